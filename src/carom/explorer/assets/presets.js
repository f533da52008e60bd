// Examples with a story: a choice sets the controls and tells what there is to see.
window.Carom = window.Carom || {};

Carom.presets = (() => {
  const NONE = "";
  const select = document.getElementById("preset");
  const place = document.getElementById("story");
  const heard = [];
  const found = (id) => Carom.config.presets.find((preset) => preset.id === id);

  function build() {
    select.append(new Option("choose …", NONE));
    Carom.config.presets.forEach(({ id, title }) => select.append(new Option(title, id)));
    select.addEventListener("change", () => {
      tell();
      const preset = found(select.value);
      if (preset) heard.forEach((hear) => hear(new URLSearchParams(preset.query)));
    });
  }

  function paragraph(text, className = "") {
    const element = document.createElement("p");
    Object.assign(element, { textContent: text, className });
    return element;
  }

  function tell() {
    const preset = found(select.value);
    place.hidden = !preset;
    if (!preset) return;
    const title = document.createElement("h2");
    title.textContent = preset.title;
    const sources = document.createElement("details");
    const summary = document.createElement("summary");
    summary.textContent = "Where the numbers are from";
    sources.append(summary, ...preset.sources.map((source) => paragraph(source)));
    place.replaceChildren(title, paragraph(preset.story));
    if (preset.caution) place.append(paragraph(preset.caution, "carom-caution"));
    place.append(sources);
  }

  // Show a story; return the query that it sets, as a link may hold other words.
  function choose(id) {
    const preset = found(id);
    select.value = preset ? id : NONE;
    tell();
    return new URLSearchParams(preset ? preset.query : "");
  }

  return { build, choose, chosen: () => select.value, hear: (listener) => heard.push(listener) };
})();
