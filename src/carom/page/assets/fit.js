// Measured rebounds: a data set that comes along or a file of the reader's, and its fit.

Carom.fit = (() => {
  const { largest_upload: LARGEST } = Carom.config; // bytes of a file
  const BODIES = ["material", "young", "poisson", "density"].flatMap((name) => [name, `second_${name}`])
    .concat("radius", "against", "second_radius", "thickness");
  const { make } = Carom.elements;
  const panel = document.getElementById("fit-panel");
  const parts = {};
  let file = null; // {name, contents} of the reader's file
  let columns = ""; // what its columns hold, as the text of a file map.toml
  let told = null; // the bodies of the page that were last said
  let used = null; // those that a file was fitted with
  let shown = null; // the fit
  let scaled = false; // whether residuals are in standard deviations
  let asking = null;
  let ticking = 0;

  function build() {
    const published = Carom.config.datasets.map(({ name, title }) => make("option", { value: name, title }, name));
    parts.data = make("select", { id: "data" }, new Option("none", ""), ...published);
    parts.input = make("input", { id: "upload", type: "file", accept: ".csv,.txt,.tsv,.dat,.xlsx,.ods,.toml,text/csv,text/plain", hidden: true });
    parts.button = make("button", { id: "upload-button", type: "button" }, "Choose or drop a file");
    parts.drop = make("div", { id: "drop" }, parts.button, parts.input);
    const template = make("a", { id: "template", className: "carom-button", download: "template.csv", href: Carom.source.file("template.csv") }, "Empty table to fill in");
    parts.progress = make("p", { id: "fit-progress", role: "status" });
    parts.notice = make("p", { id: "fit-notice", className: "carom-notice", role: "alert" });
    parts.question = make("div", { id: "fit-ask", hidden: true });
    parts.lists = make("div", {});
    parts.fit = make("div", { id: "fit" });
    const label = make("label", { htmlFor: "data" }, "Published measurements");
    const words = make("p", { className: "carom-note" }, "Friction, stiffness ratio and restitution from a table of measured rebounds, one impact a row.");
    const row = make("div", { className: "carom-fit-source" }, label, parts.data, make("span", { className: "carom-note" }, "or your own"), parts.drop, template, parts.progress);
    panel.replaceChildren(words, row, parts.notice, parts.question, parts.lists, parts.fit);
    listen();
  }

  function listen() {
    parts.data.addEventListener("change", () => parts.data.value !== "" || !file ? ask() : null);
    parts.button.addEventListener("click", () => parts.input.click());
    parts.input.addEventListener("change", () => {
      take(parts.input.files[0]);
      parts.input.value = ""; // so that the same file can be taken again
    });
    for (const kind of ["dragover", "dragleave", "drop"]) {
      parts.drop.addEventListener(kind, (event) => {
        event.preventDefault();
        parts.drop.classList.toggle("carom-over", kind === "dragover");
        if (kind === "drop") take(event.dataTransfer.files[0]);
      });
    }
    Carom.fields.hear(changed);
    Carom.theme.hear(draw);
    new ResizeObserver(draw).observe(parts.fit);
  }

  async function take(chosen) {
    if (!chosen) return;
    list();
    if (chosen.size > LARGEST) {
      clear();
      return complain({ message: `${chosen.name} has ${chosen.size} bytes; it must have at most ${LARGEST}. Leave out what is not needed.` });
    }
    const isMap = /\.toml$/i.test(chosen.name);
    const contents = await new Promise((done, fail) => {
      const reader = new FileReader();
      reader.onload = () => done(reader.result);
      reader.onerror = () => fail(reader.error);
      if (isMap) reader.readAsText(chosen);
      else reader.readAsDataURL(chosen);
    }).catch(() => null);
    if (contents === null) return complain({ message: `${chosen.name} could not be read; choose it again.` });
    if (isMap || file) columns = isMap ? contents : ""; // what was said is of one file, but a map may come first
    if (isMap && !file) return complain({ message: `${chosen.name} is here; now choose the table whose columns it names.` });
    if (!isMap) [file, told] = [{ name: chosen.name, contents }, null];
    if (parts.data.value) {
      parts.data.value = "";
      parts.data.dispatchEvent(new Event("change", { bubbles: true })); // the link forgets the data set
    }
    ask(told);
  }

  // The bodies of the page as words of a link, null if psi_1 and chi are given instead.
  function bodies() {
    if (Carom.fields.value("given") === "numbers") return null;
    const now = Carom.fields.query();
    const link = new URLSearchParams({ given: "bodies" });
    BODIES.filter((name) => now.has(name)).forEach((name) => link.set(name, now.get(name)));
    return link.toString();
  }

  function inWords() {
    const { value, withUnit } = Carom.fields;
    const long = (name) => `${withUnit(name, value(name))} radius`;
    const of = (name) => (value(name) === "own" ? "your own material" : value(name));
    const against = document.getElementById("against").selectedOptions[0].text;
    const sized = value("against") === "half-space" ? Carom.fields.plate(value) : ` of ${long("second_radius")}`;
    return `ball of ${long("radius")}, ${of("material")}; on a ${against}${sized}, ${of("second_material")}`;
  }

  // Fit the data set that is chosen, else the file; with the bodies of the page if these are said.
  async function ask(said = null) {
    const name = parts.data.value;
    if (name) {
      file = null;
      columns = "";
      list();
    }
    told = said;
    clear();
    if (!name && !file) return;
    const request = name ? { data: name } : { ...file, bodies: said ?? "", columns };
    asking = new AbortController();
    const mine = asking;
    progress();
    try {
      const answer = await Carom.source.fit(request, mine.signal);
      if (mine !== asking) return;
      if (answer.asks) askBodies(answer);
      else show(answer, name ? null : said);
    } catch (error) {
      if (mine === asking && error.name !== "AbortError") complain(error);
    } finally {
      if (mine === asking) rest();
    }
  }

  // Ask again with what the lists say.
  function again(said) {
    columns = parts.lists.firstChild?.said() ?? columns;
    ask(said);
  }

  function list(lists = null, open = false) {
    const held = parts.lists.contains(document.activeElement);
    parts.lists.replaceChildren(...(lists ? [Carom.fitColumns.build(lists, open, () => again(told))] : []));
    if (held) parts.lists.querySelector("summary")?.focus();
  }

  function clear() {
    asking?.abort();
    asking = null;
    rest();
    shown = used = null;
    parts.notice.textContent = "";
    parts.question.hidden = true;
    parts.fit.replaceChildren();
  }

  function progress() {
    const begin = performance.now();
    const tell = () => {
      const seconds = Math.floor((performance.now() - begin) / 1000);
      parts.progress.textContent = seconds ? `Fitting … ${seconds} s` : "Fitting …";
    };
    tell();
    ticking = window.setInterval(tell, 1000);
  }

  function rest() {
    window.clearInterval(ticking);
    parts.progress.textContent = "";
  }

  function complain({ field, message, lists }) {
    if (lists) list(lists, true);
    const label = field && Carom.fields.label(field);
    parts.notice.textContent = label ? `${label}: ${message}` : message;
    parts.notice.scrollIntoView({ block: "nearest" });
  }

  function askBodies({ message, lists }) {
    list(lists, true);
    parts.question.hidden = false;
    parts.question.waits = message;
    rewrite();
  }

  function rewrite() {
    const own = bodies();
    const use = make("button", { id: "fit-bodies", type: "button", onclick: () => again(bodies()) }, `Use the bodies of the page: ${own ? inWords() : ""}`);
    const other = make("p", { className: "carom-note" }, own
      ? "Or choose others in the controls first, or write them into the file as the empty table shows."
      : "Choose bodies in the controls first, instead of ψ₁ and χ, or write them into the file as the empty table shows.");
    parts.question.replaceChildren(make("p", {}, parts.question.waits), ...(own ? [use] : []), other);
  }

  // A fit stays as it is when the bodies change, until the reader wants another.
  function changed() {
    if (!parts.question) return; // not built, or of a copy without fits
    if (!parts.question.hidden && parts.question.waits) return rewrite();
    const now = bodies();
    const differs = used !== null && now !== null && now !== used;
    parts.question.hidden = !differs;
    if (!differs || document.getElementById("fit-again")) return;
    const button = make("button", { id: "fit-again", type: "button", onclick: () => again(bodies()) }, "Fit again");
    parts.question.replaceChildren(make("p", {}, "The bodies have changed: "), button);
    parts.question.waits = "";
  }

  function show(fit, said) {
    shown = fit;
    list(fit.lists);
    used = fit.bodies.from === "page" ? said : null;
    const words = (name, children) => make("div", { className: `carom-fit-words ${name}` }, ...children);
    parts.keys = make("div", { className: "carom-keys" });
    const key = make("div", { className: "carom-fit-key" }, parts.keys, residualChoice());
    const charts = make("div", { className: "carom-fit-right" }, key, make("div", { className: "carom-fit-charts" }, ...fit.charts.map(cell)));
    const view = [words("carom-beside", Carom.fitTables.beside(fit)), charts, words("carom-below", Carom.fitTables.below(fit))];
    parts.fit.replaceChildren(Carom.fitTables.head(fit), make("div", { className: "carom-fit-view" }, ...view));
    draw();
  }

  function residualChoice() {
    const select = make("select", { id: "fit-residuals" }, new Option("in the unit of the response", ""), new Option("in standard deviations", "1"));
    select.value = scaled ? "1" : "";
    select.addEventListener("change", () => ((scaled = select.value === "1"), draw()));
    return make("p", { className: "carom-residuals" }, make("label", { htmlFor: select.id }, "Residuals "), select);
  }

  function cell(chart) {
    const title = make("h3", { title: chart.meaning }, chart.response[0].toUpperCase() + chart.response.slice(1));
    return make("section", { className: "carom-cell" }, title, make("div", { className: "carom-chart carom-fit-curve" }), make("div", { className: "carom-chart carom-fit-residual" }));
  }

  async function draw() {
    if (!shown || !parts.fit.clientWidth) return; // in a tab that is not shown
    const mine = shown;
    await Carom.plotting.load();
    if (mine !== shown) return;
    Carom.keys.show(parts.keys, Carom.fitCharts.keys(shown.charts[0]));
    parts.fit.querySelectorAll(".carom-cell").forEach((box, row) => {
      const [curve, residual] = box.querySelectorAll(".carom-chart");
      Carom.plotting.draw(curve, Carom.fitCharts.curve(shown.charts[row]));
      Carom.plotting.draw(residual, Carom.fitCharts.residuals(shown.charts[row], scaled));
    });
  }

  // Choose a data set as a link says; one that is not there is none.
  function choose(name) {
    if (!parts.data || parts.data.value === name) return;
    parts.data.value = name;
    if (parts.data.selectedIndex < 0) parts.data.value = "";
    ask();
  }

  return { build, choose, chosen: () => parts.data?.value ?? "", changed };
})();
