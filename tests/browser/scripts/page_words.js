() => {
  const clip = at => { const box = { left: 0, top: 0, right: innerWidth, bottom: innerHeight };
    for (let e = at; e && e !== document.body; e = e.parentElement) {
      const style = getComputedStyle(e);
      if (!/auto|scroll|hidden/.test(style.overflowX + style.overflowY)) continue;
      const b = e.getBoundingClientRect();
      box.left = Math.max(box.left, b.left); box.right = Math.min(box.right, b.right);
      box.top = Math.max(box.top, b.top); box.bottom = Math.min(box.bottom, b.bottom); }
    return box; };
  const found = [];
  const add = (at, text, r) => { const c = clip(at);
    found.push({ text, box: [r.left, r.top, r.right, r.bottom],
      seen: r.left > c.left - 1 && r.right < c.right + 1
        && r.top > c.top - 1 && r.bottom < c.bottom + 1,
      aside: r.left < c.left - 1.5 || r.right > c.right + 1.5 }); };
  const walk = document.createTreeWalker(document.getElementById('page'), NodeFilter.SHOW_TEXT);
  while (walk.nextNode()) {
    const node = walk.currentNode, at = node.parentElement;
    if (!node.textContent.trim()
      || !at.checkVisibility({ visibilityProperty: true, opacityProperty: true })
      || at.closest('select, .hoverlayer, pre, sub, sup, #tip')) continue;
    const around = [at, at.closest('h2') || at];
    if (around.some(each => getComputedStyle(each).clipPath !== 'none')) continue;
    const range = document.createRange(); range.selectNodeContents(node);
    for (const r of range.getClientRects()) if (r.width > 1) add(at, node.textContent.trim(), r); }
  return found; }
