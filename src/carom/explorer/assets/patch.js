// The contact from above: traction as shading, stick and slip, and both along a line below.
window.Carom = window.Carom || {};

Carom.patch = (() => {
  const { canvas } = Carom;
  const BAR = 74; // pixels that the colour bar and its words take
  const SPACING = 0.25; // of slip arrows, in radii of the largest contact
  const NAME = [52, 12]; // pixels around the name of the slip, without arrows
  const THIN = 0.05; // ring without arrows
  const ARROWS = "arrows: the first body slides on the second";
  const UNBOUNDED = "viscous bodies being loaded: p is unbounded at the edge";
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

  function layout(width, height) {
    const profile = Math.max(76, Math.min(120, 0.27 * height));
    const top = 8;
    const side = Math.max(60, Math.min(width - BAR - 24, height - profile - top - 44));
    const x = Math.max(12, (width - BAR - side) / 2);
    const map = { x: x + side / 2, y: top + side / 2, unit: (side / 2) * 0.97 };
    const line = { top: top + side + 8, height: profile, middle: top + side + 8 + profile / 2 };
    return { width, height, side, left: x, top, map, line };
  }

  function circle(pen, map, radius) {
    pen.beginPath();
    pen.arc(map.x, map.y, radius * map.unit, 0, 2 * Math.PI);
  }

  function ring(pen, map, from, to) {
    pen.beginPath();
    pen.arc(map.x, map.y, to * map.unit, 0, 2 * Math.PI);
    if (from > 0) pen.arc(map.x, map.y, from * map.unit, 0, 2 * Math.PI, true);
  }

  function drawShading(pen, map, now) {
    const fill = pen.createRadialGradient(map.x, map.y, 0, map.x, map.y, now.contact * map.unit);
    const last = now.traction.length - 1;
    now.traction.forEach((value, i) => fill.addColorStop(i / last, shade(value)));
    circle(pen, map, now.contact);
    pen.fillStyle = fill;
    pen.fill();
  }

  function drawSlip(pen, map, now) {
    if (!now.sign || now.contact <= now.stick) return;
    pen.save();
    ring(pen, map, now.stick, now.contact);
    pen.clip("evenodd");
    pen.strokeStyle = color("hatch");
    pen.lineWidth = 1;
    canvas.hatch(pen, map.x - map.unit, map.y - map.unit, 2 * map.unit, now.sign);
    pen.restore();
    const rings = Math.max(1, Math.floor((now.contact - now.stick) / SPACING));
    const width = (now.contact - now.stick) / rings;
    if (width < THIN) return;
    for (let i = 0; i < rings; i++) drawArrows(pen, map, now, now.stick + (i + 0.5) * width, width);
  }

  // Where the first body slides on the second, evenly around a circle.
  function drawArrows(pen, map, now, radius, width) {
    const count = Math.max(6, 2 * Math.round((Math.PI * radius) / SPACING));
    const name = nameOfSlip(map, now) || [-1e3, -1e3];
    const half = 0.5 * Math.min(0.16, Math.max(0.09, 0.75 * width)) * map.unit * now.sign;
    for (let i = 0; i < count; i++) {
      const angle = ((i + 0.5) / count) * 2 * Math.PI;
      const x = map.x + radius * map.unit * Math.cos(angle);
      const y = map.y - radius * map.unit * Math.sin(angle);
      if (Math.abs(x - name[0]) < NAME[0] && Math.abs(y - name[1]) < NAME[1]) continue;
      canvas.arrow(pen, x - half, y, x + half, y, color("ink"), 1.6);
    }
  }

  function drawBorders(pen, map, now) {
    circle(pen, map, now.contact);
    pen.lineWidth = 1.5;
    pen.strokeStyle = color("ink");
    pen.stroke();
    if (now.stick <= 0) return;
    circle(pen, map, now.stick);
    pen.lineWidth = 4.5;
    pen.strokeStyle = color("panel");
    pen.stroke();
    pen.lineWidth = 2.5;
    pen.strokeStyle = color("stick");
    pen.stroke();
  }

  // Where the name of the slip is written, null where there is no room for it.
  function nameOfSlip(map, now) {
    const room = (now.contact - now.stick) * map.unit;
    if (!now.sign || room < 20) return null;
    return [map.x, map.y + map.unit * (now.stick > 0 ? 0.5 * (now.stick + now.contact) : 0)];
  }

  function drawNames(pen, map, now) {
    const middle = { align: "center", base: "middle", size: 13 };
    if (now.stick > 0.25) canvas.haloed(pen, "stick", map.x, map.y, middle);
    const place = nameOfSlip(map, now);
    if (place) canvas.haloed(pen, now.phase, ...place, middle);
  }

  function drawBar(pen, box) {
    const x = box.left + box.side + 14;
    const [top, height] = [box.top + 22, box.side - 44];
    const fill = pen.createLinearGradient(0, top, 0, top + height);
    for (let i = 0; i <= 16; i++) fill.addColorStop(i / 16, shade(1 - i / 8));
    pen.fillStyle = fill;
    pen.fillRect(x, top, 12, height);
    pen.strokeStyle = color("muted");
    pen.lineWidth = 1;
    pen.strokeRect(x + 0.5, top + 0.5, 12, height);
    ["1", "0.5", "0", "−0.5", "−1"].forEach((text, i) => {
      canvas.word(pen, text, x + 18, top + (i / 4) * height, { base: "middle", size: 11 });
    });
    canvas.word(pen, "fₓ / (µ p₀)", x, top - 11, { size: 11 });
  }

  // Traction along y = 0, between the limits of friction, below the map and on its scale.
  function drawLine(pen, box, now) {
    const { map, line } = box;
    const half = line.height / 2 - 4;
    const at = (x, f) => [map.x + x * map.unit, line.middle - f * half];
    drawAxes(pen, box, half);
    if (now.apart || now.contact <= 0) return;
    pen.save(); // above the scale it goes on: viscous bodies press without bound at the edge
    pen.beginPath();
    pen.rect(0, line.top, box.width, line.height);
    pen.clip();
    const limit = (x) => Carom.scene.pressureAt(x, now.contact, now.rim);
    const along = Array.from({ length: 65 }, (_, i) => now.contact * Math.sin(((i - 32) / 64) * Math.PI));
    for (const side of [1, -1]) {
      path(pen, along.map((x) => at(x, side * limit(x))));
      pen.setLineDash([5, 3]);
      pen.lineWidth = 1.2;
      pen.strokeStyle = color("muted");
      pen.stroke();
      pen.setLineDash([]);
    }
    const step = now.contact / (now.traction.length - 1);
    const right = now.traction.map((f, i) => at(i * step, f));
    const left = now.traction.map((f, i) => at(-i * step, f)).reverse();
    path(pen, [...left, ...right]);
    pen.lineWidth = 2.2;
    pen.lineJoin = "round";
    pen.strokeStyle = color("accent");
    pen.stroke();
    pen.restore();
    if (now.stick > 0) drawTies(pen, box, now);
  }

  function drawAxes(pen, box, half) {
    const { map, line } = box;
    pen.strokeStyle = color("grid");
    pen.lineWidth = 1;
    for (const level of [-1, 0, 1]) {
      const y = Math.round(line.middle - level * half) + 0.5;
      path(pen, [[map.x - map.unit, y], [map.x + map.unit, y]]);
      pen.stroke();
    }
    const words = { size: 11, base: "middle", color: color("ink") };
    const beside = map.x + map.unit + 8;
    canvas.word(pen, "± µ p", beside, line.middle - half + 4, { ...words, color: color("muted") });
    canvas.word(pen, "fₓ", beside, line.middle, { ...words, color: color("accent") });
    const y = line.top + line.height + 9;
    ["−1", "0", "1"].forEach((text, i) => {
      canvas.word(pen, text, map.x + (i - 1) * map.unit, y, { ...words, align: "center" });
    });
    canvas.word(pen, "x / a max →", map.x + 0.5 * map.unit, y, { ...words, align: "center" });
  }

  // The border of the stick zone, from the map down to the line.
  function drawTies(pen, box, now) {
    pen.setLineDash([2, 3]);
    pen.strokeStyle = color("stick");
    pen.lineWidth = 1.2;
    for (const side of [-1, 1]) {
      const x = box.map.x + side * now.stick * box.map.unit;
      path(pen, [[x, box.map.y], [x, box.line.top + box.line.height]]);
      pen.stroke();
    }
    pen.setLineDash([]);
  }

  function path(pen, points) {
    pen.beginPath();
    points.forEach(([x, y], i) => (i ? pen.lineTo(x, y) : pen.moveTo(x, y)));
  }

  function draw(share) {
    const element = document.getElementById("patch");
    const sheet = element && canvas.ready(element);
    if (!sheet || !Carom.scene.data()) return;
    const { pen } = sheet;
    const box = layout(sheet.width, sheet.height);
    const now = Carom.scene.at(share);
    circle(pen, box.map, 1);
    pen.setLineDash([4, 4]);
    pen.strokeStyle = color("muted");
    pen.lineWidth = 1;
    pen.stroke();
    pen.setLineDash([]);
    drawBar(pen, box);
    const foot = { align: "center", size: 11, color: color("muted") };
    canvas.word(pen, now.rim > 0 ? UNBOUNDED : ARROWS, sheet.width / 2, sheet.height - 4, foot);
    if (now.apart) {
      canvas.word(pen, "apart", box.map.x, box.map.y, { align: "center", size: 14, color: color("muted") });
    } else if (now.contact > 0) {
      drawShading(pen, box.map, now);
      drawSlip(pen, box.map, now);
      drawBorders(pen, box.map, now);
    }
    drawLine(pen, box, now);
    if (!now.apart) drawNames(pen, box.map, now);
  }

  return { draw };
})();
