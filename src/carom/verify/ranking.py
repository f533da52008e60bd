"""The ranking of contact laws: how far each is from the exact impact, and what step it needs."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from carom import plots
from carom.dem.base import ContactLaw
from carom.dem.damping import damped_restitution
from carom.io.citations import IMPACT, bibtex
from carom.io.labels import labelled_dataset
from carom.io.progress import Progress, advancing
from carom.plots.result import Result, card
from carom.quantities.arrays import Array
from carom.quantities.units import or_none
from carom.verify import errors
from carom.verify.entries import CATALOGUE, Entry, as_entry
from carom.verify.errors import INCIDENCES, Impacts, LawOrFunction, dashed, largest, pure
from carom.verify.steps import TimeSteps, advised_steps, told_steps

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure

CHI = 1.4412  # solid spheres with nu = 0.3
FINE = 0.01  # error in psi_2 of a fine step
NUMBERS = ("max_error", "worst", "rms_error", "force_error", "energy_gain")


class Standing(NamedTuple):
    """A law in a ranking: its errors in psi_2 and force, its gain of energy, the steps it needs.

    `worst` is the psi_1 of the largest error in psi_2. `force_error` is the rms error of the
    tangential force in the impact where it is largest, in units of mu P_max. `energy_gain` is the
    largest |psi_2| - |psi_1|. `step` has the fewest time steps per contact whose own error is below
    that of the law, `fine_step` those with an error below 0.01. `restitution` is the e of the law,
    at which it is compared.
    """

    entry: Entry
    max_error: float
    worst: float
    rms_error: float
    force_error: float
    energy_gain: float
    step: TimeSteps | None
    fine_step: TimeSteps | None
    restitution: float = 1.0


@dataclass(frozen=True)
class Ranking(Result):
    """Contact laws by their largest error in psi_2, the best first; made by `rank`.

    Each of `standings` is a law with its errors in psi_2 and in the force, and the time step that
    it needs.

    Examples
    --------
    >>> import carom
    >>> laws = [carom.dem.LinearSpring(), carom.dem.HardSphere()]
    >>> ranking = carom.verify.rank(laws, psi=[1.0, 6.0])
    >>> [round(one.max_error, 2) for one in ranking.standings]
    [0.06, 0.18]
    """

    chi: float
    kappa: float
    psi: tuple[float, ...]
    standings: tuple[Standing, ...]

    def __str__(self) -> str:
        return _table(self)

    def _repr_html_(self) -> str:
        """Return a table and a picture for a notebook."""
        rows = {s.entry.label: f"{s.max_error:.3f} at psi_1 = {s.worst:g}" for s in self.standings}
        title = f"Largest |error in psi_2| at chi = {self.chi:g}"
        return card(title, rows, self.plot())

    def to_dict(self) -> dict[str, Any]:
        """Return the ranking as what JSON can hold.

        Returns
        -------
        dict
            chi, kappa, psi_in and laws, a record each.
        """
        laws = [_record(standing) for standing in self.standings]
        return {"chi": self.chi, "kappa": self.kappa, "psi_in": list(self.psi), "laws": laws}

    as_record = to_dict  # its name before

    def cite(self) -> str:
        """Return what to cite for the exact answer, as BibTeX."""
        return bibtex(*IMPACT)

    def _draw(self, dataset: "xr.Dataset", **look: Any) -> "Figure":
        return plots.plot_laws(dataset, **look)

    def to_dataset(self) -> "xr.Dataset":
        """Return psi_2 of each law and of the exact impact, and all errors, as one dataset.

        Returns
        -------
        xarray.Dataset
            psi_out (law, psi_in), psi_out_exact (psi_in; also of the law if their restitutions
            differ), max_error, rms_error, force_error, energy_gain and restitution (law), steps
            (law, step_kind), -1 where none suffice; chi and kappa.
        """
        laws = [standing.entry.law for standing in self.standings]
        met = Impacts(np.array(self.psi), self.chi, self.kappa)
        given = [met.rebound(law) for law in laws]
        left = [standing.restitution for standing in self.standings]
        exact = list(map(met.exact, left))
        steps = [
            [step.steps if step else -1 for step in (s.step, s.fine_step)] for s in self.standings
        ]
        meanings = {
            "max_error": "largest |error in psi_2|",
            "rms_error": "root mean square of the error in psi_2",
            "force_error": "rms error of the tangential force, in mu P_max, of the worst impact",
            "energy_gain": "largest |psi_2| - |psi_1|",
        }
        errors_of_laws = {
            name: ("law", [getattr(s, name) for s in self.standings], pure(meaning))
            for name, meaning in meanings.items()
        }
        return labelled_dataset(
            {
                "psi_out": (("law", "psi_in"), np.array(given)),
                "psi_out_exact": (*_without_copies(exact), pure("psi_2 of the exact impact")),
                **errors_of_laws,
                "restitution": ("law", left, pure("restitution that the law leaves")),
                "steps": (("law", "step_kind"), steps, pure("steps per contact, -1: none")),
                "chi": self.chi,
                "kappa": self.kappa,
            },
            {
                "law": ("law", [s.entry.label for s in self.standings], {}),
                "psi_in": np.array(self.psi),
                "step_kind": ("step_kind", ["below the error of the law", f"below {FINE:g}"], {}),
            },
            {"title": "contact laws against the exact impact"},
        )


def _without_copies(exact: list[Array]) -> tuple[tuple[str, ...], Array]:
    """Return dimensions and values of the exact psi_2, once if it is the same for all laws."""
    same = all(np.array_equal(each, exact[0]) for each in exact)
    return (("psi_in",), exact[0]) if same else (("law", "psi_in"), np.array(exact))


def rank(
    entries: Sequence[Entry | LawOrFunction] = CATALOGUE,
    *,
    chi: float = CHI,
    kappa: float | None = None,
    psi: ArrayLike = INCIDENCES,
    restitution: float | None = None,
    progress: Progress = None,
) -> Ranking:
    """Return how far contact laws are from the exact impact, the best first.

    Laws are ranked by the largest |psi_2 of the law - psi_2(psi_1, chi)| over the incidences. A law
    with damping is compared with Kelvin-Voigt solids (Kuwabara & Kono 1987) of the same e.

    Parameters
    ----------
    entries : sequence of Entry, Law or callable
        Laws, functions as of `carom.dem.FunctionLaw`, or entries with a label and the programs that
        use the law; by default the whole catalogue.
    chi : float
        Ratio of inertia to stiffness, (kappa/2)(m_n/m_t), positive.
    kappa : float, optional
        Stiffness ratio G*/E*; by default that of solid spheres, 4 chi/7.
    psi : array_like
        Incidences psi_1.
    restitution : float, optional
        Normal coefficient of restitution e for which all laws are damped; laws of the catalogue
        that have no damping are left out.
    progress : bool or callable, optional
        Whether a progress bar is shown after two seconds, by default in a notebook and on a
        terminal; or a function that is called with the number of laws done and their total.

    Returns
    -------
    Ranking
        `standings` has one item per law, ordered by max_error: its `entry`, max_error and rms_error
        in psi_2, `worst`, the psi_1 of the largest error, force_error in units of mu P_max,
        energy_gain in units of psi, and the time steps that the law needs, `step` and `fine_step`,
        or None.

    Raises
    ------
    InputError
        If there is no law, a law to be damped has no damping, or a value is out of range.

    Examples
    --------
    >>> import carom
    >>> best = carom.verify.rank(carom.verify.catalogue()[:2]).standings[0]
    >>> best.entry.label, round(best.max_error, 3)
    ('linear spring, k_t/k_n = kappa', 0.176)
    >>> law = carom.dem.LammpsMindlin("mindlin")
    >>> damped = carom.verify.rank(law, psi=[0.5, 2.0], restitution=0.7)
    >>> round(damped.standings[0].max_error, 2)
    0.27
    """
    met = Impacts.of(psi, chi, kappa)
    given = [as_entry(each) for each in errors.laws_of("entries", entries)]
    if restitution is not None:
        if entries is CATALOGUE:
            given = [entry for entry in given if hasattr(entry.law, "restitution")]
        e = damped_restitution("restitution", restitution)
        given = [entry._replace(law=errors.damped(entry.law, e)) for entry in given]
    standings = []
    with advancing("ranking the laws", len(given), progress, unit="laws") as advance:
        for entry in given:
            standings.append(_standing(entry, met))
            advance(1)
    ordered = sorted(standings, key=lambda s: (np.isnan(s.max_error), s.max_error, s.entry.label))
    return Ranking(met.chi, met.kappa, tuple(met.psi.tolist()), tuple(ordered))


def _standing(entry: Entry, met: Impacts) -> Standing:
    law, (psi, chi, kappa) = entry.law, met
    given = met.rebound(law)
    met.refuse_failure(law, given)
    left = met.restitution(law)
    error = given - met.exact(left)
    most = largest(error)
    forces = [errors.force_error(law, at, chi, kappa=kappa).rms for at in psi if at != 0.0]
    step = fine = None
    if isinstance(law, ContactLaw) and most > 0.0:
        step, fine = (advised_steps(law, e, psi, chi, kappa=kappa) for e in (most, FINE))
    return Standing(
        entry,
        most,
        float(psi[int(np.argmax(np.abs(error)))]),
        errors.root_mean_square(error),
        float(np.max(forces)) if forces else float("nan"),
        errors.energy_gain(psi, given),
        step,
        fine,
        left,
    )


def _record(standing: Standing) -> dict[str, Any]:
    entry, numbers = standing.entry, {name: getattr(standing, name) for name in NUMBERS}
    return {
        "law": entry.label,
        "used_by": entry.used_by,
        "source": entry.law.source,
        "restitution": standing.restitution,
        **{name: or_none(value) for name, value in numbers.items()},
        **told_steps(standing.step),
        "fine_steps": standing.fine_step.steps if standing.fine_step else None,
    }


def _table(ranking: Ranking) -> str:
    loses = any(s.restitution != 1.0 for s in ranking.standings)
    head = f"{'max':>7s} {'at':>5s} {'rms':>7s} {'force':>7s} {'steps':>6s} {'fine':>5s}"
    rows = [
        f"  {s.entry.label:32s} {s.max_error:7.3f} {s.worst:5.2f} {s.rms_error:7.3f}"
        f" {dashed(s.force_error, 7, '.3f')} {dashed(s.step and s.step.steps, 6, 'd')}"
        f" {dashed(s.fine_step and s.fine_step.steps, 5, 'd')}  {s.entry.used_by}"
        + (f"; gains energy, {s.energy_gain:.2g} in psi" if s.energy_gain > 1e-9 else "")
        + (f"; e = {s.restitution:.4g}" if loses else "")
        for s in ranking.standings
    ]
    return "\n".join(
        [
            f"|error in psi_2| of contact laws at chi = {ranking.chi:g},"
            f" kappa = {ranking.kappa:.4g}, {errors.in_words(ranking.psi)}",
            *(["compared with viscoelastic bodies of the same restitution e"] if loses else []),
            f"  {'':32s} {head}  used by",
            *rows,
            "max, at: largest error, and its psi_1; force: rms error of the tangential force in the"
            " worst impact, in mu P_max",
            "steps: time steps per contact, enough that they add less error than the law has; fine:"
            f" enough for an error below {FINE:g}",
        ]
    )
