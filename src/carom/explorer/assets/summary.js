// What the first level tells of an impact: three results, each as a picture and in words.

Carom.summary = (() => {
  const { make } = Carom.elements;
  const LITTLE = 0.5; // degrees, turns a second and percent: what is less is not told
  const box = document.getElementById("summary");
  const degrees = (angle) => (angle * 180) / Math.PI;
  const plain = (value, digits = 3) => Carom.quantities.plain(Math.abs(value), digits);

  function tile(title, picture, ...words) {
    const figure = make("figure", "carom-tile");
    figure.innerHTML = `<svg viewBox="-50 -46 100 64" aria-hidden="true">${picture}</svg>`;
    figure.append(make("figcaption", "", make("h2", "", title), ...words.map((text) => make("p", "", text))));
    return figure;
  }

  const ray = (angle, look, ends) => {
    const [x, y] = [40 * Math.sin(angle), -40 * Math.cos(angle)];
    const from = ends === "in" ? `M${-x} ${y} L0 0` : `M0 0 L${x} ${y}`;
    return `<path class="${look}" d="${from}" marker-end="url(#carom-tip)"/>`;
  };
  const TIP = '<marker id="carom-tip" viewBox="0 0 6 6" refX="5" refY="3" markerWidth="5" markerHeight="5" orient="auto"><path d="M0 0 L6 3 L0 6z" fill="context-stroke"/></marker>';
  const GROUND = '<path class="carom-ground" d="M-50 2 H50 V10 H-50z"/>';

  function leaves({ rebound_angle: after, throw: thrown }, view) {
    const angle = degrees(after);
    const back = angle < -LITTLE ? ", back the way it came" : angle <= LITTLE ? ", straight up" : "";
    const picture = TIP + GROUND + ray((view.angle * Math.PI) / 180, "carom-ray-in", "in") + ray(after, "carom-ray-out", "out");
    const came = view.against === "sphere" ? `The other ball is thrown ${plain(degrees(thrown))}° off the line of centres.` : `It came at ${plain(view.angle)}°.`;
    return tile("It leaves", picture, `at ${plain(angle)}°${back}`, came);
  }

  function spins({ spin_out: spin }, view) {
    const turns = spin / (2 * Math.PI);
    const still = Math.abs(turns) < 1e-6 * Math.abs(view.speed) || turns === 0;
    const arc = still ? "" : `<path class="carom-ray-out" d="M${spin > 0 ? "20 -2 A26 26 0 1 0 -20 -2" : "-20 -2 A26 26 0 1 1 20 -2"}" marker-end="url(#carom-tip)"/>`;
    const picture = `${TIP}<circle class="carom-ball" cx="0" cy="-12" r="16"/>${arc}`;
    const kind = spin > 0 ? "backspin" : "topspin";
    const words = still ? "without spin" : `with ${plain(turns)} turns/s, ${kind}`;
    return tile("It spins", picture, words, view.spin ? `It came with ${plain(view.spin / (2 * Math.PI))}, ${view.spin > 0 ? "backspin" : "topspin"}.` : "It came without spin.");
  }

  function keeps({ energy_kept: kept }, { history }) {
    const rubbed = history.energies.frictional_work.at(-1);
    const percent = (value) => `${plain(100 * value, value > 0.999 ? 5 : 3)} %`;
    const picture = `<rect class="carom-lost" x="-40" y="-20" width="80" height="18"/><rect class="carom-kept" x="-40" y="-20" width="${80 * kept}" height="18"/>`;
    const lost = 1 - kept - rubbed;
    const words = [rubbed > 1e-4 ? `${percent(rubbed)} is rubbed away` : "", lost > 1e-4 ? `${percent(lost)} is lost inside the bodies` : ""].filter(Boolean);
    return tile("Energy left", picture, percent(kept), words.length ? `${words.join(", ")}.` : "Nothing is lost.");
  }

  function show(answer) {
    const { numbers, view } = answer;
    box.hidden = !numbers;
    if (numbers) box.replaceChildren(leaves(numbers, view), spins(numbers, view), keeps(numbers, answer));
  }

  return { show };
})();
