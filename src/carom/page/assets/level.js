// Two levels: first the ball and what it does, in words; then all numbers, symbols, charts and laws.

Carom.level = (() => {
  const [FIRST, FULL] = ["first", "full"];
  const OF_FULL = ["tab", "beside", "law", "data", "slow"]; // words of a link that the first level has not
  const button = document.getElementById("level");
  const heard = [];
  let chosen = FIRST;

  function choose(level) {
    chosen = level === FULL ? FULL : FIRST;
    document.body.dataset.level = chosen;
    button.textContent = chosen === FULL ? "Simple view" : "Show everything";
    heard.forEach((hear) => hear(chosen));
  }

  // The level of a link: what it says, or what it needs.
  function asked(link) {
    if (link.has("level") || link.has("story")) return link.get("level");
    return OF_FULL.some((name) => link.has(name)) || link.get("given") === "numbers" ? FULL : FIRST;
  }

  button.addEventListener("click", () => choose(chosen === FULL ? FIRST : FULL));
  return { choose, asked, isFull: () => chosen === FULL, hear: (listener) => heard.push(listener) };
})();
