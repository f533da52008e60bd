"""Quasi-static load paths: the memory of a contact driven through any history.

A step is a straight line in penetration d and tangential displacement U. It discards what leaves
the contact, slip cuts F down to l, and new contact is laid at its limits (`memory`): no more than
one annulus is added, so that the cost of a step is constant on average. Where the force Q is wanted
instead of U, the front of slip is the root of a cubic. |Q| <= (2/3) d^(3/2) is Coulomb's cone.
The work of slip in a step has a closed form.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.dimensionless.load_paths import memory
from carom.dimensionless.load_paths.memory import RADIUS, RIM, SHIFT, SLOPE
from carom.dimensionless.numerics.arrays import Array, Flags, Matrix, Vector
from carom.dimensionless.numerics.kernels import entry_point, kernel

NODES = np.array([-np.sqrt(0.6), 0.0, np.sqrt(0.6)])  # Gauss: exact for degree 5 in the radius
WEIGHTS = np.array([5.0, 8.0, 5.0]) / 9.0

# Columns of the results of a step.
DISPLACEMENT, TRACTION, STICK, STORED, WORK = range(5)
RESULTS = 5
FORCE_ROUNDING = 16.0 * np.finfo(np.float64).eps  # relative; smaller differences are none
INSIDE = -1  # no step lies outside Coulomb's cone


class Way(NamedTuple):
    """A straight step as it is wanted: d and U before it, d after it, and U or, by force, Q."""

    d0: float
    u0: float
    d1: float
    target: float
    by_force: bool


class Step(NamedTuple):
    """A straight step: d and U before and after."""

    d0: float
    u0: float
    d1: float
    u1: float


@kernel
def work_in(stack: Array, k: int, low: float, high: float, sign: int, step: Step) -> float:
    """Return the work of slip of this sign from radius low to high in annulus k.

    A spring slips from F(s) = l(t0) until the end t1 of the step or of its contact:
    w(s) = (l0 - l1) * integral of (d - s) dt, quadratic in s where F and t1 are linear.
    """
    before, after = step.d0 - sign * step.u0, step.d1 - sign * step.u1
    fall, deepening = before - after, step.d1 - step.d0
    if high <= low or fall <= 0.0:
        return 0.0
    middle, half, total = 0.5 * (high + low), 0.5 * (high - low), 0.0
    for n in range(NODES.size):
        s = (middle + half * NODES[n]) ** 2
        start = (before - s - sign * memory.shift_at(stack, k, s)) / fall
        end = 1.0
        if s > step.d1 and deepening < 0.0:  # by rounding also where nothing leaves
            end = min(max((s - step.d0) / deepening, 0.0), 1.0)
        start = min(max(start, 0.0), end)
        mean = step.d0 + 0.5 * deepening * (start + end) - s
        total += WEIGHTS[n] * fall * (end - start) * mean
    return half * total


@kernel
def work_within(stack: Array, i: int, s: float, j: int, sign: int, step: Step) -> float:
    """Return the work of slip between the front at s in annulus i and the edge in annulus j."""
    front, rim, total = np.sqrt(s), np.sqrt(min(step.d0, step.d1)), 0.0
    for k in range(max(i, 1), j + 1):
        low, high = max(stack[k - 1, RADIUS], front), min(stack[k, RADIUS], rim)
        total += work_in(stack, k, low, high, sign, step)
    return total


@kernel
def work_leaving(stack: Array, j: int, top: int, step: Step) -> float:
    """Return the work of slip of the springs that leave the contact in a step.

    Which sign slips is that of the deflection with which a spring would leave if it stuck; it is
    linear in s on each annulus.
    """
    if step.d1 == step.d0:
        return 0.0
    edge, total = max(step.d1, 0.0), 0.0
    drift = (step.u1 - step.u0) / (step.d1 - step.d0)
    for k in range(max(j, 1), top + 1):
        inner, g = stack[k - 1, RIM], stack[k, SLOPE]
        low, high = max(inner, edge), stack[k, RIM]
        at_low = step.u1 + drift * (low - step.d1) + stack[k - 1, SHIFT] - g * (low - inner)
        at_high = at_low + (drift - g) * (high - low)
        turn = high
        if at_low * at_high < 0.0:
            turn = low + (high - low) * at_low / (at_low - at_high)
        sign = 1 if at_low > 0.0 or (at_low == 0.0 and at_high > 0.0) else -1
        middle = np.sqrt(turn)
        total += work_in(stack, k, np.sqrt(low), middle, sign, step)
        total += work_in(stack, k, middle, stack[k, RADIUS], -sign, step)
    return total


@kernel
def work_on_new(step: Step) -> float:
    """Return the work of slip on contact that is laid in a step: as above, from touch to end."""
    rise = step.d1 - step.d0
    fall = abs(step.u1 - step.u0) - rise
    return 0.5 * fall / rise * memory.ring_square(np.sqrt(step.d0), np.sqrt(step.d1))


@kernel
def sign_of(value: float, rounding: float) -> int:
    """Return the sign of a value, 0 if it is no more than rounding."""
    if abs(value) <= rounding:
        return 0
    return 1 if value > 0.0 else -1


@kernel
def find_front(stack: Array, j: int, sign: int, way: Way) -> tuple[int, float, float]:
    """Return annulus and s of the front of slip, and U, in a step to d and a wanted U or Q."""
    i, s, d, target = 0, 0.0, way.d1, way.target
    if not way.by_force:
        rounding = FORCE_ROUNDING * (d + abs(target))
        i, s = memory.front_at_limit(stack, j, sign, d - sign * target, rounding)
        return i, min(s, d), target
    b = np.sqrt(d)
    rounding = FORCE_ROUNDING * memory.cubes(0.0, b)
    if abs(target) < memory.cubes(0.0, b) - rounding:
        i, s = memory.front_at_force(stack, j, sign, b, target, rounding)
    s = min(s, d)
    return i, s, sign * (d - s) - memory.shift_at(stack, i, s)


@kernel
def load(stack: Array, top: int, way: Way) -> tuple[int, float, float]:
    """Take a step that deepens the contact; return the new top, U and the work of slip."""
    d0, u0, d1, target, by_force = way
    rise, b = d1 - d0, np.sqrt(d1)
    if by_force:
        g = (target - stack[top, memory.FORCE]) / memory.cubes(stack[top, RADIUS], b)
        if abs(target) >= memory.cubes(0.0, b) * (1.0 - FORCE_ROUNDING):
            g = 2.0 * np.sign(target)
    else:
        g = (target - u0) / rise
    if abs(g) <= 1.0:
        u1 = u0 + g * rise if by_force else target
        below = top - 1 if top > 0 and stack[top, SLOPE] == g else top
        return memory.add(stack, below, d1, g, -u1), u1, 0.0
    sign = 1 if g > 0.0 else -1
    i, s, u1 = find_front(stack, top, sign, way)
    step = Step(d0, u0, d1, u1)
    work = work_within(stack, i, s, top, sign, step) + work_on_new(step)
    return memory.slip_outside(stack, i, s, sign, d1, u1), u1, work


@kernel
def unload(stack: Array, top: int, way: Way) -> tuple[int, float, float]:
    """Take a step that does not deepen the contact; return as `load`."""
    d0, u0, d1, target, by_force = way
    j = memory.annulus_at(stack, top, d1)
    c, force = memory.edge_at(stack, j, d1)
    if by_force:
        sign = sign_of(target - force, FORCE_ROUNDING * memory.cubes(0.0, np.sqrt(d1)))
    else:
        sign = sign_of(target + c, FORCE_ROUNDING * (d1 + abs(target)))
    i, s, u1 = j, d1, -c if by_force else target
    if sign != 0:
        i, s, u1 = find_front(stack, j, sign, way)
    step = Step(d0, u0, d1, u1)
    work = work_within(stack, i, s, j, sign, step) + work_leaving(stack, j, top, step)
    if sign == 0:
        return memory.cut(stack, j, d1), u1, work
    return memory.slip_outside(stack, i, s, sign, d1, u1), u1, work


@kernel
def part(stack: Array, top: int, way: Way) -> tuple[int, float, float]:
    """Take a step that ends in separation; return as `load`. A force has then let go of U."""
    u1 = -stack[0, SHIFT] if way.by_force else way.target
    work = work_leaving(stack, 0, top, Step(way.d0, way.u0, way.d1, u1))
    stack[0, SHIFT] = -u1
    return 0, u1, work


@kernel
def touch(stack: Array, way: Way) -> float:
    """Start the memory at the first touch within a step; return U there."""
    d0, u0, d1, target, by_force = way
    if by_force:
        g = min(max(target / memory.cubes(0.0, np.sqrt(d1)), -1.0), 1.0)
    else:
        g = (target - u0) / (d1 - d0)
    stack[0, SHIFT] = g * d0 - u0
    return u0 - g * d0


@kernel
def advance(stack: Array, top: int, way: Way) -> tuple[int, float, float]:
    """Take a step to a depth and a wanted U or, `by_force`, Q; return the new top, U and work."""
    if way.d1 <= 0.0:
        return part(stack, top, way)
    if way.d0 < 0.0:
        way = Way(0.0, touch(stack, way), way.d1, way.target, way.by_force)
    if np.sqrt(way.d1) > stack[top, RADIUS]:
        return load(stack, top, way)
    return unload(stack, top, way)


@entry_point()
def follow(
    stack: Matrix, depths: Vector, targets: Vector, by_force: Flags, results: Matrix
) -> tuple[int, int]:
    """Follow a path, a row of results for each step; return the top and the bad step, or INSIDE."""
    top, d, u, total = 0, 0.0, 0.0, 0.0
    for n in range(depths.size):
        cone = memory.cubes(0.0, np.sqrt(max(depths[n], 0.0)))
        if by_force[n] and abs(targets[n]) > cone * (1.0 + FORCE_ROUNDING):
            return top, n
        top, u, work = advance(stack, top, Way(d, u, depths[n], targets[n], by_force[n]))
        d = depths[n]
        total += work
        row = results[n]
        row[DISPLACEMENT], row[TRACTION] = u, stack[top, memory.FORCE]
        row[STICK], row[STORED] = memory.stick_radius(stack, top), 0.5 * stack[top, memory.SQUARE]
        row[WORK] = total
    return top, INSIDE


@entry_point()
def motion_of_surfaces(
    stack: Matrix, depths: Vector, displacements: Vector, radii: Vector, out: Matrix
) -> None:
    """Write U - u_0 and u_2 where radii ask for them, in rows of steps, and of the end for all."""
    top, d, u = 0, 0.0, 0.0
    for n in range(depths.size):
        top, u, _ = advance(stack, top, Way(d, u, depths[n], displacements[n], False))
        d = depths[n]
        if radii[n] >= 0.0:
            mean, lateral = memory.carried(stack, top, radii[n])
            out[n, 0], out[n, 1] = u - mean, lateral
    row = depths.size
    for n in range(depths.size):
        if radii[n] >= 0.0:
            mean, lateral = memory.carried(stack, top, radii[n])
            out[row, 0], out[row, 1] = u - mean, lateral
            row += 1


def slid(depths: Array, displacements: Array, radii: Array) -> Array:
    """Return the radial functions of the slip at the end of a path since the points met.

    w_x = w_0 - lambda w_2 cos 2 theta, w_y = -lambda w_2 sin 2 theta: the motion of the bodies less
    that of their surfaces, from the last touch of a radius on; shape (n, 2), zero outside.
    """
    slip = np.zeros((radii.size, 2))
    path, u = np.append(0.0, depths), np.append(0.0, displacements)
    order = np.argsort(radii, kind="stable")
    order = order[radii[order] ** 2 < path[-1]]
    s = radii[order] ** 2
    before = np.searchsorted(np.minimum.accumulate(path[::-1])[::-1], s, side="right") - 1
    share = (s - path[before]) / (path[before + 1] - path[before])
    met = u[before] + share * (u[before + 1] - u[before])
    marks = np.insert(np.full(depths.size, -1.0), before, radii[order])
    rows = np.empty((marks.size + s.size, 2))
    stack = memory.new_stack(marks.size)
    depths, displacements = np.insert(depths, before, s), np.insert(displacements, before, met)
    motion_of_surfaces(stack, depths, displacements, marks, rows)
    slip[order] = rows[marks.size :] - rows[: marks.size][marks >= 0.0]
    return slip


class Path(NamedTuple):
    """A path followed: a row of results for each step, the memory left, the step refused."""

    results: Array
    stack: Array
    refused: int


def follow_path(depths: Array, targets: Array, by_force: NDArray[np.bool_]) -> Path:
    """Follow a path to depths d and wanted U or, where `by_force`, Q, from the first touch.

    Q = sum of g (2/3) (x_i^3 - x_(i-1)^3) over the annuli, U - U(touch) the same of squares where
    the centre has not slipped.
    """
    results = np.full((depths.size, RESULTS), np.nan)
    stack = memory.new_stack(depths.size)
    depths, targets = np.ascontiguousarray(depths), np.ascontiguousarray(targets)
    top, refused = follow(stack, depths, targets, np.ascontiguousarray(by_force), results)
    return Path(results, stack[: top + 1].copy(), refused)
