"""Intervals by profile likelihood: how far a parameter can go, the others following it."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from carom.fitting.descent import descend
from carom.fitting.estimation import Best

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

ROUNDS, CLOSE = 16, 2e-3  # at most; of the distance at which the loss has risen enough
FIRST = 4.0  # parts of the range in which an open side is searched for, at first


@dataclass(frozen=True, eq=False)
class Profile:
    """The ends of the intervals: coordinates (parameters, 2, parameters), low end first.

    `open` tells where the loss did not rise enough up to the end of the range. `better` is a point
    with a smaller loss than the fit, if one was met.
    """

    ends: Array
    open: Mask
    rise: Array
    better: Array | None


@dataclass(eq=False)
class _Search:
    """Both ends of every parameter at once: each is a problem of a batch."""

    best: Best
    bounds: Array  # rise of the loss at the ends, of shape (batch,)

    @cached_property
    def which(self) -> NDArray[np.int64]:
        return np.repeat(np.arange(self.count), 2)

    @cached_property
    def sides(self) -> Array:
        return np.tile([-1.0, 1.0], self.count)

    @property
    def count(self) -> int:
        return len(self.best.at)

    @cached_property
    def limits(self) -> Array:
        low, high = self.best.model.bounds
        return np.where(self.sides < 0.0, low[self.which], high[self.which])

    @cached_property
    def directions(self) -> Array:
        """How all coordinates go along with one, to first order, of shape (batch, parameters)."""
        covariance = self.best.information.covariance[self.which]
        own = np.take_along_axis(covariance, self.which[:, np.newaxis], axis=1)
        return np.asarray(covariance / own)

    def follow(self, start: Array) -> tuple[Array, Array]:
        """Return where the others go, and the root of the rise of the loss over its bound."""
        best = self.best
        free = np.arange(self.count) != self.which[:, np.newaxis]
        residuals = best.model.residuals(best.weights, best.loss)
        found = descend(residuals, start, best.model.bounds, free)
        return found.at, (found.sums - best.sum) / self.bounds


def profile(best: Best, quantiles: Array) -> Profile:
    """Return the ends of the intervals of all parameters.

    The loss may rise by the spread of the loss times a quantile of chi squared, or of F.
    """
    search = _Search(best, np.repeat(best.spread * quantiles, 2))
    which, sides, limits = search.which, search.sides, search.limits
    own = best.at[which]
    deviation = np.sqrt(np.diag(best.information.covariance))[which]
    width = np.sqrt(search.bounds) * deviation
    low, high = best.model.bounds
    width = np.minimum(width, ((high - low) / FIRST)[which])
    target = _within(own + sides * width, limits, sides)
    inside, outside = np.zeros(len(own)), np.full(len(own), np.inf)  # distances from the fit
    root_in, root_out = np.zeros(len(own)), np.full(len(own), np.inf)
    at = np.repeat(best.at[np.newaxis], len(own), axis=0)
    ends, done, rise = at.copy(), np.zeros(len(own), dtype=bool), np.zeros(len(own))
    for _ in range(ROUNDS):
        start = at + search.directions * (target - at[np.arange(len(own)), which])[:, np.newaxis]
        start[np.arange(len(own)), which] = target
        at, excess = search.follow(start)
        if np.any(excess < -0.02):
            return Profile(ends.reshape(-1, 2, search.count), done, rise, at[np.argmin(excess)])
        root = np.sqrt(np.maximum(excess, 0.0))
        distance = np.abs(target - own)
        ends = np.where(done[:, np.newaxis], ends, at)
        rise = np.where(done, rise, excess)
        within = root < 1.0
        inside, root_in = np.where(within, distance, inside), np.where(within, root, root_in)
        outside = np.where(within, outside, distance)
        root_out = np.where(within, root_out, root)
        stuck = within & (target == limits)
        done |= (np.abs(root - 1.0) < CLOSE) | stuck
        if done.all():
            break
        target = _within(own + sides * _next(inside, outside, root_in, root_out), limits, sides)
    opened = (ends[np.arange(len(own)), which] == limits) & (rise < 1.0 - CLOSE)
    return Profile(ends.reshape(-1, 2, search.count), opened.reshape(-1, 2), rise, None)


def _within(target: Array, limits: Array, sides: Array) -> Array:
    return np.where(sides < 0.0, np.maximum(target, limits), np.minimum(target, limits))


def _next(inside: Array, outside: Array, root_in: Array, root_out: Array) -> Array:
    """Return the next distance to try: a secant in a bracket, or farther out."""
    with np.errstate(invalid="ignore", divide="ignore"):
        bracket = outside - inside
        part = np.clip((1.0 - root_in) / (root_out - root_in), 0.05, 0.95)
        secant = inside + np.where(np.isfinite(bracket), bracket * part, 0.0)
        farther = inside * np.clip(1.02 / np.maximum(root_in, 1e-9), 1.05, 3.0)
    return np.where(np.isfinite(outside), secant, farther)
