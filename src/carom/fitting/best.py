"""A model fitted: where it is best, by which errors, and what the values tell of the parameters."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from carom.fitting import errors
from carom.fitting.least_squares import Minimum, descend, jacobian
from carom.fitting.model import Model
from carom.io.user_table import Mask
from carom.quantities.arrays import Array

WEAK = 0.3  # standard deviations by which a coordinate changes the values, too few to tell


@dataclass(frozen=True, eq=False)
class Information:
    """Derivatives of residuals, of shape (rows, responses, parameters), in standard deviations."""

    slopes: Array

    @cached_property
    def matrix(self) -> Array:
        """Fisher's information, of shape (parameters, parameters)."""
        return np.asarray(np.einsum("rjp,rjq->pq", self.slopes, self.slopes))

    @cached_property
    def covariance(self) -> Array:
        """Covariance of the coordinates; one that is not told is uncertain by 1/WEAK."""
        sizes, directions = np.linalg.eigh(self.matrix)
        known = np.maximum(sizes, 0.0) + WEAK**2 * 1e-2
        return np.asarray((directions / known) @ directions.T)

    @property
    def used(self) -> Array:
        """How many of the parameters each response determines."""
        taken = np.einsum("rjp,pq,rjq->j", self.slopes, self.covariance, self.slopes)
        return np.asarray(taken)

    @property
    def shares(self) -> Array:
        """Variances of the coordinates from each response, of shape (parameters, responses)."""
        gains = np.einsum("pq,rjq->prj", self.covariance, self.slopes)
        return np.asarray(np.square(gains).sum(axis=1))


def information(
    model: Model, at: Array, weights: errors.Weights, loss: errors.RobustLoss
) -> Information:
    """Return what the values tell at coordinates of shape (parameters,)."""
    residuals = model.residuals(weights, loss)
    start = at[np.newaxis]
    slopes = jacobian(residuals, start, residuals(start), model.bounds)[0]
    return Information(slopes.reshape(*model.problem.measured.shape, -1))


@dataclass(frozen=True, eq=False)
class Best:
    """A model fitted: coordinates, loss there, and the errors that were used.

    `estimated` tells of which responses the errors come from the scatter, `scale` by how much
    errors that were given had to be made larger, `others` where descents from other starts ended.
    """

    model: Model
    at: Array
    sum: float
    weights: errors.Weights
    loss: errors.RobustLoss
    sigma: Array
    scale: Array
    estimated: Mask
    others: Array
    result: Any = None

    @property
    def values(self) -> dict[str, float]:
        """Values of all parameters."""
        return self.model.values_at(self.at)

    @property
    def expected(self) -> Array:
        """The responses that the fit gives, of shape (rows, responses)."""
        return np.asarray(self.model.expected(self.at[np.newaxis])[0])

    @property
    def residuals(self) -> Array:
        """Residuals in standard deviations, of shape (rows, responses), 0 where not measured."""
        return np.asarray(self.weights.whitened(self.model.problem, self.expected[np.newaxis])[0])

    @cached_property
    def rivals(self) -> Minimum:
        """Minima found from other starts."""
        residuals = self.model.residuals(self.weights, self.loss)
        return descend(residuals, self.others, self.model.bounds)

    @cached_property
    def information(self) -> Information:
        """What the values tell of the free parameters."""
        return information(self.model, self.at, self.weights, self.loss)

    @property
    def freedom(self) -> Array:
        """Degrees of freedom of the error of each parameter (Welch & Satterthwaite 1946-47)."""
        with np.errstate(divide="ignore"):
            return np.asarray(1.0 / (self._shares**2 * self._doubts).sum(axis=1))

    @property
    def caution(self) -> Array:
        """What weights from the scatter, uncertain themselves, add to variances (Meier 1953).

        1 + 4 sum p (1 - p)/nu over responses, with the part p of each in a variance, for each
        parameter.
        """
        parts = self._shares
        return np.asarray(1.0 + 4.0 * (parts * (1.0 - parts) * self._doubts).sum(axis=1))

    @property
    def _shares(self) -> Array:
        """Part of each response in the variance of each parameter, (parameters, responses)."""
        shares = self.information.shares
        return np.asarray(shares / np.maximum(shares.sum(axis=1, keepdims=True), 1e-300))

    @property
    def _doubts(self) -> Array:
        """One over the degrees of freedom of errors from the scatter, 0 where they are known."""
        own = np.maximum(self.model.problem.present.sum(axis=0) - self.information.used, 1.0)
        return np.asarray((self.estimated | (self.scale > 1.0)) / own)

    @property
    def spread(self) -> float:
        """What the loss rises by, in units of chi squared, where a parameter is one sigma off.

        E[influence^2]/E[slope] (Huber 1981, section 7.6), 1 for squares: that of normal errors, or
        more where those found say so.
        """
        if self.loss.is_square:
            return 1.0
        found = self.residuals[self.model.problem.present]
        used = float(self.information.used.sum())

        def ratio(mean: Callable[[Callable[[Array], Array]], float]) -> float:
            return mean(lambda r: self.loss.influence(r) ** 2) / mean(self.loss.slope)

        normal = ratio(lambda f: errors.gaussian_mean(f(errors.NORMAL)))
        return max(normal, ratio(lambda f: errors.mean_over(found, f, used)))


def likelihood(best: Best) -> float:
    """Return -2 log likelihood."""
    return best.sum + normalization(best.model, best.weights, best.loss)


def normalization(model: Model, weights: errors.Weights, loss: errors.RobustLoss) -> float:
    """Return -2 log likelihood of residuals of zero."""
    problem = model.problem
    return weights.sizes(problem.present) + problem.count * loss.size
