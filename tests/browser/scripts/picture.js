([part, share, width, height, colors]) => {
  const canvas = document.createElement("canvas");
  canvas.style.cssText = `display: block; width: ${width}px; height: ${height}px`;
  document.body.append(canvas);
  Carom[part].draw(canvas, Carom.page.scenes[0], share);
  const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
  const size = [canvas.height, canvas.width];
  canvas.remove();
  const text = Array.from(data, byte => String.fromCharCode(byte)).join("");
  return { size, data: btoa(text), colors: colors.map(name => Carom.theme.color(name)) };
}
