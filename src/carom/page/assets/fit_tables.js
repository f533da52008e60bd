// The words and tables of a fit: parameters, laws, notes, what the columns were taken for.

Carom.fitTables = (() => {
  const { make } = Carom.elements;

  function table(name, heads, rows) {
    const head = heads.map((text) => make("th", { scope: "col" }, text));
    const body = rows.map((cells) => make("tr", {}, ...cells.map((cell) => make("td", {}, cell))));
    const caption = make("caption", {}, name);
    return make("table", { className: "carom-table carom-fit-table" }, caption, make("thead", {}, make("tr", {}, ...head)), make("tbody", {}, ...body));
  }

  // A unit stands after the interval, what is to be said of a parameter below its name.
  function parameters({ parameters: estimates, confidence }) {
    const rows = estimates.map(({ symbol: sign, meaning, value, interval, unit, note }) => {
      const below = make("span", { className: "carom-note" }, note);
      const named = make("div", {}, meaning, ...(note ? [make("br"), below] : []));
      return [Carom.tips.symbol(sign), named, value, [interval, unit].filter(Boolean).join(" ")];
    });
    const made = table("Parameters", ["", "", "value", `${confidence} interval`], rows);
    made.classList.add("carom-parameters");
    return made;
  }

  function laws({ laws: compared, verdict }) {
    if (!compared.length) return [];
    const rows = compared.map(({ law, excess, weight, parameters: words }) => {
      const below = make("span", { className: "carom-note", innerHTML: Carom.plotting.lowered(words) });
      return [make("div", {}, law, make("br"), below), excess, weight];
    });
    const heads = ["law", "AICc excess", "weight"];
    const made = table("Laws compared on these data", heads, rows);
    made.classList.add("carom-compared");
    return [made, make("p", {}, sentence(verdict))];
  }

  const sentence = (text) => (text ? `${text[0].toUpperCase()}${text.slice(1)}.` : "");

  function notes({ notes: words, regimes }) {
    const lines = [...words];
    if (regimes.length) lines.push(`rows by regime: ${regimes.map(({ name, rows }) => `${rows} ${name}`).join("; ")}`);
    if (!lines.length) return [];
    return [make("h3", {}, "Notes"), make("ul", { className: "carom-notes" }, ...lines.map((line) => make("li", {}, line)))];
  }

  function columns(taken) {
    const rows = taken.map(({ head, kind, meaning, unit }) => [make("code", {}, head), kind, meaning, unit]);
    return table("What the columns were taken for", ["column", "", "taken for", "unit"], rows);
  }

  function fold(title, open, ...children) {
    return make("details", { className: "carom-fold", open }, make("summary", {}, title), ...children);
  }

  const FROM = { file: "as the file says", page: "those of the page" };

  function head({ name, values, rows, bodies }) {
    const counted = (count, word) => `${count} ${word}${count === 1 ? "" : "s"}`;
    const where = `${counted(values, "value")} in ${counted(rows, "row")}`;
    return make("div", { className: "carom-fit-head" }, make("h3", {}, name),
      make("p", {}, `${where}. Bodies, ${FROM[bodies.from]}: ${bodies.text}.`));
  }

  // What is beside the charts, and what is below both.
  const beside = (fit) => [parameters(fit), ...laws(fit)];

  function below(fit) {
    const words = make("pre", { className: "carom-code", tabIndex: 0 }, fit.words);
    const notesAndText = make("div", {}, ...notes(fit), fold("As text, for a report", false, words));
    return [make("div", {}, columns(fit.columns)), notesAndText];
  }

  return { head, beside, below, fold };
})();
