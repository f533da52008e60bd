"""Intervals by profile likelihood: how far a parameter can go, the others following it."""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from carom.fitting.errors import Loss
from carom.fitting.estimation import WEAK, Best, Information, estimate
from carom.fitting.interpolation import THROUGHOUT, regimes
from carom.fitting.laws import half_ratio
from carom.fitting.least_squares import descend
from carom.fitting.model import OFFSET, Model
from carom.quantities.arrays import Array

Mask = NDArray[np.bool_]
FIRST = 4.0  # parts of the range in which an open side is searched for, at first
HELD_FIRST = (OFFSET, "restitution", "tangential_restitution", "kappa", "friction")
EXAMPLES = {"restitution": 0.98, "kappa": 0.82, "friction": 0.1, OFFSET: 0.0}
MEMBER = 0.25  # part of a direction that a parameter of a group has at least
WORSE = 0.5  # rise of the loss at which a starting value contradicts the data
ROUNDS, CLOSE = 16, 2e-3  # at most; of the distance at which the loss has risen enough


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


def rise_of(confidence: float, freedom: Array) -> Array:
    """Return the square of Student's t, a quantile of F(1, freedom); of chi squared if infinite."""
    from scipy.special import ndtri, stdtrit

    level = 0.5 + 0.5 * confidence
    bounded = np.where(np.isfinite(freedom), freedom, 1.0)
    return np.asarray(np.where(np.isfinite(freedom), stdtrit(bounded, level), ndtri(level)) ** 2)


EXAMPLES |= {"tangential_restitution": 0.4}


@dataclass(frozen=True, eq=False)
class Settled:
    """The best fit of what the data tell, and the groups of parameters that they do not tell.

    Of each group the first parameter is held; `whole` is the fit before anything was held.
    """

    best: Best
    groups: tuple[tuple[str, ...], ...]
    whole: Best


def settle(model: Model, loss: Loss, start: Mapping[str, float]) -> Settled:
    """Fit, and hold one parameter after the other until the data tell all that are free."""
    whole = best = estimate(model, loss)
    groups: list[tuple[str, ...]] = []
    while len(best.model.free):
        group = weak_group(best.information, best.model.free)
        if not group or len(best.model.free) == 1:
            return Settled(best, (*groups, *((group,) if group else ())), whole)
        groups.append(group)
        best = _held(best, group[0], start[group[0]], loss)
    return Settled(best, tuple(groups), whole)


def weak_group(told: Information, names: tuple[str, ...]) -> tuple[str, ...]:
    """Return the parameters of a direction in which the values hardly change, to be held first."""
    alone = np.sqrt(np.diag(told.matrix)) < WEAK
    if alone.any():
        return (names[int(np.argmax(alone))],)
    sizes, directions = np.linalg.eigh(told.matrix)
    if sizes[0] >= WEAK**2:
        return ()
    members = [n for n, part in zip(names, directions[:, 0], strict=True) if abs(part) > MEMBER]
    return tuple(sorted(members, key=HELD_FIRST.index))


def _held(best: Best, name: str, start: float, loss: Loss) -> Best:
    """Return the fit with a parameter held where it starts, or where it was if that is worse."""
    at_start = estimate(best.model.holding(name, start), loss)
    found = float(best.model.values(best.at[np.newaxis])[name][0, 0])
    if abs(at_start.sum - best.sum) < WORSE * best.spread or at_start.estimated.any():
        return at_start
    return estimate(best.model.holding(name, found), loss)


def row_regimes(best: Best, at: Array | None = None) -> NDArray[np.int8]:
    """Return the place of each row's regime in `curves.REGIMES`, by default at the fit."""
    model, problem = best.model, best.model.problem
    point = best.at if at is None else at
    values = {name: float(v[0, 0]) for name, v in model.values(point[np.newaxis]).items()}
    motion = problem.motion
    velocity = problem.contact_velocity + problem.pair.first.radius * values[OFFSET]
    psi = values["kappa"] * velocity / (values["friction"] * motion.normal_speed)
    chi = half_ratio(problem.pair) * values["kappa"]
    return regimes(psi, chi, values["restitution"])


def reason(group: tuple[str, ...], best: Best) -> str:
    """Return why the data do not tell a group of parameters."""
    if len(group) > 1:
        return _together(group)
    name = group[0]
    found = row_regimes(best)
    if name == "kappa" and np.all(found == THROUGHOUT):
        return "every row slips throughout, where the stiffness does not matter"
    if name == "friction" and np.all(found == 0):
        return "every row sticks from the first touch, where friction hardly matters"
    if name == "restitution":
        return "nothing that was measured depends on it; measure normal_restitution"
    return "over its whole range it changes the values by less than their scatter"


def _together(group: tuple[str, ...]) -> str:
    others = f"fix one of them, e.g. fixed={{'{group[0]}': {EXAMPLES[group[0]]}}}"
    if set(group) == {"friction", "restitution"}:
        return f"only friction (1 + restitution) enters; {others}, or measure normal_restitution"
    *most, last = sorted(group)
    return f"{', '.join(most)} and {last} change the values only together; {others}"
