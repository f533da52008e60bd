() => {
  const parse = text => text.match(/[\d.]+/g).map(Number);
  const light = rgb => rgb.slice(0, 3).map(v => v / 255)
    .map(v => v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4)
    .reduce((sum, v, i) => sum + v * [0.2126, 0.7152, 0.0722][i], 0);
  const ground = at => { for (; at; at = at.parentElement) {
    const found = parse(getComputedStyle(at).backgroundColor);
    if (found.length === 3 || found[3] > 0.99) return found; } return [255, 255, 255]; };
  const words = at => [...at.childNodes].some(n => n.nodeType === 3 && n.textContent.trim());
  return [...document.querySelectorAll('#page *')]
    .filter(at => at.checkVisibility() && words(at) && !at.closest('svg'))
    .map(at => { const [a, b] = [light(parse(getComputedStyle(at).color)), light(ground(at))];
      return { text: at.textContent.trim().slice(0, 30),
        ratio: (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05) }; });
}
