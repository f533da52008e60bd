"""Where and how do contact laws of DEM codes go wrong? The figures of law_ranking.py."""

from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from rich.progress import track
from small_pictures import store_small

import carom
from carom.dimensionless.numerics.hertz import DURATION
from carom.plots import style
from carom.plots.legends import legend_above
from carom.plots.regimes import draw_borders
from carom.verify import Ranking, error_map
from carom.verify.errors import INCIDENCES

CHI = 1.4412
SKY = "#56B4E9"
REBOUNDS: dict[str, Any] = {  # laws whose curves are drawn, by their names in the ranking
    "mindlin_rescale/force, 0.78 k_t": {"color": style.GREEN, "ls": style.DASHES[3]},
    "linear spring, k_t/k_n = kappa": {"color": style.BLUE, "ls": style.DASHES[1]},
    "mindlin_rescale/force": {"color": style.PURPLE, "ls": style.DASHES[4]},
    "mindlin": {"color": style.VERMILION, "ls": style.DASHES[2]},
    "linear spring, k_t/k_n = 2/7": {"color": SKY, "ls": "-"},
}
SCALE, TENTH = 0.7, 0.1  # of errors in maps: the end of the colours, what is outlined
SHOWN = {  # in maps and through impacts
    "linear spring, $k_t/k_n = \\kappa$": carom.dem.LinearSpring(),
    "Thornton": carom.dem.ThorntonLaw(),
    "mindlin": carom.dem.LammpsMindlin("mindlin"),
    "mindlin_rescale/force, 0.78 $k_t$": carom.dem.LammpsMindlin(
        "mindlin_rescale/force", stiffness=0.78
    ),
}
THROUGH = (style.BLUE, style.PURPLE, style.VERMILION, style.GREEN)
FREE = {
    "linear spring": carom.dem.LinearSpring,
    "Hertz, linear history": carom.dem.HertzLinearHistory,
    "mindlin": lambda x: carom.dem.LammpsMindlin("mindlin", stiffness=x),
    "mindlin_rescale/force": lambda x: carom.dem.LammpsMindlin(
        "mindlin_rescale/force", stiffness=x
    ),
}
OF_FREE = (style.BLUE, SKY, style.VERMILION, style.PURPLE)
KAPPA = 4.0 * CHI / 7.0


@style.styled
def plot_ranking(ranking: Ranking) -> Figure:
    """Draw the rebounds of some laws beside the exact one, and the errors of all, best first."""
    figure, axes = style.new_figure(1, 2, width=style.DOUBLE, height=88.0, width_ratios=(1, 0.62))
    left, right = axes[0]
    psi, chi = np.linspace(0.0, 7.0, 281), ranking.chi
    style.zero_line(left)
    exact = carom.rebound(psi, chi)
    left.plot(psi, exact, color=style.BLACK, lw=2.2, label="exact")
    standings = {standing.entry.label: standing for standing in ranking.standings}
    for name, look in REBOUNDS.items():
        left.plot(psi, standings[name].entry.law.rebound(psi, chi), label=_formulas(name), **look)
    left.set(xlim=(0.0, 7.0), xlabel=style.label("psi_in"), ylabel=style.label("psi_out"))
    left.set(ylim=(-3.1, 2.1), title="Rebound")
    left.legend(loc="upper left", bbox_to_anchor=(0.17, 1.0))
    for place, (name, standing) in enumerate(standings.items()):
        color = REBOUNDS.get(name, {"color": "0.65"})["color"]
        right.barh(place, standing.max_error, height=0.65, color=color)
        right.annotate(
            f"{standing.max_error:.2f}",
            (standing.max_error, place),
            xytext=(2, 0),
            textcoords="offset points",
            va="center",
            fontsize="small",
        )
    right.set_yticks(range(len(standings)), map(_formulas, standings))
    right.tick_params(axis="y", length=0.0)
    right.set(ylim=(len(standings) - 0.4, -0.6), xlim=(0.0, 1.7))
    right.set_xlabel(r"largest |error in $\psi_2$|")
    right.set_title("Error, the best first")
    for side in ("top", "right"):
        right.spines[side].set_visible(False)
    return figure


