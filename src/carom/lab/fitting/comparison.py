"""Laws on the same data by Akaike's criterion: of rebound, and of losses against speed."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from math import inf, isfinite, nan
from typing import Any, Generic, TypeVar

import numpy as np
from scipy.special import stdtrit

from carom.bodies.losses import ElasticPlastic, KelvinVoigt, LossLaw, Metal
from carom.bodies.observables import NORMAL
from carom.bodies.pairs import Pair
from carom.io.cells import Mask
from carom.lab.fitting import model as laws, plates
from carom.lab.fitting.estimation import Best, estimate, polished, scan, weighed
from carom.lab.fitting.intervals import Estimate, estimate_of, profiled, settle
from carom.lab.fitting.loss_laws import CONSTANT, ON_PLATE, elastic, laws_of_losses
from carom.lab.fitting.model import EXACT, OFFSET, Model
from carom.lab.fitting.plates import THICKNESS
from carom.lab.fitting.problem import OUTLIER, FitProblem, RobustLoss
from carom.quantities.arrays import Array
from carom.quantities.glossary import GLOSSARY
from carom.quantities.prefixes import span
from carom.quantities.units import or_none

START = {"tangential_restitution": 0.4}  # of a solid sphere that sticks, about
APART = 2.0  # difference of the criterion from which laws are told apart (Burnham & Anderson 2002)
CLEAR = 10.0  # from which one is out of the question
VERDICTS = (  # by how much the criterion of a rival exceeds that of the exact law at least
    (CLEAR, "the data rule out {}"),
    (APART, "{} is less likely than the exact law"),
    (-APART, "the data cannot tell {} from the exact law"),
    (-inf, "{} describes the data better than the exact law"),
)
TOO_FEW = "there are too few values to compare with {}"
SQUARES = RobustLoss(inf)
ALARM = 0.001  # probability of calling a value of a response that has none an outlier
FEWEST, RANGE = 4, 1.2  # values; of the speeds, largest over smallest: below nothing can be told
LEAST_KEPT = 0.75  # of the values: where more lie far off, they are no outliers


@dataclass(frozen=True, eq=False)
class Standing:
    """A law fitted: its criterion, the excess of that over the least, and Akaike's weight."""

    law: str
    criterion: float
    excess: float
    weight: float
    _best: Best = field(repr=False)

    @property
    def cells(self) -> tuple[str, str]:
        """Excess and weight as they are printed."""
        there = isfinite(self.excess)
        return (f"{self.excess:.1f}", f"{self.weight:.3f}") if there else ("-", "-")

    def to_dict(self) -> dict[str, Any]:
        """Return excess and weight, None where they cannot be computed."""
        return {"excess": or_none(self.excess), "weight": or_none(self.weight)}


Kind = TypeVar("Kind", bound=Standing)


@dataclass(frozen=True, eq=False)
class Standings(Generic[Kind]):
    """Standings of laws by Akaike's criterion on the same data, corrected for few values (AICc)."""

    standings: tuple[Kind, ...]

    def __getitem__(self, law: str) -> Kind:
        return {each.law: each for each in self.standings}[law]

    def __iter__(self) -> Iterator[Kind]:
        return iter(self.standings)

    def to_dict(self) -> dict[str, Any]:
        """Return the comparison as plain numbers, by law; what cannot be computed is None."""
        return {each.law: each.to_dict() for each in self.standings}


@dataclass(frozen=True, eq=False)
class LawFit(Standing):
    """A law of rebound fitted."""

    @property
    def values(self) -> dict[str, float]:
        """The parameters of the law, and the offset of the spin if it was fitted."""
        offset = (OFFSET,) if OFFSET in self._best.model.free else ()
        values = self._best.values
        return {name: values[name] for name in (*self._best.model.law.names, *offset)}

    def to_dict(self) -> dict[str, Any]:
        """Return criterion, excess, weight, how much was fitted, and the parameters."""
        fitted = {"free": _free(self._best), "parameters": self.values}
        return {"aicc": or_none(self.criterion), **super().to_dict(), **fitted}


