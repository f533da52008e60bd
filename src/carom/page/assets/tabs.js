// Charts, measurements, files, Python: one panel at a time.

Carom.tabs = (() => {
  const list = document.getElementById("tabs");
  const panels = [...document.querySelectorAll("[data-tab]")];
  const heard = [];
  let chosen = panels[0].dataset.tab;

  function build() {
    panels.forEach((panel) => {
      const tab = Carom.elements.make("button", { type: "button", id: `tab-${panel.id}`, role: "tab" }, panel.dataset.tab);
      tab.setAttribute("aria-controls", panel.id);
      panel.role = "tabpanel";
      panel.setAttribute("aria-labelledby", tab.id);
      tab.addEventListener("click", () => choose(panel.dataset.tab));
      list.append(tab);
    });
    list.addEventListener("keydown", step);
    show();
  }

  function step(event) {
    const by = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    if (!by) return;
    const row = panels.findIndex((panel) => panel.dataset.tab === chosen);
    choose(panels[(row + by + panels.length) % panels.length].dataset.tab);
    list.children[(row + by + panels.length) % panels.length].focus();
  }

  function show() {
    list.hidden = panels.length === 1;
    panels.forEach((panel, row) => {
      const is = panel.dataset.tab === chosen;
      panel.hidden = !is;
      list.children[row].setAttribute("aria-selected", is);
      list.children[row].tabIndex = is ? 0 : -1;
    });
  }

  function choose(name) {
    if (!panels.some((panel) => panel.dataset.tab === name) || name === chosen) return;
    chosen = name;
    show();
    heard.forEach((hear) => hear(name));
  }

  build();
  return { choose, chosen: () => chosen, first: panels[0].dataset.tab, hear: (listener) => heard.push(listener) };
})();
