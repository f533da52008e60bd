// The lines of Python of what the page shows, once one looks at them.

Carom.code = (() => {
  const WAIT = 200; // ms without a change
  const place = document.getElementById("code");
  let wanted = "";
  let shown = null;
  let waiting = 0;
  let asking = null;

  async function ask() {
    if (asking) asking.abort();
    asking = new AbortController();
    const query = wanted;
    try {
      place.textContent = await Carom.source.code(query, asking.signal);
      shown = query;
    } catch (error) {
      if (error.name !== "AbortError") place.textContent = error.message;
    }
  }

  function show(query = wanted) {
    if (query !== wanted) asking?.abort(); // or its answer would come after this
    wanted = query;
    const seen = Carom.tabs.chosen() === "Python";
    window.clearTimeout(waiting);
    if (seen && wanted !== shown) waiting = window.setTimeout(ask, WAIT);
  }

  Carom.tabs.hear(() => show());
  return { show };
})();
