"""The result of a fit, as users have it."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from math import nan
from typing import TYPE_CHECKING, Any

import numpy as np

from carom.impacts.curves import REGIMES
from carom.io.citations import FITS, PLATE, SAMPLES, VISCOUS, bibtex, with_doi
from carom.io.progress import Progress
from carom.lab.fitting import plates
from carom.lab.fitting.advice import Advice, advise
from carom.lab.fitting.comparison import FitRecord
from carom.lab.fitting.datasets import fit_dataset, sample
from carom.lab.fitting.intervals import (
    Estimate,
    ProfiledFit,
    Settled,
    estimate_of,
    mapped,
    profiled,
    reason,
)
from carom.lab.fitting.model import half_ratio
from carom.lab.fitting.options import NAMES
from carom.lab.fitting.plates import THICKNESS
from carom.lab.fitting.problem import FitProblem
from carom.lab.fitting.report import as_text, notes
from carom.lab.fitting.report_file import Reported, sections_of
from carom.plots.result import Section, card

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure


@dataclass(frozen=True, eq=False)
class Fit(FitRecord, Reported):
    """Parameters from measured rebounds; made by `carom.fit`.

    `estimates` holds friction, kappa, chi, restitution and spin_offset by name, and the thickness
    of a plate; `fit["friction"]` is one of them, with intervals at the level `confidence`.
    `regimes` counts the rows in each regime, `notes` has remarks on the fit.

    Examples
    --------
    >>> found = carom.fit(carom.datasets.load("kharaz2001"))
    >>> found.friction.low < 0.092 < found.friction.high  # that of the literature
    True
    """

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
        """Ratio of inertia to stiffness, (kappa/2)(m_n/m_t)."""
        return self.estimates["chi"]

    @property
    def restitution(self) -> Estimate:
        """Normal coefficient of restitution e; on a plate the median of the rows."""
        return self.estimates["restitution"]

    @property
    def thickness(self) -> Estimate | None:
        """Thickness of the plate in m; None for other bodies, and if the data have it by row."""
        return self.estimates.get(THICKNESS)

    @property
    def spin_offset(self) -> Estimate:
        """Spin that the bodies had before all impacts besides the given one, in rad/s."""
        return self.estimates["spin_offset"]

    @property
    def lmfit_result(self) -> Any:
        """The result of lmfit in transformed coordinates, which are log friction and log kappa."""
        return self._best.result

    def advice(self, n: int = 5, parameter: str | None = None) -> Advice:
        """Return the incidences to measure next, and how much shorter they make an interval.

        This is a c-optimal design (Atkinson, Donev & Tobias 2007, chapter 10): one more impact at
        an angle adds its expected information.

        Parameters
        ----------
        n : int
            Number of further measurements, 1 to 1000.
        parameter : str, optional
            Parameter that shall become more certain, of friction, kappa, chi, thickness,
            restitution and spin_offset; by default the least certain.

        Returns
        -------
        Advice
            `places` has n incidences of the contact point: the `angle` in rad, its `regime`, and
            `needed`, the number of measurements at this angle that would halve the interval (None
            if there are too many). `best` is the incidence that needs the fewest. `shorter` is the
            width of the interval after measuring all places, over the present width.

        Raises
        ------
        InputError
            If the parameter was not to be fitted, or n is out of range.

        Examples
        --------
        >>> found = carom.fit(carom.datasets.load("kharaz2001"))
        >>> advised = found.advice(3, "friction")
        >>> len(advised.places), advised.shorter < 1.0
        (3, True)
        """
        return advise(self, n, parameter)

    def posterior(
        self, steps: int = 1000, seed: int | None = None, progress: Progress = None
    ) -> "xr.Dataset":
        """Return samples of the posterior of the parameters that the data determine.

        Walkers move by differential evolution (ter Braak 2006) in emcee (Foreman-Mackey et al.
        2013). The likelihood is exp(-L/(2 lambda)), with the loss L and its spread lambda of the
        fit. The prior is even in log friction, log kappa, restitution, the inverse square of a
        thickness, and spin offset, within their ranges.

        Parameters
        ----------
        steps : int
            Number of steps of the walkers, 100 to 100000; the first quarter is discarded.
        seed : int, optional
            Seed of the random numbers, not negative; the same seed gives the same samples.
        progress : bool or callable, optional
            Whether a progress bar is shown after two seconds, by default in a notebook and on a
            terminal; or a function that is called with the number of steps done and their total.

        Returns
        -------
        xarray.Dataset
            Along `sample`: the parameters that were varied, friction, kappa and restitution as pure
            numbers, thickness in m, spin_offset in rad/s; and chi if kappa was varied. The
            attributes are steps, seed, autocorrelation_time in steps, and converged.

        Raises
        ------
        InputError
            If steps or seed are out of range, or emcee is not installed.

        Examples
        --------
        >>> found = carom.fit(carom.datasets.load("kharaz2001"))
        >>> samples = found.posterior(100, seed=1)
        >>> bool(abs(samples.friction.mean() - found.friction.value) < 0.01)
        True
        """
        return sample(self, steps, seed, progress)

    def to_dataset(self) -> "xr.Dataset":
        """Return data, fit, curves and intervals as one dataset, from which the figure is drawn.

        Returns
        -------
        xarray.Dataset
            Along (row, response) measured, error, expected and residual in SI units, outlier (1 for
            one), and regime (row); curve_expected (law, curve, response), curve_low and curve_high
            (curve, response) over curve_incidence (curve) in rad; border (regime_border) in rad;
            value, low, high and reason (parameter); aicc (law). Where `losses` is not None:
            restitution, its error and normal_speed (row), loss_restitution (loss_law, loss_curve)
            over loss_speed.
        """
        return fit_dataset(self)

    def to_dict(self) -> dict[str, Any]:
        """Return the result as plain numbers, texts and lists, for JSON; what is open is None.

        Returns
        -------
        dict
            parameters, correlations, confidence, values (how many were measured), rows, regimes,
            notes, comparison and, None if there are none, losses; SI units.
        """
        return {
            "parameters": {name: each.to_dict() for name, each in self.estimates.items()},
            "correlations": self.correlations,
            "confidence": self.confidence,
            "values": self._best.model.problem.count,
            "rows": self._best.model.problem.trials,
            "regimes": dict(self.regimes),
            "notes": list(self.notes),
            "comparison": self.comparison.to_dict(),
            "losses": self.losses.to_dict() if self.losses else None,
        }

    def cite(self, *, posterior: bool = False) -> str:
        """Return what to cite for this result, and for the data if they have a DOI, as BibTeX.

        Parameters
        ----------
        posterior : bool
            Whether to include what `posterior` uses.

        Returns
        -------
        str
            Entries of BibTeX, one after the other.

        Examples
        --------
        >>> found = carom.fit(carom.datasets.load("kharaz2001"), fixed={"restitution": 1.0})
        >>> [line for line in found.cite().splitlines() if line.startswith("@")][-2:]
        ['@software{newville2014,', '@article{kharaz2001,']
        """
        problem = self._best.model.problem
        lossy = (PLATE if problem.on_plate else VISCOUS,) if self.restitution.value < 1.0 else ()
        entries = bibtex(*FITS, *lossy, *(SAMPLES if posterior else ()))
        return f"{entries}\n{with_doi(problem.doi)}" if problem.doi else entries

    def _sections(self) -> Iterable[Section]:
        return sections_of(self, self.plot)

    def _draw(self, dataset: Any, **look: Any) -> "Figure":
        from carom.plots.fits import plot_drops, plot_fit  # which loads matplotlib

        is_drops = self.losses is not None and self._best.model.problem.is_normal
        return (plot_drops if is_drops else plot_fit)(dataset, **look)

    def _repr_html_(self) -> str:
        """Return a table and a picture for a notebook."""
        rows = {name: str(estimate) for name, estimate in self.estimates.items()}
        return card("Parameters from rebounds", rows, self.plot(), "\n".join(self.notes))

    def __str__(self) -> str:
        return "\n".join([as_text(self), *([str(self.losses)] if self.losses else [])])


def assembled(settled: Settled, confidence: float, profile: ProfiledFit | None = None) -> Fit:
    """Return the result of a fit: intervals, which may be known, regimes, notes."""
    profile = profile or profiled(settled.best, confidence)
    best, problem, pair = profile.best, profile.best.model.problem, profile.best.model.problem.pair
    estimates = {name: estimate_of(profile, name) for name in best.values}
    estimates |= _undetermined(settled, profile, estimates, confidence)
    estimates["chi"] = mapped(estimates["kappa"], "chi", lambda kappa: half_ratio(pair) * kappa)
    if problem.on_plate:
        estimates["restitution"] = _on_plate(problem, estimates.get(THICKNESS))
    for name, elastic in (("kappa", pair.kappa), ("chi", pair.chi)):
        estimates[name] = replace(estimates[name], elastic=elastic)
    ordered = {name: estimates[name] for name in NAMES if name in estimates}
    counts = np.bincount(best.model.regimes(best.at), minlength=len(REGIMES))
    regimes = dict(zip(REGIMES, counts.tolist(), strict=True))
    return Fit(ordered, confidence, regimes, tuple(notes(profile, settled, ordered)), best)


def _on_plate(problem: FitProblem, thickness: Estimate | None) -> Estimate:
    """Return the restitution that follows from a plate, the median of the rows."""

    def median(h: Any) -> float:
        values = {THICKNESS: np.asarray(h)}
        e = plates.restitution(problem.pair, problem.motion.normal_speed, values)
        return float(np.median(e))

    if thickness is None:
        return Estimate("restitution", median(problem.motion.thickness))
    return mapped(thickness, "restitution", median)


def _undetermined(
    settled: Settled, profile: ProfiledFit, estimates: Mapping[str, Estimate], confidence: float
) -> dict[str, Estimate]:
    """Return the estimates of parameters that the data do not tell, or tell from one side only."""
    result: dict[str, Estimate] = {}
    whole: ProfiledFit | None = None
    for group in settled.groups:
        if len(group) == 1:
            whole = whole or profiled(settled.whole, confidence)
            if not whole.open[whole.best.model.free.index(group[0])].all():
                result[group[0]] = estimate_of(whole, group[0])
                continue
        why = reason(group, profile.best) + _product(group, profile, estimates)
        for name in group:
            result[name] = replace(estimates[name], low=nan, high=nan, reason=why)
    return result


def _product(group: tuple[str, ...], fit: ProfiledFit, estimates: Mapping[str, Estimate]) -> str:
    """Return what is known of mu (1 + e), where only that is."""
    if set(group) != {"friction", "restitution"} or "friction" not in fit.best.model.free:
        return ""
    friction, factor = estimates["friction"], 1.0 + estimates["restitution"].value
    numbers = (factor * each for each in (friction.value, friction.low, friction.high))
    return "; that product is {:.4g} ({:.4g} to {:.4g})".format(*numbers)
