"""Load paths in two directions: on one line as `paths`, where they turn by springs.

Springs at x, s = x^2, bear q, and their slopes g = -dq/ds make the traction

    tau(r) = int_r^b g d sqrt(x^2 - r^2),    |tau(r)| <= p(r) = sqrt(b^2 - r^2)

(Barber 1979, (6), in either direction). A step is straight in depth and displacement, and cut into
parts until twice as many come to the same; what they differ by corrects them to second order. In a
part all q follow the bodies, and then go to the nearest q, by elastic energy, that Coulomb's law
allows at every radius (Moreau 1977, J. Differ. Equations 26:347). On a line that is the law of
springs, |q| <= d - s, of `memory`. Units as there.
"""

from collections.abc import Callable
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.dimensionless.load_paths import paths
from carom.dimensionless.load_paths.memory import cubes
from carom.dimensionless.load_paths.paths import FORCE_ROUNDING, INSIDE
from carom.dimensionless.numerics.arrays import Array, Matrix, Vector
from carom.dimensionless.numerics.kernels import entry_point, plain

SPRINGS = 64
MOST_SWEEPS = 2000
TRACTION_SETTLED = 1e-10  # of the radius: the last change of a traction
EDGES_KEPT = 256  # whose rings are known
TINY_LENGTH = 1e-300

# Columns of the results of a step.
U_X, U_Y, Q_X, Q_Y, STICK, STORED, WORK = range(7)
RESULTS = 7

PARTS_TOLERANCE = 1e-3  # of Coulomb's limit: what twice as many parts may differ by
MOST_PARTS = 256
FORCE_SEARCHED, FORCE_REACHED = 1e-9, 1e-6  # likewise: where a search ends, what it must come to
LIMIT_TOLERANCE = 1e-7  # of the limit: a ring as near has reached it
Advance = Callable[[int], object]
limit_at = plain(cubes)


class Rings(NamedTuple):
    """Springs and the rings at their places within an edge b."""

    squares: Array  # s
    weights: Array  # of springs in an integral over x
    limits: Array  # p of the rings
    slopes: Array  # tau = slopes q
    reach: Array  # q = reach tau
    compliance: Array  # of the rings: reach' weights reach


@lru_cache(maxsize=EDGES_KEPT)
def rings_within(h: float, edge: float) -> Rings:
    """Return the springs at x = k h within an edge; between them q is linear in s."""
    x = np.arange(SPRINGS, dtype=np.float64) * h
    x = x[x < edge]
    ends, inner = np.append(x[1:], edge), x[:, None]
    far = np.sqrt(np.maximum(ends**2 - inner**2, 0.0))
    near = np.sqrt(np.maximum(x**2 - inner**2, 0.0))
    fall = (np.eye(x.size) - np.eye(x.size, k=1)) / (ends**2 - x**2)[:, None]
    slopes = np.triu(far - near) @ fall
    reach = np.asarray(np.linalg.inv(slopes), np.float64)
    weights = (ends - x) * (2.0 * ends + x) / (3.0 * (ends + x))
    weights[1:] += (ends - x - weights)[:-1]
    compliance = reach.T @ (weights[:, None] * reach)
    return Rings(x**2, weights, far[:, -1].copy(), slopes, reach, compliance)


@entry_point()
def relax(
    compliance: Matrix, pulled: Matrix, limits: Vector, traction: Matrix, settled: float
) -> int:
    """Bring tractions to tau = pulled or to limits by projected Gauss-Seidel; return its sweeps."""
    for sweep in range(MOST_SWEEPS):
        change = 0.0
        for k in range(limits.size):
            x, y = pulled[k, 0], pulled[k, 1]
            for j in range(limits.size):
                x -= compliance[k, j] * traction[j, 0]
                y -= compliance[k, j] * traction[j, 1]
            x = traction[k, 0] + x / compliance[k, k]
            y = traction[k, 1] + y / compliance[k, k]
            size = np.hypot(x, y)
            if size > limits[k]:
                x, y = x * limits[k] / size, y * limits[k] / size
            change = max(change, abs(x - traction[k, 0]), abs(y - traction[k, 1]))
            traction[k, 0], traction[k, 1] = x, y
        if change <= settled:
            return sweep + 1
    return MOST_SWEEPS


def cut(vectors: Array, most: Array) -> Array:
    """Return vectors cut back to lengths."""
    size = np.hypot(vectors[:, 0], vectors[:, 1])
    return np.asarray((most / np.maximum(size, np.maximum(most, TINY_LENGTH)))[:, None] * vectors)


