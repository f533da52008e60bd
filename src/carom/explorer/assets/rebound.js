// psi_2 from the table: Chebyshev series on patches of chi and of psi_1, scaled so that the borders
// between the regimes lie at 1, 2 and 3.

Carom.rebound = (() => {
  const read = new Map(); // tables by restitution, as numbers

  function numbers(text, Kind) {
    const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
    return new Kind(bytes.buffer);
  }

  function table(restitution) {
    if (!read.has(restitution)) {
      const stored = Carom.tables.rebounds[restitution];
      const decoded = { terms: stored.terms, smallest: stored.smallest };
      for (const name of ["cuts", "corners", "series"]) decoded[name] = numbers(stored[name], Float64Array);
      for (const name of ["axes", "children"]) decoded[name] = numbers(stored[name], Int16Array);
      read.set(restitution, decoded);
    }
    return read.get(restitution);
  }

  // The |psi_1| at which the regime changes.
  function borders(chi, e) {
    return [1, 2 * chi, 2 * chi * (1 + e) - e].map((border) => Math.max(border, 1));
  }

  function place(psi, chi, e) {
    if (psi <= 1) return psi;
    const width = 2 * chi - 1;
    return psi <= 2 * chi ? 1 + (psi - 1) / width : 2 + (psi - 2 * chi) / (e * width);
  }

  function clenshaw(series, from, terms, at) {
    let [last, one] = [0, 0];
    for (let i = terms - 1; i > 0; i--) [last, one] = [one, series[from + i] + 2 * at * one - last];
    return series[from] + at * one - last;
  }

  // psi_2/psi_1 at a chi and a place.
  function valueAt({ axes, cuts, children, corners, series, terms }, chi, at) {
    let node = 0;
    while (axes[node] >= 0) node = children[2 * node + ((axes[node] ? at : chi) >= cuts[node] ? 1 : 0)];
    const leaf = children[2 * node];
    const [low, high, left, right] = corners.subarray(4 * leaf, 4 * leaf + 4);
    const [across, along] = [(2 * chi - low - high) / (high - low), (2 * at - left - right) / (right - left)];
    const rows = Array.from({ length: terms[0] }, (_, i) =>
      clenshaw(series, (leaf * terms[0] + i) * terms[1], terms[1], along),
    );
    return clenshaw(rows, 0, terms[0], across);
  }

  // psi_2; beyond the last border the contact slides throughout.
  function of(psi, chi, e) {
    const size = Math.abs(psi);
    const sign = psi < 0 ? -1 : 1;
    if (size >= borders(chi, e)[2] && size > 1) return sign * (size - 2 * chi * (1 + e));
    const patches = table(e);
    const ratio = valueAt(patches, chi, Math.max(place(size, chi, e), patches.smallest));
    return psi * Math.min(1, Math.max(-1, ratio));
  }

  return { of, borders };
})();
