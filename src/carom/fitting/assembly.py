"""From the best fit to the result: intervals, what is not determined, regimes, notes."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from math import nan

import numpy as np

from carom.fitting.estimates import LIMITS, Estimate
from carom.fitting.estimation import Best, estimate
from carom.fitting.intervals import Profile, Settled, profile, reason, rise_of, row_regimes
from carom.fitting.laws import half_ratio
from carom.fitting.report import notes
from carom.fitting.result import Fit
from carom.impacts.curves import REGIMES

TRIES = 4  # better fits that the search for the ends may meet
PRODUCT = {"friction", "restitution"}


@dataclass(frozen=True, eq=False)
class Told:
    """A fit, and the ends of the intervals of its free parameters."""

    best: Best
    ends: Profile

    def estimate_of(self, name: str) -> Estimate:
        """Return the estimate of a free parameter; without a reason yet if it has no end."""
        model = self.best.model
        place = model.free.index(name)
        value = float(model.values(self.best.at[np.newaxis])[name][0, 0])
        if self.ends.open[place].all():
            return Estimate(name, value)
        ends = model.values(self.ends.ends[place])[name][:, 0]
        known = zip(ends, LIMITS[name], self.ends.open[place], strict=True)
        low, high = (float(limit if is_open else end) for end, limit, is_open in known)
        return Estimate(name, value, low, high)


def told(best: Best, confidence: float) -> Told:
    """Return the ends of the intervals, from a better fit if the search meets one."""
    for _ in range(TRIES):
        ends = profile(best, best.caution * rise_of(confidence, best.freedom))
        if ends.better is None:
            break
        best = estimate(best.model, best.loss, ends.better[np.newaxis])
    return Told(best, ends)


def assembled(settled: Settled, confidence: float) -> Fit:
    """Return the result of a fit."""
    found = told(settled.best, confidence)
    values = found.best.model.values(found.best.at[np.newaxis])
    estimates = {
        name: found.estimate_of(name)
        if name in found.best.model.free
        else Estimate(name, float(values[name][0, 0]))
        for name in ("friction", "kappa", "restitution", "spin_offset")
    }
    for name in found.best.model.free:
        if not estimates[name].determined:
            estimates[name] = replace(estimates[name], reason=reason((name,), found.best))
    estimates |= _undetermined(settled, found, estimates, confidence)
    ordered = {
        "friction": estimates["friction"],
        "kappa": estimates["kappa"],
        "chi": _as_chi(estimates["kappa"], half_ratio(found.best.model.problem.pair)),
        "restitution": estimates["restitution"],
        "spin_offset": estimates["spin_offset"],
    }
    counts = np.bincount(row_regimes(found.best), minlength=len(REGIMES))
    regimes = dict(zip(REGIMES, counts.tolist(), strict=True))
    return Fit(ordered, confidence, regimes, notes(found.best, found.ends), found.best)


def _undetermined(
    settled: Settled, found: Told, estimates: Mapping[str, Estimate], confidence: float
) -> dict[str, Estimate]:
    """Return the estimates of parameters that the data do not tell, or tell from one side only."""
    result: dict[str, Estimate] = {}
    whole: Told | None = None
    for group in settled.groups:
        if len(group) == 1:
            whole = whole or told(settled.whole, confidence)
            one_sided = whole.estimate_of(group[0])
            if one_sided.determined:
                result[group[0]] = one_sided
                continue
        why = reason(group, found.best) + _product(group, found, estimates)
        for name in group:
            result[name] = replace(estimates[name], low=nan, high=nan, reason=why)
    return result


def _product(group: tuple[str, ...], found: Told, estimates: Mapping[str, Estimate]) -> str:
    """Return what is known of mu (1 + e), where only that is."""
    if set(group) != PRODUCT or "friction" not in found.best.model.free:
        return ""
    friction, factor = estimates["friction"], 1.0 + estimates["restitution"].value
    numbers = (factor * each for each in (friction.value, friction.low, friction.high))
    return "; it is {:.4g} ({:.4g} to {:.4g})".format(*numbers)


def _as_chi(kappa: Estimate, half: float) -> Estimate:
    value, low, high = (half * each for each in (kappa.value, kappa.low, kappa.high))
    return Estimate("chi", value, low, high, kappa.reason)
