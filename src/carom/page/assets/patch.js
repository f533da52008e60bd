// The contact from above: traction as shading, stick and slip; and the traction along the middle.

Carom.patch = (() => {
  const { canvas, profile } = Carom;
  const { EDGE, LINE, SMALL } = Carom.patchLayout;
  const SPACING = 0.25; // of slip arrows, in radii of the largest contact,
  const FEWER = 18; // and at least, in pixels
  const THIN = 0.05; // ring without arrows
  const NAME = 13;
  const color = (name) => Carom.theme.color(name);
  let map = { text: "", stops: [] };

  // The colour of a traction between -1 and 1: the stops are in the style sheet.
  function shade(value) {
    const text = color("traction-map");
    if (map.text !== text) {
      const hex = text.split(",").map((part) => parseInt(part.trim().slice(1), 16));
      map = { text, stops: hex.map((n) => [n >> 16, (n >> 8) & 255, n & 255]) };
    }
    const place = ((Math.max(-1, Math.min(1, value)) + 1) / 2) * (map.stops.length - 1);
    const low = Math.min(map.stops.length - 2, Math.floor(place));
    const mixed = map.stops[low].map((from, i) => {
      return Math.round(from + (place - low) * (map.stops[low + 1][i] - from));
    });
    return `rgb(${mixed.join(",")})`;
  }

  function circle(pen, { x, y, unit }, radius) {
    pen.beginPath();
    pen.arc(x, y, radius * unit, 0, 2 * Math.PI);
  }

  function drawShading(pen, disc, now) {
    const fill = pen.createRadialGradient(disc.x, disc.y, 0, disc.x, disc.y, now.contact * disc.unit);
    const last = now.traction.length - 1;
    now.traction.forEach((value, i) => fill.addColorStop(i / last, shade(value)));
    circle(pen, disc, now.contact);
    pen.fillStyle = fill;
    pen.fill();
  }

  // The ring that slips: lines that tell its sign, arrows along which the first body slides.
  function drawSlip(pen, disc, now, name) {
    if (!now.sign || now.contact <= now.stick) return;
    const { x, y, unit } = disc;
    pen.save();
    circle(pen, disc, now.contact);
    if (now.stick > 0) pen.arc(x, y, now.stick * unit, 0, 2 * Math.PI, true);
    pen.clip("evenodd");
    pen.strokeStyle = color("hatch");
    pen.lineWidth = 1;
    const reach = now.contact * unit;
    canvas.hatch(pen, x - reach, y - reach, 2 * reach, 2 * reach, now.sign, 9);
    pen.restore();
    const spacing = Math.max(SPACING, FEWER / unit);
    const rings = Math.max(1, Math.floor((now.contact - now.stick) / spacing));
    const width = (now.contact - now.stick) / rings;
    if (width < THIN || width * unit < 5) return;
    const places = Array.from({ length: rings }, (_, i) => now.stick + (i + 0.5) * width);
    const all = places.flatMap((radius) => arrowsOn(disc, now, radius, spacing, width, name));
    canvas.arrows(pen, all, color("ink"), 1.6, color("panel"));
  }

  function arrowsOn({ x, y, unit }, now, radius, spacing, width, name) {
    const count = Math.max(6, 2 * Math.round((Math.PI * radius) / spacing));
    const half = 0.5 * Math.max(8, Math.min(0.64 * spacing, 0.75 * width) * unit) * now.sign;
    const all = [];
    for (let i = 0; i < count; i++) {
      const angle = ((i + 0.5) / count) * 2 * Math.PI;
      const [ax, ay] = [x + radius * unit * Math.cos(angle), y - radius * unit * Math.sin(angle)];
      const box = { left: ax - Math.abs(half), top: ay - 4, wide: 2 * Math.abs(half), high: 8 };
      if (!(name && canvas.meet(box, name))) all.push([ax - half, ay, ax + half, ay]);
    }
    return all;
  }

  // The edge in the colour of what it does, the stick zone in its own.
  function drawBorders(pen, disc, now) {
    const line = (radius, shade, width) => {
      circle(pen, disc, radius);
      pen.lineWidth = width;
      pen.strokeStyle = shade;
      pen.stroke();
    };
    line(now.contact, canvas.phaseColor(now.kind), 2.5);
    if (now.stick <= 0 || now.stick >= now.contact) return;
    line(now.stick, color("panel"), 4.5);
    line(now.stick, color("stick"), 2.5);
  }

  // The box of the name of what slips, null where there is no room for it.
  function nameOfSlip(pen, { x, y, unit }, now) {
    if (!now.sign) return null;
    const [wide, high] = [canvas.widthOf(pen, now.phase, NAME), NAME + 3];
    const [edge, inner] = [now.contact * unit, now.stick * unit];
    const down = inner > 0 ? 0.5 * (inner + edge) : 0;
    const inside = Math.hypot(wide / 2, down + high / 2) < edge - 2;
    if (!inside || (inner > 0 && edge - inner < high + 6)) return null;
    return { left: x - wide / 2, top: y + down - high / 2, wide, high };
  }

  function drawNames(pen, disc, now, name) {
    const middle = { align: "center", base: "middle", size: NAME };
    const room = 1.6 * now.stick * disc.unit;
    const stick = Carom.scene.nameOf({ kind: "stick", sign: 0 });
    if (room > canvas.widthOf(pen, stick, NAME)) canvas.haloed(pen, stick, disc.x, disc.y, middle);
    if (name) canvas.haloed(pen, now.phase, disc.x, name.top + name.high / 2, middle);
  }

  function drawBar(pen, { bar, left, side, map: disc }) {
    if (bar === "none") return;
    const [x, thick] = [left + side + 10, bar === "full" ? 12 : 8];
    const top = disc.y - side / 2 + 24;
    const tall = side - 32;
    const fill = pen.createLinearGradient(0, top, 0, top + tall);
    for (let i = 0; i <= 16; i++) fill.addColorStop(i / 16, shade(1 - i / 8));
    pen.fillStyle = fill;
    pen.fillRect(x, top, thick, tall);
    pen.strokeStyle = color("muted");
    pen.lineWidth = 1;
    pen.strokeRect(x, top, thick, tall);
    const levels = tall > 76 && bar === "full" ? ["1", "0.5", "0", "−0.5", "−1"] : ["1", "0", "−1"];
    levels.forEach((text, i) => {
      const y = top + (i / (levels.length - 1)) * tall;
      canvas.word(pen, text, x + thick + 5, y, { base: "middle", size: SMALL });
    });
    const name = bar === "full" ? "fₓ / (µ p₀)" : "fₓ/µp₀";
    canvas.word(pen, name, x - 4, top - 14, { size: SMALL, base: "middle" });
  }

  // The border of the stick zone, from the map down to the profile.
  function drawTies(pen, { map: disc, line, tied }, now) {
    if (!line || !tied || now.stick <= 0) return;
    pen.setLineDash([2, 3]);
    pen.strokeStyle = color("stick");
    pen.lineWidth = 1.2;
    for (const side of [-1, 1]) {
      const x = disc.x + side * now.stick * disc.unit;
      canvas.trace(pen, [[x, disc.y], [x, line.top]]);
    }
    pen.setLineDash([]);
  }

  // What no instant changes: the largest contact, scales and numbers.
  function drawFrame(pen, box) {
    circle(pen, box.map, 1);
    pen.setLineDash([4, 4]);
    pen.strokeStyle = color("muted");
    pen.lineWidth = 1;
    pen.stroke();
    pen.setLineDash([]);
    drawBar(pen, box);
    if (box.line) profile.axes(pen, box.line);
  }

  function drawFoot(pen, { foot, width, height, low }, now) {
    const note = now.rim > 0 ? foot.rim : foot.slip;
    const y = height - LINE / 2 - 2;
    const place = foot.lines === 1 ? [width - EDGE, y] : [EDGE, y];
    const align = foot.lines === 1 ? "right" : "left";
    canvas.word(pen, note, ...place, { align, base: "middle", size: SMALL, shade: color("muted") });
    canvas.drawKey(pen, now, EDGE, low + 4 + LINE / 2 - 2);
  }

  function draw(element, scene, share) {
    const sheet = element && canvas.ready(element);
    if (!sheet || !scene) return;
    const { pen, width, height } = sheet;
    const box = Carom.patchLayout.of(pen, scene, width, height);
    const now = scene.at(share);
    const touching = !now.apart && now.contact > 0;
    if (touching && box.line) profile.zones(pen, box.line, now);
    canvas.layer(element, "frame", sheet, [scene, Boolean(box.line)], (own) => drawFrame(own, box));
    if (touching) {
      const name = nameOfSlip(pen, box.map, now);
      drawShading(pen, box.map, now);
      drawSlip(pen, box.map, now, name);
      drawBorders(pen, box.map, now);
      drawTies(pen, box, now);
      drawNames(pen, box.map, now, name);
      if (box.line) profile.draw(pen, scene, box.line, now);
    } else if (now.apart) {
      const middle = { align: "center", base: "middle", size: NAME, shade: color("muted") };
      canvas.word(pen, "apart", box.map.x, box.map.y, middle);
    }
    drawFoot(pen, box, now);
  }

  return { draw };
})();
