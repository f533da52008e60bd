() => {
  const at = document.activeElement;
  const near = [at, at.parentElement, at.parentElement && at.parentElement.parentElement];
  const marked = near.some(each => each && (style => style.outlineStyle !== 'none'
    && parseFloat(style.outlineWidth) >= 1)(getComputedStyle(each)));
  const inside = at.closest('.dash-dropdown-wrapper');
  const button = inside && inside.querySelector('button');
  return { id: at.id || (button && button.id) || at.name || at.innerText || at.className,
    tag: at.tagName, marked };
}
