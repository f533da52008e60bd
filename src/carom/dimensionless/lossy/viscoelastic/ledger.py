"""Where the tangential energy of a viscoelastic impact is: stored in springs, lost in dashpots.

Springs that stick have u' = psi, those that slip u = sigma (w - alpha h), u' = sigma (v + h), with
w = d - s. What the dashpots lose is alpha u'^2, and u^2/2 of each spring that the edge lets go; the
rest is lost to friction.
"""

from typing import NamedTuple

import numpy as np

from carom.dimensionless.lossy.panels import normal, work as at
from carom.dimensionless.lossy.panels.collocation import evaluate, place, slope
from carom.dimensionless.lossy.panels.normal import Motion, Stage
from carom.dimensionless.lossy.panels.work import Arrays, Panel, State
from carom.dimensionless.lossy.viscoelastic import passed
from carom.dimensionless.lossy.viscoelastic.memory import FLAT, cubes, level_at, row_of
from carom.dimensionless.lossy.viscoelastic.passed import AT_ONCE, left, left_at
from carom.dimensionless.lossy.viscoelastic.ring import Front, Mode, Ring, moved, ring_of
from carom.dimensionless.numerics.kernels import kernel

ABSCISSAS, WEIGHTS = np.polynomial.legendre.leggauss(8)
ROUNDING = 1e-6  # relative, of squares of radii at which a ring begins
LAYERS = np.array([0.0, 2.0, 6.0, 14.0, 38.0])  # ages of h, in alpha, between which it is smooth


class Moments(NamedTuple):
    """Integrals over the ring of h, h s and h^2, and h at the edge."""

    plain: float
    weighted: float
    square: float
    edge: float


@kernel
def passed_moments(
    work: Arrays, n: int, sign: int, alpha: float, x0: float, x1: float, time: float
) -> tuple[float, float, float]:
    """Return the integrals of h, h s and h^2 over what the front passed in part of a panel.

    By parts, as the front comes to the centre like the root of time: -[h r] + integral of r dh.
    """
    plain, weighted, square, high = 0.0, 0.0, 0.0, x1
    for layer in range(1, LAYERS.size):
        if high <= x0:
            break
        oldest = time - LAYERS[layer] * alpha
        low = x0
        if evaluate(work.series, n, at.TIME, x0) < oldest:
            low = max(x0, min(high, place(work.series, n, at.TIME, oldest, x0, high)))
        half = 0.5 * (high - low)
        for k in range(ABSCISSAS.size):
            x = low + half * (1.0 + ABSCISSAS[k])
            r, h = front_at(work, n, x), left_at(work, n, sign, alpha, x, time)
            rise = half * WEIGHTS[k] * slope_of_left(work, n, sign, alpha, x, time)
            plain += rise * r
            weighted += rise * r * r * r / 3.0
            square += rise * 2.0 * h * r
        high = low
    for end, x in ((1.0, x0), (-1.0, x1)):
        r, h = front_at(work, n, x), left_at(work, n, sign, alpha, x, time)
        plain += end * h * r
        weighted += end * h * r * r * r / 3.0
        square += end * h * h * r
    return plain, weighted, square


@kernel
def front_at(work: Arrays, n: int, x: float) -> float:
    """Return where the front was at a place of a panel."""
    return float(np.sqrt(max(evaluate(work.series, n, at.FRONT, x), 0.0)))


@kernel
def slope_of_left(work: Arrays, n: int, sign: int, alpha: float, x: float, time: float) -> float:
    """Return the derivative of h by the place where its spring was passed."""
    table, ago = work.series, evaluate(work.series, n, at.TIME, x) - time
    excess = sign * evaluate(table, n, at.PSI, x) - evaluate(table, n, at.SPEED, x)
    change = sign * slope(table, n, at.PSI, x) - slope(table, n, at.SPEED, x)
    return float(np.exp(ago / alpha) * (change + excess * slope(table, n, at.TIME, x) / alpha))


@kernel
def entry_moments(
    work: Arrays, i: int, ring: Ring, alpha: float, edge: float, x1: float, time: float
) -> tuple[float, float, float]:
    """Return the integrals over an entry of the stack, from the edge to a place of its panel."""
    row, n = work.passed[i], int(work.passed[i, passed.PANEL])
    outer, inner = min(row[passed.R_OUTER], edge), row[passed.R_INNER]
    if outer <= inner:
        return 0.0, 0.0, 0.0
    if row[passed.PANEL] == AT_ONCE:
        h = left(work, i, True, ring.sign, alpha, time)
        return h * (outer - inner), h * cubes(inner, outer), h * h * (outer - inner)
    x0 = row[passed.X_OUTER]
    if outer < row[passed.R_OUTER]:
        x0 = place(work.series, n, at.FRONT, outer * outer, x0, x1)
    return passed_moments(work, n, ring.sign, alpha, x0, x1, time)


@kernel
def gap_end(work: Arrays, i: int, ring: Ring, front: float) -> float:
    """Return where what the front jumped ends, from the end of an entry to the next.

    Where it arrives is known to rounding of levels, which is much of a thin ring.
    """
    if i < ring.depth - 1:
        return float(work.passed[i + 1, passed.R_OUTER])
    if ring.mode == Mode.RETREATS:
        return float(np.sqrt(work.values[at.FRONT, 0]))
    return float(work.passed[i, passed.R_INNER]) if ring.mode == Mode.RETURNS else front


