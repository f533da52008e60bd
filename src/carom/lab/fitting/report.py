"""The result of a fit in words, with usual mistakes in tables that would explain a bad one."""

from collections.abc import Iterator, Mapping
from dataclasses import replace
from itertools import combinations
from math import inf, isnan, log, pi
from typing import Any, NamedTuple

import numpy as np

from carom.io.remedies import REMEDIES
from carom.io.user_table import AFTERWARDS
from carom.lab.fitting import plates
from carom.lab.fitting.comparison import FitRecord
from carom.lab.fitting.estimation import Best, estimate, rough_minima
from carom.lab.fitting.groups import about_repeats
from carom.lab.fitting.intervals import (
    ELASTIC_KAPPA,
    LIMITS,
    Estimate,
    ProfiledFit,
    Settled,
    elastic_bounds,
)
from carom.lab.fitting.model import KAPPA, Model
from carom.lab.fitting.plates import THICKNESS
from carom.lab.fitting.problem import OUTLIER, FitProblem, RobustLoss, typical_deviation
from carom.lab.fitting.reading import FROM_SURFACE, UNSIGNED
from carom.quantities.arrays import Array
from carom.quantities.glossary import GLOSSARY
from carom.quantities.refusals import InputError

ANGLES = ("angle", "contact_angle", "rebound_angle", "contact_rebound_angle")
SPINS = ("spin", "spin2", "spin_out")
NAMES = {  # and responses: of the centre, of the contact point, its negative
    "contact_restitution": ("tangential_restitution", "contact_beta"),
    "contact_beta": ("contact_restitution",),
    "tangential_restitution": ("contact_restitution", "contact_beta"),
}
RPM, DEGREE = pi / 30.0, pi / 180.0
OF_SPINS = (  # with the factor, and the unit that it stands for; a radius only matters beside them
    ("spins of the other sign", -1.0, ""),
    ("spins in rad/s, not in rpm", 1.0 / RPM, ""),
    ("those of half the radius (is the radius a diameter?)", 0.5, ""),
    ("those of twice the radius (is the radius half of it?)", 2.0, ""),
    ("spins in rpm", RPM, "rpm"),
    ("spins in rev/s", 2.0 * pi, "rev/s"),
)
ROUGH = 0.1  # of the range of a response, which scatter does not exceed where a law fits
FAR, PART = 20.0, 0.25  # by how much and to which part chi squared must fall
HOPEFUL = 0.9  # of the scatter as given: a rough fit must leave less, in one response at least
LEAST = 0.75  # of the values that must not be outliers then
LIKELIER = 2.0 * log(100.0)  # of -2 log likelihood, with angles from the other side


def _likely_mistake(whole: Best, estimates: Mapping[str, Estimate]) -> Iterator[str]:
    """Yield the mistake with which the data are far likelier than as they stand, if there is one.

    Angles from the surface are always tried, as they may fit well; other mistakes only where
    something is odd: scatter beyond what errors allow or a tenth of the range, or a kappa that the
    bodies cannot have. Each is tried with the kappa of the elastic constants. `whole` is the fit
    with nothing held that was to be found. Raises InputError if the mistake is the unit of spins of
    a file that tells none.
    """
    problem = whole.model.problem
    trials = [*_turned(problem), *(_trials(problem) if _is_odd(whole, estimates) else ())]
    likely = [(*found, each.unit) for each in trials if (found := _tried(whole, each))]
    if not likely:
        return
    _, words, unit = min(likely)
    columns = ((n, c) for n, c in problem.rows.cells.items() if n in (*SPINS, UNSIGNED))
    bare = {each.head: name for name, each in columns if each.letter and not str(each.unit)}
    if unit and bare:
        asked = f"{next(iter(bare.values()))}: no unit; {words}"
        for own in (unit, "rad/s"):
            remedy = REMEDIES.get().columns({head: f"{bare[head]} [{own}]" for head in bare})
            asked += f"; if they are in {own}, {remedy}"
        raise InputError(asked)
    yield words


def _is_odd(best: Best, estimates: Mapping[str, Estimate]) -> bool:
    """Tell whether the data hardly fit as they stand."""
    problem, kappa = best.model.problem, estimates["kappa"]
    low, high = np.nanpercentile(problem.measured, (10.0, 90.0), axis=0)
    sigma = np.where(problem.present, best.sigma, np.nan)
    is_rough = best.estimated & (np.nanmedian(sigma, axis=0) > ROUGH * (high - low))
    varies = np.array([name != "normal_restitution" for name in problem.responses])
    typical = typical_deviation(best.residuals * best.scale, problem.present)
    excluded = kappa.determined and not kappa.low <= problem.pair.kappa <= kappa.high
    at_end = "restitution" in best.model.free and best.values["restitution"] > 1.0 - 1e-6
    return bool(np.any(is_rough & varies) or np.any(typical > 2.0) or excluded or at_end)


