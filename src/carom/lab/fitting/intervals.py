"""Intervals by profile likelihood; what data do not determine, and what is taken for granted."""

from collections import defaultdict
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from math import floor, inf, isfinite, isnan, log, log10, nan
from typing import Any

import numpy as np
from scipy.special import chdtri

from carom.dimensionless.rebounds import THROUGHOUT
from carom.io.cells import Mask
from carom.io.remedies import REMEDIES
from carom.lab.fitting.estimation import WEAK, Best, Information, estimate
from carom.lab.fitting.model import KAPPA, OFFSET, RESTITUTION, Model, plain, ranged
from carom.lab.fitting.plates import THICKNESS
from carom.lab.fitting.problem import RobustLoss
from carom.quantities.arrays import Array
from carom.quantities.glossary import GLOSSARY
from carom.quantities.prefixes import Printed, shared
from carom.quantities.refusals import InputError
from carom.quantities.units import or_none

ELASTIC_KAPPA = (2.0 / 3.0, 1.0)  # for Poisson's ratios from 1/2 to 0
AUXETIC_KAPPA = 4.0 / 3.0  # for a Poisson's ratio of -1
CLEAR = 2.0 * log(1000.0)  # of -2 log likelihood, by which the data contradict a bound
CONTRADICTED = float(chdtri(1.0, 0.01))  # by one parameter more, by chance once in 100

ELASTIC_TAKEN = (
    "restitution: taken as 1, since it is neither varied nor fixed; from rows that slip throughout "
    "only friction (1 + restitution) follows"
)
LIMITS: dict[str, tuple[float, float]] = defaultdict(lambda: (0.0, inf))  # what is possible at all
LIMITS |= {"restitution": (0.0, 1.0), "tangential_restitution": (-1.0, 1.0)}
LIMITS["spin_offset"] = (-inf, inf)
TRIES = 4  # fits of which the ends are searched for, each better than the one before
FIRST = 4.0  # parts of the range in which an open side is searched for, at first
ROUNDS, CLOSE = 16, 2e-3  # at most; of the distance at which the loss has risen enough
HELD_FIRST = (OFFSET, THICKNESS, "restitution", "tangential_restitution", "kappa", "friction")
EXAMPLES = {"restitution": 0.98, "kappa": 0.82, "friction": 0.1, OFFSET: 0.0, THICKNESS: "3 mm"}
LEAST_PART = 0.25  # of a direction that a parameter of a group has
ROUNDED = 1e-10  # of the information: less is that of rounded difference quotients
WORSE = 0.5  # rise of the loss at which a starting value contradicts the data


@dataclass(frozen=True, eq=False)
class ProfiledFit:
    """A fit, and the ends of its intervals: coordinates (parameters, 2, parameters), low end first.

    `open` tells where the loss did not rise enough up to the end of the range.
    """

    best: Best
    ends: Array
    open: Mask


def profiled(best: Best, confidence: float) -> ProfiledFit:
    """Return a fit with the ends of its intervals, or a better fit if the search meets one.

    The loss may rise by its spread times a quantile of chi squared, or of F. Where weights change
    with the parameters so that better fits never end, the last one counts.
    """
    for last in range(TRIES):
        rises = np.repeat(best.rises(confidence), 2)
        profile, better = _profile(best, rises, whatever=last == TRIES - 1)
        if better is None:
            break
        best = estimate(best.model, best.loss, better[np.newaxis])
    return profile


