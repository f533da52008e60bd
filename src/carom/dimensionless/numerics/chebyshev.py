"""Functions as Chebyshev series on panels: values, coefficients, and panels found adaptively."""

from collections.abc import Callable, Sequence
from functools import cache
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.dimensionless.numerics.arrays import Array, Vector
from carom.dimensionless.numerics.kernels import entry_point

Branched = Callable[[Array], tuple[Array, NDArray[np.int64]]]  # values, and on which branch each is

GRADING = 0.15  # of a panel, beside a border at which the function may be singular
NARROWEST = 1e-12  # of its place: no panel is split further
BISECTIONS = 34  # that find a kink
TAIL = 3  # coefficients whose size tells the error of a series


class Panels(NamedTuple):
    """A piecewise series: `edges`, shape (n + 1,), and `coefficients`, shape (n, terms).

    A row holds the Chebyshev coefficients on a panel mapped to [-1, 1].
    """

    edges: Array
    coefficients: Array


@entry_point()
def evaluate(coefficients: Vector, low: float, high: float, x: float) -> float:
    """Return the value at x of a Chebyshev series on [low, high] (Clenshaw 1955)."""
    y = (2.0 * x - low - high) / (high - low)
    last, one = 0.0, 0.0
    for k in range(coefficients.size - 1, 0, -1):
        last, one = one, coefficients[k] + 2.0 * y * one - last
    return float(coefficients[0] + y * one - last)


@cache
def nodes(terms: int) -> Array:
    """Return the roots of T_n in [-1, 1], at which `transform` wants its values."""
    return np.asarray(np.cos(_angles(terms)), dtype=np.float64)


@cache
def transform(terms: int) -> Array:
    """Return the matrix that makes Chebyshev coefficients of values at `nodes`."""
    matrix = np.cos(np.outer(np.arange(terms), _angles(terms))) * (2.0 / terms)
    matrix[0] *= 0.5
    return np.asarray(matrix, dtype=np.float64)


def _angles(terms: int) -> Array:
    return (np.arange(terms) + 0.5) * np.pi / terms


@cache
def extrema(degree: int) -> Array:
    """Return the extrema of T_n in [-1, 1], ends included, at which `from_extrema` wants values."""
    return np.asarray(-np.cos(np.arange(degree + 1) * np.pi / degree), dtype=np.float64)


@cache
def from_extrema(degree: int) -> Array:
    """Return the matrix that makes Chebyshev coefficients of values at `extrema`."""
    return np.asarray(np.linalg.inv(np.polynomial.chebyshev.chebvander(extrema(degree), degree)))


def fitted(
    function: Branched,
    borders: Sequence[float],
    degree: int,
    tolerance: float,
    singular: Sequence[float] = (),
    narrowest: float = NARROWEST,
) -> Panels:
    """Return f as series on panels between borders, split until the error of x f(x) is tolerable.

    `function` gives values and the number of the branch of f on which each lies: panels are cut
    where the branch changes. The last terms of a series tell its error, and a look between the
    outer nodes, where a weak kink could hide. Where it is too large, a panel is halved, or cut
    close to its lower end if that is `singular`; none is halved that is narrower than `narrowest`
    times its upper end.
    """
    recall = _remembering(function)
    waiting = list(pairwise(borders))
    done: list[tuple[float, float, Array]] = []
    while waiting:
        points = _points(waiting, degree)
        line, branch = recall(points.ravel())
        values, branches = line.reshape(points.shape), branch.reshape(points.shape)
        rows = values @ from_extrema(degree).T
        errors = points[:, -1] * np.max(np.abs(rows[:, -TAIL:]), axis=1)
        _look_between(function, points, rows, errors, tolerance)
        kinks = _kinks(function, points, branches, errors > tolerance)
        judged = list(zip(waiting, rows, errors, kinks, strict=True))
        waiting = []
        for (low, high), row, error, inside in judged:
            if error <= tolerance or high - low <= narrowest * high:
                done.append((low, high, row))
                continue
            near = GRADING if low in singular else 0.5
            cuts = inside or [low + near * (high - low)]
            waiting += pairwise([low, *cuts, high])
    done.sort(key=lambda panel: panel[0])
    edges = [panel[0] for panel in done] + [borders[-1]]
    return Panels(np.array(edges), np.array([row for _, _, row in done]))


def _remembering(function: Branched) -> Branched:
    """Return the function, asked once for each point: panels share their ends and middles."""
    answered: dict[float, tuple[float, int]] = {}

    def recall(x: Array) -> tuple[Array, NDArray[np.int64]]:
        asked = x.tolist()
        new = [each for each in dict.fromkeys(asked) if each not in answered]
        if new:
            answers = (part.tolist() for part in function(np.array(new)))
            answered.update(zip(new, zip(*answers, strict=True), strict=True))
        values, branches = zip(*(answered[each] for each in asked), strict=True)
        return np.array(values), np.array(branches)

    return recall


def _points(panels: Sequence[tuple[float, float]], degree: int) -> Array:
    """Return the extrema of every panel, the ends as they stand."""
    low, high = np.array(panels).T[:, :, np.newaxis]
    points = 0.5 * (low + high) + 0.5 * (high - low) * extrema(degree)
    points[:, :1], points[:, -1:] = low, high
    return np.asarray(points, dtype=np.float64)


def _look_between(
    function: Branched, points: Array, rows: Array, errors: Array, tolerance: float
) -> None:
    """Raise errors that seem small to those found between the two nodes at either end."""
    seem = np.flatnonzero(errors <= tolerance)
    if not seem.size:
        return
    degree = rows.shape[1] - 1
    angles = np.pi * np.array([0.5, degree - 0.5]) / degree
    low, high = points[seem, :1], points[seem, -1:]
    between = 0.5 * (low + high) - 0.5 * (high - low) * np.cos(angles)
    values = function(between.ravel())[0].reshape(between.shape)
    series = rows[seem] @ np.polynomial.chebyshev.chebvander(-np.cos(angles), degree).T
    between_nodes = np.max(np.abs(between * (series - values)), axis=1)
    errors[seem] = np.maximum(errors[seem], between_nodes)


def _kinks(
    function: Branched, points: Array, branches: NDArray[np.int64], wanted: NDArray[np.bool_]
) -> list[list[float]]:
    """Return where each panel that is wanted changes its branch, by bisection."""
    changes = branches[:, 1:-2] != branches[:, 2:-1]  # an end may belong to either side
    rows, place = np.nonzero(changes & wanted[:, np.newaxis])
    low, high = points[rows, place + 1], points[rows, place + 2]
    lower = branches[rows, place + 1]
    for _ in range(BISECTIONS if rows.size else 0):
        middle = 0.5 * (low + high)
        below = function(middle)[1] == lower
        low, high = np.where(below, middle, low), np.where(below, high, middle)
    kinks: list[list[float]] = [[] for _ in points]
    for row, kink in zip(rows, 0.5 * (low + high), strict=True):
        kinks[row].append(float(kink))
    return kinks
