"""Where and how do contact laws of DEM codes go wrong? The figures of law_ranking.py."""

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.figure import Figure
from rich.progress import track
from small_pictures import store_small

import carom
from carom.dimensionless.numerics.hertz import DURATION
from carom.plots import style
from carom.plots.laws import plot_error_map, plot_laws
from carom.plots.legends import legend_above
from carom.verify import error_map
from carom.verify.errors import INCIDENCES

if TYPE_CHECKING:
    import xarray as xr

CHI = 1.4412
MAPS = {  # of errors, on one colour scale
    "spring": carom.dem.LinearSpring(),
    "thornton": carom.dem.ThorntonLaw(),
    "mindlin": carom.dem.LammpsMindlin("mindlin"),
    "softer": carom.dem.LammpsMindlin("mindlin_rescale/force", stiffness=0.78),
}
SCALE = 0.7
SHOWN = {
    "linear spring, $k_t/k_n=\\kappa$": carom.dem.LinearSpring(),
    "Thornton": carom.dem.ThorntonLaw(),
    "mindlin": carom.dem.LammpsMindlin("mindlin"),
    "mindlin_rescale/force, 0.78": carom.dem.LammpsMindlin("mindlin_rescale/force", stiffness=0.78),
}
FREE = {
    "linear spring": carom.dem.LinearSpring,
    "Hertz, linear history": carom.dem.HertzLinearHistory,
    "mindlin": lambda x: carom.dem.LammpsMindlin("mindlin", stiffness=x),
    "mindlin_rescale/force": lambda x: carom.dem.LammpsMindlin(
        "mindlin_rescale/force", stiffness=x
    ),
}
KAPPA = 4.0 * CHI / 7.0
COLORS = (style.BLUE, style.VERMILION, style.GREEN, style.PURPLE)


@style.styled
def plot_stiffness() -> Figure:
    """Draw the largest error in psi_2 of four laws against their tangential stiffness."""
    figure, axes = style.new_figure(height=66.0)
    axis, stiffness = axes[0, 0], np.geomspace(0.1, 3.0, 121)
    exact = carom.rebound(INCIDENCES, CHI)
    for (name, law), color, dash in zip(FREE.items(), COLORS, style.DASHES, strict=False):
        unit = KAPPA if law is carom.dem.LinearSpring else 1.0
        laws = [law(float(unit * x)) for x in stiffness]
        errors = [np.max(np.abs(one.rebound(INCIDENCES, CHI) - exact)) for one in laws]
        axis.plot(stiffness, errors, color=color, ls=dash, label=name)
    axis.axvline(1.0, color="0.5", lw=0.5, zorder=1)
    axis.set_xscale("log")
    ticks = [0.1, 0.2, 0.5, 1.0, 2.0, 3.0]
    axis.set_xticks(ticks, [f"{tick:g}" for tick in ticks])
    axis.minorticks_off()
    axis.set(xlim=(0.1, 3.0), ylim=(0.0, None), ylabel=r"max |error in $\psi_2$|")
    axis.set_xlabel(r"$k_t/(\kappa k_n)$ of linear springs, $k_t/(2G^*b)$ of others")
    legend_above(axis, 2)
    return figure


@style.styled
def plot_histories() -> Figure:
    """Draw the tangential force of four laws and of the exact impact, at three incidences."""
    figure, axes = style.new_figure(1, 3, width=style.DOUBLE, height=62.0)
    parts = np.linspace(0.0, 1.0, 401)
    for axis, psi in zip(axes[0], (0.75, 1.5, 3.0), strict=True):
        solution = carom.solve(psi, CHI).at(parts * DURATION)
        axis.axhline(0.0, color="0.5", lw=0.5, zorder=1)
        axis.plot(parts, 1.5 * solution.force, color=style.BLACK, lw=1.6, label="exact")
        for (name, law), color, dash in zip(SHOWN.items(), COLORS, style.DASHES[1:], strict=True):
            history = law.history(psi, CHI, steps=4000)
            time = history["time"] / history["time"][-1]
            axis.plot(time, history["tangential_force"], color=color, ls=dash, lw=1.0, label=name)
        axis.set(xlim=(0.0, 1.0), xlabel="part of the contact's duration")
        axis.set_title(rf"$\psi_1$ = {psi:g}")
    axes[0, 0].set_ylabel(r"$F_x/(\mu F_{z,\max})$")
    handles, _ = axes[0, 0].get_legend_handles_labels()
    figure.legend(handles=handles, loc="outside upper center", ncols=5)
    return figure


def draw_figures(ranking: "xr.Dataset", folder: Path) -> None:
    """Draw all figures of the page into a folder, at two thirds of their size."""
    figures = {"ranking": plot_laws(ranking)}
    for name, law in MAPS.items():
        found = error_map(law, chi=np.linspace(7.0 / 6.0, 7.0 / 4.0, 41))
        figures[f"map_{name}"] = plot_error_map(found, SCALE)
    figures |= {"stiffness": plot_stiffness(), "forces": plot_histories()}
    for name, figure in track(figures.items(), "figures", len(figures)):
        store_small(figure, folder / f"law_{name}.png", all_colors=name.startswith("map"))
