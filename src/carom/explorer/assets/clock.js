// The time of the animation, as a share of the contact's duration: 0 first touch, 1 separation.
window.Carom = window.Carom || {};

Carom.clock = (() => {
  const FIRST = -0.6;
  const LAST = 1.6;
  const STEP = 0.002;
  const START = 0.5; // maximum compression
  const PACE = 5; // seconds that the whole takes, until chosen
  const REST = 0.7; // seconds at the end before it starts anew
  const LONGEST = 0.1; // seconds that one frame may take: no leap after a pause of the browser

  let time = START;
  let playing = false;
  let last = 0; // of the frame before, in ms
  let rested = 0; // seconds at the end so far
  const heard = [];

  const limited = (value) => Math.min(LAST, Math.max(FIRST, value));
  const tell = () => heard.forEach((hear) => hear(time, playing));

  function pace() {
    const select = document.getElementById("pace");
    return Math.max(0.1, Number(select && select.value) || PACE);
  }

  function frame(now) {
    if (!playing) return;
    const passed = Math.min((now - last) / 1000, LONGEST);
    last = now;
    if (time < LAST) {
      time = limited(time + (passed * (LAST - FIRST)) / pace());
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
  };
})();
