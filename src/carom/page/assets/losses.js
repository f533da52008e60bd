// What is lost of the energy, said in the same words everywhere.

Carom.losses = (() => {
  const LEAST = 1e-4; // shares: what is less is told as less
  const { lost: WORDS } = Carom.config;

  // Where the normal motion loses its energy to.
  const sink = ({ plate }) => (plate === undefined ? WORDS.bodies : WORDS.waves);

  function percent(value) {
    const digits = value > 0.999 && value < 1 ? 5 : 3;
    return `${Carom.quantities.plain(100 * value, digits)} %`;
  }

  // The shares that are lost of the energy of all bodies before, each with its words.
  function shares({ scene, lossy, numbers: { energy_rubbed: rubbed, energy_lost: lost } }) {
    return [[rubbed, WORDS.friction], [lossy ? lost : 0, sink(scene)]].filter(([share]) => share > 0);
  }

  // All that is lost, in a sentence.
  function told(answer) {
    const lost = shares(answer);
    const worth = lost.filter(([share]) => share >= LEAST);
    if (!lost.length) return "Nothing is lost.";
    if (!worth.length) return `Less than ${percent(LEAST)} is lost.`;
    return `${worth.map(([share, words]) => `${percent(share)} is ${words}`).join(", ")}.`;
  }

  return { WORDS, sink, percent, told };
})();
