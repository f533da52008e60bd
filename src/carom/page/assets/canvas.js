// What both canvases share: sharp at any pixel density, layers that are kept, arrows, words, keys.

Carom.canvas = (() => {
  const FONT = "system-ui, -apple-system, 'Segoe UI', Roboto, sans-serif";
  const GAP = 3; // pixels between two words
  const THEMED = ["ink", "panel", "traction-map"]; // whoever changes the theme changes these
  const layers = new WeakMap(); // of each canvas: what is the same in many frames
  const widths = new Map();
  const color = (name) => Carom.theme.color(name);

  // Clear a canvas, fit it to its box; null where there is no room to draw.
  function ready(canvas) {
    const { clientWidth: width, clientHeight: height } = canvas;
    if (width < 40 || height < 40) return null;
    return sheet(canvas, width, height);
  }

  function sheet(canvas, width, height) {
    const dense = window.devicePixelRatio || 1;
    const [across, down] = [Math.round(width * dense), Math.round(height * dense)];
    const pen = canvas.getContext("2d");
    if (canvas.width !== across || canvas.height !== down) {
      Object.assign(canvas, { width: across, height: down }); // slow: all its memory is new
    }
    pen.reset(); // forgets how the pen was left, too
    pen.scale(dense, dense);
    return { pen, width, height, dense };
  }

  // Draw a layer that is painted anew only where its size, the theme or what it shows has changed.
  // Returns what paint returned.
  function layer(canvas, name, { pen, width, height, dense }, shown, paint) {
    if (!layers.has(canvas)) layers.set(canvas, {});
    const kept = layers.get(canvas);
    const key = [width, height, dense, ...THEMED.map(color), ...shown];
    const old = kept[name];
    if (!old || old.key.some((part, i) => part !== key[i])) {
      const own = old ? old.own : document.createElement("canvas");
      kept[name] = { own, key, made: paint(sheet(own, width, height).pen) };
    }
    pen.drawImage(kept[name].own, 0, 0, width, height);
    return kept[name].made;
  }

  const fontOf = (size) => `${size}px ${FONT}`;

  function widthOf(pen, text, size = 12) {
    const key = `${size} ${text}`;
    if (!widths.has(key)) {
      pen.font = fontOf(size);
      widths.set(key, pen.measureText(text).width);
    }
    return widths.get(key);
  }

  function word(pen, text, x, y, { align = "left", base = "alphabetic", shade, size = 12 } = {}) {
    pen.font = fontOf(size);
    pen.textAlign = align;
    pen.textBaseline = base;
    pen.fillStyle = shade || color("ink");
    pen.fillText(text, x, y);
  }

  // A word that is read on any ground.
  function haloed(pen, text, x, y, options = {}) {
    pen.font = fontOf(options.size || 12);
    pen.textAlign = options.align || "left";
    pen.textBaseline = options.base || "alphabetic";
    pen.lineJoin = "round";
    pen.lineWidth = 3.5;
    pen.strokeStyle = color("panel");
    pen.strokeText(text, x, y);
    word(pen, text, x, y, options);
  }

  // Name a point beside it, where the name neither leaves the box nor meets another name; boxes
  // are those taken so far. Without such a place the point stays without a name.
  function name(pen, text, [x, y], boxes, { width, height }, { size = 12, order = "above" } = {}) {
    const [wide, high] = [widthOf(pen, text, size), size + 2];
    const places = {
      above: [x - wide / 2, y - high - 4],
      right: [x + 7, y - high / 2],
      left: [x - wide - 7, y - high / 2],
      lowerRight: [x + 7, y + 1],
      lowerLeft: [x - wide - 7, y + 1],
      below: [x - wide / 2, y + 5],
    };
    for (const side of [order, ...Object.keys(places)]) {
      const [left, top] = places[side];
      const box = { left: Math.min(Math.max(left, 4), width - wide - 4), top, wide, high };
      if (top < 2 || top + high > height - 2 || boxes.some((other) => meet(box, other))) continue;
      if (Math.abs(box.left - left) > wide / 2 + 6) continue; // far from its point
      boxes.push(box);
      haloed(pen, text, box.left, top + high / 2, { base: "middle", size });
      return box;
    }
    return null;
  }

  function meet(a, b) {
    const across = a.left < b.left + b.wide + GAP && b.left < a.left + a.wide + GAP;
    return across && a.top < b.top + b.high + GAP && b.top < a.top + a.high + GAP;
  }

  // Arrows of one look, each [x0, y0, x1, y1]; with a halo they are seen on any ground.
  function arrows(pen, all, shade, width = 2, halo = "") {
    const [shafts, heads] = [new Path2D(), new Path2D()];
    for (const [x0, y0, x1, y1] of all) {
      const length = Math.hypot(x1 - x0, y1 - y0);
      if (length < 1) continue;
      const head = Math.min(4 + 2.2 * width, 0.6 * length);
      const [ux, uy] = [(x1 - x0) / length, (y1 - y0) / length];
      const [bx, by] = [x1 - ux * head, y1 - uy * head];
      shafts.moveTo(x0, y0);
      shafts.lineTo(bx, by);
      heads.moveTo(x1, y1);
      heads.lineTo(bx - uy * head * 0.45, by + ux * head * 0.45);
      heads.lineTo(bx + uy * head * 0.45, by - ux * head * 0.45);
      heads.closePath();
    }
    pen.lineCap = "butt";
    if (halo) {
      pen.strokeStyle = halo;
      pen.lineWidth = width + 2;
      pen.stroke(shafts);
      pen.lineWidth = 2;
      pen.stroke(heads);
    }
    pen.strokeStyle = pen.fillStyle = shade;
    pen.lineWidth = width;
    pen.stroke(shafts);
    pen.fill(heads);
  }

  function trace(pen, points) {
    pen.beginPath();
    points.forEach(([x, y], i) => (i ? pen.lineTo(x, y) : pen.moveTo(x, y)));
    pen.stroke();
  }

  const phaseColor = (kind) => color(kind === "gross slip" ? "gross" : kind);
  const phaseFill = (kind) => color(`${kind === "gross slip" ? "gross" : kind}-fill`);

  // Lines across a box, rising to the right for slip +, falling for slip −: read without colour.
  function hatch(pen, x, y, width, height, sign, gap = 8) {
    pen.beginPath();
    for (let along = -height; along < width; along += gap) {
      const [from, to] = sign < 0 ? [along, along + height] : [along + height, along];
      pen.moveTo(x + from, y);
      pen.lineTo(x + to, y + height);
    }
    pen.stroke();
  }

  // A box as figures mark a phase: a tint, and lines that tell the sign of slip.
  function band(pen, x, y, width, height, { kind, sign }, gap) {
    if (width <= 0) return;
    pen.save();
    pen.beginPath();
    pen.rect(x, y, width, height);
    pen.clip();
    pen.fillStyle = phaseFill(kind);
    pen.fillRect(x, y, width, height);
    if (sign) {
      pen.globalAlpha = kind === "gross slip" ? 0.4 : 0.55;
      pen.strokeStyle = phaseColor(kind);
      pen.lineWidth = 1;
      hatch(pen, x, y, width, height, sign, gap || (kind === "gross slip" ? 6 : 8));
    }
    pen.restore();
  }

  // What the zones of the contact are called, beside how they are marked, on one line.
  const SWATCH = [20, 11];
  const [NEAR, APART] = [6, 14]; // pixels from a swatch to its name, and to the next
  const KEY = 12;

  function zonesOf({ apart, stick, contact, kind, sign, phase }) {
    if (apart) return [];
    const zones = stick > 0 || kind === "stick" ? [{ name: Carom.scene.nameOf({ kind: "stick", sign: 0 }), kind: "stick", sign: 0 }] : [];
    return sign && stick < contact ? [...zones, { name: phase, kind, sign }] : zones;
  }

  function drawKey(pen, now, x, y) {
    let at = x;
    for (const zone of zonesOf(now)) {
      const [wide, high] = SWATCH;
      band(pen, at, y - high / 2, wide, high, zone, 6);
      pen.strokeStyle = phaseColor(zone.kind);
      pen.lineWidth = 1.5;
      pen.strokeRect(at, y - high / 2, wide, high);
      word(pen, zone.name, at + wide + NEAR, y + 0.5, { base: "middle", size: KEY });
      at += wide + NEAR + widthOf(pen, zone.name, KEY) + APART;
    }
  }

  // The room that the key takes at most while a film runs.
  function keyWidth(pen, { data }) {
    const one = (name) => SWATCH[0] + NEAR + widthOf(pen, name, KEY);
    const names = data.phases.map((phase) => [phase.kind, one(Carom.scene.nameOf(phase))]);
    const takes = names.map(([kind, wide]) => (kind === "slip" ? one(Carom.scene.nameOf({ kind: "stick", sign: 0 })) + APART + wide : wide));
    return Math.max(...takes);
  }

  return { ready, layer, forget: (canvas) => layers.delete(canvas), widthOf, word, haloed, name, meet, trace, arrows, phaseColor, hatch, band, drawKey, keyWidth };
})();
