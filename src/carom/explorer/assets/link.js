// The address bar, the link to copy and the downloads: all say what the page shows.
window.Carom = window.Carom || {};

Carom.link = (() => {
  const DOWNLOADS = "a.carom-download, .carom-downloads a";
  const WAIT = 300; // ms between two changes: browsers refuse floods
  let opened = new URLSearchParams(window.location.search);
  let query = null; // what Dash says; null until it has
  let paused = Carom.clock.START; // where the time last stood still
  let waiting = 0;

  // A part of the link that was opened, by loading the page or by going back and forward.
  const part = (name) => opened.get(name);

  function asked(name) {
    const text = part(name);
    return text === null || text.trim() === "" ? NaN : Number(text);
  }

  function whole() {
    const parts = [query];
    if (!Carom.clock.isPlaying()) paused = Carom.clock.now();
    const time = Number(paused.toFixed(3));
    if (time !== Carom.clock.START) parts.push(`time=${time}`);
    if (Carom.clock.pace() !== Carom.clock.PACE) parts.push(`pace=${Carom.clock.pace()}`);
    if (Carom.theme.choice() !== "auto") parts.push(`theme=${Carom.theme.choice()}`);
    return parts.filter(Boolean).join("&");
  }

  function write() {
    window.clearTimeout(waiting);
    waiting = 0;
    if (query === null) return;
    const words = whole();
    const { origin, pathname, search } = window.location;
    if (search !== `?${words}`) window.history.replaceState(null, "", `${pathname}?${words}`);
    const field = document.getElementById("link");
    if (field) field.value = `${origin}${pathname}?${words}`;
    Carom.code.show(words);
    document.querySelectorAll(DOWNLOADS).forEach((anchor) => {
      const path = (anchor.dataset.path || anchor.getAttribute("href") || "").split("?")[0];
      if (path) anchor.setAttribute("href", `${path}?${words}`);
    });
  }

  // Write soon, not while the time runs.
  function refresh() {
    if (!waiting && !Carom.clock.isPlaying()) waiting = window.setTimeout(write, WAIT);
  }

  function put(given) {
    query = String(given || "").replace(/^\?/, "");
    write();
  }

  async function copy() {
    write();
    const field = document.getElementById("link");
    field.focus();
    field.select();
    let done = false;
    try {
      await navigator.clipboard.writeText(field.value);
      done = true;
    } catch {
      done = document.execCommand("copy"); // pages that are not "secure" have no clipboard
    }
    tell(done ? "Link copied" : "Press Ctrl+C to copy the link");
  }

  function tell(text) {
    const place = document.getElementById("copied");
    if (!place) return;
    place.textContent = text;
    window.setTimeout(() => place.textContent === text && (place.textContent = ""), 4000);
  }

  window.addEventListener("popstate", () => (opened = new URLSearchParams(window.location.search)));

  return { whole, DOWNLOADS, part, asked, put, refresh, write, copy };
})();
