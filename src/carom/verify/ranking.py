"""The ranking of contact laws: how far each is from the exact impact, and what step it needs."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from carom.dem.base import ContactLaw
from carom.dem.damping import damped_restitution
from carom.io.citations import IMPACT, bibtex
from carom.io.labels import labelled_dataset, pure
from carom.io.progress import Progress, advancing
from carom.plots.result import Result, card
from carom.quantities.arrays import Array
from carom.quantities.refusals import known_keywords
from carom.quantities.units import or_none
from carom.verify import errors
from carom.verify.entries import CATALOGUE, Entry, LawOrFunction, as_entry, damped, listed
from carom.verify.errors import INCIDENCES, SOLID_CHI, Impacts, TimeSteps
from carom.verify.tables import text_table

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure

FINE_ERROR = 0.01  # in psi_2, of a fine step
MEANINGS = {
    "max_error": "largest |error in psi_2|",
    "rms_error": "root mean square of the error in psi_2",
    "force_error": "rms error of the tangential force, in mu P_max, of the worst impact",
    "energy_gain": "largest |psi_2| - |psi_1|",
}
COLUMNS = ":<32s max:7.3f at:5.2f rms:7.3f force:7.3f steps:6d fine:5d"


class Standing(NamedTuple):
    """A law of a ranking, `entry`: its errors in psi_2 and force, gain of energy, steps it needs.

    `max_error` is the largest in psi_2, at psi_1 = `worst`. `force_error` is the rms error of the
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

    def to_dict(self) -> dict[str, Any]:
        """Return the standing as what JSON can hold."""
        numbers = ("max_error", "worst", "rms_error", "force_error", "energy_gain")
        return {
            "law": self.entry.label,
            "used_by": self.entry.used_by,
            "source": self.entry.law.source,
            "restitution": self.restitution,
            **{name: or_none(getattr(self, name)) for name in numbers},
            **errors.steps_record(self.step),
            "fine_steps": self.fine_step.steps if self.fine_step else None,
        }


@dataclass(frozen=True)
class Ranking(Result):
    """Contact laws by their largest error in psi_2 at all `psi`, the best first; made by `rank`.

    Each of `standings` is a law with its errors in psi_2 and in the force, and the time step that
    it needs.

    Examples
    --------
    >>> laws = [carom.dem.LinearSpring(), carom.dem.HardSphere()]
    >>> ranking = carom.verify.rank(laws, psi_1=[1.0, 6.0])
    >>> [round(one.max_error, 2) for one in ranking.standings]
    [0.06, 0.18]
    """

    chi: float
    kappa: float
    psi_in: tuple[float, ...]
    standings: tuple[Standing, ...]

    def __str__(self) -> str:
        loses = any(s.restitution != 1.0 for s in self.standings)
        rows = [
            (
                *(s.entry.label, s.max_error, s.worst, s.rms_error, or_none(s.force_error)),
                *(step and step.steps for step in (s.step, s.fine_step)),
                s.entry.used_by
                + (f"; gains energy, {s.energy_gain:.2g} in psi" if s.energy_gain > 1e-9 else "")
                + (f"; e = {s.restitution:.4g}" if loses else ""),
            )
            for s in self.standings
        ]
        head, *lines = text_table(COLUMNS, rows)
        return "\n".join(
            [
                f"|error in psi_2| of contact laws at chi = {self.chi:g},"
                f" kappa = {self.kappa:.4g}, {errors.in_words(self.psi_in)}",
                *(["compared with viscoelastic bodies of the same restitution e"] if loses else []),
                f"{head}  used by",
                *lines,
                "max, at: largest error, and its psi_1; force: rms error of the tangential force in"
                " the worst impact, in mu P_max",
                "steps: time steps per contact, enough that they add less error than the law has;"
                f" fine: enough for an error below {FINE_ERROR:g}",
            ]
        )

    def _repr_html_(self) -> str:
        rows = {s.entry.label: f"{s.max_error:.3f} at psi_1 = {s.worst:g}" for s in self.standings}
        title = f"Largest |error in psi_2| at chi = {self.chi:g}"
        return card(title, rows, self.plot())

    def to_dict(self) -> dict[str, Any]:
        """Return chi, kappa, psi_in and laws, a record each, as what JSON can hold."""
        laws = [standing.to_dict() for standing in self.standings]
        return {"chi": self.chi, "kappa": self.kappa, "psi_in": list(self.psi_in), "laws": laws}

    def cite(self) -> str:
        """Return what to cite for the exact answer, as BibTeX."""
        return bibtex(*IMPACT)

    def _draw(self, dataset: "xr.Dataset", **look: Any) -> "Figure":
        from carom.plots.laws import plot_laws

        return plot_laws(dataset, **look)

    def to_dataset(self) -> "xr.Dataset":
        """Return psi_2 of each law and of the exact impact, and all errors, as one dataset.

        psi_out (law, psi_in), psi_out_exact (psi_in; also of the law if their restitutions
        differ), max_error, rms_error, force_error, energy_gain and restitution (law), steps (law,
        step_kind), -1 where none suffice; chi and kappa.
        """
        impacts = Impacts(np.array(self.psi_in), self.chi, self.kappa)
        psi_out = [impacts.rebound(standing.entry.law) for standing in self.standings]
        restitutions = [standing.restitution for standing in self.standings]
        exact = list(map(impacts.exact, restitutions))
        steps = [
            [step.steps if step else -1 for step in (s.step, s.fine_step)] for s in self.standings
        ]
        kinds = ["below the error of the law", f"below {FINE_ERROR:g}"]
        numbers = {
            name: ("law", [getattr(s, name) for s in self.standings], pure(meaning))
            for name, meaning in MEANINGS.items()
        }
        return labelled_dataset(
            {
                "psi_out": (("law", "psi_in"), np.array(psi_out)),
                "psi_out_exact": (*_without_copies(exact), pure("psi_2 of the exact impact")),
                **numbers,
                "restitution": ("law", restitutions, pure("restitution that the law leaves")),
                "steps": (("law", "step_kind"), steps, pure("steps per contact, -1: none")),
                "chi": self.chi,
                "kappa": self.kappa,
            },
            {
                "law": ("law", [s.entry.label for s in self.standings], {}),
                "psi_in": np.array(self.psi_in),
                "step_kind": ("step_kind", kinds, {}),
            },
            {"title": "contact laws against the exact impact"},
        )


