"""Labels with leader lines: which of many places each takes, so that none is in another's way."""

from itertools import combinations, pairwise

import numpy as np
from numpy.typing import NDArray

from carom.plots.placing import APART, Spot
from carom.quantities.arrays import Array

TRIALS, LABELS = 12, 20  # of which the best stays, for so many labels; fewer for more of them
SWEEPS, LAST = 100, 5  # times that every label may move, and the last of them without chance
CHANCE = 15.0  # in mm, by which lines may be longer than the shortest at first
IN_THE_WAY = 80.0  # cost of two labels or lines that meet, in mm


def arranged(anchors: list[Array], spots: list[list[Spot]]) -> list[Spot | None]:
    """Return a spot for each label, so that labels and lines keep clear of each other.

    The lines are short on the whole, by simulated annealing; what finds no room has no spot.
    """
    ends = np.cumsum([0, *(len(choice) for choice in spots)])
    own = [slice(start, end) for start, end in pairwise(ends)]
    costs = np.array([spot.cost for choice in spots for spot in choice])
    meet = np.zeros((costs.size, costs.size), dtype=np.bool_)
    for i, j in combinations([i for i, choice in enumerate(spots) if choice], 2):
        meet[own[i], own[j]] = ~_clear(anchors[i], spots[i], anchors[j], spots[j])
        meet[own[j], own[i]] = meet[own[i], own[j]].T
    rng = np.random.default_rng(0)
    free = [part for part in own if part.stop > part.start]
    trials = [
        _annealed(rng, free, costs, meet) for _ in range(TRIALS * LABELS // max(LABELS, len(free)))
    ]
    best = min(trials, key=lambda kept: (-len(kept), costs[kept].sum()))
    every = [spot for choice in spots for spot in choice]
    taken = {int(np.searchsorted(ends, k, side="right")) - 1: every[k] for k in best}
    return [taken.get(i) for i in range(len(spots))]


def _annealed(
    rng: np.random.Generator, own: list[slice], costs: Array, meet: NDArray[np.bool_]
) -> list[int]:
    """Return the spots of most labels, of which no two meet."""
    chosen = [part.start + int(costs[part].argmin()) for part in own]
    hits = meet[chosen].sum(axis=0)
    for sweep in range(SWEEPS):
        chance = CHANCE * max(0.0, 1.0 - sweep / (SWEEPS - LAST))
        for i in rng.permutation(len(own)).tolist():
            hits = hits - meet[chosen[i]]
            cost = costs[own[i]] + IN_THE_WAY * hits[own[i]]
            cost = cost - chance * rng.gumbel(size=cost.size)
            chosen[i] = own[i].start + int(cost.argmin())
            hits = hits + meet[chosen[i]]
    while chosen:
        often = meet[np.ix_(chosen, chosen)].sum(axis=0)
        if not often.any():
            break
        chosen.pop(int(often.argmax()))
    return chosen


def _clear(start: Array, spots: list[Spot], other: Array, others: list[Spot]) -> NDArray[np.bool_]:
    """Tell which spots of two labels keep clear of each other, shape (spots, others)."""
    (low, high, end), (below, above, stop) = _boxes(spots), _boxes(others)
    apart = np.any((low[:, None] > above[None]) | (high[:, None] < below[None]), axis=-1)
    met = _cross(start, end[:, None], other, stop[None])
    met |= _enters(start, end[:, None], below[None], above[None])
    met |= _enters(other, stop[None], low[:, None], high[:, None])
    return np.asarray(apart & ~met)


def _boxes(spots: list[Spot]) -> tuple[Array, Array, Array]:
    """Return the corners of labels, with half of what is to be between them, and ends of lines."""
    if not spots:
        return (np.empty((0, 2)),) * 3
    at, end = (np.array([spot[k] for spot in spots]) for k in (2, 3))
    half = 0.5 * (np.array([spot.block.size for spot in spots]) + APART)
    return at - half, at + half, end


def _cross(a: Array, b: Array, c: Array, d: Array) -> NDArray[np.bool_]:
    """Tell whether lines from a to b and from c to d cross."""
    sides = _side(a, b, c) * _side(a, b, d) < 0.0
    return np.asarray(sides & (_side(c, d, a) * _side(c, d, b) < 0.0))


def _side(a: Array, b: Array, point: Array) -> Array:
    (x, y), (u, v) = (np.moveaxis(np.asarray(p - a), -1, 0) for p in (b, point))
    return np.asarray(x * v - y * u)


def _enters(a: Array, b: Array, low: Array, high: Array) -> NDArray[np.bool_]:
    """Tell whether lines from a to b enter boxes."""
    starts, ends = np.zeros(1), np.ones(1)
    with np.errstate(divide="ignore", invalid="ignore"):
        for k in (0, 1):
            slope = 1.0 / (b[..., k] - a[..., k])
            first, second = (low[..., k] - a[..., k]) * slope, (high[..., k] - a[..., k]) * slope
            starts = np.fmax(starts, np.fmin(first, second))
            ends = np.fmin(ends, np.fmax(first, second))
    return np.asarray(starts < ends)
