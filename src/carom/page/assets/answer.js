// What there is to see of an impact: its scene, histories, curve and numbers.

Carom.answer = (() => {
  const { solver } = Carom;
  const POINTS = { elastic: 240, viscous: 60 }; // intervals of the curve, over all regimes
  const BEYOND = 1.15; // of the present psi_1, that is shown
  const OF_CURVES = 1e-7; // of a panel: psi_2 to 1e-6
  const KEPT = 16; // curves that are remembered
  const CARRIED = 6; // digits that go over from bodies to numbers
  const NO_SPIN = 1e-9; // of the spin before: less is rounding
  const ZENER = 1.25 ** 0.4; // Zener's inelasticity parameter of a plate of lambda = 1
  const THINNEST = 2; // lambda; so thin a plate gives way like a foil
  const TOO_LARGE = "with the other numbers it leads to some that a computer cannot hold";
  const FOIL = "so thin a plate gives way like a foil (λ about 2)";
  const curves = new Map();
  const short = (values) => Carom.paths.short(values);
  const precise = (values) => Array.from(values, (value) => Number(value.toPrecision(6)) || 0);
  const fine = (values) => Array.from(values, (value) => Math.round(value * 1e7) / 1e7 || 0);
  const shares = Array.from({ length: solver.TIMES + 1 }, (_, i) => i / solver.TIMES);

  function refuse(field, message) {
    throw { field, message };
  }

  function solved(psi, chi, loss, field) {
    if (loss.give > THINNEST) refuse(field === "psi" ? "inelasticity" : "thickness", FOIL);
    const found = [psi, chi].every(Number.isFinite) ? solver.solve(psi, chi, loss) : null;
    return found ?? refuse(field, TOO_LARGE);
  }

  // psi_1 over all regimes and psi_2, psi_1 >= 0.
  function half(chi, loss, last) {
    const key = [chi, loss.alpha, loss.give].join();
    if (!curves.has(key)) {
      const count = loss.alpha ? POINTS.viscous : POINTS.elastic;
      const psi = Array.from({ length: count + 1 }, (_, i) => (last * i) / count);
      curves.set(key, [psi, solver.rebounds(psi, chi, loss, OF_CURVES)]);
    }
    if (curves.size > KEPT) curves.delete(curves.keys().next().value);
    return curves.get(key);
  }

  // The curve over all regimes and the present point; beyond the regimes it is straight.
  function curve(psi, { out, chi, alpha, give, restitution, strongest }) {
    const regimes = Math.ceil(2 * Math.max(4 * chi, 1.5)) / 2;
    const point = Number.isFinite(psi) ? psi : 0;
    const reach = Math.ceil(BEYOND * Math.abs(point));
    const beyond = Math.abs(point) > regimes / BEYOND && reach > regimes ? [reach] : [];
    const [grid, known] = half(chi, { alpha, give }, regimes);
    const along = [...grid, ...beyond];
    const outs = [...known, ...solver.rebounds(beyond, chi, { alpha, give })];
    const mirrored = (values) => values.slice(1).reverse().map((value) => -value);
    const both = (values) => (point < 0 ? [...mirrored(values), ...values] : values);
    return {
      psi: fine(both(along)),
      out: fine(both(outs)),
      borders: solver.borders(chi, { restitution, give, strongest }),
      at: Number.isFinite(psi) ? [psi, out] : null,
    };
  }

  function scene(impact, { duration, unit, phases, stick, stage }) {
    const highest = impact.limit.reduce((most, value) => Math.max(most, value));
    return {
      ...(impact.give ? { plate: impact.restitution } : {}),
      duration,
      unit,
      phases,
      time: short(shares),
      psi: precise(impact.psi),
      contact: short(impact.contact.map((value) => value / impact.widest)),
      stick: short(stick.map((value) => value / impact.widest)),
      force: precise(impact.force.map((value) => (1.5 * value) / highest)),
      rim: short(impact.speed.map((value) => (impact.alpha * Math.max(value, 0)) / impact.widest ** 2)),
      tractions: impact.tractions.map(short),
      stage,
    };
  }

  function rows(numbers, lossy) {
    const { rows: usual, lossy: more } = Carom.config;
    return Object.entries(lossy ? { ...usual, ...more } : usual)
      .filter(([name]) => name in numbers)
      .map(([name, { symbol, meaning, unit }]) => ({ name, symbol, meaning, ...Carom.quantities.printed(numbers[name], unit) }));
  }

  // Columns as shares of what they add up to.
  function parts(columns) {
    const whole = shares.map((_, i) => Object.values(columns).reduce((total, column) => total + column[i], 0));
    const share = (column) => fine(shares.map((_, i) => (whole[0] > 0 ? column[i] / whole[i] : column[i])));
    return Object.fromEntries(Object.entries(columns).map(([name, column]) => [name, share(column)]));
  }

  function ofNumbers({ psi, chi, friction, restitution, inelasticity }) {
    if (!friction) refuse("friction", "must be above 0: without friction there is no ψ₁");
    const give = inelasticity / ZENER;
    const impact = solved(psi, chi, { alpha: give ? 0 : solver.alphaOf(restitution), give }, "psi");
    const { duration, phases, stick, out } = impact;
    const moving = { velocity: impact.psi, speed: impact.speed, penetration: Array.from(impact.depth), duration };
    const stage = Carom.paths.ofNumbers({ psi, chi, friction, gives: give > 0, ...moving });
    const numbers = { psi_in: psi, psi_out: out, chi, ...(psi ? { contact_restitution: out / psi } : {}) };
    const energies = parts({
      contact_kinetic_energy: impact.psi.map((value) => 0.5 * value * value),
      tangential_elastic_energy: impact.stored,
      frictional_work: impact.dissipated,
      shear_loss: impact.shear,
    });
    return {
      carried: null,
      lossy: give > 0 || restitution !== 1,
      shape: [chi, impact.alpha, give].join(),
      scene: scene(impact, { duration, unit: "d_max/V₁", phases, stick, stage }),
      history: { share: shares, force: fine(impact.force.map((value) => 1.5 * value)), limit: fine(impact.limit), unit: "µ F_max", energies },
      curve: curve(psi, impact),
      results: rows(give ? { ...numbers, normal_restitution: impact.restitution } : numbers, give > 0),
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
    const give = pair.normalMass / (pair.impedance * scales.time);
    return { speed, before, velocity, scales, psi, give, rubs: pair.friction > 0 || velocity === 0 };
  }

  // The bodies in the course of time, in SI units.
  function columns(impact, pair, { speed, before, velocity, scales, rubs, psi }) {
    const impulse = pair.tangentialMass * scales.tangentialSpeed;
    const first = rubs ? psi : 0;
    const now = Array.from(impact.psi, (value) => Carom.pair.after(pair, before, impulse * (first - value)));
    const energy = impulse * scales.tangentialSpeed;
    const of = (column, scale) => Array.from(column, (value) => value * scale);
    return {
      along: now.map(([value]) => value),
      spins: [1, 2].map((i) => now.map((each) => each[i])),
      speed: of(impact.speed, speed),
      penetration: of(impact.depth, scales.length),
      energies: {
        normal_kinetic_energy: Array.from(impact.speed, (value) => Carom.pair.kineticEnergy(pair, speed, speed * value)),
        tangential_kinetic_energy: now.map(([value]) => Carom.pair.kineticEnergy(pair, before[0], value)),
        spin_kinetic_energy: now.map(([, ...spins]) => Carom.pair.spinEnergy(pair, spins)),
        normal_elastic_energy: of(impact.normalStored, scales.energy),
        tangential_elastic_energy: of(impact.stored, energy),
        frictional_work: of(impact.dissipated, energy),
        normal_loss: of(impact.normalLost, scales.energy),
        shear_loss: of(impact.shear, energy),
      },
    };
  }

  function numbersOf(impact, pair, view, { speed, before, velocity, scales, psi, rubs }) {
    const e = impact.restitution;
    const after = rubs ? impact.out * scales.tangentialSpeed : velocity;
    const [along, spin] = Carom.pair.after(pair, before, pair.tangentialMass * (velocity - after));
    const sheared = impact.shear[solver.TIMES] * pair.tangentialMass * scales.tangentialSpeed ** 2;
    return {
      psi_in: psi,
      psi_out: rubs ? impact.out : psi,
      chi: pair.chi,
      kappa: pair.kappa,
      rebound_angle: Math.atan2(along, e * speed),
      rebound_speed: Math.hypot(e * speed, along),
      spin_out: Math.abs(spin) < NO_SPIN * Math.abs(view.spin) ? 0 : spin,
      contact_restitution: velocity === 0 ? NaN : after / velocity,
      tangential_restitution: before[0] === 0 ? NaN : along / before[0],
      dissipated_energy: 0.5 * pair.tangentialMass * (velocity - after) * (velocity + after) - sheared,
      duration: impact.duration * scales.time,
      max_force: impact.strongest * scales.force,
      max_radius: impact.widest * scales.radius,
      normal_restitution: e,
      lost_energy: scales.energy * (1 - e * e),
      ...(impact.give ? {} : { shear_lost_energy: sheared }),
    };
  }

  // What the first level and stories tell: where the bodies go as people see them, by angles from the
  // line of centres to the side of the motion; by how much friction throws the body that is struck
  // off it; the share of the duration in which all slides; what is left of psi_1; and what of the
  // energy is left, what friction has taken of it, and what the normal motion and shear have lost.
  function asSeen({ psi_in: psi, psi_out: out, normal_restitution: e, ...numbers }, { velocity, scales, speed, before, rubs }, pair, { phases, energies }) {
    const whole = Object.values(energies).reduce((total, [first]) => total + first, 0) || 1;
    const change = rubs ? velocity - out * scales.tangentialSpeed : 0;
    const [impulse, pushed] = [pair.tangentialMass * change, pair.normalMass * speed * (1 + e)];
    const [along] = Carom.pair.shared(pair, before[0], before[0] - impulse / pair.normalMass);
    const [onwards] = Carom.pair.shared(pair, speed, -e * speed);
    const last = Object.entries(energies).filter(([name]) => name.endsWith("kinetic_energy"));
    return {
      along,
      onwards,
      throw: Math.atan2(impulse, pushed),
      slides: phases.reduce((sum, { kind, start, end }) => sum + (kind === "gross slip" ? end - start : 0), 0),
      contact_kept: Math.abs(psi - out),
      energy_kept: last.reduce((sum, [, values]) => sum + values[values.length - 1], 0) / whole,
      energy_rubbed: numbers.dissipated_energy / whole,
      energy_lost: (numbers.lost_energy + (numbers.shear_lost_energy ?? 0)) / whole,
    };
  }

  function ofBodies(view, pair) {
    const met = approach(view, pair);
    const alpha = met.give ? 0 : solver.alphaOf(view.restitution);
    const impact = solved(met.rubs ? met.psi : 0, pair.chi, { alpha, give: met.give }, "speed");
    const numbers = numbersOf(impact, pair, view, met);
    const moving = columns(impact, pair, met);
    const [seconds, unit] = Carom.quantities.prefixed(numbers.duration, "s");
    const [newtons, forceUnit] = Carom.quantities.prefixed(pair.friction * numbers.max_force || numbers.max_force, "N");
    const force = pair.friction * met.scales.force * newtons;
    const free = [{ kind: "gross slip", sign: met.psi > 0 ? 1 : -1, start: 0, end: 1 }];
    const shown = {
      duration: numbers.duration * seconds,
      unit,
      phases: met.rubs ? impact.phases : free,
      stick: met.rubs ? impact.stick : impact.stick.map(() => 0),
      stage: Carom.paths.ofBodies(pair, { ...moving, duration: numbers.duration }),
    };
    const digits = (value) => Number(value.toPrecision(CARRIED));
    const energies = parts(moving.energies);
    const lossy = met.give > 0 || view.restitution !== 1;
    return {
      lossy,
      view,
      numbers: { ...numbers, ...asSeen(numbers, met, pair, { ...shown, energies: moving.energies }) },
      shape: [pair.chi, pair.kappa, alpha, met.give].join(),
      carried: met.rubs ? { psi: digits(met.psi), chi: digits(pair.chi), inelasticity: digits(ZENER * met.give) } : null,
      scene: { ...scene(impact, shown), ...(met.rubs ? {} : { psi: null }) },
      history: {
        share: shares,
        force: fine(impact.force.map((value) => 1.5 * force * value)),
        limit: fine(impact.limit.map((value) => force * value)),
        unit: forceUnit,
        energies,
      },
      curve: curve(met.psi, { ...impact, out: numbers.psi_out }),
      results: rows(numbers, lossy),
    };
  }

  // The answer to a view of the page, or a refusal of one of its fields.
  function of(view) {
    return view.given === "numbers" ? ofNumbers(view) : ofBodies(view, Carom.reading.pair(view));
  }

  return { of };
})();
