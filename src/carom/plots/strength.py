"""The speeds that bodies bear, against the angle of incidence and the coefficient of friction."""

from typing import Unpack

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator

from carom.plots import style
from carom.plots.drawing import Drawable, draws
from carom.plots.look import Look
from carom.quantities.arrays import Array
from carom.quantities.refusals import InputError, refuse

MOST_LINES = len(style.LINES)  # more coefficients of friction than this make a map
LEVELS = 24  # of a map
TICKS = (1.0, 2.0, 5.0)  # of each decade, labelled on axes and curves
TITLES = {
    "yield_speed": "{} body yields",
    "tensile_speed": "{} body, tensile strength",
    "crack_speed": "{} body, flaws crack",
}
SPEEDS = tuple(f"{name}_{body}" for name in TITLES for body in ("first", "second"))


@draws("speeds that bodies bear, what carom.bearable_speeds returns", "friction", "angle", "status")
def plot_strength(dataset: Drawable, **look: Unpack[Look]) -> Figure:
    """Draw the speeds from which on bodies yield or crack: lines, or maps of many frictions.

    Raises
    ------
    InputError
        If the dataset is another one, has one angle, or no speed in it is finite.

    Examples
    --------
    >>> ball = carom.Sphere(radius="5 mm", material="bearing steel")
    >>> pair = carom.Pair(ball, carom.HalfSpace(material="bearing steel"), friction=0.2)
    >>> figure = carom.plots.plot_strength(carom.bearable_speeds(pair, angle=["0 deg", "60 deg"]))
    >>> len(figure.axes)
    2
    """
    names = [n for n in SPEEDS if n in dataset and np.isfinite(dataset[n].values).any()]
    refuse(not names and "plot_strength: no speed in this dataset is finite; there is no limit")
    if dataset.sizes["angle"] < 2:
        raise InputError("plot_strength: one angle makes no curve; give two or more")
    columns = min(len(names), 2)
    rows = -(-len(names) // columns)
    width = style.SINGLE if columns == 1 else style.DOUBLE
    figure, axes = style.new_figure(rows, columns, width=width, height=62.0 * rows)
    for axis, name in zip(axes.flat, names, strict=False):
        many = dataset.sizes["friction"] > MOST_LINES
        quantity, _, body = name.rpartition("_")
        axis.set_title(TITLES[quantity].format(body))
        (_map if many else _lines)(axis, dataset, name)
        axis.set_xlabel(style.label("angle", "deg"))
    for axis in axes.flat[len(names) :]:
        axis.set_axis_off()
    return figure


def _table(dataset: xr.Dataset, name: str) -> Array:
    """Return speeds, a row for each friction; nothing where they have no bound."""
    values = dataset[name].transpose("friction", "angle").values
    return np.where(np.isfinite(values), values, np.nan)


def _lines(axis: Axes, dataset: xr.Dataset, name: str) -> None:
    angle, friction = np.degrees(dataset["angle"].values), dataset["friction"].values
    for i, (mu, row) in enumerate(zip(friction, _table(dataset, name), strict=True)):
        text = f"{style.label('friction')} = {mu:g}"
        axis.plot(angle, row, color=style.LINES[i], ls=style.DASHES[i], label=text)
    axis.set_yscale("log")
    axis.yaxis.set_major_locator(LogLocator(subs=TICKS))
    axis.yaxis.set_major_formatter("{x:g}")
    axis.yaxis.set_minor_formatter("")
    axis.set_ylabel(style.label(name))
    style.span(axis, angle)
    axis.legend(loc="upper left")


def _map(axis: Axes, dataset: xr.Dataset, name: str) -> None:
    angle, friction = np.degrees(dataset["angle"].values), dataset["friction"].values
    values = _table(dataset, name)
    low, high = np.nanmin(values), np.nanmax(values)
    shades = np.geomspace(low, high * (1.0 + 1e-9), LEVELS)
    axis.contourf(angle, friction, values, shades, cmap=style.MAP, norm=LogNorm(low, high))
    decades = 10.0 ** np.arange(np.floor(np.log10(low)), np.ceil(np.log10(high)) + 1)
    levels = np.outer(decades, TICKS).ravel()
    levels = levels[(levels > low) & (levels < high)]
    if levels.size:
        curves = axis.contour(angle, friction, values, levels, colors="white", linewidths=0.7)
        axis.clabel(curves, fmt=lambda speed: f"{speed:g}", fontsize="small")
    axis.set_title(f"{axis.get_title()}: {style.label(name)}")
    axis.set_ylabel(style.label("friction"))
    style.span(axis, angle, friction)
