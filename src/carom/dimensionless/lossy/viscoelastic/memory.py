"""What sticks in a viscoelastic contact: pieces of memory, from the centre to the front of slip.

A spring at s = x^2 that sticks has the deflection u = U + c(s) and bears f = T + c, T = U + alpha
psi. It sticks while A = s + c <= D - T and B = s - c <= D + T. Both grow outwards, so that slip is
one ring, and its front stands where A, for slip +, or B, for slip -, is at its limit, the level. A
piece was laid at the edge of the contact, or where slip of a sign has stopped: there A or B is the
level of that moment, the same all over a flat piece, and nearly so over one left by a front that
returned.
"""

import numpy as np
from numpy.typing import NDArray

from carom.dimensionless.lossy.panels import work as at
from carom.dimensionless.lossy.panels.collocation import evaluate, place
from carom.dimensionless.lossy.panels.work import Arrays
from carom.dimensionless.numerics.arrays import Cube
from carom.dimensionless.numerics.kernels import kernel

Pieces = NDArray[np.float64]
FLAT = -1.0  # instead of a panel
HALVINGS = 54


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
    for _ in range(HALVINGS):
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
    """Return the force, for T = 0, between radii at which slip has left these levels.

    `moment` is the integral of r over the levels: errors of r count little, as the level hardly
    changes.
    """
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
