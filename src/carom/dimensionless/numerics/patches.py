"""Functions of some variables as Chebyshev series on boxes, found adaptively."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.dimensionless.numerics.arrays import Array, Counts, CountTable, Cube, Matrix, Vector
from carom.dimensionless.numerics.chebyshev import extrema, from_extrema
from carom.dimensionless.numerics.kernels import kernel

GRADING = 0.15  # of a side that begins at a singular place
NARROWEST = 1e-12  # of the whole: no side is cut further
BISECTIONS = 34  # that find a kink
DEEPEST = 100  # levels of the tree
TAIL, TAIL_OF_ONE = 2, 3  # last terms, whose size tells the error of a series; in one variable


class Samples(NamedTuple):
    """A function at points: its value, what an error in it weighs, and on which branch it is."""

    values: Array
    weights: Array
    branches: NDArray[np.int64]


class Patches(NamedTuple):
    """A function on a box: a tree whose inner nodes cut one side, whose leaves hold a series."""

    axes: Counts  # (nodes,): the side that is cut, -1 of a leaf
    cuts: Vector  # (nodes,): where
    children: CountTable  # (nodes, 2): the nodes below; of a leaf its number, twice
    corners: Cube  # (leaves, variables, 2)
    terms: Counts  # (variables,): of a series along each side
    series: Matrix  # (leaves, all terms): of T_i(x) T_j(y) ..., those of the last variable together


@kernel
def leaf_at(patches: Patches, point: Vector) -> int:
    """Return the number of the leaf that holds a point."""
    node = 0
    for _ in range(DEEPEST):
        axis = patches.axes[node]
        if axis < 0:
            break
        node = patches.children[node, 1 if point[axis] >= patches.cuts[node] else 0]
    return int(patches.children[node, 0])


@kernel
def contract(patches: Patches, leaf: int, point: Vector, work: Vector) -> None:
    """Write the series of a leaf in its last variable, at given values of the others."""
    size = patches.series.shape[1]
    for i in range(size):
        work[i] = patches.series[leaf, i]
    for axis in range(patches.terms.size - 1):
        low, high = patches.corners[leaf, axis, 0], patches.corners[leaf, axis, 1]
        place = (2.0 * point[axis] - low - high) / (high - low)
        size //= patches.terms[axis]
        before, now = 1.0, place
        for term in range(1, patches.terms[axis]):
            for i in range(size):
                work[i] += now * work[term * size + i]
            before, now = now, 2.0 * place * now - before


def sections(patches: Patches, *others: float) -> tuple[Array, Array]:
    """Return the function of the last variable at given values of the others.

    The ends of its panels, shape (n + 1,), and the coefficients on each, shape (n, terms).
    """
    last, ends, rows, waiting = len(others), [], [], [0]
    while waiting:
        node = waiting.pop()
        axis, (low, high) = patches.axes[node], patches.children[node]
        if axis < 0:
            corner, series = patches.corners[low], patches.series[low].reshape(patches.terms)
            for value, (start, end) in zip(others, corner, strict=False):
                place = (2.0 * value - start - end) / (end - start)
                terms = np.polynomial.chebyshev.chebvander(place, len(series) - 1)[0]
                series = np.tensordot(terms, series, 1)
            rows.append(series)
            ends.append(corner[last])
        else:
            beyond = axis < last and others[axis] >= patches.cuts[node]
            waiting += [high] if beyond else [low] if axis < last else [high, low]
    edges = [low for low, _ in ends] + [ends[-1][1]]
    return np.array(edges), np.array(rows)


def fitted(
    function: Callable[..., Samples],
    box: Sequence[tuple[float, float]],
    degrees: Sequence[int],
    tolerance: float,
    *,
    cuts: Sequence[tuple[int, Sequence[float]]] = (),
    singular: float | None = None,
    narrowest: float = NARROWEST,
) -> Patches:
    """Return a function of some variables on a box, cut first at some places, then where needed.

    The last terms of a series, times the weight of an error, tell the error of it. Where it is too
    large, a box is cut across the side along which its series ends worst, in the middle, or close
    to its lower end if that is the `singular` value of the last variable. A function of one
    variable is cut where its branch changes, and looked at between the outer nodes, where a weak
    kink could hide.
    """
    tree = _Tree(np.array(box, dtype=np.float64), degrees)
    waiting = [0]
    for axis, values in cuts:
        waiting = [leaf for old in waiting for leaf in tree.cut(old, axis, values)]
    width, last = np.diff(tree.boxes[0])[:, 0], len(box) - 1
    function = _remembering(function) if last == 0 else function
    while waiting:
        points = tree.points(waiting)
        samples = function(*points)
        series = tree.series(samples.values)
        weights = samples.weights.reshape(points.shape[1:]).max(axis=1)
        errors = weights * np.array([_tail(series, axis) for axis in range(last + 1)])
        kinks: list[list[float]] = [[] for _ in waiting]
        if last == 0:
            _look_between(function, tree, waiting, series, errors[0], tolerance)
            kinks = _kinks(function, points[0], samples, errors[0] > tolerance)
        later = []
        for leaf, row, error, inside in zip(waiting, series, errors.T, kinks, strict=True):
            low, high = tree.boxes[leaf].T
            error = np.where(high - low > narrowest * width, error, 0.0)
            if error.max() <= tolerance:
                tree.leaves[leaf] = row.ravel()
                continue
            axis = int(error.argmax())
            near = GRADING if axis == last and low[axis] == singular else 0.5
            middle = low[axis] + near * (high[axis] - low[axis])
            later += tree.cut(leaf, axis, inside or [middle])
        waiting = later
    return tree.patches()


def _remembering(function: Callable[..., Samples]) -> Callable[..., Samples]:
    """Return a function of one variable that is asked once for the ends that panels share."""
    known: dict[float, tuple[float, float, int]] = {}

    def recall(x: Array) -> Samples:
        asked = x.ravel().tolist()
        new = [each for each in dict.fromkeys(asked) if each not in known]
        if new:
            answers = (part.tolist() for part in function(np.array(new)))
            known.update(zip(new, zip(*answers, strict=True), strict=True))
        return Samples(*map(np.array, zip(*(known[each] for each in asked), strict=True)))

    return recall


class _Tree:
    """A tree of patches that is still growing."""

    def __init__(self, box: Array, degrees: Sequence[int]) -> None:
        self.degrees = degrees
        self.nodes: list[tuple[int, float, int, int]] = [(-1, 0.0, 0, 0)]
        self.boxes = [box]
        self.leaves: dict[int, Array] = {}

    def cut(self, node: int, axis: int, values: Sequence[float]) -> list[int]:
        """Cut a leaf across a side at rising values; return the new leaves."""
        leaves = []
        for value in values:
            first = len(self.nodes)
            low, high = self.boxes[node].copy(), self.boxes[node].copy()
            low[axis, 1] = high[axis, 0] = value
            self.boxes += [low, high]
            self.nodes[node] = axis, value, first, first + 1
            self.nodes += [(-1, 0.0, 0, 0)] * 2
            leaves.append(first)
            node = first + 1
        return [*leaves, node]

    def points(self, leaves: Sequence[int]) -> Array:
        """Return the nodes of the series of some leaves, of shape (variables, leaves, points)."""
        low, high = np.moveaxis(np.array([self.boxes[leaf] for leaf in leaves]), -1, 0)[..., None]
        grids = np.meshgrid(*map(extrema, self.degrees), indexing="ij")
        unit = np.array([grid.ravel() for grid in grids])
        points = 0.5 * (low + high) + 0.5 * (high - low) * unit
        if len(self.degrees) == 1:  # to the bit, as panels share them
            points[..., :1], points[..., -1:] = low, high
        return np.ascontiguousarray(np.moveaxis(np.clip(points, low, high), 1, 0))

    def series(self, values: Array) -> Array:
        """Return the coefficients of leaves from their values at the nodes."""
        rows = values.reshape(-1, *(degree + 1 for degree in self.degrees))
        for axis, degree in enumerate(self.degrees, start=1):
            product = np.tensordot(from_extrema(degree), rows, (1, axis))
            rows = np.moveaxis(product, 0, axis)
        return np.asarray(rows)

    def patches(self) -> Patches:
        """Return the tree as arrays."""
        axes, cuts, *children = map(np.array, zip(*self.nodes, strict=True))
        leaves = np.flatnonzero(axes < 0)
        below = np.stack(children, axis=-1)
        below[leaves] = np.arange(leaves.size)[:, np.newaxis]
        corners = np.array([self.boxes[leaf] for leaf in leaves])
        series = np.array([self.leaves[leaf] for leaf in leaves.tolist()])
        return Patches(axes, cuts, below, corners, np.array(self.degrees) + 1, series)


def _tail(series: Array, axis: int) -> Array:
    """Return the size of the last terms of every leaf along a side."""
    tail = TAIL_OF_ONE if series.ndim == 2 else TAIL
    last = np.abs(np.moveaxis(series, axis + 1, 1)[:, -tail:])
    return np.asarray(last.reshape(len(series), -1).max(axis=1))


def _look_between(
    function: Callable[..., Samples],
    tree: _Tree,
    leaves: Sequence[int],
    series: Array,
    errors: Array,
    tolerance: float,
) -> None:
    """Raise errors that seem small to those between the outer nodes, of leaves of one variable."""
    seem, degree = np.flatnonzero(errors <= tolerance), tree.degrees[0]
    if not seem.size:
        return
    angles = np.pi * np.array([0.5, degree - 0.5]) / degree
    low, high = np.array([tree.boxes[leaf][0] for leaf in leaves])[seem].T[..., np.newaxis]
    between = 0.5 * (low + high) - 0.5 * (high - low) * np.cos(angles)
    values, weights, _ = (each.reshape(between.shape) for each in function(between))
    wanted = series[seem] @ np.polynomial.chebyshev.chebvander(-np.cos(angles), degree).T
    off = np.max(weights * np.abs(wanted - values), axis=1)
    errors[seem] = np.maximum(errors[seem], off)


def _kinks(
    function: Callable[..., Samples], points: Array, samples: Samples, wanted: NDArray[np.bool_]
) -> list[list[float]]:
    """Return where each leaf that is wanted changes its branch, by bisection."""
    branches = samples.branches.reshape(points.shape)
    changes = branches[:, 1:-2] != branches[:, 2:-1]  # an end may belong to either side
    rows, place = np.nonzero(changes & wanted[:, np.newaxis])
    low, high = points[rows, place + 1], points[rows, place + 2]
    lower = branches[rows, place + 1]
    for _ in range(BISECTIONS if rows.size else 0):
        middle = 0.5 * (low + high)
        below = function(middle).branches == lower
        low, high = np.where(below, middle, low), np.where(below, high, middle)
    kinks: list[list[float]] = [[] for _ in points]
    for row, kink in zip(rows, 0.5 * (low + high), strict=True):
        kinks[row].append(float(kink))
    return kinks
