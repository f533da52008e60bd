// What both canvases share: sharp at any pixel density, arrows, words.
window.Carom = window.Carom || {};

Carom.canvas = (() => {
  const FONT = "system-ui, -apple-system, 'Segoe UI', Roboto, sans-serif";

  // Clear a canvas, fit it to its box; null where there is no room to draw.
  function ready(canvas) {
    const { clientWidth: width, clientHeight: height } = canvas;
    if (width < 40 || height < 40) return null;
    const dense = window.devicePixelRatio || 1;
    canvas.width = Math.round(width * dense); // clears, and forgets how the pen was left
    canvas.height = Math.round(height * dense);
    const pen = canvas.getContext("2d");
    pen.scale(dense, dense);
    return { pen, width, height };
  }

  function word(pen, text, x, y, { align = "left", base = "alphabetic", color, size = 12 } = {}) {
    pen.font = `${size}px ${FONT}`;
    pen.textAlign = align;
    pen.textBaseline = base;
    pen.fillStyle = color || Carom.theme.color("ink");
    pen.fillText(text, x, y);
  }

  // A word that is read on any ground.
  function haloed(pen, text, x, y, options = {}) {
    pen.font = `${options.size || 12}px ${FONT}`;
    pen.textAlign = options.align || "left";
    pen.textBaseline = options.base || "alphabetic";
    pen.lineJoin = "round";
    pen.lineWidth = 3.5;
    pen.strokeStyle = Carom.theme.color("panel");
    pen.strokeText(text, x, y);
    word(pen, text, x, y, options);
  }

  function arrow(pen, x0, y0, x1, y1, color, width = 2) {
    const length = Math.hypot(x1 - x0, y1 - y0);
    if (length < 1) return;
    const head = Math.min(4 + 2.2 * width, 0.6 * length);
    const [ux, uy] = [(x1 - x0) / length, (y1 - y0) / length];
    const [bx, by] = [x1 - ux * head, y1 - uy * head];
    pen.beginPath();
    pen.moveTo(x0, y0);
    pen.lineTo(bx, by);
    pen.strokeStyle = color;
    pen.lineWidth = width;
    pen.lineCap = "butt";
    pen.stroke();
    pen.beginPath();
    pen.moveTo(x1, y1);
    pen.lineTo(bx - uy * head * 0.45, by + ux * head * 0.45);
    pen.lineTo(bx + uy * head * 0.45, by - ux * head * 0.45);
    pen.closePath();
    pen.fillStyle = color;
    pen.fill();
  }

  // The colour of what slips or sticks.
  function phaseColor(kind, sign) {
    if (kind === "stick") return Carom.theme.color("stick");
    const name = kind === "gross slip" ? "gross" : "slip";
    return Carom.theme.color(`${name}-${sign < 0 ? "minus" : "plus"}`);
  }

  // Lines across a box, rising to the right for slip +, falling for slip −: read without colour.
  function hatch(pen, x, y, size, sign, gap = 9) {
    pen.beginPath();
    for (let along = -size; along < 2 * size; along += gap) {
      const [from, to] = sign < 0 ? [along, along + size] : [along + size, along];
      pen.moveTo(x + from, y);
      pen.lineTo(x + to, y + size);
    }
    pen.stroke();
  }

  return { ready, word, haloed, arrow, phaseColor, hatch };
})();
