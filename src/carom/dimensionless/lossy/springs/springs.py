"""The springs that a contact is cut into: where they stand, what they weigh, and how they stretch.

In shear each is a standard linear solid, f = u + g m, m' = u' - m/theta; g = 0 is an elastic one.
In stick u grows as U does. In slip f = sigma N, so that m relaxes by itself, in the time
(1 + g) theta. Springs of two components need two rows of U and RELAXING and a circle for a limit
here, and nowhere else.
"""

from typing import NamedTuple

import numpy as np

from carom.dimensionless.numerics.arrays import Array
from carom.dimensionless.numerics.kernels import kernel

# Columns of the springs: place, its square, weight in the integral over the contact, of which the
# outer part; deflection in shear, and that of the branch that relaxes; the latter in compression,
# or by how much a spring that yields is softer; Coulomb's limit before and after, and its rate; the
# sign of its slip; `bends` between it and the next one, in u and in m.
X, S, WEIGHT, OUTER, U, RELAXING, PRESSED, LIMIT, NEXT, RATE, SLIPS, BEND, BEND_RELAXING = range(13)
SOFTER = PRESSED
SPRING_COLUMNS = 13

SHORT_STEP = 1e-3  # of a step, in relaxation times: where its functions are series


class Step(NamedTuple):
    """What is the same for all springs in a step."""

    time: float
    psi: float  # at its start
    moved: float  # by how much U grows
    relaxing: float  # by how much m grows with U
    extra: float  # g
    give: float  # 1/(1 + g)
    fading: float  # 1/theta
    left: float  # exp(-time/theta)
    kept: float  # of a steady growth of u by m
    slipping: float  # exp(-time/((1 + g) theta))
    forced: float  # of a steady growth of f by m in slip


@kernel
def share(near: float, far: float) -> float:
    """Return the weight at `near` of the integral to `far` of what is linear in x^2."""
    return float(abs(far - near) * (2.0 * far + near) / (3.0 * (far + near)))


@kernel
def lay(springs: Array, count: int, edge: float) -> None:
    """Place a spring at the edge, beside so many.

    The weights integrate what is linear in x^2 between springs and zero at the edge.
    """
    springs[:, count] = 0.0
    springs[X, count], springs[S, count] = edge, edge * edge
    if count > 0:
        outer = share(springs[X, count - 1], edge)
        springs[WEIGHT, count - 1] += outer - springs[OUTER, count - 1]
        springs[OUTER, count - 1] = outer
        springs[WEIGHT, count] = share(edge, springs[X, count - 1])


@kernel
def rim(springs: Array, last: int, edge: float) -> float:
    """Return by how much the last spring's weight differs, as the contact ends at the edge."""
    return float(share(springs[X, last], edge) - springs[OUTER, last])


@kernel
def integral(springs: Array, row: int, count: int, edge: float) -> float:
    """Return the integral over the contact of what so many springs have, zero at the edge."""
    total = rim(springs, count - 1, edge) * springs[row, count - 1] if count > 0 else 0.0
    for j in range(count):
        total += springs[WEIGHT, j] * springs[row, j]
    return float(total)


@kernel
def faded(time: float, relaxation: float) -> tuple[float, float, float]:
    """Return what fading leaves: of what was there, of a steady growth, of a growing rate.

    exp(-q), (1 - exp(-q))/q and theta ((1 + exp(-q))/2 - (1 - exp(-q))/q), q = time/theta; the last
    times the change of the rate over the step.
    """
    q = time / relaxation
    left = np.exp(-q)
    if q < SHORT_STEP:
        return left, 1.0 - 0.5 * q + q * q / 6.0, time * q / 12.0
    kept = -np.expm1(-q) / q
    return left, kept, relaxation * (0.5 * (1.0 + left) - kept)


@kernel
def lowest(start: float, slope: float, end: float) -> float:
    """Return the least value, its start apart, of a parabola on [0, 1].

    Slip that stops within a step leaves the springs at the limit of that moment; without it the
    error would depend on where in the step slip stops.
    """
    curvature = end - start - slope
    if slope < 0.0 and -slope < 2.0 * curvature:
        return start - slope * slope / (4.0 * curvature)
    return end


