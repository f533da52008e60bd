"""An impact in the course of time: forces, velocities, radii, energies; and its path of forces."""

from collections.abc import Callable, Iterable, Sequence
from typing import Any, NamedTuple, Unpack

import matplotlib
import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from carom.plots import style
from carom.plots.bands import BANDS, SIGNS, phases, shade
from carom.plots.drawing import Drawable, draws
from carom.plots.legends import legend_above, legend_outside
from carom.plots.look import Look
from carom.quantities.arrays import Array
from carom.quantities.glossary import GLOSSARY

ENERGIES = {
    "normal_kinetic_energy": ("normal motion", "#E8EEF4", ""),
    "tangential_kinetic_energy": ("tangential motion", "#A9CCE6", "...."),
    "spin_kinetic_energy": ("spin", "#5B9BC8", ""),
    "normal_elastic_energy": ("elastic, normal", "#F6E3B4", "////"),
    "tangential_elastic_energy": ("elastic, tangential", "#E69F00", ""),
    "frictional_work": ("lost to friction", "#6E6E6E", "\\\\\\\\"),
}
SPUN = {  # what of it friction takes
    "normal_spin_kinetic_energy": ("normal spin", "#009E73", "oo")
}
LOST = {  # where there is any
    "normal_loss": ("normal losses", "#DDA6C3", "xxxx"),
    "shear_loss": ("losses in shear", "#B07AA1", "----"),
}

HISTORY = "the history of an impact, what Impact.history returns"
FORCES = ("tangential_force", "normal_force", "friction", "time")
VELOCITIES = ("contact_velocity", "normal_velocity")
TWO_COLUMNS = 130.0  # mm that two panels beside each other need, with fonts of the usual size
RADII = ("contact_radius", "stick_radius", "time")
ENERGY = ("normal_kinetic_energy", "tangential_kinetic_energy", "spin_kinetic_energy")
MANY = matplotlib.colormaps["viridis"]  # of more impacts than there are colours of lines


class Curve(NamedTuple):
    """A curve against time: its name in the legend, SI values of a history, dash; None: no unit."""

    name: str
    values: Callable[[xr.Dataset], Array]
    dash: Any = style.DASHES[0]
    quantity: str | None = None


def _variable(name: str) -> Callable[[xr.Dataset], Array]:
    return lambda history: np.asarray(history[name].values, dtype=np.float64)


def limit_of(history: xr.Dataset) -> Array:
    """Return the largest force that friction bears, mu F_z, in N."""
    return np.asarray(float(history["friction"]) * history["normal_force"].values)


def _stick(history: xr.Dataset) -> Array:
    """Return the radius of the stick zone while there is one, to where it has shrunk to nothing."""
    stick, contact = history["stick_radius"].values, history["contact_radius"].values
    before = np.concatenate([[0.0], stick[:-1]])
    return np.where((stick > 0.0) | (before > 0.0) | (contact == 0.0), stick, np.nan)


def _lost(history: xr.Dataset) -> Array:
    """Return the work of friction as a share of the energy before the impact."""
    before = sum(float(history[name][0]) for name in (*ENERGY, *SPUN) if name in history)
    return np.asarray(history["frictional_work"].values / (before or 1.0))


