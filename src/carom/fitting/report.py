"""The result of a fit in words."""

from collections.abc import Mapping
from math import isnan

import numpy as np

from carom.fitting.errors import OUTLYING, least_error
from carom.fitting.estimates import LIMITS, Estimate, FitRecord
from carom.fitting.estimation import Best
from carom.fitting.intervals import ProfiledFit
from carom.fitting.mistakes import likely_mistake
from carom.fitting.problem import FitProblem
from carom.fitting.reading import HEIGHTS, taken_by_air
from carom.quantities.glossary import GLOSSARY

AT_END = 1e-6  # of a coordinate from an end of its range
APART = 0.1  # of a coordinate between two minima
COLUMN = 14
THIN = 2e-3  # part of a restitution that air may take unsaid
POSSIBLE = (2.0 / 3.0, 1.0)  # kappa for Poisson's ratios from 1/2 to 0


def as_text(fit: FitRecord) -> str:
    """Return a small table of the parameters, and what else is to be known."""
    problem = fit.best.model.problem
    head = (
        f"{problem.count} value{'s' * (problem.count != 1)} of {', '.join(problem.responses)} in "
        f"{len(problem.rows)} row{'s' * (len(problem.rows) != 1)}; "
        f"in brackets {100.0 * fit.confidence:g} % intervals by profile likelihood"
    )
    lines = [head, *(f"  {name:{COLUMN}s} {_line(each)}" for name, each in fit.estimates.items())]
    tells = [f"note: {note}" for note in fit.notes]
    if problem.is_normal:
        return "\n".join([*lines, *tells])
    regimes = "; ".join(f"{count} {name}" for name, count in fit.regimes.items() if count)
    return "\n".join([*lines, f"rows by regime: {regimes}", *tells, str(fit.comparison)])


def _line(estimate: Estimate) -> str:
    """Return an estimate, with what the bodies give beside it."""
    if not estimate.determined or isnan(estimate.elastic):
        return str(estimate)
    return f"{estimate}; the elastic constants give {estimate.elastic:.3g}"


def notes(found: ProfiledFit, whole: Best, estimates: Mapping[str, Estimate]) -> tuple[str, ...]:
    """Return what is to be known besides the numbers; `whole` is the fit with nothing held."""
    best = found.best
    problem = best.model.problem
    lines = [*_about_errors(best), *_about_outliers(best), *_about_regimes(found)]
    lines += [*_about_ranges(best), *_about_incidence(whole), *_about_others(whole, estimates)]
    lines += _about_bodies(estimates["kappa"])
    mistake = likely_mistake(whole, estimates)
    if mistake is not None:
        lines.append(mistake)
    lines += _about_air(problem)
    if problem.ignored:
        lines.append(f"columns that were not used: {', '.join(problem.ignored)}")
    gaps = np.asarray(~problem.present.any(axis=1))
    if gaps.any():
        lines.append(f"nothing was measured in {problem.rows.named(gaps)}")
    return tuple(lines)


def _about_errors(best: Best) -> list[str]:
    problem, lines = best.model.problem, []
    least = least_error(problem)
    for place, name in enumerate(problem.responses):
        if best.estimated[place]:
            unknown = problem.present[:, place] & ~np.isfinite(problem.errors[:, place])
            size = float(np.median(best.sigma[unknown, place]))
            told = GLOSSARY[name].text(size, 2)
            lines.append(f"{name}: the scatter gives a standard deviation of {told}")
        elif best.scale[place] > 1.0:
            lines.append(
                f"{name}: the scatter is {best.scale[place]:.1f} times what the errors allow, so "
                "they were enlarged"
            )
        if np.any(problem.errors[:, place] < least[place]):
            lines.append(
                f"{name}: errors below {GLOSSARY[name].text(least[place], 2)} were raised to that, "
                "the accuracy of the curves that are fitted"
            )
    return lines


def _about_air(problem: FitProblem) -> list[str]:
    """Return by how much air falsifies a restitution that comes from heights."""
    if not set(HEIGHTS) <= set(problem.rows.columns):
        return []
    ball = problem.pair.first
    part = taken_by_air(problem.rows.columns, ball.radius, ball.mass)
    if part < THIN:
        return []
    return [f"air: drag makes the restitution about {100.0 * part:.2g} % of its value too small"]


def _about_ranges(best: Best) -> list[str]:
    """Return which parameters lie at an end of the range in which they are searched for."""
    lines = []
    for parameter, at, low, high in zip(
        best.model.parameters, best.at, *best.model.bounds, strict=True
    ):
        ends = {parameter.low: at - low, parameter.high: high - at}
        for end, distance in ends.items():
            if distance < AT_END and end not in LIMITS[parameter.name]:
                reach = f"from {GLOSSARY[parameter.name].span(parameter.low, parameter.high, 3)}"
                lines.append(f"{parameter.name}: the best value is at an end of the range {reach}")
    return lines


def _about_outliers(best: Best) -> list[str]:
    far = np.asarray((np.abs(best.residuals) > OUTLYING).any(axis=1))
    rows = best.model.problem.rows
    return [f"outliers: {rows.named(far)}"] if far.any() else []


def _about_bodies(kappa: Estimate) -> list[str]:
    """Return what the bodies have to say of a kappa that was fitted."""
    if not kappa.determined or kappa.low <= kappa.elastic <= kappa.high:
        return []
    told = f"kappa: the interval excludes {kappa.elastic:.3g}, which the elastic constants give"
    if POSSIBLE[0] <= kappa.value <= POSSIBLE[1]:
        return [f"{told}; check bodies, units and signs"]
    return [f"{told}, and kappa is 2/3 to 1 for elastic bodies; check bodies, units and signs"]


def _about_regimes(found: ProfiledFit) -> list[str]:
    """Return which rows may lie in more than one regime, as far as the data can tell."""
    model = found.best.model
    at_fit = model.regimes(found.best.at)
    unsure = np.zeros(len(at_fit), dtype=bool)
    for point in found.ends.reshape(-1, len(found.best.at)):
        unsure |= model.regimes(point) != at_fit
    unsure &= model.problem.present.any(axis=1)
    if not unsure.any():
        return []
    return [f"the regime may differ within the intervals: {model.problem.rows.named(unsure)}"]


def _about_incidence(whole: Best) -> list[str]:
    """Return that rows at one incidence, whose psi_1 are one, tell one number of two."""
    if not {"friction", "kappa"} <= set(whole.model.free) or not whole.model.problem.is_one:
        return []
    return [
        "one incidence determines friction or kappa, not both; fix one, or measure at other angles"
    ]


def _about_others(whole: Best, estimates: Mapping[str, Estimate]) -> list[str]:
    """Return another minimum that the data do not exclude, outside of the intervals."""
    rivals, model = whole.rivals, whole.model
    found = model.coordinates({name: estimates[name].value for name in model.free})
    near = rivals.sums - whole.sum < 4.0 * whole.spread
    for point in rivals.at[near][np.argsort(rivals.sums[near])]:
        values = model.values_at(point)
        far = [
            name for name, off in zip(model.free, point - found, strict=True) if abs(off) > APART
        ]
        told = [estimates[name] for name in far if estimates[name].determined]
        if any(not each.low <= values[each.name] <= each.high for each in told):
            shown = ", ".join(
                f"{name} {GLOSSARY[name].text(values[name], 3)}" for name in model.free
            )
            return [f"other values fit nearly as well: {shown}"]
    return []
