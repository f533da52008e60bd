"""Results against the exact answer: psi_2 and its errors, or a history of forces and its errors."""

from typing import Any, Unpack

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from carom.plots import style
from carom.plots.drawing import Drawable, draws
from carom.plots.impact import phase_handles, time_axis
from carom.plots.legends import legend_above, legend_outside
from carom.plots.look import Look
from carom.plots.regimes import shade_regimes
from carom.quantities.arrays import Array

ALLOWED: Any = {"color": "0.35", "ls": style.DASHES[2], "lw": 0.8, "zorder": 1}
GIVEN: Any = {"mfc": "white", "mec": style.BLACK, "mew": 0.8, "ls": ""}
MARKED = 100  # more times make a line
FAR = 2.0  # times the psi_1 from which all slides: beyond it a figure has little to show
MARGIN, ROOM = 0.03, 0.12  # beyond what is shown, along psi_1 and the error
MARKERS, EDGES = "os^Dv<>p", (style.BLACK, style.VERMILION, style.GREEN, style.PURPLE)
LONGEST_NAME = 40  # characters, in a legend
LEGEND_ROW = 4.0  # in mm
SMALL = 1e-6  # an error that is told as less than that


@draws("a score, what carom.verify.score returns", "error", "psi_in", "psi_out", "tolerance")
def plot_score(dataset: Drawable, **look: Unpack[Look]) -> Figure:
    """Draw results beside the exact answer, and their errors with the tolerance below.

    A rebound curve or velocities: psi_2 against psi_1, the regimes as bands. A history: forces and
    their errors against time, the phases of the exact impact as bands. The legend names code and
    law, if the dataset tells them, and the largest error of each.

    Examples
    --------
    >>> psi = [0.5, 1.0, 2.0, 4.0]
    >>> result = carom.verify.score({"psi_1": psi, "psi_2": [0.05, -0.06, -0.84, -1.51]}, chi=1.44)
    >>> len(carom.plots.plot_score(result.to_dataset()).axes)
    2
    """
    return _forces(dataset) if "normal_force_exact" in dataset else _points(dataset)


def _points(dataset: xr.Dataset) -> Figure:
    markers = _markers(dataset)
    height = 98.0 + LEGEND_ROW * (len(markers) - 1)
    figure, axes = style.new_figure(2, 1, height=height, sharex=True, height_ratios=(1.6, 1.0))
    upper, lower = axes[:, 0]
    whole, dataset = dataset, _near(dataset)
    psi = dataset["psi_in"].values
    if left_out := whole["psi_in"].size - psi.size:
        note = rf"{left_out} more at larger $|\psi_1|$"
        place: Any = {"xytext": (0, -18), "textcoords": "offset points", "ha": "right", "va": "top"}
        lower.annotate(note, (1.0, 0.0), xycoords="axes fraction", **place)
    low, high = min(0.0, psi.min()), max(0.0, psi.max())
    room = MARGIN * (high - low) or 1.0
    low -= room * (low < 0.0)
    _exact(upper, dataset, (low, high + room))
    for name, marker in markers.items():
        where = _names(dataset) == name
        out = dataset["psi_out"].values[where]
        upper.plot(psi[where], out, label=_label(whole, name), **marker)
        lower.plot(psi[where], dataset["error"].values[where], **marker)
    _tolerance(lower, dataset["error"].values, float(dataset["tolerance"]))
    upper.set_xlim(low, high + room)
    bands = _bands(upper, dataset)
    _bands(lower, dataset)
    upper.set_ylabel(style.label("psi_out"))
    lower.set(xlabel=style.label("psi_in"), ylabel=r"error in $\psi_2$")
    legend_outside(figure, upper.get_legend_handles_labels()[0], 2)
    if bands:
        legend_above(upper, 2, handles=bands)
    legend_above(lower, 2)
    return figure


def _near(dataset: xr.Dataset) -> xr.Dataset:
    """Return the results that do not lie far in gross slip, if there are others."""
    border = np.maximum(1.0, 4.0 * dataset["chi"].values - 1.0)
    inside = np.abs(dataset["psi_in"].values) <= FAR * border
    return dataset.isel(point=np.flatnonzero(inside)) if inside.any() else dataset


def _names(dataset: xr.Dataset) -> Any:
    """Return what computed each result, code and law, or "results"."""
    origins = [dataset[name].values.tolist() for name in ("code", "law") if name in dataset]
    if not origins:
        return np.full(dataset["psi_in"].size, "results", dtype=object)
    rows = (", ".join(filter(None, row)) for row in zip(*origins, strict=True))
    return np.array([row or "results" for row in rows], dtype=object)


