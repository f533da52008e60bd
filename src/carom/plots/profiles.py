"""Pressure, traction and memory along a line through the contact, zones shaded."""

from typing import Any, Unpack

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from carom.plots import style
from carom.plots.bands import STICK, Band, moment, shade, slip_band
from carom.plots.drawing import Drawable, at_instant, draws
from carom.plots.legends import legend_above
from carom.plots.look import AXES, Look
from carom.quantities.arrays import Array
from carom.quantities.refusals import InputError

MARGIN = 1.2  # of a line through the contact, in contact radii
NEAR = 1e-9  # relative: a y that is 0 but for rounding


@draws(
    "fields on the line y = 0 or along the radius, what Impact.fields or Impact.radial returns",
    *("pressure", "traction_x", "contact_radius", "stick_radius", "friction"),
    take=at_instant("radial", "fields"),
)
def plot_profiles(dataset: Drawable, *, at: Any = None, **look: Unpack[Look]) -> Figure:
    """Draw the traction f_x between its limits, mu p, along the line y = 0 of the contact.

    Of a profile along the radius also the memory: g = -dq/ds, and the deflection q of the springs.

    Raises
    ------
    InputError
        If the dataset has no points on the line y = 0.

    Examples
    --------
    >>> len(carom.plots.plot_profiles(hit.radial("21 us")).axes)
    3
    """
    radial = "memory_g" in dataset
    figure, axes = style.new_figure(
        3 if radial else 1, height=118.0 if radial else 62.0, sharex=True
    )
    line = dataset if radial else _middle(dataset)
    name = "distance" if radial else "x"
    place, unit, scale = style.scaled(line, name)
    reach = (1.0 if radial else MARGIN) * float(line["contact_radius"]) * scale
    for axis in axes.flat:
        _shade_zones(axis, line, scale, place)
        style.zero_line(axis)
        style.span(axis, (max(place[0], -reach), min(place[-1], reach)))
    _tractions(axes[0, 0], line, place)
    if radial:
        _memory(axes[1, 0], line, place)
        _deflection(axes[2, 0], line, place)
    axes[-1, 0].set_xlabel(style.label(name, unit))
    if AXES.get() is None:
        figure.suptitle(moment(dataset))
        figure.align_ylabels()
    else:
        axes[0, 0].get_legend().set_title(moment(dataset))
    return figure


def _middle(dataset: xr.Dataset) -> xr.Dataset:
    """Return the fields at the points with y = 0, in order of x."""
    y = np.atleast_1d(dataset["y"].values)
    along = "point" if "point" in dataset.dims else "y"
    if along == "y" and y.size > 1 and y[0] < 0.0 < y[-1] and not np.any(np.abs(y) <= NEAR * y[-1]):
        return dataset.interp(y=0.0)  # between the rows of elements
    line = dataset.isel({along: np.flatnonzero(np.abs(y) <= NEAR * np.abs(y).max())})
    if along == "point":
        line = line.sortby("x")
    elif line.sizes["y"]:
        line = line.isel(y=0)
    places = line["x"].values
    if places.size < 2 or line["pressure"].size != places.size or not np.all(np.diff(places) > 0.0):
        raise InputError("fields: they hold no line through the contact; give points with y = 0")
    return line


def _shade_zones(axis: Axes, line: xr.Dataset, scale: float, place: Array) -> None:
    contact, stick = (float(line[name]) * scale for name in ("contact_radius", "stick_radius"))
    for side in (-1.0, 1.0) if place[0] < 0.0 else (1.0,):
        if stick > 0.0:
            shade(axis, 0.0, side * stick, STICK)
        if contact > stick:
            shade(axis, side * stick, side * contact, slip_band(line))


def _tractions(axis: Axes, line: xr.Dataset, place: Array) -> None:
    limit = float(line["friction"]) * line["pressure"].values
    traction, unit, scale = style.scaled(line, "traction_x", like=limit)
    axis.plot(place, traction, color=style.BLUE, label="$f_x$")
    style.limit_lines(axis, place, limit * scale, r"$\pm\mu p$")
    axis.set_ylabel(style.label("traction_x", unit))
    lines, _ = axis.get_legend_handles_labels()
    legend_above(axis, 4, handles=[*lines, *zone_handles(line)])


def profile_panel(axis: Axes, fields: xr.Dataset, reach: float, scale: float) -> None:
    """Draw the traction between its limits along y = 0, to a `reach` in m, times a scale."""
    line = _middle(fields)
    place, unit, length = style.scaled(line, "x", like=reach)
    _shade_zones(axis, line, length, place)
    style.zero_line(axis)
    axis.plot(place, line["traction_x"] * scale, color=style.BLUE)
    limit = float(line["friction"]) * line["pressure"].values
    style.limit_lines(axis, place, limit * scale)
    style.span(axis, (-reach * length, reach * length))
    axis.set_xlabel(style.label("x", unit))


def zone_handles(dataset: xr.Dataset) -> list[Patch]:
    """Return what a legend shows of the zones that a contact has."""
    contact, stick = (float(dataset[name]) for name in ("contact_radius", "stick_radius"))
    zones: list[tuple[str, Band]] = [("stick", STICK)] if stick > 0.0 else []
    zones += [("slip", slip_band(dataset))] if contact > stick else []
    return [band.key(name) for name, band in zones]


def _memory(axis: Axes, line: xr.Dataset, place: Array) -> None:
    axis.plot(place, line["memory_g"], color=style.VERMILION)
    for limit in (-1.0, 1.0):
        axis.axhline(limit, color=style.BLACK, ls=style.DASHES[1], lw=0.8)
    axis.set_ylim(-1.15, 1.15)
    axis.set_ylabel(style.label("memory_g"))


def _deflection(axis: Axes, line: xr.Dataset, place: Array) -> None:
    limit = line["memory_limit"].values
    scale, unit = style.prefixed(limit, "m")
    axis.plot(place, line["memory_q"].values * scale, color=style.BLUE)
    style.limit_lines(axis, place, limit * scale)
    axis.set_ylabel(style.label("memory_q", unit))
