"""What a view comes to: an impact solved, in the units in which the page draws it."""

from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, replace
from functools import lru_cache
from math import isfinite
from typing import Any

import numpy as np

from carom.bodies.losses import ZENER, LossLaw, ZenerPlate
from carom.dem.base import SOLID
from carom.dimensionless.lossy.solution import LossySolution
from carom.dimensionless.rebounds import regime_borders
from carom.dimensionless.solution import Solution, solve
from carom.dimensionless.states import History, Phase
from carom.explorer.results import Row, findings_of, in_words, rows_of
from carom.explorer.stages import MovingBodies, precise, short, stage_of_bodies, stage_of_numbers
from carom.explorer.views import PAGE, Refused, View
from carom.impacts.exact import Impact
from carom.impacts.outcome import history_columns
from carom.impacts.solve import impact
from carom.quantities.arrays import Array
from carom.quantities.prefixes import prefixed
from carom.quantities.refusals import InputError

HISTORY_TIMES = 201
SPIN_ROUNDING = 1e-9  # of the spin before
KEPT_SCENES = 16
RADII, INSTANTS = 33, 61  # at which tractions are drawn
INSTANTS_WITH_LOSSES = 31  # of which one takes 2 ms
HIGHEST_TRACTION = 9.0  # at the edge it is infinite where viscous bodies are loaded
ENERGIES: dict[str, str] = PAGE["energies"]
ENERGIES_OF_CONTACT: dict[str, str] = PAGE["energies_of_contact"]
FORCE_SCALE = 1.5  # F_x/(mu F_max) over Q of the theory
OF_PLATES = ("thickness", "inelasticity")  # what the library refuses where a plate is too thin
TOO_LARGE = "with the other numbers it leads to some that a computer cannot hold"


@dataclass(frozen=True, eq=False)
class Scene:
    """An impact as the page draws it: histories along `share`, 0 at first touch, 1 at parting."""

    psi_in: float
    psi_out: float
    chi: float
    kappa: float
    restitution: float
    losses: LossLaw | None  # that alone decide the restitution, at any speed
    borders: Array  # of the regimes
    lasts: float  # d_max/V_1
    duration: float
    time_unit: str
    phases: tuple[Phase, ...]  # times as shares of the duration
    share: Array
    psi: Array
    force: Array
    limit: Array
    force_scale: float  # mu times the largest force without losses
    force_unit: str
    energies: Mapping[str, Array]  # as shares of all
    contact: Array
    stick: Array
    rim: Array  # of the pressure, its density at the edge
    tractions: Array
    stage: MovingBodies
    results: tuple[Row, ...]
    findings: tuple[Row, ...]

    @property
    def rubs(self) -> bool:
        """Whether there is a psi_1: without friction it is infinite."""
        return isfinite(self.psi_in)

    def moving(self) -> dict[str, Any]:
        """Return what the page animates, as JSON can hold it."""
        names = ("kind", "sign", "start", "end")
        phases = [{name: getattr(phase, name) for name in names} for phase in self.phases]
        on_plate = isinstance(self.losses, ZenerPlate)
        return {
            **({"plate": self.restitution} if on_plate else {}),
            "duration": self.duration,
            "unit": self.time_unit,
            "phases": phases,
            "time": short(self.share),
            "contact": short(self.contact),
            "stick": short(self.stick),
            "psi": precise(self.psi) if self.rubs else None,
            "force": precise(self.force / (self.limit.max() or 1.0)),
            "rim": short(self.rim),
            "tractions": short(self.tractions),
            "stage": self.stage.moving(),
        }


def scene_of(view: View) -> Scene:
    """Solve what a view asks for, or raise InputError."""
    return _solved(replace(view, law=(), data=""))


@lru_cache(maxsize=KEPT_SCENES)
def _solved(view: View) -> Scene:
    with refusals("psi" if view.in_numbers else "friction"):
        return _of_numbers(view) if view.in_numbers else _of_bodies(view)


def impact_of(view: View) -> Impact:
    """Return the impact of the bodies of a view, or raise Refused."""
    with refusals("speed"):
        hit: Impact = impact(view.pair, losses=view.losses, **view.motion)
        return hit


@contextmanager
def refusals(field: str) -> Iterator[None]:
    """Refuse a field of the page where the library refuses: each is right by itself."""
    try:
        yield
    except Refused:
        raise
    except (InputError, ArithmeticError) as error:
        name, _, message = str(error).partition(": ")
        if name in OF_PLATES:
            raise Refused("thickness", in_words(message)) from None
        raise Refused(field, TOO_LARGE) from None


def _of_bodies(view: View) -> Scene:
    hit = impact_of(view)
    pair, scales, column = hit.pair, hit.scales, history_columns(hit, HISTORY_TIMES)
    seconds, unit = prefixed(hit.duration, "s")
    give = pair.plate_give(hit.normal_speed)
    newtons, force_unit = prefixed(pair.friction * hit.max_force or hit.max_force, "N")
    return Scene(
        **_in_both(hit, hit.solution, column, ENERGIES),
        chi=pair.chi,
        kappa=pair.kappa,
        restitution=hit.normal_restitution if give else view.restitution,
        losses=ZenerPlate(inelasticity=ZENER * give) if give else view.losses,
        borders=_borders(view, hit.solution, give),
        duration=hit.duration * seconds,
        time_unit=unit,
        psi=column["contact_velocity"] / (scales.tangential_speed or np.inf),
        force=column["tangential_force"] * newtons,
        limit=pair.friction * column["normal_force"] * newtons,
        force_scale=pair.friction * scales.force * newtons,
        force_unit=force_unit,
        rim=_rim(hit.solution, column["normal_velocity"] / hit.normal_speed),
        stage=stage_of_bodies(hit, column),
        results=rows_of(_scalars(hit), lossy=view.is_lossy),
        findings=findings_of(hit.validity.findings),
    )