@kernel
def edge_left(work: Arrays, i: int, ring: Ring, alpha: float, edge: float, time: float) -> float:
    """Return h at the edge, which an entry of the stack holds."""
    row, n = work.passed[i], int(work.passed[i, passed.PANEL])
    if row[passed.PANEL] == AT_ONCE or edge <= row[passed.R_INNER]:
        return left(work, i, False, ring.sign, alpha, time)
    x = place(work.series, n, at.FRONT, edge * edge, row[passed.X_OUTER], row[passed.X_INNER])
    return left_at(work, n, ring.sign, alpha, x, time)


@kernel
def ring_moments(
    work: Arrays, motion: Motion, panel: Panel, x: float, now: State, border: Front, time: float
) -> Moments:
    """Return what the ledger needs to know of h in the ring, at a place of a panel."""
    ring, alpha, edge = ring_of(work), motion.alpha, now.radius
    plain, weighted, square, at_edge = 0.0, 0.0, 0.0, 0.0
    for i in range(ring.depth):
        row = work.passed[i]
        last = (
            border.place
            if ring.mode == Mode.RETURNS and i == ring.depth - 1
            else row[passed.X_INNER]
        )
        found = entry_moments(work, i, ring, alpha, edge, last, time)
        plain, weighted, square = plain + found[0], weighted + found[1], square + found[2]
        inner, outer = gap_end(work, i, ring, border.radius), min(row[passed.R_INNER], edge)
        if inner < outer:
            h = left(work, i, False, ring.sign, alpha, time)
            plain, weighted = plain + h * (outer - inner), weighted + h * cubes(inner, outer)
            square += h * h * (outer - inner)
        if edge <= row[passed.R_OUTER] and (edge > inner or i == ring.depth - 1):
            at_edge = edge_left(work, i, ring, alpha, edge, time)
    if ring.mode == Mode.RETREATS:
        n, x0 = panel.number, -1.0
        if edge * edge <= work.values[at.FRONT, 0] * (1.0 + ROUNDING):
            x0 = place(work.series, n, at.FRONT, edge * edge, -1.0, x)
            at_edge = left_at(work, n, ring.sign, alpha, x0, time)
        found = passed_moments(work, n, ring.sign, alpha, x0, x, time)
        plain, weighted, square = plain + found[0], weighted + found[1], square + found[2]
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
    work: Arrays,
    motion: Motion,
    panel: Panel,
    x: float,
    now: State,
    border: Front,
    depth: float,
    force: float,
    h: Moments,
) -> float:
    """Return the integral of u^2 over the contact at a place of a panel; `force` is Q there."""
    ring, a, b, u = ring_of(work), border.radius, now.radius, now.moved
    if ring.mode == Mode.RETRACES:
        return float(work.ring[at.RATIO] ** 2 * squares(depth, 0.0, b))
    limit = normal.limit(motion, b, now.speed)
    laid = force - moved(motion, now) * a - ring.sign * (limit * (b - a) - cubes(a, b))
    total = u * u * a + 2.0 * u * laid + squares_of_c(work, panel, x, border)
    total += squares(depth, a, b)
    alpha = motion.alpha
    return float(total - 2.0 * alpha * (depth * h.plain - h.weighted) + alpha * alpha * h.square)


@kernel
def squares(level: float, inner: float, outer: float) -> float:
    """Return the integral of (level - s)^2 between two radii."""
    plain = level * (level * (outer - inner) - 2.0 * cubes(inner, outer))
    return float(plain + (outer**5 - inner**5) / 5.0)


@kernel
def squares_of_c(work: Arrays, panel: Panel, x: float, border: Front) -> float:
    """Return the integral of c^2 over what sticks, at a place of a panel."""
    pieces, ring, total = work.pieces, ring_of(work), 0.0
    whole = panel.pieces - 1 if ring.mode == Mode.RETREATS else panel.pieces
    for i in range(whole):
        total += square_of_piece(work, i, pieces[i, at.R1], pieces[i, at.X1])
    if ring.mode == Mode.RETREATS:
        total += square_of_piece(work, whole, border.radius, border.place)
    elif ring.mode == Mode.STICKS:
        total += evaluate(work.series, panel.number, at.LAID_SQUARE, x)
    elif ring.mode == Mode.RETURNS:
        total += square_left(work, panel.number, ring.sign, -1.0, x)
    return float(total)


@kernel
def square_of_piece(work: Arrays, i: int, r1: float, x1: float) -> float:
    """Return the integral of c^2 over a piece up to a radius, which is at this place."""
    pieces, sign, n = work.pieces, int(work.pieces[i, at.SIGN]), int(work.pieces[i, at.PANEL])
    r0 = pieces[i, at.R0]
    if pieces[i, at.PANEL] == FLAT:
        level = level_at(pieces, i, sign, False)
        return squares(level, r0, r1)
    if sign != 0:
        return square_left(work, n, sign, pieces[i, at.X0], x1)
    last = (
        pieces[i, at.S1] if x1 == pieces[i, at.X1] else evaluate(work.series, n, at.LAID_SQUARE, x1)
    )
    return float(last - pieces[i, at.S0])


@kernel
def square_left(work: Arrays, n: int, sign: int, x0: float, x1: float) -> float:
    """Return the integral of c^2 over what a front that returned left in part of a panel."""
    total, half = 0.0, 0.5 * (x1 - x0)
    for k in range(ABSCISSAS.size):
        x = x0 + half * (1.0 + ABSCISSAS[k])
        r = evaluate(work.series, n, at.LAID_RADIUS, x)
        c = evaluate(work.series, n, row_of(sign), x) - r * r
        total += WEIGHTS[k] * half * slope(work.series, n, at.LAID_RADIUS, x) * c * c
    return total
