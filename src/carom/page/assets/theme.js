// Light or dark, by choice or as the system is; colours for what is drawn on a canvas.

Carom.theme = (() => {
  const CHOICES = ["auto", "light", "dark"];
  const system = window.matchMedia("(prefers-color-scheme: dark)");
  const heard = [];
  let choice = "auto";
  let colors = null;

  const shown = () => (choice === "auto" ? (system.matches ? "dark" : "light") : choice);

  function choose(name) {
    choice = CHOICES.includes(name) ? name : "auto";
    apply();
  }

  function apply() {
    document.documentElement.dataset.theme = shown();
    colors = null;
    document.getElementById("theme").textContent = `Theme: ${choice}`;
    heard.forEach((hear) => hear(choice));
  }

  // The value of a CSS variable, each read once per theme.
  function color(name) {
    if (!colors) colors = { style: getComputedStyle(document.documentElement), read: {} };
    const { style, read } = colors;
    return (read[name] = read[name] || style.getPropertyValue(`--${name}`).trim());
  }

  system.addEventListener("change", apply);
  choose(new URLSearchParams(window.location.search).get("theme"));

  return {
    choose,
    next: () => choose(CHOICES[(CHOICES.indexOf(choice) + 1) % CHOICES.length]),
    choice: () => choice,
    hear: (listener) => heard.push(listener),
    color,
  };
})();
