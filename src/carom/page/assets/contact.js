// Where two drawn bodies overlap: the line at which each is flattened.

Carom.contact = (() => {
  const POINTS = 24; // along the line, where it is curved

  // The line between two bodies that overlap, null if they do not.
  // at(s) is its point for s from -1 to 1 (left to right), along its direction, half the angle
  // under which each body sees it.
  function between(ball, other) {
    if (["plane", "plate"].includes(other.kind)) return onPlane(ball, other);
    return other.kind === "cup" ? inCup(ball, other) : ofSpheres(ball, other);
  }

  function onPlane(ball, plane) {
    const height = ball.y - plane.y;
    if (height >= ball.radius) return null;
    const half = Math.sqrt(Math.max(0, ball.radius ** 2 - height ** 2));
    const at = (s) => [ball.x + s * half, plane.y];
    return { at, along: [1, 0], half: [Math.atan2(half, height)], toward: [-Math.PI / 2] };
  }

  function ofSpheres(ball, other) {
    const [dx, dy] = [other.x - ball.x, other.y - ball.y];
    const apart = Math.hypot(dx, dy);
    if (apart >= ball.radius + other.radius || apart === 0) return null;
    const near = (apart ** 2 + ball.radius ** 2 - other.radius ** 2) / (2 * apart);
    const half = Math.sqrt(Math.max(0, ball.radius ** 2 - near ** 2));
    const [ux, uy] = [dx / apart, dy / apart];
    const along = [-uy, ux];
    const middle = [ball.x + ux * near, ball.y + uy * near];
    const at = (s) => [middle[0] + along[0] * half * s, middle[1] + along[1] * half * s];
    const toward = Math.atan2(dy, dx);
    return {
      at,
      along,
      half: [Math.atan2(half, near), Math.atan2(half, apart - near)],
      toward: [toward, toward + Math.PI],
    };
  }

  // In a cup the line keeps the curve of the cup.
  function inCup(ball, cup) {
    const [dx, dy] = [ball.x - cup.x, ball.y - cup.y];
    const apart = Math.hypot(dx, dy);
    if (apart + ball.radius <= cup.radius || apart === 0) return null;
    const far = (apart ** 2 + cup.radius ** 2 - ball.radius ** 2) / (2 * apart);
    const half = Math.sqrt(Math.max(0, cup.radius ** 2 - far ** 2));
    const toward = Math.atan2(dy, dx);
    const angle = Math.atan2(half, far);
    const at = (s) => {
      const turned = toward + s * angle;
      return [cup.x + cup.radius * Math.cos(turned), cup.y + cup.radius * Math.sin(turned)];
    };
    const along = [-dy / apart, dx / apart];
    return { at, along, half: [Math.atan2(half, far - apart)], toward: [toward] };
  }

  // The outline of a sphere, flattened where it touches; which: 0 the first body, 1 the second.
  function outline(body, touch, which) {
    const path = new Path2D();
    if (!touch) {
      path.arc(body.x, body.y, body.radius, 0, 2 * Math.PI);
      return path;
    }
    const [toward, half] = [touch.toward[which], touch.half[which]];
    path.arc(body.x, body.y, body.radius, toward + half, toward - half + 2 * Math.PI);
    for (let i = 0; i <= POINTS; i++) {
      const s = (2 * i) / POINTS - 1;
      path.lineTo(...touch.at(which ? -s : s));
    }
    path.closePath();
    return path;
  }

  return { between, outline };
})();
