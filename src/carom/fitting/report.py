"""The result of a fit in words."""

from itertools import chain

import numpy as np

from carom.fitting.errors import least_error
from carom.fitting.estimates import LIMITS, FitRecord
from carom.fitting.estimation import Best
from carom.fitting.intervals import ProfiledFit, Settled

AT_END = 1e-6  # of a coordinate from an end of its range
FAR = 4.0  # standard deviations of an outlier
COLUMN = 14


def as_text(fit: FitRecord) -> str:
    """Return a small table of the parameters, and what else is to be known."""
    problem = fit.best.model.problem
    head = (
        f"{problem.count} value{'s' * (problem.count != 1)} of {', '.join(problem.responses)} in "
        f"{len(problem.rows)} row{'s' * (len(problem.rows) != 1)}; "
        f"intervals of {100.0 * fit.confidence:g} % by profile likelihood"
    )
    lines = [head, *(f"  {name:{COLUMN}s} {each}" for name, each in fit.estimates.items())]
    regimes = ", ".join(f"{name}: {count}" for name, count in fit.regimes.items() if count)
    lines.append(f"rows by regime: {regimes}")
    lines += [f"note: {note}" for note in fit.notes]
    return "\n".join([*lines, str(fit.comparison)])


def notes(found: ProfiledFit, settled: Settled) -> tuple[str, ...]:
    """Return what is to be known besides the numbers."""
    best = found.best
    problem = best.model.problem
    lines = [*_about_errors(best), *_about_outliers(best), *_about_regimes(found)]
    lines += [*_about_ranges(best), *_about_others(best, settled)]
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
            lines.append(f"{name}: standard deviation {size:.2g} from the scatter")
        elif best.scale[place] > 1.0:
            lines.append(
                f"{name}: the scatter is {best.scale[place]:.1f} times what the errors allow; "
                "they were enlarged"
            )
        if np.any(problem.errors[:, place] < least[place]):
            lines.append(
                f"{name}: errors below {least[place]:.2g} count as that; the curves are no better"
            )
    return lines


def _about_ranges(best: Best) -> list[str]:
    """Return which parameters lie at an end of the range in which they are searched for."""
    lines = []
    for parameter, at, low, high in zip(
        best.model.parameters, best.at, *best.model.bounds, strict=True
    ):
        ends = {parameter.low: at - low, parameter.high: high - at}
        for end, distance in ends.items():
            if distance < AT_END and end not in LIMITS[parameter.name]:
                reach = f"from {parameter.low:.3g} to {parameter.high:.3g}"
                lines.append(f"{parameter.name}: best at an end of its range, {reach}")
    return lines


def _about_outliers(best: Best) -> list[str]:
    far = np.asarray((np.abs(best.residuals) > FAR).any(axis=1))
    rows = best.model.problem.rows
    return [f"outliers: {rows.named(far)}"] if far.any() else []


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
    return [f"regime within the intervals not certain: {model.problem.rows.named(unsure)}"]


def _about_others(best: Best, settled: Settled) -> list[str]:
    """Return another minimum that the data do not exclude, apart in what they seem to tell."""
    whole, told = settled.whole, set(best.model.free) - set(chain(*settled.groups))
    rivals, model = whole.rivals, whole.model
    near = rivals.sums - rivals.sums[0] < 4.0 * whole.spread
    known = [name in told for name in model.free]
    apart = np.any(np.abs(rivals.at - model.coordinates(best.values))[:, known] > 0.1, axis=1)
    lines = []
    for point in rivals.at[near & apart][:1]:
        values = model.values_at(point)
        shown = ", ".join(f"{name} {values[name]:.3g}" for name in model.free)
        lines.append(f"fits nearly as well: {shown}")
    return lines