def _profile(best: Best, rises: Array, whatever: bool) -> tuple[ProfiledFit, Array | None]:
    """Return both ends of all intervals, searched for at once, and a better fit if one was met.

    `rises`, of shape (2 parameters,), is what the loss may rise by, the other parameters following;
    `whatever` tells to go on beyond a better fit.
    """
    (low, high), count = best.model.bounds, len(best.at)
    which, sides = np.repeat(np.arange(count), 2), np.tile([-1.0, 1.0], count)
    own, place = best.at[which], (np.arange(2 * count), which)
    limits = np.where(sides < 0.0, low[which], high[which])
    others = np.arange(count) != which[:, np.newaxis]
    covariance = best.information.covariance[which]
    variance = covariance[place]
    directions = covariance / variance[:, np.newaxis]  # how the others follow, to first order
    width = np.minimum(np.sqrt(rises) * np.sqrt(variance), ((high - low) / FIRST)[which])
    inner, outer = np.zeros((2, 2 * count)), np.full((2, 2 * count), np.inf)
    at = np.tile(best.at, (2 * count, 1))
    ends, done, rise = at.copy(), np.zeros(2 * count, dtype=bool), np.zeros(2 * count)
    better = None
    for _ in range(ROUNDS):
        target = np.clip(own + sides * width, low[which], high[which])
        start = at + directions * (target - at[place])[:, np.newaxis]
        start[place] = target
        at, sums = best.descended(start, others)
        excess = (sums - best.sum) / rises
        if np.any(excess < -0.02) and not whatever:
            better = at[np.argmin(excess)]
            break
        ends = np.where(done[:, np.newaxis], ends, at)
        rise = np.where(done, rise, excess)
        root = np.sqrt(np.maximum(excess, 0.0))
        done |= (np.abs(root - 1.0) < CLOSE) | ((root < 1.0) & (target == limits))
        if done.all():
            break
        met = np.abs(target - own), root
        inner, outer = np.where(root < 1.0, met, inner), np.where(root < 1.0, outer, met)
        width = _next_distance(inner, outer)
    opened = (ends[place] == limits) & (rise < 1.0 - CLOSE)
    return ProfiledFit(best, ends.reshape(-1, 2, count), opened.reshape(-1, 2)), better


def _next_distance(inner: Array, outer: Array) -> Array:
    """Return the next distance from the fit to try: a secant in a bracket, or farther out.

    Each end of a bracket is a distance and the root of the rise of the loss there.
    """
    (inside, root_in), (outside, root_out) = inner, outer
    with np.errstate(invalid="ignore", divide="ignore"):
        bracket = outside - inside
        part = np.clip((1.0 - root_in) / (root_out - root_in), 0.05, 0.95)
        secant = inside + np.where(np.isfinite(bracket), bracket * part, 0.0)
        farther = inside * np.clip(1.02 / np.maximum(root_in, 1e-9), 1.05, 3.0)
    return np.asarray(np.where(np.isfinite(outside), secant, farther))


@dataclass(frozen=True, eq=False)
class Settled:
    """The best fit of what the data tell, and the groups of parameters that they do not tell.

    Of each group the first parameter is held, at a value from `start`; `whole` is the fit before
    that, and `unbounded` that with any kappa. `taken` notes what was taken for granted.
    """

    best: Best
    groups: tuple[tuple[str, ...], ...]
    whole: Best
    unbounded: Best
    start: Mapping[str, float]
    taken: tuple[str, ...] = ()


def settle(
    model: Model, loss: RobustLoss, start: Mapping[str, float], taken: tuple[str, ...] = ()
) -> Settled:
    """Fit, and hold one parameter after the other until the data tell all that are free."""
    unbounded = estimate(model, loss)
    whole = within_elastic_range(unbounded)
    return Settled(*without_weak(whole, start), whole, unbounded, start, taken)


def without_weak(
    whole: Best, start: Mapping[str, float]
) -> tuple[Best, tuple[tuple[str, ...], ...]]:
    """Return the fit with one parameter after the other held, and the groups that are not told."""
    best = whole
    groups: list[tuple[str, ...]] = []
    while group := weak_group(best.information, best.model.free):
        groups.append(group)
        if len(best.model.free) == 1:
            break
        best = _held(best, group, start[group[0]])
    return best, tuple(groups)


