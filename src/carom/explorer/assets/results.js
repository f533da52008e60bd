// The numbers of an impact, and whether the theory holds for it.

Carom.results = (() => {
  const MARKS = { // sign, class, what a reader of the screen says; in the order in which they are shown
    FAILS: ["✗ FAILS", "fails", "does not hold"],
    "?": ["?", "unknown", "not judged"],
    ok: ["✓", "ok", "holds"],
  };
  const SHORTLY = { FAILS: "fails", "?": "is not judged" };
  const SHORT = { // what a line has room for; the whole meaning where one points
    psi_in: "velocity before",
    psi_out: "velocity after",
    chi: "inertia/stiffness",
    kappa: "stiffness ratio",
    rebound_angle: "rebound angle",
    rebound_speed: "rebound speed",
    spin_out: "spin after",
    contact_restitution: "slip, after/before",
    tangential_restitution: "path, after/before",
    dissipated_energy: "lost to friction",
    duration: "contact time",
    max_force: "largest force",
    max_radius: "contact radius",
    normal_restitution: "normal restitution",
    lost_energy: "normal losses",
    shear_lost_energy: "losses in shear",
  };
  let unfolded = false;
  const { make } = Carom.elements;
  const box = (id) => document.getElementById(id);

  // The rows of both impacts, those of the first in front.
  function rows([first, second]) {
    const other = new Map((second ? second.results : []).map((row) => [row.name, row]));
    const both = first.results.map((row) => [row, other.get(row.name)]);
    const names = new Set(first.results.map(({ name }) => name));
    return [...both, ...[...other.values()].filter(({ name }) => !names.has(name)).map((row) => [null, row])];
  }

  function value(row) {
    if (!row) return make("td", "carom-none", "–");
    const unit = row.unit ? make("span", "carom-unit", `\u00a0${row.unit}`) : "";
    const [number, why] = row.value.split(": "); // where there is none
    const cell = make("td", "", number.replace(/^-/, "−"), unit);
    if (why) cell.title = why;
    return cell;
  }

  function line([first, second], both) {
    const { name, symbol, meaning } = first || second;
    const sign = Carom.tips.symbol(symbol);
    const words = make("span", { title: meaning }, SHORT[name] || meaning);
    const cells = [value(first), ...(both ? [value(second)] : [])];
    const head = make("th", { className: "carom-sign", scope: "row" }, sign);
    const row = make("tr", "", head, make("td", "carom-meaning", words), ...cells);
    row.dataset.name = (first || second).name;
    return row;
  }

  function head() {
    const column = (text) => make("th", { scope: "col" }, text);
    return make("thead", "", make("tr", "", make("td"), make("td", "carom-meaning"), column("this"), column("beside")));
  }

  function table(answers) {
    const both = Boolean(answers[1]);
    const body = make("tbody", "", ...rows(answers).map((row) => line(row, both)));
    return make("table", `carom-table carom-results${both ? " carom-both" : ""}`, ...(both ? [head()] : []), body);
  }

  function finding({ mark, text }) {
    const [sign, look, meaning] = MARKS[mark];
    const icon = make("span", { className: "carom-mark", role: "img", ariaLabel: `${meaning}: ` }, sign);
    return make("li", `carom-${look}`, icon, make("span", "", text));
  }

  // How far the theory holds, in a line; what it is judged by opens, and stays so for other impacts.
  function findings({ findings: all }, title) {
    if (!all?.length) return [];
    const order = Object.keys(MARKS);
    const sorted = [...all].sort((a, b) => order.indexOf(a.mark) - order.indexOf(b.mark));
    const worst = sorted[0].mark;
    const count = sorted.filter(({ mark }) => mark === worst).length;
    const holds = worst === "ok" ? "the theory holds" : `the theory ${SHORTLY[worst]} in ${count} of ${all.length}`;
    const sign = make("span", `carom-mark carom-${MARKS[worst][1]}`, MARKS[worst][0][0]);
    const fold = make("details", "", make("summary", "", sign, ` ${title}${holds}`));
    fold.open = unfolded;
    fold.addEventListener("toggle", () => fold.isConnected && (unfolded = fold.open));
    fold.append(make("ul", "carom-findings", ...sorted.map(finding)));
    return [fold];
  }

  // What a plate comes to.
  function plate({ scene }, title) {
    const taken = Carom.sentence.waves(scene);
    const words = `${title}e = ${scene.plate?.toPrecision(3)}, and waves in the plate carry away ${taken} of the normal energy.`;
    return taken ? [make("p", "carom-note", words)] : [];
  }

  function show(answers) {
    box("results").replaceChildren(table(answers));
    judge(answers);
  }

  // The verdict, which follows: whoever is at it by the keyboard stays there.
  function judge(answers) {
    if (answers.some((answer) => answer && !answer.findings) && Carom.source.live) return; // until it is there
    const titles = answers[1] ? ["This: ", "Beside: "] : ["", ""];
    const told = (answer, title) => [...plate(answer, title), ...findings(answer, title)];
    const held = box("findings").contains(document.activeElement);
    box("findings").replaceChildren(...answers.flatMap((answer, row) => (answer ? told(answer, titles[row]) : [])));
    if (held) box("findings").querySelector("summary")?.focus();
  }

  return { show, judge };
})();
