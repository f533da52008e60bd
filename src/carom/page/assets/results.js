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
    shear_lost_energy: "lost in shear",
  };
  const OF_BALLS = "θ′, V′ and e_t are of the first ball as seen from the other. Pictures and energies are as one sees them: the other at rest before.";
  const SHORTER = { [Carom.losses.WORDS.waves]: "lost to waves" };
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

  // What the energy is lost to, where that is the same in both impacts.
  function sinkOf(answers) {
    const sinks = new Set(answers.filter((answer) => answer?.lossy).map(({ scene }) => Carom.losses.sink(scene)));
    return sinks.size === 1 ? [...sinks][0] : "lost energy";
  }

  function line([first, second], both, sink) {
    const { name, symbol, meaning } = first || second;
    const sign = Carom.tips.symbol(symbol);
    const short = name === "lost_energy" ? SHORTER[sink] || sink : SHORT[name] || meaning;
    const words = make("span", { title: meaning }, short);
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
    const body = make("tbody", "", ...rows(answers).map((row) => line(row, both, sinkOf(answers))));
    return make("table", `carom-table carom-results${both ? " carom-both" : ""}`, ...(both ? [head()] : []), body);
  }

  function finding({ mark, text }) {
    const [sign, look, meaning] = MARKS[mark];
    const icon = make("span", { className: "carom-mark", role: "img", ariaLabel: `${meaning}: ` }, sign);
    return make("li", `carom-${look}`, icon, make("span", "", text));
  }

  // How far the theory holds, in a line; what it is judged by opens, and stays so for other impacts.
  // Of an impact without a verdict the line says why.
  function findings({ findings: all }, title, why) {
    if (why && !Carom.source.live) return make("p", "carom-note", title + why);
    const { sorted } = Carom.verdict;
    const [worst, words] = why ? ["?", why] : counted(sorted(all));
    const sign = make("span", `carom-mark carom-${MARKS[worst][1]}`, MARKS[worst][0][0]);
    const fold = make("details", "", make("summary", "", sign, ` ${title}${words}`));
    fold.open = unfolded;
    fold.addEventListener("toggle", () => fold.isConnected && (unfolded = fold.open));
    if (!why) fold.append(make("ul", "carom-findings", ...sorted(all).map(finding)));
    return fold;
  }

  function counted(all) {
    const [{ mark }] = all;
    const count = all.filter((each) => each.mark === mark).length;
    return [mark, mark === "ok" ? "the theory holds" : `the theory ${SHORTLY[mark]} in ${count} of ${all.length}`];
  }

  // What a plate comes to; and of two balls, in which frame the pictures show them.
  function notes(answer, title) {
    const { scene, view } = answer;
    const said = [];
    if (scene.plate < 1) said.push(`e = ${scene.plate.toPrecision(3)}. ${takenByPlate(answer)}`);
    if (view?.against === "sphere") said.push(OF_BALLS);
    return said.map((words) => make("p", "carom-note", title + words));
  }

  function takenByPlate(answer) {
    if (answer.numbers) return Carom.losses.told(answer);
    const share = Carom.losses.percent(1 - answer.scene.plate ** 2); // two numbers tell no more
    return `${share} of the normal energy is ${Carom.losses.sink(answer.scene)}.`;
  }

  const titled = (answers) => (answers[1] ? ["This: ", "Beside: "] : ["", ""]);

  function show(answers) {
    box("results").replaceChildren(table(answers));
    judge(answers);
  }

  // The verdict, which follows: until it is there the line says so. Whoever is at it by the keyboard
  // stays there. `pending` as in `Carom.verdict`.
  function judge(answers, pending = "") {
    const titles = titled(answers);
    const told = (answer, title) => [...notes(answer, title), findings(answer, title, Carom.verdict.missing(answer, pending))];
    const held = box("findings").contains(document.activeElement);
    box("findings").replaceChildren(...answers.flatMap((answer, row) => (answer ? told(answer, titles[row]) : [])));
    if (held) box("findings").querySelector("summary")?.focus();
  }

  return { show, judge };
})();
