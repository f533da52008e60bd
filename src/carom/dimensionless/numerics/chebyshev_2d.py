"""Functions of two variables as Chebyshev series on rectangles, found adaptively."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np

from carom.dimensionless.numerics.arrays import Array, CountTable, Cube, Matrix
from carom.dimensionless.numerics.chebyshev import evaluate, nodes, transform
from carom.dimensionless.numerics.kernels import kernel

Rectangle = tuple[float, float, float, float]  # x from, to, y from, to

TERMS = 9  # along either side
TAIL = 2  # terms whose size tells the error of a series
GRADING = 0.15  # of a side that begins at a singular line
DEEPEST = 60  # levels of the tree


class Patches(NamedTuple):
    """A function on a rectangle: a tree whose inner nodes cut one side, whose leaves hold a series.

    `cuts` has rows of (axis, value), axis 0 for x, 1 for y, -1 for a leaf; `children` the two nodes
    below; `corners` x from, to, y from, to; `series` the coefficients of T_i(x) T_j(y).
    """

    cuts: Matrix  # (n, 2)
    children: CountTable  # (n, 2)
    corners: Matrix  # (n, 4)
    series: Cube  # (n, TERMS, TERMS)


@kernel
def value_at(patches: Patches, x: float, y: float) -> float:
    """Return the value of the function at (x, y)."""
    node = 0
    for _ in range(DEEPEST):
        axis = patches.cuts[node, 0]
        if axis < 0.0:
            break
        beyond = (x if axis == 0.0 else y) >= patches.cuts[node, 1]
        node = patches.children[node, 1 if beyond else 0]
    corner, series = patches.corners[node], patches.series[node]
    place = (2.0 * x - corner[0] - corner[1]) / (corner[1] - corner[0])
    last, one = 0.0, 0.0
    for i in range(TERMS - 1, 0, -1):
        coefficient = evaluate(series[i], corner[2], corner[3], y)
        last, one = one, coefficient + 2.0 * place * one - last
    return float(evaluate(series[0], corner[2], corner[3], y) + place * one - last)


def fitted_patches(
    function: Callable[[Array, Array], Array],
    whole: Rectangle,
    cuts: Sequence[float],
    tolerance: float,
    singular: float,
) -> Patches:
    """Return a function of (x, y) on a rectangle, cut first at some x, then wherever it takes it.

    A patch is cut across the side along which its series ends worse, in the middle, or close to its
    lower end if that is the `singular` x.
    """
    tree = _Tree(function)
    leaves = tree.grow([whole])
    for x in cuts:
        leaves = leaves[:-1] + tree.cut([(leaves[-1], 0, x)])
    for _ in range(DEEPEST - len(cuts)):
        waiting = [
            (leaf, *_better_cut(tree.corners[leaf], tree.series[leaf], singular))
            for leaf in leaves
            if max(_errors(tree.series[leaf])) > tolerance
        ]
        if not waiting:
            break
        leaves = tree.cut(waiting)
    return tree.patches()


class _Tree:
    """A tree of patches that is still growing."""

    def __init__(self, function: Callable[[Array, Array], Array]) -> None:
        self.function = function
        self.cuts: list[tuple[float, float]] = []
        self.children: list[tuple[int, int]] = []
        self.corners: list[Rectangle] = []
        self.series: list[Array] = []

    def grow(self, rectangles: Sequence[Rectangle]) -> list[int]:
        """Add leaves, and return their places."""
        first = len(self.corners)
        self.corners += rectangles
        self.series += list(_series(self.function, np.array(rectangles)))
        self.cuts += [(-1.0, 0.0)] * len(rectangles)
        self.children += [(0, 0)] * len(rectangles)
        return list(range(first, len(self.corners)))

    def cut(self, waiting: Sequence[tuple[int, int, float]]) -> list[int]:
        """Make inner nodes of leaves, each cut along an axis at a value; return the new leaves."""
        cut = [_halves(self.corners[leaf], axis, value) for leaf, axis, value in waiting]
        halves = [half for both in cut for half in both]
        leaves = self.grow(halves)
        for (leaf, axis, value), low in zip(waiting, leaves[::2], strict=True):
            self.cuts[leaf], self.children[leaf] = (float(axis), value), (low, low + 1)
        return leaves

    def patches(self) -> Patches:
        """Return the tree as arrays."""
        parts = self.cuts, self.children, self.corners, self.series
        cuts, children, corners, series = (np.array(part) for part in parts)
        return Patches(cuts, children, corners, series)


def _better_cut(corner: Rectangle, series: Array, singular: float) -> tuple[int, float]:
    """Return the axis to cut, and where."""
    along_x, along_y = _errors(series)
    axis = int(along_y > along_x)
    low, high = corner[2 * axis : 2 * axis + 2]
    return axis, low + (GRADING if axis == 0 and low == singular else 0.5) * (high - low)


def _halves(corner: Rectangle, axis: int, value: float) -> tuple[Rectangle, Rectangle]:
    a, b, c, d = corner
    if axis == 0:
        return (a, value, c, d), (value, b, c, d)
    return (a, b, c, value), (a, b, value, d)


def _series(function: Callable[[Array, Array], Array], corners: Array) -> Array:
    """Return the Chebyshev coefficients on every rectangle."""
    a, b, c, d = corners.T[:, :, np.newaxis]
    x = 0.5 * (a + b) + 0.5 * (b - a) * nodes(TERMS)
    y = 0.5 * (c + d) + 0.5 * (d - c) * nodes(TERMS)
    shape = len(corners), TERMS, TERMS
    grid = (np.broadcast_to(each, shape).ravel() for each in (x[:, :, None], y[:, None, :]))
    values = function(*grid).reshape(shape)
    return np.asarray(transform(TERMS) @ values @ transform(TERMS).T)


def _errors(series: Array) -> tuple[float, float]:
    """Return the size of the last terms along x and along y."""
    return float(np.max(np.abs(series[-TAIL:]))), float(np.max(np.abs(series[:, -TAIL:])))
