// The traction along the middle of the contact, between the limits of friction.

Carom.profile = (() => {
  const { canvas } = Carom;
  const SMALL = 12;
  const color = (name) => Carom.theme.color(name);

  // The zones behind the profile, as figures mark them.
  function zones(pen, { x, unit, top, height }, now) {
    const zone = (from, to, kind, sign) =>
      canvas.band(pen, x + from * unit, top, (to - from) * unit, height, { kind, sign });
    if (now.sign && now.stick < now.contact) {
      zone(-now.contact, -now.stick, now.kind, now.sign);
      zone(now.stick, now.contact, now.kind, now.sign);
    }
    if (now.stick > 0) zone(-now.stick, now.stick, "stick", 0);
  }

  // Traction along y = 0 between the limits of friction, on the scale of the colours.
  function draw(pen, scene, line, now) {
    const middle = line.top + line.height / 2;
    const half = line.height / 2 - 4;
    const at = (x, f) => [line.x + x * line.unit, middle - f * half];
    pen.save(); // above the scale it goes on: viscous bodies press without bound at the edge
    pen.beginPath();
    pen.rect(line.x - line.unit, line.top, 2 * line.unit, line.height);
    pen.clip();
    const limit = (x) => scene.pressureAt(x, now.contact, now.rim);
    const along = Array.from({ length: 65 }, (_, i) => now.contact * Math.sin(((i - 32) / 64) * Math.PI));
    pen.setLineDash([5, 3]);
    pen.lineWidth = 1.2;
    pen.strokeStyle = color("muted");
    const limits = scene.facts.rubs || now.kind === "stick" ? [1, -1] : []; // none without friction
    for (const side of limits) canvas.trace(pen, along.map((x) => at(x, side * limit(x))));
    pen.setLineDash([]);
    const step = now.contact / (now.traction.length - 1);
    const right = now.traction.map((f, i) => at(i * step, f));
    const left = now.traction.map((f, i) => at(-i * step, f)).reverse();
    pen.lineWidth = 2.2;
    pen.lineJoin = "round";
    pen.strokeStyle = color("accent");
    canvas.trace(pen, [...left, ...right]);
    pen.restore();
  }

  function axes(pen, { x, unit, top, height, named }) {
    const middle = top + height / 2;
    const half = height / 2 - 4;
    pen.strokeStyle = color("grid");
    pen.lineWidth = 1;
    for (const level of [-1, 0, 1]) {
      const y = Math.round(middle - level * half) + 0.5;
      canvas.trace(pen, [[x - unit, y], [x + unit, y]]);
    }
    const words = { size: SMALL, base: "middle" };
    if (named) {
      const beside = x + unit + 5;
      canvas.word(pen, "±µp", beside, middle - half + 3, { ...words, shade: color("muted") });
      canvas.word(pen, "fₓ", beside, middle, { ...words, shade: color("accent") });
    }
    const y = top + height + 9;
    const ticks = ["−1", "0", "1"];
    ticks.forEach((text, i) => canvas.word(pen, text, x + (i - 1) * unit, y, { ...words, align: "center" }));
    const name = ["x / a max →", "x/a"].find((text) => canvas.widthOf(pen, text, SMALL) < unit - 24);
    if (name) canvas.word(pen, name, x + 0.5 * unit, y, { ...words, align: "center" });
  }

  return { zones, draw, axes };
})();
