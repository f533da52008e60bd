// The normal motion of an impact in units of d_max, V_1 and F_max, on the steps in which the contact
// is followed: elastic bodies, or viscous ones with the loss time alpha.

Carom.normal = (() => {
  const EVEN = 600; // even intervals of the whole: a multiple of those of histories and of tractions
  const AT_ENDS = 12; // steps in the first and the last, where the edge moves like a root
  const CLOCK = 0.002; // step of the clock d(tau) = dt/(2 b), by which nothing is singular
  const ITERATIONS = 6;
  const kept = new Map(); // it depends on alpha and on how fine the steps are alone

  // b, v and t by the clock: loading has its edge where the surfaces meet, unloading where springs let go.
  function rates(loading, alpha, b, v) {
    const force = loading ? b * b * (b * b + 1.5 * alpha * v) : b ** 4;
    return [loading ? v : v - 1.25 * alpha * b ** 3, -2.5 * force, 2 * b];
  }

  function stepped(state, h, alpha) {
    const { loading, b, v, t } = state;
    const one = rates(loading, alpha, b, v);
    const two = rates(loading, alpha, b + 0.5 * h * one[0], v + 0.5 * h * one[1]);
    const three = rates(loading, alpha, b + 0.5 * h * two[0], v + 0.5 * h * two[1]);
    const four = rates(loading, alpha, b + h * three[0], v + h * three[1]);
    const [db, dv, dt] = one.map((first, i) => (h * (first + 2 * two[i] + 2 * three[i] + four[i])) / 6);
    return { loading, b: b + db, v: v + dv, t: t + dt };
  }

  // The state where `missing`, which falls at `pace` by the clock, comes to zero.
  function cut(state, alpha, missing, pace) {
    let h = 0;
    let at = state;
    for (let i = 0; i < ITERATIONS; i++) {
      h -= missing(at) / pace(at);
      at = stepped(state, h, alpha);
    }
    return at;
  }

  // The turning point and the end of the contact.
  function ends(alpha) {
    let state = { loading: true, b: 0, v: 1, t: 0 };
    while (stepped(state, CLOCK, alpha).v > 0) state = stepped(state, CLOCK, alpha);
    const turning = cut(state, alpha, (at) => at.v, (at) => rates(true, alpha, at.b, at.v)[1]);
    state = { ...turning, loading: false, v: 0 };
    while (stepped(state, CLOCK, alpha).b > 0) state = stepped(state, CLOCK, alpha);
    const end = cut(state, alpha, (at) => at.b, (at) => rates(false, alpha, at.b, at.v)[0]);
    return { turning: { ...turning, loading: false, v: 0 }, end: { ...end, b: 0 } };
  }

  // Times of all steps, and which of them are even.
  function instants(duration, turning, finer) {
    const times = [];
    for (let i = 0; i < EVEN; i++) {
      const steps = i === 0 || i === EVEN - 1 ? AT_ENDS : finer;
      for (let j = 0; j < steps; j++) {
        let part = j / steps;
        if (i === 0) part *= part;
        else if (i === EVEN - 1) part *= 2 - part;
        times.push({ time: (duration * (i + part)) / EVEN, even: j === 0 });
      }
    }
    times.push({ time: duration, even: true });
    if (times.every(({ time }) => Math.abs(time - turning) > 1e-9)) {
      times.push({ time: turning, even: false });
      times.sort((one, other) => one.time - other.time);
    }
    return times;
  }

  function reached(state, time, alpha) {
    const left = time - state.t;
    const root = Math.sqrt(Math.max(0, state.b ** 2 + state.v * left));
    let h = left / Math.max(state.b + root, 1e-12); // the edge moves at the pace v
    let next = stepped(state, h, alpha);
    for (let i = 0; i < ITERATIONS; i++) {
      h -= (next.t - time) / Math.max(2 * next.b, 1e-12);
      next = stepped(state, h, alpha);
    }
    return { ...next, t: time };
  }

  function laid(alpha, finer) {
    const { turning, end } = ends(alpha);
    const places = instants(end.t, turning.t, finer);
    const motion = { alpha, duration: end.t, radius: turning.b, restitution: -end.v, turning: turning.t };
    const names = ["time", "speed", "edge", "penetration", "depth", "force", "stored"];
    names.forEach((name) => (motion[name] = new Float64Array(places.length)));
    motion.even = places.flatMap((place, i) => (place.even ? [i] : []));
    let state = { loading: true, b: 0, v: 1, t: 0 };
    places.forEach(({ time }, i) => {
      if (Math.abs(time - turning.t) <= 1e-9) state = turning;
      else if (i === places.length - 1) state = end;
      else if (i) state = reached(state, time, alpha);
      write(motion, i, time, state);
    });
    return motion;
  }

  function write(motion, i, time, { loading, b, v }) {
    const d = loading ? b * b : b * b - motion.alpha * v;
    motion.time[i] = time;
    motion.speed[i] = v;
    motion.edge[i] = b * b; // s = r^2 of the edge
    motion.penetration[i] = d;
    motion.depth[i] = loading ? d + motion.alpha * v : b * b; // D: springs bear D - s
    motion.force[i] = loading ? b ** 3 + 1.5 * motion.alpha * v * b : b ** 3;
    motion.stored[i] = b * (1.875 * d * d - b * b * (1.25 * d - 0.375 * b * b));
  }

  // The motion in steps of which so many lie in an even interval.
  function of(alpha, finer) {
    const key = `${alpha} ${finer}`;
    if (!kept.has(key)) kept.set(key, laid(alpha, finer));
    return kept.get(key);
  }

  return { of };
})();
