// What a contact remembers: springs at s = r^2, deflected by u, of which each bears at most D - s.
// Between knots u is linear in s, and a knot lies wherever slip begins, so that a front is sharp.

Carom.springs = (() => {
  const MOST = 16384; // knots
  const NEAREST = 1e-5; // in s: of viscous springs, what is closer to a knot is not told apart
  const NOTHING = 1e-14; // of a deflection: rounding

  function lines() {
    const [s, x, u] = [0, 1, 2].map(() => new Float64Array(MOST));
    return { s, x, u, side: new Int8Array(MOST), count: 0 };
  }

  function create(viscous) {
    let now = lines();
    let next = lines();
    let first = 0; // how far the centre is beyond its limit, negative within
    let front = 0;
    now.count = 1;

    function put(s, x, u, side) {
      let at = next.count;
      // in elastic slip u follows the limit, linear in s: what lies between two knots says nothing
      const says = viscous || !side || at < 2 || next.side[at - 1] !== side || next.side[at - 2] !== side;
      if (!says) at -= 1;
      next.s[at] = s;
      next.x[at] = x;
      next.u[at] = u;
      next.side[at] = side;
      next.count = at + 1;
    }

    // Leave out what the edge has passed.
    function trim(edge) {
      let last = now.count - 1;
      if (now.s[last] <= edge) return;
      while (last > 0 && now.s[last - 1] >= edge) last--;
      if (last > 0) {
        const part = (edge - now.s[last - 1]) / (now.s[last] - now.s[last - 1]);
        now.u[last] = now.u[last - 1] + part * (now.u[last] - now.u[last - 1]);
      }
      now.s[last] = edge;
      now.x[last] = Math.sqrt(edge);
      now.count = last + 1;
    }

    // Follow the bodies, which shift over a step, as far as friction allows. The penetration is that
    // before and after; of what viscous springs lag behind the limit, the part `left` is left.
    function move(shift, before, after, edge, left) {
      trim(edge);
      const grows = edge > now.s[now.count - 1];
      next.count = 0;
      front = -1;
      let [wasS, wasFree, wasAbove, wasBelow, wasSide] = [0, 0, 0, 0, 0];
      for (let k = 0; k < now.count; k++) {
        const s = now.s[k];
        let high = after - s + left * (now.u[k] - before + s);
        let low = s - after + left * (now.u[k] + before - s);
        if (high < low) high = low = 0.5 * (high + low); // let go
        const free = now.u[k] + shift;
        const above = free - high;
        const below = low - free;
        const side = above > NOTHING ? 1 : below > NOTHING ? -1 : 0;
        if (k === 0) {
          first = Math.max(above, below);
          if (side) front = 0;
        } else if (side !== wasSide) {
          const up = (side || wasSide) > 0;
          const from = up ? wasAbove : wasBelow;
          const part = Math.min(1, Math.max(0, from / (from - (up ? above : below)) || 0));
          const place = wasS + part * (s - wasS);
          if (side && front < 0) front = place;
          const apart = Math.min(place - wasS, s - place) > (viscous ? NEAREST : 0);
          if (apart) put(place, Math.sqrt(place), wasFree + part * (free - wasFree), side || wasSide);
        }
        put(s, now.x[k], Math.min(high, Math.max(low, free)), side);
        wasS = s;
        wasFree = free;
        wasAbove = above;
        wasBelow = below;
        wasSide = side;
      }
      if (grows) put(edge, Math.sqrt(edge), 0, next.side[next.count - 1]);
      [now, next] = [next, now];
    }

    function borne(k, depth, tension) {
      const most = Math.max(0, depth - now.s[k]);
      return Math.max(-most, Math.min(most, now.u[k] + tension));
    }

    // What springs bear, the part of their dashpots in `tension` included, integrated over x.
    function pull(depth, tension) {
      let total = 0;
      let load = borne(0, depth, tension);
      for (let k = 1; k < now.count; k++) {
        const [x, y] = [now.x[k - 1], now.x[k]];
        const other = borne(k, depth, tension);
        if (y > x) total += (y - x) * (load + ((other - load) * (2 * x + y)) / (3 * (x + y)));
        load = other;
      }
      return total;
    }

    // The power of friction on viscous springs, times alpha: the rate that slips is what the free
    // load has beyond the limit.
    function rubbing(depth, tension) {
      let total = 0;
      let most = depth;
      let over = Math.abs(now.u[0] + tension) - depth;
      for (let k = 1; k < now.count; k++) {
        const [x, y] = [now.x[k - 1], now.x[k]];
        const least = Math.max(0, depth - now.s[k]);
        const beyond = Math.abs(now.u[k] + tension) - least;
        if (y > x && (over > 0 || beyond > 0)) total += rubbed(x, y, most, least, over, beyond);
        most = least;
        over = beyond;
      }
      return total;
    }

    // Simpson's rule over a cell, or over that part of it which slips.
    function rubbed(x, y, most, least, over, beyond) {
      const width = y * y - x * x;
      const place = over / (over - beyond);
      const from = over > 0 ? 0 : place;
      const till = beyond > 0 ? 1 : place;
      const low = from ? Math.sqrt(x * x + from * width) : x;
      const high = till < 1 ? Math.sqrt(x * x + till * width) : y;
      const middle = (0.25 * (low + high) * (low + high) - x * x) / width;
      const at = (part) => (most + part * (least - most)) * (over + part * (beyond - over));
      return ((high - low) * (at(from) + 4 * at(middle) + at(till))) / 6;
    }

    // The integral of u^2 over x.
    function squared() {
      let total = 0;
      for (let k = 1; k < now.count; k++) {
        const [s, t, x, y] = [now.s[k - 1], now.s[k], now.x[k - 1], now.x[k]];
        if (!(t > s)) continue;
        const slope = (now.u[k] - now.u[k - 1]) / (t - s);
        const base = now.u[k - 1] - slope * s;
        total += base * base * (y - x) + (2 / 3) * base * slope * (y * t - x * s);
        total += 0.2 * slope * slope * (y * t * t - x * s * s);
      }
      return total;
    }

    // Loads as lines between knots, also where the limit cuts them.
    function loads(depth, tension) {
      const knots = { s: [], f: [] };
      for (let k = 0; k < now.count; k++) {
        if (k && viscous) cutBetween(k, depth, tension, knots);
        knots.s.push(now.s[k]);
        knots.f.push(borne(k, depth, tension));
      }
      return knots;
    }

    function cutBetween(k, depth, tension, knots) {
      const [s, t] = [now.s[k - 1], now.s[k]];
      const [u, w] = [now.u[k - 1] + tension, now.u[k] + tension];
      [1, -1].forEach((sign) => {
        const [from, till] = [sign * u - depth + s, sign * w - depth + t];
        if (from * till >= 0) return;
        const part = from / (from - till);
        knots.s.push(s + part * (t - s));
        knots.f.push(u + part * (w - u));
      });
    }

    // Whether the contact sticks, slips in a ring or as a whole, and where the front is; of elastic
    // springs by what they did in the step, of viscous ones by what they bear at its end.
    function state(depth, tension, loading) {
      const last = now.count - 1;
      let sign = 0;
      if (viscous) sign = slipping(depth, tension);
      else for (let k = last; k >= 0 && !sign; k--) sign = now.side[k];
      if (!sign && !loading) [sign, front] = [Math.sign(now.u[last] + tension), now.s[last]]; // it lets go
      const kind = !sign ? "stick" : front === 0 ? "gross slip" : "slip";
      return { kind, sign, front: kind === "stick" ? Infinity : Math.max(front, 0), first };
    }

    // The sign of slip of the ring outside the front, which is found on the way.
    function slipping(depth, tension) {
      let [was, sign] = [0, 0];
      front = -1;
      for (let k = 0; k < now.count; k++) {
        const load = now.u[k] + tension;
        const over = Math.abs(load) - Math.max(0, depth - now.s[k]);
        if (k === 0) first = over;
        if (over > NOTHING) {
          sign = Math.sign(load);
          if (front < 0) front = k ? now.s[k - 1] + (was / (was - over)) * (now.s[k] - now.s[k - 1]) : 0;
        } else if (k < now.count - 1) [front, sign] = [-1, 0];
        was = Math.min(over, 0);
      }
      return sign;
    }

    return { move, pull, rubbing, squared, loads, state };
  }

  // The traction at a radius that loads between knots come to, by Abel's transform.
  function traction({ s, f }, r, edge) {
    const square = r * r;
    const last = s.length - 1;
    let [total, low] = [0, -1];
    for (let k = 1; k <= last; k++) {
      if (s[k] <= square) continue;
      const root = Math.sqrt(s[k] - square);
      if (low < 0) low = Math.sqrt(Math.max(0, s[k - 1] - square));
      if (s[k] > s[k - 1]) total += ((f[k - 1] - f[k]) / (s[k] - s[k - 1])) * (root - low);
      low = root;
    }
    if (Math.abs(f[last]) > NOTHING) total += (0.5 * f[last]) / Math.sqrt(Math.max(0, edge - square));
    return total;
  }

  return { create, traction };
})();
