"""A law with some parameters free: from coordinates to residuals, for batches of them."""

from collections.abc import Collection, Mapping
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from carom.dimensionless.rebounds import regimes
from carom.fitting.errors import RobustLoss, Weights
from carom.fitting.laws import (
    OFFSET,
    FittedLaw,
    IncomingMotion,
    Parameter,
    Values,
    half_ratio,
    ranged,
)
from carom.fitting.least_squares import BoxBounds, Residuals
from carom.fitting.problem import FitProblem
from carom.quantities.arrays import Array


@dataclass(frozen=True, eq=False)
class Model:
    """A law, what was measured, and which of its parameters are free; the others are held."""

    law: FittedLaw
    problem: FitProblem
    free: tuple[str, ...]
    held: Mapping[str, float]

    @cached_property
    def parameters(self) -> tuple[Parameter, ...]:
        """The free parameters, in the order of the coordinates."""
        own = (ranged(parameter, self.problem.pair) for parameter in self.law.parameters)
        known = {parameter.name: parameter for parameter in own}
        return tuple(known.get(name) or offset_parameter(self.problem) for name in self.free)

    @cached_property
    def bounds(self) -> BoxBounds:
        """The range of the coordinates."""
        ends = [(p.coordinate(p.low), p.coordinate(p.high)) for p in self.parameters]
        return BoxBounds(*np.array(ends).reshape(-1, 2).T)

    def values(self, at: Array) -> Values:
        """Return the values of all parameters at coordinates, each of shape (batch, 1)."""
        batch = len(at)
        held = {name: np.full((batch, 1), value) for name, value in self.held.items()}
        columns = (p.value(at[:, i : i + 1]) for i, p in enumerate(self.parameters))
        return held | dict(zip(self.free, columns, strict=True))

    def values_at(self, point: Array) -> dict[str, float]:
        """Return the values of all parameters at coordinates of shape (parameters,)."""
        return {name: float(v[0, 0]) for name, v in self.values(point[np.newaxis]).items()}

    def coordinates(self, values: Mapping[str, float]) -> Array:
        """Return the coordinates of values, of shape (parameters,)."""
        return np.array([p.coordinate(values[p.name]) for p in self.parameters])

    def expected(self, at: Array, motion: IncomingMotion | None = None) -> Array:
        """Return the responses at coordinates, of shape (batch, rows, responses).

        They are those to the motion that was measured, or to another one.
        """
        problem = self.problem
        before = problem.motion if motion is None else motion
        return self.law.predicted(problem.pair, before, self.values(at), problem.responses)

    def weights(self, point: Array, sigma: Array, scale: Array) -> Weights:
        """Return the weights at coordinates of shape (parameters,).

        Covariance of the responses of a row: S (diag(sigma^2) + sum_x d_x d_x^T) S, with d_x half
        the difference of the responses when a column x of the motion before goes one standard
        deviation up and down (effective variance; Orear 1982), and S the factors by which given
        errors are too small. `sigma` has the shape (rows, responses), `scale` (responses,).
        """
        present, at = self.problem.present, point[np.newaxis]
        variance = np.where(present, sigma, 1.0) ** 2
        covariance = variance[:, :, np.newaxis] * np.eye(len(scale))
        for up, down in self.problem.shaken:
            difference = self.expected(at, up)[0] - self.expected(at, down)[0]
            reach = np.where(present, 0.5 * difference, 0.0)
            covariance += reach[:, :, np.newaxis] * reach[:, np.newaxis, :]
        return Weights(np.linalg.inv(np.linalg.cholesky(covariance)) / scale)

    def residuals(self, weights: Weights, loss: RobustLoss) -> Residuals:
        """Return the function whose sum of squares is to be least."""

        def of(at: Array) -> Array:
            roots = loss.root(weights.whitened(self.problem, self.expected(at)))
            return roots.reshape(len(at), self.problem.measured.size)

        return of

    def regimes(self, point: Array) -> NDArray[np.int8]:
        """Return the place in `carom.impacts.curves.REGIMES` of each row, by the exact law."""
        problem, values = self.problem, self.values_at(point)
        velocity = problem.contact_velocity + problem.pair.first.radius * values[OFFSET]
        psi = values["kappa"] * velocity / (values["friction"] * problem.motion.normal_speed)
        return regimes(psi, half_ratio(problem.pair) * values["kappa"], values["restitution"])

    def holding(self, name: str, value: float) -> "Model":
        """Return the model with one of the free parameters held."""
        free = tuple(each for each in self.free if each != name)
        return replace(self, free=free, held={**self.held, name: value})

    def freeing(self, names: Collection[str]) -> "Model":
        """Return the model with some of the parameters that are held free."""
        held = {name: value for name, value in self.held.items() if name not in names}
        return replace(self, free=(*self.free, *names), held=held)


def offset_parameter(problem: FitProblem) -> Parameter:
    """Return the offset of the spin, which is varied in units of a tenth of the rolling spin."""
    scale = 0.1 * float(np.median(problem.motion.normal_speed)) / problem.pair.first.radius
    return Parameter(OFFSET, -100.0 * scale, 100.0 * scale, scale)
