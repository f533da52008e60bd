// Bands of phases and regimes behind a chart, with names where they fit; others are named where one points.

Carom.bands = (() => {
  const FONT = "12px";
  const LINE = 13; // pixels from one line of a name to the next
  const LINES = 3; // that a name may take
  const GAP = 3; // pixels between a name and the borders of its band
  const pen = document.createElement("canvas").getContext("2d");
  const widths = new Map();

  function width(text) {
    if (!widths.has(text)) {
      pen.font = `${FONT} ${getComputedStyle(document.body).fontFamily}`;
      widths.set(text, pen.measureText(text).width);
    }
    return widths.get(text);
  }

  // A name in lines that a width holds, null if it does not.
  function fitted(name, most) {
    const lines = [];
    for (const word of name.split(" ")) {
      const longer = lines.length ? `${lines[lines.length - 1]} ${word}` : "";
      if (longer && width(longer) <= most) lines[lines.length - 1] = longer;
      else lines.push(word);
    }
    return lines.length <= LINES && lines.every((line) => width(line) <= most) ? lines : null;
  }

  // Pixels that the names need at the top of a plot.
  function room(bands, [low, high], length) {
    const scale = length / (high - low);
    const counts = bands.map(({ start, end, name }) => {
      const seen = Math.min(end, high) - Math.max(start, low);
      return (fitted(name, seen * scale - GAP) || []).length;
    });
    return Math.max(1, ...counts) * LINE + 4;
  }

  function element(className, style, text = "") {
    const made = Carom.elements.make("div", className, text);
    Object.assign(made.style, style);
    return made;
  }

  const px = (value) => `${value.toFixed(1)}px`;

  // Bands and names where the axis has them now, zoomed or not.
  function place(box) {
    const seen = Carom.plotting.frame(box);
    if (!seen) return;
    const { bands, names, shaded } = box.carom;
    const height = { top: px(seen.top), height: px(seen.height) };
    const spans = shaded.map(({ start, end, name, look }) => {
      const [from, to] = [start, end].map((at) => Math.min(seen.width, Math.max(0, seen.pixel(at))));
      return { from, to, name, look, lines: fitted(name, to - from - GAP) };
    });
    const shown = spans.filter(({ from, to }) => to - from > 0.2);
    bands.replaceChildren(...shown.map(({ from, to, look }) => {
      return element(`carom-band carom-${look}`, { left: px(seen.left + from), width: px(to - from), ...height });
    }));
    names.replaceChildren(
      ...shown.slice(1).map(({ from }) => element("carom-change", { left: px(seen.left + from), ...height })),
      ...shown.filter(({ lines }) => lines).map(({ from, to, lines }) => {
        const at = { left: px(seen.left + from), width: px(to - from), top: px(seen.top + 2) };
        return element("carom-name", at, lines.join("\n"));
      }),
    );
    box.carom.named = null;
  }

  // Name the band at a place along x, if it has no room for its name.
  function point(box, at) {
    const seen = Carom.plotting.frame(box);
    if (!seen || !box.carom.shaded) return;
    const { names, shaded } = box.carom;
    const band = at === null ? null : shaded.find(({ start, end }) => at >= start && at <= end);
    const [from, to] = band ? [band.start, band.end].map(seen.pixel) : [0, 0];
    const visible = band && to > 0 && from < seen.width;
    const hidden = visible && !fitted(band.name, Math.min(to, seen.width) - Math.max(from, 0) - GAP);
    const name = hidden ? band.name : null;
    if (name === box.carom.named) return;
    box.carom.named = name;
    names.querySelector(".carom-pointed")?.remove();
    if (name) names.append(pointed(name, 0.5 * (from + to), seen));
    covered(names);
  }

  function pointed(name, middle, seen) {
    const half = 0.5 * width(name) + GAP;
    const left = Math.max(half, Math.min(seen.width - half, middle));
    const at = { left: px(seen.left + left - half), top: px(seen.top + 2), width: px(2 * half) };
    return element("carom-name carom-pointed", at, name);
  }

  // Names that the one pointed at lies upon are out of its way.
  function covered(names) {
    const over = names.querySelector(".carom-pointed")?.getBoundingClientRect();
    names.querySelectorAll(".carom-name:not(.carom-pointed)").forEach((name) => {
      const range = document.createRange();
      range.selectNodeContents(name);
      const own = range.getBoundingClientRect();
      name.style.visibility = over && own.left < over.right && own.right > over.left ? "hidden" : "";
    });
  }

  // The regimes on both sides of zero as far as they are shown, marked as in figures.
  const LOOKS = ["stick", "slip-plus", "gross-plus", "only"]; // from zero on
  function regimes(borders, low, high) {
    const ends = [0, ...borders, Infinity];
    const bands = LOOKS.flatMap((look, row) => {
      const [from, to] = [ends[row], ends[row + 1]];
      const sides = row ? [[-to, -from], [from, to]] : [[-to, to]]; // stick is one band
      const { name } = Carom.config.regimes[row];
      return sides.map(([start, end]) => ({ name, look, start: Math.max(start, low), end: Math.min(end, high) }));
    });
    return bands.filter(({ start, end }) => end > start).sort((a, b) => a.start - b.start);
  }

  // A phase of the contact; its sign stays on the line of its last word.
  const phase = ({ kind, sign, start, end }, scale = 1) => ({
    start: start * scale,
    end: end * scale,
    name: Carom.scene.nameOf({ kind, sign }).replace(/ (?=[+−]$)/, "\u00a0"),
    look: kind === "stick" ? "stick" : `${kind === "slip" ? "slip" : "gross"}-${sign < 0 ? "minus" : "plus"}`,
  });

  return { room, place, point, regimes, phase };
})();
