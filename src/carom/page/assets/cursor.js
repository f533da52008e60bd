// The present time as a line over the charts of time; pointing at such a chart sets the time.

Carom.cursor = (() => {
  const CHARTS = { forces: "forcesAt", energies: "energiesAt" };
  const box = (name) => document.getElementById(name);

  // How long the contact is on the axis of time: of two impacts, both are 1.
  const whole = ([first, second]) => (second ? 1 : first.scene.duration);

  function lineOf({ plot }) {
    const drawn = plot.querySelector(":scope > .carom-cursor");
    if (drawn) return drawn;
    return plot.appendChild(Carom.elements.make("div", { className: "carom-cursor", ariaHidden: "true" }));
  }

  // The line over a chart, the name of a narrow phase under it, and the values in the keys.
  function place(name, time) {
    const chart = box(name);
    const seen = Carom.plotting.frame(chart);
    if (!seen) return;
    const line = lineOf(chart.carom);
    const answers = Carom.charts.answers();
    const at = time * whole(answers);
    const along = seen.pixel(at);
    line.hidden = time < 0 || time > 1 || along < -0.5 || along > seen.width + 0.5;
    Carom.bands.point(chart, line.hidden ? null : at);
    Carom.keys.tell(chart.carom.keys, Carom.histories[CHARTS[name]](answers, time));
    if (line.hidden) return;
    line.style.transform = `translateX(${seen.left + along}px)`;
    const { room } = chart.carom; // of the names, which it would cross
    line.style.top = `${seen.top + room}px`;
    line.style.height = `${seen.height - room}px`;
  }

  function draw(time) {
    Object.keys(CHARTS).forEach((name) => place(name, time));
  }

  function point(event) {
    if (event.pointerType === "mouse" && event.buttons) return; // a zoom
    const chart = event.currentTarget;
    const seen = Carom.plotting.frame(chart);
    if (!seen) return;
    const corner = chart.carom.plot.getBoundingClientRect();
    const x = event.clientX - corner.left - seen.left;
    const y = event.clientY - corner.top - seen.top;
    if (x < 0 || x > seen.width || y < 0 || y > seen.height) return;
    Carom.clock.pause();
    Carom.clock.set(Math.max(0, Math.min(1, seen.value(x) / whole(Carom.charts.answers()))));
  }

  function watch() {
    for (const name of Object.keys(CHARTS)) {
      for (const kind of ["pointermove", "pointerdown"]) {
        box(name).addEventListener(kind, point, { capture: true, passive: true });
      }
      box(name).addEventListener("plotly_afterplot", () => place(name, Carom.clock.now()));
    }
  }

  return { draw, watch };
})();
