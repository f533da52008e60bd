// Symbols explained where one points at them, by mouse, key or finger.

Carom.tips = (() => {
  const GAP = 6; // pixels between a symbol and what is said of it
  const { make } = Carom.elements;
  const box = document.getElementById("tip");

  // A symbol of the page's text; of V_y the index stands below.
  function symbol(name) {
    const [letter, index] = name.split("_");
    const element = make("abbr", {}, letter, ...(index ? [make("sub", {}, index)] : []));
    element.dataset.symbol = name;
    return ready(element);
  }

  function ready(element) {
    if (Carom.config.symbols[element.dataset.symbol]) element.tabIndex = 0;
    return element;
  }

  function show(element) {
    const words = Carom.config.symbols[element.dataset.symbol];
    if (!words) return;
    box.textContent = words;
    box.hidden = false;
    element.setAttribute("aria-describedby", "tip");
    const at = element.getBoundingClientRect();
    const { width, height } = box.getBoundingClientRect();
    const below = at.bottom + GAP + height < window.innerHeight;
    box.style.left = `${Math.max(GAP, Math.min(at.left, window.innerWidth - width - GAP))}px`;
    box.style.top = `${below ? at.bottom + GAP : at.top - height - GAP}px`;
  }

  const hide = () => (box.hidden = true);

  function of(event) {
    return event.target instanceof Element && event.target.closest("[data-symbol]");
  }

  for (const kind of ["pointerover", "focusin", "pointerdown"]) {
    document.addEventListener(kind, (event) => (of(event) ? show(of(event)) : hide()));
  }
  document.addEventListener("keydown", (event) => event.key === "Escape" && hide());
  document.addEventListener("scroll", hide, { capture: true, passive: true });
  document.querySelectorAll("[data-symbol]").forEach(ready);

  return { symbol };
})();