@dataclass(frozen=True, eq=False)
class Comparison(Standings[LawFit]):
    """Standings of laws of rebound, the exact one first, by Akaike's criterion (AICc)."""

    standings: tuple[LawFit, ...]

    @property
    def verdict(self) -> str:
        """What the data say of the laws, in a sentence."""
        exact, parts = self[EXACT.name], []
        for rival in sorted(self.standings, key=lambda s: s.excess):
            gap = rival.criterion - exact.criterion
            words = next((each for least, each in VERDICTS if gap >= least), TOO_FEW)
            parts += [words.format(rival.law)] if rival is not exact else []
        return "; ".join(parts)

    @property
    def rows(self) -> list[tuple[str, ...]]:
        """The laws as a table with its head, the likeliest first."""
        rows: list[tuple[str, ...]] = [("law", "AICc excess", "weight", "parameters")]
        for each in sorted(self.standings, key=lambda s: s.excess):
            values = (f"{n} {GLOSSARY[n].text(value, 4)}" for n, value in each.values.items())
            rows.append((each.law, *each.cells, ", ".join(values)))
        return rows

    def __str__(self) -> str:
        head, *rows = self.rows
        lines = [head, *((f"  {law}", *cells) for law, *cells in rows)]
        table = [f"{law:16s}{excess:>11s}  {weight:>6s}  {x}" for law, excess, weight, x in lines]
        return "\n".join([*table, self.verdict])


def compare(best: Best) -> Comparison:
    """Return the laws on common ground, with the same parameters held, by least squares.

    Values that lie far from the law that describes the others best are left out for all laws, and
    the errors are those of the best law on what is left: none gains by the scatter that it leaves.
    """
    problem, held, fits = best.model.problem, best.model.held, [best]
    for law in (laws.suited(law, problem) for law in laws.RIVALS):
        free = tuple(name for name in (*law.names, OFFSET) if name not in held)
        fits.append(settle(Model(law, problem, free, held), best.loss, START | best.values).best)
    numbers, anew = on_common_ground(fits)
    standings = zip(numbers, [best, *anew[1:]], strict=True)
    return Comparison(tuple(LawFit(each.model.law.name, *n, each) for n, each in standings))


def on_common_ground(fits: Sequence[Best]) -> tuple[list[tuple[float, float, float]], list[Best]]:
    """Return laws fitted anew without the outliers of one of them, by its errors.

    Before them come their criteria, what these exceed the least by, and Akaike's weights; all are
    NaN where there are too few values.
    """
    reference = min(fits, key=criterion)
    problem = reference.model.problem
    kept = replace(problem, measured=np.where(_far(reference), nan, problem.measured))
    if kept.count < LEAST_KEPT * problem.count:
        kept = problem
    models = [replace(each.model, problem=kept) for each in fits]
    pairs = zip(models, fits, strict=True)
    left = [estimate(model, each.loss, each.at[np.newaxis]) for model, each in pairs]
    best = min(left, key=criterion)
    anew = [_refitted(each.model, each.at, best) for each in left]
    criteria = np.array([criterion(each) for each in anew])
    least = np.nanmin(criteria) if np.isfinite(criteria).any() else nan
    weights = np.exp(-0.5 * (criteria - least))
    columns = criteria, criteria - least, weights / np.nansum(weights)
    return [*zip(*(column.tolist() for column in columns), strict=True)], anew


def _far(best: Best) -> Mask:
    """Return which values are outliers: by their errors, or by the scatter of the others.

    Where errors come from the scatter an outlier enlarges its own, and is told by the test of
    extreme studentized deviates (Rosner 1983).
    """
    residuals, present = best.residuals, best.model.problem.present
    far = present & (np.abs(residuals) > OUTLIER)
    for place in np.flatnonzero(best.estimated):
        sizes = np.where(present[:, place], np.abs(residuals[:, place]), -1.0)
        order = np.argsort(-sizes)
        count, most = int(present[:, place].sum()), int((1.0 - LEAST_KEPT) * len(order))
        for out in range(min(most, count - 3)):
            others = sizes[order[out + 1 : count]]
            freedom = others.size - 1
            beyond = stdtrit(freedom, 1.0 - 0.5 * ALARM / (freedom + 2))
            if sizes[order[out]] > beyond * np.sqrt(np.mean(others**2)):
                far[order[: out + 1], place] = True
    return far


