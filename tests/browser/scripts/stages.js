() => [...document.querySelectorAll('#film canvas')]
  .filter(each => each.checkVisibility())
  .map(each => { const box = each.getBoundingClientRect();
    return [box.left, box.top, innerWidth - box.right, innerHeight - box.bottom]; }).flat()
