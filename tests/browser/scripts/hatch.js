sign => {
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = 60;
  const pen = canvas.getContext("2d");
  Carom.canvas.band(pen, 0, 0, 60, 60, { kind: "slip", sign });
  return Array.from(pen.getImageData(0, 0, 60, 60).data);
}
