"""The memory of a contact whose limits are shifted, and the force that it gives.

A(s) = s + c(s) <= p = D - U and B(s) = s - c(s) <= m = D + U at every s in contact; what is beyond
a limit is cut down to it. The memory is a row of pieces from the centre outwards, each laid in one
panel of loading, or flat where slip has cut it. On a piece A and B are monotone, so that a limit
cuts its inner or its outer end.
"""

import numpy as np
from numpy.typing import NDArray

from carom.dimensionless._jit import kernel
from carom.dimensionless.lossy.collocation import evaluate, place

Pieces = NDArray[np.float64]

# Columns of a piece: sign of the slip that made it flat (0: laid), its panel, where in the panel it
# begins and ends, and there: radius, A, and the integral of U db since the panel's start.
SIGN, PANEL, X0, X1, R0, R1, A0, A1, W0, W1 = range(10)
COLUMNS = 10
MAX_PIECES = 400
ACTIVE, PAST = -1.0, -2.0  # instead of a panel: slips at the moment, has slipped
PARTS = 3  # into which a piece can be cut

SLACK = 1e-11  # beyond a limit by rounding alone

# Series of a panel: b, U, integral of U db, A and B as they are laid.
RADIUS, MOVED, LAID, LAID_A, LAID_B = range(5)


@kernel
def cubes(inner: float, outer: float) -> float:
    """Return the integral of s dx between two radii."""
    return (outer - inner) * (outer * outer + outer * inner + inner * inner) / 3.0


@kernel
def force(piece: Pieces, u: float) -> float:
    """Return the integral of q = U + A - s over a piece."""
    r0, width = piece[R0], piece[R1] - piece[R0]
    if piece[SIGN] == 0.0:
        return float(u * width - (piece[W1] - piece[W0]))
    share = cubes(r0, piece[R1])
    if piece[SIGN] > 0.0:
        return float((u + piece[A0]) * width - share)
    return float((u + piece[A0] - 2.0 * r0 * r0) * width + share)


@kernel
def is_whole(piece: Pieces, p: float, m: float, edge: float) -> bool:
    """Tell whether a piece lies within the contact and its limits."""
    if piece[R1] > edge or piece[A0] > p + SLACK or piece[A1] > p + SLACK:
        return False
    s0, s1 = piece[R0] * piece[R0], piece[R1] * piece[R1]
    return bool(2.0 * s0 - piece[A0] <= m + SLACK and 2.0 * s1 - piece[A1] <= m + SLACK)


@kernel
def cut(piece: Pieces, series: Pieces, p: float, m: float, edge: float, parts: Pieces) -> int:
    """Cut a piece by both limits and the edge; write its parts and return how many there are."""
    if is_whole(piece, p, m, edge):
        parts[0] = piece
        return 1
    if piece[SIGN] == 0.0:
        return cut_laid(piece, series, p, m, edge, parts)
    return cut_flat(piece, p, m, edge, parts)


@kernel
def cut_laid(piece: Pieces, series: Pieces, p: float, m: float, edge: float, parts: Pieces) -> int:
    """Cut a piece that was laid in stick."""
    x0, x1, outer = piece[X0], piece[X1], piece[R1]
    if outer > edge:
        x1, outer = place(series[RADIUS], edge, x0, x1), edge
    begins, ends = 0, 0
    for sign in (1, -1):
        level, laid = (p, series[LAID_A]) if sign == 1 else (m, series[LAID_B])
        inside, outside = piece[A0], piece[A1]
        if sign == -1:
            inside = 2.0 * piece[R0] * piece[R0] - inside
            outside = 2.0 * piece[R1] * piece[R1] - outside
        if inside > level + SLACK:
            begins = sign
            x = x1
            if outside < level - SLACK:
                x = place(laid, level, piece[X0], piece[X1])
            x0 = max(x0, min(x, x1))
        elif outside > level + SLACK:
            x = place(laid, level, piece[X0], piece[X1])
            if x < x1:
                ends, x1 = sign, x
    r0 = piece[R0] if begins == 0 else min(max(evaluate(series[RADIUS], x0), piece[R0]), outer)
    r1 = outer
    if x1 <= x0:
        r1 = r0
    elif ends != 0:
        r1 = max(min(evaluate(series[RADIUS], x1), outer), r0)
    count = 0
    if r0 > piece[R0]:
        count = add_slipping(parts, count, begins, piece[R0], r0, p, m)
    if r1 > r0:
        add_laid(parts[count], piece, series, x0, x1, r0, r1)
        count += 1
    if outer > r1:
        count = add_slipping(parts, count, ends if ends != 0 else begins, r1, outer, p, m)
    return count


@kernel
def cut_flat(piece: Pieces, p: float, m: float, edge: float, parts: Pieces) -> int:
    """Cut a piece that slip made flat: A is constant there for sign +, B for sign -."""
    sign, inner, outer = int(piece[SIGN]), piece[R0], min(piece[R1], edge)
    own = piece[A0] if sign == 1 else 2.0 * inner * inner - piece[A0]
    limit, other = (p, m) if sign == 1 else (m, p)
    if own > limit + SLACK:
        return add_slipping(parts, 0, sign, inner, outer, p, m)
    border = min(max(np.sqrt(max(0.5 * (own + other), 0.0)), inner), outer)
    count = 0
    if border > inner:
        parts[0] = piece
        parts[0, R1] = border
        parts[0, A1] = own if sign == 1 else 2.0 * border * border - own
        count = 1
    if outer > border:
        count = add_slipping(parts, count, -sign, border, outer, p, m)
    return count


@kernel
def add_slipping(
    parts: Pieces, count: int, sign: int, r0: float, r1: float, p: float, m: float
) -> int:
    """Write a part that slip of this sign holds at its limit; return how many there are now."""
    part = parts[count]
    part[:] = 0.0
    part[SIGN], part[PANEL], part[R0], part[R1] = sign, ACTIVE, r0, r1
    part[A0] = p if sign == 1 else 2.0 * r0 * r0 - m
    part[A1] = p if sign == 1 else 2.0 * r1 * r1 - m
    return count + 1


@kernel
def add_laid(
    part: Pieces, piece: Pieces, series: Pieces, x0: float, x1: float, r0: float, r1: float
) -> None:
    """Write what is left of a laid piece between two places of its panel."""
    part[:] = piece
    part[X0], part[X1], part[R0], part[R1] = x0, x1, r0, r1
    if x0 != piece[X0]:
        part[A0], part[W0] = evaluate(series[LAID_A], x0), evaluate(series[LAID], x0)
    if x1 != piece[X1]:
        part[A1], part[W1] = evaluate(series[LAID_A], x1), evaluate(series[LAID], x1)
