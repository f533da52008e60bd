"""From the best fit to the result: intervals, what is not determined, regimes, notes."""

from collections.abc import Mapping
from dataclasses import replace
from math import nan

import numpy as np

from carom.fitting.estimates import Estimate, estimate_of
from carom.fitting.intervals import ProfiledFit, Settled, profiled, reason
from carom.fitting.laws import half_ratio
from carom.fitting.options import NAMES
from carom.fitting.report import notes
from carom.fitting.result import Fit
from carom.impacts.curves import REGIMES


def assembled(settled: Settled, confidence: float) -> Fit:
    """Return the result of a fit."""
    found = profiled(settled.best, confidence)
    best, model = found.best, found.best.model
    estimates = {name: estimate_of(found, name) for name in best.values}
    for name in model.free:
        if not estimates[name].determined:
            estimates[name] = replace(estimates[name], reason=reason((name,), best))
    estimates |= _undetermined(settled, found, estimates, confidence)
    estimates["chi"] = _as_chi(estimates["kappa"], half_ratio(model.problem.pair))
    counts = np.bincount(model.regimes(best.at), minlength=len(REGIMES))
    regimes = dict(zip(REGIMES, counts.tolist(), strict=True))
    pair = model.problem.pair
    for name, elastic in (("kappa", pair.kappa), ("chi", pair.chi)):
        estimates[name] = replace(estimates[name], elastic=elastic)
    ordered = {name: estimates[name] for name in NAMES}
    return Fit(ordered, confidence, regimes, notes(found, settled.whole, ordered), best)


def _undetermined(
    settled: Settled, found: ProfiledFit, estimates: Mapping[str, Estimate], confidence: float
) -> dict[str, Estimate]:
    """Return the estimates of parameters that the data do not tell, or tell from one side only."""
    result: dict[str, Estimate] = {}
    whole: ProfiledFit | None = None
    for group in settled.groups:
        if len(group) == 1:
            whole = whole or profiled(settled.whole, confidence)
            one_sided = estimate_of(whole, group[0])
            if one_sided.determined:
                result[group[0]] = one_sided
                continue
        why = reason(group, found.best) + _product(group, found, estimates)
        for name in group:
            result[name] = replace(estimates[name], low=nan, high=nan, reason=why)
    return result


def _product(group: tuple[str, ...], found: ProfiledFit, estimates: Mapping[str, Estimate]) -> str:
    """Return what is known of mu (1 + e), where only that is."""
    if set(group) != {"friction", "restitution"} or "friction" not in found.best.model.free:
        return ""
    friction, factor = estimates["friction"], 1.0 + estimates["restitution"].value
    numbers = (factor * each for each in (friction.value, friction.low, friction.high))
    return "; that product is {:.4g} ({:.4g} to {:.4g})".format(*numbers)


def _as_chi(kappa: Estimate, half: float) -> Estimate:
    value, low, high = (half * each for each in (kappa.value, kappa.low, kappa.high))
    return Estimate("chi", value, low, high, kappa.reason)
