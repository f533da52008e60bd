"""Where to measure next: incidences that shorten an interval most, by expected information."""

from collections import Counter
from dataclasses import dataclass, replace
from math import ceil, inf, log10
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.impacts.curves import REGIMES
from carom.lab.fitting.comparison import FitRecord
from carom.lab.fitting.estimation import Best, weighed
from carom.lab.fitting.plates import THICKNESS
from carom.lab.fitting.problem import NORMAL, FitProblem, RobustLoss, gaussian_mean
from carom.quantities.arrays import Array
from carom.quantities.refusals import InputError, nearest
from carom.quantities.units import counted

ANGLES = np.arange(1.0, 86.0)  # of incidence that are considered, in degrees
WORTHWHILE = 10_000  # measurements at one incidence that are worth a thought
MOST_LISTED = 1000  # measurements that are said one by one
ROUNDING = 0.01  # of a measurement
PRIOR = 1e-2  # information on what nothing is known of, per unit of its coordinate
HALVED = 4.0  # what a variance is divided by where its interval is halved


@dataclass(frozen=True)
class Incidence:
    """An angle to measure at, its regime, and how many are `needed` to halve the interval."""

    angle: float
    regime: str
    needed: int | None


@dataclass(frozen=True)
class Advice:
    """Which incidences to measure next for a parameter, and what is to be expected of that.

    `places` in the order in which they help most, each given the ones before; `best` is the single
    incidence that halves the interval with the fewest measurements; `shorter` is the width of the
    interval after all of `places`, in units of the present one.
    """

    parameter: str
    places: tuple[Incidence, ...]
    best: Incidence
    shorter: float

    def to_dict(self) -> dict[str, Any]:
        """Return the advice as plain numbers and texts; angles in rad."""
        return {
            "parameter": self.parameter,
            "shorter": self.shorter,
            "best": vars(self.best),
            "places": [vars(place) for place in self.places],
        }

    def __str__(self) -> str:
        best = f"{np.degrees(self.best.angle):.0f} deg"
        alone = f"{self.best.needed} more" if self.best.needed else f"more than {WORTHWHILE}"
        halved = f"To halve the interval of {self.parameter}, measure {alone}"
        lines = [f"{halved} at {best} ({self.best.regime})."]
        lines.append(f"The best {len(self.places)} to measure next:")
        for place, times in Counter(self.places).items():
            lines.append(f"  {times} at {np.degrees(place.angle):.0f} deg ({place.regime})")
        lines.append(f"The interval will then be {self.shorter:.2f} of what it is now.")
        return "\n".join(lines)


def advise(fit: FitRecord, n: int, parameter: str | None) -> Advice:
    """Return the n incidences that shorten the interval of a parameter most, as `Fit.advice`.

    One more impact at an angle, at the usual speed, with the responses and errors measured so far,
    adds J^T J to the information.
    """
    count = counted("n", n, 1, MOST_LISTED)
    best = _with_all(fit)
    name = _wanted(fit, best, parameter)
    place = best.model.free.index(name)
    gains, regimes = _candidates(best)
    free = len(best.model.free)
    root = _joined(np.sqrt(PRIOR) * np.eye(free), best.information.all_slopes)
    now = _variance(root, place)
    needed = _needed(root, gains, place)
    counts = [None if need > WORTHWHILE else ceil(need - ROUNDING) for need in needed]
    places = list(map(Incidence, np.radians(ANGLES).tolist(), regimes, counts))
    chosen = []
    for _ in range(count):
        index = int(np.argmin(_variance(_joined(root, gains), place)))
        chosen.append(places[index])
        root = _joined(root, gains[index])
    shorter = float(np.sqrt(_variance(root, place) / now))
    wanted = "chi" if parameter == "chi" else name
    return Advice(wanted, tuple(chosen), places[int(np.argmin(needed))], shorter)


