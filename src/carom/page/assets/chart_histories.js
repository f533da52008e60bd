// The charts of time: friction force between its limits, and where the energy is.

Carom.histories = (() => {
  const ENERGIES = { // fill pattern of plotly; their colours are those of the theme
    normal_kinetic_energy: "",
    tangential_kinetic_energy: ".",
    contact_kinetic_energy: ".",
    spin_kinetic_energy: "",
    normal_elastic_energy: "/",
    tangential_elastic_energy: "",
    frictional_work: "\\",
    normal_loss: "x",
    shear_loss: "-",
  };
  const NONE = { sample: "", text: "none: the contact point does not move" };
  const PADDING = 1.06; // of the largest force
  const TIP = "<br>%{y:.4g} at %{x:.4g}<extra></extra>";
  const BESIDE = { dash: "7px,4px", width: 1.5 };

  const color = (name) => Carom.theme.color(name);
  const largest = (values) => values.reduce((most, value) => Math.max(most, Math.abs(value)), 0);
  const last = (values) => values[values.length - 1] ?? 0;

  // The scales of a chart: of one impact in its units; of two, which may differ by powers of ten,
  // each over its own duration and its own limit.
  function scaled({ scene, history }, both) {
    if (!both) return { time: scene.duration, force: 1 };
    return { time: 1, force: 1 / (largest(history.limit) || 1) };
  }

  const times = (values, by) => values.map((value) => value * by);
  const besideKey = () => ({ sample: Carom.keys.line({ ...BESIDE, color: color("beside") }), text: "beside" });

  function time({ scene }, both, longest = 1) {
    const title = both ? "t / t<sub>c</sub>" : Carom.plotting.titled("t", scene.unit);
    return { title, range: [0, longest * (both ? 1 : scene.duration)] };
  }

  function phases({ scene }, both) {
    return scene.phases.map((phase) => Carom.bands.phase(phase, both ? 1 : scene.duration));
  }

  function beside({ history }) {
    const by = scaled({ history }, true).force;
    const look = { ...BESIDE, color: color("beside") };
    return Carom.plotting.line(history.share, times(history.force, by), "beside", look, "beside" + TIP);
  }

  function ofLaws(laws, by) {
    const followed = laws.filter(({ share }) => share.length); // a hard sphere has no force in time
    return followed.map(({ label, share, force }) => {
      const look = { ...Carom.laws.style(label), width: 1.7 };
      return Carom.plotting.line(times(share, by.time), times(force, by.force), label, look, label + TIP);
    });
  }

  function forceTraces([first, second]) {
    const { line } = Carom.plotting;
    const { share, force, limit } = first.history;
    const by = scaled(first, second);
    const at = times(share, by.time);
    const edge = { color: color("limit"), dash: "5px,3px", width: 1.3 };
    return [
      line(at, times(limit, by.force), "", edge),
      line(at, times(limit, -by.force), "", edge),
      ...ofLaws(first.laws, by),
      ...(second ? [beside(second)] : []),
      line(at, times(force, by.force), "exact", { color: color("ink"), width: 2.6 }),
    ];
  }

  function forceKeys(second) {
    const { line } = Carom.keys;
    return [
      { sample: line({ color: color("ink"), width: 2.6 }), text: "F<sub>x</sub>", follows: true },
      { sample: line({ color: color("limit"), dash: "5,3", width: 1.3 }), text: "±µ F<sub>z</sub>", follows: true },
      ...(second ? [besideKey()] : []),
    ];
  }

  function forces([first, second]) {
    const by = scaled(first, second);
    const most = Math.max(largest(first.history.limit), ...first.laws.map(({ force }) => largest(force)));
    const end = (PADDING * Math.max(most * by.force, second ? 1 : 0)) || 1;
    const title = second ? "F<sub>x</sub> / µ F<sub>max</sub>" : Carom.plotting.titled("F_x", first.history.unit);
    return {
      traces: forceTraces([first, second]),
      x: time(first, second, Math.max(1, ...first.laws.map(({ share }) => last(share)))),
      y: { title, range: [-end, end], zeroline: true },
      bands: phases(first, second),
      keys: forceKeys(second),
      hover: first.laws.length > 0 || Boolean(second),
      revision: `${title} ${first.scene.unit}`,
    };
  }

  // The energies that there are.
  function shown({ history }) {
    return Object.keys(history.energies).filter((key) => history.energies[key].some((part) => part > 0));
  }

  const look = (key) => `energy-${key.replace(/_energy$/, "").replaceAll("_", "-")}`;

  function energyTraces([first, second]) {
    const at = times(first.history.share, scaled(first, second).time);
    const hatch = { fgcolor: color("energy-hatch"), fgopacity: 1, size: 6 };
    const drawn = shown(first).map((key) => ({
      ...Carom.plotting.line(at, first.history.energies[key], key, { width: 0.8, color: color("panel") }),
      stackgroup: "energy",
      fillcolor: color(look(key)),
      fillpattern: { ...hatch, shape: ENERGIES[key], bgcolor: color(look(key)) },
    }));
    return alike(first, second) ? [...drawn, ...borders(second)] : drawn;
  }

  // Whether a second impact has its energy shared among the same: all of it, or that of the contact point.
  function alike(first, second) {
    const [one, other] = [first, second].map((each) => each && Object.keys(each.history.energies)[0]);
    return one === other;
  }

  // Of the impact beside only the lines between its energies.
  function borders({ history }) {
    const below = history.share.map(() => 0);
    return shown({ history }).slice(0, -1).map((key) => {
      history.energies[key].forEach((value, row) => (below[row] += value));
      return Carom.plotting.line(history.share, [...below], "beside", { ...BESIDE, color: color("beside") });
    });
  }

  function energies([first, second]) {
    const of = Carom.config.energies;
    const names = first.scene.plate === undefined ? of : { ...of, normal_loss: Carom.losses.sink(first.scene) };
    const keys = shown(first).map((key) => ({ sample: Carom.keys.area(look(key)), text: names[key], follows: true }));
    return {
      traces: energyTraces([first, second]),
      x: time(first, second),
      y: { title: "E (%)", range: [0, 1], tickvals: [0, 0.25, 0.5, 0.75, 1], ticktext: ["0", "25", "50", "75", "100"] },
      bands: phases(first, second),
      keys: [...(keys.length ? keys : [NONE]), ...(alike(first, second) ? [besideKey()] : [])],
      hover: false,
      revision: `${Boolean(second)} ${first.scene.unit}`,
    };
  }

  // The value of a history at a share of the contact; null outside.
  const between = (values, share) => (share < 0 || share > 1 ? null : Carom.scene.between(values, 0, 1, share));

  const digits = (value) => (value === null ? "" : Number(value.toPrecision(3)).toString().replace("-", "−"));
  const percent = (value) => (value === null ? "" : `${(100 * value).toFixed(0)}\u00a0%`);

  // What the keys say of an instant.
  function forcesAt([first, second], share) {
    const by = scaled(first, second).force;
    const at = [first.history.force, first.history.limit].map((values) => between(values, share));
    return at.map((value) => digits(value === null ? null : value * by));
  }

  function energiesAt([{ history }], share) {
    return shown({ history }).map((key) => percent(between(history.energies[key], share)));
  }

  return { forces, energies, forcesAt, energiesAt };
})();
