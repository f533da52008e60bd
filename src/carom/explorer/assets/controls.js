// What the controls say, as the query of a link; and sliders that follow their numbers.
window.dash_clientside = window.dash_clientside || {};
window.dash_clientside.controls = {
  query(names, values) {
    const found = new URLSearchParams();
    names.forEach((name, place) => {
      const value = values[place];
      if (Array.isArray(value)) value.forEach((each) => found.append(name, each));
      else found.append(name, Number.isNaN(value) ? "" : (value ?? ""));
    });
    return found.toString();
  },

  // A slider moves its number; a number moves its slider, as far as that goes.
  follow(number, slider) {
    const same = window.dash_clientside.no_update;
    const moved = window.dash_clientside.callback_context.triggered_id ?? "";
    if (String(moved).endsWith("-slider")) return [Number(slider), same];
    return [same, Number.isFinite(number) ? number : same];
  },

  accept(contents, name, largest) {
    const same = window.dash_clientside.no_update;
    if (!contents) return [same, same];
    const size = Math.floor((contents.length - contents.indexOf(",") - 1) * 0.75);
    if (size > largest) {
      return [same, `file: ${name} has ${size} bytes; it must be at most ${largest}`];
    }
    return [{ contents, name, read: Date.now() }, ""];
  },
};
