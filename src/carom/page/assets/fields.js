// What the reader sets: numbers with sliders, choices; together they are the query of a link.

Carom.fields = (() => {
  const { make } = Carom.elements;
  const { fields: described } = Carom.config;
  const OF_MATERIAL = ["young", "poisson", "density"];
  const material = (which) => [`${which}material`, ...OF_MATERIAL.map((name) => which + name)];
  const GROUPS = {
    given: ["given"],
    numbers: ["psi", "chi"],
    motion: ["angle", "speed", "spin", "friction", "restitution", "inelasticity"],
    bodies: ["radius", ...material(""), "against", "second_radius", ...material("second_"), "thickness"],
  };
  const PLAIN = /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i; // what a slider can follow
  const heard = [];
  let alone = ""; // the one field of a step of a story
  const box = (name) => document.getElementById(name);

  // What a field is called in the first level: between balls spin has no back and no top.
  function plainOf(name) {
    const { plain, of_balls: between } = described[name] ?? {};
    return (between && box("against")?.value === "sphere" && between) || plain;
  }

  function labelOf(name) {
    const { label, symbol, plain } = described[name];
    const sign = symbol ? [" ", Carom.tips.symbol(symbol)] : [];
    const full = make("span", plain ? "carom-full" : "", label, ...sign);
    const words = plain ? [full, make("span", "carom-first", plain)] : [full];
    return make("label", { htmlFor: name, title: described[name].hint }, ...words);
  }

  function number(name) {
    const { slider, label, plain, unit } = described[name];
    // of type "number" a browser drops what it does not know, and 1,5 becomes 15
    const typed = make("input", { id: name, type: "text", autocomplete: "off" });
    const parts = [labelOf(name), typed, make("span", { className: "carom-unit", textContent: unit })];
    if (slider) {
      const [min, max, step] = slider;
      parts.push(make("input", { id: `${name}-slider`, type: "range", min, max, step, ariaLabel: `${plain || label}, slider` }));
    }
    return parts;
  }

  function choice(name) {
    const options = described[name].choices.map(([value, text]) => new Option(text, value));
    return [labelOf(name), make("select", { id: name }, ...options)];
  }

  function build() {
    for (const [group, names] of Object.entries(GROUPS)) {
      const parts = names.filter((name) => described[name]).map((name) => {
        const wrong = make("p", { id: `${name}-wrong`, className: "carom-wrong", hidden: true });
        const control = described[name].choices ? choice(name) : number(name);
        return make("div", { id: `${name}-field`, className: "carom-field" }, ...control, wrong);
      });
      box("fields").append(make("div", { id: `${group}-fields`, className: "carom-group" }, ...parts));
    }
    box("fields").addEventListener("input", (event) => moved(event.target));
    set(new URLSearchParams());
  }

  function moved(element) {
    const name = element.id.replace(/-slider$/, "");
    if (element.id !== name) box(name).value = (element.value === element.max && described[name].otherwise) || element.value;
    follow(name);
    hide();
    heard.forEach((hear) => hear(name));
  }

  // Set some numbers at once, by hand.
  function move(values) {
    for (const [name, text] of Object.entries(values)) put(name, text);
    heard.forEach((hear) => hear(Object.keys(values)[0]));
  }

  // A number moves its slider, as far as that goes.
  function follow(name) {
    const slider = box(`${name}-slider`);
    const { otherwise } = described[name];
    const typed = box(name).value.trim();
    const text = otherwise && ["", otherwise].includes(typed) ? slider?.max : typed;
    if (slider && document.activeElement !== slider && PLAIN.test(text)) slider.value = text;
  }

  // Whether a field matters, where the others have these words.
  const counts = (name, word) => Object.entries(described[name].needs).every(([other, words]) => words.includes(word(other)));

  // Show one field alone, its slider over a range of its own; "" shows all again.
  function only(name, range) {
    const ends = ([min, max, step]) => ({ min, max, step });
    const slider = (field) => Object.assign(box(`${field}-slider`), ends((field === name && range) || described[field].slider));
    names().filter((field) => described[field].slider).forEach((field) => (slider(field), follow(field)));
    alone = name;
    hide();
  }

  // What is not given, or not there, is not asked for.
  function hide() {
    const plain = (name) => described[name].plain || value("given") === "numbers";
    const first = (name) => (alone ? name === alone : plain(name));
    const shown = (name) => counts(name, value) && (Carom.level.isFull() || first(name));
    for (const name of names()) box(`${name}-field`).hidden = !shown(name);
    names().filter((name) => described[name].of_balls).forEach(rename);
    for (const group of ["numbers", "bodies"]) box(`${group}-fields`).hidden = value("given") !== group;
  }

  function rename(name) {
    box(`${name}-field`).querySelector("label .carom-first").textContent = plainOf(name);
    box(`${name}-slider`).ariaLabel = `${plainOf(name)}, slider`;
  }

  const names = () => Object.values(GROUPS).flat().filter((name) => described[name]);
  const value = (name) => box(name).value;

  function put(name, text) {
    box(name).value = text;
    follow(name);
  }

  // Set a field to what it is as the page opens; tell whether that changed it.
  function reset(name) {
    const first = names().includes(name) ? String(described[name].default) : null;
    if (first === null || value(name) === first) return false;
    put(name, first);
    return true;
  }

  // A number as it was typed, with the unit of its field unless it has its own.
  const withUnit = (name, text) => (PLAIN.test(text.trim()) ? `${text} ${described[name].unit}` : text).trim();

  // The query of what differs from the page as it opens.
  function query() {
    const words = new URLSearchParams();
    for (const name of names()) {
      if (value(name) !== String(described[name].default)) words.set(name, value(name));
    }
    Carom.laws.chosen().forEach((label) => words.append("law", label));
    if (Carom.fit.chosen()) words.set("data", Carom.fit.chosen());
    return words;
  }

  // Set all to what a query says; return what of it the page does not know, each in a line.
  function set(link) {
    const odd = [];
    for (const name of new Set(link.keys())) {
      if (!described[name] && !["law", "data"].includes(name)) odd.push(`${name}: no word of a link`);
    }
    for (const name of names()) {
      const first = String(described[name].default);
      put(name, link.get(name) ?? first);
      if (link.has(name) && value(name) !== link.get(name)) {
        odd.push(`${described[name].label}: there is no ${link.get(name)}, and ${first} is shown`);
        put(name, first);
      }
    }
    const laws = link.getAll("law");
    const there = laws.filter((label) => Carom.config.laws.some((law) => law.label === label));
    laws.filter((label) => !there.includes(label)).forEach((label) => odd.push(`Contact law: there is no ${label}`));
    Carom.laws.choose(there);
    const data = link.get("data") ?? "";
    const has = !data || (Carom.source.live && Carom.config.datasets.some(({ name }) => name === data));
    if (!has) odd.push(`${described.data.label}: ${Carom.source.live ? `there is no ${data}` : "not fitted in this copy"}`);
    Carom.fit.choose(has ? data : "");
    Carom.fit.changed();
    hide();
    complain("", "");
    return odd;
  }

  // Say of a field what is wrong with it; of all others that nothing is.
  function complain(field, message) {
    for (const name of names()) {
      const wrong = box(`${name}-wrong`);
      wrong.textContent = name === field ? message : "";
      wrong.hidden = name !== field;
      box(name).setAttribute("aria-invalid", name === field);
      if (name === field) box(name).setAttribute("aria-describedby", wrong.id);
      else box(name).removeAttribute("aria-describedby");
    }
  }

  // The thickness of a plate in words, where these are the words of the fields; "" of a thick wall.
  function plate(of) {
    const thick = ["", String(described.thickness.default)].includes(of("thickness").trim());
    return thick || !counts("thickness", of) ? "" : ` ${withUnit("thickness", of("thickness"))} thick`;
  }

  // The bodies and their motion in words, to tell two impacts apart.
  function words(link) {
    const of = (name) => link.get(name) ?? String(described[name].default);
    if (of("given") === "numbers") {
      const gives = Number(of("inelasticity")) ? `, λ = ${of("inelasticity")}` : "";
      return `ψ₁ = ${of("psi")}, χ = ${of("chi")}${gives}`;
    }
    return `${of("material")} on ${of("second_material")}${plate(of)}, ${withUnit("angle", of("angle"))}, µ = ${of("friction")}`;
  }

  return {
    build,
    hide,
    only,
    counts,
    query,
    set,
    put,
    move,
    value,
    complain,
    words,
    plate,
    label: (name) => (!Carom.level.isFull() && plainOf(name)) || (described[name]?.label ?? ""),
    reset,
    withUnit,
    hear: (listener) => heard.push(listener),
  };
})();
