// Contact laws to choose from; the same strip is the key to their lines in the charts.

Carom.laws = (() => {
  const { make } = Carom.elements;
  const { laws: catalogue } = Carom.config;
  const DASHES = ["7px,3px", "2px,2.5px", "9px,3px,2px,3px", "14px,4px"];
  const COLORS = 6; // of the theme: law-1 and so on
  const EQUAL = 1e-6; // laws are solved to 1e-8
  const chips = new Map();
  let strip = null;
  let more = null;
  let clear = null;
  let place = () => {}; // puts the buttons where they belong: on top of all laws, behind those chosen
  let answer = null;

  // Colour and dash by the place in the list: no two of 24 have both alike.
  function style(label) {
    const row = Math.max(0, catalogue.findIndex((law) => law.label === label));
    const turn = Math.floor(row / COLORS);
    return { color: Carom.theme.color(`law-${(row % COLORS) + 1}`), dash: DASHES[(row + turn) % DASHES.length] };
  }

  function chip({ label, used_by: users }, row) {
    const input = make("input", { type: "checkbox", name: "law", value: label, id: `law-${row}` });
    const sample = make("span", "carom-line");
    const called = make("span", { className: "carom-called", id: `law-${row}-called`, innerHTML: written(label) });
    const remark = make("span", { className: "carom-remark", id: `law-${row}-remark` });
    input.setAttribute("aria-labelledby", called.id);
    input.setAttribute("aria-describedby", remark.id);
    const element = make("label", { className: "carom-chip", title: `${label}: used by ${users}` }, input, sample, called, remark);
    element.addEventListener("pointerenter", () => input.checked && Carom.charts.stress(label));
    element.addEventListener("pointerleave", () => Carom.charts.stress(null));
    input.addEventListener("focus", () => input.checked && Carom.charts.stress(label));
    input.addEventListener("blur", () => Carom.charts.stress(null));
    chips.set(label, { input, sample, remark, users, element });
    return element;
  }

  const button = (className, onclick, ...words) => make("button", { className, type: "button", onclick }, ...words);

  function build() {
    const title = make("span", "carom-strip-title", "Contact laws");
    strip = make("fieldset", "carom-laws carom-folded", title, ...catalogue.map(chip));
    strip.ariaLabel = title.textContent;
    more = button("carom-more", () => fold(!strip.classList.contains("carom-folded")));
    clear = button("carom-clear", () => (choose([]), changed(), more.focus()), "Remove all");
    const buttons = make("div", "carom-law-buttons", more, clear);
    place = (folded) => (folded ? strip.append(buttons) : title.after(buttons));
    place(true);
    strip.hidden = !Carom.source.live;
    strip.addEventListener("change", kept);
    document.getElementById("laws").replaceChildren(strip);
    update();
  }

  // Letters as they are written in formulas.
  function written(text) {
    const greek = text.replace(/\bkappa\b/g, "κ").replace(/\bbeta_/g, "β_");
    return greek.replace(/(?<![^\s/])([kKβ])_(\w)\b/g, "$1<sub>$2</sub>");
  }

  const changed = () => strip.dispatchEvent(new Event("change", { bubbles: true }));

  // A chip that is taken off a folded strip goes; who used the keyboard stays in the strip.
  function kept(event) {
    const gone = event.target.name === "law" && !event.target.checked && strip.classList.contains("carom-folded");
    if (gone) more.focus();
    update();
  }

  function fold(folded) {
    strip.classList.toggle("carom-folded", folded);
    place(folded);
    update();
    more.focus(); // it was moved
    strip.scrollIntoView({ block: "nearest" });
  }

  const chosen = () => [...chips].filter(([, { input }]) => input.checked).map(([label]) => label);

  function choose(labels) {
    for (const [label, { input }] of chips) input.checked = labels.includes(label);
    update();
  }

  // What a chip says of its law: psi_2 and how far off, or why there is none.
  function words(label) {
    const { users } = chips.get(label);
    if (!answer || !chips.get(label).input.checked) return `used by: ${users}`;
    if (answer.late.includes(label)) return "solving …";
    const law = answer.laws.find((each) => each.label === label);
    if (law && law.at !== null) return `ψ₂ ${number(law.at)}, ${off(law.off)}`;
    if (law) return "no ψ₂: without friction";
    if (answer.undamped.includes(label)) return "no damping: left out with losses";
    if ((answer.slow || []).includes(label)) return "not solved in time: choose fewer";
    return "solving …";
  }

  const number = (value) => value.toFixed(4).replace("-", "−");

  function off(error) {
    if (error === null || Math.abs(error) <= EQUAL) return "exact";
    return `off by ${error < 0 ? "−" : "+"}${Math.abs(error).toPrecision(2)}`;
  }

  function update() {
    if (!strip) return;
    const folded = strip.classList.contains("carom-folded");
    const taken = chosen().length;
    for (const [label, { input, sample, remark, element }] of chips) {
      element.classList.toggle("carom-chosen", input.checked);
      sample.innerHTML = Carom.keys.line({ ...style(label), width: 2.2 }, 32);
      remark.innerHTML = written(words(label));
    }
    const rest = catalogue.length - taken;
    more.textContent = folded ? `${taken ? "More laws" : "Choose laws"} (${rest})` : "Show chosen laws only";
    more.hidden = folded && !rest;
    more.setAttribute("aria-expanded", !folded);
    clear.hidden = !taken;
  }

  // Until those of another impact are there, the curves of this one, where they are the same.
  function lend(from, to) {
    if (from?.shape !== to.shape || to.laws.length) return;
    const known = from.laws.filter(({ label }) => to.late.includes(label));
    to.laws = known.map((law) => ({ ...law, at: null, off: null, share: [], force: [] }));
  }

  function show(latest) {
    answer = latest;
    update();
  }

  Carom.theme.hear(update);
  return { build, chosen, choose, lend, show, style };
})();
