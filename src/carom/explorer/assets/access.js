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

  // Keys change a number in its field; its buttons are for the hand.
  function nameSteppers() {
    for (const button of document.querySelectorAll(".carom-field .dash-input-stepper")) {
      const field = button.closest(".carom-field").querySelector("input");
      const verb = button.classList.contains("dash-stepper-decrement") ? "Decrease" : "Increase";
      button.ariaLabel = `${verb} ${labelOf(field.id)}`;
      button.tabIndex = -1;
    }
    const file = document.querySelector("#upload input[type=file]");
    if (file) file.tabIndex = -1;
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
    nameSteppers();
    nameLists();
    nameChoices();
  }

  return { name };
})();
