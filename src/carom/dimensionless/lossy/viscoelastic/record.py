"""What a viscoelastic impact leaves behind: a few numbers, where its energy went, its panels.

Springs that stick have u' = psi, those that slip u = sigma (w - alpha h), u' = sigma (v + h), with
w = d - s. What the dashpots lose is alpha u'^2, and u^2/2 of each spring that the edge lets go; the
rest is lost to friction.
"""

from typing import NamedTuple

import numpy as np

from carom.dimensionless.elastic.phases import Kind
from carom.dimensionless.lossy import layout
from carom.dimensionless.lossy.viscoelastic import contact, normal, work as at
from carom.dimensionless.lossy.viscoelastic.contact import Fading, Front, Mode, Ring, cubes
from carom.dimensionless.lossy.viscoelastic.normal import Motion, Stage
from carom.dimensionless.lossy.viscoelastic.work import Arrays, Panel, State
from carom.dimensionless.numerics.arrays import Array, CodePairs, Cube
from carom.dimensionless.numerics.kernels import kernel

ABSCISSAS, WEIGHTS = np.polynomial.legendre.leggauss(8)
NEAR_FRONT = 1e-6  # relative, of squares of radii at which a ring begins
LAYERS = np.array([0.0, 2.0, 6.0, 14.0, 38.0])  # ages of h, in alpha, between which it is smooth

TERNARY_STEPS = 40


class Moments(NamedTuple):
    """Integrals over the ring of h, h s and h^2, and h at the edge."""

    plain: float
    weighted: float
    square: float
    edge: float


@kernel
def passed_moments(
    work: Arrays, n: int, fading: Fading, x0: float, x1: float
) -> tuple[float, float, float]:
    """Return the integrals of h, h s and h^2 over what the front passed in part of a panel.

    By parts, as the front comes to the centre like the root of time: -[h r] + integral of r dh.
    """
    table, plain, weighted, square, high = work.series, 0.0, 0.0, 0.0, x1
    for layer in range(1, LAYERS.size):
        if high <= x0:
            break
        oldest = fading.time - LAYERS[layer] * fading.alpha
        low = x0
        if at.evaluate(table, n, at.TIME, x0) < oldest:
            low = max(x0, min(high, at.place(table, n, at.TIME, oldest, x0, high)))
        half = 0.5 * (high - low)
        for k in range(ABSCISSAS.size):
            x = low + half * (1.0 + ABSCISSAS[k])
            r, h = front_at(work, n, x), contact.left_at(work, n, fading, x)
            rise = half * WEIGHTS[k] * slope_of_left(work, n, fading, x)
            plain += rise * r
            weighted += rise * r * r * r / 3.0
            square += rise * 2.0 * h * r
        high = low
    for end, x in ((1.0, x0), (-1.0, x1)):
        r, h = front_at(work, n, x), contact.left_at(work, n, fading, x)
        plain += end * h * r
        weighted += end * h * r * r * r / 3.0
        square += end * h * h * r
    return plain, weighted, square


@kernel
def front_at(work: Arrays, n: int, x: float) -> float:
    """Return where the front was at a place of a panel."""
    return float(np.sqrt(max(at.evaluate(work.series, n, at.FRONT, x), 0.0)))


@kernel
def slope_of_left(work: Arrays, n: int, fading: Fading, x: float) -> float:
    """Return the derivative of h by the place where its spring was passed."""
    table, alpha, sign = work.series, fading.alpha, fading.sign
    ago = at.evaluate(table, n, at.TIME, x) - fading.time
    excess = sign * at.evaluate(table, n, at.PSI, x) - at.evaluate(table, n, at.SPEED, x)
    change = sign * at.slope(table, n, at.PSI, x) - at.slope(table, n, at.SPEED, x)
    return float(np.exp(ago / alpha) * (change + excess * at.slope(table, n, at.TIME, x) / alpha))


@kernel
def entry_moments(
    work: Arrays, i: int, fading: Fading, edge: float, x1: float
) -> tuple[float, float, float]:
    """Return the integrals over an entry of the stack, from the edge to a place of its panel."""
    row, n = work.passed[i], int(work.passed[i, contact.PASSED_PANEL])
    outer, inner = min(row[contact.R_OUTER], edge), row[contact.R_INNER]
    if outer <= inner:
        return 0.0, 0.0, 0.0
    if row[contact.PASSED_PANEL] == contact.AT_ONCE:
        h = contact.left(work, i, True, fading)
        return h * (outer - inner), h * cubes(inner, outer), h * h * (outer - inner)
    x0 = row[contact.X_OUTER]
    if outer < row[contact.R_OUTER]:
        x0 = at.place(work.series, n, at.FRONT, outer * outer, x0, x1)
    return passed_moments(work, n, fading, x0, x1)