class Trial(NamedTuple):
    """What the data may be in truth: words, the problem then, factors of the responses in it.

    A gain of so much likelihood is enough; a unit is that of spins.
    """

    words: str
    problem: FitProblem
    factors: Array
    enough: float = inf
    unit: str = ""


def _turned(problem: FitProblem) -> Iterator[Trial]:
    """Yield the trial with angles from the other side, if those before the impact may be so."""
    before = [values for name, values in problem.before.items() if name in ANGLES]
    if all(np.min(values) > 0.0 for values in before) and _columns(problem, ANGLES):
        turned = {*FROM_SURFACE} & {*problem.rows.columns}
        words = f"angles from the {'normal' if turned else 'surface'}"
        yield _changed(words, problem, ANGLES, -1.0, shift=0.5 * pi)._replace(enough=LIKELIER)


def _trials(problem: FitProblem) -> Iterator[Trial]:
    """Yield what else may have been mistaken in the columns that there are."""
    angles = _columns(problem, ANGLES)
    if angles and all(np.nanmax(np.abs(v)) < 0.5 * pi * DEGREE for v in angles):
        yield _changed("angles in radians", problem, ANGLES, 1.0 / DEGREE)
    if _columns(problem, SPINS):
        for words, factor, unit in OF_SPINS:
            yield _changed(words, problem, SPINS, factor)._replace(unit=unit)
    yield from _swapped(problem)
    for place, name in enumerate(problem.responses):
        for other in set(NAMES.get(name, ())) - set(problem.responses):
            names = (*problem.responses[:place], other, *problem.responses[place + 1 :])
            renamed = replace(problem, responses=names)
            yield Trial(f"{other} in the column {name}", renamed, np.ones(len(names)))


def _columns(problem: FitProblem, names: tuple[str, ...]) -> list[Array]:
    before = [values for name, values in problem.before.items() if name in names]
    places = [place for place, name in enumerate(problem.responses) if name in names]
    return [*before, *problem.measured.T[places]]


def _changed(
    words: str, problem: FitProblem, names: tuple[str, ...], factor: float, shift: float = 0.0
) -> Trial:
    """Return the trial with columns, and their errors, multiplied by a factor, and shifted."""
    chosen = np.array([name in names for name in problem.responses])
    factors = np.where(chosen, factor, 1.0)
    before = {n: shift + factor * v if n in names else v for n, v in problem.before.items()}
    given = problem.before_errors.items()
    changed = replace(
        problem,
        before=before,
        before_errors={n: v * abs(factor) if n in names else v for n, v in given},
        measured=np.where(chosen, shift + factor * problem.measured, problem.measured),
        errors=problem.errors * np.abs(factors),
    )
    return Trial(words, changed, factors)


def _swapped(problem: FitProblem) -> Iterator[Trial]:
    """Yield the trial with columns before and after exchanged, if these have no gaps."""
    pairs = {a: b for a, b in AFTERWARDS.items() if a in problem.before and b in problem.responses}
    places = {b: problem.responses.index(b) for b in pairs.values()}
    after = {a: problem.measured[:, places[b]] for a, b in pairs.items()}
    speeds = [after[name] for name in ("speed", "normal_speed") if name in after]
    if not speeds or not np.all(np.isfinite([*after.values()])) or np.min(speeds) <= 0.0:
        return
    measured = problem.measured.copy()
    for name, other in pairs.items():
        measured[:, places[other]] = problem.before[name]
    swapped = replace(problem, before={**problem.before, **after}, measured=measured)
    words = "the motion before and the motion after exchanged"
    yield Trial(words, swapped, np.ones(len(problem.responses)))


def _tried(best: Best, trial: Trial) -> tuple[float, str] | None:
    """Return -2 log likelihood of the data with a mistake that explains them far better, in words.

    kappa is that of the bodies.
    """
    free = tuple(name for name in best.model.free if name != "kappa")
    held = {**best.model.held, "kappa": best.model.problem.pair.kappa}
    model = replace(best.model, problem=trial.problem, free=free, held=held)
    present = trial.problem.present
    as_given = (best.model.problem.measured - best.expected) * trial.factors
    if not _is_promising(model, best.loss, as_given):
        return None
    other = estimate(model, best.loss)
    kept = present & (np.abs(other.residuals) <= OUTLIER)
    chi2 = float(np.square(other.residuals[kept]).sum())
    size = np.where(present, other.sigma * other.scale, 1.0)
    instead = float(np.square(as_given[kept] / size[kept]).sum())
    few = kept.sum() * log(max(instead, 1e-300) / max(chi2, 1e-300)) < FAR
    few |= instead - chi2 < FAR or chi2 > PART * instead
    changed = 2.0 * float((present.sum(axis=0) * np.log(np.abs(trial.factors))).sum())
    against = other.deviance - changed
    if kept.sum() < LEAST * present.sum() or (few and best.deviance - against < trial.enough):
        return None
    words = f"these data fit as {trial.words}: chi-square {chi2:.3g} instead of {instead:.3g}"
    return against, f"{words}, with {_shown(other, other.values)}"


