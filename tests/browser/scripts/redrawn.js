async theme => {
  const charts = [...document.querySelectorAll('.js-plotly-plot')].filter(x => x.checkVisibility());
  const before = charts.map(chart => chart._fullData);
  const frame = () => new Promise(requestAnimationFrame);
  Carom.theme.choose(theme);
  while (charts.some((chart, row) => chart._fullData === before[row])) await frame();
  await frame(); }
