"""Figures, drawn from datasets: a stored file is drawn without solving again."""

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from carom.quantities import GLOSSARY
from carom.results import FIGURES, checked_output, replace_whole

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

BANDS = {"stick": "#56B4E9", "slip": "#E69F00", "gross slip": "#999999"}
SHARES = ("#8FBBDA", "#8FD0B5", "#EDB687")
LINES = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#000000")


def plot_impact(dataset: "xr.Dataset") -> "Figure":
    """Draw forces, velocities, radii and energies of an impact against time, phases shaded."""
    figure, axes = _figure(2, 2, (9.0, 6.4))
    scale, unit = _time_unit(float(dataset["time"][-1]))
    time = dataset["time"].values * scale
    for axis in axes.flat:
        _shade_phases(axis, dataset, scale)
        axis.set_xlim(time[0], time[-1])
        axis.axhline(0.0, color="0.6", linewidth=0.6)
    _forces(axes[0, 0], dataset, time)
    _velocities(axes[0, 1], dataset, time)
    _radii(axes[1, 0], dataset, time)
    _energies(axes[1, 1], dataset, time)
    for axis in axes[1]:
        axis.set_xlabel(f"time since the first touch, $t$ ({unit})")
    figure.legend(*_phase_legend(dataset), loc="outside upper center", ncols=4, frameon=False)
    return figure


def plot_curve(dataset: "xr.Dataset") -> "Figure":
    """Draw psi_2 against psi_1, one line per chi, with the straight line of sliding throughout."""
    figure, axes = _figure(1, 1, (6.4, 4.4))
    axis = axes[0, 0]
    psi = dataset["psi_in"].values
    axis.axhline(0.0, color="0.6", linewidth=0.6)
    for row, chi in enumerate(dataset["chi"].values):
        color = LINES[row % len(LINES)]
        out = dataset["psi_out"].values[row]
        axis.plot(psi, out, color=color, label=rf"$\chi$ = {chi:g}")
        borders = dataset["border"].values[row]
        inside = (borders > psi[0]) & (borders < psi[-1])
        axis.plot(borders[inside], np.interp(borders[inside], psi, out), "o", color=color, ms=4)
    axis.set_xlabel(GLOSSARY["psi_in"].label())
    axis.set_ylabel(GLOSSARY["psi_out"].label())
    axis.set_xlim(psi[0], psi[-1])
    axis.legend(frameon=False, title="dots: borders of regimes")
    return figure


def save_figure(figure: "Figure", path: str | Path) -> Path:
    """Store a figure as .png, .pdf or .svg; one that is there is replaced whole or not at all."""
    target = checked_output(path, FIGURES)
    return replace_whole(target, lambda where: figure.savefig(where, dpi=160))


def _figure(rows: int, columns: int, size: tuple[float, float]) -> tuple["Figure", Any]:
    from matplotlib.figure import Figure

    figure = Figure(figsize=size, layout="constrained")
    return figure, figure.subplots(rows, columns, squeeze=False, sharex=True)


def _time_unit(duration: float) -> tuple[float, str]:
    for scale, unit in ((1.0, "s"), (1e3, "ms"), (1e6, "µs"), (1e9, "ns")):
        if duration * scale >= 1.0:
            return scale, unit
    return 1e12, "ps"


def _shade_phases(axis: "Axes", dataset: "xr.Dataset", scale: float) -> None:
    for kind, start, end in _phases(dataset):
        axis.axvspan(start * scale, end * scale, color=BANDS[kind], alpha=0.2, linewidth=0)


def _phases(dataset: "xr.Dataset") -> list[tuple[str, float, float]]:
    columns = (dataset[f"phase_{name}"].values for name in ("kind", "start", "end"))
    return [
        (str(kind), float(start), float(end)) for kind, start, end in zip(*columns, strict=True)
    ]


def _phase_legend(dataset: "xr.Dataset") -> tuple[list[Any], list[str]]:
    from matplotlib.patches import Patch

    kinds = [kind for kind in BANDS if kind in {row[0] for row in _phases(dataset)}]
    return [Patch(color=BANDS[kind], alpha=0.3, linewidth=0) for kind in kinds], kinds


def _forces(axis: "Axes", dataset: "xr.Dataset", time: Any) -> None:
    limit = float(dataset["friction"]) * dataset["normal_force"].values
    axis.plot(time, limit, color="0.4", linestyle="--", linewidth=1, label=r"$\pm\mu F_z$")
    axis.plot(time, -limit, color="0.4", linestyle="--", linewidth=1)
    axis.plot(time, dataset["tangential_force"], color=LINES[0], label="$F_x$")
    _finish(axis, "tangential force (N)")


def _velocities(axis: "Axes", dataset: "xr.Dataset", time: Any) -> None:
    axis.plot(time, dataset["contact_velocity"], color=LINES[0], label="$V_x$, contact point")
    axis.plot(time, dataset["normal_velocity"], color=LINES[1], label="$V_z$, normal")
    _finish(axis, "velocity (m/s)")


def _radii(axis: "Axes", dataset: "xr.Dataset", time: Any) -> None:
    contact, stick = (dataset[name].values * 1e6 for name in ("contact_radius", "stick_radius"))
    axis.plot(time, contact, color=LINES[4], label="contact, $b$")
    axis.plot(time, stick, color=LINES[0], label="stick zone, $a$")
    axis.fill_between(time, stick, contact, color=LINES[1], alpha=0.25, linewidth=0, label="slip")
    _finish(axis, "radius (µm)", "lower center")


def _energies(axis: "Axes", dataset: "xr.Dataset", time: Any) -> None:
    shares = {
        "tangential_kinetic_energy": "kinetic",
        "tangential_elastic_energy": "elastic",
        "frictional_work": "lost to friction",
    }
    start = float(dataset["tangential_kinetic_energy"][0]) or 1.0
    parts = [dataset[name].values / start for name in shares]
    axis.stackplot(time, parts, labels=list(shares.values()), colors=SHARES)
    _finish(axis, "share of tangential energy", "upper right")


def _finish(axis: "Axes", label: str, place: Any = "best") -> None:
    axis.set_ylabel(label)
    axis.legend(fontsize="small", loc=place, facecolor="white", edgecolor="none", framealpha=0.75)
