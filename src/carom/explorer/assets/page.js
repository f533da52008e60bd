// Brings the parts together: what Dash calls, what the reader does, what is drawn when.
window.Carom = window.Carom || {};

Carom.page = (() => {
  const WORDS = "input:not([type=range]), textarea, select, button, summary, a, [contenteditable]";
  const NARROW = "(max-width: 760px)";
  const sizes = new ResizeObserver(() => draw());
  const sized = new WeakSet();
  const CHARTS = 3;
  let latest = null;
  let due = false;
  let folded = false;
  let paced = false;

  const byId = (id) => document.getElementById(id);

  function make(tag, box, properties) {
    const element = document.createElement(tag);
    Object.assign(element, properties);
    box.append(element);
    return element;
  }

  // Parts that React would set back if it owned them.
  function build() {
    const times = byId("time-box");
    if (times && !byId("time")) {
      const { FIRST: min, LAST: max, STEP: step } = Carom.clock;
      const slider = make("input", times, { type: "range", id: "time", min, max, step });
      slider.setAttribute("aria-label", "time");
    }
    const links = byId("link-box");
    if (links && !byId("link")) {
      const field = make("input", links, { id: "link", type: "text", readOnly: true });
      field.setAttribute("aria-label", "link to this view");
      make("button", links, { id: "copy", type: "button", textContent: "Copy link" });
      make("span", links, { id: "copied", role: "status", className: "carom-copied" });
    }
  }

  // On a small screen the pictures come first; the controls open at a touch.
  function fold() {
    const details = document.querySelector(".carom-controls details");
    if (!details || folded) return;
    folded = true;
    if (window.matchMedia(NARROW).matches) details.open = false;
  }

  // Dash makes the page late and may make parts of it again: look each time.
  function attach() {
    build();
    fold();
    Carom.theme.label();
    Carom.access.name();
    Carom.cursor.watch();
    for (const id of ["stage", "patch"]) {
      const canvas = byId(id);
      if (!canvas || sized.has(canvas)) continue;
      sized.add(canvas);
      canvas.setAttribute("role", "img");
      sizes.observe(canvas);
    }
    if (byId("pace") && !paced) {
      setPace();
      paced = true;
    }
    const output = byId("clock");
    if (output) output.setAttribute("aria-live", "off"); // it would talk without end
  }

  function setPace() {
    const select = byId("pace");
    if (!select) return; // Dash has not made it yet
    select.value = String(Carom.link.asked("pace"));
    if (!select.value) select.value = String(Carom.clock.PACE);
  }

  // What a link that is gone back to says of the film and the theme; Dash restores all else.
  function restore() {
    const time = Carom.link.asked("time");
    Carom.clock.pause();
    Carom.clock.set(Number.isNaN(time) ? Carom.clock.START : time);
    setPace();
    Carom.theme.choose(Carom.link.part("theme"));
  }

  function draw() {
    if (due) return;
    due = true;
    requestAnimationFrame(() => {
      due = false;
      drawNow(Carom.clock.now());
    });
  }

  function drawNow(time) {
    Carom.stage.draw(time);
    Carom.patch.draw(time);
    Carom.cursor.draw(time);
    showTime(time);
  }

  function showTime(time) {
    const told = Carom.scene.told(time);
    const [output, slider, button] = ["clock", "time", "play"].map(byId);
    if (output && output.textContent !== told) output.textContent = told;
    if (slider) slider.value = time;
    const verb = Carom.clock.isPlaying() ? "Pause" : "Play";
    if (button && button.textContent !== verb) button.textContent = verb;
    if (!Carom.clock.isPlaying()) describe(told, slider);
  }

  // Pictures in words, for those who hear the page.
  function describe(told, slider) {
    if (slider) slider.setAttribute("aria-valuetext", told);
    const [stage, patch] = ["stage", "patch"].map(byId);
    if (stage) stage.setAttribute("aria-label", `The bodies at ${told}`);
    if (patch) patch.setAttribute("aria-label", `The contact from above at ${told}`);
  }

  function onInput(event) {
    if (event.target.id === "pace") Carom.link.refresh();
    if (event.target.id !== "time") return;
    Carom.clock.pause();
    Carom.clock.set(event.target.value);
  }

  function onClick(event) {
    if (!(event.target instanceof Element)) return;
    if (event.target.closest(Carom.link.DOWNLOADS)) Carom.link.write();
    const button = event.target.closest("button");
    if (!button) return;
    if (button.id === "play") Carom.clock.toggle();
    if (button.id === "theme") Carom.theme.next();
    if (button.id === "copy") Carom.link.copy();
  }

  function onKey(event) {
    const busy = event.ctrlKey || event.altKey || event.metaKey || event.repeat;
    if (event.key !== " " || busy || !byId("play")) return;
    if (event.target instanceof Element && event.target.closest(WORDS)) return;
    event.preventDefault();
    Carom.clock.toggle();
  }

  function show(scene) {
    attach();
    Carom.scene.put(scene);
    draw();
    return window.dash_clientside.no_update;
  }

  function link(query) {
    attach();
    Carom.link.put(query);
    return window.dash_clientside.no_update;
  }

  // The charts, which take longest, once the moving pictures are there; none that is outdated.
  async function chart(figures) {
    const same = window.dash_clientside.no_update;
    latest = figures;
    await new Promise((done) => requestAnimationFrame(() => setTimeout(done)));
    return figures && figures === latest ? figures : Array(CHARTS).fill(same);
  }

  function listen() {
    document.addEventListener("input", onInput);
    document.addEventListener("click", onClick, true);
    document.addEventListener("keydown", onKey);
    Carom.clock.hear(draw);
    Carom.clock.hear(() => Carom.link.refresh());
    Carom.theme.hear(() => (draw(), Carom.link.refresh()));
    window.addEventListener("popstate", restore);
    Carom.clock.set(Carom.link.asked("time"));
  }

  document.addEventListener("DOMContentLoaded", listen);
  return { show, link, chart, attach: () => (attach(), window.dash_clientside.no_update) };
})();

window.dash_clientside = window.dash_clientside || {};
window.dash_clientside.carom = Carom.page; // what Dash calls by name