@kernel
def gap_end(work: Arrays, i: int, ring: Ring, front: float) -> float:
    """Return where what the front jumped ends; rounding of levels is much of a thin ring."""
    if i < ring.depth - 1:
        return float(work.passed[i + 1, contact.R_OUTER])
    if ring.mode == Mode.RETREATS:
        return float(np.sqrt(work.values[at.FRONT, 0]))
    return float(work.passed[i, contact.R_INNER]) if ring.mode == Mode.RETURNS else front


@kernel
def edge_left(work: Arrays, i: int, fading: Fading, edge: float) -> float:
    """Return h at the edge, which an entry of the stack holds."""
    row, n = work.passed[i], int(work.passed[i, contact.PASSED_PANEL])
    if row[contact.PASSED_PANEL] == contact.AT_ONCE or edge <= row[contact.R_INNER]:
        return contact.left(work, i, False, fading)
    x0, x1 = row[contact.X_OUTER], row[contact.X_INNER]
    return contact.left_at(work, n, fading, at.place(work.series, n, at.FRONT, edge * edge, x0, x1))


@kernel
def ring_moments(
    work: Arrays, motion: Motion, panel: Panel, x: float, now: State, border: Front
) -> Moments:
    """Return what the ledger needs to know of h in the ring, at a place of a panel."""
    ring, edge = contact.ring_of(work), now.radius
    fading = Fading(ring.sign, motion.alpha, now.time)
    plain, weighted, square, at_edge = 0.0, 0.0, 0.0, 0.0
    for i in range(ring.depth):
        row, last = work.passed[i], work.passed[i, contact.X_INNER]
        if ring.mode == Mode.RETURNS and i == ring.depth - 1:
            last = border.place
        part = entry_moments(work, i, fading, edge, last)
        plain, weighted, square = plain + part[0], weighted + part[1], square + part[2]
        inner, outer = gap_end(work, i, ring, border.radius), min(row[contact.R_INNER], edge)
        if inner < outer:
            h = contact.left(work, i, False, fading)
            plain, weighted = plain + h * (outer - inner), weighted + h * cubes(inner, outer)
            square += h * h * (outer - inner)
        if edge <= row[contact.R_OUTER] and (edge > inner or i == ring.depth - 1):
            at_edge = edge_left(work, i, fading, edge)
    if ring.mode == Mode.RETREATS:
        n, x0 = panel.number, -1.0
        if edge * edge <= work.values[at.FRONT, 0] * (1.0 + NEAR_FRONT):
            x0 = at.place(work.series, n, at.FRONT, edge * edge, -1.0, x)
            at_edge = contact.left_at(work, n, fading, x0)
        part = passed_moments(work, n, fading, x0, x)
        plain, weighted, square = plain + part[0], weighted + part[1], square + part[2]
    return Moments(plain, weighted, square, at_edge)


@kernel
def loss_rate(motion: Motion, now: State, ring: Ring, border: Front, h: Moments) -> float:
    """Return the rate of viscous loss in shear by the clock, such that psi^2/2 is kinetic."""
    alpha, v, a, b = motion.alpha, now.speed, border.radius, now.radius
    squared = now.psi * now.psi * a + v * v * (b - a) + 2.0 * v * h.plain + h.square
    rate = 7.5 * motion.chi * alpha * b * squared
    if motion.stage == Stage.UNLOADING.value:
        let_go = alpha * (ring.sign * (v + h.edge) if ring.sign != 0 else now.psi)
        rate -= 1.875 * motion.chi * let_go * let_go * normal.edge_rate(motion, b, v)
    return float(rate)


@kernel
def square_of_u(
    work: Arrays, motion: Motion, panel: Panel, j: int, border: Front, h: Moments, rows: Array
) -> float:
    """Return the integral of u^2 over the contact at a node, whose depth and force are known."""
    now, ring, a = at.state_at_node(work, j), contact.ring_of(work), border.radius
    b, u, depth, alpha = now.radius, now.moved, rows[layout.AT_D, j], motion.alpha
    if ring.mode == Mode.RETRACES:
        return float(work.ring[at.RATIO] ** 2 * squares(depth, 0.0, b))
    limit = normal.limit(motion, b, now.speed)
    slips = ring.sign * (limit * (b - a) - cubes(a, b))
    laid = rows[layout.AT_Q, j] - contact.moved(motion, now) * a - slips
    total = u * u * a + 2.0 * u * laid + squares_of_c(work, panel, at.PLACES[j], border)
    total += squares(depth, a, b)
    return float(total - 2.0 * alpha * (depth * h.plain - h.weighted) + alpha * alpha * h.square)


