"""Several impacts laid over each other: the same curves of each, in a colour of its own."""

from collections.abc import Callable, Iterable, Sequence
from typing import Any, NamedTuple

import matplotlib
import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.lines import Line2D

from carom.plots import style
from carom.plots.legends import legend_above
from carom.quantities.arrays import Array
from carom.quantities.glossary import GLOSSARY

ENERGY = ("normal_kinetic_energy", "tangential_kinetic_energy", "spin_kinetic_energy")
SPUN = "normal_spin_kinetic_energy"  # where there is any
MANY = matplotlib.colormaps["viridis"]  # of more impacts than there are colours of lines


class Curve(NamedTuple):
    """A curve against time: its name in the legend, SI values of a history, dash; None: no unit."""

    name: str
    values: Callable[[xr.Dataset], Array]
    dash: Any = style.DASHES[0]
    quantity: str | None = None


def _variable(name: str) -> Callable[[xr.Dataset], Array]:
    return lambda history: np.asarray(history[name].values, dtype=np.float64)


def _limit(history: xr.Dataset) -> Array:
    return np.asarray(float(history["friction"]) * history["normal_force"].values)


def stick_line(stick: Array, contact: Array) -> Array:
    """Return the radius of the stick zone while there is one, to where it has shrunk to nothing.

    Stick that begins all over the contact is no line from zero: there is none in gross slip.
    """
    before = np.concatenate([[0.0], stick[:-1]])
    return np.where((stick > 0.0) | (before > 0.0) | (contact == 0.0), stick, np.nan)


def _stick(history: xr.Dataset) -> Array:
    return stick_line(history["stick_radius"].values, history["contact_radius"].values)


def _lost(history: xr.Dataset) -> Array:
    """Return the work of friction as a share of the energy before the impact."""
    before = sum(float(history[name][0]) for name in (*ENERGY, SPUN) if name in history)
    return np.asarray(history["frictional_work"].values / (before or 1.0))


FORCE, DASHED = "tangential_force", style.DASHES[1]
CURVES: tuple[tuple[Curve, ...], ...] = (
    (
        Curve("$F_x$", _variable(FORCE), quantity=FORCE),
        Curve(r"$\pm\mu F_z$", _limit, DASHED, FORCE),
        Curve("", lambda history: -_limit(history), DASHED, FORCE),
    ),
    (
        Curve("$V_x$", _variable("contact_velocity"), quantity="contact_velocity"),
        Curve("$V_z$", _variable("normal_velocity"), DASHED, "contact_velocity"),
    ),
    (
        Curve("$b$", _variable("contact_radius"), quantity="contact_radius"),
        Curve("$a$", _stick, DASHED, "contact_radius"),
    ),
    (Curve("lost to friction", _lost),),
)


def overlay(
    axes: Iterable[Axes], named: dict[str, xr.Dataset], courses: Sequence[tuple[Curve, ...]]
) -> list[Any]:
    """Draw the curves of several impacts on axes, and return what a legend shows of the impacts."""
    longest = max(float(history["time"].max()) for history in named.values())
    times, unit = style.prefixed(longest, "s")
    for axis, curves in zip(axes, courses, strict=True):
        _draw(axis, named, curves, times)
        style.span(axis, (0.0, longest * times))
        axis.set_xlabel(style.label("time", unit))
    colors = _colors(len(named))
    return [Line2D([], [], color=c, label=name) for c, name in zip(colors, named, strict=True)]


def _colors(count: int) -> Sequence[Any]:
    if count <= len(style.LINES):
        return style.LINES[:count]
    return [MANY(place) for place in np.linspace(0.0, 0.9, count)]


def _draw(
    axis: Axes, named: dict[str, xr.Dataset], curves: tuple[Curve, ...], times: float
) -> None:
    quantity = curves[0].quantity
    values = {curve: [curve.values(history) for history in named.values()] for curve in curves}
    every = np.concatenate([line for lines in values.values() for line in lines])
    scale, unit = style.prefixed(every, GLOSSARY[quantity].unit) if quantity else (1.0, "1")
    style.zero_line(axis)
    colors = _colors(len(named))
    for curve, lines in values.items():
        for i, (history, line) in enumerate(zip(named.values(), lines, strict=True)):
            stroke: Any = {"color": colors[i], "ls": curve.dash}
            width = 1.2 if curve.dash == style.DASHES[0] else 0.7
            axis.plot(history["time"] * times, line * scale, lw=width, **stroke)
    symbols = ", ".join(curve.name for curve in curves if curve.name)
    axis.set_ylabel(symbols if unit == "1" else f"{symbols}\u00a0({unit})")
    keys = [Line2D([], [], color=style.BLACK, ls=c.dash, label=c.name) for c in curves if c.name]
    if len(curves) > 1:
        legend_above(axis, 2, handles=keys)
