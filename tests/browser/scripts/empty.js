about => [...document.querySelectorAll('.carom-card, .carom-cell')]
  .filter(card => card.checkVisibility()).map(card => {
    const box = card.getBoundingClientRect();
    const boxes = [];
    const walk = document.createTreeWalker(card, NodeFilter.SHOW_TEXT);
    while (walk.nextNode()) { if (!walk.currentNode.textContent.trim()) continue;
      const range = document.createRange(); range.selectNodeContents(walk.currentNode);
      boxes.push(...range.getClientRects()); }
    card.querySelectorAll('canvas, .main-svg, tr, input, select, button, .carom-drop')
      .forEach(each => each.checkVisibility() && boxes.push(each.getBoundingClientRect()));
    const [step, count] = [8, { all: 0, empty: 0 }];
    for (let x = box.left + step / 2; x < box.right; x += step)
      for (let y = box.top + step / 2; y < box.bottom; y += step) {
        count.all++;
        if (!boxes.some(b => x > b.left - about && x < b.right + about
          && y > b.top - about && y < b.bottom + about)) count.empty++; }
    return { card: card.id || card.innerText.slice(0, 20), empty: count.empty / count.all }; })
