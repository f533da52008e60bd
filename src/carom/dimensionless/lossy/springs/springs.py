"""The springs that a contact is cut into: where they stand, what they weigh, and how they stretch.

In shear each is a standard linear solid, f = u + g m, m' = u' - m/theta; g = 0 is an elastic one.
In stick u grows as U does. In slip f = sigma N, so that m relaxes by itself, in the time
(1 + g) theta. Springs of two components have a circle for a limit, and slip is along f; in slip f
turns towards the velocity of the bodies. Across, they may be stiffer by a ratio: u is the
deflection times the stiffness.
"""

from typing import NamedTuple

import numpy as np

from carom.dimensionless.lossy.springs.motion import EDGE, LOAD
from carom.dimensionless.numerics.arrays import Array
from carom.dimensionless.numerics.kernels import kernel

# Columns of the springs: place, its square, weight in the integral over the contact, of which the
# outer part; deflection in shear, and that of the branch that relaxes; the latter in compression,
# or by how much a spring that yields is softer; Coulomb's limit before and after, and its rate;
# both deflections in shear across.
X, S, WEIGHT, OUTER, U, RELAXING, PRESSED, LIMIT, NEXT, RATE, U_ACROSS, RELAXING_ACROSS = range(12)
SOFTER = PRESSED
SPRING_COLUMNS = 12

SLIDES = 6  # of Newton's method
CREEP = 1.0 - 0.5**0.5  # the first part of a step of a viscous spring
SHORT_STEP = 1e-3  # of a step, in relaxation times: where its functions are series


class Step(NamedTuple):
    """What is the same for all springs in a step, in one direction."""

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
    """Place a spring at the edge; weights integrate what is linear in x^2 and zero at the edge."""
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
def weight_of(springs: Array, j: int, count: int, edge: float) -> float:
    """Return the weight of one of so many springs, as the contact ends at the edge."""
    return float(springs[WEIGHT, j] + (rim(springs, j, edge) if j == count - 1 else 0.0))


@kernel
def integral(springs: Array, row: int, count: int, edge: float) -> float:
    """Return the integral over the contact of what so many springs have, zero at the edge."""
    total = rim(springs, count - 1, edge) * springs[row, count - 1] if count > 0 else 0.0
    one, two, three, whole = 0.0, 0.0, 0.0, count - count % 4
    for j in range(0, whole, 4):  # four sums at once, as each waits for its last addition
        total += springs[WEIGHT, j] * springs[row, j]
        one += springs[WEIGHT, j + 1] * springs[row, j + 1]
        two += springs[WEIGHT, j + 2] * springs[row, j + 2]
        three += springs[WEIGHT, j + 3] * springs[row, j + 3]
    for j in range(whole, count):
        total += springs[WEIGHT, j] * springs[row, j]
    return float((total + one) + (two + three))


@kernel
def recede(springs: Array, laid: int, new: Array) -> int:
    """Fill in the edge, where springs bear nothing, and the load; return how many touch."""
    count = 0
    while count < laid and springs[NEXT, count] > 0.0:
        count += 1
    if count > 0:
        inner, outer = count - 1, count
        part = springs[NEXT, inner] / (springs[NEXT, inner] - springs[NEXT, outer])
        new[EDGE] = np.sqrt(springs[S, inner] + part * (springs[S, outer] - springs[S, inner]))
        new[LOAD] = 1.5 * integral(springs, NEXT, count, new[EDGE])
    return count


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
    """Return the least value of a parabola on [0, 1], its start apart: there slip stops."""
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
    slipping, forced, _ = faded(time, (1.0 + extra) * relaxation)
    moved, relaxing = half * time, half * time * kept + growing * rate * time
    give, fading, forced = 1.0 / (1.0 + extra), 1.0 / relaxation, forced / (1.0 + extra)
    return Step(time, psi, moved, relaxing, extra, give, fading, left, kept, slipping, forced)


@kernel
def stretch(springs: Array, count: int, edge: float, step: Step) -> tuple[float, float]:
    """Move so many springs on by a step; return the integrals of f and m^2 over the contact."""
    if step.extra == 0.0:
        return stretch_elastic(springs, count, edge, step), 0.0
    force, square = 0.0, 0.0
    for j in range(count):
        limits = springs[LIMIT, j], springs[NEXT, j], springs[RATE, j]
        u, m = stretched(springs[U, j], springs[RELAXING, j], *limits, step)
        springs[U, j], springs[RELAXING, j] = u, m
        weight = weight_of(springs, j, count, edge)
        force += weight * (u + step.extra * m)
        square += weight * m * m
    return force, square


