// What there is to see of an impact that was solved: its scene, histories, curve and numbers.

Carom.answer = (() => {
  const POINTS = 241; // of the curve
  const BEYOND = 1.15; // of the present psi_1, that is shown
  const CARRIED = 6; // digits that go over from bodies to numbers
  const OF_LOSSES = 4; // digits of energies that springs give
  const SMALL_CONTACT = 0.1; // a_max/R* up to which Hertz's theory holds
  const NO_SPIN = 1e-9; // of the spin before: less is rounding
  const short = (values) => Carom.paths.short(values);
  const precise = (values) => Array.from(values, (value) => Number(value.toPrecision(6)) || 0);
  const fine = (values) => Array.from(values, (value) => Math.round(value * 1e7) / 1e7 || 0);
  const most = (values) => values.reduce((a, b) => Math.max(a, b));
  const shares = Array.from({ length: Carom.law.TIMES + 1 }, (_, i) => i / Carom.law.TIMES);

  // The psi_1 over which the curve is drawn: all regimes, and the present point.
  function curve(psi, out, chi, e) {
    const regimes = Math.ceil(2 * Math.max(4 * chi, 1.5)) / 2;
    const point = Number.isFinite(psi) ? psi : 0;
    const reach = Math.abs(point) > regimes / BEYOND ? Math.ceil(BEYOND * Math.abs(point)) : regimes;
    const [low, high] = [point < 0 ? -reach : 0, Math.max(reach, regimes)];
    const [first, last] = [Math.max(low, -regimes), Math.min(high, regimes)];
    const within = Array.from({ length: POINTS }, (_, i) => first + ((last - first) * i) / (POINTS - 1));
    const along = [...new Set([low, ...within, high])]; // beyond the regimes the curve is straight
    return {
      psi: fine(along),
      out: fine(along.map((value) => Carom.rebound.of(value, chi, e))),
      borders: Carom.rebound.borders(chi, e),
      at: Number.isFinite(psi) ? [psi, out] : null,
    };
  }

  function scene(solved, { duration, unit, phases, stick, stage }) {
    const highest = most(solved.limit);
    return {
      duration,
      unit,
      phases,
      time: short(shares),
      psi: precise(solved.psi),
      contact: short(solved.contact.map((value) => value / solved.radius)),
      stick: short(stick.map((value) => value / solved.radius)),
      force: precise(solved.force.map((value) => (1.5 * value) / highest)),
      rim: short(solved.speed.map((value) => (solved.normal.alpha * Math.max(value, 0)) / solved.radius ** 2)),
      tractions: solved.tractions.map(short),
      stage,
    };
  }

  function rows(numbers, lossy) {
    const { rows: usual, lossy: more } = Carom.tables;
    return Object.entries(lossy ? { ...usual, ...more } : usual)
      .filter(([name]) => name in numbers)
      .map(([name, { symbol, meaning, unit }]) => {
        const rough = lossy && ["dissipated_energy", "shear_lost_energy"].includes(name);
        return { name, symbol, meaning, ...Carom.quantities.printed(numbers[name], unit, rough ? OF_LOSSES : undefined) };
      });
  }

  // Columns as shares of what they add up to.
  function parts(columns) {
    const whole = shares.map((_, i) => Object.values(columns).reduce((total, column) => total + column[i], 0));
    const share = (column) => fine(shares.map((_, i) => (whole[0] > 0 ? column[i] / whole[i] : column[i])));
    return Object.fromEntries(Object.entries(columns).map(([name, column]) => [name, share(column)]));
  }

  function ofNumbers({ psi, chi, friction, restitution }) {
    const solved = Carom.law.solve(psi, chi, restitution);
    const { duration, phases, stick, out } = solved;
    const moving = { velocity: solved.psi, speed: solved.speed, penetration: Array.from(solved.depth), duration };
    const stage = Carom.paths.ofNumbers({ psi, chi, friction, ...moving });
    const numbers = { psi_in: psi, psi_out: out, chi, ...(psi ? { contact_restitution: out / psi } : {}) };
    const energies = parts({
      contact_kinetic_energy: solved.psi.map((value) => 0.5 * value * value),
      tangential_elastic_energy: solved.stored,
      frictional_work: solved.dissipated,
      shear_loss: solved.shear,
    });
    return {
      carried: null,
      scene: scene(solved, { duration, unit: "d_max/V₁", phases, stick, stage }),
      history: { share: shares, force: fine(solved.force.map((value) => 1.5 * value)), limit: fine(solved.limit), unit: "µ F_max", energies },
      curve: curve(psi, out, chi, restitution),
      results: rows(numbers),
      findings: [],
    };
  }

  // How the bodies meet, and in which units: V_x, psi_1 and all that goes with it.
  function approach(view, pair) {
    const angle = (view.angle * Math.PI) / 180;
    const [speed, along] = [view.speed * Math.cos(angle), view.speed * Math.sin(angle)];
    const before = [along, view.spin, 0];
    const velocity = Carom.pair.contactVelocity(pair, before.slice(0, 1 + pair.moving.length));
    const scales = Carom.pair.scales(pair, speed);
    const psi = velocity === 0 ? 0 : velocity / scales.tangentialSpeed;
    return { speed, before, velocity, scales, psi, rubs: Number.isFinite(psi) };
  }

  // The bodies in the course of time, in SI units.
  function columns(solved, pair, { speed, before, velocity, scales, rubs, psi }) {
    const impulse = pair.tangentialMass * scales.tangentialSpeed;
    const drift = rubs ? 0 : velocity;
    const first = rubs ? psi : 0;
    const now = Array.from(solved.psi, (value) => Carom.pair.after(pair, before, impulse * (first - value)));
    const energy = impulse * scales.tangentialSpeed;
    const of = (column, scale) => Array.from(column, (value) => value * scale);
    return {
      along: now.map(([value]) => value),
      spins: [1, 2].map((i) => now.map((each) => each[i])),
      speed: of(solved.speed, speed),
      penetration: of(solved.depth, scales.length),
      energies: {
        normal_kinetic_energy: Array.from(solved.speed, (value) => value * value * scales.energy),
        tangential_kinetic_energy: now.map(([value]) => 0.5 * pair.normalMass * value ** 2),
        spin_kinetic_energy: now.map(([, ...spins]) => Carom.pair.spinEnergy(pair, spins)),
        normal_elastic_energy: of(solved.normalStored, scales.energy),
        tangential_elastic_energy: of(solved.stored, energy),
        frictional_work: of(solved.dissipated, energy),
        normal_loss: of(solved.normalLost, scales.energy),
        shear_loss: of(solved.shear, energy),
      },
    };
  }

  function numbersOf(solved, pair, view, { speed, before, velocity, scales, psi, rubs }) {
    const last = Carom.law.TIMES;
    const e = view.restitution;
    const after = rubs ? solved.out * scales.tangentialSpeed : velocity;
    const [along, spin] = Carom.pair.after(pair, before, pair.tangentialMass * (velocity - after));
    const unit = pair.tangentialMass * scales.tangentialSpeed ** 2;
    const sheared = solved.shear[last] * unit;
    return {
      psi_in: psi,
      psi_out: rubs ? solved.out : psi,
      chi: pair.chi,
      kappa: pair.kappa,
      rebound_angle: Math.atan2(along, e * speed),
      rebound_speed: Math.hypot(e * speed, along),
      spin_out: Math.abs(spin) < NO_SPIN * Math.abs(view.spin) ? 0 : spin,
      contact_restitution: velocity === 0 ? NaN : after / velocity,
      tangential_restitution: before[0] === 0 ? NaN : along / before[0],
      dissipated_energy: 0.5 * pair.tangentialMass * (velocity - after) * (velocity + after) - sheared,
      duration: solved.duration * scales.time,
      max_force: Carom.tables.losses[e].max_force * scales.force,
      max_radius: solved.radius * scales.radius,
      normal_restitution: e,
      lost_energy: scales.energy * (1 - e * e),
      shear_lost_energy: sheared,
    };
  }

  function findings(pair, scales) {
    const ratio = scales.radius / pair.radius;
    const small = ratio <= SMALL_CONTACT;
    const verdict = small ? "the contact is small compared with the bodies" : `the contact is too large for Hertz's theory, which needs ${SMALL_CONTACT} at most`;
    const text = `a_max/R* = ${Carom.quantities.plain(ratio, 3)}: ${verdict}`;
    const rest = "whether a body yields, sticks or loses energy, waves matter or unlike materials couple: the installed program judges that";
    return [{ mark: small ? "ok" : "FAILS", text }, { mark: "?", text: rest }];
  }

  function ofBodies(view, pair) {
    const met = approach(view, pair);
    const solved = Carom.law.solve(met.rubs ? met.psi : 0, pair.chi, view.restitution);
    const numbers = numbersOf(solved, pair, view, met);
    const moving = columns(solved, pair, met);
    const [seconds, unit] = Carom.quantities.prefixed(numbers.duration, "s");
    const [newtons, forceUnit] = Carom.quantities.prefixed(pair.friction * numbers.max_force || numbers.max_force, "N");
    const force = pair.friction * met.scales.force * newtons;
    const free = [{ kind: "gross slip", sign: met.psi > 0 ? 1 : -1, start: 0, end: 1 }];
    const shown = {
      duration: numbers.duration * seconds,
      unit,
      phases: met.rubs ? solved.phases : free,
      stick: met.rubs ? solved.stick : solved.stick.map(() => 0),
      stage: Carom.paths.ofBodies(pair, { ...moving, duration: numbers.duration }),
    };
    const digits = (value) => Number(value.toPrecision(CARRIED));
    return {
      carried: met.rubs ? { psi: digits(met.psi), chi: digits(pair.chi), inelasticity: 0 } : null,
      scene: scene(solved, shown),
      history: {
        share: shares,
        force: fine(solved.force.map((value) => 1.5 * force * value)),
        limit: fine(solved.limit.map((value) => force * value)),
        unit: forceUnit,
        energies: parts(moving.energies),
      },
      curve: curve(met.psi, numbers.psi_out, pair.chi, view.restitution),
      results: rows(numbers, view.restitution !== 1),
      findings: findings(pair, met.scales),
    };
  }

  return { ofNumbers, ofBodies };
})();
