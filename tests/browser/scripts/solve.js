async cases => {
  const { solver } = Carom;
  await solver.ready;
  const plain = (_, value) => ArrayBuffer.isView(value) ? Array.from(value) : value;
  return cases.map(([psi, chi, e, give]) => {
    const solved = solver.solve(psi, chi, { alpha: solver.alphaOf(e), give });
    return JSON.stringify(solved, plain); });
}
