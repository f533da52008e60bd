"""The springs that a contact is cut into: where they stand, what they weigh, and how they stretch.

In shear each is a standard linear solid, f = u + g m, m' = u' - m/theta; g = 0 is an elastic one.
In stick u grows as U does. In slip f = sigma N, so that m relaxes by itself, in the time
(1 + g) theta. Springs of two components have a circle for a limit, and slip is along f. Across,
they may be stiffer by a ratio: u is the deflection times the stiffness.
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
HALVES = 2  # of a step: what slip begins and ends within is told better
EACH = 1.0 - 0.5**0.5  # how far each of two implicit steps goes
NO_SLIDE = 1e-12
SHORT_STEP = 1e-3  # of a step, in relaxation times: where its functions are series


class Step(NamedTuple):
    """What is the same for all springs in a step, in one direction."""

    time: float
    psi: float  # at its start
    moved: float  # by how much U grows
    gained: float  # and psi
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
    moves = moved, rate * time, relaxing
    return Step(time, psi, *moves, extra, give, fading, left, kept, slipping, forced)


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
    springs[U, j], springs[U_ACROSS, j] = slid(springs[U, j], springs[U_ACROSS, j], most, ratio)


@kernel
def stretch_both(
    springs: Array, count: int, edge: float, step: Step, across: Step, ratio: float
) -> tuple[float, float, float]:
    """Move springs of two components on; return the integrals of f, of f across and of m^2."""
    force, aside, squares = 0.0, 0.0, 0.0
    for j in range(count):
        move(springs, j, step, across, ratio)
        along, beside = pulled(springs, j, step.extra)
        weight = weight_of(springs, j, count, edge)
        force += weight * along
        aside += weight * beside
        squares += weight * (springs[RELAXING, j] ** 2 + springs[RELAXING_ACROSS, j] ** 2 / ratio)
    return force, aside, squares


@kernel
def move(springs: Array, j: int, step: Step, across: Step, ratio: float) -> None:
    """Move a spring of two components on by two implicit steps in each half of a step.

    Each ends with what slip along f leaves of f in stick. Together they are of second order,
    however fast m relaxes (Alexander 1977, SIAM J. Numer. Anal. 14:1006). The limit is a parabola
    in time, psi is straight.
    """
    u, m = springs[U, j], springs[RELAXING, j]
    v, n = springs[U_ACROSS, j], springs[RELAXING_ACROSS, j]
    limit, rises = springs[LIMIT, j], springs[RATE, j] * step.time
    bends, g, time = springs[NEXT, j] - limit - rises, step.extra, EACH * step.time / HALVES
    fades = 1.0 / (1.0 + time * step.fading)
    for i in range(2 * HALVES):
        first = i % 2 == 0
        part = (i // 2 + (EACH if first else 1.0)) / HALVES
        moved = time * (step.psi + part * step.gained)
        aside = time * (across.psi + part * across.gained)
        pull, beside = u + moved + g * fades * (m + moved), v + aside + g * fades * (n + aside)
        kept, kept_beside = slid(pull, beside, limit + part * (rises + part * bends), ratio)
        moved -= (pull - kept) / (1.0 + g * fades)
        aside -= (beside - kept_beside) / (1.0 + g * fades)
        more = 1.0 / EACH - 1.0 if first else 1.0
        u, m = u + more * moved, m + more * ((m + moved) * fades - m)
        v, n = v + more * aside, n + more * ((n + aside) * fades - n)
    springs[U, j], springs[RELAXING, j] = u, m
    springs[U_ACROSS, j], springs[RELAXING_ACROSS, j] = v, n


@kernel
def slid(pull: float, beside: float, limit: float, ratio: float) -> tuple[float, float]:
    """Return what is left of a pull where slip along it takes it back to the limit.

    Newton's method for the slip l: its components become 1/(1 + l) and 1/(1 + ratio l) of what they
    were, so that 1/size is nearly linear in l.
    """
    square = pull * pull + beside * beside
    if limit <= 0.0:
        return 0.0, 0.0
    if square <= limit * limit:
        return pull, beside
    slip, size = np.sqrt(square) / limit - 1.0, limit
    for _ in range(SLIDES if ratio != 1.0 else 0):
        along, across = 1.0 / (1.0 + slip), 1.0 / (1.0 + ratio * slip)
        x, y = (pull * along) ** 2, (beside * across) ** 2
        size = np.sqrt(x + y)
        change = (size / limit - 1.0) * size * size / (x * along + y * across * ratio)
        slip = max(slip + change, 0.0)
        if abs(change) < NO_SLIDE * (1.0 + slip):
            break
    return pull / (1.0 + slip), beside / (1.0 + ratio * slip)
