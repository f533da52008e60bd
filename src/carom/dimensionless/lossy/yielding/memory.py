"""The memory of a contact whose limits are shifted, and the force that it gives.

A(s) = s + c(s) <= p = D - U and B(s) = s - c(s) <= m = D + U at every s in contact; what is beyond
a limit is cut down to it. The memory is a row of pieces from the centre outwards, each laid in one
panel of loading, or flat where slip has cut it. On a piece A and B are monotone, so that a limit
cuts its inner or its outer end.
"""

import numpy as np

from carom.dimensionless.lossy.panels.collocation import evaluate, place
from carom.dimensionless.lossy.panels.pieces import (
    A0,
    A1,
    COLUMNS,
    PANEL,
    R0,
    R1,
    S0,
    S1,
    SIGN,
    W0,
    W1,
    X0,
    X1,
    Pieces,
    cubes,
)
from carom.dimensionless.lossy.panels.work import LAID, LAID_A, LAID_B, LAID_SQUARE, RADIUS
from carom.dimensionless.numerics.kernels import kernel

ACTIVE, PAST = -1.0, -2.0  # instead of a panel: slips at the moment, has slipped

SLACK = 1e-13  # beyond a limit by rounding alone


@kernel
def force(pieces: Pieces, i: int, u: float) -> float:
    """Return the integral of q = U + A - s over a piece."""
    r0, r1 = pieces[i, R0], pieces[i, R1]
    if pieces[i, SIGN] == 0.0:
        return float(u * (r1 - r0) - (pieces[i, W1] - pieces[i, W0]))
    if pieces[i, SIGN] > 0.0:
        return float((u + pieces[i, A0]) * (r1 - r0) - cubes(r0, r1))
    return float((u + pieces[i, A0] - 2.0 * r0 * r0) * (r1 - r0) + cubes(r0, r1))


@kernel
def square(pieces: Pieces, i: int, u: float) -> float:
    """Return the integral of q^2 over a piece."""
    r0, r1 = pieces[i, R0], pieces[i, R1]
    if pieces[i, SIGN] == 0.0:
        once, twice = pieces[i, W1] - pieces[i, W0], pieces[i, S1] - pieces[i, S0]
        return float(u * (u * (r1 - r0) - 2.0 * once) + twice)
    c = u + pieces[i, A0]  # q = c - s, or s - (2 s_0 - c)
    if pieces[i, SIGN] < 0.0:
        c = 2.0 * r0 * r0 - c
    return float(c * (c * (r1 - r0) - 2.0 * cubes(r0, r1)) + (r1**5 - r0**5) / 5.0)


@kernel
def is_whole(pieces: Pieces, i: int, p: float, m: float, edge: float) -> bool:
    """Tell whether a piece lies within the contact and its limits."""
    r0, r1, a0, a1 = pieces[i, R0], pieces[i, R1], pieces[i, A0], pieces[i, A1]
    if r1 > edge or a0 > p + SLACK or a1 > p + SLACK:
        return False
    return bool(2.0 * r0 * r0 - a0 <= m + SLACK and 2.0 * r1 * r1 - a1 <= m + SLACK)


@kernel
def cut(
    pieces: Pieces, i: int, series: Pieces, p: float, m: float, edge: float, parts: Pieces
) -> int:
    """Cut a piece by both limits and the edge; write its parts and return how many there are."""
    if is_whole(pieces, i, p, m, edge):
        copy(pieces, i, parts, 0)
        return 1
    if pieces[i, SIGN] == 0.0:
        return cut_laid(pieces, i, series, p, m, edge, parts)
    return cut_flat(pieces, i, p, m, edge, parts)


