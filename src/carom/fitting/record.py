"""The result of a fit."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from math import floor, inf, isfinite, isnan, log10, nan
from pathlib import Path
from typing import TYPE_CHECKING, Any

from carom.fitting.estimation import Best
from carom.pairs import Pair

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure

    from carom.fitting.advice import Advice
    from carom.fitting.comparison import Comparison

LIMITS = {  # what a parameter can be at all
    "friction": (0.0, inf),
    "kappa": (0.0, inf),
    "chi": (0.0, inf),
    "restitution": (0.0, 1.0),
    "tangential_restitution": (-1.0, 1.0),
    "spin_offset": (-inf, inf),
}
UNITS = {"spin_offset": "rad/s"}


@dataclass(frozen=True)
class Estimate:
    """A parameter: its value, the ends of its interval, and why there is none if so.

    An end that the data leave open is that of what is possible: 0, 1, infinity. An undetermined
    parameter has NaN as ends, a reason, and as value what was assumed; one that was not varied has
    NaN as ends and no reason.
    """

    name: str
    value: float
    low: float = nan
    high: float = nan
    reason: str = ""

    @property
    def determined(self) -> bool:
        """Whether there is an interval, be it with an open end."""
        return not isnan(self.low)

    @property
    def open(self) -> bool:
        """Whether an end is open."""
        lowest, highest = LIMITS[self.name]
        return self.determined and (self.low == lowest or self.high == highest)

    def __str__(self) -> str:
        lowest, highest = LIMITS[self.name]
        unit = f" {UNITS[self.name]}" if self.name in UNITS else ""
        if self.reason:
            return f"not determined: {self.reason}"
        if not self.determined:
            return f"{self.value:.4g}{unit}, held"
        if self.low == lowest:
            return f"{self.value:.4g}{unit}, at most {self.high:.4g}{unit}"
        if self.high == highest:
            return f"{self.value:.4g}{unit}, at least {self.low:.4g}{unit}"
        digits = significant(self.value, self.high - self.low)
        low, value, high = (f"{each:.{digits}g}" for each in (self.low, self.value, self.high))
        return f"{value}{unit} ({low} to {high})"


def significant(value: float, width: float) -> int:
    """Return how many digits of a value to show, two of the width of its interval.

    Examples
    --------
    >>> significant(0.0921, 0.0014), significant(-3.0, 40.0)
    (3, 2)
    """
    if not (isfinite(width) and width > 0.0 and value):
        return 4
    return max(2, min(8, 2 + floor(log10(abs(value))) - floor(log10(width))))


@dataclass(frozen=True, eq=False)
class Fit:
    """Parameters from measured rebounds; made by `carom.fit`.

    `estimates` holds friction, kappa, chi, restitution and spin_offset by name, `fit["friction"]`
    one of them. `regimes` counts the rows by regime, `notes` says what else is to be known.

    Examples
    --------
    >>> import carom
    >>> found = carom.fit(carom.datasets.load("kharaz2001"))
    >>> found.friction.low < 0.092 < found.friction.high  # that of the literature
    True
    """

    estimates: Mapping[str, Estimate]
    confidence: float
    regimes: Mapping[str, int]
    notes: tuple[str, ...]
    best: Best = field(repr=False)

    def __getitem__(self, name: str) -> Estimate:
        return self.estimates[name]

    @property
    def friction(self) -> Estimate:
        """Coefficient of friction mu."""
        return self.estimates["friction"]

    @property
    def kappa(self) -> Estimate:
        """Ratio of tangential to normal contact stiffness."""
        return self.estimates["kappa"]

    @property
    def chi(self) -> Estimate:
        """(kappa/2)(m_n/m_t)."""
        return self.estimates["chi"]

    @property
    def restitution(self) -> Estimate:
        """Normal restitution e."""
        return self.estimates["restitution"]

    @property
    def spin_offset(self) -> Estimate:
        """Initial spin besides what was meant, in rad/s."""
        return self.estimates["spin_offset"]

    @property
    def pair(self) -> Pair:
        """The bodies with the fitted friction."""
        bodies = self.best.model.problem.pair
        return Pair(bodies.first, bodies.second, self.friction.value)

    @property
    def lmfit_result(self) -> Any:
        """What lmfit returned, in transformed coordinates: log friction, log kappa."""
        return self.best.result

    @cached_property
    def comparison(self) -> "Comparison":
        """Akaike's criterion of the exact law, rigid Coulomb and Walton's, on the same data."""
        from carom.fitting.comparison import compare

        return compare(self.best)

    def advice(self, n: int = 5, parameter: str | None = None) -> "Advice":
        """Return which incidences to measure next, n of them, and what that would give."""
        from carom.fitting.advice import advise

        return advise(self, n, parameter)

    def posterior(
        self,
        steps: int = 1000,
        seed: int | None = None,
        progress: Callable[[int, int], object] | None = None,
    ) -> "xr.Dataset":
        """Return samples of the posterior by emcee; `progress` is told steps done and to do."""
        from carom.fitting.posterior import sample

        return sample(self, steps, seed, progress)

    def to_dataset(self) -> "xr.Dataset":
        """Return data, fit, curves and intervals as one dataset, from which the figure is drawn."""
        from carom.fitting.datasets import fit_dataset

        return fit_dataset(self)

    def to_dict(self) -> dict[str, Any]:
        """Return the result as plain numbers, texts and lists, for JSON; what is open is None."""
        return {
            "parameters": {name: _plain(each) for name, each in self.estimates.items()},
            "confidence": self.confidence,
            "values": self.best.model.problem.count,
            "rows": len(self.best.model.problem.rows),
            "regimes": dict(self.regimes),
            "notes": list(self.notes),
            "comparison": self.comparison.to_dict(),
        }

    def plot(self, path: str | Path | None = None) -> "Figure":
        """Draw data, curves and residuals; with a path, store the figure there."""
        from carom.plots.fits import plot_fit
        from carom.plots.style import save_figure

        figure = plot_fit(self.to_dataset())
        if path is not None:
            save_figure(figure, path)
        return figure

    def _repr_html_(self) -> str:
        """Return a table and a picture for a notebook."""
        from carom.notebooks import card

        rows = {name: str(estimate) for name, estimate in self.estimates.items()}
        return card("Parameters from rebounds", rows, self.plot(), "\n".join(self.notes))

    def __str__(self) -> str:
        from carom.fitting.report import as_text

        return as_text(self)


def _plain(estimate: Estimate) -> dict[str, Any]:
    numbers = {name: getattr(estimate, name) for name in ("value", "low", "high")}
    plain = {name: value if isfinite(value) else None for name, value in numbers.items()}
    return {**plain, "determined": estimate.determined, "reason": estimate.reason}
