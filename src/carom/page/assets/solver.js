// An impact in plain numbers, solved by the library's own kernels. Units are those of the elastic
// impact on a thick wall: d_max, V_1, d_max/V_1. Losses are alpha of viscous bodies or lambda of a
// plate that gives way, one of them or none.

Carom.solver = (() => {
  const { kernels } = Carom;
  const { numbers, array, filled, rows, lasting, within, call } = kernels;
  const { columns, sizes, losses, kinds, tolerances, smallest, largest_psi: LARGEST, inertia } = Carom.wasm;
  const TIMES = 200; // intervals of histories
  const [INSTANTS, RADII] = [60, 33]; // intervals and radii at which tractions are told
  const SPRINGS = 160;
  const HIGHEST = 9; // of a traction: at the edge it is infinite while viscous bodies load
  const [SHORTEST, SHORTEST_VISCOUS] = [1e-12, 1e-6]; // of a phase
  const JUST = 1 - 1e-9; // of the area of a contact: springs beyond are touched at that time, and bear nothing yet
  const AT_ONCE = 1e-12; // by which springs in series with dashpots are as Kelvin's & Voigt's
  const LEAST_ALPHA = -18; // powers of e between which alpha is sought
  const MOST_ALPHA = 6;
  const [HALVED, TRIALS, ROUNDING] = [4, 60, 1e-14];
  const HALVINGS = 32; // of a panel, to find an instant
  const alphas = new Map();

  const even = (count, last) => Float64Array.from({ length: count + 1 }, (_, i) => (last * i) / count);
  const clamped = (value, low, high) => Math.min(high, Math.max(low, value));

  // The alpha that gives a restitution.
  function alphaOf(e) {
    if (e === 1) return 0;
    if (!alphas.has(e)) alphas.set(e, within(() => sought(e)));
    return alphas.get(e);
  }

  // By false position in log(alpha), the end that stays weighed half (the Illinois method).
  function sought(e) {
    const excess = (at) => call("lossy.viscoelastic.normal.restitution", [Math.exp(at), ...lasting.viscous])[0] - e;
    let [low, high] = [LEAST_ALPHA, MOST_ALPHA];
    let [over, under] = [excess(low), excess(high)];
    for (let i = 0; i < TRIALS && high - low > ROUNDING; i++) {
      const next = i < HALVED ? 0.5 * (low + high) : high - (under * (high - low)) / (under - over);
      const value = excess(next);
      if (value > 0) [low, over, under] = [next, value, i < HALVED ? under : 0.5 * under];
      else [high, under, over] = [next, value, i < HALVED ? over : 0.5 * over];
      if (Math.abs(value) < ROUNDING) return Math.exp(next);
    }
    return Math.exp(0.5 * (low + high));
  }

  // psi_2 of many impacts, NaN of those that are not solved.
  function rebounds(psi, chi, { alpha, give }, tolerance = tolerances.panel) {
    return within(() => {
      const out = array([psi.length]);
      const status = array([psi.length], "i1");
      const [at, chis, losing] = [psi, psi.map(() => chi), psi.map(() => alpha || give)].map((each) => filled(each));
      if (!alpha) {
        const work = [...lasting.elastic, ...lasting.nothing, out, status, array([psi.length], "i8")];
        call("rebounds.fill", [at, chis, losing, work]);
        return Array.from(numbers(out), (value, i) => (numbers(status)[i] ? NaN : value));
      }
      const table = array([psi.length, sizes.numbers]);
      const work = [...lasting.viscous, ...lasting.no_panels, table, status];
      call("lossy.viscoelastic.impacts.fill", [at, chis, losing, tolerance, work]);
      return Array.from(psi, (_, i) => (numbers(status)[i] ? NaN : numbers(table)[i * sizes.numbers + columns.numbers.PSI_OUT]));
    });
  }

  // The whole impact: what it comes to, phases as shares of the duration, histories at even times,
  // tractions from the centre to the edge. Null if it is not solved.
  function solve(psi, chi, loss) {
    const solved = within(() => (loss.alpha ? viscous(psi, chi, loss.alpha) : elastic(psi, chi, loss.give)));
    if (!solved) return null;
    const { duration, phases } = solved;
    const share = (phase) => ({ ...phase, start: phase.start / duration, end: phase.end / duration });
    return { psi_in: psi, chi, ...loss, ...solved, phases: phases.map(share), tractions: tractions(psi, chi, loss, solved) };
  }

  // Phases of [end, kind, sign]; what is shorter than can be told joins its neighbour.
  function phasesOf(stretches, mirror, shortest) {
    const phases = [];
    for (const [end, code, slip] of stretches) {
      const [kind, sign] = [kinds[code], mirror * slip || 0];
      const last = phases[phases.length - 1];
      const start = last ? last.end : 0;
      if (last && ((last.kind === kind && last.sign === sign) || end - start <= shortest)) last.end = end;
      else phases.push({ kind, sign, start, end });
    }
    return phases;
  }

  function elastic(psi, chi, give) {
    const { elastic: work, course } = lasting;
    numbers(course[5]).fill(0n);
    const [e, duration, deepest] = give ? call("elastic.plates.normal_motion", [give, tolerances.step, ...work]) : [1, Carom.wasm.duration, 1];
    const solvedFor = psi || give ? Math.max(Math.abs(psi), smallest.elastic) : 0;
    const [status] = call("elastic.phases.run_phases", [solvedFor, chi, give, tolerances.step, ...work, ...course], "i8");
    if (status) return null;
    const [nodes, , changed] = Array.from(numbers(course[5]), Number);
    const [changes, when] = [rows(course[4], changed), array([changed])];
    const steps = [rows(course[0], nodes), rows(course[1], nodes), chi, give, array([nodes]), array([nodes + 1, 2])];
    call("elastic.dense_output.tabulate", [changes, ...steps, when]);
    const [count, wide] = [TIMES + 1, sizes.sampled];
    const sampled = array([count, wide]);
    call("elastic.dense_output.sample", [...steps, filled(even(TIMES, duration)), sampled]);
    const out = numbers(sampled);
    const column = (name) => Float64Array.from({ length: count }, (_, i) => out[i * wide + columns.sampled[name]]);
    const mirror = psi < 0 ? -1 : 1;
    const scale = mirror * Math.min(1, Math.abs(psi) / smallest.elastic);
    const [times, table] = [Array.from(numbers(when)), Array.from(numbers(changes))];
    const kind = (i, name) => table[i * changes.shape[1] + columns.changes[name]];
    const stretches = times.slice(1).map((end, i) => [end, kind(i, "KIND"), kind(i, "KIND_SIGN")]);
    const sticks = [[duration, 0, 0]];
    const depth = column("AT_D");
    const speed = column("AT_V").map((v, i) => v + 1.25 * give * depth[i] ** 1.5);
    return {
      out: rebounds([psi], chi, { alpha: 0, give })[0],
      restitution: e, duration, deepest, strongest: deepest ** 1.5, widest: Math.sqrt(deepest),
      phases: phasesOf(psi ? stretches : sticks, mirror, SHORTEST),
      depth, speed,
      psi: column("AT_PSI").map((value) => scale * value),
      force: column("AT_Q").map((value) => scale * value),
      limit: depth.map((d) => d ** 1.5),
      contact: column("AT_CONTACT"),
      stick: column(psi ? "AT_STICK" : "AT_CONTACT"),
      stored: column("AT_STORED").map((value) => scale ** 2 * value),
      dissipated: column("AT_DISSIPATED").map((value) => scale ** 2 * value),
      shear: new Float64Array(count),
      normalStored: depth.map((d) => d ** 2.5),
      normalLost: depth.map((d, i) => (give ? Math.max(0, 1 - speed[i] ** 2 - d ** 2.5) : 0)),
    };
  }

  function viscous(psi, chi, alpha) {
    const { panels } = lasting;
    const told = array([sizes.numbers]);
    const [status, count] = call("lossy.viscoelastic.impacts.outgoing", [psi, chi, alpha, tolerances.panel, lasting.viscous, panels, told].flat(), "i8");
    if (status) return null;
    const at = (name) => numbers(told)[columns.numbers[name]];
    const [, height, nodes] = panels[0].shape;
    const kept = numbers(panels[0]);
    const duration = at("TIME");
    const series = (panel, name) => kept.subarray((panel * height + columns.rows[name]) * nodes).subarray(0, nodes);
    const ends = Array.from({ length: count }, (_, panel) => series(panel, "AT_TIME")[nodes - 1]);
    const places = Array.from(even(TIMES, duration), (time) => {
      const panel = Math.min(ends.filter((end) => end < time).length, count - 1);
      return [panel, placeOf(series(panel, "AT_TIME"), time)];
    });
    const column = (name) => Float64Array.from(places, ([panel, x]) => interpolated(series(panel, name), x));
    const first = clamped(Math.abs(psi), smallest.viscous, LARGEST);
    const scale = Math.sign(psi) * Math.min(1, Math.abs(psi) / first);
    const excess = Math.max(0, Math.abs(psi) - first);
    const codes = numbers(panels[1]);
    const stretches = psi ? ends.map((end, i) => [end, codes[2 * i], codes[2 * i + 1]]) : [[duration, 0, 0]];
    const moving = column("AT_PSI");
    const contact = column("AT_B").map((value) => Math.max(0, value));
    const stored = column("AT_SQUARE").map((value) => 1.875 * chi * value);
    const shear = column("AT_SHEAR_LOST");
    return {
      out: at("PSI_OUT"), restitution: at("RESTITUTION"), duration,
      deepest: at("DEEPEST"), strongest: at("STRONGEST"), widest: at("WIDEST"),
      phases: phasesOf(stretches, psi < 0 ? -1 : 1, SHORTEST_VISCOUS),
      depth: column("AT_D"), speed: column("AT_V"), contact,
      psi: moving.map((value) => scale * (value + excess)),
      force: column("AT_Q").map((value) => scale * value),
      limit: column("AT_P"),
      stick: psi ? column("AT_STUCK").map((value, i) => Math.min(value, contact[i])) : contact,
      stored: stored.map((value) => scale ** 2 * value),
      dissipated: moving.map((value, i) => scale ** 2 * (0.5 * (first - value) * (first + value + 2 * excess) - stored[i] - shear[i])),
      shear: shear.map((value) => scale ** 2 * value),
      normalStored: column("AT_STORED"), normalLost: column("AT_LOST"),
    };
  }

  // The polynomial through values at Chebyshev's extrema, by the barycentric formula.
  function interpolated(values, x) {
    const last = values.length - 1;
    let [above, below] = [0, 0];
    for (let j = 0; j <= last; j++) {
      const away = x + Math.cos((Math.PI * j) / last);
      if (away === 0) return values[j];
      const weight = ((j % 2 ? -1 : 1) * (j % last ? 1 : 0.5)) / away;
      above += weight * values[j];
      below += weight;
    }
    return above / below;
  }

  // Where rising values pass a level, by bisection.
  function placeOf(values, level) {
    let [low, high] = [-1, 1];
    for (let i = 0; i < HALVINGS; i++) {
      const middle = 0.5 * (low + high);
      [low, high] = interpolated(values, middle) < level ? [middle, high] : [low, middle];
    }
    return 0.5 * (low + high);
  }

  // Between which of rising times others lie, and where between them.
  function placesOf(times, wanted) {
    let i = 0;
    return Array.from(wanted, (time) => {
      while (i < times.length - 2 && times[i + 1] < time) i++;
      const width = times[i + 1] - times[i];
      return [i, width > 0 ? clamped((time - times[i]) / width, 0, 1) : 0];
    });
  }

  const between = (values, places) => Float64Array.from(places, ([i, part]) => (1 - part) * values[i] + part * values[i + 1]);

  // The tractions at even times, by springs: what they bear is linear in x^2 between them.
  function tractions(psi, chi, { alpha, give }, { duration, widest }) {
    return within(() => {
      const solid = alpha ? [BigInt(losses.VISCOUS), AT_ONCE, alpha / AT_ONCE, 0] : [BigInt(losses.PLATE), give, 0, 0];
      const most = SPRINGS + sizes.spare;
      const impact = [Math.min(Math.abs(psi), LARGEST), 0, chi, ...inertia.slice(1), ...solid, BigInt(SPRINGS), ...lasting.trial];
      const work = lasting.springs.slice(0, 4);
      const trace = (count, springs) => {
        const kept = [array([count, sizes.rows]), array([springs ? count : 0, sizes.frames, springs])];
        return [call("lossy.springs.march.trace", [...impact, ...work, ...kept], "i8")[0], ...kept];
      };
      const [count] = trace(0, 0);
      const [, table, frames] = trace(count + 1, most);
      const of = (name) => Float64Array.from({ length: count + 1 }, (_, i) => numbers(table)[i * sizes.rows + columns.rows[name]]);
      const [pulled, times] = [numbers(frames), of("AT_TIME")];
      const x = numbers(work[1]).slice(0, most);
      const places = placesOf(times, even(INSTANTS, times[count]));
      const areas = of("AT_B").map((b) => b * b);
      const [area, moving, speed] = [areas, of("AT_PSI"), of("AT_V")].map((column) => between(column, places));
      const row = (i) => pulled.subarray((i * sizes.frames + columns.frames.PULLED) * most);
      return places.map(([i, part], instant) => {
        const touches = instant > 0 && instant < INSTANTS;
        if (!touches) return Array(RADII).fill(0);
        const [one, other, edge] = [row(i), row(i + 1), Math.sqrt(area[instant])];
        const rim = alpha * Math.max(0, speed[instant]); // what viscous bodies bear there while they load
        const last = clamped(alpha * moving[instant], -rim, rim);
        const bears = (j) => (1 - part) * (x[j] ** 2 < JUST * areas[i] ? one[j] : last) + part * other[j];
        const knots = knotsOf(x, edge, bears, last);
        const of = (radius) => clamped((Math.sign(psi) * traction(knots, radius)) / widest, -HIGHEST, HIGHEST) || 0;
        return Array.from({ length: RADII }, (_, j) => of((edge * j) / (RADII - 1)));
      });
    });
  }

  function knotsOf(x, edge, bears, last) {
    const knots = { s: [], f: [] };
    for (let j = 0; j < x.length && x[j] < edge && (j === 0 || x[j] > x[j - 1]); j++) {
      knots.s.push(x[j] ** 2);
      knots.f.push(bears(j));
    }
    return { s: [...knots.s, edge ** 2], f: [...knots.f, last] };
  }

  // The traction at a radius, by Abel's transform; at a rim that bears a jump it is infinite.
  function traction({ s, f }, radius) {
    const square = radius ** 2;
    const [edge, jump] = [s[s.length - 1], f[f.length - 1]];
    let [total, low] = [jump ? (0.5 * jump) / Math.sqrt(Math.max(0, edge - square)) : 0, -1];
    for (let k = 1; k < s.length; k++) {
      if (s[k] <= square) continue;
      if (low < 0) low = Math.sqrt(Math.max(0, s[k - 1] - square));
      const root = Math.sqrt(s[k] - square);
      if (s[k] > s[k - 1]) total += ((f[k - 1] - f[k]) / (s[k] - s[k - 1])) * (root - low);
      low = root;
    }
    return total;
  }

  // The |psi_1| at which the regime changes.
  function borders(chi, { restitution: e, give, strongest }) {
    return [1, 2 * chi * (1 - 1.25 * give * strongest), 2 * chi * (1 + e) - e].map((border) => Math.max(border, 1));
  }

  return { TIMES, ready: kernels.ready, alphaOf, rebounds, solve, borders };
})();
