"""What a fit found: parameters with intervals, or why there is none."""

from collections import defaultdict
from collections.abc import Callable
from dataclasses import dataclass
from math import floor, inf, isfinite, isnan, log10, nan
from typing import Any

from carom.fitting.intervals import ProfiledFit, elastic_bounds, reason
from carom.fitting.model import KAPPA
from carom.quantities.glossary import GLOSSARY
from carom.quantities.prefixes import shared
from carom.quantities.shown import Printed
from carom.quantities.units import or_none

LIMITS: dict[str, tuple[float, float]] = defaultdict(lambda: (0.0, inf))  # what is possible at all
LIMITS |= {"restitution": (0.0, 1.0), "tangential_restitution": (-1.0, 1.0)}
LIMITS["spin_offset"] = (-inf, inf)


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

    def mapped(self, name: str, function: Callable[[float], float]) -> "Estimate":
        """Return the estimate of another parameter, which grows with this one."""
        value, low, high = map(function, (self.value, self.low, self.high))
        return Estimate(name, value, low, high, self.reason)

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


def significant(value: float, width: float) -> int:
    """Return how many digits of a value to show, two of the width of its interval."""
    if not (isfinite(width) and width > 0.0 and value):
        return 4
    return max(2, min(8, 2 + floor(log10(abs(value))) - floor(log10(width))))
