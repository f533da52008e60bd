"""Restitution against speed: which law of losses the normal velocities follow."""

from dataclasses import dataclass, replace
from functools import cache
from math import isfinite
from typing import Any

import numpy as np
from scipy.interpolate import CubicSpline

from carom.bodies.losses import ElasticPlastic, KelvinVoigt, LossLaw
from carom.bodies.pairs import Pair
from carom.datasets.observables import NORMAL
from carom.dimensionless.lossy.panels.stages import restitution
from carom.dimensionless.lossy.panels.work import new_work
from carom.fitting.comparison import APART, CLEAR, Standing, on_common_ground, weighed
from carom.fitting.estimates import Estimate, estimate_of
from carom.fitting.estimation import Best
from carom.fitting.intervals import profiled, settle
from carom.fitting.model import (
    ANY_RESTITUTION,
    OFFSET,
    FittedLaw,
    Model,
    Parameter,
    Values,
    untouched,
)
from carom.fitting.problem import FitProblem
from carom.quantities.arrays import Array
from carom.quantities.prefixes import span

FEWEST, RANGE = 4, 1.2  # values; of the speeds, largest over smallest: below nothing can be told
LEAST, MOST = 1e-8, 10.0  # of a loss time, in units of d_max/V_1
SLOWEST = 1e-5  # yield velocity, in units of the smallest speed
CONSTANT = "constant"


@dataclass(frozen=True, eq=False)
class LossFit(Standing):
    """A law of losses fitted to restitutions, with its one parameter."""

    parameter: Estimate

    @property
    def losses(self) -> LossLaw:
        """The law with its parameter, as `impact` takes it."""
        value = self.parameter.value
        if self.parameter.name == "yield_velocity":
            return ElasticPlastic(yield_velocity=value)
        return KelvinVoigt(**{self.parameter.name: value})

    def restitution(self, normal_speed: Array) -> Array:
        """Return the restitution at normal speeds."""
        model = self.best.model
        values = model.values(self.best.at[np.newaxis])
        return np.asarray(model.law.restitution(model.problem.pair, normal_speed, values)[0])


@dataclass(frozen=True, eq=False)
class LossComparison:
    """Laws of losses by Akaike's criterion on the same normal velocities, the best one first."""

    standings: tuple[LossFit, ...]
    speeds: Array
    measured: Array
    errors: Array

    def __getitem__(self, law: str) -> LossFit:
        return {each.law: each for each in self.standings}[law]

    @property
    def verdict(self) -> str:
        """What the data say of the laws, in a sentence."""
        first, *others = self.standings
        if not isfinite(first.excess):
            return "there are too few values to tell laws of losses apart"
        close = [each.law for each in others if not each.excess > APART]
        if close:
            return f"the data cannot tell {first.law} from {' and '.join(close)}"
        next_law = others[0].law
        how = f"the data rule out {next_law}"
        if others[0].excess <= CLEAR:
            how = f"{next_law} is less likely"
        varies = f"depends on the speed as in {first.law}"
        told = "is the same at all speeds" if first.law == CONSTANT else varies
        return f"the restitution {told}; {how}"

    def to_dict(self) -> dict[str, Any]:
        """Return the comparison as plain numbers, by law; what cannot be computed is None."""
        return {
            each.law: {**each.to_dict(), each.parameter.name: each.parameter.to_dict()}
            for each in self.standings
        }

    def __str__(self) -> str:
        speeds = span(float(self.speeds.min()), float(self.speeds.max()), "m/s", 3)
        head = f"losses at normal speeds of {speeds}"
        fitted = [f"{each.law}: {each.parameter.name} {each.parameter}" for each in self.standings]
        wide = max(48, *map(len, fitted))
        lines = [f"{head:{wide}s}AICc excess  weight"]
        for each, told in zip(self.standings, fitted, strict=True):
            excess, weight = each.cells
            lines.append(f"  {told:{wide}s} {excess:>8s}  {weight:>6s}")
        return "\n".join([*lines, self.verdict])