def held(now: Rings, springs: Array) -> Array:
    """Return the traction of the nearest springs that Coulomb's law allows."""
    edge = now.limits[0]
    traction = cut(now.slopes @ cut(springs, edge**2 - now.squares), now.limits)
    pulled = now.reach.T @ (now.weights[:, None] * springs)
    relax(now.compliance, pulled, now.limits, traction, TRACTION_SETTLED * edge)
    return traction


class State(NamedTuple):
    """The contact: depth, displacement, the springs (zero outside), their force, work of slip."""

    depth: float
    moved: Array  # shape (2,)
    springs: Array  # shape (SPRINGS, 2)
    force: Array  # shape (2,)
    work: float


def limit(depth: float) -> float:
    """Return Coulomb's limit of the force at a depth."""
    return limit_at(0.0, float(np.sqrt(max(depth, 0.0))))


def apart(depth: float, moved: Array, work: float) -> State:
    """Return bodies that do not press on each other."""
    return State(depth, moved, np.zeros((SPRINGS, 2)), np.zeros(2), work)


def step(state: State, h: float, depth: float, moved: Array) -> State:
    """Return the contact after a small step; what is touched in it goes only the rest of the way.

    Work is that of mean forces on the slip: what the bodies moved more than the springs.
    """
    deepest, rise, way = max(depth, state.depth), depth - state.depth, moved - state.moved
    if deepest <= 0.0:
        return apart(depth, moved, state.work)
    s = (np.arange(SPRINGS)[:, None] * h) ** 2
    taken = way * (np.clip((depth - s) / rise, 0.0, 1.0) if rise > 0.0 else np.ones(s.shape))
    springs, force = np.zeros((SPRINGS, 2)), np.zeros(2)
    if depth > 0.0:
        now = rings_within(h, float(np.sqrt(depth)))
        inside = now.limits.size
        springs[:inside] = now.reach @ held(now, (state.springs + taken)[:inside])
        force = now.weights @ springs[:inside]
    weights = rings_within(h, float(np.sqrt(deepest))).weights
    slip = taken - (springs - state.springs)
    work = 0.5 * np.sum((springs + state.springs) * slip, axis=1)[: weights.size]
    return State(depth, moved, springs, force, state.work + float(weights @ work))


def steps(state: State, h: float, depth: float, moved: Array, count: int) -> State:
    """Return the contact after a straight way in equal steps; bodies touch and part between two."""
    shares = np.arange(1, count) / count
    depths = state.depth + shares * (depth - state.depth)
    if depth * state.depth < 0.0:
        met = state.depth / (state.depth - depth)
        at = int(np.searchsorted(shares, met))
        shares, depths = np.insert(shares, at, met), np.insert(depths, at, 0.0)
    first = state.moved
    for share, there in zip(shares, depths, strict=True):
        state = step(state, h, float(there), first + share * (moved - first))
    return step(state, h, depth, moved)


def stick_radius(state: State, h: float) -> float:
    """Return the radius within which no ring is at its limit; (p - |tau|)^2 is linear in s."""
    if state.depth <= 0.0:
        return 0.0
    edge = float(np.sqrt(state.depth))
    now = rings_within(h, edge)
    traction = now.slopes @ state.springs[: now.limits.size]
    gap = now.limits - np.hypot(traction[:, 0], traction[:, 1])
    first = int(np.argmin(np.append(gap > LIMIT_TOLERANCE * now.limits, False)))
    if first == now.limits.size:
        return edge
    if first < 2:
        return float(h * max(first - 1, 0))
    one, two = gap[first - 2 : first] ** 2
    inner, outer, beyond = now.squares[first - 2 : first + 1]
    front = outer + two * (outer - inner) / (one - two) if one > two else beyond
    return float(np.sqrt(min(front, beyond)))


def stored(state: State, h: float) -> float:
    """Return the elastic energy, half the integral of q^2."""
    if state.depth <= 0.0:
        return 0.0
    weights = rings_within(h, float(np.sqrt(state.depth))).weights
    return 0.5 * float(weights @ np.sum(state.springs[: weights.size] ** 2, axis=1))


class Taken(NamedTuple):
    """A step in parts and in twice as many."""

    parts: State
    halves: State

    def even(self, before: State) -> bool:
        """Return whether both come to the same."""
        force, work = self.halves.force - self.parts.force, self.halves.work - self.parts.work
        deepest, way = max(before.depth, self.halves.depth), self.halves.moved - before.moved
        most = PARTS_TOLERANCE * limit(deepest)
        return bool(np.hypot(*force) <= most and abs(work) <= most * (deepest + np.hypot(*way)))

    def corrected(self) -> State:
        """Return what parts of no length would come to."""
        one, two = self
        force = cut((2.0 * two.force - one.force)[None], np.array([limit(two.depth)]))[0]
        springs, work = 2.0 * two.springs - one.springs, 2.0 * two.work - one.work
        return two._replace(springs=springs, force=force, work=work)


