"""Small steps of springs in two directions: they follow the bodies, friction holds them."""

from typing import NamedTuple

import numpy as np

from carom.dimensionless.load_paths.memory import cubes
from carom.dimensionless.load_paths.rings import SPRINGS, held, rings_within
from carom.dimensionless.numerics.arrays import Array
from carom.dimensionless.numerics.kernels import plain

HELD = 1e-7  # of the limit: a ring as near has reached it

limit_at = plain(cubes)


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
    first = int(np.argmin(np.append(gap > HELD * now.limits, False)))
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
