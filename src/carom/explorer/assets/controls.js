// What the controls say, as the query of a link; and sliders that follow their numbers.
window.dash_clientside = window.dash_clientside || {};
window.dash_clientside.controls = {
  PLAIN: /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i, // what a slider can follow

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
    return [same, this.PLAIN.test(number) ? Number(number) : same];
  },

  // What is not given, or not there, is not asked for.
  hide(given, against) {
    const numbers = given === "numbers";
    return [!numbers, numbers, numbers, against === "half-space", numbers, numbers];
  },

  // The controls as they are when the reader, not a link, goes over from bodies to numbers.
  leaves_bodies(given, restored, view) {
    const byLink = restored !== this.restored;
    this.restored = restored;
    return byLink || given !== "numbers" ? window.dash_clientside.no_update : view;
  },

  // A file is fitted again when the bodies change: it may not tell its own.
  refit(names, query, file) {
    const bodies = this.told(names, query);
    if (!file || file.bodies === bodies) return window.dash_clientside.no_update;
    return { ...file, bodies };
  },

  told(names, query) {
    const found = new URLSearchParams(query ?? "");
    return names.map((name) => found.getAll(name)).join(";");
  },

  accept(names, largest, contents, name, query) {
    const same = window.dash_clientside.no_update;
    if (!contents) return [same, same, same, same];
    const size = Math.floor((contents.length - contents.indexOf(",") - 1) * 0.75);
    if (size > largest) {
      const wrong = `file: ${name} has ${size} bytes; it must be at most ${largest}`;
      return [null, wrong, "", null];
    }
    const file = { contents, name, bodies: this.told(names, query), read: Date.now() };
    return [file, "", "", null]; // so that the same file can be sent again
  },

  // A data set that comes along takes the place of a file.
  dismiss: (data) => (data ? null : window.dash_clientside.no_update),
};