def _markers(dataset: xr.Dataset) -> dict[str, Any]:
    """Return how the results of each code and law are drawn, by its name."""
    names = dict.fromkeys(_names(dataset))
    return {
        name: GIVEN | {"marker": MARKERS[i % len(MARKERS)], "mec": EDGES[i % len(EDGES)]}
        for i, name in enumerate(names)
    }


def _label(dataset: xr.Dataset, name: str) -> str:
    """Return the name of results for a legend, and how far they are off at most."""
    error = float(np.abs(dataset["error"].values[_names(dataset) == name]).max())
    short = name if len(name) <= LONGEST_NAME else f"{name[: LONGEST_NAME - 1]}…"
    plain = short.replace("$", r"\$")  # no formula of matplotlib's
    off = f"{error:.2g}" if error >= SMALL else f"less than {SMALL:g}"
    return rf"{' ' * plain.startswith('_')}{plain} ($\psi_2$ off by {off})"


def _exact(axis: Axes, dataset: xr.Dataset, span: tuple[float, float]) -> None:
    """Draw the exact psi_2 between two psi_1: curves, or points where curves were too many."""
    style.zero_line(axis)
    psi = dataset["psi_in"].values
    if "curve_psi_out" in dataset:
        chis = dataset["curve_chi"].values
        along = dataset["curve_psi_in"].values
        shown = (along >= span[0]) & (along <= span[1])
        for row, chi in enumerate(np.unique(chis)):
            where = shown & (chis == chi)
            line = [dataset[f"curve_psi_{side}"].values[where] for side in ("in", "out")]
            color, dash = (some[row % len(some)] for some in (style.LINES, style.DASHES))
            axis.plot(*line, label=rf"exact, $\chi$ = {chi:.5g}", color=color, ls=dash)
    else:
        exact = dataset["psi_out_exact"].values
        axis.plot(psi, exact, "x", ms=4.5, color=style.BLUE, zorder=3, label="exact")


def _bands(axis: Axes, dataset: xr.Dataset) -> list[Patch]:
    """Shade the regimes of a single chi, and return what a legend shows of them."""
    limits = axis.get_xlim()
    keys = shade_regimes(axis, dataset["border"].values if "border" in dataset else None, *limits)
    axis.set_xlim(limits)
    return keys


def _tolerance(axis: Axes, error: Array, tolerance: float) -> None:
    """Draw zero and the tolerance, and let the axis take in both and all errors."""
    style.zero_line(axis)
    axis.axhline(tolerance, label=f"tolerance, ±{tolerance:g}", **ALLOWED)
    axis.axhline(-tolerance, **ALLOWED)
    low, high = min(error.min(), -tolerance), max(error.max(), tolerance)
    room = ROOM * (high - low)
    axis.set_ylim(low - room, high + room)


def _forces(dataset: xr.Dataset) -> Figure:
    size: Any = {"width": style.DOUBLE, "height": 104.0, "height_ratios": (1.6, 1.0)}
    figure, axes = style.new_figure(2, 2, sharex=True, **size)
    friction, peak = float(dataset["friction"]), float(dataset["max_force"])
    drawn = (
        ("tangential_force", friction * peak, r"$F_x$, in $\mu P_{max}$"),
        ("normal_force", peak, "$F_z$, in $P_{max}$"),
    )
    for (upper, lower), (name, unit, words) in zip(axes.T, drawn, strict=True):
        time = _force(upper, dataset, name)
        difference = (dataset[name].values - dataset[f"{name}_exact"].values) / unit
        time_axis(lower, dataset)
        lower.plot(time, difference, color=style.VERMILION)
        _tolerance(lower, difference, float(dataset["tolerance"]))
        lower.set_ylabel(f"error in {words}")
        legend_above(lower, 2)
    figure.legend(handles=phase_handles(dataset), loc="outside upper center", ncols=5)
    return figure


def _force(axis: Axes, dataset: xr.Dataset, name: str) -> Array:
    """Draw a force as it was given over the exact one, and return the times in their unit."""
    time = time_axis(axis, dataset)
    axis.set_xlabel("")
    style.zero_line(axis)
    exact = dataset[f"{name}_exact"].values
    force, unit, scale = style.scaled(dataset, name, like=exact)
    axis.plot(time, exact * scale, color=style.BLUE, label="exact")
    how = {"marker": "o", "ms": 2.0, "ls": ""} if time.size <= MARKED else {"ls": style.DASHES[1]}
    axis.plot(time, force, color=style.VERMILION, label=_label(dataset, _names(dataset)[0]), **how)
    if name == "tangential_force":
        limit = float(dataset["friction"]) * dataset["normal_force_exact"].values * scale
        style.limit_lines(axis, time, limit, r"$\pm\mu F_z$, exact")
    axis.set_ylabel(style.label(name, unit))
    legend_above(axis, 3)
    return time
