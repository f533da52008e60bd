// The balls on their way: where they are and how far they have turned, before, during and after.
// Lengths are in radii of the first, and motion is magnified so that it can be seen. A ball that is
// struck is at rest before, as people see it.

Carom.paths = (() => {
  const BEYOND = 0.6; // of the contact's duration that is shown before and after
  const [DEEPEST, WIDEST] = [0.3, 6]; // radii that the bodies may approach, and travel sideways
  const SLAB = 0.3; // ball radii that a plate is thick of which no thickness is known
  const BENT = { plane: "", plate: ", plate to scale", cup: ", paths bent", sphere: ", the struck ball at rest before" };
  const STEEPEST = 0.7; // angle by which a ball may travel around in a cup
  const ROLLED = 0.3; // angle by which a ball may travel around another while they touch
  const ROLLS = 2 / 7; // of the impulse on the contact point of a solid sphere, the centre's part
  const SOLID = 4 / 7; // kappa/chi of a solid sphere

  const short = (values) => Array.from(values, (value) => Math.round(value * 1e5) / 1e5 || 0);
  const most = (values) => values.reduce((a, b) => Math.max(a, b));

  // A path with what lies before and after the contact at constant speed.
  function continued(path, before, after, duration) {
    const steps = path.length - 1;
    const more = Math.round(BEYOND * steps);
    const last = path[steps];
    const ahead = Array.from({ length: more }, (_, i) => path[0] + ((i - more) / steps) * duration * before);
    const behind = Array.from({ length: more }, (_, i) => last + ((i + 1) / steps) * duration * after);
    return [...ahead, ...path, ...behind];
  }

  // The integral of a speed over even times of the contact.
  function summed(speed, duration) {
    const step = duration / (speed.length - 1);
    const path = [0];
    for (let i = 1; i < speed.length; i++) path.push(path[i - 1] + 0.5 * step * (speed[i - 1] + speed[i]));
    return path;
  }

  // The same with what lies before and after.
  function travelled(speed, duration) {
    return continued(summed(speed, duration), speed[0], speed[speed.length - 1], duration);
  }

  function times(steps) {
    const more = Math.round(BEYOND * steps);
    return Array.from({ length: steps + 1 + 2 * more }, (_, i) => (i - more) / steps);
  }

  function magnification(kind, size, closer, along) {
    const depth = most(closer);
    const travel = most(along.map(Math.abs));
    let [deep, wide] = [DEEPEST, 0.5 * WIDEST];
    if (kind === "sphere") [deep, wide] = [DEEPEST * Math.min(1, size), ROLLED * (1 + size)];
    if (kind === "cup") {
      const lifted = most(closer.map((value) => -value)) / depth;
      [deep, wide] = [Math.min(DEEPEST, (0.5 * (size - 1)) / lifted), STEEPEST * (size - 1)];
    }
    return Math.min(deep / depth, travel ? wide / travel : Infinity);
  }

  // Where the first centre is as seen from the second body's, whose surface its path follows.
  function placed(kind, size, along, closer) {
    if (kind === "plane" || kind === "plate") return [along, 1 - closer];
    const reach = kind === "sphere" ? 1 + size - closer : size - 1 + closer;
    const angle = along / (kind === "sphere" ? 1 + size : size - 1);
    return [reach * Math.sin(angle), reach * (kind === "sphere" ? 1 : -1) * Math.cos(angle)];
  }

  function body(kind, radius, points, turn) {
    return { kind, radius, x: short(points.map((p) => p[0])), y: short(points.map((p) => p[1])), turn: short(turn) };
  }

  const digits = (value) => Carom.quantities.plain(value, 3);

  // Bodies from how they move in time: speeds in m/s, spins in rad/s, penetration in m.
  function ofBodies(pair, moving) {
    return pair.against === "sphere" ? ofBalls(pair, moving) : onGround(pair, moving);
  }

  // Two balls: before and after the contact both fly straight; while they touch, the first follows
  // the surface of the second.
  function ofBalls(pair, { along, spins, speed, penetration, duration }) {
    const radius = pair.moving[0].radius;
    const size = pair.otherRadius / radius;
    const inRadii = (values) => values.map((value) => value / radius);
    const way = inRadii(summed(along, duration));
    const closer = inRadii(penetration);
    const large = magnification("sphere", size, closer, way);

    const middle = 0.5 * way[way.length - 1];
    const apart = way.map((value, i) => placed("sphere", size, large * (value - middle), large * closer[i]));
    const [x, y] = [along, speed].map((relative) => ofBoth(pair, inRadii(relative)));
    const moved = [x, y].map(({ second }) => summed(second, duration).map((value) => large * value));
    const second = apart.map((_, i) => [moved[0][i], -size - moved[1][i]]);
    const first = apart.map((from, i) => [second[i][0] + from[0], second[i][1] + from[1]]);

    const free = (points, which) => flown(points, large * duration, [x, y].map((velocity) => velocity[which]));
    const turns = spins.map((spin) => travelled(spin, duration).map((value) => large * value));
    return {
      time: short(times(way.length - 1)),
      caption: captionOf(large, "sphere"),
      bodies: [body("sphere", 1, free(first, "first"), turns[0]), body("sphere", size, free(second, "second"), turns[1])],
    };
  }

  // What both bodies have of a component of their relative velocity.
  function ofBoth(pair, relative) {
    const each = relative.map((now) => Carom.pair.shared(pair, relative[0], now));
    return { first: each.map(([value]) => value), second: each.map(([, value]) => value) };
  }

  // A path with the straight ones before and after it, of velocities to the right and down.
  function flown(points, duration, [right, down]) {
    const last = points.length - 1;
    const of = (which, speed, sign) => continued(points.map((point) => point[which]), sign * speed[0], sign * speed[last], duration);
    const [x, y] = [of(0, right, 1), of(1, down, -1)];
    return x.map((value, i) => [value, y[i]]);
  }

  const captionOf = (large, kind) => `motion magnified ${digits(large)} times${BENT[kind]}`;

  // A ball on a plane, on a plate or in a cup.
  function onGround(pair, { along, spins, speed, penetration, duration }) {
    const radius = pair.moving[0].radius;
    const thick = pair.thickness === Infinity ? "plane" : "plate";
    const kind = pair.against === "half-space" ? thick : pair.against;
    const size = { plane: 1, plate: pair.thickness / radius }[kind] ?? pair.otherRadius / radius;
    const last = speed.length - 1;
    const way = travelled(along, duration).map((value) => value / radius);
    const closer = continued(penetration, speed[0], speed[last], duration).map((value) => value / radius);
    const fallen = kind === "plate" ? travelled(speed, duration).map((value) => value / radius) : closer;
    const large = magnification(kind, size, fallen, way);
    const turns = spins.map((spin) => travelled(spin, duration).map((value) => large * value));
    const height = kind === "cup" ? size : 0;
    const sunk = fallen.map((value, i) => large * (value - closer[i])); // a plate, in its middle
    const places = way.map((value, i) => placed(kind, size, large * value, large * closer[i]));
    const first = places.map(([x, y], i) => [x, y + height - sunk[i]]);
    const second = sunk.map((value) => [0, height - value]);
    return {
      time: short(times(last)),
      caption: captionOf(large, kind),
      bodies: [body("sphere", 1, first, turns[0]), body(kind, size, second, turns[1])],
    };
  }

  // A solid sphere without spin on a plane or a plate, as psi and chi move it.
  function ofNumbers({ psi, chi, friction, gives, velocity, speed, penetration, duration }) {
    const last = speed.length - 1;
    const slope = friction / (SOLID * chi);
    const lost = Array.from(velocity, (value) => psi - value);
    const way = travelled(lost.map((value) => slope * (psi - ROLLS * value)), duration);
    const turn = travelled(lost.map((value) => -slope * (1 - ROLLS) * value), duration);
    const closer = continued(penetration, 1, speed[last], duration);
    const fallen = gives ? travelled(speed, duration) : closer;
    const [kind, size] = gives ? ["plate", SLAB] : ["plane", 1];
    const large = magnification(kind, size, fallen, way);
    const first = way.map((value, i) => [large * value, 1 - large * fallen[i]]);
    const second = fallen.map((value, i) => [0, large * (closer[i] - value)]);
    const bodies = [body("sphere", 1, first, turn.map((value) => large * value)), body(kind, size, second, way.map(() => 0))];
    const caption = `drawn as a solid sphere, friction ${Carom.quantities.plain(friction, 6)}${gives ? ", plate not to scale" : ""}`;
    return { time: short(times(last)), caption, bodies };
  }

  return { ofBodies, ofNumbers, short };
})();