@kernel
def stretch_elastic(springs: Array, count: int, edge: float, step: Step) -> float:
    """Move so many springs on by a step, of which no part relaxes: the same with m = 0."""
    for j in range(count):
        u, limit, limit_end = springs[U, j], springs[LIMIT, j], springs[NEXT, j]
        stuck, slope = u + step.moved, springs[RATE, j]
        forth = lowest(limit - u, (slope - step.psi) * step.time, limit_end - stuck)
        back = lowest(limit + u, (slope + step.psi) * step.time, limit_end + stuck)
        springs[U, j] = stuck + min(forth, 0.0) - min(back, 0.0)
    return integral(springs, U, count, edge)


@kernel
def stretched(
    u: float, m: float, limit: float, limit_end: float, rate: float, step: Step
) -> tuple[float, float]:
    """Return u and m after a step; rate is that of the limit at its start."""
    stuck, relaxed = u + step.moved, m * step.left + step.relaxing
    least, end, slid, slid_m = _slip(1.0, u, m, limit, limit_end, rate, step)
    sign = 1.0
    if least >= 0.0:
        least, end, slid, slid_m = _slip(-1.0, u, m, limit, limit_end, rate, step)
        sign = -1.0
    if least >= 0.0:
        return stuck, relaxed
    if least == end:
        return slid, slid_m
    return stuck + sign * least, relaxed + sign * least * step.kept


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


@kernel
def pulled(springs: Array, j: int, extra: float) -> tuple[float, float]:
    """Return what a spring bears in shear, and across."""
    return (
        springs[U, j] + extra * springs[RELAXING, j],
        springs[U_ACROSS, j] + extra * springs[RELAXING_ACROSS, j],
    )


@kernel
def square(springs: Array, j: int, extra: float, ratio: float) -> float:
    """Return twice the energy that a spring holds in shear."""
    u, m = springs[U, j], springs[RELAXING, j]
    v, n = springs[U_ACROSS, j], springs[RELAXING_ACROSS, j]
    return float(u * u + v * v / ratio + extra * (m * m + n * n / ratio))


@kernel
def cut(springs: Array, j: int, most: float, ratio: float) -> None:
    """Cut what an elastic spring bears in shear to a limit."""
    left = slid(complex(springs[U, j], springs[U_ACROSS, j]), most, ratio)
    springs[U, j], springs[U_ACROSS, j] = left.real, left.imag


@kernel
def stretch_both(
    springs: Array, count: int, edge: float, step: Step, across: Step, ratio: float
) -> tuple[float, float, float]:
    """Move springs of two components on; return the integrals of f, of f across and of m^2."""
    force, aside, squares = 0.0, 0.0, 0.0
    psi, moved = complex(step.psi, across.psi), complex(step.moved, across.moved)
    relaxing = complex(step.relaxing, across.relaxing)
    for j in range(count):
        move(springs, j, step, psi, moved, relaxing, ratio)
        along, beside = pulled(springs, j, step.extra)
        weight = weight_of(springs, j, count, edge)
        force += weight * along
        aside += weight * beside
        squares += weight * (springs[RELAXING, j] ** 2 + springs[RELAXING_ACROSS, j] ** 2 / ratio)
    return force, aside, squares


@kernel
def move(
    springs: Array,
    j: int,
    step: Step,
    psi: complex,
    moved: complex,
    relaxing: complex,
    ratio: float,
) -> None:
    """Move a spring of two components, one complex number: it sticks, slips or stops on the way."""
    u = complex(springs[U, j], springs[U_ACROSS, j])
    m = complex(springs[RELAXING, j], springs[RELAXING_ACROSS, j])
    limits = springs[LIMIT, j], springs[NEXT, j], springs[RATE, j]
    stuck = u + moved, m * step.left + relaxing
    if step.left == 0.0:  # all has relaxed within the step
        u, m = crept(u + step.extra / step.fading * psi, *stuck, *limits[:2], step, ratio)
    else:
        u, m = crossed(u, m, psi, *stuck, *limits, step, ratio)
    springs[U, j], springs[U_ACROSS, j] = u.real, u.imag
    springs[RELAXING, j], springs[RELAXING_ACROSS, j] = m.real, m.imag


