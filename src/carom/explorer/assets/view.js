// What of the bodies fits on the canvas: its scale, and the arrows of their velocities.
window.Carom = window.Carom || {};

Carom.view = (() => {
  const DEPTH = 0.55; // of a plane or cup that is shown, in radii of the ball
  const WHOLE = 2.5; // larger second spheres are shown in part
  const PART = 1.2;
  const ARROW = 0.9; // the longest, in radii
  const MARGIN = 0.3; // around the tip of an arrow, for its name
  const SMALLEST = 18; // pixels of a radius

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

  function bounds(stage) {
    const [ball, other] = stage.bodies;
    const box = {
      left: least(ball.x) - ball.radius,
      right: most(ball.x) + ball.radius,
      top: most(ball.y) + ball.radius,
      bottom: least(ball.y) - ball.radius - DEPTH,
    };
    if (other.kind === "sphere") {
      const whole = other.radius <= WHOLE;
      const side = whole ? other.radius : 0;
      box.left = Math.min(box.left, least(other.x) - side);
      box.right = Math.max(box.right, most(other.x) + side);
      const deep = whole ? least(other.y) - other.radius : most(other.y) + other.radius - PART;
      box.bottom = Math.min(box.bottom, deep);
    } else {
      box.bottom = (other.kind === "cup" ? other.y[0] - other.radius : other.y[0]) - DEPTH;
    }
    for (const { tip } of arrows(stage)) {
      box.left = Math.min(box.left, tip[0] - MARGIN);
      box.right = Math.max(box.right, tip[0] + MARGIN);
      box.top = Math.max(box.top, tip[1] + MARGIN);
    }
    return box;
  }

  function of(stage, width, height, foot) {
    const box = bounds(stage);
    const room = [width - 16, height - foot - 12];
    const fit = Math.min(room[0] / (box.right - box.left), room[1] / (box.top - box.bottom));
    const unit = Math.max(SMALLEST, fit);
    const x = width / 2 - 0.5 * (box.left + box.right) * unit;
    const y = 6 + room[1] / 2 + 0.5 * (box.top + box.bottom) * unit;
    return { unit, x, y, at: (point) => [x + point[0] * unit, y - point[1] * unit] };
  }

  return { of, arrows };
})();
