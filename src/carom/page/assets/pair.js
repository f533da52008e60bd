// Two bodies: their effective constants, the scales of their impact, and how they move.

Carom.pair = (() => {
  const SOLID = 0.4; // K^2/R^2 of a solid sphere

  const shear = ({ young, poisson }) => young / (2 * (1 + poisson));
  const mass = (radius, { density }) => (4 / 3) * Math.PI * radius ** 3 * density;

  function body(radius, material) {
    const m = mass(radius, material);
    return { radius, mass: m, inertia: m * SOLID * radius ** 2 };
  }

  // The pair of bodies: radii in m, materials in SI units, rigid ones with an infinite modulus.
  function of({ radius, material, against, otherRadius, otherMaterial, thickness, friction }) {
    const materials = [material, otherMaterial];
    const moving = [body(radius, material)];
    if (against === "sphere") moving.push(body(otherRadius, otherMaterial));
    const curvature = { "half-space": 0, sphere: 1 / otherRadius, cup: -1 / otherRadius }[against];
    const modulus = 1 / sum(materials, (m) => (1 - m.poisson ** 2) / m.young);
    const shearModulus = 1 / sum(materials, (m) => (2 - m.poisson) / (4 * shear(m)));
    const normalMass = 1 / sum(moving, (each) => 1 / each.mass);
    const tangentialMass = 1 / sum(moving, (each) => (1 + 1 / SOLID) / each.mass);
    const kappa = shearModulus / modulus;
    return {
      moving, against, friction, modulus, shearModulus, normalMass, tangentialMass, kappa,
      radius: 1 / (1 / radius + curvature),
      chi: (0.5 * kappa * normalMass) / tangentialMass,
      otherRadius, thickness,
      impedance: impedance(otherMaterial, thickness),
    };
  }

  // Force over speed of the middle of a plate, 8 sqrt(D rho h); infinite of a thick wall.
  function impedance({ young, poisson, density }, thickness) {
    if (thickness === Infinity) return Infinity;
    const stiffness = (young * thickness ** 3) / (12 * (1 - poisson ** 2));
    return 8 * Math.sqrt(stiffness * density * thickness);
  }

  const sum = (items, of) => items.reduce((total, item) => total + of(item), 0);

  // The scales of the elastic impact at a normal speed, in SI units.
  function scales(pair, speed) {
    const stiffness = pair.modulus * Math.sqrt(pair.radius);
    const length = ((15 * pair.normalMass * speed ** 2) / (16 * stiffness)) ** 0.4;
    return {
      length,
      radius: Math.sqrt(pair.radius * length),
      force: (4 / 3) * stiffness * length ** 1.5,
      time: length / speed,
      energy: 0.5 * pair.normalMass * speed ** 2,
      tangentialSpeed: (pair.friction * speed) / pair.kappa,
    };
  }

  // The tangential velocity of the contact point, of speed and spins.
  function contactVelocity(pair, [along, ...spins]) {
    return along + sum(pair.moving, (each) => each.radius * spins[pair.moving.indexOf(each)]);
  }

  // The motion after an impulse on the first body, against +x.
  function after(pair, [along, ...spins], impulse) {
    const turned = spins.map((spin, i) => {
      const each = pair.moving[i];
      return each ? spin - (impulse * each.radius) / each.inertia : spin;
    });
    return [along - impulse / pair.normalMass, ...turned];
  }

  // The velocities of both bodies, of one component of their relative velocity before and now:
  // the second was at rest, and a wall stays so.
  function shared(pair, before, now) {
    const other = pair.moving[1] ? (pair.normalMass / pair.moving[1].mass) * (before - now) : 0;
    return [now + other, other];
  }

  function kineticEnergy(pair, before, now) {
    const velocities = shared(pair, before, now);
    return sum(pair.moving, (each) => 0.5 * each.mass * velocities[pair.moving.indexOf(each)] ** 2);
  }

  function spinEnergy(pair, spins) {
    return pair.moving.reduce((total, each, i) => total + 0.5 * each.inertia * spins[i] ** 2, 0);
  }

  return { of, scales, contactVelocity, after, shared, kineticEnergy, spinEnergy };
})();