def taken(state: State, h: float, depth: float, moved: Array, count: int) -> Taken:
    """Take a step in so many parts."""
    return Taken(*(steps(state, h, depth, moved, parts) for parts in (count, 2 * count)))


def move(state: State, h: float, depth: float, moved: Array) -> State:
    """Return the contact after a step to a depth and a displacement."""
    count = 1
    now = taken(state, h, depth, moved, count)
    while not now.even(state) and count < MOST_PARTS:
        count *= 2
        now = Taken(now.halves, steps(state, h, depth, moved, 2 * count))
    return now.corrected()


def push(state: State, h: float, depth: float, wanted: Array) -> State | None:
    """Return the contact after a step to a depth and a force; None if none has been found."""
    from scipy.optimize import root

    most = limit(depth)
    if depth <= 0.0:  # a force lets go
        return move(state, h, depth, state.moved - state.springs[0])
    if np.hypot(*wanted) > (1.0 - FORCE_REACHED) * most:  # springs that turn come to it nowhere
        return None

    def lacks(moved: Array, count: int) -> Array:
        return (taken(state, h, depth, moved, count).corrected().force - wanted) / most

    moved, count = first_guess(state, h, depth, wanted), 1
    while True:
        moved = root(lacks, moved, (count,), "hybr", options={"xtol": FORCE_SEARCHED}).x
        now = taken(state, h, depth, moved, count)
        if now.even(state) or count >= MOST_PARTS:
            break
        count *= 2
    reached = now.corrected()
    return reached if np.hypot(*(reached.force - wanted)) <= FORCE_REACHED * most else None


def first_guess(state: State, h: float, depth: float, wanted: Array) -> Array:
    """Return the displacement to a force by springs that stick: in slip the force tells no way."""
    there, edge = taken(state, h, depth, state.moved, 1).corrected(), np.sqrt(depth)
    inside = (np.arange(SPRINGS) * h) ** 2 < min(depth, state.depth)
    slip = (there.springs - state.springs)[inside]
    back = slip[np.argmin(np.hypot(slip[:, 0], slip[:, 1]))] if inside.any() else np.zeros(2)
    there = taken(state, h, depth, state.moved + back, 1).corrected()
    return np.asarray(there.moved + (wanted - there.force) / edge)


def follow_turning(
    depths: Array, targets: Array, by_force: NDArray[np.bool_], advance: Advance
) -> tuple[Array, int]:
    """Follow a path by springs; return a row of results for each step, and the step refused."""
    results = np.full((depths.size, RESULTS), np.nan)
    h = float(np.sqrt(max(depths.max(), 0.0))) / SPRINGS
    state = apart(0.0, np.zeros(2), 0.0)
    for n, (depth, target, forced) in enumerate(zip(depths, targets, by_force, strict=True)):
        if forced and np.hypot(*target) > limit(depth) * (1.0 + FORCE_ROUNDING):
            return results, n
        there = (push if forced else move)(state, h, float(depth), target)
        if there is None:
            return results, n
        state = there
        results[n, :STICK] = *state.moved, *state.force
        results[n, STICK:] = stick_radius(state, h), stored(state, h), state.work
        advance(1)
    return results, INSIDE


def direction_of(targets: Array) -> Array | None:
    """Return the direction of a path on one line, None if it turns."""
    size = np.hypot(targets[:, 0], targets[:, 1])
    along = targets[np.argmax(size)] / max(float(size.max()), np.finfo(np.float64).tiny)
    aside = targets[:, 1] * along[0] - targets[:, 0] * along[1]
    return along if np.all(np.abs(aside) <= FORCE_ROUNDING * size) else None


def follow_path(
    depths: Array, targets: Array, by_force: NDArray[np.bool_], advance: Advance
) -> tuple[Array, int]:
    """Follow a path to depths d and wanted (U_x, U_y) or, where `by_force`, (Q_x, Q_y).

    Targets have the shape (n, 2); `advance` is called after each step that turns. Returns a row of
    results for each step, and the step refused, or INSIDE.
    """
    along = direction_of(targets)
    if along is None:
        return follow_turning(depths, targets, by_force, advance)
    path = paths.follow_path(depths, targets @ along, by_force)
    results = np.empty((depths.size, RESULTS))
    results[:, U_X : U_Y + 1] = np.outer(path.results[:, paths.DISPLACEMENT], along)
    results[:, Q_X : Q_Y + 1] = np.outer(path.results[:, paths.TRACTION], along)
    results[:, STICK:] = path.results[:, paths.STICK :]
    return results, path.refused
