// A second impact beside the one that the controls set: kept as its query, and answered likewise.
window.Carom = window.Carom || {};

Carom.beside = (() => {
  const box = (id) => document.getElementById(id);
  let query = null; // null: there is none; "" is the impact as the page opens
  let answer = null;
  let heard = () => {};

  // Keep an impact beside; its contact laws stay with the other.
  function put(words) {
    query = words === null ? null : new URLSearchParams(words);
    if (query) ["law", "data"].forEach((name) => query.delete(name));
    answer = null;
    box("compare").textContent = query ? "Remove the other" : "Set beside another";
    box("swap").hidden = !query;
    box("compared").textContent = query ? `Beside: ${Carom.fields.words(query)}` : "";
    document.body.classList.toggle("carom-two", Boolean(query));
    for (const id of ["stage-beside", "patch-beside"]) box(id).hidden = !query;
  }

  async function answered() {
    if (query && !answer) answer = await Carom.source.answer(query.toString());
    return answer;
  }

  function build(hear) {
    heard = hear;
    box("compare").addEventListener("click", () => {
      put(query ? null : Carom.fields.query());
      heard();
    });
    box("swap").addEventListener("click", () => {
      const other = query;
      const laws = Carom.laws.chosen();
      put(Carom.fields.query());
      Carom.fields.set(other);
      Carom.laws.choose(laws);
      heard();
    });
  }

  return { build, put, answered, query: () => (query ? query.toString() : null) };
})();
