"""The figure of the page on the coupling."""

from pathlib import Path

import numpy as np
from coupling_plan import ANGLES, BEST, BETA, FALLS, FRICTION, KAPPA, OTHERS, SLIPS, Rows
from coupling_tables import (
    DATA,
    SETS,
    SHARES,
    Coulomb,
    elements,
    found,
    measured,
    misfits,
    profiled,
    spun,
)
from matplotlib.axes import Axes
from scipy.interpolate import PchipInterpolator
from scipy.stats import f as fisher
from small_pictures import store_small

from carom.plots import style
from carom.plots.legends import legend_above

PICTURE = Path(__file__).parents[1] / "docs" / "figures" / "coupling.png"


def draw_restitutions(axis: Axes, rows: Rows, full: Coulomb) -> None:
    """Draw what was measured, both solutions, and the full one with other surfaces."""
    angles = np.linspace(1.0, 33.0, 200)
    lines = {
        "theory": full.at(angles, FRICTION, KAPPA, 0.0),
        "full solution": full.at(angles, FRICTION, KAPPA, BETA),
    }
    changed = {
        "3 times the friction at small slip": BEST,
        "friction falls as $p^{-1/3}$": OTHERS[2],
        "a layer that shears": OTHERS[7],
    }
    for name, variant in changed.items():
        lines[name] = PchipInterpolator(ANGLES, found(rows, variant), extrapolate=False)(angles)
    for (name, e_t), color, dash in zip(lines.items(), style.LINES, style.DASHES, strict=True):
        axis.plot(angles, e_t, color=color, ls=dash, label=name)
    for data, marker in zip(DATA, "osD", strict=True):
        angle, e_t, at, spin = measured(data)
        points = {"ms": 3.0, "ls": "", "marker": marker, "zorder": 5}
        first = data == DATA[0]
        axis.plot(angle, e_t, color="k", mfc="w", label="measured" if first else None, **points)
        from_spin = 1.0 - spin / spun(at, np.zeros(1))
        axis.plot(at, from_spin, color="0.5", label="from the spin" if first else None, **points)
    axis.set(xlim=(0.0, 33.0), ylim=(0.56, 0.81), xlabel="angle of incidence (°)")
    axis.set_ylabel("tangential restitution $e_t$")
    legend_above(axis, 2, columnspacing=0.6)


def draw_slips(axis: Axes, rows: Rows, full: Coulomb) -> None:
    """Draw how well a friction fits that falls with slip."""
    for ratio, color, dash in zip(FALLS, style.LINES, style.DASHES, strict=True):
        group = [variant for variant in SLIPS if variant.strength == ratio]
        off = [misfits(found(rows, variant))[0] for variant in group]
        scales = [1e6 * variant.scale for variant in group]
        axis.plot(scales, off, color=color, ls=dash, marker="o", label=f"{ratio:g}")
    for name, beta in (("full solution", BETA), ("theory", 0.0)):
        off = misfits(full.at(np.array(ANGLES), FRICTION, KAPPA, beta))[0]
        axis.axhline(off, color="0.5", lw=0.6)
        axis.annotate(
            name,
            (1.0, off),
            (0, 2 if beta else -8),
            textcoords="offset points",
            ha="right",
            fontsize=7,
        )
    axis.set(xscale="log", ylim=(0.0, 0.082), xlabel="$s_0$ (µm)")
    axis.set_ylabel("rms misfit of $e_t$, 1.8° to 30°")
    axis.set_xticks([0.2, 0.3, 0.5, 1.0], ["0.2", "0.3", "0.5", "1"])
    axis.minorticks_off()
    title = "friction before any slip over that in sliding"
    legend_above(axis, 5, title=title, handlelength=1.4, columnspacing=0.8)


def draw_shares(axis: Axes, full: Coulomb) -> None:
    """Draw how well each share of the coupling fits, kappa as in handbooks or free."""
    for (sets, name), color in zip(SETS.items(), style.LINES, strict=False):
        for free, dash in ((False, "-"), (True, (0, (4, 1.5)))):
            fit = profiled(full, measured(DATA[0]), sets, free)
            label = None if free else name
            axis.plot(SHARES, fit.excess, color=color, ls=dash, label=label)
    axis.axhline(fisher.ppf(0.95, 1, 12), color="0.5", lw=0.6)
    axis.annotate("dashed: $\\kappa$ free", (0.03, 20.0), fontsize=7)
    axis.annotate("95 %", (1.1, 4.9), va="bottom", ha="right", fontsize=7)
    axis.set(ylim=(0.0, 30.0), xlabel=r"$\beta$ over that of the pair")
    axis.set_ylabel("$F$")
    legend_above(axis, 3)


def draw_elements(axis: Axes, rows: Rows) -> None:
    """Draw finite elements and the full solution, less the theory."""
    x, theirs, ours, uncoupled = elements(rows)
    axis.plot(x, ours - uncoupled, color=style.LINES[1], ls=style.DASHES[1], label="full solution")
    axis.errorbar(x, theirs - uncoupled, 0.05, **style.POINTS, label="finite elements")
    style.zero_line(axis)
    axis.set(ylim=(-0.25, 0.25), xlabel=r"$V_x/(\mu V_1)$ before the impact")
    axis.set_ylabel(r"$V_x'/(\mu V_1')$ less the theory's")
    legend_above(axis, 2)


@style.styled
def draw(rows: Rows, full: Coulomb) -> None:
    """Draw the figure of the page."""
    figure, axes = style.new_figure(2, 2, width=style.DOUBLE, height=140.0)
    draw_restitutions(axes[0, 0], rows, full)
    draw_slips(axes[0, 1], rows, full)
    draw_shares(axes[1, 0], full)
    draw_elements(axes[1, 1], rows)
    for axis, letter in zip(axes.flat, "abcd", strict=True):
        axis.annotate(f"({letter})", (-0.15, 1.03), xycoords="axes fraction", fontsize=8)
    store_small(style.save_figure(figure, PICTURE), PICTURE)
