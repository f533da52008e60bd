// The time of the film, as a share of the contact's duration: 0 first touch, 1 separation.

Carom.clock = (() => {
  const FIRST = -0.6;
  const LAST = 1.6;
  const STEP = 0.002;
  const START = 0.5; // maximum compression
  const PACE = 5; // seconds that the whole takes, until chosen
  const REST = 0.7; // seconds at the end before it starts anew
  const LONGEST = 0.1; // seconds that one frame may take: no leap after a pause of the browser
  const SLOWEST = 1 / 6; // of the usual rate, at a change of phase
  const AROUND = 0.05; // the share before and after a change in which the film is slower
  const SUBSTEP = 0.004; // seconds in which the rate hardly changes
  const SAME = 1e-6; // shares that are one instant, as finely as links hold them

  let time = START;
  let playing = false;
  let last = 0; // of the frame before, in ms
  let rested = 0; // seconds at the end so far
  let changes = []; // of phase, in order
  let slower = false;
  const heard = [];

  const limited = (value) => Math.min(LAST, Math.max(FIRST, value));
  const tell = () => heard.forEach((hear) => hear(time, playing));

  function pace() {
    const select = document.getElementById("pace");
    return Math.max(0.1, Number(select && select.value) || PACE);
  }

  // How fast the film runs at an instant, 1 far from any change of phase; smooth.
  function rateAt(share) {
    if (!slower) return 1;
    const nearest = changes.reduce((least, at) => Math.min(least, Math.abs(share - at)), AROUND);
    const near = Math.cos((0.5 * Math.PI * nearest) / AROUND) ** 2;
    return 1 - (1 - SLOWEST) * near;
  }

  // The instant that is reached after some seconds.
  function after(share, seconds) {
    const usual = (LAST - FIRST) / pace();
    const steps = slower ? Math.max(1, Math.ceil(seconds / SUBSTEP)) : 1;
    let reached = share;
    for (let i = 0; i < steps; i++) reached += (rateAt(reached) * usual * seconds) / steps;
    return limited(reached);
  }

  function frame(now) {
    if (!playing) return;
    const passed = Math.max(0, Math.min((now - last) / 1000, LONGEST));
    last = now;
    if (time < LAST) {
      time = after(time, passed);
      rested = 0;
      tell();
    } else {
      rested += passed;
      if (rested > REST) time = FIRST;
    }
    requestAnimationFrame(frame);
  }

  function play() {
    if (playing) return;
    if (time >= LAST) time = FIRST;
    playing = true;
    rested = 0;
    last = performance.now();
    tell();
    requestAnimationFrame(frame);
  }

  function pause() {
    if (!playing) return;
    playing = false;
    tell();
  }

  function set(value) {
    const next = limited(Number(value));
    if (Number.isNaN(next) || next === time) return;
    time = next;
    tell();
  }

  // To an instant as a link holds it, not before the change.
  function jump(to) {
    const held = Number((Math.ceil(to / SAME) * SAME).toFixed(6));
    pause();
    set(held < to ? held + SAME : held);
  }

  // The changes of phase of all impacts that are shown, as shares of the duration.
  function borders(shares) {
    const sorted = shares.map(Number).filter(Number.isFinite).sort((a, b) => a - b);
    changes = sorted.filter((at, i) => !i || at - sorted[i - 1] > SAME);
  }

  const later = () => changes.find((at) => at > time + 2 * SAME);
  const earlier = () => changes.filter((at) => at < time - 2 * SAME).pop();

  return {
    FIRST,
    LAST,
    STEP,
    START,
    PACE,
    now: () => time,
    pace,
    isPlaying: () => playing,
    hear: (listener) => heard.push(listener),
    toggle: () => (playing ? pause() : play()),
    play,
    pause,
    set,
    borders,
    slow: (on) => (slower = Boolean(on)),
    isSlow: () => slower,
    after,
    next: () => jump(later() ?? LAST),
    previous: () => jump(earlier() ?? FIRST),
  };
})();
