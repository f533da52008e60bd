// Lists by which a reader says what the columns of a file hold, its sheet, its decimal sign.

Carom.fitColumns = (() => {
  const SIGNS = [["", "choose"], [",", "comma: 0,5"], [".", "point: 0.5"]];
  const ERROR = "_error"; // ends the name of standard deviations
  const { make } = Carom.elements;
  const quoted = (text) => JSON.stringify(text).replace(/\x7f/g, "\\u007f");
  const options = (pairs) => pairs.map(([value, text]) => new Option(text, value));

  function choice(label, pairs, value) {
    const select = make("select", {}, ...options(pairs));
    select.value = value;
    return [make("div", {}, make("label", {}, `${label} `, select)), select];
  }

  // What a column may hold, by kind, and below it the standard deviations of the same.
  function holdable(quantities) {
    const kinds = Object.groupBy(quantities, ({ kind }) => kind);
    const groups = Object.entries(kinds).map(([kind, each]) => [kind, each.map(({ name, words }) => [name, `${words} · ${name}`])]);
    groups.push(["standard deviation", quantities.map(({ name, words }) => [name + ERROR, `of ${words} · ${name}${ERROR}`])]);
    return groups.map(([label, pairs]) => make("optgroup", { label }, ...options(pairs)));
  }

  // The row of a column; `said` is what its lists say beyond its own head, null if nothing.
  function row(column, { quantities, units }) {
    const { head, own } = column;
    const si = () => quantities.find(({ name }) => name === holds.value.replace(ERROR, ""))?.si;
    const holds = make("select", { ariaLabel: `what ${head} holds` }, new Option("not used", ""), ...holdable(quantities));
    const unit = make("select", { ariaLabel: `unit of ${head}` });
    const mark = make("span", { className: "carom-note" }, column.suggested ? "suggested" : "");
    holds.value = column.name;
    holds.ariaDescription = mark.textContent;

    function offer(wanted, ...more) {
      const names = [...new Set([...(units[si()] ?? []), ...more].filter(Boolean))];
      unit.replaceChildren(new Option(`none: ${si()}`, ""), ...options(names.map((name) => [name, name])));
      unit.value = names.includes(wanted) ? wanted : "";
      unit.hidden = !(si() in units) || column.fits.includes(si());
    }

    offer(column.chosen || column.own_unit, column.chosen, column.own_unit);
    holds.addEventListener("change", () => (mark.replaceChildren(), offer(unit.value)));

    function said() {
      const chosen = unit.hidden ? "" : unit.value;
      if (!holds.value) return own || column.likely ? `column ${column.letter}` : null;
      if (holds.value === own && chosen === column.own_unit) return null;
      return chosen ? `${holds.value} [${chosen}]` : holds.value;
    }

    const line = make("div", { className: "carom-column" }, make("code", {}, head), make("span", {}, column.first.join(" · ")), holds, make("span", {}, unit, mark));
    return { line, said: () => [head, said()] };
  }

  // A fold with all lists; its `text` is what they say, as a file map.toml holds it.
  function build(lists, open, use) {
    const [sheetList, sheet] = choice("Sheet", [["", lists.columns.length ? "that with numbers" : "choose"], ...lists.sheets.map((name) => [name, name])], lists.sheet);
    const [signList, sign] = choice("Decimal sign", SIGNS, lists.decimal);
    const rows = lists.columns.map((column) => row(column, lists));
    const lines = (pairs) => pairs.filter(([, text]) => text).map(([key, text]) => `${key} = ${quoted(text)}\n`).join("");

    function text() {
      const own = lines([["sheet", sheet.value], ["decimal", sign.value]]);
      return `${own}${own && "\n"}[columns]\n${lines(rows.map(({ said }) => said()).map(([head, name]) => [quoted(head), name]))}`;
    }

    const button = make("button", { id: "fit-columns-use", type: "button", onclick: use }, "Read the file like this");
    const save = make("button", { id: "fit-columns-save", type: "button", title: "for this page, and for carom fit", onclick: () => Carom.files.save(new Blob([text()]), "map.toml") }, "Save as map.toml");
    const fold = Carom.fitTables.fold("Columns of the file: what each holds", open, ...(lists.sheets.length ? [sheetList] : []), ...(lists.asks_decimal ? [signList] : []), ...rows.map(({ line }) => line), button, save);
    return Object.assign(fold, { id: "fit-columns", said: text });
  }

  return { build };
})();
