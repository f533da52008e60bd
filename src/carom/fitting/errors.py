"""Errors of what is measured: a robust loss, weights, and errors that come from the scatter."""

from dataclasses import dataclass

import numpy as np

from carom.fitting.problem import FitProblem, Mask
from carom.quantities.arrays import Array

NORMAL = np.linspace(-10.0, 10.0, 2001)  # where means over a normal distribution are taken
SURE = 3.09  # standard deviations beyond which errors that were given are called too small
RESOLVED = 1e-4  # of the largest measured value: errors below are those of the curves
OUTLYING = 10.0  # times the median: larger values are outliers
TINY = 1e-2  # of what a response may be: values below are as good as zero


@dataclass(frozen=True)
class RobustLoss:
    """Loss 2 c^2 (sqrt(1 + (r/c)^2) - 1) of a residual r in standard deviations.

    r^2 for small r, 2 c |r| for outliers (Charbonnier et al. 1997; scipy's soft_l1). With c = 2 it
    keeps 97 % of the efficiency where errors are Gaussian; with c infinite it is r^2, maximum
    likelihood for them.
    """

    c: float

    def root(self, residual: Array) -> Array:
        """Return the residual whose square is the loss, of the same sign."""
        square = (residual / self.c) ** 2
        return np.asarray(residual * np.sqrt(2.0 / (1.0 + np.sqrt(1.0 + square))))

    def influence(self, residual: Array) -> Array:
        """Return half the derivative of the loss."""
        return np.asarray(residual / np.sqrt(1.0 + (residual / self.c) ** 2))

    def slope(self, residual: Array) -> Array:
        """Return the derivative of the influence."""
        return np.asarray((1.0 + (residual / self.c) ** 2) ** -1.5)


def gaussian_mean(values: Array) -> float:
    """Return the mean of a function, given at NORMAL, over a standard normal distribution."""
    density = np.exp(-0.5 * NORMAL**2)
    return float((values * density).sum() / density.sum())


@dataclass(frozen=True, eq=False)
class Weights:
    """What makes residuals independent and of unit variance: inverse Cholesky factors by row."""

    factors: Array

    def whitened(self, problem: FitProblem, expected: Array) -> Array:
        """Return the residuals in standard deviations, 0 where nothing was measured."""
        residual = np.where(problem.present, problem.measured - expected, 0.0)
        return np.asarray(np.einsum("rij,brj->bri", self.factors, residual))


def first_errors(problem: FitProblem) -> Array:
    """Return errors to begin with where none are known: a part of the spread of each response."""
    spread = np.nanstd(problem.measured, axis=0)
    return np.asarray(0.1 * spread + least_error(problem))


def usable_errors(problem: FitProblem) -> Array:
    """Return the errors that were given, none smaller than that of the curves."""
    return np.maximum(problem.errors, least_error(problem))


def least_error(problem: FitProblem) -> Array:
    """Return the error of the interpolated curves, by response."""
    sizes = np.abs(problem.measured)
    largest = np.minimum(np.nanmax(sizes, axis=0), OUTLYING * np.nanmedian(sizes, axis=0))
    return np.asarray(RESOLVED * np.maximum(largest, TINY * problem.sizes))


def scatter(residuals: Array, present: Mask, used: Array, loss: RobustLoss) -> Array:
    """Return by how much the scatter of each response exceeds its errors (Huber's proposal 2)."""
    wanted = gaussian_mean(loss.influence(NORMAL) ** 2)
    factors = np.ones(len(used))
    for place, (column, there) in enumerate(zip(residuals.T, present.T, strict=True)):
        if np.any(column[there]):
            kept = max(1.0 - used[place] / there.sum(), 0.05)
            factors[place] = _factor(column[there], loss, wanted * kept)
    return factors


def _factor(residuals: Array, loss: RobustLoss, wanted: float) -> float:
    """Return what residuals are to be divided by for their mean square influence to be this."""
    factor = 1.0
    for _ in range(50):
        mean = float(np.mean(loss.influence(residuals / factor) ** 2))
        step = np.sqrt(mean / wanted)
        factor *= float(step)
        if abs(step - 1.0) < 1e-5:
            break
    return factor


def typical_deviation(residuals: Array, present: Mask) -> Array:
    """Return the median deviation of each response, in its errors; few outliers do not move it."""
    shown = np.where(present, np.abs(residuals), np.nan)
    return np.asarray(np.nanmedian(shown, axis=0) / 0.6745)


def too_small(present: Mask, factors: Array, typical: Array) -> Mask:
    """Tell which scatter is larger than errors that were given allow.

    Chi squared (Wilson & Hilferty 1931) and the median deviation (Huber 1981, section 5.1) must
    both say so: not a few outliers, but most of the values.
    """
    counts = np.maximum(present.sum(axis=0), 1)
    bound = (1.0 - 2.0 / (9.0 * counts) + SURE * np.sqrt(2.0 / (9.0 * counts))) ** 1.5
    return np.asarray((factors > bound) & (typical > 1.0 + SURE * 1.17 / np.sqrt(counts)))
