"""Wear of a contact by impacts: along the distance from its centre, and seen from above."""

from typing import Unpack

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Circle

from carom.plots import style
from carom.plots.drawing import Drawable, draws
from carom.plots.look import Look

AT_CENTRE = 1e-3  # of the contact: nearer than that to it is in it
MARGIN = 1.05  # of the map around the contact
WORK, DEPTH = "friction_work", "wear_depth"


@draws(
    "the wear of one spot, what Impact.wear, or carom.wear_of_many without an area, returns",
    *("mean_friction_work", "distance", "max_wear_radius"),
    along="distance",
    take="wear",
)
def plot_wear(dataset: Drawable, **look: Unpack[Look]) -> Figure:
    """Draw the depth of wear, or else the work of friction per area, around and over the contact.

    Of impacts on one spot, what `carom.wear_of_many` returns, there is no map.

    Examples
    --------
    >>> carom.plots.plot_wear(hit.wear()).axes[0].get_ylabel()
    '$\\\\bar W_A$\\xa0(kJ/m²)'
    """
    name = DEPTH if f"mean_{DEPTH}" in dataset else WORK
    mapped = name in dataset
    if mapped:
        style.check_grid(dataset, name, "y", "x")
    width = style.DOUBLE if mapped else style.SINGLE
    figure, axes = style.new_figure(1, 1 + mapped, width=width, height=66.0)
    _profile(axes[0, 0], dataset, f"mean_{name}")
    if mapped:
        _map(figure, axes[0, 1], dataset, name)
    return figure


def _profile(axis: Axes, dataset: xr.Dataset, name: str) -> None:
    distance, unit, length = style.scaled(dataset, "distance")
    values, unit_of_values, _ = style.scaled(dataset, name)
    axis.plot(distance, values, color=style.BLUE)
    most = float(dataset["max_wear_radius"])
    if values.any():
        axis.axvline(most * length, color=style.BLACK, ls=style.DASHES[1], lw=0.8)
        where = f"{style.label('max_wear_radius', '1')} = {most * length:.3g}\u00a0{unit}"
        beside = most > AT_CENTRE * float(dataset["distance"].max())
        axis.set_title(f"largest at {where}" if beside else "largest in the centre")
    style.span(axis, distance)
    axis.set_ylim(bottom=0.0)
    axis.set(xlabel=style.label("distance", unit), ylabel=style.label(name, unit_of_values))


def _map(figure: Figure, axis: Axes, dataset: xr.Dataset, name: str) -> None:
    x, unit, length = style.scaled(dataset, "x")
    y = dataset["y"].values * length
    values, unit_of_values, _ = style.scaled(dataset, name)
    shading = axis.pcolormesh(x, y, values, cmap=style.MAP, shading="gouraud", rasterized=True)
    edge = float(dataset["max_radius"]) * length
    shading.set_clip_path(Circle((0.0, 0.0), edge, transform=axis.transData))
    axis.add_patch(Circle((0.0, 0.0), edge, fill=False, ec="black", lw=1.0))
    axis.set_aspect("equal")
    axis.set(xlabel=style.label("x", unit), ylabel=style.label("y", unit))
    reach = MARGIN * edge
    style.span(axis, np.clip(x, -reach, reach), np.clip(y, -reach, reach))
    figure.colorbar(shading, ax=axis, label=style.label(name, unit_of_values), pad=0.02, aspect=28)
