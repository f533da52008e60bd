"""Errors of what is measured: residuals made independent, of unit variance, and robust."""

from dataclasses import dataclass

import numpy as np

from carom.fitting.problem import FitProblem
from carom.quantities.arrays import Array

NORMAL = np.linspace(-10.0, 10.0, 2001)  # where means over a normal distribution are taken


@dataclass(frozen=True)
class Loss:
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
