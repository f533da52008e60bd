"""A viscoelastic contact: what sticks, from the centre outwards, and the ring of slip around it.

A spring at s = x^2 that sticks has the deflection u = U + c(s) and bears f = T + c, T = U + alpha
psi. It sticks while A = s + c <= D - T and B = s - c <= D + T. Both grow outwards, so that slip is
one ring, and its front stands where A, for slip +, or B, for slip -, is at its limit, the level. A
piece was laid at the edge of the contact, or where slip of a sign has stopped: there A or B is the
level of that moment, the same all over a flat piece, and nearly so over one left by a front that
returned.

What slip has passed is a stack of springs that slid from when its front went by. Where the front
was at t0 the rate of slip is g - h, h = g(t0) exp(-(t - t0)/alpha), with the excess g = sigma psi -
v. Springs stick again when g has fallen to their h, the last one passed first, so that the front
returns over the stack. What slips since it was touched has h = 0 and is not in it.
"""

from enum import IntEnum
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.dimensionless.lossy.viscoelastic import normal, work as at
from carom.dimensionless.lossy.viscoelastic.normal import Motion
from carom.dimensionless.lossy.viscoelastic.work import Arrays, Panel, State, evaluate, place
from carom.dimensionless.numerics.arrays import Cube
from carom.dimensionless.numerics.kernels import kernel

Pieces = NDArray[np.float64]
FLAT = -1.0  # instead of a panel
LEVEL_HALVINGS = 54

# Columns: the panel, the places in it and radii of the outer and the inner end; of what was passed
# in an instant, which has no panel, the time and excess then.
PASSED_PANEL, X_OUTER, X_INNER, R_OUTER, R_INNER, INSTANT, EXCESS = range(7)
AT_ONCE = -1.0
FRONT_HALVINGS = 36  # errors of the front count in second order


@kernel
def cubes(inner: float, outer: float) -> float:
    """Return the integral of s dx between two radii."""
    return (outer - inner) * (outer * outer + outer * inner + inner * inner) / 3.0


@kernel
def row_of(sign: int) -> int:
    """Return the row of A for slip +, of B for slip -."""
    return at.LAID_A if sign > 0 else at.LAID_B


@kernel
def level_at(pieces: Pieces, i: int, sign: int, outer: bool) -> float:
    """Return A for slip +, B for slip -, at an end of a piece."""
    a, r = (pieces[i, at.A1], pieces[i, at.R1]) if outer else (pieces[i, at.A0], pieces[i, at.R0])
    return float(a if sign > 0 else 2.0 * r * r - a)


@kernel
def rim(pieces: Pieces, count: int) -> float:
    """Return the radius of all that sticks."""
    return float(pieces[count - 1, at.R1]) if count > 0 else 0.0


@kernel
def passed_level(work: Arrays, i: int, sign: int, level: float) -> tuple[float, float]:
    """Return where on a piece A or B passes a level, as radius and place of its panel."""
    pieces, kind = work.pieces, int(work.pieces[i, at.SIGN])
    r0, r1, x0, x1 = pieces[i, at.R0], pieces[i, at.R1], pieces[i, at.X0], pieces[i, at.X1]
    if pieces[i, at.PANEL] == FLAT:
        other = level_at(pieces, i, -sign, False)
        return min(max(np.sqrt(max(0.5 * (other + level), 0.0)), r0), r1), 0.0
    n = int(pieces[i, at.PANEL])
    if kind == -sign:
        x = opposite(work.series, n, row_of(-sign), level, x0, x1)
    else:
        x = place(work.series, n, row_of(sign), level, x0, x1)
    return min(max(evaluate(work.series, n, at.LAID_RADIUS, x), r0), r1), x


@kernel
def opposite(table: Cube, n: int, row: int, level: float, low: float, high: float) -> float:
    """Return where 2 r^2 less a row passes a level."""
    for _ in range(LEVEL_HALVINGS):
        x = 0.5 * (low + high)
        r = evaluate(table, n, at.LAID_RADIUS, x)
        if 2.0 * r * r - evaluate(table, n, row, x) < level:
            low = x
        else:
            high = x
    return 0.5 * (low + high)


@kernel
def left_force(
    sign: int, r0: float, r1: float, level0: float, level1: float, moment: float
) -> float:
    """Return the force for T = 0 of left levels, by the integral of r: errors of r count little."""
    return sign * (level1 * r1 - level0 * r0 - moment - cubes(r0, r1))