def weak_group(information: Information, names: tuple[str, ...]) -> tuple[str, ...]:
    """Return the parameters of a direction in which the values hardly change, to be held first."""
    if not names:
        return ()
    alone = np.sqrt(np.diag(information.matrix)) < WEAK
    if alone.any():
        return (names[int(np.argmax(alone))],)
    sizes, directions = np.linalg.eigh(information.matrix)
    if sizes[0] >= max(WEAK**2, ROUNDED * sizes[-1]):
        return ()
    members = [n for n, part in zip(names, directions[:, 0], strict=True) if abs(part) > LEAST_PART]
    return tuple(sorted(members, key=lambda name: HELD_FIRST.index(plain(name))))


def _held(best: Best, group: tuple[str, ...], start: float) -> Best:
    """Return the fit with the first of a group held where it starts, or where it was.

    It is held where it starts if the data allow that: with the others of its group following, or
    with all others as they are if it is alone. The fit goes on from where it was: elsewhere the
    data may tell what they do not tell here.
    """
    name = group[0]
    others = best.at[np.newaxis, [each != name for each in best.model.free]]
    held = replace(best, model=best.model.holding(name, start))
    at = others if len(group) == 1 else held.descended(others).at
    rise = float(np.square(held.roots(at)).sum()) - best.sum
    if rise < WORSE * best.spread:
        return estimate(held.model, best.loss, at)
    return estimate(best.model.holding(name, best.values[name]), best.loss, others)


def reason(group: tuple[str, ...], best: Best) -> str:
    """Return why the data do not tell a group of parameters."""
    if len(group) > 1:
        fix = REMEDIES.get().fix.format(name=group[0], value=EXAMPLES[group[0]])
        others = f"fix one of them, e.g. {fix}"
        if set(group) == {"friction", "restitution"}:
            cure = f"{others}, or measure normal_restitution"
            return f"only friction (1 + restitution) matters; {cure}"
        *most, last = sorted(group)
        return f"the data determine {', '.join(most)} and {last} only together; {others}"
    name, regimes = group[0], best.model.regimes(best.at)
    if name == "kappa" and np.all(regimes == THROUGHOUT):
        return "every row slips throughout, where the stiffness does not matter"
    if name == "friction" and np.all(regimes == 0):
        return "every row sticks from the first touch, where friction hardly matters"
    if name == "restitution":
        return "nothing that was measured depends on it; measure normal_restitution, too"
    return "over its whole range it changes the values by less than their scatter"


def elastic_bounds(model: Model) -> tuple[float, float] | None:
    """Return the range of elastic bodies, if kappa is kept in it."""
    own = next((each for each in model.law.parameters if each.name == KAPPA.name), KAPPA)
    return None if own == KAPPA else ranged(own, model.problem)[1:3]


def within_elastic_range(best: Best) -> Best:
    """Return the fit with kappa in the range of elastic bodies, unless the data contradict that.

    The kappa of like bodies is 2 (1 - nu)/(2 - nu); that of unlike ones lies between those of each.
    """
    if KAPPA.name not in best.model.free:
        return best
    low, high = ELASTIC_KAPPA
    if best.model.problem.pair.kappa > high:
        high = AUXETIC_KAPPA
    inner = KAPPA._replace(low=low, high=high)
    law = best.model.law
    parameters = tuple(inner if each == KAPPA else each for each in law.parameters)
    bounded = replace(best.model, law=replace(law, parameters=parameters))
    if low <= best.values[KAPPA.name] <= high:
        return replace(best, model=bounded)
    inside = estimate(bounded, best.loss)
    return inside if inside.deviance - best.deviance < CLEAR else best


def refuse_contradicted(best: Best) -> None:
    """Raise InputError if the data contradict the restitution of 1 that nobody has given.

    They do if a restitution of its own makes them likelier than chance does in one of 100 sets.
    """
    name = RESTITUTION.name
    if best.model.problem.count <= len(best.model.free) + 1:  # too few to tell
        return
    freed = estimate(best.model.freeing([name]), best.loss)
    if best.deviance - freed.deviance > CONTRADICTED:
        said = round(freed.values[name], 2)
        fix = REMEDIES.get().fix.format(name=name, value=said)
        words = f"it would be held at 1, but the data say about {said}"
        raise InputError(f"{name}: {words}; add it to vary, or fix it, e.g. {fix}")