def _refitted(model: Model, at: Array, common: Best) -> Best:
    """Return least squares of a law with the errors of another one: no outliers are left."""
    starts = np.concatenate([at[np.newaxis], scan(model, SQUARES, common.sigma)])
    minima = weighed(model, SQUARES, at, common.sigma, common.scale).descended(starts)
    lowest = minima.at[np.argmin(minima.sums)]
    return polished(weighed(model, SQUARES, lowest, common.sigma, common.scale))


def criterion(best: Best) -> float:
    """Return AICc = -2 log L + 2 k n/(n - k - 1) (Hurvich & Tsai 1989); NaN for few values."""
    free, values = _free(best), best.model.problem.count
    price = 2.0 * free * values / (values - free - 1) if values > free + 1 else nan
    return best.deviance + price


def _free(best: Best) -> int:
    """Return how much was fitted: parameters, and errors that were taken from the scatter."""
    return len(best.model.free) + int(best.estimated.sum() + (best.scale > 1.0).sum())


@dataclass(frozen=True, eq=False)
class FitRecord:
    """What a fit found, as data: the parameters by name, rows by regime, notes, the best fit."""

    estimates: Mapping[str, Estimate]
    confidence: float
    regimes: Mapping[str, int]
    notes: tuple[str, ...]
    _best: Best = field(repr=False)

    @property
    def correlations(self) -> dict[str, dict[str, float]]:
        """Correlations of the parameters that were fitted, by the names of both.

        They come from Fisher's information at the best values; that of friction and kappa is
        `correlations["friction"]["kappa"]`.
        """
        free, matrix = self._best.model.free, self._best.information.correlations.tolist()
        told = {name: i for i, name in enumerate(free) if self.estimates[name].determined}
        return {one: {other: matrix[i][j] for other, j in told.items()} for one, i in told.items()}

    @property
    def pair(self) -> Pair:
        """The bodies with the fitted friction, and thickness of a plate."""
        bodies = self._best.model.problem.pair
        if THICKNESS in self.estimates:
            bodies = plates.with_thickness(bodies, self.estimates[THICKNESS].value)
        friction = self.estimates["friction"].value
        return Pair(bodies.first, bodies.second, friction, roughness=bodies.roughness)

    @cached_property
    def comparison(self) -> Comparison:
        """The exact law, rigid Coulomb and Walton's, compared by Akaike's criterion."""
        return compare(self._best)

    @cached_property
    def losses(self) -> "LossComparison | None":
        """Laws of losses, compared on the normal velocities; None unless their speeds differ.

        On a plate, `ZenerPlate` is that its waves take the energy, with a thickness.

        Examples
        --------
        >>> heights = {"drop_height": [0.1, 0.2, 0.4, 0.8],
        ...            "rebound_height": [0.06, 0.1, 0.17, 0.29]}
        >>> print(carom.fit(heights, pair=pair).losses.verdict)
        the restitution depends on the speed as in ElasticPlastic; the data rule out Metal
        """
        return compare_losses(self._best, self.confidence)


@dataclass(frozen=True, eq=False)
class LossFit(Standing):
    """A law of losses fitted to restitutions, with its one parameter."""

    parameter: Estimate

    @property
    def losses(self) -> LossLaw | None:
        """The law with its parameter, as `impact` takes it; None if the bodies have the plate."""
        value = self.parameter.value
        if self.law == ON_PLATE:
            return None
        laws: dict[str, Any] = {"yield_velocity": ElasticPlastic, "flow_stress": Metal}
        law: LossLaw = laws.get(self.parameter.name, KelvinVoigt)(**{self.parameter.name: value})
        return law

    def restitution(self, normal_speed: Array) -> Array:
        """Return the restitution at normal speeds."""
        model = self._best.model
        values = model.values(self._best.at[np.newaxis])
        return np.asarray(model.law.restitution(model.problem.pair, normal_speed, values)[0])

    def to_dict(self) -> dict[str, Any]:
        """Return excess, weight, and the parameter by its name."""
        return {**super().to_dict(), self.parameter.name: self.parameter.to_dict()}