@kernel
def squares(level: float, inner: float, outer: float) -> float:
    """Return the integral of (level - s)^2 between two radii."""
    plain = level * (level * (outer - inner) - 2.0 * cubes(inner, outer))
    return float(plain + (outer**5 - inner**5) / 5.0)


@kernel
def squares_of_c(work: Arrays, panel: Panel, x: float, border: Front) -> float:
    """Return the integral of c^2 over what sticks, at a place of a panel."""
    pieces, ring, total = work.pieces, contact.ring_of(work), 0.0
    whole = panel.pieces - 1 if ring.mode == Mode.RETREATS else panel.pieces
    for i in range(whole):
        total += square_of_piece(work, i, pieces[i, at.R1], pieces[i, at.X1])
    if ring.mode == Mode.RETREATS:
        total += square_of_piece(work, whole, border.radius, border.place)
    elif ring.mode == Mode.STICKS:
        total += at.evaluate(work.series, panel.number, at.LAID_SQUARE, x)
    elif ring.mode == Mode.RETURNS:
        total += square_left(work, panel.number, ring.sign, -1.0, x)
    return float(total)


@kernel
def square_of_piece(work: Arrays, i: int, r1: float, x1: float) -> float:
    """Return the integral of c^2 over a piece up to a radius, which is at this place."""
    pieces, sign, n = work.pieces, int(work.pieces[i, at.SIGN]), int(work.pieces[i, at.PANEL])
    r0 = pieces[i, at.R0]
    if pieces[i, at.PANEL] == contact.FLAT:
        level = contact.level_at(pieces, i, sign, False)
        return squares(level, r0, r1)
    if sign != 0:
        return square_left(work, n, sign, pieces[i, at.X0], x1)
    last = pieces[i, at.S1]
    if x1 != pieces[i, at.X1]:
        last = at.evaluate(work.series, n, at.LAID_SQUARE, x1)
    return float(last - pieces[i, at.S0])


@kernel
def square_left(work: Arrays, n: int, sign: int, x0: float, x1: float) -> float:
    """Return the integral of c^2 over what a front that returned left in part of a panel."""
    total, half = 0.0, 0.5 * (x1 - x0)
    for k in range(ABSCISSAS.size):
        x = x0 + half * (1.0 + ABSCISSAS[k])
        r = at.evaluate(work.series, n, at.LAID_RADIUS, x)
        c = at.evaluate(work.series, n, contact.row_of(sign), x) - r * r
        total += WEIGHTS[k] * half * at.slope(work.series, n, at.LAID_RADIUS, x) * c * c
    return total


class Trace(NamedTuple):
    """Panels kept so far; empty arrays keep nothing."""

    rows: Cube  # (panels, ROWS, NODES)
    kinds: CodePairs  # (panels, 2): what the panel does, sign of slip


def new_record(wanted: bool) -> Trace:
    """Return an empty record."""
    room = at.MAX_PANELS if wanted else 0
    return Trace(np.zeros((room, layout.ROWS, at.NODES)), np.zeros((room, 2), dtype=np.int8))


@kernel
def note_numbers(work: Arrays, motion: Motion, panel: Panel, numbers: Array) -> None:
    """Add a solved panel to what an impact comes to."""
    values, rates, last = work.values, work.rates, at.NODES - 1
    b, v = values[at.RADIUS], values[at.SPEED]
    for j in range(at.NODES):
        rates[0, j] = 2.0 * b[j]
        rates[1, j] = 2.0 * b[j] * v[j]
    at.integrate(panel.clock, numbers[layout.TIME], panel.length, rates[0], rates[2])
    numbers[layout.TIME] = rates[2, last]
    at.integrate(panel.clock, numbers[layout.PENETRATION], panel.length, rates[1], rates[2])
    numbers[layout.PENETRATION] = rates[2, last]
    numbers[layout.DEEPEST] = max(numbers[layout.DEEPEST], numbers[layout.PENETRATION])
    numbers[layout.WIDEST] = max(numbers[layout.WIDEST], b[last])
    numbers[layout.STRONGEST] = max(numbers[layout.STRONGEST], strongest(work, motion, panel))
    numbers[layout.PSI_OUT], numbers[layout.RESTITUTION] = values[at.PSI, last], -v[last]