@dataclass(frozen=True)
class Estimate(Printed):
    """A fitted parameter: name, value, interval from low to high, or the reason why it has none.

    An end of the interval that the data leave open is the end of the possible values: 0, 1 or
    infinity. If the data do not determine a parameter, its ends are NaN, `reason` says why, and its
    value is what was assumed. If a parameter was not varied, its ends are NaN and there is no
    reason. `elastic` is what the elastic constants of the bodies give for kappa and chi.

    Examples
    --------
    >>> str(Estimate("friction", 0.0921, 0.0914, 0.0928))
    '0.0921 (0.0914 to 0.0928)'
    """

    name: str
    value: float
    low: float = nan
    high: float = nan
    reason: str = ""
    elastic: float = nan

    @property
    def determined(self) -> bool:
        """Whether there is an interval, also one with an open end."""
        return not isnan(self.low)

    @property
    def limits(self) -> tuple[float, float]:
        """The least and the largest value that is possible at all."""
        return LIMITS[self.name]

    @property
    def open(self) -> bool:
        """Whether an end of the interval is open."""
        lowest, highest = self.limits
        return self.determined and (self.low == lowest or self.high == highest)

    def to_dict(self) -> dict[str, Any]:
        """Return value, ends and reason as plain numbers and texts; what is open is None."""
        names = ("value", "low", "high", *(() if isnan(self.elastic) else ("elastic",)))
        numbers = {name: or_none(getattr(self, name)) for name in names}
        return {**numbers, "determined": self.determined, "reason": self.reason}

    @property
    def cells(self) -> tuple[str, str]:
        """The value, and from where to where its interval goes or why there is none."""
        (lowest, highest), quantity = self.limits, GLOSSARY[self.name]
        if self.reason:
            return "not determined", self.reason
        if not self.determined:
            return quantity.text(self.value, 4), "not varied"
        if self.low == lowest:
            return quantity.text(self.value, 4), f"at most {quantity.text(self.high, 4)}"
        if self.high == highest:
            return quantity.text(self.value, 4), f"at least {quantity.text(self.low, 4)}"
        digits = significant(self.value, self.high - self.low)
        numbers, unit = shared((self.low, self.value, self.high), quantity.unit, digits)
        value = numbers[1] if unit == "1" else f"{numbers[1]} {unit}"
        return value, f"{numbers[0]} to {numbers[2]}"

    def __str__(self) -> str:
        value, interval = self.cells
        if self.reason:
            return f"{value}: {interval}"
        closed = self.determined and not self.open
        return f"{value} ({interval})" if closed else f"{value}, {interval}"


def estimate_of(fit: ProfiledFit, name: str) -> Estimate:
    """Return the estimate of a parameter, with the reason if it was fitted and has no end."""
    best, model, value = fit.best, fit.best.model, fit.best.values[name]
    if name not in model.free:
        return Estimate(name, value)
    place = model.free.index(name)
    bounds = elastic_bounds(model) if name == KAPPA.name else None
    if fit.open[place].all() and bounds is None:
        return Estimate(name, value, reason=reason((name,), best))
    ends = model.values(fit.ends[place])[name][:, 0]
    limits = zip(ends, bounds or LIMITS[name], fit.open[place], strict=True)
    low, high = (float(limit if is_open else end) for end, limit, is_open in limits)
    return Estimate(name, value, low, high)


def mapped(each: Estimate, name: str, function: Callable[[float], float]) -> Estimate:
    """Return the estimate of another parameter, which grows with one."""
    value, low, high = map(function, (each.value, each.low, each.high))
    return Estimate(name, value, low, high, each.reason)


def significant(value: float, width: float) -> int:
    """Return how many digits of a value to show, two of the width of its interval."""
    if not (isfinite(width) and width > 0.0 and value):
        return 4
    return max(2, min(8, 2 + floor(log10(abs(value))) - floor(log10(width))))
