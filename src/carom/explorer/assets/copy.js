// Answers of the copy of the page that runs without a server: from tables and springs, in the browser.

Carom.source = (() => {
  const PROGRAM = "install Carom with its extra \"explore\", then run carom explore";
  const MORE = `The program takes others: ${PROGRAM}.`;
  const WHY = `This copy of the page runs in the browser alone and cannot do this. The program can: ${PROGRAM}.`;
  const NUMBER = /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?/i;
  const LONGEST = 40; // characters of a wrong number that are shown
  const PARTS = ["young", "poisson", "density"];
  const GIGA = 1e9;
  const KEPT = 16; // answers that are remembered
  const { fields, materials, page_only: OWN, longest_link: LONGEST_LINK } = Carom.config;
  const kept = new Map();

  function refuse(field, message) {
    throw { field, message };
  }

  // One word of a link as the field of the page takes it.
  function word(name, text) {
    const { least, most, unit, choices } = fields[name];
    if (least === null) {
      const words = (choices || []).map(([value]) => String(value));
      if (choices && !words.includes(text)) refuse(name, `there is no '${text.slice(0, LONGEST)}'; there are ${words.join("; ")}`);
      return text;
    }
    const allowed = `must be a number from ${least} to ${most}${unit && ` ${unit}`}`;
    const trimmed = text.trim();
    if (!trimmed) refuse(name, `${allowed}; it is empty`);
    const [digits] = NUMBER.exec(trimmed) || [""];
    const rest = trimmed.slice(digits.length).trim();
    const value = Number(digits);
    const right = digits && (rest === "" || rest === unit) && value >= least && value <= most;
    const foreign = digits && /^\p{L}/u.test(rest) && rest !== unit;
    const units = foreign ? `; this copy takes ${unit || "no unit"} only` : "";
    if (!right) refuse(name, `${allowed}, not '${text.slice(0, LONGEST)}'${units}`);
    return value;
  }

  // The view of a query: a value for every field.
  function viewOf(query) {
    if (query.length > LONGEST_LINK) refuse("", `the link has ${query.length} characters; at most ${LONGEST_LINK} are read`);
    const words = new URLSearchParams(query);
    for (const name of words.keys()) {
      if (!(name in fields || OWN.includes(name))) refuse("", `the link says '${name.slice(0, LONGEST)}', which is unknown; leave it out`);
    }
    words.getAll("law").forEach((label) => label && word("law", label));
    const of = (name) => words.getAll(name).at(-1) ?? String(fields[name].default);
    const view = {};
    for (const name of Object.keys(fields)) {
      if (name === "law" || name === "data") continue;
      try {
        view[name] = word(name, of(name));
      } catch (refusal) {
        if (Carom.fields.counts(name, of)) throw refusal;
        view[name] = fields[name].default;
      }
    }
    covered(view);
    return view;
  }

  function covered({ restitution, given, chi, friction }) {
    if (given === "numbers" && !friction) refuse("friction", "must be above 0: without friction there is no ψ₁");
    const tabulated = Object.keys(Carom.tables.losses).map(Number).sort((a, b) => b - a);
    if (!tabulated.includes(restitution)) refuse("restitution", `this copy has ${tabulated.join(", ")} only. ${MORE}`);
    const [least, most] = Carom.tables.chi;
    if (given === "numbers" && !(chi >= least && chi <= most)) refuse("chi", `this copy has ${least} to ${most} only. ${MORE}`);
  }

  // The query of what differs from the page as it opens.
  function canonical(view, query) {
    const words = new URLSearchParams();
    for (const [name, value] of Object.entries(view)) {
      if (String(value) !== String(fields[name].default)) words.set(name, value);
    }
    new URLSearchParams(query).getAll("law").forEach((label) => label && words.append("law", label));
    return words.toString();
  }

  function materialOf(view, which) {
    const name = view[`${which}material`];
    if (name === "own") {
      const [young, poisson, density] = PARTS.map((part) => view[which + part]);
      return { young: young * GIGA, poisson, density };
    }
    const { young, poisson, density } = materials[name] || { young: null, poisson: 0, density: null };
    return { young: young ?? Infinity, poisson, density };
  }

  function pairOf(view) {
    const { against, radius, second_radius: other, friction } = view;
    if (against === "cup" && !(other > radius)) refuse("second_radius", `must be above ${radius} mm: the ball has to fit into the cup`);
    if (against === "sphere" && view.second_material === "rigid") {
      refuse("second_material", "a ball that moves must have a density, which a rigid one has not; take another");
    }
    const [material, otherMaterial] = [materialOf(view, ""), materialOf(view, "second_")];
    const pair = Carom.pair.of({ against, radius: radius * 1e-3, material, otherRadius: other * 1e-3, otherMaterial, friction });
    const [least, most] = Carom.tables.chi;
    if (!(pair.chi >= least && pair.chi <= most)) {
      refuse("", `For these bodies χ = ${Carom.quantities.plain(pair.chi, 4)}; this copy has ${least} to ${most} only. ${MORE}`);
    }
    return pair;
  }

  function answered(query) {
    const view = viewOf(query);
    const answer = view.given === "numbers" ? Carom.answer.ofNumbers(view) : Carom.answer.ofBodies(view, pairOf(view));
    return { query: canonical(view, query), ...answer, laws: [], late: [], undamped: [] };
  }

  async function answer(query) {
    const words = new URLSearchParams(query);
    words.sort();
    const key = words.toString();
    if (!kept.has(key)) kept.set(key, answered(query));
    if (kept.size > KEPT) kept.delete(kept.keys().next().value);
    return kept.get(key);
  }

  const cannot = async () => refuse("", WHY);

  return {
    can: { laws: false, fit: false, files: false, code: false },
    why: WHY,
    answer,
    laws: async () => ({ laws: [], slow: [] }),
    fit: cannot,
    code: cannot,
    written: cannot,
    file: () => null,
  };
})();
