// What the first level tells of an impact: three results, each as a picture and in words.

Carom.summary = (() => {
  const { make } = Carom.elements;
  const LITTLE = 0.5; // degrees that make no other direction
  const LEAST = 0.01; // degrees of throw: what is less is told as less
  const STILL = 1e-6; // of the speed: a slower ball stands
  const TURNED = 6e-6; // rad per m of the way: what turns less does not spin
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
  const OTHER = '<circle class="carom-other" cx="0" cy="27" r="25"/>';

  function leaves(numbers, view) {
    if (view.against === "sphere") return leavesBall(numbers, view);
    const angle = degrees(numbers.rebound_angle);
    const back = angle < -LITTLE ? ", back the way it came" : angle <= LITTLE ? ", straight up" : "";
    const picture = TIP + GROUND + rays(view, numbers.rebound_angle);
    return tile("It leaves", picture, `at ${plain(angle)}°${back}`, `It came at ${plain(view.angle)}°.`);
  }

  const rays = (view, after) => ray((view.angle * Math.PI) / 180, "carom-ray-in", "in") + ray(after, "carom-ray-out", "out");

  // As one sees it who watches two balls, of which the second was at rest.
  function leavesBall(numbers, view) {
    const { along, onwards } = numbers;
    const stays = Math.hypot(along, onwards) < STILL * view.speed;
    const picture = TIP + OTHER + (stays ? ray((view.angle * Math.PI) / 180, "carom-ray-in", "in") : rays(view, Math.atan2(along, -onwards)));
    return tile(stays ? "It stops" : "It leaves", picture, stays ? "where it struck" : direction(along, onwards), thrown(numbers));
  }

  // An angle from the line of centres, and to which side of what is struck.
  function direction(along, onwards) {
    const angle = degrees(Math.atan2(Math.abs(along), Math.abs(onwards)));
    const side = along < 0 && angle > LITTLE ? ", to the side it came from" : "";
    const way = 90 - angle <= LITTLE ? "" : onwards > 0 ? ", onwards" : ", back";
    return `at ${plain(angle)}° to the line of centres${way}${side}`;
  }

  function thrown({ throw: angle }) {
    const size = Math.abs(degrees(angle));
    if (size === 0) return "The other ball leaves along the line of centres.";
    const side = angle < 0 ? ", against the motion" : "";
    const told = size < LEAST ? `less than ${LEAST}` : plain(size);
    return `The other ball is thrown ${told}° off the line of centres${size < LEAST ? "" : side}.`;
  }

  // Between balls it is side spin, which has no top.
  function kindOf(spin, { against }) {
    if (against === "sphere") return `side spin ${spin > 0 ? "along" : "against"} the motion`;
    return spin > 0 ? "backspin" : "topspin";
  }

  function spins({ spin_out: spin }, view) {
    const turns = (value) => plain(value / (2 * Math.PI));
    const still = Math.abs(spin) < TURNED * Math.abs(view.speed) || spin === 0;
    const arc = still ? "" : `<path class="carom-ray-out" d="M${spin > 0 ? "20 -2 A26 26 0 1 0 -20 -2" : "-20 -2 A26 26 0 1 1 20 -2"}" marker-end="url(#carom-tip)"/>`;
    const picture = `${TIP}<circle class="carom-ball" cx="0" cy="-12" r="16"/>${arc}`;
    const words = still ? "without spin" : `with ${turns(spin)} turns/s, ${kindOf(spin, view)}`;
    const rate = still ? "" : `That is ${plain(spin)} rad/s. `;
    const came = view.spin ? `It came with ${turns(view.spin)} turns/s, ${kindOf(view.spin, view)}.` : "It came without spin.";
    return tile("It spins", picture, words, rate + came);
  }

  function keeps({ energy_kept: kept }, answer) {
    const picture = `<rect class="carom-lost" x="-40" y="-20" width="80" height="18"/><rect class="carom-kept" x="-40" y="-20" width="${80 * kept}" height="18"/>`;
    return tile("Energy left", picture, Carom.losses.percent(kept), Carom.losses.told(answer));
  }

  function show(answer) {
    const { numbers, view } = answer;
    box.hidden = !numbers;
    if (numbers) box.replaceChildren(leaves(numbers, view), spins(numbers, view), keeps(numbers, answer));
  }

  return { show };
})();