FORCE, DASHED = "tangential_force", style.DASHES[1]
CURVES: tuple[tuple[Curve, ...], ...] = (
    (
        Curve("$F_x$", _variable(FORCE), quantity=FORCE),
        Curve(r"$\pm\mu F_z$", limit_of, DASHED, FORCE),
        Curve("", lambda history: -limit_of(history), DASHED, FORCE),
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


@draws(HISTORY, *FORCES, *VELOCITIES, *RADII, *ENERGIES, along="time", several=True)
def plot_impact(dataset: Drawable, **look: Unpack[Look]) -> Figure:
    """Draw forces, velocities, radii and energies of an impact against time.

    Bands show the phases; their hatch leans with the sign of slip. Of several impacts the lines are
    laid over each other, without bands, and the energy is the share that friction takes.

    Examples
    --------
    >>> len(carom.plots.plot_impact(hit).axes)
    4
    >>> steeper = carom.impact(pair, speed=2.0, angle="10 deg")
    >>> figure = carom.plots.plot_impact({"10 deg": steeper, "30 deg": hit}, width=140.0)
    """
    return impact_figure(dataset)


def impact_figure(
    dataset: Any, energies: dict[str, tuple[str, str, str]] = ENERGIES, of: str = "energy"
) -> Figure:
    """Return what `plot_impact` draws, with these energies as shares of this one."""
    beside = 2 if style.room(style.DOUBLE) > TWO_COLUMNS else 1
    size: Any = {"width": style.DOUBLE, "height": 112.0}
    if beside == 1:
        size = {"width": style.SINGLE, "height": 200.0, "keep_height": True}
    figure, axes = style.new_figure(4 // beside, beside, sharex=True, **size)
    if isinstance(dataset, dict):
        handles = overlay(axes.flat, dataset, CURVES)
    else:
        for axis, panel in zip(
            axes.flat, (forces_panel, velocities_panel, radii_panel), strict=False
        ):
            panel(axis, dataset)
        energies_panel(axes.flat[3], dataset, energies, of)
        handles = phase_handles(dataset)
    for axis in axes[:-1].flat:
        axis.set_xlabel("")
    legend_outside(figure, handles, 5)
    return figure


@draws(HISTORY, *FORCES, along="time", several=True)
def plot_forces(dataset: Drawable, **look: Unpack[Look]) -> Figure:
    """Draw the tangential force between its limits, mu F_z, against time, in one column.

    Examples
    --------
    >>> len(carom.plots.plot_forces(hit.history(50)).axes)
    1
    """
    return _single(dataset, forces_panel, CURVES[0])


@draws(HISTORY, *RADII, along="time", several=True)
def plot_radii(dataset: Drawable, **look: Unpack[Look]) -> Figure:
    """Draw the radii of the contact and of its stick zone against time, in one column.

    Examples
    --------
    >>> len(carom.plots.plot_radii(hit.history(50)).axes)
    1
    """
    return _single(dataset, radii_panel, CURVES[2])


def _single(dataset: Any, panel: Any, curves: tuple[Curve, ...]) -> Figure:
    figure, axis = style.single_axis()
    if isinstance(dataset, dict):
        legend_outside(figure, overlay([axis], dataset, [curves]), 4)
        return figure
    panel(axis, dataset)
    lines, _ = axis.get_legend_handles_labels()
    legend_above(axis, 3, handles=[*lines, *phase_handles(dataset)])
    return figure


def phase_handles(dataset: xr.Dataset) -> list[Patch]:
    """Return what a legend shows of the phases of an impact, each kind and sign once."""
    present = {(phase.kind, phase.sign) for phase in phases(dataset)}
    return [band.key(of[0] + SIGNS[of[1]]) for of, band in BANDS.items() if of in present]


def time_axis(axis: Axes, dataset: xr.Dataset) -> Array:
    """Shade the phases, label the axis of time, and return the times in its unit."""
    time, unit, scale = style.scaled(dataset, "time")
    for phase in phases(dataset):
        shade(axis, phase.start * scale, phase.end * scale, BANDS[phase.kind, phase.sign])
    style.span(axis, time)
    axis.set_xlabel(style.label("time", unit))
    return time


def forces_panel(axis: Axes, dataset: xr.Dataset) -> None:
    """Draw F_x between -mu F_z and mu F_z."""
    time, limit = time_axis(axis, dataset), limit_of(dataset)
    force, unit, scale = style.scaled(dataset, "tangential_force", like=limit)
    style.zero_line(axis)
    axis.plot(time, force, color=style.BLUE, label="$F_x$")
    style.limit_lines(axis, time, limit * scale, r"$\pm\mu F_z$")
    axis.set_ylabel(style.label("tangential_force", unit))
    legend_above(axis, 2)


def force_at(history: xr.Dataset, fields: xr.Dataset) -> tuple[float, float]:
    """Return where the instant of fields is in the panel of the forces of a history."""
    force = style.scaled(history, "tangential_force", like=limit_of(history)).scale
    time = style.scaled(history, "time").scale
    return float(fields["time"]) * time, float(fields["tangential_force"]) * force


def velocities_panel(axis: Axes, dataset: xr.Dataset) -> None:
    """Draw the velocity of the contact point, tangential, and that of approach."""
    time = time_axis(axis, dataset)
    names = {"contact_velocity": "$V_x$, contact point", "normal_velocity": "$V_z$, approach"}
    largest = [np.abs(dataset[name].values).max() for name in names]
    style.zero_line(axis)
    units = {name: style.scaled(dataset, name, like=largest).unit for name in names}
    alike = len(set(units.values())) == 1  # those of a dimensionless impact differ
    for name, color, dash in zip(names, (style.BLUE, style.VERMILION), style.DASHES, strict=False):
        values, unit, _ = style.scaled(dataset, name, like=largest)
        label = names[name] if alike else f"{names[name]}\u00a0({unit})"
        axis.plot(time, values, color=color, ls=dash, label=label)
    axis.set_ylabel(f"$V_x$, $V_z$\u00a0({unit})" if alike else "$V_x$, $V_z$")
    legend_above(axis, 2)


def radii_panel(axis: Axes, dataset: xr.Dataset) -> None:
    """Draw the radii of the contact and of its stick zone; what lies between slips."""
    time = time_axis(axis, dataset)
    contact, unit, scale = style.scaled(dataset, "contact_radius")
    axis.plot(time, contact, color=style.BLACK, label="contact, $b$")
    stick = _stick(dataset) * scale
    axis.plot(time, stick, color=style.BLUE, ls=style.DASHES[1], label="stick zone, $a$")
    style.span(axis, y=(0.0, 1.06 * contact.max()))
    axis.set_ylabel(f"$a$, $b$\u00a0({unit})")
    legend_above(axis, 2)


def energies_panel(
    axis: Axes, dataset: xr.Dataset, energies: dict[str, tuple[str, str, str]], of: str
) -> None:
    """Draw how the energy is shared between motion, deformation, friction and other losses."""
    time = time_axis(axis, dataset)
    lost = {name: look for name, look in LOST.items() if name in dataset}
    lossy = any(np.any(dataset[name].values) for name in lost)
    drawn = energies | lost if lossy else energies
    parts = np.array([dataset[name].values for name in drawn])
    if all(name in dataset for name in SPUN):
        drawn = drawn | SPUN
        spun = (dataset[name].values for name in SPUN)  # all of it would hide the others
        parts = np.vstack([parts, *(energy - energy[-1] for energy in spun)])
    total = float(parts[:, 0].sum()) or 1.0
    shares = axis.stackplot(time, parts / total, colors=[face for _, face, _ in drawn.values()])
    for area, (name, _, hatch) in zip(shares, drawn.values(), strict=True):
        area.set(label=name, hatch=hatch, edgecolor="0.35", linewidth=0.4)
    axis.set_ylim(0.0, 1.0)
    axis.set_ylabel(f"share of {of}")
    legend_above(axis, 3, handlelength=1.0, handletextpad=0.3, columnspacing=0.5, fontsize="small")


def overlay(
    axes: Iterable[Axes], named: dict[str, xr.Dataset], courses: Sequence[tuple[Curve, ...]]
) -> list[Any]:
    """Draw the curves of several impacts on axes, and return what a legend shows of the impacts."""
    longest = max(float(history["time"].max()) for history in named.values())
    times, unit = style.prefixed(longest, "s")
    for axis, curves in zip(axes, courses, strict=True):
        _lay_over(axis, named, curves, times)
        style.span(axis, (0.0, longest * times))
        axis.set_xlabel(style.label("time", unit))
    colors = _colors(len(named))
    return [Line2D([], [], color=c, label=name) for c, name in zip(colors, named, strict=True)]


def _colors(count: int) -> Sequence[Any]:
    if count <= len(style.LINES):
        return style.LINES[:count]
    return [MANY(place) for place in np.linspace(0.0, 0.9, count)]


def _lay_over(
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
