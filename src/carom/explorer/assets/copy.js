// What the copy of the page does without a server: it says what needs the program.

Carom.source = (() => {
  const WHY = "This copy of the page runs in the browser alone and cannot do this. To install the program: pip install \"carom[explore]\"; then run carom explore.";

  async function cannot() {
    throw { field: "", message: WHY };
  }

  async function number(name, text, allowed) {
    const { unit } = Carom.config.fields[name];
    const units = /^[\s+\-.\d]+\p{L}/u.test(text) ? `; this copy takes ${unit || "no unit"} only` : "";
    throw { field: name, message: `${allowed}, not '${text.slice(0, 40)}'${units}` };
  }

  return {
    can: { laws: false, fit: false, files: false, code: false },
    why: WHY,
    number,
    verdict: async () => null,
    laws: async () => ({ laws: [], slow: [] }),
    fit: cannot,
    code: cannot,
    written: cannot,
    file: () => null,
  };
})();
