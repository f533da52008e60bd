// Stories: a few steps each, with one question and one control; doing it shows the answer.

Carom.stories = (() => {
  const { make } = Carom.elements;
  const { stories } = Carom.config;
  const place = document.getElementById("stories");
  const below = document.getElementById("story-steps"); // the control stands between both
  const heard = [];
  let story = null;
  let step = 0;
  let solved = new Set(); // steps whose answers were found

  const button = (words, onclick, name = "") => make("button", { type: "button", className: name, onclick }, words);

  // The story and the step of a word of a link, "superball.2".
  function found(word) {
    const [id, number] = (word ?? "").split(".");
    const known = stories.find((each) => each.id === id);
    const row = Number(number ?? 1) - 1;
    return known && row in known.steps ? [known, row] : [null, 0];
  }

  function query(word) {
    const [known, row] = found(word);
    return known ? new URLSearchParams(known.steps[row].query) : null;
  }

  function open(word) {
    [story, step] = found(word);
    tell();
  }

  function go(known, row) {
    if (known !== story) solved = new Set();
    [story, step] = [known, row];
    Carom.presets.choose("");
    Carom.level.choose("first");
    tell();
    focus((story ? place : below).querySelector("h2"));
    heard.forEach((hear) => hear(new URLSearchParams(story ? story.steps[row].query : "")));
  }

  function list() {
    const buttons = stories.map((each) => button(each.title, () => go(each, 0), "carom-story"));
    return [make("h2", "", "Stories"), make("div", "carom-story-list", ...buttons)];
  }

  function told() {
    const { text, question, answer } = story.steps[step];
    const last = step === story.steps.length - 1;
    const done = solved.has(step);
    const head = make("div", "carom-story-head", make("h2", "", story.title), make("span", "carom-note", `${step + 1} of ${story.steps.length}`));
    const asked = make("p", "carom-question", question);
    const found = make("p", { className: "carom-answer", hidden: !done }, answer);
    found.role = "status";
    const steps = make("div", "carom-story-steps",
      ...(step ? [button("Back", () => go(story, step - 1))] : []),
      ...(done ? [] : [button("Show me", reveal)]),
      button(last ? "More stories" : "Next", () => (last ? go(null, 0) : go(story, step + 1)), "carom-next"),
      button("Leave the story", () => go(null, 0)));
    const off = make("p", { className: "carom-note", id: "story-off" });
    return [[head, make("p", "", text), asked], [off, found, steps]];
  }

  function tell() {
    const [above, after] = story ? told() : [[], list()];
    place.replaceChildren(...above);
    below.replaceChildren(...after);
    const now = story ? story.steps[step] : null;
    document.body.classList.toggle("carom-in-story", Boolean(now));
    document.body.dataset.chart = now?.chart ?? "";
    Carom.fields.only(now?.control ?? "", now?.slider);
  }

  // Whoever uses the keyboard goes on where the story does.
  function focus(element) {
    element.tabIndex = -1;
    element.focus({ preventScroll: true });
  }

  function reveal() {
    const { control, value } = story.steps[step];
    solved.add(step);
    Carom.fields.move({ [control]: String(value) });
    tell();
    focus(below.querySelector(".carom-answer"));
  }

  // Whether the impact that is shown answers the question.
  function answers({ numbers, laws }) {
    const { quantity, below = Infinity, above = -Infinity } = story.steps[step].until;
    const value = quantity === "off" ? Math.abs(laws[0]?.off ?? NaN) : numbers?.[quantity]; // laws follow
    return value > above && value < below;
  }

  // Whether an impact differs from that of the step in its control alone: none is left from before.
  function belongs({ view }) {
    const { query: words, control } = story.steps[step];
    const first = new URLSearchParams(words);
    const same = ([name, { default: usual }]) => String(view[name]) === (first.get(name) ?? String(usual));
    const others = Object.entries(Carom.config.fields).filter(([name]) => ![control, "law", "data"].includes(name));
    return others.every((each) => same(each) || (view[each[0]] === Infinity && !first.has(each[0])));
  }

  function show(answer) {
    const told = document.getElementById("story-off");
    const off = answer.laws[0]?.off ?? null;
    if (told) told.textContent = off === null ? "" : `The law is off by ${Math.abs(off).toFixed(3)}.`;
    if (!story || solved.has(step) || !answer.view || !belongs(answer) || !answers(answer)) return;
    solved.add(step);
    tell();
  }

  return {
    build: tell,
    open,
    query,
    show,
    chosen: () => (story ? `${story.id}.${step + 1}` : ""),
    hear: (listener) => heard.push(listener),
  };
})();
