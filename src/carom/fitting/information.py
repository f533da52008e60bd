"""What measured values tell of the parameters, near a fit: slopes, covariance, and whose doing."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from carom.fitting.descent import jacobian
from carom.fitting.errors import Loss, Weights
from carom.fitting.model import Model

Array = NDArray[np.float64]

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
        count = len(self.matrix)
        return np.asarray(np.linalg.inv(self.matrix + WEAK**2 * 1e-2 * np.eye(count)))

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


def information(model: Model, at: Array, weights: Weights, loss: Loss) -> Information:
    """Return what the values tell at coordinates of shape (parameters,)."""
    residuals = model.residuals(weights, loss)
    start = at[np.newaxis]
    slopes = jacobian(residuals, start, residuals(start), model.bounds)[0]
    return Information(slopes.reshape(*model.problem.measured.shape, -1))
