// A second impact beside the one that the controls set: kept as its query, and answered likewise.

Carom.beside = (() => {
  const box = (id) => document.getElementById(id);
  let query = null; // null: there is none; "" is the impact as the page opens
  let example = ""; // of which it is
  let answer = null;
  let heard = () => {};

  // Keep an impact beside; its contact laws stay with the other.
  function put(words, preset = "") {
    example = preset;
    query = words === null ? null : new URLSearchParams(words);
    if (query) ["law", "data"].forEach((name) => query.delete(name));
    answer = null;
    box("compare").textContent = query ? "Remove the other" : "Set beside another";
    box("swap").hidden = !query;
    box("compared").textContent = query ? `Beside: ${Carom.fields.words(query)}` : "";
    document.body.classList.toggle("carom-two", Boolean(query));
    for (const id of ["stage-beside", "patch-beside"]) box(id).hidden = !query;
  }

  // Its answer, null without one; what is refused is no longer beside.
  async function answered() {
    const mine = query;
    if (!mine || answer) return answer;
    try {
      const latest = await Carom.reading.answer(mine.toString());
      if (mine === query) answer = latest; // it may be another by now
    } catch (refusal) {
      if (mine === query) put(null);
      throw { field: refusal.field, message: refusal.message, beside: true };
    }
    return answer;
  }

  function build(hear) {
    heard = hear;
    box("compare").addEventListener("click", () => {
      if (query) put(null);
      else put(Carom.fields.query(), Carom.presets.chosen());
      heard();
    });
    box("swap").addEventListener("click", () => {
      const [other, story] = [query, example];
      const laws = Carom.laws.chosen();
      put(Carom.fields.query(), Carom.presets.chosen());
      Carom.presets.choose(story);
      Carom.fields.set(other);
      Carom.laws.choose(laws);
      heard();
    });
  }

  return { build, put, answered, query: () => (query ? query.toString() : null) };
})();