@kernel
def step_of(
    extra: float, relaxation: float, time: float, psi: float, half: float, rate: float
) -> Step:
    """Return a step from its length, psi at its start and in its middle, and psi'."""
    left, kept, growing = faded(time, relaxation)
    slower = (1.0 + extra) * relaxation
    slipping, forced, _ = faded(time, slower)
    moved, relaxing = half * time, half * time * kept + growing * rate * time
    give, fading, forced = 1.0 / (1.0 + extra), 1.0 / relaxation, forced / (1.0 + extra)
    return Step(time, psi, moved, relaxing, extra, give, fading, left, kept, slipping, forced)


@kernel
def stretch(springs: Array, count: int, edge: float, step: Step) -> tuple[float, float, float]:
    """Move so many springs on by a step; return the integrals of f and m^2 over the contact.

    Between both, that of f at the end with which the mean over the step is that of its ends.
    """
    if step.extra == 0.0:
        return stretch_elastic(springs, count, edge, step)
    force, more, square = 0.0, 0.0, 0.0
    for j in range(count):
        limits = springs[LIMIT, j], springs[NEXT, j], springs[RATE, j]
        u, m, slip = stretched(springs[U, j], springs[RELAXING, j], *limits, step)
        sign, weight = 1.0 * (slip > 0.0) - 1.0 * (slip < 0.0), springs[WEIGHT, j]
        if sign != springs[SLIPS, j]:
            start = limits[0] - sign * force_of(springs, j, step.extra)
            more += weight * late(start, slip / step.give, limits[0])
            springs[SLIPS, j] = sign
        springs[U, j], springs[RELAXING, j] = u, m
        if j == count - 1:
            weight += rim(springs, j, edge)
        force += weight * (u + step.extra * m)
        square += weight * m * m
    force += bends(springs, count, edge, step.extra, step.left)
    return force, force + more, square


@kernel
def stretch_elastic(
    springs: Array, count: int, edge: float, step: Step
) -> tuple[float, float, float]:
    """Move so many springs on by a step, of which no part relaxes: the same with m = 0."""
    force, more = 0.0, 0.0
    for j in range(count):
        u, limit, limit_end = springs[U, j], springs[LIMIT, j], springs[NEXT, j]
        stuck, slope = u + step.moved, springs[RATE, j]
        forth = lowest(limit - u, (slope - step.psi) * step.time, limit_end - stuck)
        back = lowest(limit + u, (slope + step.psi) * step.time, limit_end + stuck)
        slip = min(back, 0.0) - min(forth, 0.0)
        sign = 1.0 * (slip > 0.0) - 1.0 * (slip < 0.0)
        if sign != springs[SLIPS, j]:
            more += springs[WEIGHT, j] * late(limit - sign * u, slip, limit)
            springs[SLIPS, j] = sign
        springs[U, j] = stuck - slip
        force += springs[WEIGHT, j] * springs[U, j]
    if count > 0:
        force += rim(springs, count - 1, edge) * springs[U, count - 1]
    force += bends(springs, count, edge, 0.0, 1.0)
    return force, force + more, 0.0


@kernel
def late(start: float, slip: float, limit: float) -> float:
    """Return twice by how much the mean of f over a step exceeds that of both ends.

    f turns from stick to its limit, which was so far at the start and is passed by the slip. Less
    its mean over all starts, where steps are short, so that what is left has no bias.
    """
    if start <= 0.0 or slip == 0.0:
        return 0.0
    whole = start + abs(slip)
    mean = np.copysign(whole, slip) / 6.0 * max(1.0 - (whole / limit) ** 4, 0.0)
    return float(slip * start / whole - mean)


@kernel
def bends(springs: Array, count: int, edge: float, extra: float, left: float) -> float:
    """Return what the integral of f misses between springs of which one slips and one sticks.

    There f bends; where slip stops the bend stays, with an error that depends on where between the
    springs it is. While it moves the mean of that is left out. A bend has a part that relaxes.
    """
    total = 0.0
    for j in range(count - 1):
        here, beyond = springs[SLIPS, j], springs[SLIPS, j + 1]
        if here != beyond:
            area, mean = 0.0, 0.0
            if here == 0.0 and j > 0:
                area, mean = corner(
                    springs, j, j - 1, springs[X, j + 1], springs[NEXT, j + 1], beyond, extra
                )
            elif beyond == 0.0 and j < count - 2:
                area, mean = corner(
                    springs, j + 1, j + 2, springs[X, j], springs[NEXT, j], here, extra
                )
            m = springs[BEND_RELAXING, j] * left
            grown = (area - springs[BEND, j] - extra * m) / (1.0 + extra)
            springs[BEND, j], springs[BEND_RELAXING, j] = springs[BEND, j] + grown, m + grown
            total += area - mean
        elif springs[BEND, j] != 0.0:
            kept = 1.0 if here == 0.0 else 0.0
            springs[BEND, j] *= kept
            springs[BEND_RELAXING, j] *= kept * left
            total += springs[BEND, j] + extra * springs[BEND_RELAXING, j]
    if count > 1 and springs[SLIPS, count - 1] == 0.0:
        total += rim_bend(springs, count - 1, edge, extra)
    return total


