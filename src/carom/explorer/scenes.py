"""What a view comes to: an impact solved, in the units in which the page draws it."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import lru_cache
from math import isinf, isnan
from typing import Any

import numpy as np

from carom.dimensionless.lossy.solution import LossySolution
from carom.dimensionless.solution import Solution, solve
from carom.dimensionless.states import Phase
from carom.explorer.stages import MovingBodies, short, stage_of_bodies, stage_of_numbers
from carom.explorer.views import View
from carom.impacts.exact import Impact
from carom.impacts.report import OF_LOSSES
from carom.impacts.solve import impact
from carom.laws.dem.base import SOLID
from carom.plots.impact import ENERGIES, LOST
from carom.quantities.arrays import Array
from carom.quantities.glossary import GLOSSARY
from carom.quantities.prefixes import prefixed, text

TIMES = 201  # of the histories
KEPT = 16  # scenes that are remembered
RADII, INSTANTS = 33, 61  # at which tractions are drawn
FEWER = 31  # instants with losses, of which one takes 2 ms
HIGHEST = 9.0  # traction that is drawn: at the edge it is infinite where viscous bodies are loaded
OF_BODIES = (
    "chi",
    "kappa",
    "psi_in",
    "psi_out",
    "rebound_angle",
    "rebound_speed",
    "spin_out",
    "contact_restitution",
    "tangential_restitution",
    "dissipated_energy",
    "duration",
    "max_force",
    "max_radius",
)
LETTERS = {"chi": "χ", "kappa": "κ", "psi_in": "ψ₁", "psi_out": "ψ₂"}
OF_CONTACT = {  # energies of the tangential motion alone
    "contact_kinetic_energy": "motion of the contact point",
    "tangential_elastic_energy": "elastic, tangential",
    "frictional_work": "lost to friction",
    "shear_loss": "losses in shear",
}


@dataclass(frozen=True, eq=False)
class Scene:
    """An impact as the page draws it: histories along `share`, 0 at first touch, 1 at parting."""

    psi_in: float
    psi_out: float
    chi: float
    kappa: float
    restitution: float
    lasts: float  # d_max/V_1
    duration: float
    time_unit: str
    phases: tuple[Phase, ...]  # times as shares of the duration
    share: Array
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
    results: Mapping[str, str]
    findings: str

    def moving(self) -> dict[str, Any]:
        """Return what the page animates, as JSON can hold it."""
        told = ("kind", "sign", "start", "end")
        phases = [{name: getattr(phase, name) for name in told} for phase in self.phases]
        return {
            "duration": self.duration,
            "unit": self.time_unit,
            "phases": phases,
            "time": short(self.share),
            "contact": short(self.contact),
            "stick": short(self.stick),
            "force": short(self.force / (self.limit.max() or 1.0)),
            "rim": short(self.rim),
            "tractions": [short(line) for line in self.tractions],
            "stage": self.stage.moving(),
        }


def scene_of(view: View) -> Scene:
    """Solve what a view asks for, or raise InputError."""
    return _solved(replace(view, law=(), data=""))


@lru_cache(maxsize=KEPT)
def _solved(view: View) -> Scene:
    return _of_numbers(view) if view.in_numbers else _of_bodies(view)


def impact_of(view: View) -> Impact:
    """Return the impact of the bodies of a view, or raise InputError."""
    found: Impact = impact(view.pair, losses=view.losses, **view.motion)
    return found


def _of_bodies(view: View) -> Scene:
    hit = impact_of(view)
    history = hit.history(TIMES)
    column = {str(name): line.values for name, line in history.variables.items()}
    seconds, unit = prefixed(hit.duration, "s")
    newtons, force_unit = prefixed(hit.pair.friction * hit.max_force or hit.max_force, "N")
    energies = {name: column[name] for name in (*ENERGIES, *LOST)}
    whole = sum(energies.values())
    scalars = hit.scalars()
    told = OF_BODIES if hit.losses is None else (*OF_BODIES, *OF_LOSSES)
    return Scene(
        psi_in=hit.psi_in,
        psi_out=hit.psi_out,
        chi=hit.pair.chi,
        kappa=hit.pair.kappa,
        restitution=view.restitution,
        lasts=hit.solution.duration,
        duration=hit.duration * seconds,
        time_unit=unit,
        phases=_shares(hit.phases, hit.duration),
        share=history["time"].values / hit.duration,
        force=column["tangential_force"] * newtons,
        limit=hit.pair.friction * column["normal_force"] * newtons,
        force_scale=hit.pair.friction * hit.pair.scales(hit.normal_speed).force * newtons,
        force_unit=force_unit,
        energies={name: part / whole for name, part in energies.items()},
        contact=column["contact_radius"] / hit.max_radius,
        stick=column["stick_radius"] / hit.max_radius,
        rim=_rim(hit.solution, column["normal_velocity"] / hit.normal_speed),
        tractions=_tractions(hit.solution),
        stage=stage_of_bodies(hit, column),
        results={_named(name): _text(name, scalars[name]) for name in told},
        findings=str(hit.validity),
    )


def _of_numbers(view: View) -> Scene:
    solution = solve(view.psi, view.chi, losses=view.losses)
    history = solution.history(TIMES)
    parts = (0.5 * history.psi**2, history.stored, history.dissipated, history.shear_lost)
    whole = sum(parts) if parts[0][0] > 0.0 else np.ones(TIMES)
    return Scene(
        psi_in=solution.psi_in,
        psi_out=solution.psi_out,
        chi=solution.chi,
        kappa=SOLID * solution.chi,
        restitution=view.restitution,
        lasts=solution.duration,
        duration=solution.duration,
        time_unit="d_max/V₁",
        phases=_shares(solution.phases, solution.duration),
        share=history.time / solution.duration,
        force=1.5 * history.force,  # Q = (2/3) F_x/(mu P_max)
        limit=history.normal_force,
        force_scale=1.0,
        force_unit="µ F_max",
        energies={name: part / whole for name, part in zip(OF_CONTACT, parts, strict=True)},
        contact=history.contact_radius / solution.max_radius,
        stick=history.stick_radius / solution.max_radius,
        rim=_rim(solution, history.speed),
        tractions=_tractions(solution),
        stage=stage_of_numbers(solution, history, view.friction),
        results=_numbers(solution),
        findings="",
    )


def _numbers(solution: Solution | LossySolution) -> dict[str, str]:
    psi, out = solution.psi_in, solution.psi_out
    rows = {
        _named("psi_in"): text(psi, "1"),
        _named("psi_out"): text(out, "1"),
        _named("chi"): text(solution.chi, "1"),
    }
    if psi:
        rows[_named("contact_restitution")] = text(out / psi, "1")
    return rows


def _tractions(solution: Solution | LossySolution) -> Array:
    """Return the traction over mu and Hertz's pressure of the largest contact, to the edge."""
    instants = FEWER if isinstance(solution, LossySolution) else INSTANTS
    times = np.linspace(0.0, solution.duration, instants)
    edges = solution.at(times).contact_radius
    found = np.zeros((instants, RADII))
    line = np.linspace(0.0, 1.0, RADII)
    for row in range(1, instants - 1):
        found[row] = solution.traction(times[row], edges[row] * line)
    return np.clip(found / solution.max_radius, -HIGHEST, HIGHEST)


def _rim(solution: Solution | LossySolution, speed: Array) -> Array:
    """Return what the density of the pressure ends with at the edge, in units of the largest."""
    if isinstance(solution, Solution):
        return np.zeros(speed.size)
    alpha = solution.losses.parameter
    return np.asarray(alpha * np.maximum(speed, 0.0) / solution.max_radius**2)


def _shares(phases: tuple[Phase, ...], duration: float) -> tuple[Phase, ...]:
    return tuple(p._replace(start=p.start / duration, end=p.end / duration) for p in phases)


def _named(name: str) -> str:
    """Return what a number is called, after its letter if the page speaks of it by that."""
    letter = LETTERS.get(name)
    return f"{letter}, {GLOSSARY[name].meaning}" if letter else GLOSSARY[name].meaning


def _text(name: str, value: float) -> str:
    """Return a value of the glossary with its unit, which no line break parts."""
    if isinf(value):
        return "none: it slides freely"
    if isnan(value):
        return "none: it was zero before"
    unbroken = GLOSSARY[name].text(value).replace(" ", "\N{NO-BREAK SPACE}")
    return unbroken.replace("\N{NO-BREAK SPACE}(", " (")  # radians may begin a line