def _in_both(
    outcome: Any,
    solution: Solution | LossySolution,
    column: Mapping[str, Array],
    energies: Iterable[str],
) -> dict[str, Any]:
    """Return what a scene tells of bodies and of numbers alike, of the one or the other outcome."""
    duration, radius = outcome.duration, outcome.max_radius
    whole: Any = sum(column[name] for name in energies)  # zero where nothing moves
    phases = (
        phase._replace(start=phase.start / duration, end=phase.end / duration)
        for phase in outcome.phases
    )
    return {
        "psi_in": outcome.psi_in,
        "psi_out": outcome.psi_out,
        "lasts": solution.duration,
        "phases": tuple(phases),
        "share": column["time"] / duration,
        "energies": {n: column[n] / whole if whole.any() else column[n] for n in energies},
        "contact": column["contact_radius"] / radius,
        "stick": column["stick_radius"] / radius,
        "tractions": _tractions(solution),
    }


def _scalars(hit: Impact) -> Mapping[str, float]:
    """Return the numbers of an impact; what rounding leaves of a spin is none."""
    numbers = hit.scalars()
    left = numbers["spin_out"]
    if hit.pair.thickness is not None:
        del numbers["shear_lost_energy"]  # bodies on plates are elastic
    return numbers | {"spin_out": 0.0 if abs(left) < SPIN_ROUNDING * abs(hit.spin) else left}


def columns_of_numbers(history: History) -> dict[str, Array]:
    """Return the columns of a history in units of the theory, by the names of those of bodies."""
    return {
        "time": history.time,
        "normal_force": history.normal_force,
        "tangential_force": FORCE_SCALE * history.force,
        "contact_velocity": history.psi,
        "normal_velocity": history.centre_speed,
        "contact_radius": history.contact_radius,
        "stick_radius": history.stick_radius,
        "contact_kinetic_energy": 0.5 * history.psi**2,
        "tangential_elastic_energy": history.stored,
        "frictional_work": history.dissipated,
        "shear_loss": history.shear_lost,
    }


def _of_numbers(view: View) -> Scene:
    if not view.friction:
        raise Refused("friction", "must be above 0: without friction there is no ψ₁")
    solution = solve(view.psi, view.chi, losses=view.losses)
    history = solution.history(HISTORY_TIMES)
    column = columns_of_numbers(history)
    return Scene(
        **_in_both(solution, solution, column, ENERGIES_OF_CONTACT),
        chi=solution.chi,
        kappa=SOLID * solution.chi,
        restitution=solution.restitution if view.on_plate else view.restitution,
        losses=view.losses,
        borders=_borders(view, solution, view.inelasticity / ZENER),
        duration=solution.duration,
        time_unit="d_max/V₁",
        psi=history.psi,
        force=column["tangential_force"],
        limit=history.normal_force,
        force_scale=1.0,
        force_unit="µ F_max",
        rim=_rim(solution, history.speed),
        stage=stage_of_numbers(solution, history, view.friction),
        results=rows_of(_numbers(solution, view), lossy=view.on_plate),
        findings=(),
    )


def _borders(view: View, solution: Solution | LossySolution, give: float) -> Array:
    """Return the psi_1 at which the regime changes; `give` is how far a plate does, lambda."""
    e = solution.restitution if view.on_plate else view.restitution
    return regime_borders(solution.chi, e, 1.25 * give * solution.max_force)


def _numbers(solution: Solution | LossySolution, view: View) -> dict[str, float]:
    psi, out = solution.psi_in, solution.psi_out
    numbers = {"psi_in": psi, "psi_out": out, "chi": solution.chi}
    numbers |= {"contact_restitution": out / psi} if psi else {}
    return numbers | ({"normal_restitution": solution.restitution} if view.on_plate else {})


def _tractions(solution: Solution | LossySolution) -> Array:
    """Return the traction over mu and Hertz's pressure of the largest contact, to the edge."""
    instants = INSTANTS_WITH_LOSSES if isinstance(solution, LossySolution) else INSTANTS
    times = np.linspace(0.0, solution.duration, instants)
    edges = solution.at(times).contact_radius
    tractions = np.zeros((instants, RADII))
    line = np.linspace(0.0, 1.0, RADII)
    for row in range(1, instants - 1):
        tractions[row] = solution.traction(times[row], edges[row] * line)
    return np.clip(tractions / solution.max_radius, -HIGHEST_TRACTION, HIGHEST_TRACTION)


def _rim(solution: Solution | LossySolution, speed: Array) -> Array:
    """Return what the density of the pressure ends with at the edge, in units of the largest."""
    if isinstance(solution, Solution):
        return np.zeros(speed.size)
    alpha = solution._losses.parameter
    return np.asarray(alpha * np.maximum(speed, 0.0) / solution.max_radius**2)
