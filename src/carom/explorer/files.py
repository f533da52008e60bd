"""The files of the page as they are written: histories, pictures, the template for a fit."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import xarray as xr
from matplotlib.figure import Figure

from carom.dimensionless.solution import solve
from carom.explorer.figures import contact_figure, course_figure, curve_figure, history_figure
from carom.explorer.scenes import TIMES, impact_of
from carom.explorer.views import View
from carom.fitting.template import TEMPLATE
from carom.io.files import save
from carom.io.labels import labelled_dataset
from carom.plots import save_figure

DRAW: dict[str, Callable[[View, float], Figure]] = {
    "curve": curve_figure,
    "history": history_figure,
    "contact": contact_figure,
    "course": course_figure,
}
MEANINGS = {  # of the columns of `Solution.history`
    "penetration": "penetration, in d_max",
    "speed": "normal speed of approach, in V_1",
    "psi": "velocity of the contact point, in mu V_1/kappa",
    "displacement": "tangential displacement, in mu d_max/kappa",
    "force": "(2/3) F_x/(mu P_max)",
    "stick_radius": "radius of the stick zone, in sqrt(R* d_max)",
    "contact_radius": "radius of the contact, in sqrt(R* d_max)",
    "stored": "tangential elastic energy; that of motion is psi^2/2",
    "dissipated": "work of friction, as above",
    "normal_force": "F_z/P_max",
    "normal_stored": "normal elastic energy, in that of the impact",
    "shear_lost": "what viscosity took in shear, in psi^2/2",
    "normal_lost": "what the normal motion lost, as above",
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
        return impact_of(view).history(TIMES)
    solution = solve(view.psi, view.chi, losses=view.losses)
    history = solution.history(TIMES)
    columns: dict[str, Any] = {
        name: ("time", getattr(history, name), {"long_name": meaning, "units": "1"})
        for name, meaning in MEANINGS.items()
    }
    time = ("time", history.time, {"long_name": "time, in d_max/V_1", "units": "1"})
    numbers = {"psi_in": view.psi, "chi": view.chi, "psi_out": solution.psi_out}
    numbers |= {"restitution": view.restitution} if view.losses else {}
    title = {"title": "oblique impact, in the units of carom.solve"}
    return labelled_dataset({**columns, **numbers}, {"time": time}, title)