@kernel
def piece_force(pieces: Pieces, i: int) -> float:
    """Return the integral of c over a piece: its force for T = 0."""
    kind = int(pieces[i, at.SIGN])
    if kind == 0:
        return float(pieces[i, at.W0] - pieces[i, at.W1])
    levels = level_at(pieces, i, kind, False), level_at(pieces, i, kind, True)
    return left_force(
        kind, pieces[i, at.R0], pieces[i, at.R1], *levels, pieces[i, at.W1] - pieces[i, at.W0]
    )


@kernel
def part_force(work: Arrays, i: int, r: float, x: float) -> float:
    """Return the integral of c over a piece up to a radius, which is at this place of its panel."""
    pieces, kind, n = work.pieces, int(work.pieces[i, at.SIGN]), int(work.pieces[i, at.PANEL])
    if kind == 0:
        return float(pieces[i, at.W0] - evaluate(work.series, n, at.LAID, x))
    first = level_at(pieces, i, kind, False)
    last, moment = first, 0.0
    if n >= 0:
        last = evaluate(work.series, n, row_of(kind), x)
        moment = evaluate(work.series, n, at.LAID, x) - pieces[i, at.W0]
    return left_force(kind, pieces[i, at.R0], r, first, last, moment)


@kernel
def trim(work: Arrays, i: int, r: float, x: float) -> None:
    """Trim a piece to what lies inside a radius, which is at this place of its panel."""
    pieces, kind, n = work.pieces, int(work.pieces[i, at.SIGN]), int(work.pieces[i, at.PANEL])
    level = level_at(pieces, i, kind, False)
    if n >= 0:
        pieces[i, at.X1], pieces[i, at.W1] = x, evaluate(work.series, n, at.LAID, x)
        pieces[i, at.S1] = evaluate(work.series, n, at.LAID_SQUARE, x)
        level = evaluate(work.series, n, row_of(1 if kind == 0 else kind), x)
    pieces[i, at.R1] = r
    pieces[i, at.A1] = 2.0 * r * r - level if kind < 0 else level


@kernel
def lay_flat(pieces: Pieces, i: int, sign: int, r0: float, r1: float, level: float) -> None:
    """Write a piece that slip of a sign has left at one level."""
    pieces[i, at.SIGN], pieces[i, at.PANEL], pieces[i, at.R0], pieces[i, at.R1] = sign, FLAT, r0, r1
    pieces[i, at.W0], pieces[i, at.W1] = 0.0, 0.0
    pieces[i, at.A0] = level if sign > 0 else 2.0 * r0 * r0 - level
    pieces[i, at.A1] = level if sign > 0 else 2.0 * r1 * r1 - level


class Fading(NamedTuple):
    """What h depends on besides its spring: the sign of slip, alpha and the time."""

    sign: int
    alpha: float
    time: float


@kernel
def push(work: Arrays, panel: int, r_outer: float, r_inner: float) -> None:
    """Add what the front passes in a whole panel."""
    row = work.passed[int(work.ring[at.DEPTH])]
    row[PASSED_PANEL], row[X_OUTER], row[X_INNER] = panel, -1.0, 1.0
    row[R_OUTER], row[R_INNER] = r_outer, r_inner
    work.ring[at.DEPTH] += 1


@kernel
def push_at_once(work: Arrays, r_outer: float, r_inner: float, time: float, excess: float) -> None:
    """Add what the front passes in an instant."""
    row = work.passed[int(work.ring[at.DEPTH])]
    row[PASSED_PANEL], row[R_OUTER], row[R_INNER] = AT_ONCE, r_outer, r_inner
    row[INSTANT], row[EXCESS] = time, excess
    work.ring[at.DEPTH] += 1


@kernel
def left_at(work: Arrays, n: int, fading: Fading, x: float) -> float:
    """Return h of the spring that was passed at this place of a panel."""
    table = work.series
    excess = fading.sign * evaluate(table, n, at.PSI, x) - evaluate(table, n, at.SPEED, x)
    ago = evaluate(table, n, at.TIME, x) - fading.time
    return float(excess * np.exp(ago / fading.alpha))


@kernel
def left(work: Arrays, top: int, outer: bool, fading: Fading) -> float:
    """Return h at an end of an entry of the stack."""
    row = work.passed[top]
    if row[PASSED_PANEL] == AT_ONCE:
        return float(row[EXCESS] * np.exp((row[INSTANT] - fading.time) / fading.alpha))
    return left_at(work, int(row[PASSED_PANEL]), fading, row[X_OUTER if outer else X_INNER])


