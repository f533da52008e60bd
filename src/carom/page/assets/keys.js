// Keys of lines and areas above a chart, and what they are at the present time.

Carom.keys = (() => {
  // A piece of a line in its colour and dash.
  function line({ color, dash = "", width = 2 }, length = 26) {
    const look = `stroke="${color}" stroke-width="${width}" stroke-dasharray="${dash}"`;
    return `<svg class="carom-sample" width="${length}" height="10" aria-hidden="true">` +
      `<path d="M1 5H${length - 1}" fill="none" ${look}/></svg>`;
  }

  function marker({ color, fill = color }) {
    return `<svg class="carom-sample" width="12" height="10" aria-hidden="true">` +
      `<circle cx="6" cy="5" r="4" fill="${fill}" stroke="${color}" stroke-width="1.6"/></svg>`;
  }

  const area = (look) => `<span class="carom-area carom-${look}" aria-hidden="true"></span>`;

  // Show entries {sample, text (HTML), follows: whether its value does}.
  function show(box, entries) {
    const written = entries.map(({ sample, text, follows }) => {
      return `<span class="carom-entry">${sample}<span>${text}</span>${follows ? "<output></output>" : ""}</span>`;
    }).join("");
    if (box.carom !== written) box.innerHTML = box.carom = written;
  }

  // Write values after the entries that have one, in their order.
  function tell(box, values) {
    box.querySelectorAll("output").forEach((output, row) => {
      const text = values[row] ?? "";
      if (output.textContent !== text) output.textContent = text;
    });
  }

  return { line, marker, area, show, tell };
})();