def compare_losses(best: Best, confidence: float) -> LossComparison | None:
    """Return laws of losses on the normal velocities of a fit; None where they tell nothing.

    A constant restitution, the viscoelastic solid of one loss time (Kuwabara & Kono 1987), and the
    sphere that yields (Thornton 1997), on common ground as laws of rebound are.
    """
    problem = _normal(best.model.problem)
    if problem is None:
        return None
    own = [
        settle(Model(law, problem, law.names, {OFFSET: 0.0}), best.loss, _elastic(law)).best
        for law in _laws(problem)
    ]
    criteria, fits = on_common_ground(own)
    excess, weights = weighed(criteria)
    standings = []
    for place in np.argsort(criteria):
        found = profiled(fits[place], confidence)
        law = found.best.model.law
        parameter = estimate_of(found, law.names[0])
        standings.append(LossFit(law.name, excess[place], weights[place], found.best, parameter))
    measured, errors = _restitutions(problem, standings[0].best)
    return LossComparison(tuple(standings), problem.motion.normal_speed, measured, errors)


def _normal(problem: FitProblem) -> FitProblem | None:
    """Return the normal responses alone, if their speeds are known and differ."""
    places = [place for place, name in enumerate(problem.responses) if name in NORMAL]
    if not places or not problem.has_speeds:
        return None
    there = problem.present[:, places]
    speeds = problem.motion.normal_speed[there.any(axis=1)]
    if there.sum() < FEWEST or speeds.max() < RANGE * speeds.min():
        return None
    names = tuple(problem.responses[place] for place in places)
    measured, errors = problem.measured[:, places], problem.errors[:, places]
    return replace(problem, responses=names, measured=measured, errors=errors)


def _restitutions(problem: FitProblem, best: Best) -> tuple[Array, Array]:
    """Return measured restitutions, outliers too, and their errors; the first response counts."""
    is_speed = problem.responses[0] == "normal_speed_out"
    scale = 1.0 / problem.motion.normal_speed if is_speed else 1.0
    return scale * problem.measured[:, 0], scale * best.sigma[:, 0] * best.scale[0]


def _laws(problem: FitProblem) -> tuple[FittedLaw, ...]:
    """Return the laws, with ranges beyond which nothing changes at these speeds."""
    speeds = problem.motion.normal_speed
    times = _times(problem.pair, speeds)
    loss_time = Parameter("loss_time", LEAST * times.min(), MOST * times.max(), None)
    yielding = Parameter("yield_velocity", SLOWEST * speeds.min(), float(speeds.max()), None)
    return (
        FittedLaw(CONSTANT, (ANY_RESTITUTION,), untouched),
        FittedLaw("KelvinVoigt", (loss_time,), untouched, viscous),
        FittedLaw("ElasticPlastic", (yielding,), untouched, plastic),
    )


def _elastic(law: FittedLaw) -> dict[str, float]:
    """Return the parameter with which a law loses next to nothing."""
    (parameter,) = law.parameters
    is_time = parameter.name == "loss_time"
    return {parameter.name: parameter.low if is_time else parameter.high}


def _times(pair: Pair, normal_speed: Any) -> Array:
    """Return d_max/V_1 at each speed."""
    return np.asarray(pair.scales(normal_speed).time)


def viscous(pair: Pair, normal_speed: Array, values: Values) -> Array:
    """Return e(alpha), alpha = tau V_1/d_max (Kuwabara & Kono 1987), without tension."""
    alpha = values["loss_time"] / _times(pair, normal_speed)
    return np.asarray(np.exp(-np.exp(_viscous()(np.log(alpha)))))


@cache
def _viscous() -> CubicSpline:
    """Return log(-log e) of log alpha, which is nearly straight at both ends."""
    alphas, work = np.geomspace(1e-7, 90.0, 241), new_work()
    found = np.array([restitution(float(alpha), work) for alpha in alphas])
    return CubicSpline(np.log(alphas), np.log(-np.log(found)))


def plastic(pair: Pair, normal_speed: Array, values: Values) -> Array:
    """Return e = P_max/d_max^(1/4) of a sphere that yields, 1 below V_y (Thornton 1997, (28)).

    In units of the elastic impact, y = (V_y/V_1)^(2/5) and P_max^2 = (6/5) y - y^6/5.
    """
    y = np.minimum(values["yield_velocity"] / normal_speed, 1.0) ** 0.4
    peak = np.sqrt(1.2 * y - 0.2 * y**6)
    deepest = y**2 + (peak - y**3) / (1.5 * y)
    return np.asarray(peak / deepest**0.25)
