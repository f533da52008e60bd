"""The exact law against rigid Coulomb and Walton's on the same data, by Akaike's criterion."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from math import inf, isfinite, nan
from typing import Any

import numpy as np
from scipy.special import stdtrit

from carom.fitting.best import Best, likelihood
from carom.fitting.errors import OUTLYING, RobustLoss
from carom.fitting.estimation import estimate, fitted
from carom.fitting.intervals import settle
from carom.fitting.laws import EXACT, OFFSET, RIVALS, FittedLaw
from carom.fitting.least_squares import descend
from carom.fitting.model import Model
from carom.fitting.starts import scan
from carom.io.user_table import Mask
from carom.quantities.arrays import Array
from carom.quantities.glossary import GLOSSARY
from carom.quantities.units import or_none

START = {"tangential_restitution": 0.4}  # of a solid sphere that sticks, about
APART = 2.0  # difference of the criterion from which laws are told apart (Burnham & Anderson 2002)
CLEAR = 10.0  # from which one is out of the question
SQUARES = RobustLoss(inf)
ALARM = 0.001  # probability of calling a value of a response that has none an outlier
LEAST_KEPT = 0.75  # of the values: where more lie far off, they are no outliers


@dataclass(frozen=True, eq=False)
class LawFit:
    """A law fitted: its criterion, how much it exceeds the least, parameters by name.

    `free` counts what was fitted, parameters and errors that were taken from the scatter.
    """

    law: str
    criterion: float
    excess: float
    weight: float
    free: int
    values: dict[str, float]
    best: Best = field(repr=False)


@dataclass(frozen=True, eq=False)
class Comparison:
    """Laws by Akaike's criterion on the same data, corrected for few values (AICc)."""

    standings: tuple[LawFit, ...]

    def __getitem__(self, law: str) -> LawFit:
        return {each.law: each for each in self.standings}[law]

    def __iter__(self) -> Iterator[LawFit]:
        return iter(self.standings)

    @property
    def verdict(self) -> str:
        """What the data say of the laws, in a sentence."""
        exact = self[EXACT.name]
        rivals = sorted((s for s in self.standings if s is not exact), key=lambda s: s.excess)
        parts = []
        for rival in rivals:
            gap = rival.criterion - exact.criterion
            if not isfinite(gap):
                parts.append(f"there are too few values to compare with {rival.law}")
            elif gap > CLEAR:
                parts.append(f"the data rule out {rival.law}")
            elif gap > APART:
                parts.append(f"{rival.law} is less likely than the exact law")
            elif gap >= -APART:
                parts.append(f"the data cannot tell {rival.law} from the exact law")
            else:
                parts.append(f"{rival.law} describes the data better than the exact law")
        return "; ".join(parts)

    def to_dict(self) -> dict[str, Any]:
        """Return the comparison as plain numbers, by law; what cannot be computed is None."""
        return {
            each.law: {
                "aicc": or_none(each.criterion),
                "excess": or_none(each.excess),
                "weight": or_none(each.weight),
                "free": each.free,
                "parameters": each.values,
            }
            for each in self.standings
        }

    def __str__(self) -> str:
        lines = ["law             AICc excess  weight  parameters"]
        for each in sorted(self.standings, key=lambda s: s.excess):
            shown = ", ".join(
                f"{name} {GLOSSARY[name].text(value, 4)}" for name, value in each.values.items()
            )
            excess, weight = f"{each.excess:.1f}", f"{each.weight:.3f}"
            if not isfinite(each.criterion):
                excess = weight = "-"
            lines.append(f"  {each.law:14s} {excess:>10s}  {weight:>6s}  {shown}")
        return "\n".join([*lines, self.verdict])


def compare(best: Best) -> Comparison:
    """Return the laws on common ground, with the same parameters held, by least squares.

    Values that lie far from the law that describes the others best are left out for all laws, and
    the errors are those of the best law on what is left: none gains by the scatter that it leaves.
    """
    own = [best, *(_rival(law, best) for law in RIVALS)]
    fits = on_common_ground(own)
    criteria = np.array([criterion(each) for each in fits])
    numbers = zip(criteria.tolist(), *standing(criteria), strict=True)
    return Comparison(
        tuple(
            LawFit(each.model.law.name, *known, _free(each), _values(each), each)
            for each, known in zip([best, *fits[1:]], numbers, strict=True)
        )
    )


def standing(criteria: Array) -> tuple[list[float], list[float]]:
    """Return by how much each exceeds the least, and Akaike's weights; NaN where there is none."""
    least = np.nanmin(criteria) if np.isfinite(criteria).any() else nan
    weights = np.exp(-0.5 * (criteria - least))
    return (criteria - least).tolist(), (weights / np.nansum(weights)).tolist()


def on_common_ground(fits: Sequence[Best]) -> list[Best]:
    """Return laws fitted anew without the outliers of one of them, with its errors."""
    reference = min(fits, key=criterion)
    problem = reference.model.problem
    kept = replace(problem, measured=np.where(_far(reference), nan, problem.measured))
    if kept.count < LEAST_KEPT * problem.count:
        kept = problem
    models = [replace(each.model, problem=kept) for each in fits]
    left = [
        estimate(model, each.loss, each.at[np.newaxis])
        for model, each in zip(models, fits, strict=True)
    ]
    best = min(left, key=criterion)
    return [_refitted(each.model, each.at, best) for each in left]


def _far(best: Best) -> Mask:
    """Return which values are outliers: by their errors, or by the scatter of the others.

    Where errors come from the scatter an outlier enlarges its own, and is told by the test of
    extreme studentized deviates (Rosner 1983).
    """
    residuals, present = best.residuals, best.model.problem.present
    far = present & (np.abs(residuals) > OUTLYING)
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
    weights = model.weights(at, common.sigma, common.scale)
    starts = np.concatenate([at[np.newaxis], scan(model, SQUARES, common.sigma)])
    found = descend(model.residuals(weights, SQUARES), starts, model.bounds)
    return fitted(model, SQUARES, found.at[np.argmin(found.sums)], common.sigma, common.scale)


def _price(free: int, values: int) -> float:
    """Return what parameters cost, NaN where there are too few values."""
    return 2.0 * free * values / (values - free - 1) if values > free + 1 else nan


def criterion(best: Best) -> float:
    """Return AICc = -2 log L + 2 k n/(n - k - 1) (Hurvich & Tsai 1989); NaN for few values."""
    return likelihood(best) + _price(_free(best), best.model.problem.count)


def _free(best: Best) -> int:
    return len(best.model.free) + int(best.estimated.sum() + (best.scale > 1.0).sum())


def _values(best: Best) -> dict[str, float]:
    """Return the parameters of a law, and the offset of the spin if it was fitted."""
    offset = (OFFSET,) if OFFSET in best.model.free else ()
    values = best.values
    return {name: values[name] for name in (*best.model.law.names, *offset)}


def _rival(law: FittedLaw, best: Best) -> Best:
    """Return another law fitted to the same data."""
    held = best.model.held
    free = tuple(name for name in (*law.names, OFFSET) if name not in held)
    model = Model(law, best.model.problem, free, held)
    return settle(model, best.loss, START | best.values).best