@kernel
def strongest(work: Arrays, motion: Motion, panel: Panel) -> float:
    """Return the largest normal force in a panel, by bisection between its nodes."""
    values, best, largest = work.values, 0, -np.inf
    for j in range(at.NODES):
        force = normal.normal_force(motion, values[at.RADIUS, j], values[at.SPEED, j])
        if force > largest:
            best, largest = j, force
    low, high = at.PLACES[max(best - 1, 0)], at.PLACES[min(best + 1, at.NODES - 1)]
    series, n = work.series, panel.number
    for _ in range(TERNARY_STEPS):
        near, far = (2.0 * low + high) / 3.0, (low + 2.0 * high) / 3.0
        if force_at(motion, series, n, near) < force_at(motion, series, n, far):
            low = near
        else:
            high = far
    return max(force_at(motion, series, n, 0.5 * (low + high)), largest)


@kernel
def force_at(motion: Motion, series: Array, n: int, x: float) -> float:
    """Return the normal force at a place of a panel."""
    b, v = at.evaluate(series, n, at.RADIUS, x), at.evaluate(series, n, at.SPEED, x)
    return normal.normal_force(motion, b, v)


@kernel
def keep_normal(work: Arrays, motion: Motion, panel: Panel, numbers: Array, rows: Array) -> None:
    """Keep the normal motion of a panel, U and psi at its nodes, before the numbers are added."""
    values, rates, h = work.values, work.rates, panel.length
    b, v = values[at.RADIUS], values[at.SPEED]
    for j in range(at.NODES):
        rates[0, j], rates[1, j] = 2.0 * b[j], 2.0 * b[j] * v[j]
        rates[2, j] = normal.loss_rate(motion, b[j], v[j])
    at.integrate(panel.clock, numbers[layout.TIME], h, rates[0], rows[layout.AT_TIME])
    at.integrate(panel.clock, numbers[layout.PENETRATION], h, rates[1], rows[layout.AT_D])
    at.integrate(panel.clock, numbers[layout.LOST], h, rates[2], rows[layout.AT_LOST])
    for j in range(at.NODES):
        rows[layout.AT_B, j], rows[layout.AT_V, j] = b[j], v[j]
        rows[layout.AT_U, j], rows[layout.AT_PSI, j] = values[at.MOVED, j], values[at.PSI, j]
        rows[layout.AT_P, j] = normal.normal_force(motion, b[j], v[j])
        rows[layout.AT_STORED, j] = normal.stored(b[j], rows[layout.AT_D, j])
    numbers[layout.LOST] = rows[layout.AT_LOST, at.NODES - 1]


@kernel
def note_shear(work: Arrays, motion: Motion, panel: Panel, numbers: Array, record: Trace) -> None:
    """Add what is lost in shear in a panel; keep the panel, if wanted."""
    wanted, ring, rates = record.rows.shape[0] > 0, contact.ring_of(work), work.rates
    rows = record.rows[panel.number] if wanted else work.values
    if wanted:
        keep_normal(work, motion, panel, numbers, rows)
    for j in range(at.NODES):
        x, now = at.PLACES[j], at.state_at_node(work, j)
        border = contact.front(work, motion, panel, now)
        h = ring_moments(work, motion, panel, x, now, border)
        rates[0, j] = loss_rate(motion, now, ring, border, h)
        if wanted:
            rows[layout.AT_Q, j] = contact.force(work, motion, panel, x, now, border)
            rows[layout.AT_STUCK, j] = border.radius
            rows[layout.AT_SQUARE, j] = square_of_u(work, motion, panel, j, border, h, rows)
    at.integrate(panel.clock, numbers[layout.SHEAR_LOST], panel.length, rates[0], rates[2])
    numbers[layout.SHEAR_LOST] = rates[2, at.NODES - 1]
    if wanted:
        for j in range(at.NODES):
            rows[layout.AT_SHEAR_LOST, j] = rates[2, j]
        kind = Kind.SLIP.value
        if ring.mode == Mode.STICKS or ring.mode == Mode.RETRACES:
            kind = Kind.STICK.value
        elif ring.mode == Mode.SLIPS:
            kind = Kind.GROSS_SLIP.value
        record.kinds[panel.number, 0], record.kinds[panel.number, 1] = kind, ring.sign