def _without_copies(exact: list[Array]) -> tuple[tuple[str, ...], Array]:
    """Return dimensions and values of the exact psi_2, once if it is the same for all laws."""
    same = all(np.array_equal(each, exact[0]) for each in exact)
    return (("psi_in",), exact[0]) if same else (("law", "psi_in"), np.array(exact))


@known_keywords
def rank(
    entries: Sequence[Entry | LawOrFunction] = CATALOGUE,
    *,
    chi: float = SOLID_CHI,
    kappa: float | None = None,
    psi_1: ArrayLike = INCIDENCES,
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
    psi_1 : array_like
        Incidences psi_1.
    restitution : float, optional
        Normal coefficient of restitution e for which all laws are damped; laws of the catalogue
        that have no damping are left out.
    progress : bool or callable, optional
        As for `carom.sweep`; laws are counted.

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
    >>> best = carom.verify.rank(carom.verify.catalogue()[:2]).standings[0]
    >>> best.entry.label, round(best.max_error, 3)
    ('linear spring, k_t/k_n = kappa', 0.176)
    """
    impacts = Impacts.of(psi_1, chi, kappa)
    ranked = [as_entry(each) for each in listed("entries", entries)]
    if restitution is not None:
        if entries is CATALOGUE:
            ranked = [entry for entry in ranked if hasattr(entry.law, "restitution")]
        e = damped_restitution("restitution", restitution)
        ranked = [entry._replace(law=damped(entry.law, e)) for entry in ranked]
    standings = []
    with advancing("ranking the laws", len(ranked), progress, unit="laws") as advance:
        for entry in ranked:
            standings.append(_standing(entry, impacts))
            advance(1)
    ordered = sorted(standings, key=lambda s: (np.isnan(s.max_error), s.max_error, s.entry.label))
    return Ranking(impacts.chi, impacts.kappa, tuple(impacts.psi.tolist()), tuple(ordered))


def _standing(entry: Entry, impacts: Impacts) -> Standing:
    law, (psi, chi, kappa) = entry.law, impacts
    psi_out = impacts.rebound(law)
    impacts.refuse_failure(law, psi_out)
    restitution = impacts.restitution(law)
    error = psi_out - impacts.exact(restitution)
    max_error = errors.largest(error)
    forces = [errors.force_error(law, at, chi, kappa=kappa).rms for at in psi if at != 0.0]
    step = fine_step = None
    if isinstance(law, ContactLaw) and max_error > 0.0:
        step, fine_step = (
            errors.advised_steps(law, allowed, psi, chi, kappa=kappa)
            for allowed in (max(max_error, errors.LEAST_ALLOWED), FINE_ERROR)
        )
    return Standing(
        entry=entry,
        max_error=max_error,
        worst=float(psi[int(np.argmax(np.abs(error)))]),
        rms_error=errors.root_mean_square(error),
        force_error=float(np.max(forces)) if forces else float("nan"),
        energy_gain=errors.energy_gain(psi, psi_out),
        step=step,
        fine_step=fine_step,
        restitution=restitution,
    )
