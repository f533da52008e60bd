// The lines of Python of what the page shows: the server's file of them, soon after a change.
window.Carom = window.Carom || {};

Carom.code = (() => {
  const WAIT = 200; // ms without a change
  let waiting = 0;
  let shown = null; // the query whose lines are there
  let asking = null;

  async function ask(query) {
    if (asking) asking.abort();
    asking = new AbortController();
    try {
      const answer = await fetch(`view.py?${query}`, { signal: asking.signal });
      const text = await answer.text();
      const place = document.getElementById("code");
      if (!place || !answer.ok) return;
      place.textContent = text;
      shown = query;
    } catch {
      // the server is gone or a newer question is on its way: the lines stay
    }
  }

  function show(query) {
    if (!document.getElementById("code")) return;
    window.clearTimeout(waiting);
    if (asking) asking.abort();
    if (query === shown) return;
    waiting = window.setTimeout(() => ask(query), WAIT);
  }

  return { show };
})();
