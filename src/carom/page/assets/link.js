// The address bar, the link to copy and the files: all say what the page shows.

Carom.link = (() => {
  const FILES = "a.carom-download";
  const WAIT = 300; // ms between two changes: browsers refuse floods
  const { longest_link: LONGEST, page_only: OWN } = Carom.config; // characters; words of the page alone
  let opened = new URLSearchParams(window.location.search);
  let query = null; // of the impact; null until there is one
  let paused = Carom.clock.START; // where the time last stood still
  let waiting = 0;

  // A word of the link that was opened, by loading the page or by going back and forward.
  const part = (name) => opened.get(name);

  function number(name) {
    const text = part(name);
    return text === null || text.trim() === "" ? NaN : Number(text);
  }

  const shown = () => Number(paused.toFixed(6));
  const long = () => opened.toString().length > LONGEST;
  const refused = () => (long() ? [`The link is too long: ${LONGEST} characters are read at most`] : []);

  // The link that was opened without the words of the page alone; one too long says nothing.
  function asked() {
    if (long()) return new URLSearchParams();
    const words = new URLSearchParams(opened);
    OWN.forEach((name) => words.delete(name));
    return words;
  }

  function whole() {
    const link = new URLSearchParams(query);
    if (!Carom.clock.isPlaying()) paused = Carom.clock.now();
    const time = shown();
    const words = {
      time: time === Carom.clock.START ? "" : time,
      pace: Carom.clock.pace() === Carom.clock.PACE ? "" : Carom.clock.pace(),
      slow: Carom.clock.isSlow() ? 1 : "",
      theme: Carom.theme.choice() === "auto" ? "" : Carom.theme.choice(),
      tab: Carom.tabs.chosen() === Carom.tabs.first ? "" : Carom.tabs.chosen(),
      preset: Carom.presets.chosen(),
      story: Carom.stories.chosen(),
      level: Carom.level.isFull() ? "full" : "",
      beside: Carom.beside.query() ?? "",
    };
    if (Carom.beside.query() === "") words.beside = "given=bodies";
    if (words.preset && !query) link.set("given", "bodies"); // not those of the example
    Object.entries(words).forEach(([name, word]) => word !== "" && link.set(name, word));
    return link.toString();
  }

  function write() {
    window.clearTimeout(waiting);
    waiting = 0;
    if (query === null) return;
    const words = whole();
    const { href, search } = window.location;
    const address = href.split(/[?#]/)[0];
    if (search.slice(1) !== words) window.history.replaceState(null, "", words ? `?${words}` : address);
    document.getElementById("link").value = words ? `${address}?${words}` : address;
    const of = new URLSearchParams(query);
    of.set("time", shown());
    Carom.code.show(of.toString());
    document.querySelectorAll(FILES).forEach((anchor) => {
      if (anchor.dataset.path) anchor.href = `${anchor.dataset.path}?${of}`;
    });
  }

  // Write soon, not while the time runs.
  function refresh() {
    if (!waiting && !Carom.clock.isPlaying()) waiting = window.setTimeout(write, WAIT);
  }

  function put(latest) {
    query = latest;
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
    place.textContent = text;
    window.setTimeout(() => place.textContent === text && (place.textContent = ""), 4000);
  }

  window.addEventListener("popstate", () => (opened = new URLSearchParams(window.location.search)));
  document.addEventListener("click", (event) => event.target.closest?.(FILES) && write(), true);
  document.getElementById("copy").addEventListener("click", copy);

  return { part, words: () => opened, number, asked, refused, put, refresh };
})();
