// Where the contact from above has its map, its profile, its colour bar and the words below.

Carom.patchLayout = (() => {
  const { canvas } = Carom;
  const BARS = { full: 74, slim: 42, none: 0 }; // pixels that the colour bar and its words take
  const ENOUGH = 150; // pixels of a map that leaves room for the bar
  const LINE = 17; // pixels of a line of words below
  const TICKS = 17; // pixels of the numbers below a profile
  const BESIDE = 32; // pixels for the names of the lines of a profile
  const TOP = 7;
  const EDGE = 8;
  const ROOMY = 250; // pixels of height from which on the note has a line of its own
  const NOTES = {
    slip: ["arrows: the first body slides on the second", "arrows: slip of the first body"],
    rim: ["viscous bodies being loaded: p is unbounded at the edge", "p is unbounded at the edge"],
  };
  const BROAD = 1.4; // times the height
  const SMALL = 12; // pixels of the words

  // The notes that fit, the longest of each, and the lines that the words below take.
  function footOf(pen, scene, width, height) {
    const takes = (text) => canvas.widthOf(pen, text, SMALL);
    const beside = width - canvas.keyWidth(pen, scene) - 4 * EDGE;
    const longest = (texts, room) => texts.find((text) => takes(text) <= room) || "";
    const needed = scene.facts.viscous ? ["slip", "rim"] : ["slip"];
    const inLine = needed.every((name) => longest(NOTES[name], beside));
    const fits = longest(NOTES.slip, width - 2 * EDGE);
    const lines = inLine || !fits || height < ROOMY ? 1 : 2;
    const room = inLine ? beside : lines === 2 ? width - 2 * EDGE : 0;
    const [slip, rim] = [NOTES.slip, NOTES.rim].map((texts) => longest(texts, room));
    return { lines, slip, rim };
  }

  // The map above its profile, or beside it.
  function of(pen, scene, width, height) {
    const foot = footOf(pen, scene, width, height);
    const low = height - LINE * foot.lines - 4;
    if (!Carom.level.isFull()) return { ...alone(width, low), width, height, low, foot };
    const [above, beside] = [stacked(width, low), sideways(width, low)];
    const worse = width > BROAD * low ? 0.85 : 1.1; // a broad box is filled by what is side by side
    const box = beside.side > worse * above.side ? beside : above;
    return { ...box, width, height, low, foot };
  }

  // The map without scales and profile, for who does not ask for numbers.
  function alone(width, low) {
    const side = Math.max(40, Math.min(width - 2 * EDGE, low - TOP - 4));
    return { bar: "none", side, map: { x: width / 2, y: (low + TOP) / 2, unit: 0.48 * side }, line: null };
  }

  // The widest bar beside which the map stays large.
  function barred(sideWith) {
    const most = sideWith(BARS.none);
    const wide = Object.keys(BARS).find((name) => {
      const side = sideWith(BARS[name]);
      return side >= 0.92 * most || side >= ENOUGH;
    }) ?? "none"; // in a box too small for any
    return { bar: wide, side: Math.max(40, sideWith(BARS[wide])) };
  }

  function stacked(width, low) {
    const tall = Math.max(50, Math.min(120, 0.29 * low));
    const { bar, side } = barred((taken) => {
      const right = Math.max(taken, BESIDE);
      return Math.min(width - right - EDGE - 4, low - TOP - tall - TICKS - 10);
    });
    const left = Math.max(EDGE, (width - side - Math.max(BARS[bar], BESIDE)) / 2);
    const disc = { x: left + side / 2, y: TOP + side / 2, unit: 0.48 * side };
    const top = TOP + side + 8;
    const line = { x: disc.x, unit: disc.unit, top, height: low - TICKS - top, named: true };
    return { bar, side, left, map: disc, line, tied: true };
  }

  function sideways(width, low) {
    const named = width > 290;
    const taken = (named ? BESIDE : 0) + 4 * EDGE;
    const { bar, side } = barred((wide) => Math.min(low - TOP - 4, 0.55 * (width - taken - wide)));
    const disc = { x: EDGE + side / 2, y: (low + TOP - 4) / 2, unit: 0.48 * side };
    const start = EDGE + side + BARS[bar] + 14;
    const unit = (width - start - EDGE - (named ? BESIDE : 0)) / 2;
    const height = Math.min(low - TICKS - TOP, Math.max(side, 1.5 * unit + 30));
    const top = TOP + (low - TICKS - TOP - height) / 2;
    return { bar, side, left: EDGE, map: disc, line: { x: start + unit, unit, top, height, named } };
  }

  return { of, EDGE, LINE, SMALL };
})();