@kernel
def cut_laid(
    pieces: Pieces, i: int, series: Pieces, p: float, m: float, edge: float, parts: Pieces
) -> int:
    """Cut a piece that was laid in stick."""
    panel, inner, outer = int(pieces[i, PANEL]), pieces[i, R0], pieces[i, R1]
    x0, x1 = pieces[i, X0], pieces[i, X1]
    if outer > edge:
        x1, outer = place(series, panel, RADIUS, edge, x0, x1), edge
    begins, ends = 0, 0
    for sign in (1, -1):
        level, row, inside, outside = p, LAID_A, pieces[i, A0], pieces[i, A1]
        if sign == -1:
            level, row = m, LAID_B
            inside = 2.0 * inner * inner - inside
            outside = 2.0 * pieces[i, R1] * pieces[i, R1] - outside
        if inside <= level + SLACK and outside <= level + SLACK:
            continue
        x = x1
        if inside <= level + SLACK or outside < level - SLACK:
            x = min(place(series, panel, row, level, pieces[i, X0], pieces[i, X1]), x1)
        if inside > level + SLACK:
            begins, x0 = sign, max(x0, x)
        elif x < x1:
            ends, x1 = sign, x
    r0, r1 = inner, outer
    if begins != 0:
        r0 = min(max(evaluate(series, panel, RADIUS, x0), inner), outer)
    if x1 <= x0:
        r1 = r0
    elif ends != 0:
        r1 = max(min(evaluate(series, panel, RADIUS, x1), outer), r0)
    count = 0
    if r0 > inner:
        count = add_slipping(parts, count, begins, inner, r0, p, m)
    if r1 > r0:
        copy(pieces, i, parts, count)
        trim_laid(parts, count, series, x0, x1, r0, r1)
        count += 1
    if outer > r1:
        count = add_slipping(parts, count, ends if ends != 0 else begins, r1, outer, p, m)
    return count


@kernel
def cut_flat(pieces: Pieces, i: int, p: float, m: float, edge: float, parts: Pieces) -> int:
    """Cut a piece that slip made flat: A is constant there for sign +, B for sign -."""
    sign, inner, outer = int(pieces[i, SIGN]), pieces[i, R0], min(pieces[i, R1], edge)
    own = pieces[i, A0] if sign == 1 else 2.0 * inner * inner - pieces[i, A0]
    limit, other = (p, m) if sign == 1 else (m, p)
    if own > limit + SLACK:
        return add_slipping(parts, 0, sign, inner, outer, p, m)
    border = min(max(np.sqrt(max(0.5 * (own + other), 0.0)), inner), outer)
    count = 0
    if border > inner:
        copy(pieces, i, parts, 0)
        parts[0, R1] = border
        parts[0, A1] = own if sign == 1 else 2.0 * border * border - own
        count = 1
    if outer > border:
        count = add_slipping(parts, count, -sign, border, outer, p, m)
    return count


@kernel
def copy(pieces: Pieces, i: int, others: Pieces, j: int) -> None:
    """Write a piece over another: column by column, as slices are slow."""
    for column in range(COLUMNS):
        others[j, column] = pieces[i, column]


@kernel
def add_slipping(
    parts: Pieces, count: int, sign: int, r0: float, r1: float, p: float, m: float
) -> int:
    """Write a part that slip of this sign holds at its limit; return how many there are now."""
    parts[count, SIGN], parts[count, PANEL] = sign, ACTIVE
    parts[count, R0], parts[count, R1] = r0, r1
    parts[count, A0] = p if sign == 1 else 2.0 * r0 * r0 - m
    parts[count, A1] = p if sign == 1 else 2.0 * r1 * r1 - m
    return count + 1


@kernel
def trim_laid(
    parts: Pieces, k: int, series: Pieces, x0: float, x1: float, r0: float, r1: float
) -> None:
    """Trim a laid part to what lies between two places of its panel."""
    panel = int(parts[k, PANEL])
    parts[k, R0], parts[k, R1] = r0, r1
    if x0 != parts[k, X0]:
        parts[k, A0] = evaluate(series, panel, LAID_A, x0)
        parts[k, W0] = evaluate(series, panel, LAID, x0)
        parts[k, S0] = evaluate(series, panel, LAID_SQUARE, x0)
    if x1 != parts[k, X1]:
        parts[k, A1] = evaluate(series, panel, LAID_A, x1)
        parts[k, W1] = evaluate(series, panel, LAID, x1)
        parts[k, S1] = evaluate(series, panel, LAID_SQUARE, x1)
    parts[k, X0], parts[k, X1] = x0, x1
