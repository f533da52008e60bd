"""The result of a fit."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from math import isfinite
from pathlib import Path
from typing import TYPE_CHECKING, Any

from carom.bodies.pairs import Pair
from carom.fitting.estimates import Estimate
from carom.fitting.estimation import Best
from carom.io.citations import FITS, SAMPLES, VISCOUS, bibtex, with_doi
from carom.io.progress import Progress

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure

    from carom.fitting.advice import Advice
    from carom.fitting.comparison import Comparison


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
        """Return which incidences to measure next, and what that would give.

        c-optimal design (Atkinson, Donev & Tobias 2007, chapter 10): one more impact at an angle
        adds its expected information.

        Parameters
        ----------
        n : int
            How many measurements.
        parameter : str, optional
            What is to be known better, by default what is known least: friction, kappa, chi,
            restitution or spin_offset.

        Returns
        -------
        Advice
            `places`: n incidences of the contact point, each an `angle` in rad with its `regime`
            and how many measurements there, `needed`, would halve the interval (None if too many);
            `best` the single one that needs fewest; `shorter` the width of the interval after all
            places, in units of the present one.

        Raises
        ------
        InputError
            If the parameter was not to be fitted, or n is below 1.

        Examples
        --------
        >>> import carom
        >>> found = carom.fit(carom.datasets.load("kharaz2001"))
        >>> advised = found.advice(3, "friction")
        >>> len(advised.places), advised.shorter < 1.0
        (3, True)
        """
        from carom.fitting.advice import advise

        return advise(self, n, parameter)

    def posterior(
        self,
        steps: int = 1000,
        seed: int | None = None,
        progress: Progress = None,
    ) -> "xr.Dataset":
        """Return samples of the posterior of what the data determine, along `sample`.

        Walkers move by differential evolution (ter Braak 2006) in emcee (Foreman-Mackey et al.
        2013). The likelihood is exp(-loss/(2 lambda)) with the loss and its spread lambda of the
        fit, the prior even in log friction, log kappa, restitution and spin offset within their
        ranges.

        Parameters
        ----------
        steps : int
            Steps of the walkers, 100 at least, of which a quarter is left out.
        seed : int, optional
            Of the random numbers; the same seed gives the same samples.
        progress : bool or callable, optional
            Whether a bar is shown after two seconds, by default in a notebook and on a terminal; or
            what is called with the steps done and their number.

        Returns
        -------
        xarray.Dataset
            Along `sample`: the parameters that were varied, friction, kappa and restitution as pure
            numbers, spin_offset in rad/s; and chi if kappa was varied. The attributes tell steps,
            seed, autocorrelation_time in steps, and whether it has converged.

        Raises
        ------
        InputError
            If there are too few steps, or emcee is not installed.

        Examples
        --------
        >>> import carom
        >>> found = carom.fit(carom.datasets.load("kharaz2001"))
        >>> samples = found.posterior(100, seed=1)
        >>> bool(abs(samples.friction.mean() - found.friction.value) < 0.01)
        True
        """
        from carom.fitting.posterior import sample

        return sample(self, steps, seed, progress)

    def to_dataset(self) -> "xr.Dataset":
        """Return data, fit, curves and intervals as one dataset, from which the figure is drawn.

        Returns
        -------
        xarray.Dataset
            Along (row, response) measured, error, expected and residual in SI units, and regime
            (row); curve_expected (law, curve, response), curve_low and curve_high (curve, response)
            over curve_incidence (curve) in rad; border (regime_border) in rad; value, low, high and
            reason (parameter); aicc (law).
        """
        from carom.fitting.datasets import fit_dataset

        return fit_dataset(self)

    def to_dict(self) -> dict[str, Any]:
        """Return the result as plain numbers, texts and lists, for JSON; what is open is None.

        Returns
        -------
        dict
            parameters, confidence, values (how many were measured), rows, regimes, notes and
            comparison; SI units.
        """
        return {
            "parameters": {name: _plain(each) for name, each in self.estimates.items()},
            "confidence": self.confidence,
            "values": self.best.model.problem.count,
            "rows": len(self.best.model.problem.rows),
            "regimes": dict(self.regimes),
            "notes": list(self.notes),
            "comparison": self.comparison.to_dict(),
        }

    def cite(self, *, posterior: bool = False) -> str:
        """Return what to cite for this result, and for the data if they tell a DOI, as BibTeX.

        Parameters
        ----------
        posterior : bool
            Whether `posterior` was used, too.

        Returns
        -------
        str
            Entries of BibTeX, one after the other.

        Examples
        --------
        >>> import carom
        >>> found = carom.fit(carom.datasets.load("kharaz2001"), fixed={"restitution": 1.0})
        >>> [line for line in found.cite().splitlines() if line.startswith("@")][-2:]
        ['@software{newville2014,', '@article{kharaz2001,']
        """
        lossy = (VISCOUS,) if self.restitution.value < 1.0 else ()
        keys = (*FITS, *lossy, *(SAMPLES if posterior else ()))
        doi = self.best.model.problem.doi
        return "\n".join([bibtex(*keys), *([with_doi(doi)] if doi else [])])

    def plot(self, path: str | Path | None = None) -> "Figure":
        """Draw data, curves and residuals.

        Parameters
        ----------
        path : str or Path, optional
            Where the figure is stored, too: .png, .pdf or .svg.

        Returns
        -------
        matplotlib.figure.Figure
            The figure.

        Raises
        ------
        InputError
            If the name ends otherwise or the file cannot be written.

        Examples
        --------
        >>> import carom
        >>> len(carom.fit(carom.datasets.load("kharaz2001")).plot().axes) > 1
        True
        """
        from carom.plots.fits import plot_fit
        from carom.plots.style import save_figure

        figure = plot_fit(self.to_dataset())
        if path is not None:
            save_figure(figure, path)
        return figure

    def _repr_html_(self) -> str:
        """Return a table and a picture for a notebook."""
        from carom.plots.result import card

        rows = {name: str(estimate) for name, estimate in self.estimates.items()}
        return card("Parameters from rebounds", rows, self.plot(), "\n".join(self.notes))

    def __str__(self) -> str:
        from carom.fitting.report import as_text

        return as_text(self)


def _plain(estimate: Estimate) -> dict[str, Any]:
    numbers = {name: getattr(estimate, name) for name in ("value", "low", "high")}
    plain = {name: value if isfinite(value) else None for name, value in numbers.items()}
    return {**plain, "determined": estimate.determined, "reason": estimate.reason}
