"""Quasi-static load paths: the memory of a contact driven through any history.

A step is a straight line in penetration d and tangential displacement U. It discards what leaves
the contact, slip cuts F down to l, and new contact is laid at its limits (`memory`): no more than
one annulus is added, so that the cost of a step is constant on average. Where the force Q is wanted
instead of U, the front of slip is the root of a cubic. |Q| <= (2/3) d^(3/2) is Coulomb's cone.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.dimensionless.load_paths import memory
from carom.dimensionless.load_paths.dissipation import Step, work_leaving, work_on_new, work_within
from carom.dimensionless.numerics.arrays import Array, Flags, Matrix, Vector
from carom.dimensionless.numerics.kernels import entry_point, kernel

# What is known after a step.
DISPLACEMENT, TRACTION, STICK, STORED, WORK = range(5)
RESULTS = 5

ROUNDING = 16.0 * np.finfo(np.float64).eps  # relative; differences of forces below it are none
INSIDE = -1  # no step lies outside Coulomb's cone


@kernel
def sign_of(value: float, rounding: float) -> int:
    """Return the sign of a value, 0 if it is no more than rounding."""
    if abs(value) <= rounding:
        return 0
    return 1 if value > 0.0 else -1


@kernel
def find_front(
    stack: Array, j: int, sign: int, d: float, target: float, by_force: bool
) -> tuple[int, float, float]:
    """Return annulus and s of the front of slip, and U, in a step to d and a wanted U or Q."""
    i, s = 0, 0.0
    if not by_force:
        rounding = ROUNDING * (d + abs(target))
        i, s = memory.front_at_limit(stack, j, sign, d - sign * target, rounding)
        return i, min(s, d), target
    b = np.sqrt(d)
    rounding = ROUNDING * memory.cubes(0.0, b)
    if abs(target) < memory.cubes(0.0, b) - rounding:
        i, s = memory.front_at_force(stack, j, sign, b, target, rounding)
    s = min(s, d)
    return i, s, sign * (d - s) - memory.shift_at(stack, i, s)


@kernel
def load(
    stack: Array, top: int, d0: float, u0: float, d1: float, target: float, by_force: bool
) -> tuple[int, float, float]:
    """Take a step that deepens the contact; return the new top, U and the work of slip."""
    rise, b = d1 - d0, np.sqrt(d1)
    if by_force:
        g = (target - stack[top, memory.FORCE]) / memory.cubes(stack[top, memory.RADIUS], b)
        if abs(target) >= memory.cubes(0.0, b) * (1.0 - ROUNDING):
            g = 2.0 * np.sign(target)
    else:
        g = (target - u0) / rise
    if abs(g) <= 1.0:
        u1 = u0 + g * rise if by_force else target
        below = top - 1 if top > 0 and stack[top, memory.SLOPE] == g else top
        return memory.add(stack, below, d1, g, -u1), u1, 0.0
    sign = 1 if g > 0.0 else -1
    i, s, u1 = find_front(stack, top, sign, d1, target, by_force)
    step = Step(d0, u0, d1, u1)
    work = work_within(stack, i, s, top, sign, step) + work_on_new(step)
    return memory.slip_outside(stack, i, s, sign, d1, u1), u1, work


@kernel
def unload(
    stack: Array, top: int, d0: float, u0: float, d1: float, target: float, by_force: bool
) -> tuple[int, float, float]:
    """Take a step that does not deepen the contact; return as `load`."""
    j = memory.annulus_at(stack, top, d1)
    c, force = memory.edge_at(stack, j, d1)
    if by_force:
        sign = sign_of(target - force, ROUNDING * memory.cubes(0.0, np.sqrt(d1)))
    else:
        sign = sign_of(target + c, ROUNDING * (d1 + abs(target)))
    i, s, u1 = j, d1, -c if by_force else target
    if sign != 0:
        i, s, u1 = find_front(stack, j, sign, d1, target, by_force)
    step = Step(d0, u0, d1, u1)
    work = work_within(stack, i, s, j, sign, step) + work_leaving(stack, j, top, step)
    if sign == 0:
        return memory.cut(stack, j, d1), u1, work
    return memory.slip_outside(stack, i, s, sign, d1, u1), u1, work


@kernel
def part(
    stack: Array, top: int, d0: float, u0: float, d1: float, target: float, by_force: bool
) -> tuple[int, float, float]:
    """Take a step that ends in separation; return as `load`. A force has then let go of U."""
    u1 = -stack[0, memory.SHIFT] if by_force else target
    work = work_leaving(stack, 0, top, Step(d0, u0, d1, u1))
    stack[0, memory.SHIFT] = -u1
    return 0, u1, work


@kernel
def touch(stack: Array, d0: float, u0: float, d1: float, target: float, by_force: bool) -> float:
    """Start the memory at the first touch within a step; return U there."""
    if by_force:
        g = min(max(target / memory.cubes(0.0, np.sqrt(d1)), -1.0), 1.0)
    else:
        g = (target - u0) / (d1 - d0)
    stack[0, memory.SHIFT] = g * d0 - u0
    return u0 - g * d0


@kernel
def advance(
    stack: Array, top: int, d0: float, u0: float, d1: float, target: float, by_force: bool
) -> tuple[int, float, float]:
    """Take a step to a depth and a wanted U or, `by_force`, Q; return the new top, U and work."""
    if d1 <= 0.0:
        return part(stack, top, d0, u0, d1, target, by_force)
    if d0 < 0.0:
        d0, u0 = 0.0, touch(stack, d0, u0, d1, target, by_force)
    if np.sqrt(d1) > stack[top, memory.RADIUS]:
        return load(stack, top, d0, u0, d1, target, by_force)
    return unload(stack, top, d0, u0, d1, target, by_force)


@entry_point()
def follow(
    stack: Matrix, depths: Vector, targets: Vector, by_force: Flags, results: Matrix
) -> tuple[int, int]:
    """Follow a path from the first touch; return the top and the step that is refused, or INSIDE.

    A row of results is filled for each step.
    """
    top, d, u, total = 0, 0.0, 0.0, 0.0
    for n in range(depths.size):
        cone = memory.cubes(0.0, np.sqrt(max(depths[n], 0.0)))
        if by_force[n] and abs(targets[n]) > cone * (1.0 + ROUNDING):
            return top, n
        top, u, work = advance(stack, top, d, u, depths[n], targets[n], by_force[n])
        d = depths[n]
        total += work
        results[n, DISPLACEMENT] = u
        results[n, TRACTION] = stack[top, memory.FORCE]
        results[n, STICK] = memory.stick_radius(stack, top)
        results[n, STORED] = 0.5 * stack[top, memory.SQUARE]
        results[n, WORK] = total
    return top, INSIDE


@entry_point()
def motion_of_surfaces(
    stack: Matrix, depths: Vector, displacements: Vector, radii: Vector, out: Matrix
) -> None:
    """Write U less the mean displacement u_0 of the surfaces, and u_2, where radii ask for them.

    A row for each step, and in the last rows the end of the path for each radius again.
    """
    top, d, u = 0, 0.0, 0.0
    for n in range(depths.size):
        top, u, _ = advance(stack, top, d, u, depths[n], displacements[n], False)
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
