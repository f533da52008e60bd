// Names and roles for what Dash leaves without them, for readers of the screen.
window.Carom = window.Carom || {};

Carom.access = (() => {
  const words = (element) => (element ? element.textContent.trim() : "");
  const labelOf = (id) => words(document.querySelector(`label[for="${id}"]`));

  function nameSliders() {
    for (const slider of document.querySelectorAll('input[id$="-slider"]')) {
      slider.ariaLabel = `${labelOf(slider.id.replace(/-slider$/, ""))}, slider`;
    }
  }

  // Their options are labels around boxes to tick, which are reached themselves.
  function nameLists() {
    for (const list of document.querySelectorAll(".carom-field .dash-options-list")) {
      list.setAttribute("role", "group");
      list.ariaLabel = words(list.closest("fieldset")?.querySelector("legend"));
      for (const option of list.querySelectorAll("[role=option]")) {
        option.removeAttribute("role");
        option.removeAttribute("aria-selected");
      }
    }
  }

  function nameChoices() {
    for (const target of document.querySelectorAll(".dash-dropdown-focus-target")) {
      const button = target.parentElement.querySelector("button[id]");
      target.removeAttribute("aria-hidden");
      target.setAttribute("role", "combobox");
      target.setAttribute("aria-expanded", button.getAttribute("aria-expanded") ?? "false");
      target.setAttribute("aria-haspopup", "listbox");
      target.setAttribute("aria-controls", button.id);
      target.ariaLabel = `${labelOf(button.id)}: ${words(button)}`;
    }
  }

  function name() {
    nameSliders();
    nameLists();
    nameChoices();
  }

  return { name };
})();
