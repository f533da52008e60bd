"""A law with some parameters free: from coordinates to residuals, for batches of them."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from carom.fitting.errors import Loss, Weights
from carom.fitting.laws import Law, Parameter, Values, predicted, ranged
from carom.fitting.least_squares import Bounds, Residuals
from carom.fitting.problem import Problem
from carom.quantities.arrays import Array

OFFSET = "spin_offset"


@dataclass(frozen=True, eq=False)
class Model:
    """A law, what was measured, and which of its parameters are free; the others are held."""

    law: Law
    problem: Problem
    free: tuple[str, ...]
    held: Mapping[str, float]

    @cached_property
    def parameters(self) -> tuple[Parameter, ...]:
        """The free parameters, in the order of the coordinates."""
        own = (ranged(parameter, self.problem.pair) for parameter in self.law.parameters)
        known = {parameter.name: parameter for parameter in own}
        return tuple(known.get(name) or offset_parameter(self.problem) for name in self.free)

    @cached_property
    def bounds(self) -> Bounds:
        """The range of the coordinates."""
        ends = [(p.coordinate(p.low), p.coordinate(p.high)) for p in self.parameters]
        low, high = np.array(ends).reshape(-1, 2).T
        return Bounds(low, high)

    def values(self, at: Array) -> Values:
        """Return the values of all parameters at coordinates, each of shape (batch, 1)."""
        batch = len(at)
        held = {name: np.full((batch, 1), value) for name, value in self.held.items()}
        columns = (p.value(at[:, i : i + 1]) for i, p in enumerate(self.parameters))
        return held | dict(zip(self.free, columns, strict=True))

    def coordinates(self, values: Mapping[str, float]) -> Array:
        """Return the coordinates of values, of shape (parameters,)."""
        return np.array([p.coordinate(values[p.name]) for p in self.parameters])

    def expected(self, at: Array) -> Array:
        """Return the responses at coordinates, of shape (batch, rows, responses)."""
        problem = self.problem
        values = self.values(at)
        return predicted(self.law, problem.pair, problem.motion, values, problem.responses)

    def residuals(self, weights: Weights, loss: Loss) -> Residuals:
        """Return the function whose sum of squares is to be least."""

        def of(at: Array) -> Array:
            return loss.root(weights.whitened(self.problem, self.expected(at))).reshape(len(at), -1)

        return of

    def holding(self, name: str, value: float) -> "Model":
        """Return the model with one of the free parameters held."""
        free = tuple(each for each in self.free if each != name)
        return replace(self, free=free, held={**self.held, name: value})


def offset_parameter(problem: Problem) -> Parameter:
    """Return the offset of the spin, which is varied in units of a tenth of the rolling spin."""
    scale = 0.1 * float(np.median(problem.motion.normal_speed)) / problem.pair.first.radius
    return Parameter(OFFSET, -100.0 * scale, 100.0 * scale, scale)
