"""The exact law against rigid Coulomb and Walton's on the same data, by Akaike's criterion."""

from collections.abc import Iterator
from dataclasses import dataclass, field
from math import isfinite, nan
from typing import Any

import numpy as np

from carom.fitting.estimation import Best
from carom.fitting.intervals import settle
from carom.fitting.laws import EXACT, OFFSET, RIVALS, FittedLaw
from carom.fitting.model import Model
from carom.quantities.units import or_none

START = {"tangential_restitution": 0.4}  # of a solid sphere that sticks, about
APART = 2.0  # difference of the criterion from which laws are told apart (Burnham & Anderson 2002)
CLEAR = 10.0  # from which one is out of the question


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
                parts.append(f"too few values to compare with {rival.law}")
            elif gap > CLEAR:
                parts.append(f"{rival.law} is out of the question")
            elif gap > APART:
                parts.append(f"{rival.law} is less likely")
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
        lines = ["law            AICc - least  weight  parameters"]
        for each in sorted(self.standings, key=lambda s: s.excess):
            shown = ", ".join(f"{name} {value:.4g}" for name, value in each.values.items())
            excess, weight = f"{each.excess:.1f}", f"{each.weight:.3f}"
            if not isfinite(each.criterion):
                excess = weight = "-"
            lines.append(f"  {each.law:14s} {excess:>10s}  {weight:>6s}  {shown}")
        return "\n".join([*lines, self.verdict])


def compare(best: Best) -> Comparison:
    """Return the laws on the data of a fit, with the same parameters held and the same loss."""
    fits = [best, *(_rival(law, best) for law in RIVALS)]
    criteria = np.array([criterion(each) for each in fits])
    least = np.nanmin(criteria) if np.isfinite(criteria).any() else nan
    weights = np.exp(-0.5 * (criteria - least))
    weights /= np.nansum(weights)
    numbers = zip(criteria.tolist(), (criteria - least).tolist(), weights.tolist(), strict=True)
    return Comparison(
        tuple(
            LawFit(each.model.law.name, *known, _free(each), _values(each), each)
            for each, known in zip(fits, numbers, strict=True)
        )
    )


def criterion(best: Best) -> float:
    """Return AICc = -2 log L + 2 k n/(n - k - 1) (Hurvich & Tsai 1989); NaN for few values.

    -2 log L is the sum of losses and the logarithm of the determinant of the covariances.
    """
    present = best.model.problem.present
    diagonal = np.einsum("rjj->rj", best.weights.factors)
    likelihood = best.sum - 2.0 * float(np.log(diagonal[present]).sum())
    values, free = best.model.problem.count, _free(best)
    if values - free - 1 <= 0:
        return nan
    return likelihood + 2.0 * free * values / (values - free - 1)


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
