"""Chebyshev series: their values, and their coefficients from values at nodes."""

from functools import cache

import numpy as np

from carom.dimensionless.numerics.arrays import Array, Vector
from carom.dimensionless.numerics.kernels import entry_point


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
