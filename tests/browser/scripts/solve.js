states => states.map(([psi, chi, e]) => {
  const found = Carom.law.solve(psi, chi, e);
  const names = ["psi", "force", "stick", "contact", "stored", "dissipated", "shear"];
  const lines = names.map(name => [name, Array.from(found[name])]);
  const tractions = found.tractions.map(line => line.map(value => Math.round(value * 1e7) / 1e7));
  const {out, phases} = found;
  return JSON.stringify({...Object.fromEntries(lines), out, phases, tractions});
})
