// The three charts: drawn one a frame, so that the film goes on; drawn again for another size or theme.

Carom.charts = (() => {
  const CHARTS = {
    rebounds: (answers) => Carom.rebounds.chart(answers),
    forces: (answers) => Carom.histories.forces(answers),
    energies: (answers) => Carom.histories.energies(answers),
  };
  const box = (name) => document.getElementById(name);
  const sizeOf = ({ clientWidth, clientHeight }) => `${clientWidth} ${clientHeight}`;
  const sizes = new Map(); // of plots as they were drawn
  let answers = null;
  let turn = 0; // counts what is to be drawn: the latest wins

  const frame = () => new Promise((done) => requestAnimationFrame(() => setTimeout(done)));

  // Draw answers once plotly is there: [this impact, the one beside or null].
  async function show(latest) {
    answers = latest;
    const mine = (turn += 1);
    await Carom.plotting.load();
    for (const name of Object.keys(CHARTS)) {
      if (mine !== turn) return;
      draw(name);
      await frame();
    }
  }

  function draw(name) {
    if (!answers || !box(name).clientWidth) return; // in a tab that is not shown
    Carom.plotting.draw(box(name), CHARTS[name](answers));
    sizes.set(name, sizeOf(box(name).carom.plot));
    Carom.cursor.draw(Carom.clock.now());
  }

  // Draw what has another size than when it was drawn, by its tab, its keys or the window.
  function resized(entries) {
    if (!window.Plotly) return;
    for (const { target } of entries) {
      if (sizes.get(target.dataset.chart) !== sizeOf(target)) draw(target.dataset.chart);
    }
  }

  // Let the line of one law stand out, or all be as they were with null.
  function stress(label) {
    const rows = answers ? answers[0].laws.map((law) => law.label) : [];
    for (const name of ["rebounds", "forces"]) {
      const drawing = box(name).carom?.drawing;
      (drawing?.data || []).forEach((trace, row) => {
        const faded = label !== null && trace.name !== label && rows.includes(trace.name);
        drawing.querySelectorAll(".scatterlayer > .trace")[row]?.classList.toggle("carom-faded", faded);
      });
    }
  }

  // Name the narrow regime that one points at.
  function regime(event) {
    const seen = Carom.plotting.frame(box("rebounds"));
    if (!seen) return;
    const along = event.clientX - box("rebounds").carom.plot.getBoundingClientRect().left - seen.left;
    const inside = event.type !== "pointerleave" && along >= 0 && along <= seen.width;
    Carom.bands.point(box("rebounds"), inside ? seen.value(along) : null);
  }

  function build() {
    const observer = new ResizeObserver(resized);
    for (const name of Object.keys(CHARTS)) {
      const { plot } = Carom.plotting.parts(box(name));
      plot.dataset.chart = name;
      observer.observe(plot);
    }
    for (const kind of ["pointermove", "pointerdown", "pointerleave"]) {
      box("rebounds").addEventListener(kind, regime, { passive: true });
    }
  }

  build();
  return {
    show,
    again: () => answers && show(answers),
    stress,
    answers: () => answers,
  };
})();