def _formulas(name: str) -> str:
    return style.with_formulas(name).replace("$ = $", " = ")


@style.styled
def plot_maps() -> Figure:
    """Draw the errors of four laws over psi_1 and chi, on one scale of colours."""
    figure, axes = style.new_figure(
        2, 2, width=style.DOUBLE, height=112.0, sharex=True, sharey=True
    )
    for axis, (name, law) in zip(axes.flat, SHOWN.items(), strict=True):
        found = error_map(law, chi=np.linspace(7.0 / 6.0, 7.0 / 4.0, 41))
        drawn = _draw_map(axis, found)
        axis.set_title(name, pad=18.0)
    for axis in axes[:, 0]:
        axis.set_ylabel(style.label("chi"))
    for axis in axes[1]:
        axis.set_xlabel(style.label("psi_in"))
    figure.colorbar(drawn, ax=axes, aspect=40).set_label(r"error in $\psi_2$")
    return figure


def _draw_map(axis: Axes, found: Any) -> Any:
    psi, chi, error = (found[name].values for name in ("psi_in", "chi", "error"))
    colors: Any = {"cmap": style.SIGNED_MAP, "vmin": -SCALE, "vmax": SCALE, "shading": "gouraud"}
    drawn = axis.pcolormesh(psi, chi, error, rasterized=True, **colors)
    lines: Any = {"colors": "0.25", "linewidths": 0.6, "linestyles": ["--", "-"]}
    axis.contour(psi, chi, error, levels=[-TENTH, TENTH], **lines)
    axis.set(xlim=(psi[0], psi[-1]), ylim=(chi[0], chi[-1]))
    draw_borders(axis)
    return drawn


@style.styled
def plot_stiffness() -> Figure:
    """Draw the largest error in psi_2 of four laws against their tangential stiffness."""
    figure, axes = style.new_figure(height=66.0)
    axis, stiffness = axes[0, 0], np.geomspace(0.1, 3.0, 121)
    exact = carom.rebound(INCIDENCES, CHI)
    for (name, law), color, dash in zip(FREE.items(), OF_FREE, style.DASHES[1:], strict=True):
        unit = KAPPA if law is carom.dem.LinearSpring else 1.0
        laws = [law(float(unit * x)) for x in stiffness]
        errors = [np.max(np.abs(one.rebound(INCIDENCES, CHI) - exact)) for one in laws]
        axis.plot(stiffness, errors, color=color, ls=dash, label=name)
    axis.axvline(1.0, color="0.5", lw=0.5, zorder=1)
    axis.text(1.05, 1.78, "usual stiffness", color="0.35", fontsize="small")
    axis.set_xscale("log")
    ticks = [0.1, 0.2, 0.5, 1.0, 2.0, 3.0]
    axis.set_xticks(ticks, [f"{tick:g}" for tick in ticks])
    axis.minorticks_off()
    axis.set(xlim=(0.1, 3.0), ylim=(0.0, 1.9), ylabel=r"max |error in $\psi_2$|")
    axis.set_xlabel("tangential stiffness over the usual one")
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
        for (name, law), color, dash in zip(SHOWN.items(), THROUGH, style.DASHES[1:], strict=True):
            history = law.history(psi, CHI, steps=4000)
            time = history["time"] / history["time"][-1]
            axis.plot(time, history["tangential_force"], color=color, ls=dash, lw=1.0, label=name)
        axis.set(xlim=(0.0, 1.0), xlabel="time over the contact's duration")
        axis.set_title(rf"$\psi_1$ = {psi:g}")
    axes[0, 0].set_ylabel(r"$F_x/(\mu F_{z,\max})$")
    handles, _ = axes[0, 0].get_legend_handles_labels()
    figure.legend(handles=handles, loc="outside upper center", ncols=5)
    return figure


def draw_figures(ranking: Ranking, folder: Path) -> None:
    """Draw all figures of the pages into a folder, at two thirds of their size."""
    figures = {"ranking": plot_ranking(ranking), "maps": plot_maps()}
    figures |= {"stiffness": plot_stiffness(), "forces": plot_histories()}
    for name, figure in track(figures.items(), "figures", len(figures)):
        store_small(figure, folder / f"law_{name}.png", all_colors=name == "maps")
