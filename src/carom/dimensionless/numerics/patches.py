"""Functions of some variables as Chebyshev series on boxes, found adaptively."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np
from numpy.polynomial.chebyshev import chebvander
from numpy.typing import NDArray

from carom.dimensionless.numerics.arrays import Array, Counts, CountTable, Cube, Matrix, Vector
from carom.dimensionless.numerics.chebyshev import extrema, from_extrema
from carom.dimensionless.numerics.kernels import kernel

GRADING = 0.15  # of a side that begins at a singular place
NARROWEST = 1e-12  # of its upper end: no side is cut further
BISECTIONS = 34  # that find a kink
DEEPEST = 100  # levels of the tree
LEAF = -1, 0.0, 0, 0  # a node: axis, cut, children
TAIL, TAIL_OF_ONE = 2, 3  # last terms, whose size tells the error of a series; in one variable


class Samples(NamedTuple):
    """A function at points: its value, what an error in it weighs, and on which branch it is."""

    values: Array
    weights: Array
    branches: NDArray[np.int64]


Function = Callable[..., Samples]


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
    """Write the series of a leaf in its last variable, at given values of one or more others."""
    size = patches.series.shape[1]
    for axis in range(patches.terms.size - 1):
        low, high = patches.corners[leaf, axis, 0], patches.corners[leaf, axis, 1]
        place = (2.0 * point[axis] - low - high) / (high - low)
        size //= patches.terms[axis]
        if axis == 0:
            add_terms(patches.series[leaf], place, size, patches.terms[axis], work)
        else:
            add_terms(work, place, size, patches.terms[axis], work)


@kernel
def add_terms(series: Vector, place: float, size: int, terms: int, out: Vector) -> None:
    """Write the sum of rows of so many numbers, each with its Chebyshev polynomial."""
    for i in range(size):
        out[i] = series[i]
    before, now = 1.0, place
    for term in range(1, terms):
        for i in range(size):
            out[i] += now * series[term * size + i]
        before, now = now, 2.0 * place * now - before


def sections(patches: Patches, *others: float) -> tuple[Array, Array]:
    """Return panels (n + 1,) and series (n, terms) in the last variable at values of the others."""
    low, high = patches.corners[..., 0], patches.corners[..., 1]
    sides, point = high[:, :-1], np.array(others)
    beyond = (sides > point) | (sides == sides.max(axis=0))
    leaves = np.flatnonzero(np.all((low[:, :-1] <= point) & beyond, axis=1))
    leaves = leaves[np.argsort(low[leaves, -1])]
    rows = patches.series[leaves].reshape(leaves.size, *patches.terms)
    for axis, value in enumerate(others):
        a, b = low[leaves, axis], high[leaves, axis]
        terms = chebvander((2.0 * value - a - b) / (b - a), rows.shape[1] - 1)
        rows = np.einsum("ni,ni...->n...", terms, rows)
    return np.append(low[leaves, -1], high[leaves[-1], -1]), rows


class _Tree:
    """A tree of boxes that is still growing."""

    def __init__(self, box: Sequence[tuple[float, float]]) -> None:
        self.boxes = [np.array(box, dtype=np.float64)]
        self.nodes = [LEAF]

    def cut(self, node: int, axis: int, places: Sequence[float]) -> list[int]:
        """Cut a leaf across an axis at some places; return the leaves that it falls into."""
        leaves = []
        for place in places:
            low, high = self.boxes[node].copy(), self.boxes[node].copy()
            low[axis, 1] = high[axis, 0] = place
            first = len(self.nodes)
            self.nodes[node] = axis, place, first, first + 1
            self.nodes += [LEAF, LEAF]
            self.boxes += [low, high]
            leaves.append(first)
            node = first + 1
        return [*leaves, node]

    def patches(self, series: dict[int, Array], terms: Sequence[int]) -> Patches:
        """Return the tree as arrays, with the series of its leaves."""
        for number, leaf in enumerate(series):
            self.nodes[leaf] = -1, 0.0, number, number
        axes, cuts, *below = map(np.array, zip(*self.nodes, strict=True))
        corners = np.array([self.boxes[leaf] for leaf in series])
        rows = np.array(list(series.values()))
        return Patches(axes, cuts, np.stack(below, axis=-1), corners, np.array(terms), rows)


def fitted(
    function: Function,
    box: Sequence[tuple[float, float]],
    degrees: Sequence[int],
    tolerance: float,
    *,
    cuts: Sequence[tuple[int, Sequence[float]]] = (),
    singular: float | None = None,
    narrowest: float = NARROWEST,
) -> Patches:
    """Return a function of some variables on a box, cut first at some places, then where needed.

    The last terms of a series, times the `weight` of an error, tell its error. A box is cut across
    the side along which its series ends worst, in the middle, or close to its lower end if that is
    the `singular` value of the last variable. A function of one variable is cut where its branch
    changes, and looked at between the outer nodes, where a weak kink could hide.
    """
    tree, last = _Tree(box), len(box) - 1
    asked = function if last else _remembering(function)
    unit = np.stack([grid.ravel() for grid in np.meshgrid(*map(extrema, degrees), indexing="ij")])
    to_series: Array = np.ones((1, 1))
    for degree in degrees:
        to_series = np.asarray(np.kron(to_series, from_extrema(degree).T))
    terms = [degree + 1 for degree in degrees]
    series: dict[int, Array] = {}
    waiting = [0]
    for axis, places in cuts:
        waiting = [leaf for old in waiting for leaf in tree.cut(old, axis, places)]
    while waiting:
        boxes = np.array([tree.boxes[leaf] for leaf in waiting])
        low, high = boxes[..., :1], boxes[..., 1:]
        points = 0.5 * (low + high) + 0.5 * (high - low) * unit
        points = np.where(unit == -1.0, low, np.where(unit == 1.0, high, points))  # shared ends
        samples = Samples._make(
            each.reshape(len(waiting), -1) for each in asked(*np.moveaxis(points, 1, 0))
        )
        rows = samples.values @ to_series
        weight = samples.weights.max(axis=1, keepdims=True)
        errors = weight * _tails(rows.reshape(-1, *terms))
        kinks: list[list[float]] = [[] for _ in waiting]
        if last == 0:
            _look_between(function, boxes[:, 0], rows, errors[:, 0], tolerance)
            kinks = _kinks(function, points[:, 0], samples.branches, errors[:, 0] > tolerance)
        errors[(high - low)[..., 0] <= narrowest * np.abs(boxes[..., 1])] = 0.0
        done, later = errors.max(axis=1) <= tolerance, []
        for i, leaf in enumerate(waiting):
            if done[i]:
                series[leaf] = rows[i]
                continue
            axis = int(errors[i].argmax())
            start, end = boxes[i, axis]
            near = GRADING if axis == last and start == singular else 0.5
            later += tree.cut(leaf, axis, kinks[i] or [start + near * (end - start)])
        waiting = later
    return tree.patches(series, terms)


def _remembering(function: Function) -> Function:
    """Return a function of one variable that is asked once for the ends that panels share."""
    answers: dict[float, tuple[float, float, int]] = {}

    def recall(x: Array) -> Samples:
        asked = x.ravel().tolist()
        new = [each for each in dict.fromkeys(asked) if each not in answers]
        if new:
            parts = (part.tolist() for part in function(np.array(new)))
            answers.update(zip(new, zip(*parts, strict=True), strict=True))
        return Samples(*map(np.array, zip(*(answers[each] for each in asked), strict=True)))

    return recall


def _tails(series: Array) -> Array:
    """Return the size of the last terms of every series along each side."""
    tail, sides = TAIL_OF_ONE if series.ndim == 2 else TAIL, range(1, series.ndim)
    ends = [np.abs(np.moveaxis(series, side, 1)[:, -tail:]) for side in sides]
    return np.stack([end.reshape(len(series), -1).max(axis=1) for end in ends], axis=-1)


def _look_between(
    function: Function, panels: Array, rows: Array, errors: Array, tolerance: float
) -> None:
    """Raise errors that seem small to those found between the two nodes at either end."""
    seem, degree = np.flatnonzero(errors <= tolerance), rows.shape[1] - 1
    if seem.size:
        between = -np.cos(np.pi * np.array([0.5, degree - 0.5]) / degree)
        low, high = panels[seem, :1], panels[seem, 1:]
        values, weights, _ = function(0.5 * (low + high) + 0.5 * (high - low) * between)
        off = np.abs((rows[seem] @ chebvander(between, degree).T).ravel() - values)
        off = np.max((weights * off).reshape(-1, 2), axis=1)
        errors[seem] = np.maximum(errors[seem], off)


def _kinks(
    function: Function, points: Array, branches: NDArray[np.int64], wanted: NDArray[np.bool_]
) -> list[list[float]]:
    """Return where each leaf that is wanted changes its branch, by bisection."""
    changes = branches[:, 1:-2] != branches[:, 2:-1]  # an end may belong to either side
    rows, place = np.nonzero(changes & wanted[:, np.newaxis])
    low, high = points[rows, place + 1], points[rows, place + 2]
    for _ in range(BISECTIONS if rows.size else 0):
        middle = 0.5 * (low + high)
        below = function(middle).branches == branches[rows, place + 1]
        low, high = np.where(below, middle, low), np.where(below, high, middle)
    kinks: list[list[float]] = [[] for _ in points]
    for row, kink in zip(rows, 0.5 * (low + high), strict=True):
        kinks[row].append(float(kink))
    return kinks
