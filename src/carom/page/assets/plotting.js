// What all charts share: plotly, loaded late; a frame of fixed margins; keys above, bands below the lines.

Carom.plotting = (() => {
  const MARGIN = { l: 44, r: 12, t: 22, b: 40 };
  const FONT = 12; // pixels
  const LEAST = 60; // pixels of width and height below which nothing is drawn
  const WIDTH_OF_TICK = 42; // pixels
  const HEIGHT_OF_TICK = 28;
  const CONFIG = { displayModeBar: false, responsive: false, doubleClick: false, showTips: false };
  const TOUCH = window.matchMedia("(pointer: coarse)"); // a finger scrolls the page, it does not zoom
  let loading = null;

  function load() {
    loading ||= new Promise((done, fail) => {
      document.head.append(Carom.elements.make("script", { src: "plotly.min.js", onload: done, onerror: fail }));
    });
    return loading;
  }

  // The parts of a chart's box, made once: keys, and the plot between bands and their names.
  function parts(box) {
    if (!box.carom) {
      const made = (name, parent) => parent.appendChild(Carom.elements.make("div", `carom-${name}`));
      const [keys, plot] = [made("keys", box), made("plot", box)];
      const [bands, drawing, names, upright] = ["bands", "drawing", "names", "upright"].map((name) => made(name, plot));
      names.ariaHidden = "true";
      box.carom = { keys, plot, bands, drawing, names, upright };
    }
    return box.carom;
  }

  // Where a chart has its plot, in pixels of its box, and its scale along x; null if not drawn yet.
  function frame(box) {
    const layout = box.carom && box.carom.drawing._fullLayout;
    const axis = layout && layout.xaxis;
    if (!axis || !axis._length) return null;
    return {
      left: axis._offset,
      top: layout._size.t,
      width: axis._length,
      height: layout._size.h,
      pixel: (value) => axis.l2p(value),
      value: (pixel) => axis.p2l(pixel),
    };
  }

  function axis(length, spacing, { title, range, ...more }) {
    const { color } = Carom.theme;
    return {
      title: title ? { text: title, standoff: 6 } : undefined,
      range: [...range], // a zoom writes into it
      nticks: Math.max(3, Math.floor(length / spacing)),
      automargin: false,
      zeroline: false,
      zerolinecolor: color("line"),
      zerolinewidth: 1,
      gridcolor: color("grid"),
      tickcolor: color("line"),
      ticks: "outside",
      ticklen: 4,
      exponentformat: "SI",
      ...more,
    };
  }

  // The range of values, null among them, with a part of it around.
  function range(lists, part) {
    const values = lists.flat().filter((value) => value !== null);
    const [low, high] = [Math.min(...values), Math.max(...values)];
    const padding = part * (high - low || 1);
    return [low - padding, high + padding];
  }

  // The range of y with room at its top for the names of bands.
  function roomy([low, high], height, pixels) {
    const left = height - MARGIN.t - MARGIN.b;
    return [low, low + ((high - low) * left) / Math.max(left - pixels, 0.5 * left)];
  }

  function layout(width, height, { x, y, hover, revision }) {
    const { color } = Carom.theme;
    const font = { size: FONT, color: color("ink"), family: getComputedStyle(document.body).fontFamily };
    return {
      width,
      height,
      margin: MARGIN,
      xaxis: axis(width - MARGIN.l - MARGIN.r, WIDTH_OF_TICK, x),
      yaxis: axis(height - MARGIN.t - MARGIN.b, HEIGHT_OF_TICK, { ...y, title: "" }),
      paper_bgcolor: "rgba(0,0,0,0)",
      plot_bgcolor: "rgba(0,0,0,0)",
      font,
      hovermode: hover ? "closest" : false,
      hoverlabel: { bgcolor: color("panel"), bordercolor: color("line"), font, align: "left" },
      dragmode: TOUCH.matches ? false : "zoom",
      showlegend: false,
      uirevision: revision, // a zoom outlives a change of what is drawn
    };
  }

  // Draw a chart: {traces, x, y, bands, keys, hover, revision}; nothing where there is no room.
  function draw(box, chart) {
    const { keys, drawing, upright } = parts(box);
    Carom.keys.show(keys, chart.keys);
    upright.innerHTML = chart.y.title; // above its axis: beside it the title would take width
    const { clientWidth: width, clientHeight: height } = drawing;
    if (width < LEAST || height < LEAST) return;
    const room = Carom.bands.room(chart.bands, chart.x.range, width - MARGIN.l - MARGIN.r);
    const y = { ...chart.y, range: roomy(chart.y.range, height, room) };
    const first = !drawing._fullLayout;
    const revision = `${chart.revision} ${box.carom.unzoomed || 0}`;
    window.Plotly.react(drawing, chart.traces, layout(width, height, { ...chart, y, revision }), CONFIG);
    Object.assign(box.carom, { shaded: chart.bands, room, chart });
    Carom.bands.place(box);
    if (first) follow(box, drawing);
  }

  // Bands go along with a zoom; a double click ends it.
  function follow(box, drawing) {
    for (const event of ["plotly_relayout", "plotly_relayouting", "plotly_afterplot"]) {
      drawing.on(event, () => Carom.bands.place(box));
    }
    drawing.on("plotly_doubleclick", () => {
      box.carom.unzoomed = (box.carom.unzoomed || 0) + 1;
      draw(box, box.carom.chart);
    });
  }

  // A line as plotly takes it; its points are named by what is pointed at.
  function line(x, y, name, look, template) {
    const trace = { type: "scatter", mode: "lines", name, x, y, line: { simplify: false, ...look } };
    return template ? { ...trace, hovertemplate: template } : { ...trace, hoverinfo: "skip" };
  }

  const lowered = (text) => text.replace(/_(\w+)/g, "<sub>$1</sub>"); // F_max as it is written
  const titled = (symbol, unit) => lowered(unit ? `${symbol} (${unit})` : symbol);

  return { load, parts, draw, frame, line, range, lowered, titled };
})();