def _with_all(fit: FitRecord) -> Best:
    """Return the fit with what could not be determined free again."""
    best = fit._best
    told = (*best.model.free, "chi")
    missing = [name for name, each in fit.estimates.items() if each.reason and name not in told]
    if not missing:
        return best
    model = best.model.freeing(missing)
    at = np.clip(model.coordinates(best.values), *model.bounds)
    return replace(best, model=model, at=at, elsewhere=None)


def _wanted(fit: FitRecord, best: Best, parameter: str | None) -> str:
    """Return the parameter that is advised on, by default the least certain in its coordinate."""
    free = best.model.free
    if parameter is None:
        return free[int(np.argmax(np.diag(best.information.covariance)))]
    name = "kappa" if parameter == "chi" else parameter
    if name not in free:
        hint = nearest(str(parameter), free) or f"the fit has {', '.join(free)}"
        raise InputError(f"parameter: {str(parameter)!r} was not fitted; {hint}")
    return name


def _candidates(best: Best) -> tuple[Array, list[str]]:
    """Return the slopes of one impact at each incidence, by deviations, and its regime."""
    seen = best.model.problem
    model = replace(best.model, problem=_impacts(seen))
    sigma = np.array([np.median(s[p]) for s, p in zip(best.sigma.T, seen.present.T, strict=True)])
    everywhere = np.broadcast_to(sigma, model.problem.measured.shape)
    planned = weighed(model, RobustLoss(inf), best.at, everywhere, best.scale)
    slopes = planned.information.slopes
    per_value = gaussian_mean(np.gradient(best.loss.root(NORMAL), NORMAL) ** 2)  # of one more value
    return np.sqrt(per_value) * slopes, [REGIMES[index] for index in model.regimes(best.at)]


def _impacts(problem: FitProblem) -> FitProblem:
    """Return impacts at all incidences that are considered, as usual otherwise."""

    def usual(values: Array) -> Array:
        return np.full(len(ANGLES), np.median(values))

    own = {name: problem.before.get(name) for name in ("spin", "spin2", THICKNESS)}
    before = {name: usual(each) for name, each in own.items() if each is not None}
    before |= {"angle": np.radians(ANGLES), "speed": usual(np.hypot(*problem.motion[:2]))}
    errors = {name: usual(e) for name, e in problem.before_errors.items() if name in before}
    none = np.zeros((len(ANGLES), len(problem.responses)))
    planned = replace(problem, before=before, before_errors=errors, measured=none)
    return replace(planned, errors=none + np.nan, bounces=None)


def _joined(root: Array, slopes: Array) -> Array:
    """Return a root of information, R^T R, with slopes added, of shape (..., rows, parameters).

    Roots by orthogonal steps keep what is known of a direction beside one known far better.
    """
    batch = np.broadcast_to(root, (*slopes.shape[:-2], *root.shape[-2:]))
    return np.asarray(np.linalg.qr(np.concatenate([batch, slopes], axis=-2), mode="r"))


def _variance(root: Array, place: int) -> Array:
    """Return the variance of one coordinate, given roots of the information."""
    unit = np.eye(root.shape[-1])[:, place : place + 1]
    return np.asarray(np.square(np.linalg.solve(root.swapaxes(-1, -2), unit)).sum(axis=(-2, -1)))


def _needed(root: Array, gains: Array, place: int) -> Array:
    """Return how many measurements at each incidence divide a variance by four."""
    wanted = _variance(root, place) / HALVED

    def suffices(times: Array) -> NDArray[np.bool_]:
        more = np.sqrt(times)[:, np.newaxis, np.newaxis] * gains
        return np.asarray(_variance(_joined(root, more), place) <= wanted)

    low, high = np.full(len(gains), -3.0), np.full(len(gains), log10(WORTHWHILE))
    never = ~suffices(10.0**high)
    for _ in range(40):
        middle = 0.5 * (low + high)
        enough = suffices(10.0**middle)
        low, high = np.where(enough, low, middle), np.where(enough, middle, high)
    return np.where(never, inf, 10.0**high)
