// Examples with a story: a choice sets the controls and tells what there is to see.

Carom.presets = (() => {
  const NONE = "";
  const { make } = Carom.elements;
  const select = document.getElementById("preset");
  const place = document.getElementById("story");
  const heard = [];
  const presetOf = (id) => Carom.config.presets.find((preset) => preset.id === id);

  function build() {
    select.append(new Option("choose …", NONE));
    Carom.config.presets.forEach(({ id, title }) => select.append(new Option(title, id)));
    const starters = Carom.config.presets.filter(({ short }) => short);
    const buttons = starters.map(({ id, short }) => make("button", { type: "button", onclick: () => start(id) }, short));
    document.getElementById("starters").append(...buttons);
    select.addEventListener("change", () => {
      tell();
      const preset = presetOf(select.value);
      if (preset) heard.forEach((hear) => hear(new URLSearchParams(preset.query)));
      else Carom.link.refresh();
    });
  }

  function start(id) {
    select.value = id;
    select.dispatchEvent(new Event("change"));
  }

  function tell() {
    const preset = presetOf(select.value);
    place.hidden = !preset;
    if (!preset) return;
    const { title, story, caution, sources } = preset;
    const stretched = caution ? [make("p", "carom-caution", caution)] : [];
    const from = sources.map((source) => make("p", {}, source));
    const fold = make("details", {}, make("summary", {}, "Where the numbers are from"), ...from);
    const head = make("summary", {}, make("h2", {}, title));
    place.replaceChildren(make("details", { open: Carom.level.isFull() }, head, make("p", {}, story), ...stretched, fold));
  }

  // Show a story; return the query that it sets, as a link may hold other words.
  function choose(id) {
    const preset = presetOf(id);
    select.value = preset ? id : NONE;
    tell();
    return new URLSearchParams(preset ? preset.query : "");
  }

  return { build, choose, chosen: () => select.value, hear: (listener) => heard.push(listener) };
})();