@kernel
def crossed(
    u: complex,
    m: complex,
    psi: complex,
    held: complex,
    relaxed: complex,
    limit: float,
    limit_end: float,
    rate: float,
    step: Step,
    ratio: float,
) -> tuple[complex, complex]:
    """Return u and m after a step from those before, and those in stick; see `move`."""
    g = step.extra
    bears, stuck = u + g * m, held + g * relaxed
    start, end = (limit - abs(bears)) * step.give, (limit_end - abs(stuck)) * step.give
    unit = direction(bears)
    recovers = g * step.fading * (m * unit.conjugate()).real
    slope = (rate + recovers) * step.give - (psi * unit.conjugate()).real
    least = lowest(start, slope * step.time, end)
    if least >= 0.0:
        return held, relaxed
    if least != end:
        back = slid(stuck, abs(stuck) + least, ratio) - stuck
        return held + back, relaxed + step.kept * back
    part, drive = max(start, 0.0) / (max(start, 0.0) - end), stuck - bears
    at, left = (1.0 - part) * limit + part * limit_end, 1.0 - part
    began = direction(bears + part * drive)
    slips = limit_end * turned(began, left * drive, at, limit_end, ratio)
    m += (limit * began - bears) * step.give  # to the limit, at once
    m = m * step.slipping + (slips - limit * began) * step.forced
    return slips - g * m, m


@kernel
def crept(
    began: complex,
    held: complex,
    relaxed: complex,
    limit: float,
    limit_end: float,
    step: Step,
    ratio: float,
) -> tuple[complex, complex]:
    """Return u and m after a step of a viscous solid, f = u + t u' with t = g theta, likewise.

    Slip is along f, so that F = u + t psi, which began with a value, has F' = u' + t psi' - (F -
    f)/t. Two implicit steps are one of second order, however short t is (Alexander 1977).
    """
    part = CREEP * step.time * step.fading / step.extra
    lag = step.extra * relaxed
    stuck = held + lag
    first = began + CREEP * (stuck - began)
    above = first - slid(first, limit + CREEP * (limit_end - limit), ratio)
    last = stuck - (1.0 / CREEP - 1.0) * part * above / (1.0 + part)
    bears = slid(last, limit_end, ratio)
    u = bears + (last - bears) / (1.0 + part) - lag
    return u, (bears - u) / step.extra


@kernel
def slid(pull: complex, limit: float, ratio: float) -> complex:
    """Return what is left of a pull where slip along it takes it back to the limit.

    Newton's method for the slip l: its components become 1/(1 + l) and 1/(1 + ratio l) of what they
    were, so that 1/size is nearly linear in l.
    """
    size, slip = abs(pull), 0.0
    if size <= limit or limit <= 0.0 or ratio == 1.0:
        return pull * (min(size, max(limit, 0.0)) / size if size > 0.0 else 1.0)
    left = pull
    for _ in range(SLIDES):
        along, across = 1.0 / (1.0 + slip), 1.0 / (1.0 + ratio * slip)
        left = complex(pull.real * along, pull.imag * across)
        size = abs(left)
        steep = left.real**2 * along + left.imag**2 * across * ratio
        slip = max(slip + (size / limit - 1.0) * size * size / steep, 0.0)
    return left * (limit / size)


@kernel
def turned(began: complex, drive: complex, limit: float, end: float, ratio: float) -> complex:
    """Return the direction of a spring that slips while it is driven, and its limit changes.

        limit angle' = (p_y cos - r p_x sin + (r - 1) limit' sin cos)/(cos^2 + r sin^2)

    p is the drive, r the ratio. The angle is that to (r p_x, p_y + (r - 1) limit' sin), of which
    the sine is taken in the middle; without a ratio this is exact for an even limit.
    """
    middle, grown = 0.5 * (limit + end), end - limit
    pull = complex(ratio * drive.real, drive.imag + (ratio - 1.0) * grown * began.imag)
    if ratio == 1.0:
        return towards(began, pull, middle)
    half = towards(began, pull, 2.0 * middle * eased(began, ratio))
    pull = complex(ratio * drive.real, drive.imag + (ratio - 1.0) * grown * half.imag)
    return towards(began, pull, middle * eased(half, ratio))


@kernel
def eased(unit: complex, ratio: float) -> float:
    """Return cos^2 + ratio sin^2."""
    return float(unit.real**2 + ratio * unit.imag**2)


@kernel
def towards(began: complex, pull: complex, limit: float) -> complex:
    """Return a direction turned towards a pull: limit * angle' = -|pull| sin(angle).

    That makes the tangent of half of the angle fade evenly.
    """
    along = direction(pull)
    angle = began * along.conjugate()
    fades = np.exp(-abs(pull) / limit) if limit > 0.0 else 0.0
    near, far = 1.0 + angle.real, fades * fades * (1.0 - angle.real)
    if near + far == 0.0:
        return along
    return along * complex(near - far, 2.0 * fades * angle.imag) / (near + far)


@kernel
def direction(vector: complex) -> complex:
    """Return a vector of length 1 in a direction; of none, none."""
    size = abs(vector)
    return vector / size if size > 0.0 else 0.0 * vector