def _is_promising(model: Model, loss: RobustLoss, as_given: Array) -> bool:
    """Tell whether a response may scatter less than as it was given, by a rough fit."""
    minimum, present = rough_minima(model, loss)[0], model.problem.present
    left = model.problem.measured - model.expected(minimum[np.newaxis])[0]
    if not np.isfinite(left[present]).all():  # ratios to a velocity that is zero then
        return False
    typical = typical_deviation(left, present) < HOPEFUL * typical_deviation(as_given, present)
    return bool(typical.any())


NEAR_END = 1e-6  # of a coordinate from an end of its range
APART = 0.1  # of a coordinate between two minima
COLUMN = 14
ONE_INCIDENCE = (
    "one incidence determines friction or kappa, not both; fix one, or measure at other angles"
)


def as_text(fit: FitRecord) -> str:
    """Return a small table of the parameters, and what else is to be known."""
    problem = fit._best.model.problem
    head = (
        f"{problem.count} value{'s' * (problem.count != 1)} of {', '.join(problem.responses)} in "
        f"{problem.trials} row{'s' * (problem.trials != 1)}; "
        f"in brackets {100.0 * fit.confidence:g} % intervals by profile likelihood"
    )
    lines = [head]
    for name, each in fit.estimates.items():
        elastic = each.determined and not isnan(each.elastic)
        beside = f"; the elastic constants give {each.elastic:.3g}" if elastic else ""
        lines.append(f"  {name:{COLUMN}s} {each}{beside}")
    tells = [*summary(fit), *(f"note: {note}" for note in fit.notes)]
    return "\n".join([*lines, *tells, *([] if problem.is_normal else [str(fit.comparison)])])


def summary(fit: FitRecord) -> list[str]:
    """Return the correlations of the parameters and the rows by regime, where there are some."""
    told = fit.correlations
    pairs = ", ".join(f"{a} and {b} {told[a][b]:+.2f}" for a, b in combinations(told, 2))
    regimes = "; ".join(f"{count} {name}" for name, count in fit.regimes.items() if count)
    by_regime = [] if fit._best.model.problem.is_normal else [f"rows by regime: {regimes}"]
    return [*([f"correlations: {pairs}"] if pairs else []), *by_regime]


def notes(fit: ProfiledFit, settled: Settled, estimates: Mapping[str, Estimate]) -> Iterator[str]:
    """Yield what is to be known besides the numbers."""
    best, whole, problem = fit.best, settled.whole, fit.best.model.problem
    yield from settled.taken
    yield from _about_errors(best)
    yield from about_repeats(best)
    yield from _where("outliers:", problem, (np.abs(best.residuals) > OUTLIER).any(axis=1))
    yield from _about_regimes(fit)
    yield from _about_ranges(best)
    if {"friction", "kappa"} <= set(whole.model.free) and problem.is_one:  # all psi_1 are one
        yield ONE_INCIDENCE
    yield from _about_others(whole, estimates)
    yield from _about_kappa(fit, settled.unbounded, estimates["kappa"])
    yield from _likely_mistake(whole, estimates)
    yield from problem.remarks
    yield from _about_plate(best, estimates)
    if problem.ignored:
        yield f"columns that were not used: {', '.join(problem.ignored)}"
    yield from problem.rows.notes
    yield from problem.rows.about_missing()
    yield from _where("nothing was measured in", problem, ~problem.present.any(axis=1))


def _where(words: str, problem: FitProblem, rows: Any) -> Iterator[str]:
    if rows.any():
        yield f"{words} {problem.rows.named(rows)}"


def _about_errors(best: Best) -> Iterator[str]:
    problem = best.model.problem
    columns = problem.errors.T, problem.present.T, best.sigma.T, best.scale, problem.least_errors
    responses = zip(problem.responses, best.estimated, *columns, strict=True)
    for name, estimated, errors, there, sigma, scale, least in responses:
        text = GLOSSARY[name].text
        if estimated:
            deviation = text(float(np.median(sigma[there & ~np.isfinite(errors)])), 2)
            yield f"{name}: the scatter gives a standard deviation of {deviation}"
        elif scale > 1.0:
            times = f"{scale:.1f} times what the errors allow, so they were enlarged"
            yield f"{name}: the scatter is {times}"
        if np.any(errors < least):
            raised = "were raised to that, the accuracy of the curves that are fitted"
            yield f"{name}: errors below {text(least, 2)} {raised}"


