// The chart of psi_2 against psi_1: exact curve, regimes, contact laws, and where this impact lies.

Carom.rebounds = (() => {
  const PLACE = "<br>ψ₁ = %{x:.4g}, ψ₂ = %{y:.4g}<extra></extra>";
  const BESIDE = { dash: "7px,4px", width: 1.5 };
  const PADDING = 0.05; // of the range of psi_2

  const color = (name) => Carom.theme.color(name);

  function points(at, name, fill) {
    return {
      type: "scatter",
      mode: "markers",
      name,
      x: [at[0]],
      y: [at[1]],
      cliponaxis: false,
      marker: { color: fill, size: 11, line: { color: color("ink"), width: 1.6 } },
      hovertemplate: name + PLACE,
    };
  }

  function ofLaws(laws) {
    const styles = laws.map(({ label }) => Carom.laws.style(label));
    return laws.map(({ label, psi, out }, row) => {
      return Carom.plotting.line(psi, out, label, { ...styles[row], width: 1.7 }, label + PLACE);
    });
  }

  // What the laws give for this impact, all in one trace.
  function pointsOfLaws(laws, psi) {
    const solved = laws.filter(({ at }) => at !== null);
    return {
      type: "scatter",
      mode: "markers",
      name: "contact laws",
      x: solved.map(() => psi),
      y: solved.map(({ at }) => at),
      text: solved.map(({ label }) => label),
      marker: { symbol: "x", size: 7, color: solved.map(({ label }) => Carom.laws.style(label).color) },
      hovertemplate: `%{text}${PLACE}`,
    };
  }

  function exact({ curve }, name, look) {
    return Carom.plotting.line(curve.psi, curve.out, name, look, name + PLACE);
  }

  function traces([first, second]) {
    const { curve, laws } = first;
    const drawn = [...ofLaws(laws)];
    if (second) drawn.push(exact(second, "beside", { ...BESIDE, color: color("beside") }));
    drawn.push(exact(first, "exact", { color: color("ink"), width: 2.6 }));
    if (curve.at && laws.length) drawn.push(pointsOfLaws(laws, curve.at[0]));
    if (second && second.curve.at) drawn.push(points(second.curve.at, "the impact beside", color("panel")));
    if (curve.at) drawn.push(points(curve.at, "this impact", color("ink")));
    return drawn;
  }

  function keys([first, second]) {
    const { line, marker } = Carom.keys;
    const ink = color("ink");
    const entries = [{ sample: line({ color: ink, width: 2.6 }), text: "exact" }];
    if (first.curve.at) entries.push({ sample: marker({ color: ink }), text: "this impact" });
    if (!Carom.level.isFull()) entries.push(...first.laws.map(({ label }) => ({ sample: line(Carom.laws.style(label)), text: label })));
    if (!second) return entries;
    const point = second.curve.at ? marker({ color: ink, fill: color("panel") }) : "";
    return [...entries, { sample: line({ ...BESIDE, color: color("beside") }) + point, text: "beside" }];
  }

  function chart(answers) {
    const [first, second] = answers;
    const curves = [first.curve, ...(second ? [second.curve] : [])];
    const xs = curves.flatMap(({ psi }) => [psi[0], psi[psi.length - 1]]);
    const x = [Math.min(...xs), Math.max(...xs)];
    const y = Carom.plotting.range([...curves.map(({ out }) => out), ...first.laws.map(({ out }) => out)], PADDING);
    return {
      traces: traces(answers),
      x: { title: "ψ₁", range: x, zeroline: x[0] < 0 },
      y: { title: "ψ₂", range: y, zeroline: true },
      bands: Carom.bands.regimes(first.curve.borders, ...x),
      keys: keys(answers),
      hover: true,
      revision: "psi",
    };
  }

  return { chart };
})();
