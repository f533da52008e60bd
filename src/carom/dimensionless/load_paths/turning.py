"""Load paths in two directions: springs on a lattice, each through straight steps in closed form.

Units as in `memory`. Springs stand at x = k h, s = x^2; between them q is linear in s. On a line
this is the exact contact in the limit of many springs; where the direction turns, it is a model of
it, as springs slip each in its own direction.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.dimensionless.load_paths.memory import cubes
from carom.dimensionless.load_paths.paths import INSIDE, ROUNDING
from carom.dimensionless.load_paths.turning_spring import turned
from carom.dimensionless.numerics.arrays import Array, Flags, Matrix, Vector
from carom.dimensionless.numerics.kernels import entry_point, kernel

# What is known after a step.
U_X, U_Y, Q_X, Q_Y, STICK, STORED, WORK = range(7)
RESULTS = 7
# Lines of the springs: deflections before a step and after it, work of slip in it.
X, Y, NEW_X, NEW_Y, LOST = range(5)
LINES = 5

SPRINGS = 1024
CLOSE = 1e-11  # of the largest force: where the search for a displacement ends
SEARCHES, HALVINGS = 80, 30
TILT = 1e-6  # of the depth: displacements from which stiffnesses are taken
SOFTEST = 1e-7  # of the stiffness of a contact that sticks


class Pull(NamedTuple):
    """The force that the springs bear, and the work of their slip in the step."""

    x: float
    y: float
    work: float


@kernel
def falling(low: float, high: float) -> float:
    """Return the integral over x from low to high of what falls from 1 to 0, linear in x^2."""
    return (high - low) * (2.0 * high + low) / (3.0 * (high + low)) if high > low else 0.0


@kernel
def weight(k: int, h: float, rim: float) -> float:
    """Return the weight of spring k in an integral over x up to the rim, where all is zero."""
    x = k * h
    if x >= rim:
        return 0.0
    inner = h - falling(x - h, x) if k > 0 else 0.0
    return inner + falling(x, min(x + h, rim))


@kernel
def take(springs: Array, h: float, d0: float, d1: float, u: float, v: float) -> Pull:
    """Bring all springs through a step, without letting it count."""
    along, across, work, rim = 0.0, 0.0, 0.0, np.sqrt(max(d1, 0.0))
    count = springs.shape[1]
    for k in range(count):
        s = (k * h) ** 2
        if s >= d0 and s >= d1:
            springs[NEW_X, k] = springs[NEW_Y, k] = springs[LOST, k] = 0.0
            continue
        new = turned(springs[X, k], springs[Y, k], s, d0, d1, u, v)
        springs[NEW_X, k], springs[NEW_Y, k], springs[LOST, k] = new
        share = weight(k, h, rim)
        along += share * new.x
        across += share * new.y
        work += weight(k, h, count * h) * new.work
    return Pull(along, across, work)


@kernel
def keep(springs: Array) -> None:
    """Let the step that was taken last count."""
    springs[X], springs[Y] = springs[NEW_X], springs[NEW_Y]


@kernel
def direction(
    springs: Array, h: float, d0: float, d1: float, at: tuple[float, float], lack: Pull
) -> tuple[float, float]:
    """Return by Newton's method how the bodies should move on to make up for a lack of force.

    Stiffnesses are those towards it; a little is added to them, as there is none in gross slip.
    """
    tilt, least = TILT * d1, SOFTEST * np.sqrt(d1)
    here = take(springs, h, d0, d1, at[0], at[1])
    x, y = np.copysign(tilt, lack.x), np.copysign(tilt, lack.y)
    one = take(springs, h, d0, d1, at[0] + x, at[1])
    two = take(springs, h, d0, d1, at[0], at[1] + y)
    xx, yx = (one.x - here.x) / x + least, (one.y - here.y) / x
    xy, yy = (two.x - here.x) / y, (two.y - here.y) / y + least
    size = xx * yy - xy * yx
    u, v = (yy * lack.x - xy * lack.y) / size, (xx * lack.y - yx * lack.x) / size
    cut = min(2.0 * max(d0, d1) / max(np.hypot(u, v), 1e-300), 1.0)
    if size <= 0.0 or u * lack.x + v * lack.y <= 0.0:
        return lack.x / np.sqrt(d1), lack.y / np.sqrt(d1)
    return cut * u, cut * v


@kernel
def pushed(
    springs: Array, h: float, d0: float, d1: float, wanted: tuple[float, float]
) -> tuple[float, float, Pull, bool]:
    """Take a step to a depth and a force; return the displacement, the force, whether it is found.

    The force rises with the displacement. So Newton's step is shortened by halves if on its way
    what lacks has turned its sign; in gross slip nothing else tells how far to go.
    """
    u = v = 0.0
    most = cubes(0.0, np.sqrt(d1))
    force = take(springs, h, d0, d1, u, v)
    for _ in range(SEARCHES):
        lack = Pull(wanted[0] - force.x, wanted[1] - force.y, 0.0)
        if np.hypot(lack.x, lack.y) <= CLOSE * most:
            return u, v, force, True
        du, dv = direction(springs, h, d0, d1, (u, v), lack)
        first = lack.x * du + lack.y * dv
        for _ in range(HALVINGS):
            force = take(springs, h, d0, d1, u + du, v + dv)
            if (wanted[0] - force.x) * du + (wanted[1] - force.y) * dv >= -0.5 * first:
                break
            du, dv, first = 0.5 * du, 0.5 * dv, 0.5 * first
        u, v = u + du, v + dv
    return u, v, force, False


@kernel
def stored(springs: Array, h: float, d: float) -> float:
    """Return half the integral of q^2."""
    total, rim = 0.0, np.sqrt(max(d, 0.0))
    for k in range(springs.shape[1]):
        total += weight(k, h, rim) * (springs[X, k] ** 2 + springs[Y, k] ** 2)
    return 0.5 * total


@kernel
def stick_radius(springs: Array, h: float, d: float) -> float:
    """Return the radius within which no spring is at its limit, from gaps taken as linear in s."""
    last, before, edge = 0.0, 0.0, max(d, 0.0)
    for k in range(springs.shape[1]):
        s = (k * h) ** 2
        if s >= edge:
            break
        gap = d - s - np.hypot(springs[X, k], springs[Y, k])
        if gap <= ROUNDING * d:
            inner = (max(k - 1, 0) * h) ** 2
            if k > 1 and before > last:
                inner += min(last * h * h * (2 * k - 3) / (before - last), s - inner)
            return float(np.sqrt(inner))
        last, before = gap, last
    return float(np.sqrt(edge))


@entry_point()
def follow(
    springs: Matrix, h: float, depths: Vector, targets: Matrix, by_force: Flags, results: Matrix
) -> int:
    """Follow a path from the first touch; return the step that is refused, or INSIDE.

    A row of results is filled for each step.
    """
    d, u, v, total = 0.0, 0.0, 0.0, 0.0
    for n in range(targets.shape[0]):
        to, to_x, to_y = depths[n], targets[n, 0], targets[n, 1]
        cone = cubes(0.0, np.sqrt(max(to, 0.0)))
        if by_force[n] and np.hypot(to_x, to_y) > cone * (1.0 + ROUNDING):
            return n
        if not by_force[n]:
            du, dv = to_x - u, to_y - v
            force = take(springs, h, d, to, du, dv)
        elif to <= 0.0:  # a force lets go
            du, dv = -springs[X, 0], -springs[Y, 0]
            force = take(springs, h, d, to, du, dv)
        else:
            du, dv, force, found = pushed(springs, h, d, to, (to_x, to_y))
            if not found:
                return n
        keep(springs)
        d, u, v, total = to, u + du, v + dv, total + force.work
        results[n, U_X], results[n, U_Y] = u, v
        results[n, Q_X], results[n, Q_Y] = force.x, force.y
        results[n, STICK], results[n, WORK] = stick_radius(springs, h, d), total
        results[n, STORED] = stored(springs, h, d)
    return INSIDE


def follow_path(depths: Array, targets: Array, by_force: NDArray[np.bool_]) -> tuple[Array, int]:
    """Follow a path to depths d and wanted (U_x, U_y) or, where `by_force`, (Q_x, Q_y).

    Targets have the shape (n, 2); returns a row of results for each step, and the step refused.
    """
    results = np.full((len(targets), RESULTS), np.nan)
    h = np.sqrt(max(float(depths.max()), 0.0)) / SPRINGS
    given = np.ascontiguousarray(depths), np.ascontiguousarray(targets)
    refused = follow(
        np.zeros((LINES, SPRINGS)), h, *given, np.ascontiguousarray(by_force), results
    )
    return results, refused