@kernel
def returned(work: Arrays, top: int, fading: Fading, excess: float) -> tuple[float, float]:
    """Return where in an entry h is the excess, as radius and place."""
    row = work.passed[top]
    n, low, high = int(row[PASSED_PANEL]), row[X_OUTER], row[X_INNER]
    if left_at(work, n, fading, high) <= excess:
        low = high
    for _ in range(FRONT_HALVINGS):
        middle = 0.5 * (low + high)
        if left_at(work, n, fading, middle) < excess:
            low = middle
        else:
            high = middle
    return np.sqrt(max(evaluate(work.series, n, at.FRONT, high), 0.0)), high


class Mode(IntEnum):
    """What a contact does; the front of slip is where it begins."""

    STICKS = 0  # as a whole
    RETREATS = 1  # the front goes inwards,
    STANDS = 2
    RETURNS = 3  # or comes back outwards
    SLIPS = 4  # as a whole
    RETRACES = 5  # sticks, and goes back as it came


class Ring(NamedTuple):
    """What the contact does, the sign of slip, and how much of what slip passed still slips."""

    mode: int
    sign: int
    depth: int


class Front(NamedTuple):
    """Where slip begins: the radius, and the place there of the panel that it runs through."""

    radius: float
    place: float


@kernel
def ring_of(work: Arrays) -> Ring:
    """Return the ring of the moment."""
    return Ring(int(work.ring[at.MODE]), int(work.ring[at.RING_SIGN]), int(work.ring[at.DEPTH]))


@kernel
def set_ring(work: Arrays, mode: int, sign: int, depth: int) -> None:
    """Change the ring."""
    work.ring[at.MODE], work.ring[at.RING_SIGN], work.ring[at.DEPTH] = mode, sign, depth


@kernel
def moved(motion: Motion, now: State) -> float:
    """Return T = U + alpha psi."""
    return now.moved + motion.alpha * now.psi


@kernel
def level_now(motion: Motion, sign: int, now: State) -> float:
    """Return the level at which springs slip: D - T for slip +, D + T for slip -."""
    return normal.limit(motion, now.radius, now.speed) - sign * moved(motion, now)


@kernel
def excess(sign: int, now: State) -> float:
    """Return g = sigma psi - v, the rate of slip of what was never stuck."""
    return sign * now.psi - now.speed


@kernel
def front(work: Arrays, motion: Motion, panel: Panel, now: State) -> Front:
    """Return where slip begins."""
    ring, stuck = ring_of(work), rim(work.pieces, panel.pieces)
    if ring.mode == Mode.STICKS or ring.mode == Mode.RETRACES:
        return Front(now.radius, 0.0)
    if ring.mode == Mode.RETREATS:
        level = level_now(motion, ring.sign, now)
        radius, x = passed_level(work, panel.pieces - 1, ring.sign, level)
        return Front(radius, x)
    if ring.mode == Mode.RETURNS:
        g, top = excess(ring.sign, now), ring.depth - 1
        radius, x = returned(work, top, Fading(ring.sign, motion.alpha, now.time), g)
        return Front(max(radius, stuck), x)
    return Front(stuck, 0.0)


@kernel
def force(work: Arrays, motion: Motion, panel: Panel, x: float, now: State, border: Front) -> float:
    """Return Q, the integral of f over the contact, at a place of a panel."""
    ring, a, b = ring_of(work), border.radius, now.radius
    if ring.mode == Mode.RETRACES:
        return float(work.ring[at.RATIO] * 2.0 / 3.0 * normal.normal_force(motion, b, now.speed))
    total = moved(motion, now) * a + work.ring[at.WHOLE]
    if ring.mode == Mode.RETREATS:
        total += part_force(work, panel.pieces - 1, a, border.place)
    elif ring.mode == Mode.STICKS:
        total -= evaluate(work.series, panel.number, at.LAID, x)
    elif ring.mode == Mode.RETURNS:
        first = work.values[row_of(ring.sign), 0], level_now(motion, ring.sign, now)
        moment = evaluate(work.series, panel.number, at.LAID, x)
        total += left_force(ring.sign, work.values[at.LAID_RADIUS, 0], a, *first, moment)
    limit = normal.limit(motion, b, now.speed)
    return float(total + ring.sign * (limit * (b - a) - cubes(a, b)))
