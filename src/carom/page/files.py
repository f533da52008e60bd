"""The files of a view, in SI units for bodies, without units where psi_1 and chi are given."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import xarray as xr
from matplotlib.figure import Figure

from carom.bodies.pairs import Scales
from carom.dimensionless.lossy.law import scale_free
from carom.dimensionless.solution import solve
from carom.impacts.contacts.fields import contact_in_impact, surface_fields
from carom.impacts.curves import curve
from carom.impacts.histories import labelled
from carom.io.files import save
from carom.io.labels import labelled_dataset
from carom.lab.fitting.template import TEMPLATE
from carom.page.limits import LAW_SECONDS, Busy
from carom.page.outcomes import FORCE_SCALE, Outcome, columns_of_numbers, impact_of, outcome_of
from carom.page.overlays import LawCurve, followers, law_curves, places
from carom.page.views import PAGE, View
from carom.plots import (
    plot_contact,
    plot_curve,
    plot_impact,
    plot_patch,
    save_figure,
    style as drawing,
)
from carom.plots.impact import ENERGIES, LOST, impact_figure
from carom.plots.legends import legend_above

SCALES = Scales(
    **dict.fromkeys(("length", "radius", "force", "pressure", "tangential_length"), 1.0),
    **dict.fromkeys(("speed", "time", "energy", "tangential_speed"), 1.0),
    tangential_force=FORCE_SCALE,
)
TANGENTIAL = {  # energies that psi_1 and chi tell, with the looks of what they are part of
    name: (words, *ENERGIES.get(name, ENERGIES["tangential_kinetic_energy"])[1:])
    for name, words in PAGE["energies_of_contact"].items()
    if name not in LOST
}
HISTORY_TIMES = 201
ENTRY_HEIGHT = 1.8  # mm that a law adds to the legend of the rebound curve


class NumbersImpact:
    """An impact that psi_1 and chi tell, as figures take it: each quantity in a unit of theory."""

    def __init__(self, view: View) -> None:
        self.losses = view.losses
        self.solution = solve(view.psi, view.chi, losses=view.losses)
        self.duration = self.solution.duration

    def history(self, n: int = HISTORY_TIMES) -> xr.Dataset:
        """Return the impact at n times."""
        solution = self.solution
        numbers = {"friction": 1.0, "max_pressure": solution.max_pressure}
        inputs: dict[str, Any] = {"psi_in": solution.psi_in, "chi": solution.chi}
        if self.losses is not None:
            inputs["losses"] = scale_free(self.losses)._asdict()
        columns = columns_of_numbers(solution.history(n))
        return _in_theory(labelled(columns, numbers, solution.phases, inputs))

    def fields(self, time: float) -> xr.Dataset:
        """Return what the surface of the contact does at a time, in d_max/V_1."""
        bodies: Any = SimpleNamespace(friction=1.0, lateral_ratio=0.0)  # slip along x alone
        contact = contact_in_impact(bodies, SCALES, 0.0, self.solution, time, {})
        return _in_theory(surface_fields(contact))


def _in_theory(dataset: xr.Dataset) -> xr.Dataset:
    for name, unit in PAGE["units_of_numbers"].items():
        if name in dataset.variables:
            dataset.variables[name].attrs["units"] = unit
    return dataset


def history_figure(view: View, _: float = 0.0) -> Figure:
    """Return forces, velocities, radii and energies against time."""
    if not view.in_numbers:
        return plot_impact(impact_of(view).history(HISTORY_TIMES))
    with drawing.style():
        return impact_figure(NumbersImpact(view).history(), TANGENTIAL, "tangential energy")


def contact_figure(view: View, time: float) -> Figure:
    """Return the contact from above at a time that is a share of the duration, or "apart"."""
    hit = _impact(view)
    touching = min(max(time, 0.0), 1.0)
    patch = hit.fields(touching * hit.duration)
    patch["time"].values += (time - touching) * hit.duration  # before the touch, after the last
    return plot_patch(patch)


def course_figure(view: View, _: float = 0.0) -> Figure:
    """Return the contact at several instants, above the course of the force."""
    return plot_contact(_impact(view))


def _impact(view: View) -> Any:
    return NumbersImpact(view) if view.in_numbers else impact_of(view)


def curve_figure(view: View, _: float = 0.0) -> Figure:
    """Return the rebound curve with the contact laws of the view; Busy if one takes too long."""
    outcome = outcome_of(view)
    laws = law_curves(outcome, view.laid_over, LAW_SECONDS, followers.joined())
    if None in laws:
        raise Busy
    return drawn_curve(outcome, [law for law in laws if law is not None])


@drawing.styled
def drawn_curve(outcome: Outcome, laws: list[LawCurve]) -> Figure:
    """Return the rebound curve with the present point and the contact laws over it."""
    figure = plot_curve(curve(outcome.chi, places(outcome), losses=outcome.losses))
    axis = figure.axes[0]
    legend = axis.get_legend()
    entries: list[Any] = [] if legend is None else list(legend.legend_handles)
    for row, law in enumerate(laws):
        look: Any = {"color": drawing.LINES[1 + row % 4], "lw": 0.9 * (1 + row // 16)}
        look["ls"] = drawing.DASHES[1 + row // 4 % 4]
        entries += axis.plot(law.psi_in, law.psi_out, label=law.label, **look)
    if outcome.rubs:
        point: Any = {"marker": "o", "ls": "", "color": drawing.BLACK, "label": "this impact"}
        entries += axis.plot(outcome.psi_in, outcome.psi_out, **point)
    if laws:  # whose names are long
        height = figure.get_figheight() + ENTRY_HEIGHT * drawing.MM * len(laws)
        figure.set_size_inches(1.5 * figure.get_figwidth(), height)
    legend_above(axis, 2, handles=entries)
    return figure


DRAW: dict[str, Callable[[View, float], Figure]] = {
    "curve": curve_figure,
    "history": history_figure,
    "contact": contact_figure,
    "course": course_figure,
}


def write(name: str, view: View, time: float, folder: Path) -> Path:
    """Write a file of a view into a folder; pictures of the contact at a share of the duration."""
    file = folder / name
    if name == "template.csv":
        file.write_text(TEMPLATE, encoding="utf-8")
        return file
    if file.stem in DRAW and file.suffix not in (".csv", ".nc"):
        return save_figure(DRAW[file.stem](view, time), file)
    return save(history_of(view), file)


def history_of(view: View) -> xr.Dataset:
    """Return the history of a view, without units if it tells psi_1 and chi."""
    if not view.in_numbers:
        return impact_of(view).history(HISTORY_TIMES)
    solution = NumbersImpact(view).solution
    history = solution.history(HISTORY_TIMES)
    history = replace(history, speed=history.centre_speed)
    columns: dict[str, Any] = {
        name: ("time", getattr(history, name), {"long_name": meaning, "units": "1"})
        for name, meaning in PAGE["columns_of_numbers"].items()
    }
    time = ("time", history.time, {"long_name": "time, in d_max/V_1", "units": "1"})
    numbers = {"psi_in": view.psi, "chi": view.chi, "psi_out": solution.psi_out}
    if view.on_plate:
        numbers |= {"restitution": solution.restitution, "inelasticity": view.inelasticity}
    elif view.losses:
        numbers |= {"restitution": view.restitution}
    title = {"title": "oblique impact, in the units of carom.solve"}
    return labelled_dataset({**columns, **numbers}, {"time": time}, title)