def _about_plate(best: Best, estimates: Mapping[str, Estimate]) -> Iterator[str]:
    """Yield how the restitution follows, and where the theory of a plate does not hold."""
    problem = best.model.problem
    if not problem.on_plate:
        return
    pair, speeds, thickness = problem.pair, problem.motion.normal_speed, estimates.get(THICKNESS)
    of_all: Any = thickness.value if thickness else problem.motion.thickness
    sizes = np.broadcast_to(of_all, speeds.shape)
    e = best.model.law.restitution(pair, speeds, {THICKNESS: sizes})
    yield f"restitution: the plate gives {e.min():.3g} to {e.max():.3g}, the median is shown"
    for finding, bad in plates.doubtful(pair, speeds, sizes):
        yield f"{finding.label}: {finding.verdict} ({problem.rows.named(bad)})"
    if thickness is not None and thickness.high == inf:
        yield "thickness: the data do not tell the plate from a thick wall"
    usual = plates.with_thickness(pair, float(np.median(sizes)))
    fitted = thickness is not None and thickness.determined
    if said := plates.shear(usual, float(np.median(speeds)), problem.responses, fitted=fitted):
        yield said


def _about_ranges(best: Best) -> Iterator[str]:
    """Yield which parameters lie at an end of the range in which they are searched for."""
    coordinates = best.at, *best.model.bounds
    for parameter, at, low, high in zip(best.model.parameters, *coordinates, strict=True):
        if parameter.name == KAPPA.name and elastic_bounds(best.model):
            continue  # told elsewhere
        ends = {parameter.low: at - low, parameter.high: high - at}
        for end, distance in ends.items():
            if distance < NEAR_END and end not in LIMITS[parameter.name]:
                reach = f"from {GLOSSARY[parameter.name].span(parameter.low, parameter.high, 3)}"
                yield f"{parameter.name}: the best value is at an end of the range {reach}"


def _about_kappa(fit: ProfiledFit, unbounded: Best, kappa: Estimate) -> Iterator[str]:
    """Yield what the bodies have to say of kappa, and where their bounds cut or change the fit."""
    model, bounds = fit.best.model, elastic_bounds(fit.best.model)
    if kappa.determined and not kappa.low <= kappa.elastic <= kappa.high:
        differs = f"the interval excludes {kappa.elastic:.3g}, which the elastic constants give"
        can_be = ELASTIC_KAPPA[0] <= kappa.value <= ELASTIC_KAPPA[1]
        beyond = "" if can_be else ", and kappa is 2/3 to 1 for elastic bodies"
        yield f"kappa: {differs}{beyond}; check bodies, units and signs"
    if bounds is None:
        return
    texts = ["2/3" if bound == ELASTIC_KAPPA[0] else f"{bound:.3g}" for bound in bounds]
    why = f"kappa is {' to '.join(texts)} for elastic bodies"
    if KAPPA.name in model.free and (cut := fit.open[model.free.index(KAPPA.name)]).any():
        ends = " and ".join(text for text, there in zip(texts, cut, strict=True) if there)
        yield f"kappa: the interval ends at {ends}, as {why}"
    if not bounds[0] <= unbounded.values[KAPPA.name] <= bounds[1]:
        better = f"would fit better, but not clearly: {_shown(unbounded, unbounded.values)}"
        yield f"kappa: {why}; other values {better}; check bodies, units and signs"


def _shown(best: Best, values: Mapping[str, float]) -> str:
    return ", ".join(f"{name} {GLOSSARY[name].text(values[name], 3)}" for name in best.model.free)


def _about_regimes(fit: ProfiledFit) -> Iterator[str]:
    """Yield which rows may lie in more than one regime, as far as the data can tell."""
    model = fit.best.model
    points = fit.ends.reshape(-1, len(fit.best.at))
    regimes = np.array([model.regimes(point) for point in (fit.best.at, *points)])
    unsure = np.any(regimes != regimes[0], axis=0) & model.problem.present.any(axis=1)
    yield from _where("the regime may differ within the intervals:", model.problem, unsure)


def _about_others(whole: Best, estimates: Mapping[str, Estimate]) -> Iterator[str]:
    """Yield another minimum that the data do not exclude, outside of the intervals."""
    rivals, model = whole.rivals, whole.model
    best = model.coordinates({name: estimates[name].value for name in model.free})
    near = rivals.sums - whole.sum < 4.0 * whole.spread
    for point in rivals.at[near][np.argsort(rivals.sums[near])]:
        values = model.values_at(point)
        far = [name for name, off in zip(model.free, point - best, strict=True) if abs(off) > APART]
        determined = [estimates[name] for name in far if estimates[name].determined]
        if any(not each.low <= values[each.name] <= each.high for each in determined):
            yield f"other values fit nearly as well: {_shown(whole, values)}"
            return
