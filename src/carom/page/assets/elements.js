// Elements of the page, each made in one call.

Carom.elements = (() => {
  // An element with these properties, or with this class, and what it holds.
  function make(tag, properties = {}, ...children) {
    const element = document.createElement(tag);
    Object.assign(element, typeof properties === "string" ? { className: properties } : properties);
    element.append(...children);
    return element;
  }

  return { make };
})();
