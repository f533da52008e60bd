"""The stress below the surface: a map with contours, and where the largest lies."""

from typing import Any, Unpack

import numpy as np
from matplotlib.axes import Axes
from matplotlib.contour import ContourSet
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from carom.plots import style
from carom.plots.bands import MINUS, is_apart, moment
from carom.plots.drawing import Drawable, at_instant, draws
from carom.plots.look import Look
from carom.quantities.arrays import Array
from carom.quantities.refusals import one_of, refuse

CONTOURS, TICKS = 9, 8
NEAR = 1e-6  # relative: a largest stress that lies in the plane drawn


@draws(
    "stresses on a grid of z and x, what Impact.stress returns", "z", "x", take=at_instant("stress")
)
def plot_stress(
    dataset: Drawable, variable: str = "von_mises", *, at: Any = None, **look: Unpack[Look]
) -> Figure:
    """Draw a stress in the plane y = 0 below the surface, with contours; a cross at the largest.

    The bar on the surface is the contact.

    Parameters
    ----------
    variable : str
        Which stress, e.g. "von_mises", "max_shear", "principal_1", "sigma_xx".

    Raises
    ------
    InputError
        If the dataset has no such stress, or not on a grid.

    Examples
    --------
    >>> figure = carom.plots.plot_stress(hit.stress("21 us"), "max_shear")
    >>> figure.axes[0].get_ylabel()
    '$z$\\xa0(µm)'
    """
    if dataset["von_mises"].ndim == 2:
        style.check_grid(dataset, "von_mises", "z", "x")
    mapped = [str(name) for name, item in dataset.items() if item.dims == ("z", "x")]
    refuse(not mapped and "stress: a map needs it on a grid of z and x, not at points")
    one_of("variable", variable, mapped)
    figure, axis = style.single_axis(height=66.0)
    x, unit, length = style.scaled(dataset, "x")
    z = dataset["z"].values * length
    values, stress_unit, scale = style.scaled(dataset, variable)
    colours = style.colours(variable, values)
    shading = axis.pcolormesh(x, z, values, shading="gouraud", rasterized=True, **colours)
    bar = figure.colorbar(shading, ax=axis, location="bottom", aspect=32, pad=0.03)
    bar.set_label(style.label(variable, stress_unit))
    if np.ptp(values) > 0.0:
        contours = _contours(axis, x, z, values, colours["cmap"] == style.SIGNED_MAP)
        bar.add_lines(contours)
        low, high = shading.get_clim()
        ticks = MaxNLocator(TICKS).tick_values(low, high)
        bar.set_ticks([tick for tick in ticks if low <= tick <= high])
    if "contact_radius" in dataset:
        contact = float(dataset["contact_radius"]) * length
        bar_below: Any = {"color": "black", "lw": 3.0, "solid_capstyle": "butt"}
        axis.plot([-contact, contact], [0.0, 0.0], clip_on=False, **bar_below)
    said = [moment(dataset)]
    if not is_apart(dataset):
        column, row, largest = _largest(dataset, variable)
        _mark(axis, column * length, row * length)
        said.append(f"+: {largest * scale:.3g}\u00a0{stress_unit}".replace("-", MINUS))

    axis.set_aspect("equal")
    axis.set(xlim=(x[0], x[-1]), ylim=(z.max(), z.min()))
    axis.set(xlabel=style.label("x", unit), ylabel=style.label("z", unit))
    axis.set_title("; ".join(text for text in said if text), pad=5.0)
    return figure


def _mark(axis: Axes, x: float, z: float) -> None:
    (mark,) = axis.plot(x, z, "+", ms=7.0, mew=1.3, color="black", clip_on=False, zorder=5)
    style.stroke_white(mark, 2.8)


def _contours(axis: Axes, x: Array, z: Array, values: Array, signed: bool) -> ContourSet:
    low, high = values.min(), values.max()
    levels = [at for at in MaxNLocator(CONTOURS).tick_values(low, high) if low < at < high]
    dark = ["white" if level < 0.5 * (low + high) else "black" for level in levels]
    colors: Any = "0.25" if signed else dark
    return axis.contour(
        x, z, values, levels=levels, colors=colors, linewidths=0.6, negative_linestyles="solid"
    )


def _largest(dataset: Drawable, variable: str) -> tuple[float, float, float]:
    """Return x, z and value of the largest stress: between the grid's points where it is known."""
    name = f"max_{variable}"
    if name in dataset and abs(float(dataset[f"{name}_y"])) < NEAR * float(dataset["x"].max()):
        return float(dataset[f"{name}_x"]), float(dataset[f"{name}_z"]), float(dataset[name])
    values = dataset[variable].values
    row, column = np.unravel_index(np.argmax(np.abs(values)), values.shape)
    return float(dataset["x"][column]), float(dataset["z"][row]), float(values[row, column])
