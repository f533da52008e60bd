// The words of a link as the numbers of an impact: what is set is checked here alone.

Carom.reading = (() => {
  const PLAIN = /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?/i;
  const LONGEST = 40; // characters of a wrong word that are shown
  const PARTS = ["young", "poisson", "density"];
  const [GIGA, MILLI] = [1e9, 1e-3];
  const KEPT = 16; // answers that are remembered
  const { fields, materials, page_only: OWN, longest_link: LONGEST_LINK } = Carom.config;
  const kept = new Map();

  function refuse(field, message) {
    throw { field, message };
  }

  // A number of a field, with or without the unit of the field; other units are read elsewhere.
  async function number(name, text) {
    const { least, most, unit, otherwise } = fields[name];
    const trimmed = text.trim();
    if (otherwise && ["", otherwise].includes(trimmed)) return Infinity;
    const allowed = `must be a number from ${least} to ${most}${unit && ` ${unit}`}${otherwise && `, or ${otherwise}`}`;
    if (!trimmed) refuse(name, `${allowed}; it is empty`);
    const [digits] = PLAIN.exec(trimmed) || [""];
    if (!digits || !["", unit].includes(trimmed.slice(digits.length).trim())) return Carom.source.number(name, text, allowed);
    const value = Number(digits);
    if (!(value >= least && value <= most)) refuse(name, `${allowed}, not '${text.slice(0, LONGEST)}'`);
    return value;
  }

  function choice(name, text) {
    const words = (fields[name].choices || []).map(([value]) => String(value));
    if (words.length && !words.includes(text)) refuse(name, `there is no '${text.slice(0, LONGEST)}'; there are ${words.filter(Boolean).join("; ")}`);
    return text;
  }

  // The view of a query: a value for every field; of those that do not matter the usual one, if wrong.
  async function view(query) {
    if (query.length > LONGEST_LINK) refuse("", `the link has ${query.length} characters; at most ${LONGEST_LINK} are read`);
    const words = new URLSearchParams(query);
    for (const name of words.keys()) {
      if (!(name in fields || OWN.includes(name))) refuse("", `the link says '${name.slice(0, LONGEST)}', which is unknown; leave it out`);
    }
    const of = (name) => words.getAll(name).at(-1) ?? String(fields[name].default);
    const values = {};
    const laws = new Set(words.getAll("law").filter(Boolean));
    for (const name of new Set([...words.keys(), ...Object.keys(fields)])) {
      if (OWN.includes(name)) continue;
      try {
        if (name === "law") values.law = [...laws].map((label) => choice("law", label));
        else values[name] = fields[name].least === null ? choice(name, of(name)) : await number(name, of(name));
      } catch (refusal) {
        if (Carom.fields.counts(name, of)) throw refusal;
        values[name] = await number(name, String(fields[name].default)).catch(() => fields[name].default);
      }
    }
    return values;
  }

  // The query of what differs from the page as it opens.
  function canonical(values) {
    const words = new URLSearchParams();
    for (const name of Object.keys(fields)) {
      const value = values[name];
      if (name === "law") value.forEach((label) => words.append("law", label));
      else if (String(value) !== String(fields[name].default) && value !== Infinity) words.set(name, value);
    }
    return words.toString();
  }

  function material(values, which) {
    const name = values[`${which}material`];
    if (name === "own") {
      const [young, poisson, density] = PARTS.map((part) => values[which + part]);
      return { young: young * GIGA, poisson, density };
    }
    const { young, poisson, density } = materials[name] || { young: null, poisson: 0, density: null };
    return { young: young ?? Infinity, poisson, density };
  }

  // The bodies of a view.
  function pair(values) {
    const { against, radius, second_radius: other, second_material: stuff, friction, restitution } = values;
    const onPlate = against === "half-space" && values.thickness !== Infinity;
    if (against === "cup" && !(other > radius)) refuse("second_radius", `must be above ${radius} mm: the ball has to fit into the cup`);
    if (against === "sphere" && stuff === "rigid") refuse("second_material", "a ball that moves must have a density, which a rigid one has not; take another");
    if (onPlate && stuff === "rigid") refuse("second_material", "a rigid plate gives no way; take another");
    if (onPlate && restitution !== 1) refuse("restitution", "must be 1 on a plate: the bodies are elastic so far");
    return Carom.pair.of({
      against,
      friction,
      radius: radius * MILLI,
      material: material(values, ""),
      otherRadius: other * MILLI,
      otherMaterial: material(values, "second_"),
      thickness: onPlate ? values.thickness * MILLI : Infinity,
    });
  }

  const damped = (label) => Carom.config.laws.some((law) => law.label === label && law.damped);

  async function answered(query) {
    await Carom.solver.ready;
    const values = await view(query);
    const answer = Carom.answer.of(values);
    const undamped = values.law.filter((label) => answer.lossy && !damped(label));
    const late = values.law.filter((label) => !undamped.includes(label));
    return { query: canonical(values), ...answer, undamped, late, laws: [], slow: [], findings: values.given === "numbers" ? [] : null, unjudged: "" };
  }

  // The answer to a query, or a refusal {field, message}.
  function answer(query) {
    const words = new URLSearchParams(query);
    words.sort();
    const key = words.toString();
    if (!kept.has(key)) {
      kept.set(key, answered(query));
      kept.get(key).catch(() => kept.delete(key)); // a program that is lost may be there again
    }
    if (kept.size > KEPT) kept.delete(kept.keys().next().value);
    return kept.get(key);
  }

  return { answer, pair };
})();
