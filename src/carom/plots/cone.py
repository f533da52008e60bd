"""The path of the forces inside the cone of friction, or inside its circle."""

from collections.abc import Iterator
from typing import Any, Unpack

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from carom.plots import style
from carom.plots.bands import phases
from carom.plots.drawing import Drawable, draws
from carom.plots.legends import legend_above
from carom.plots.look import Look
from carom.quantities.arrays import Array

PATHS: dict[str, dict[str, Any]] = {
    "stick": {"color": style.BLUE, "ls": "-", "lw": 2.0},
    "slip": {"color": style.VERMILION, "ls": style.DASHES[1], "lw": 1.5},
    "gross slip": {"color": style.BLACK, "ls": style.DASHES[2], "lw": 2.0},
    "load path": {"color": style.BLUE, "ls": "-", "lw": 1.2},
}
AHEAD = 0.02  # from the foot to the head of an arrow, as a share of the figure
APART = 0.1  # between the heads of arrows, likewise
SHORTEST_PHASE = 0.15  # with an arrow
ARROWS = 8  # on a path without phases


@draws(
    "the course of an impact or a load path, what Impact.history or LoadPath.to_dataset returns",
    *("normal_force", "tangential_force", "friction"),
)
def plot_cone(dataset: Drawable, **look: Unpack[Look]) -> Figure:
    """Draw F_x against F_z inside Coulomb's cone, |F_x| <= mu F_z, for an impact or a load path.

    The parts of an impact are marked by phase; arrows point on in time. A load path of two
    directions is drawn along the contact, F_y against F_x in units of mu F_z.

    Examples
    --------
    >>> axis = carom.plots.plot_cone(hit.history(50)).axes[0]
    >>> [text.get_text() for text in axis.get_legend().get_texts()[1:]]
    ['gross slip', 'stick', 'slip']
    """
    if "direction" in dataset.dims:
        return _draw_circle(dataset)
    figure, axis = style.single_axis(height=70.0)
    limit = 1.08 * float(dataset["friction"]) * float(dataset["normal_force"].max())
    normal, unit, _ = style.scaled(dataset, "normal_force")
    tangential, tangential_unit, scale = style.scaled(dataset, "tangential_force", like=limit)
    edge = (1.08 * float(normal.max()) or 1.0, limit * scale or 1.0)  # without friction a line
    _draw_cone(axis, *edge)
    points = np.column_stack([normal, tangential])
    for kind, part in _parts(dataset, points):
        labelled = axis.get_legend_handles_labels()[1]
        axis.plot(*part.T, **PATHS[kind], label=None if kind in labelled else kind)
        for ends in _apart(_arrows(part / edge, 1 if kind != "load path" else ARROWS)):
            _arrow(axis, ends * edge, PATHS[kind]["color"])
        if kind == "load path":
            _mark_ends(axis, part)
    axis.set_xlabel(style.label("normal_force", unit))
    axis.set_ylabel(style.label("tangential_force", tangential_unit))
    legend_above(axis, 4)
    return figure


def _draw_circle(dataset: xr.Dataset) -> Figure:
    figure, axis = style.single_axis(height=86.0)
    force = dataset["tangential_force"].transpose("step", "direction").values
    most = float(dataset["friction"]) * dataset["normal_force"].values[:, None]
    points = np.divide(force, most, out=np.zeros(force.shape), where=most > 0.0)
    turn = np.linspace(0.0, 2.0 * np.pi, 181)
    circle = np.column_stack([np.cos(turn), np.sin(turn)])
    axis.fill(*circle.T, color="0.94", lw=0, zorder=0)
    axis.plot(*circle.T, color="0.45", lw=0.8, label=r"$\mu F_z$")
    axis.plot(*points.T, **PATHS["load path"], label="load path")
    for ends in _apart(_arrows(points, ARROWS)):
        _arrow(axis, ends, PATHS["load path"]["color"])
    _mark_ends(axis, points)
    ticks = [-1.0, -0.5, 0.0, 0.5, 1.0]
    axis.set(aspect="equal", xticks=ticks, yticks=ticks)
    axis.set(xlabel=r"$F_x/\mu F_z$", ylabel=r"$F_y/\mu F_z$")
    legend_above(axis, 4)
    return figure


def _mark_ends(axis: Axes, points: Array) -> None:
    axis.plot(*points[0], "o", mfc="white", color=style.BLUE, ms=6.0, label="start")
    axis.plot(*points[-1], "o", color=style.BLUE, ms=3.0, label="end")


def _draw_cone(axis: Axes, normal: float, tangential: float) -> None:
    corners, limit = np.array([0.0, normal]), np.array([0.0, tangential])
    axis.fill_between(corners, -limit, limit, color="0.94", lw=0, zorder=0)
    axis.plot(corners, limit, color="0.45", lw=0.8, label=r"$\pm\mu F_z$")
    axis.plot(corners, -limit, color="0.45", lw=0.8)
    axis.axhline(0.0, color="0.6", lw=0.5, zorder=1)
    style.span(axis, (0.0, normal), (-1.02 * tangential, 1.02 * tangential))


def _parts(dataset: xr.Dataset, points: Array) -> Iterator[tuple[str, Array]]:
    """Yield the phases with the points of each, from the last before it on; a load path whole."""
    phases_of_path = phases(dataset)
    if not phases_of_path:
        yield "load path", points
        return
    time = dataset["time"].values
    for phase in phases_of_path:
        first = max(int(np.searchsorted(time, phase.start, side="right")) - 1, 0)
        last = int(np.searchsorted(time, phase.end, side="right"))
        yield phase.kind, points[first:last]


def _arrows(points: Array, count: int) -> list[Array]:
    """Return foot and head of arrows, evenly along a path."""
    steps = np.hypot(*np.diff(points, axis=0).T)
    along = np.concatenate([[0.0], np.cumsum(steps)])
    if along[-1] <= SHORTEST_PHASE:
        return []
    feet = (np.arange(count) + 0.4) / count * along[-1]
    ends = np.column_stack([feet, feet + AHEAD])
    return list(np.stack([np.interp(ends, along, line) for line in points.T], axis=-1))


def _apart(arrows: list[Array]) -> list[Array]:
    """Return the arrows that come to lie on no earlier one: a path may be retraced."""
    kept: list[Array] = []
    for ends in arrows:
        if all(np.hypot(*(ends[1] - other[1])) > APART for other in kept):
            kept.append(ends)
    return kept


def _arrow(axis: Axes, ends: Array, color: str) -> None:
    head = "-|>,head_length=0.6,head_width=0.3"
    axis.annotate("", ends[1], ends[0], arrowprops={"arrowstyle": head, "color": color, "lw": 1.0})