@kernel
def rim_bend(springs: Array, last: int, edge: float, extra: float) -> float:
    """Return the same between the last spring, which sticks, and the edge.

    While the edge grows f is curved there: the error is made to grow with the part of the cell that
    is filled. Else f ends in a ring that slips.
    """
    at_edge = force_at(springs, last, last - 1, edge, extra)
    empty = 2.0 * springs[X, last] - springs[X, last - 1] - edge
    if springs[NEXT, last] > springs[LIMIT, last] and empty >= 0.0:
        return float(-at_edge * empty / 6.0)
    sign = np.copysign(1.0, at_edge)
    return float(corner(springs, last, last - 1, edge, 0.0, sign, extra)[0])


@kernel
def corner(
    springs: Array, near: int, far: int, x: float, limit: float, sign: float, extra: float
) -> tuple[float, float]:
    """Return the area between f and the line from a spring that sticks to a place x that slips.

    And its mean over all places of the bend, where that is resolved. f is linear in x^2 through the
    springs that stick.
    """
    f = sign * force_of(springs, near, extra)
    gap, over = springs[NEXT, near] - f, sign * force_at(springs, near, far, x, extra) - limit
    if gap <= 0.0 or over <= 0.0:
        return 0.0, 0.0
    length, whole = sign * abs(x - springs[X, near]), gap + over
    mean = length * whole / 12.0 * max(1.0 - (whole / springs[NEXT, near]) ** 4, 0.0)
    return float(0.5 * length * gap * over / whole), float(mean)


@kernel
def force_at(springs: Array, near: int, far: int, x: float, extra: float) -> float:
    """Return what springs would bear in shear at a place, by the line in x^2 through two."""
    f, s = force_of(springs, near, extra), springs[S, near]
    slope = (f - force_of(springs, far, extra)) / (s - springs[S, far])
    return float(f + slope * (x * x - s))


@kernel
def force_of(springs: Array, j: int, extra: float) -> float:
    """Return what a spring bears in shear."""
    return float(springs[U, j] + extra * springs[RELAXING, j])


@kernel
def stretched(
    u: float, m: float, limit: float, limit_end: float, rate: float, step: Step
) -> tuple[float, float, float]:
    """Return u and m after a step, and the slip; rate is that of the limit at its start."""
    stuck, relaxed = u + step.moved, m * step.left + step.relaxing
    least, end, slid, slid_m = _slip(1.0, u, m, limit, limit_end, rate, step)
    sign = 1.0
    if least >= 0.0:
        least, end, slid, slid_m = _slip(-1.0, u, m, limit, limit_end, rate, step)
        sign = -1.0
    if least >= 0.0:
        return stuck, relaxed, 0.0
    if least == end:
        return slid, slid_m, -sign * least
    return stuck + sign * least, relaxed + sign * least * step.kept, -sign * least


@kernel
def _slip(
    sign: float, u: float, m: float, limit: float, limit_end: float, rate: float, step: Step
) -> tuple[float, float, float, float]:
    """Return how slip differs from stick at the least and at the end, and u and m after it."""
    g, stuck = step.extra, u + step.moved
    start = (limit - sign * (u + g * m)) * step.give  # to the limit, at once
    began = m + sign * start
    slid_m = began * step.slipping + sign * (limit_end - limit) * step.forced
    slid = sign * limit_end - g * slid_m
    slope = (rate + sign * g * step.fading * began) * step.give - sign * step.psi
    end = sign * (slid - stuck)
    return lowest(start, slope * step.time, end), end, slid, slid_m
