// An impact in time, and what it is at an instant.

Carom.scene = (() => {
  const ROUNDING = 1e-9;
  const HIGHEST = 9; // pressure that is drawn: at the edge it is infinite while viscous bodies load
  const SIGNS = { 1: " +", 0: "", "-1": " −" };
  const WORDS = { stick: "sticks", slip: "rim slips", "gross slip": "slides" };
  const nameOf = ({ kind, sign }) => (Carom.level.isFull() ? kind + SIGNS[sign] : WORDS[kind]);

  // The value of a series, evenly spaced between two ends, between its points.
  function between(series, first, last, at) {
    const place = ((at - first) / (last - first)) * (series.length - 1);
    const low = Math.max(0, Math.min(series.length - 2, Math.floor(place)));
    const part = Math.max(0, Math.min(1, place - low));
    return series[low] * (1 - part) + series[low + 1] * part;
  }

  // The pressure at a radius: Hertz's, and what loading adds towards the edge of viscous bodies.
  function pressureAt(radius, contact, rim) {
    const root = Math.sqrt(Math.max(0, contact ** 2 - radius ** 2));
    return Math.min(root + (rim > 0 ? (0.5 * rim) / root : 0), HIGHEST);
  }

  // What holds at all times.
  function factsOf(data) {
    const highest = data.contact.reduce((best, value, i) => (value > data.contact[best] ? i : best), 0);
    return {
      rubs: data.force.some(Boolean), // whether friction ever acts
      viscous: data.rim.some((value) => value > 0),
      peak: highest / (data.contact.length - 1), // largest compression
      strongest: data.force.reduce((most, value) => Math.max(most, Math.abs(value)), 0),
    };
  }

  // The scene of what the source sent, null if it sent none.
  function of(data) {
    if (!data || !data.phases || !data.phases.length) return null;
    const facts = factsOf(data);
    let latest = null; // both canvases ask for the same instant

    function phaseAt(share) {
      if (share < 0 || share > 1) return null;
      const current = data.phases.find((phase) => share < phase.end);
      return current || data.phases[data.phases.length - 1];
    }

    // The stick zone within its phase: it may appear at once where the contact stops sliding.
    function stickAt(share, phase, contact) {
      if (phase.kind === "stick") return contact;
      if (phase.kind === "gross slip") return 0;
      const step = 1 / (data.stick.length - 1);
      const low = Math.floor(share / step);
      const inside = [low, low + 1].filter((row) => {
        const at = row * step;
        return at >= phase.start - ROUNDING && at <= phase.end + ROUNDING && row < data.stick.length;
      });
      const rows = inside.length ? inside : [low];
      const inPhase = rows.length === 2 ? between(data.stick, 0, 1, share) : data.stick[rows[0]];
      return Math.min(inPhase, contact);
    }

    // Traction from the centre to the edge; where it slips it is friction times the pressure.
    function tractionAt(share, contact, rim, stick, sign) {
      const rows = data.tractions;
      const place = share * (rows.length - 1);
      const low = Math.min(rows.length - 2, Math.floor(place));
      const part = place - low;
      const count = rows[0].length;
      return Array.from({ length: count }, (_, i) => {
        const radius = (contact * i) / (count - 1);
        if (facts.rubs && sign && radius >= stick) return sign * pressureAt(radius, contact, rim);
        return (rows[low][i] || 0) * (1 - part) + (rows[low + 1][i] || 0) * part;
      });
    }

    function momentAt(share) {
      const phase = phaseAt(share);
      if (!phase) return { share, apart: true, phase: share < 0 ? "before" : "after" };
      const contact = between(data.contact, 0, 1, share);
      const stick = stickAt(share, phase, contact);
      const rim = between(data.rim, 0, 1, share);
      return {
        share,
        apart: false,
        kind: phase.kind,
        sign: phase.sign,
        phase: nameOf(phase),
        contact,
        stick,
        rim,
        traction: tractionAt(share, contact, rim, stick, phase.sign),
        force: forceAt(share),
      };
    }

    function at(share) {
      const level = Carom.level.isFull();
      if (!latest || latest.share !== share || latest.level !== level) latest = { ...momentAt(share), level };
      return latest;
    }

    // Over friction times the largest normal force.
    const forceAt = (share) => between(data.force, 0, 1, share);

    // The velocity of the contact point, null where it is not known.
    function psiAt(share) {
      const isKnown = data.psi && data.psi.length > 1 && data.psi.every(Number.isFinite);
      return isKnown ? between(data.psi, 0, 1, Math.max(0, Math.min(1, share))) : null;
    }

    // The bodies at an instant, in radii of the first.
    function bodiesAt(share) {
      const { time, bodies } = data.stage;
      const ends = [time[0], time[time.length - 1]];
      return bodies.map(({ kind, radius, x, y, turn }) => {
        const place = (series) => between(series, ...ends, share);
        return { kind, radius, x: place(x), y: place(y), turn: place(turn) };
      });
    }

    function clockAt(share) {
      const digits = Math.max(0, 2 - Math.floor(Math.log10(data.duration || 1)));
      const value = (share * data.duration).toFixed(Math.min(digits, 12)).replace("-", "−");
      return `${value} ${data.unit} · ${at(share).phase}`;
    }

    return { data, facts, at, phaseAt, forceAt, psiAt, bodiesAt, clockAt, pressureAt };
  }

  return { of, nameOf, between };
})();
