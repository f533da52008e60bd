// Charts of a fit: what was measured with its errors, the curves of laws, and what is left below.

Carom.fitCharts = (() => {
  const PADDING = 0.08; // of a range
  const EDGE = 0.03; // of a range along x
  const MINUS = "\u2212";
  const color = (name) => Carom.theme.color(name);

  // The exact law in ink; the others as contact laws are.
  function style(row) {
    if (row === 0) return { color: color("ink"), width: 2.4 };
    return { color: color(`law-${row}`), dash: row === 1 ? "7px,3px" : "2px,2.5px", width: 1.7 };
  }

  const bands = (chart) => (chart.borders.length ? Carom.bands.regimes(chart.borders, ...span(chart)) : []);

  // Measured values, each with the line of the file that it comes from.
  function points(chart, y, error, unit) {
    const { x, row, outlier, along_unit: alongUnit } = chart;
    const colors = outlier.map((out) => color(out ? "caution" : "after"));
    return {
      type: "scatter",
      mode: "markers",
      name: "measured",
      x,
      y,
      customdata: row.map((line, place) => `${line}${outlier[place] ? ", an outlier" : ""}`),
      error_y: { type: "data", array: error, color: color("after"), thickness: 1, width: 0 },
      marker: { size: 7, color: outlier.map((out) => color(out ? "caution" : "panel")), line: { color: colors, width: 1.8 } },
      hovertemplate: `line %{customdata}: %{y:.4g} ${unit} at %{x:.4g} ${alongUnit}<extra></extra>`,
    };
  }

  function strip({ lines, band }) {
    if (!band.length) return [];
    const { line } = Carom.plotting;
    const ends = band.map((y) => line(lines[0].x, y, "interval", { width: 0 }));
    ends[1] = { ...ends[1], fill: "tonexty", fillcolor: `${color("line")}59` };
    return ends;
  }

  const range = (lists, part = PADDING) => Carom.plotting.range(lists, part);

  // Values less and more their errors; those without one as they are.
  const reach = (values, errors) => values.flatMap((value, row) => {
    return value === null ? [] : [value - (errors[row] ?? 0), value + (errors[row] ?? 0)];
  });

  // From the first to the last place along x, a little more where a point would be cut.
  function span({ lines: [{ x: along }], x }) {
    const [low, high] = range([x], EDGE);
    return [Math.min(along[0], low), Math.max(along[along.length - 1], high)];
  }

  function keys({ lines, band, outlier }) {
    const laws = lines.map(({ law }, row) => ({ sample: Carom.keys.line(style(row)), text: law }));
    const measured = { sample: Carom.keys.marker({ color: color("after"), fill: color("panel") }), text: "measured" };
    const shade = band.length ? [{ sample: '<span class="carom-area carom-interval" aria-hidden="true"></span>', text: "interval of the exact curve" }] : [];
    const out = { sample: Carom.keys.marker({ color: color("caution") }), text: "outlier" };
    return [measured, ...(outlier.includes(true) ? [out] : []), ...laws, ...shade];
  }

  const within = (unit) => (unit ? ` (${unit})` : "");

  function curve(chart) {
    const laws = chart.lines.map(({ law, x, y }, row) => {
      return Carom.plotting.line(x, y, law, style(row), `${law}: %{y:.4g} ${chart.unit}<extra></extra>`);
    });
    return {
      traces: [...strip(chart), ...laws.reverse(), points(chart, chart.measured, chart.error, chart.unit)],
      x: { title: "", range: span(chart) },
      y: { title: within(chart.unit).trim(), range: range([reach(chart.measured, chart.error), ...chart.lines.map(({ y }) => y)]), zeroline: true },
      bands: bands(chart),
      keys: [],
      hover: true,
      revision: `fit ${chart.response}`,
    };
  }

  // What is left, in the unit of the response or in standard deviations.
  function residuals(chart, scaled) {
    const [y, unit] = scaled ? [chart.scaled, "σ"] : [chart.residual, chart.unit];
    const error = y.map((value, row) => (scaled ? (value === null ? null : 1) : chart.error[row]));
    const title = `measured ${MINUS} ${chart.lines[0].law}${within(scaled ? "standard deviations" : unit)}`;
    return {
      traces: [points(chart, y, error, unit)],
      x: { title: chart.along + within(chart.along_unit), range: span(chart) },
      y: { title, range: range([reach(y, error), [0]]), zeroline: true, nticks: 5 },
      bands: bands(chart).map((band) => ({ ...band, name: "" })),
      keys: [],
      hover: true,
      revision: `residual ${chart.response} ${scaled}`,
    };
  }

  return { curve, residuals, keys };
})();
