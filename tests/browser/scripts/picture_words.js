async ([query, parts, boxes, shares]) => {
  const { scene } = await Carom.reading.answer(query);
  const made = Carom.scene.of(scene);
  const kind = CanvasRenderingContext2D.prototype;
  const fillText = kind.fillText;
  let found = [];
  kind.fillText = function (text, x, y) {
    const box = this.measureText(text);
    const size = parseFloat(this.font);
    const sides = [x - box.actualBoundingBoxLeft, y - box.actualBoundingBoxAscent,
      x + box.actualBoundingBoxRight, y + box.actualBoundingBoxDescent];
    if (text) found.push([text, size, ...sides]);
    return fillText.apply(this, arguments);
  };
  const pictures = [];
  for (const part of parts) for (const [width, height] of boxes) {
    const canvas = document.createElement("canvas");
    canvas.style.cssText = `display: block; width: ${width}px; height: ${height}px`;
    document.body.append(canvas);
    for (const share of shares) {
      found = [];
      Carom.canvas.forget(canvas);
      Carom[part].draw(canvas, made, share);
      pictures.push({ part, width, height, share, words: found });
    }
    canvas.remove();
  }
  kind.fillText = fillText;
  return pictures;
}
