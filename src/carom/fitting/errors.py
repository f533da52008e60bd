"""Errors of what is measured: covariances row by row, whitened residuals, and a robust loss."""

from dataclasses import dataclass

import numpy as np

from carom.fitting.laws import Law, Values, predicted
from carom.fitting.problem import Problem
from carom.quantities.arrays import Array


@dataclass(frozen=True)
class SoftL1:
    """Loss 2 c^2 (sqrt(1 + (r/c)^2) - 1) of a residual r in standard deviations.

    r^2 for small r, 2 c |r| for outliers (Charbonnier et al. 1997; scipy's soft_l1). With c = 2 it
    keeps 97 % of the efficiency where errors are Gaussian.
    """

    c: float = 2.0

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


@dataclass(frozen=True)
class Squares:
    """Loss r^2: maximum likelihood for Gaussian errors."""

    def root(self, residual: Array) -> Array:
        """Return the residual."""
        return residual

    def influence(self, residual: Array) -> Array:
        """Return the residual."""
        return residual

    def slope(self, residual: Array) -> Array:
        """Return one."""
        return np.ones_like(residual)


Loss = SoftL1 | Squares


def gaussian_mean(values: Array, at: Array) -> float:
    """Return the mean of a function, given at points, over a standard normal distribution."""
    density = np.exp(-0.5 * at**2)
    return float((values * density).sum() / density.sum())


NORMAL = np.linspace(-10.0, 10.0, 2001)  # where such means are taken


@dataclass(frozen=True, eq=False)
class Weights:
    """What makes residuals independent and of unit variance: inverse Cholesky factors by row."""

    factors: Array

    def whitened(self, problem: Problem, expected: Array) -> Array:
        """Return the residuals in standard deviations, 0 where nothing was measured."""
        residual = np.where(problem.present, problem.measured - expected, 0.0)
        return np.asarray(np.einsum("rij,brj->bri", self.factors, residual))


def weights_at(law: Law, problem: Problem, values: Values, sigma: Array, scale: Array) -> Weights:
    """Return the weights where the parameters are these, a batch of one.

    Covariance of the responses of a row: S (diag(sigma^2) + sum_x d_x d_x^T) S, with d_x half the
    difference of the responses when a column x of the motion before goes one standard deviation up
    and down (effective variance; Orear 1982), and S the factors by which given errors are too
    small. `sigma` has the shape (rows, responses), `scale` (responses,).
    """
    shape = problem.measured.shape
    covariance = np.einsum(
        "rj,jk->rjk", np.where(problem.present, sigma, 1.0) ** 2, np.eye(shape[1])
    )
    for up, down in problem.shaken:
        high, low = (
            predicted(law, problem.pair, m, values, problem.responses)[0] for m in (up, down)
        )
        reach = np.where(problem.present, 0.5 * (high - low), 0.0)
        covariance += reach[:, :, np.newaxis] * reach[:, np.newaxis, :]
    factors = np.linalg.inv(np.linalg.cholesky(covariance))
    return Weights(factors / scale)
