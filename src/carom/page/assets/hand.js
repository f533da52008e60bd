// Taking the ball: its arrow is dragged for direction and speed, the ball is turned for its spin.

Carom.hand = (() => {
  const NEAR = { mouse: 14, pen: 18, touch: 30 }; // pixels from an arrow that take it
  const HANDLE = 6; // pixels of the ring at the end of the arrow
  const SHORTEST = 12; // pixels of an arrow that is dragged
  const RADIAN = 180 / Math.PI;
  const element = document.getElementById("stage");
  const color = (name) => Carom.theme.color(name);
  let over = null; // what the pointer is over: "arrow", "ball" or null
  let held = null; // what is dragged, and from where

  // The impact that is shown, as numbers in the units of its fields, which may say others.
  const view = () => Carom.page.answers()[0]?.view;

  // What was drawn last, where it can be taken: bodies, not numbers.
  function drawn() {
    const last = Carom.stage.last(element);
    return last && view() && Carom.fields.value("given") === "bodies" ? last : null;
  }

  // The velocity before of the first body.
  const arrowOf = ({ seen }) => seen.arrows.find(({ when, first }) => when === "before" && first);

  function place(event) {
    const box = element.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  }

  // How far a point is from a line between two others.
  function away([x, y], [x0, y0], [x1, y1]) {
    const [dx, dy] = [x1 - x0, y1 - y0];
    const along = Math.max(0, Math.min(1, ((x - x0) * dx + (y - y0) * dy) / (dx * dx + dy * dy || 1)));
    return Math.hypot(x - x0 - along * dx, y - y0 - along * dy);
  }

  function under(event) {
    const last = drawn();
    if (!last) return null;
    const [point, arrow] = [place(event), arrowOf(last)];
    const near = NEAR[event.pointerType] ?? NEAR.mouse;
    if (arrow && away(point, ...[arrow.from, arrow.to].map(last.seen.at)) < near) return "arrow";
    const [x, y] = last.seen.at([last.ball.x, last.ball.y]);
    return Math.hypot(point[0] - x, point[1] - y) < 1.15 * last.ball.radius * last.seen.unit ? "ball" : null;
  }

  const within = (name, value) => Math.min(Carom.config.fields[name].most, Math.max(Carom.config.fields[name].least, value));

  function take(event) {
    const what = under(event);
    if (!what || !event.isPrimary) return;
    event.preventDefault();
    element.setPointerCapture(event.pointerId);
    Carom.clock.pause();
    if (what === "arrow") Carom.clock.set(Carom.clock.START); // it points at the ball as it touches
    const { seen, ball, scene } = drawn();
    const { x, y } = what === "arrow" ? scene.bodiesAt(Carom.clock.START)[0] : ball;
    const { speed, radius } = view();
    const rim = (1000 * speed) / radius; // the spin of one radian: its rim is as fast as the ball
    held = { what, start: seen.at([x, y]), point: place(event), grip: place(event), rim, turned: 0 };
    held.before = view();
    held.last = direction(held.point);
    Carom.view.hold(true);
    Carom.page.redraw();
  }

  // The angle of an arrow to the ball, from straight down towards the right.
  const direction = ([x, y]) => Math.atan2(held.start[0] - x, held.start[1] - y);
  const length = ([x, y]) => Math.hypot(held.start[0] - x, held.start[1] - y);
  const turn = (angle) => Math.atan2(Math.sin(angle), Math.cos(angle));

  function move(event) {
    if (!held) return look(event);
    held.point = place(event);
    if (held.what === "arrow") {
      const bent = turn(direction(held.point) - direction(held.grip)) * RADIAN;
      const angle = within("angle", held.before.angle + bent);
      const part = Math.max(SHORTEST, length(held.point)) / Math.max(SHORTEST, length(held.grip));
      const speed = within("speed", held.before.speed * part);
      return Carom.fields.move({ angle: String(Number(angle.toFixed(1))), speed: String(Number(speed.toPrecision(3))) });
    }
    held.turned += turn(direction(held.point) - held.last);
    held.last = direction(held.point);
    const spin = within("spin", held.before.spin + held.turned * held.rim);
    return Carom.fields.move({ spin: String(Number(spin.toPrecision(3))) });
  }

  function leave(event) {
    if (!held) return;
    held = null;
    Carom.view.hold(false);
    look(event);
    Carom.page.redraw();
    Carom.page.replay();
  }

  function look(event) {
    const now = under(event);
    element.style.cursor = now ? "grab" : "";
    if (now !== over) Carom.page.redraw();
    over = now;
  }

  // The arrow that is held, with what it says; otherwise a ring that shows where to take it.
  function draw(pen, { seen, ball }) {
    const arrow = arrowOf({ seen });
    if (!drawn() || (!arrow && !held)) return;
    if (held?.what === "arrow") {
      Carom.canvas.arrows(pen, [[...held.point, ...held.start]], color("accent"), 4, color("panel"));
      ring(pen, held.point, true);
      words(pen, `${Carom.fields.value("angle")}°, ${Carom.fields.value("speed")} m/s`);
    } else if (arrow) ring(pen, seen.at(arrow.from), over === "arrow");
    if (over === "ball" || held?.what === "ball") turned(pen, seen, ball);
    if (held?.what === "ball") words(pen, `${Carom.fields.value("spin")} rad/s`);
  }

  function ring(pen, [x, y], strong) {
    pen.beginPath();
    pen.arc(x, y, HANDLE, 0, 2 * Math.PI);
    pen.fillStyle = color(strong ? "accent" : "panel");
    pen.strokeStyle = color("accent");
    pen.lineWidth = 2;
    pen.fill();
    pen.stroke();
  }

  function words(pen, text) {
    const [x, y] = held.point;
    const align = x > element.clientWidth / 2 ? "right" : "left";
    Carom.canvas.haloed(pen, text, x + (align === "left" ? 12 : -12), Math.max(16, y - 10), { align, size: 14 });
  }

  // An arc around the ball: it can be turned.
  function turned(pen, seen, ball) {
    const [x, y] = seen.at([ball.x, ball.y]);
    const radius = 0.78 * ball.radius * seen.unit;
    pen.strokeStyle = color("accent");
    pen.lineWidth = 3;
    for (const start of [-0.7, Math.PI - 0.7]) {
      pen.beginPath();
      pen.arc(x, y, radius, start, start + 1.4);
      pen.stroke();
    }
  }

  element.addEventListener("pointerdown", take);
  element.addEventListener("pointermove", move);
  for (const kind of ["pointerup", "pointercancel"]) element.addEventListener(kind, leave);
  element.addEventListener("pointerleave", (event) => !held && look(event));
  element.addEventListener("touchstart", (event) => held && event.preventDefault(), { passive: false });

  return { draw, throws: () => held?.what === "arrow" };
})();