@dataclass(frozen=True, eq=False)
class LossComparison(Standings[LossFit]):
    """Standings of laws of losses, the likeliest first: speeds, measured restitutions, errors.

    Outliers are among them; of several responses the first counts.
    """

    standings: tuple[LossFit, ...]
    speeds: Array
    measured: Array
    errors: Array

    @property
    def verdict(self) -> str:
        """What the data say of the laws, in a sentence."""
        first, *others = self.standings
        if not isfinite(first.excess):
            return "there are too few values to tell laws of losses apart"
        close = [each.law for each in others if not each.excess > APART]
        if close:
            names = " and ".join(each for each in (", ".join(close[:-1]), close[-1]) if each)
            return f"the data cannot tell {first.law} from {names}"
        how = "{} is less likely" if others[0].excess <= CLEAR else "the data rule out {}"
        varies = f"depends on the speed as in {first.law}"
        behaviour = "is the same at all speeds" if first.law == CONSTANT else varies
        return f"the restitution {behaviour}; {how.format(others[0].law)}"

    @property
    def range(self) -> str:
        """The normal speeds before the impacts."""
        return span(float(self.speeds.min()), float(self.speeds.max()), "m/s", 3)

    @property
    def rows(self) -> list[tuple[str, ...]]:
        """The laws as a table with its head, the likeliest first."""
        fitted = ((f"{s.law}: {s.parameter.name} {s.parameter}", *s.cells) for s in self.standings)
        return [("law", "AICc excess", "weight"), *fitted]

    def __str__(self) -> str:
        (_, *head), *rows = self.rows
        wide = max(48, *(len(law) for law, *_ in rows))
        lines = [f"{f'losses at normal speeds of {self.range}':{wide}s}{'  '.join(head)}"]
        lines += [f"  {law:{wide}s} {excess:>8s}  {weight:>6s}" for law, excess, weight in rows]
        return "\n".join([*lines, self.verdict])


def compare_losses(best: Best, confidence: float) -> LossComparison | None:
    """Return laws of losses on the normal velocities of a fit; None where they tell nothing.

    A constant restitution, the viscoelastic solid of one loss time (Kuwabara & Kono 1987), spheres
    that yield (Thornton 1997; Jackson & Green 2005), and the waves of a plate (Zener 1941), on
    common ground as laws of rebound are.
    """
    problem = _normal(best.model.problem)
    if problem is None:
        return None
    own = [
        settle(Model(law, problem, law.names, {OFFSET: 0.0}), best.loss, elastic(law)).best
        for law in laws_of_losses(problem)
    ]
    numbers, fits = on_common_ground(own)
    standings = []
    for place in map(int, np.argsort([criterion for criterion, *_ in numbers])):
        profile = profiled(fits[place], confidence)
        law = profile.best.model.law
        parameter = estimate_of(profile, law.names[0])
        standings.append(LossFit(law.name, *numbers[place], profile.best, parameter))
    speeds, best = problem.motion.normal_speed, standings[0]._best
    scale = 1.0 / speeds if problem.responses[0] == "normal_speed_out" else 1.0
    errors = scale * best.sigma[:, 0] * best.scale[0]
    return LossComparison(tuple(standings), speeds, scale * problem.measured[:, 0], errors)


def _normal(problem: FitProblem) -> FitProblem | None:
    """Return the normal responses alone, if their speeds are known and differ."""
    places = [place for place, name in enumerate(problem.responses) if name in NORMAL]
    if not places or not problem.has_speeds or problem.motion.thickness is not None:
        return None
    there = problem.present[:, places]
    speeds = problem.motion.normal_speed[there.any(axis=1)]
    if there.sum() < FEWEST or speeds.max() < RANGE * speeds.min():
        return None
    names = tuple(problem.responses[place] for place in places)
    measured, errors = problem.measured[:, places], problem.errors[:, places]
    return replace(problem, responses=names, measured=measured, errors=errors)
