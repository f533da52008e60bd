// One sentence for every instant of an impact: what happens in the contact, and why.

Carom.sentence = (() => {
  const PEAK = 0.012; // the share around the largest compression that belongs to it
  const TURN = 0.012; // likewise around an instant at which something changes its direction
  const ENDS = 0.01; // shares at both ends, in which the force has no clear sign
  const SPENT = 0.005; // of the velocity before: what is less counts as none

  const sign = (value) => Math.sign(value) || 0;
  const capital = (text) => text[0].toUpperCase() + text.slice(1);

  // In which direction the ball arrives: that of its centre, seen from the other body.
  function arrival(scene) {
    const [ball, other] = scene.data.stage.bodies;
    const travelled = ball.x[1] - ball.x[0] - (other.x[1] - other.x[0]);
    return sign(travelled) || first(scene) || 1;
  }

  // The sign of the velocity of the contact point at the first touch, 0 if it has none.
  function first(scene) {
    const { phases } = scene.data;
    const psi = scene.psiAt(0);
    return psi === null ? sign(scene.forceAt(ENDS)) || phases[0].sign : sign(psi);
  }

  // Whether a series of an impact passes through zero about now.
  function turns(valueAt, share) {
    const [from, to] = [Math.max(0, share - TURN), Math.min(1, share + TURN)];
    if (from < 2 * ENDS || to > 1 - 2 * ENDS) return false;
    return valueAt(from) * valueAt(to) < 0;
  }

  // What the sentences are made of.
  function momentOf(scene, share) {
    const { data, facts } = scene;
    const row = data.phases.indexOf(scene.phaseAt(share));
    const phase = data.phases[row];
    const inside = Math.min(1 - ENDS, Math.max(ENDS, share));
    const force = phase.kind === "gross slip" ? phase.sign : sign(scene.forceAt(inside));
    const moves = scene.psiAt(inside) !== null;
    return {
      ...phase,
      force,
      rubs: facts.rubs,
      viscous: facts.viscous,
      still: row > 0 && data.phases[row - 1].kind !== "gross slip",
      along: first(scene),
      balls: isBalls(scene),
      psi: moves ? sign(scene.psiAt(inside)) : null,
      stops: moves && turns(scene.psiAt, share),
      reverses: phase.kind !== "gross slip" && facts.rubs && turns(scene.forceAt, share),
      before: share < facts.peak,
      peak: Math.abs(share - facts.peak) <= PEAK,
      way: (toward) => (toward * arrival(scene) < 0 ? "backwards" : "forwards"),
      when: whenOf(share, facts.peak, isBalls(scene)),
    };
  }

  // Whether it is two balls that meet: both move.
  const isBalls = ({ data }) => data.stage.bodies[1].kind === "sphere";

  function whenOf(share, peak, balls) {
    if (Math.abs(share - peak) <= PEAK) return "at the largest compression";
    if (balls) return share < peak ? "as the balls are pressed together" : "as the balls push each other away";
    return share < peak ? "as the ball is pressed in" : "as the ball is pushed away";
  }

  // Where nothing acts along the surface.
  function withoutFriction({ kind, when, before, balls }) {
    const alone = before ? "slows the ball down" : "drives the ball away";
    const normal = balls ? "drives the struck ball away" : alone;
    if (kind === "stick") {
      return `${when}, the contact point has no tangential velocity and sticks: only the normal force acts and ${normal}`;
    }
    return `${when}, the surfaces slide freely: without friction only the normal force acts and ${normal}`;
  }

  function sticking(now) {
    const zone = `${now.when}, the whole contact sticks`;
    if (now.reverses) {
      return `${zone} and friction reverses: the tangential spring, which drove the contact point ${now.way(-now.along)}, brakes it from now on`;
    }
    if (now.psi === null) return `${zone}: friction is strong enough to hold it`;
    if (now.stops) {
      return `${zone} and the contact point comes to rest for an instant: the tangential spring is stretched most and begins to push it ${now.way(-now.force)}`;
    }
    if (now.force * now.psi > 0) {
      const how = now.force === now.along ? "still moves" : "now moves";
      const moves = `the contact point ${how} ${now.way(now.psi)}`;
      if (now.viscous) return `${zone}: ${moves}, and the deformed bodies brake it`;
      return `${zone}: ${moves} and stretches the tangential spring, which brakes it`;
    }
    return `${zone}: ${springs(now)}`;
  }

  function slipping(now) {
    const centre = now.still ? "the centre still sticks" : "the centre sticks";
    const zone = `${now.when}, the rim slips ${now.way(now.sign)} while ${centre}`;
    if (now.reverses) {
      return `${zone}: the tractions of both cancel at this instant, and friction reverses`;
    }
    if (now.psi === null) return `${zone}: at the rim the pressure is too low to hold it`;
    if (now.stops) {
      return `${zone}: the contact point comes to rest for an instant, and the tangential spring begins to push it ${now.way(-now.force)}`;
    }
    if (now.force * now.psi < 0) return `${zone}: ${springs(now)}`;
    if (now.force !== now.along) {
      return `${zone}: friction has reversed and brakes the contact point, which moves ${now.way(now.psi)}`;
    }
    return `${zone}: the contact point still moves ${now.way(now.psi)}, and at the rim the pressure is too low to hold it`;
  }

  // The tangential spring does work on the ball.
  function springs({ psi, along, way }) {
    if (psi === -along) return "the ball springs back tangentially";
    return `the tangential spring drives the contact point ${way(psi)} again`;
  }

  function sliding(now) {
    const zone = `${now.when}, the whole contact slips ${now.way(now.sign)}`;
    if (now.psi !== null && now.psi === -now.sign) {
      return `${zone} although the contact point moves ${now.way(now.psi)}: the falling pressure lets the tangential spring relax faster than the ball moves, and the spring still drives the ball`;
    }
    if (now.sign !== now.along) {
      return `${zone}: friction has reversed and brakes the contact point as far as the falling pressure allows`;
    }
    if (now.peak) return `${zone}: friction at its limit brakes the contact point${now.viscous ? "" : ", most strongly now"}`;
    if (now.before) {
      return `${zone}: the contact point moves too fast to stick, and friction at its limit brakes it`;
    }
    return `${zone}: friction at its limit brakes the contact point, less and less as the pressure falls`;
  }

  function approaching(scene) {
    const [along, arrives] = [first(scene), arrival(scene)];
    if (!along) return "the ball approaches: its contact point has no tangential velocity, so friction will find nothing to brake";
    if (!scene.facts.rubs) return "the ball approaches: its contact point moves, and without friction nothing will brake it";
    if (along !== arrives) return "the ball approaches: it spins so fast that its contact point moves backwards";
    return "the ball approaches: no force acts yet, and its contact point moves forwards";
  }

  function leaving(scene) {
    const takes = scene.facts.viscous || scene.data.plate < 1;
    const lost = takes ? `, and part of the energy is ${Carom.losses.sink(scene.data)}` : "";
    const left = `${isBalls(scene) ? "the balls have parted" : "the ball has left"}${lost}`;
    if (!scene.facts.rubs) {
      return `${left}: no friction acted, so its tangential velocity and its spin are what they were`;
    }
    const [before, after] = [scene.psiAt(0), scene.psiAt(1)];
    if (before === null) return `${left}: no force acts any more`;
    const part = after / before;
    const rest = isBalls(scene) ? "their contact points to move alike" : "its contact point to rest";
    if (Math.abs(part) < SPENT) return `${left}: friction has brought ${rest}`;
    const way = sign(after) === arrival(scene) ? "forwards" : "backwards";
    const share = Math.round(100 * Math.abs(part));
    const how = part > 0 ? "still moves" : "now moves";
    const point = isBalls(scene) ? "the contact point of the first, as seen from the other," : "its contact point";
    return `${left}: ${point} ${how} ${way}, at ${share}\u00a0% of its speed before the impact`;
  }

  function contact(now) {
    if (!now.rubs) return withoutFriction(now);
    if (now.kind === "stick") return sticking(now);
    return now.kind === "slip" ? slipping(now) : sliding(now);
  }

  function of(scene, share) {
    if (!scene) return "";
    const inside = share >= 0 && share <= 1;
    const text = inside ? contact(momentOf(scene, share)) : share < 0 ? approaching(scene) : leaving(scene);
    return `${capital(text)}.`;
  }

  return { of };
})();
