// Files of what the page shows, by what they show; each a button that says what it is doing.

Carom.files = (() => {
  const PICTURE = [["png", "PNG"], ["svg", "SVG"], ["pdf", "PDF"]];
  const TABLE = [["csv", "CSV"], ["nc", "NetCDF"]];
  const GROUPS = [
    ["curve", "Rebound curve", "ψ₂ against ψ₁ with its regimes, this impact and the contact laws that are chosen.", PICTURE],
    ["history", "History", "Forces, velocities, radii and energies from the first touch to the last.", [...PICTURE, ...TABLE]],
    ["contact", "Contact at this instant", "Traction, stick and slip at the time that the film shows.", PICTURE],
    ["course", "Contact through the impact", "The contact at several instants, its traction across, and the force.", PICTURE],
    ["view", "Python", "The lines that compute all this with the library.", [["py", "Python"]]],
  ];
  const { make } = Carom.elements;
  const place = document.getElementById("files");
  let notice = null;

  function anchor(name, text, what) {
    const file = Carom.source.file(name);
    const link = make("a", { id: name.replace(".", "-"), className: "carom-download carom-button", download: name, href: file }, text);
    link.dataset.path = file;
    link.ariaLabel = `${what}, ${text}`;
    return link;
  }

  function group([stem, title, words, kinds]) {
    const buttons = kinds.map(([ending, text]) => anchor(`${stem}.${ending}`, text, title));
    const text = make("div", {}, make("h3", {}, title), make("p", { className: "carom-note" }, words));
    return make("li", {}, text, make("div", { className: "carom-kinds" }, ...buttons));
  }

  function build() {
    notice = make("p", { id: "files-notice", className: "carom-note", role: "status" });
    place.replaceChildren(make("ul", { className: "carom-files" }, ...GROUPS.map(group)), notice);
    place.addEventListener("click", taken);
  }

  // A picture takes a second or more, and may be refused: the page says so, and stays.
  async function taken(event) {
    const link = event.target.closest("a.carom-download");
    if (!link || event.ctrlKey || event.metaKey || event.shiftKey) return;
    event.preventDefault();
    tell(`Writing ${link.download} …`);
    try {
      save(await Carom.source.written(link.href), link.download);
      tell(`${link.download} is written.`);
    } catch (error) {
      tell(error.message, true);
    }
  }

  function save(blob, name) {
    const link = make("a", { href: URL.createObjectURL(blob), download: name });
    link.click();
    window.setTimeout(() => URL.revokeObjectURL(link.href), 60000);
  }

  function tell(text, wrong = false) {
    notice.textContent = text;
    notice.classList.toggle("carom-wrong", wrong);
  }

  return { build, save };
})();
