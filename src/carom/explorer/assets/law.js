// An impact in plain numbers: springs that remember their slip follow it in small steps, and the
// table says how it ends. Units are those of the elastic impact: d_max, V_1, d_max/V_1.

Carom.law = (() => {
  const TIMES = 200; // intervals of histories
  const INSTANTS = { elastic: 60, viscous: 30 }; // intervals at which tractions are told
  const RADII = 33;
  const STEPS = 2; // in an even interval of the normal motion
  const THIN = { below: 0.05, steps: 6 }; // psi_1 whose slip rings in viscous bodies are thinner than usual steps
  const HIGHEST = 9; // of a traction: at the edge it is infinite while viscous bodies load
  const RETRACES = 1e-9; // of chi = 1/2: load and unload are the same path, and nothing slips

  function rows(count) {
    const ofContact = ["psi", "force", "stick", "contact", "stored", "dissipated", "shear"];
    const ofNormal = ["speed", "limit", "depth", "normalStored", "normalLost"];
    return Object.fromEntries([...ofContact, ...ofNormal].map((name) => [name, new Float64Array(count)]));
  }

  // Follow an impact; psi_1 > 0.
  function followed(psi, chi, normal) {
    const { alpha, time, speed, edge, penetration, depth } = normal;
    const viscous = alpha > 0;
    const every = normal.even.length - 1;
    const kept = new Map(normal.even.map((step, i) => [step, i]));
    const [perTime, perTraction] = [every / TIMES, every / (viscous ? INSTANTS.viscous : INSTANTS.elastic)];
    const course = { ...rows(TIMES + 1), tractions: [], states: [] };
    const springs = Carom.springs.create(viscous);
    let [now, force, lost, rubbed] = [psi, 0, 0, 0];

    const tension = (value) => (viscous ? alpha * value : 0);
    const line = Array.from({ length: RADII }, (_, i) => i / (RADII - 1));
    function keep(i, state) {
      const row = kept.get(i);
      if (row === undefined) return;
      if (row % perTime === 0) write(course, row / perTime, i, state);
      if (row % perTraction) return;
      const touches = i > 0 && i < time.length - 1;
      const loads = springs.loads(depth[i], tension(now));
      const traction = (part) => Carom.springs.traction(loads, part * Math.sqrt(edge[i]), edge[i]);
      course.tractions.push(line.map((part) => (touches ? traction(part) : 0)));
    }

    function write(into, row, i, { kind, front }) {
      const contact = Math.sqrt(edge[i]);
      into.psi[row] = now;
      into.force[row] = force;
      into.contact[row] = contact;
      into.stick[row] = kind === "stick" ? contact : Math.min(contact, Math.sqrt(front));
      into.stored[row] = 1.875 * chi * springs.squared();
      into.dissipated[row] = 3.75 * chi * lost;
      into.speed[row] = speed[i];
      into.limit[row] = normal.force[i];
      into.depth[row] = penetration[i];
      into.normalStored[row] = normal.stored[i];
      into.normalLost[row] = viscous ? Math.max(0, 1 - speed[i] ** 2 - normal.stored[i]) : 0;
    }

    let state = slidesAtFirst(psi, chi) ? { kind: "gross slip", sign: 1, front: 0, first: 0 } : { kind: "stick", sign: 0, front: Infinity, first: 0 };
    course.states.push({ ...state, excess: psi - 1 });
    keep(0, state);
    for (let i = 1; i < time.length; i++) {
      const dt = time[i] - time[i - 1];
      const shift = now * dt - 1.875 * chi * force * dt * dt;
      const left = viscous ? Math.exp(-dt / alpha) : 0;
      springs.move(shift, penetration[i - 1], penetration[i], edge[i], left);
      const ahead = now - 3.75 * chi * force * dt;
      const pulled = springs.pull(depth[i], tension(ahead));
      now -= 1.875 * chi * (force + pulled) * dt;
      force = pulled;
      if (viscous) {
        const rubs = springs.rubbing(depth[i], tension(now)) / alpha;
        lost += 0.5 * dt * (rubbed + rubs);
        rubbed = rubs;
      }
      state = springs.state(depth[i], tension(now), speed[i] > 0);
      course.states.push({ ...state, excess: Math.abs(now) - speed[i] });
      keep(i, state);
    }
    course.reached = now;
    return course;
  }

  const slidesAtFirst = (psi, chi) => psi > 1 || (psi === 1 && chi < 0.5);

  // When the contact changes what it does, between two steps.
  function phases(states, time) {
    const spans = [];
    states.forEach(({ kind, sign }, i) => {
      const last = spans[spans.length - 1];
      if (last && last.kind === kind && last.sign === sign) return;
      const start = i ? time[i - 1] + part(states[i - 1], states[i]) * (time[i] - time[i - 1]) : 0;
      if (last) last.end = start;
      spans.push({ kind, sign, start, end: time[time.length - 1] });
    });
    return spans;
  }

  function part(before, after) {
    const centre = after.kind === "gross slip" || (before.kind === "gross slip" && after.kind === "slip" && after.sign === before.sign);
    const [from, till] = centre ? [before.first, after.first] : [before.excess, after.excess];
    return from * till < 0 ? from / (from - till) : 0.5;
  }

  // The whole impact: histories at even times as arrays, tractions, phases as shares of the duration.
  function solve(psi, chi, restitution) {
    const { alpha } = Carom.tables.losses[restitution];
    const size = Math.abs(psi);
    const normal = Carom.normal.of(alpha, alpha > 0 && size < THIN.below ? THIN.steps : STEPS);
    const { smallest } = Carom.tables.rebounds[restitution]; // |psi_1| below which all is proportional to it
    const solvedFor = Math.max(size, smallest);
    const course = followed(solvedFor, chi, normal);
    const scale = (psi < 0 ? -1 : 1) * Math.min(1, size / smallest);
    const sticks = size === 0 || (Math.abs(chi - 0.5) < RETRACES && size <= 1);
    const spans = sticks ? [{ kind: "stick", sign: 0, start: 0, end: normal.duration }] : phases(course.states, normal.time);
    const out = Carom.rebound.of(psi, chi, restitution);
    settle(course, solvedFor, chi, normal, Math.abs(out) <= size ? out : null, scale);
    if (sticks) course.stick.set(course.contact);
    return {
      psi, chi, restitution, out,
      normal,
      duration: normal.duration,
      radius: normal.radius,
      phases: spans.map((phase) => ({
        kind: phase.kind,
        sign: phase.sign * (psi < 0 ? -1 : 1),
        start: phase.start / normal.duration,
        end: phase.end / normal.duration,
      })),
      ...course,
    };
  }

  // Scale an impact to its psi_1, and let it end where the table says.
  function settle(course, psi, chi, normal, out, scale) {
    const off = out === null || !scale ? 0 : out / scale - course.reached;
    const energy = scale * scale;
    for (let row = 0; row <= TIMES; row++) {
      const now = course.psi[row] + (off * row) / TIMES;
      const spent = Math.max(0, 0.5 * (psi - now) * (psi + now) - course.stored[row]);
      const rubbed = normal.alpha > 0 ? Math.min(course.dissipated[row], spent) : spent;
      course.psi[row] = scale * now;
      course.force[row] *= scale;
      course.stored[row] *= energy;
      course.dissipated[row] = energy * rubbed;
      course.shear[row] = energy * (spent - rubbed);
    }
    course.tractions.forEach((line) => line.forEach((value, i) => (line[i] = Math.max(-HIGHEST, Math.min(HIGHEST, (scale * value) / normal.radius)))));
  }

  return { solve, TIMES };
})();
