// What the copy of the page does without a server: the laws of stories, from curves that came along.

Carom.source = (() => {
  const { story_laws: known, fields } = Carom.config;
  const SAME = 1e-9; // of chi

  async function number(name, text, allowed) {
    const { unit } = fields[name];
    const units = /^[\s+\-.\d]+\p{L}/u.test(text) ? `; this copy takes ${unit || "no unit"} only` : "";
    throw { field: name, message: `${allowed}, not '${text.slice(0, 40)}'${units}` };
  }

  // psi_2 of a law; beyond its curve the contact slides, as the exact one does.
  function at({ psi, out }, { psi_in: value, psi_out: exact }) {
    const size = Math.abs(value);
    if (size >= psi.at(-1)) return exact;
    return Math.sign(value) * Carom.scene.between(out, psi[0], psi.at(-1), size);
  }

  async function laws({ late, numbers, lossy }) {
    const fits = ({ label, chi }) => !lossy && late.includes(label) && Math.abs(chi - numbers?.chi) < SAME;
    const told = known.filter(fits).map((law) => ({ ...law, at: at(law, numbers), share: [], force: [] }));
    const laws = told.map((law) => ({ ...law, off: law.at - numbers.psi_out }));
    return { laws, slow: late.filter((label) => !laws.some((law) => law.label === label)) };
  }

  return { live: false, number, laws, verdict: async () => null };
})();

// What is only there with the program.
Carom.fit = { build() {}, changed() {}, choose() {}, chosen: () => "" };
Carom.files = { build() {} };
Carom.code = { show() {} };
