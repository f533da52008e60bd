// What of the bodies fits on the canvas: its scale, and the arrows of their velocities.

Carom.view = (() => {
  const DEPTH = 0.55; // of a plane or cup that is shown, in radii of the ball
  const BELOW = 0.2; // of what is below a plate
  const WHOLE = 2.5; // larger second spheres are shown in part
  const PART = 1.2;
  const ARROW = 0.9; // the longest, in radii
  const NAMED = [26, 21]; // pixels beside and above the tip of an arrow, for its name
  const EASY = 24; // pixels of a radius that are seen well
  const views = new WeakMap();
  let last = null;
  let held = false; // by a hand: then nothing else moves

  const least = (values) => values.reduce((a, b) => Math.min(a, b));
  const most = (values) => values.reduce((a, b) => Math.max(a, b));

  // Velocities before and after, from the ends of a path; to be scaled alike for all bodies.
  function speeds(body) {
    const last = body.x.length - 1;
    const before = [body.x[1] - body.x[0], body.y[1] - body.y[0]];
    const after = [body.x[last] - body.x[last - 1], body.y[last] - body.y[last - 1]];
    return { before, after };
  }

  // Where the arrows of both velocities start and end, the longest of all as long as ARROW.
  function arrows({ bodies }) {
    const moving = bodies.filter((body) => body.kind === "sphere");
    const all = moving.map(speeds);
    const longest = most(all.flatMap((each) => [each.before, each.after].map((v) => Math.hypot(...v))));
    if (!(longest > 0)) return [];
    return moving.flatMap((body, row) => {
      const last = body.x.length - 1;
      const ends = [[body.x[0], body.y[0]], [body.x[last], body.y[last]]];
      return ["before", "after"].map((when, i) => {
        const [vx, vy] = all[row][when].map((v) => (v * ARROW) / longest);
        const [x, y] = ends[i];
        const [from, to] = i ? [[x, y], [x + vx, y + vy]] : [[x - vx, y - vy], [x, y]];
        const length = Math.hypot(vx, vy);
        return { when, from, to, tip: i ? to : from, length, first: body === bodies[0] };
      });
    });
  }

  // The box that must be seen, in radii, with so much room around the tips of arrows.
  function bounds(stage, whole, room) {
    const [ball, other] = stage.bodies;
    const box = {
      left: least(ball.x) - ball.radius,
      right: most(ball.x) + ball.radius,
      top: most(ball.y) + ball.radius,
      bottom: least(ball.y) - ball.radius - DEPTH,
    };
    if (other.kind === "sphere") {
      const side = whole ? other.radius : 0;
      box.left = Math.min(box.left, least(other.x) - side);
      box.right = Math.max(box.right, most(other.x) + side);
      const part = Math.min(PART, 2 * other.radius);
      const deep = whole ? least(other.y) - other.radius : most(other.y) + other.radius - part;
      box.bottom = Math.min(box.bottom, deep);
    } else {
      const deep = other.kind === "plate" ? Math.min(PART, Math.max(DEPTH, other.radius + BELOW)) : DEPTH;
      box.bottom = (other.kind === "cup" ? other.y[0] - other.radius : least(other.y)) - deep;
    }
    for (const { tip } of arrows(stage)) {
      box.left = Math.min(box.left, tip[0] - room[0]);
      box.right = Math.max(box.right, tip[0] + room[0]);
      box.top = Math.max(box.top, tip[1] + room[1]);
      if (whole) box.bottom = Math.min(box.bottom, tip[1] - 0.5 * room[1]);
    }
    return box;
  }

  function fitted(stage, whole, width, height) {
    let unit = EASY;
    let box = null;
    for (let i = 0; i < 4; i++) {
      box = bounds(stage, whole, NAMED.map((pixels) => pixels / unit));
      unit = Math.min((width - 12) / (box.right - box.left), (height - 8) / (box.top - box.bottom));
    }
    return { unit, box };
  }

  // A small second sphere is shown whole where there is room.
  function chosen(stage, width, height) {
    const part = fitted(stage, false, width, height);
    if (stage.bodies[1].kind !== "sphere" || stage.bodies[1].radius > WHOLE) return part;
    const whole = fitted(stage, true, width, height);
    return whole.unit >= Math.min(EASY, part.unit) ? whole : part;
  }

  function made(stage, width, height) {
    const { unit, box } = chosen(stage, width, height);
    const x = width / 2 - 0.5 * (box.left + box.right) * unit;
    const y = height / 2 + 0.5 * (box.top + box.bottom) * unit;
    const at = (point) => [x + point[0] * unit, y - point[1] * unit];
    return { unit, x, y, at, arrows: arrows(stage), width, height };
  }

  function of(stage, width, height) {
    const old = views.get(stage);
    if (old && old.width === width && old.height === height) return old;
    const still = held && last && last.width === width && last.height === height;
    const view = still ? { ...last, arrows: arrows(stage) } : made(stage, width, height);
    if (!still) views.set(stage, view);
    last = view;
    return view;
  }

  return { of, hold: (on) => (held = on) };
})();
