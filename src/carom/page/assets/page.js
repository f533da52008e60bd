// Brings the parts together: one question at a time to the source, the newest wins; what is drawn when.

Carom.page = (() => {
  const WORDS = "input:not([type=range]), textarea, select, button, summary, a, [contenteditable], [role=tab]";
  const WIDE = window.matchMedia("(min-width: 1280px)");
  const BROAD = window.matchMedia("(min-width: 800px)");
  const STILL = window.matchMedia("(prefers-reduced-motion: reduce)");
  const TOUCHES = ["pointerdown", "keydown", "wheel"];
  const PACES = [2, 5, 10, 30]; // seconds that a film takes
  const VIEWS = { stage: ["stage", "stage-beside"], patch: ["patch", "patch-beside"] };
  const byId = (id) => document.getElementById(id);
  let answers = [null, null];
  let scenes = [null, null];
  let asking = false;
  let again = false;
  let due = false;
  let untouched = true; // the film runs by itself
  let linked = ""; // what was wrong with the link that was opened
  let described = ""; // what the names of the pictures tell: an instant or the film
  let following = new AbortController();

  // Ask for what the controls say; while an answer is on its way, only the last question waits.
  async function ask() {
    again = true;
    if (asking) return;
    asking = true;
    while (again) {
      again = false;
      await once(Carom.fields.query());
    }
    asking = false;
  }

  async function once(query) {
    following.abort();
    judge("waits"); // the verdict on what is still shown is not that on what is asked
    try {
      const latest = await Promise.all([Carom.reading.answer(query.toString()), Carom.beside.answered()]);
      if (!again) show(latest);
    } catch (refusal) {
      if (!again) refuse(refusal);
    }
  }

  // A link that says one thing wrong is right in the others; an impact beside that is none goes.
  let opening = true;
  function refuse({ field, message, beside }) {
    const label = Carom.fields.label(field);
    const text = label ? `${label}: ${message}` : message || "The page has failed; load it again.";
    if (beside) return mended(`Beside: ${text}`);
    if (opening && Carom.fields.reset(field)) return mended(text);
    Carom.fields.complain(field, message);
    notice(text);
    judge("refused");
    document.body.classList.add("carom-stale");
  }

  // Say whether the theory holds for what is shown, unless something else is asked for meanwhile.
  function judge(pending = "") {
    Carom.verdict.show(answers[0], pending);
    if (answers[0]) Carom.results.judge(answers, pending);
  }

  function mended(text) {
    linked = [linked, text].filter(Boolean).join("; ");
    again = true;
  }

  const notice = (text) => (byId("notice").textContent = [linked, text].filter(Boolean).join("; "));

  function show(latest) {
    Carom.laws.lend(answers[0], latest[0]);
    answers = latest;
    opening = false;
    scenes = answers.map((answer) => answer && Carom.scene.of(answer.scene));
    document.body.classList.remove("carom-stale");
    Carom.fields.complain("", "");
    notice("");
    Carom.clock.borders(answers[0].scene.phases.flatMap(({ start, end }) => [start, end]));
    Carom.link.put(answers[0].query);
    draw();
    Carom.results.show(answers);
    Carom.summary.show(answers[0]);
    Carom.verdict.show(answers[0]);
    Carom.stories.show(answers[0]);
    Carom.laws.show(answers[0]);
    soon(() => Carom.charts.show(answers));
    follow(answers);
    if (untouched && !Carom.clock.isPlaying()) Carom.clock.play();
  }

  // Whoever touches anything takes over; Play and Pause do so themselves.
  function touched({ target }) {
    TOUCHES.forEach((name) => document.removeEventListener(name, touched, true));
    if (untouched && !(target instanceof Element && target.closest("#play"))) Carom.clock.pause();
    untouched = false;
  }

  // Show from the beginning what comes of a change, unless the browser prefers no motion.
  function replay() {
    if (STILL.matches) return;
    Carom.clock.set(Carom.clock.FIRST);
    Carom.clock.play();
  }

  // The charts, which take longest, once the moving pictures are there; none that is outdated.
  let latest = null;
  function soon(work) {
    latest = work;
    requestAnimationFrame(() => setTimeout(() => work === latest && work()));
  }

  // What the program adds: whether the theory holds, and contact laws. An answer keeps it.
  async function follow(mine) {
    following = new AbortController();
    const { signal } = following;
    mine.filter(Boolean).forEach((each) => judged(each, mine, signal));
    await lawsOf(mine, signal);
  }

  // A verdict that fails or is too late is none, and never that on another impact.
  async function judged(answer, mine, signal) {
    if (answer.findings) return;
    try {
      answer.unjudged = "";
      answer.findings = await Carom.source.verdict(answer.query, signal);
    } catch (error) {
      if (signal.aborted) return;
      answer.unjudged = error.message;
      if (answers === mine) notice(error.message);
    }
    if (answers === mine && !signal.aborted) judge();
  }

  async function lawsOf(mine, signal) {
    const [first] = mine;
    if (!first.late.length) return;
    try {
      Object.assign(first, await Carom.source.laws(first, signal), { late: [] });
    } catch (error) {
      if (error.name !== "AbortError" && answers === mine) notice(error.message);
      return;
    }
    if (answers !== mine) return;
    Carom.laws.show(first);
    Carom.stories.show(first);
    Carom.charts.show(mine);
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
    if (!scenes[0]) return;
    for (const [name, canvases] of Object.entries(VIEWS)) {
      canvases.forEach((id, row) => scenes[row] && Carom[name].draw(byId(id), scenes[row], time));
    }
    Carom.cursor.draw(time);
    showTime(time);
  }

  function showTime(time) {
    const clock = scenes[0].clockAt(time);
    write(byId("clock"), clock);
    byId("time").value = time;
    write(byId("play"), Carom.clock.isPlaying() ? "Pause" : "Play");
    byId("sentence").ariaLive = Carom.clock.isPlaying() ? "off" : "polite";
    const sentences = scenes.map((scene) => scene && Carom.sentence.of(scene, time));
    const [sentence, other] = sentences;
    const both = sentence === other ? `Both: ${sentence}` : `This impact: ${sentence} Beside it: ${other}`;
    write(byId("sentence"), other ? both : sentence);
    if (!Carom.clock.isPlaying() || described !== "film") describe(clock, sentences);
    described = Carom.clock.isPlaying() ? "film" : "instant";
  }

  function write(element, text) {
    if (element.textContent !== text) element.textContent = text;
  }

  // Pictures in words, for those who hear the page: of an instant, or of the film while it runs.
  function describe(clock, sentences) {
    byId("time").setAttribute("aria-valuetext", clock);
    const running = Carom.clock.isPlaying();
    const at = running ? "as the film runs" : `at ${clock}`;
    for (const [row, beside] of ["", "-beside"].entries()) {
      const whose = row ? " beside" : "";
      const sentence = running ? "" : ` ${sentences[row] ?? ""}`;
      byId(`stage${beside}`).ariaLabel = `The bodies${whose} ${at}.${sentence}`.trim();
      byId(`patch${beside}`).ariaLabel = `The contact${whose} from above ${at}`;
    }
  }

  // The results stand beside the pictures where there is room, else among the charts; a story
  // scrolls with the charts, and on a phone it comes before the controls.
  function place() {
    const card = byId("results-card");
    const home = WIDE.matches ? byId("results-wide") : document.querySelector(".carom-charts");
    if (card.parentElement !== home) home.prepend(card);
    if (BROAD.matches) byId("lower").prepend(byId("story"));
    else byId("controls").before(byId("story"));
  }

  function open() {
    const asked = Carom.link.asked();
    const preset = Carom.presets.choose(Carom.link.part("preset") ?? "");
    const story = Carom.stories.query(Carom.link.part("story"));
    const odd = Carom.fields.set(asked.toString() ? asked : (story ?? preset));
    opening = true;
    Carom.beside.put(Carom.link.part("beside"));
    Carom.tabs.choose(Carom.link.part("tab") ?? Carom.tabs.first);
    const time = Carom.link.number("time");
    untouched &&= Number.isNaN(time) && !STILL.matches;
    Carom.clock.pause();
    Carom.clock.set(Number.isNaN(time) ? Carom.clock.START : time);
    byId("pace").value = String(Carom.link.number("pace"));
    if (!byId("pace").value) byId("pace").value = String(Carom.clock.PACE);
    byId("slow").checked = Carom.link.number("slow") === 1;
    Carom.clock.slow(byId("slow").checked);
    Carom.theme.choose(Carom.link.part("theme"));
    Carom.level.choose(Carom.level.asked(Carom.link.words()));
    Carom.stories.open(Carom.link.part("story"));
    linked = [...Carom.link.refused(), ...odd, ...unknown()].join("; ");
    ask();
  }

  // Words of a link that are for the page alone, and that it does not know.
  function unknown() {
    const shown = { preset: Carom.presets.chosen(), story: Carom.stories.chosen(), tab: Carom.tabs.chosen(), theme: Carom.theme.choice() };
    const odd = Object.keys(shown).filter((name) => (Carom.link.part(name) || shown[name]) !== shown[name]);
    if (Carom.link.part("time") && Number.isNaN(Carom.link.number("time"))) odd.push("time");
    return odd.map((name) => `${name}: there is no ${Carom.link.part(name)}`);
  }

  // Going over from bodies to numbers keeps the impact, that of the controls as they are now.
  async function carry() {
    const query = Carom.fields.query();
    query.delete("given");
    ["law", "data"].forEach((name) => query.delete(name));
    try {
      const { carried } = await Carom.reading.answer(query.toString());
      Object.entries(carried ?? {}).forEach(([name, number]) => Carom.fields.put(name, String(number)));
    } catch {
      // bodies that are no impact leave the numbers as they were
    }
  }

  async function changed(name) {
    linked = "";
    opening = false;
    if (name === "given" && Carom.fields.value("given") === "numbers") await carry();
    ask();
  }

  function onInput(event) {
    if (event.target.id !== "time") return;
    Carom.clock.pause();
    Carom.clock.set(event.target.value);
  }

  function onChange(event) {
    if (event.target.id === "slow") Carom.clock.slow(event.target.checked);
    if (["pace", "slow"].includes(event.target.id)) Carom.link.refresh();
  }

  function onKey(event) {
    const busy = event.ctrlKey || event.altKey || event.metaKey || event.repeat;
    if (event.key !== " " || busy) return;
    if (event.target instanceof Element && event.target.closest(WORDS)) return;
    event.preventDefault();
    Carom.clock.toggle();
  }

  function build() {
    const { FIRST: min, LAST: max, STEP: step } = Carom.clock;
    Object.assign(byId("time"), { min, max, step });
    PACES.forEach((pace) => byId("pace").append(new Option(`${pace} s film`, pace)));
    Carom.laws.build();
    Carom.fields.build();
    Carom.presets.build();
    Carom.stories.build();
    Carom.files.build();
    Carom.fit.build();
    Carom.cursor.watch();
    place();
  }

  function listen() {
    Carom.fields.hear(changed);
    byId("laws").addEventListener("change", () => changed("law"));
    byId("fit-panel")?.addEventListener("change", ({ target }) => target.id === "data" && changed("data"));
    Carom.presets.hear((query) => (Carom.fields.set(query), changed(""), replay()));
    Carom.stories.hear((query) => (Carom.fields.set(query), changed(""), replay()));
    Carom.level.hear(() => (Carom.fields.hide(), draw(), Carom.link.refresh(), Carom.charts.again()));
    Carom.beside.build(() => changed(""));
    byId("play").addEventListener("click", Carom.clock.toggle);
    byId("back").addEventListener("click", Carom.clock.previous);
    byId("forth").addEventListener("click", Carom.clock.next);
    byId("theme").addEventListener("click", Carom.theme.next);
    document.addEventListener("input", onInput);
    document.addEventListener("change", onChange);
    document.addEventListener("keydown", onKey);
    TOUCHES.forEach((name) => document.addEventListener(name, touched, true));
    Carom.clock.hear(draw);
    Carom.clock.hear(() => Carom.link.refresh());
    Carom.tabs.hear(() => Carom.link.refresh());
    Carom.theme.hear(() => (draw(), Carom.charts.again(), Carom.link.refresh()));
    [WIDE, BROAD].forEach((room) => room.addEventListener("change", place));
    window.addEventListener("popstate", open);
    const sizes = new ResizeObserver(draw);
    Object.values(VIEWS).flat().forEach((id) => sizes.observe(byId(id)));
  }

  build();
  listen();
  open();
  return { redraw: draw, replay, frame: drawNow, answers: () => answers, get scenes() { return scenes; } };
})();
