// The present time as a line over the charts of time; pointing at such a chart sets the time.
window.Carom = window.Carom || {};

Carom.cursor = (() => {
  const CHARTS = ".carom-history, :not(.carom-history) > :is(#forces, #energies)";
  const watched = new WeakSet();

  // What plotly knows of a chart: its axis of time and the box it draws in; null if not there yet.
  function plotted(chart) {
    const plot = chart.querySelector(".js-plotly-plot");
    const layout = plot && plot._fullLayout;
    const axis = layout && layout.xaxis;
    if (!axis || !axis._length || !layout._size) return null;
    return { plot, axis, size: layout._size };
  }

  function lineOf(chart) {
    const found = chart.querySelector(":scope > .carom-cursor");
    if (found) return found;
    const line = document.createElement("div");
    line.className = "carom-cursor";
    line.setAttribute("aria-hidden", "true");
    chart.append(line);
    return line;
  }

  function place(chart, time) {
    const line = lineOf(chart);
    const seen = plotted(chart);
    const data = Carom.scene.data();
    const along = seen && data ? seen.axis.l2p(time * data.duration) : NaN;
    const shown = along >= -0.5 && along <= (seen ? seen.axis._length : 0) + 0.5;
    line.hidden = !shown || time < 0 || time > 1;
    if (line.hidden) return;
    const { plot, axis, size } = seen;
    line.style.transform = `translateX(${plot.offsetLeft + axis._offset + along}px)`;
    line.style.top = `${plot.offsetTop + size.t}px`;
    line.style.height = `${size.h}px`;
  }

  function draw(time) {
    document.querySelectorAll(CHARTS).forEach((chart) => place(chart, time));
  }

  // Plotly draws later than we, and again after a zoom: follow whatever changes in the chart.
  function watch() {
    document.querySelectorAll(CHARTS).forEach((chart) => {
      if (watched.has(chart)) return;
      watched.add(chart);
      const again = () => place(chart, Carom.clock.now());
      new MutationObserver(again).observe(chart, { childList: true, subtree: true });
      new ResizeObserver(again).observe(chart);
    });
  }

  function point(event) {
    if (!(event.target instanceof Element)) return;
    const chart = event.target.closest(CHARTS);
    if (!chart || (event.pointerType === "mouse" && event.buttons)) return; // a zoom
    const seen = plotted(chart);
    const data = Carom.scene.data();
    if (!seen || !data) return;
    const box = seen.plot.getBoundingClientRect();
    const x = event.clientX - box.left - seen.axis._offset;
    const y = event.clientY - box.top - seen.size.t;
    if (x < 0 || x > seen.axis._length || y < 0 || y > seen.size.h) return;
    Carom.clock.pause();
    Carom.clock.set(Math.max(0, Math.min(1, seen.axis.p2l(x) / data.duration)));
  }

  document.addEventListener("pointermove", point, { capture: true, passive: true });
  document.addEventListener("pointerdown", point, { capture: true, passive: true });

  return { draw, watch };
})();
