"""The figure of docs/bulk.md."""

from pathlib import Path

import numpy as np
from bulk import gas, modulus, shear
from bulk.cells import both_ways, flowing, left, over_blocks, sheared
from bulk.contact_laws import EXACT, LAWS
from bulk.results import CELLS, Mean, mean
from matplotlib.axes import Axes
from small_pictures import store_small

from carom.plots import style

PICTURE = Path(__file__).parents[1] / "docs" / "figures" / "bulk.png"
HUES = (style.BLACK, style.VERMILION, style.PURPLE, style.GREEN, style.BLUE, "#56B4E9")
COLORS = dict(zip((law.name for law in LAWS), HUES, strict=True))
DASHES = dict(zip(COLORS, (*style.DASHES, (0, (2, 2))), strict=True))
FRICTION = 0.3
NAMES = {
    "0.78 k_t": "mindlin_rescale/force, 0.78 $k_t$",
    "linear kappa": "linear, $k_t/k_n = \\kappa$",
    "linear 2/7": "linear, $k_t/k_n = 2/7$",
}


def draw_line(axis: Axes, law: str, x: list[float], found: list[Mean]) -> None:
    """Draw a law with its bars."""
    y, bars = zip(*found, strict=True)
    look = {"color": COLORS[law], "lw": 1.6 if law == EXACT.name else 1.0, "capsize": 1.5}
    axis.errorbar(x, y, bars, ls=DASHES[law], elinewidth=0.7, label=NAMES.get(law, law), **look)


def draw_decay(axis: Axes, restitution: float) -> None:
    """Draw what is left of the kinetic energy of a packing."""
    for law in LAWS:
        first = left(law.name, FRICTION, restitution)
        times = sorted({c.where for c in CELLS if c == first._replace(where=c.where)})
        draw_line(axis, law.name, times, [mean(first._replace(where=t)) for t in times])
    axis.set(xscale="log", yscale="log", xlabel="time (durations of an impact)")
    axis.set_ylabel("kinetic energy left")


def draw_modulus(axis: Axes, quantity: str) -> None:
    """Draw modulus or damping ratio against the amplitude of the strain."""
    scale, name = {
        "modulus": (1e3, "shear modulus $G/E$ ($10^{-3}$)"),
        "damping": (100.0, "damping ratio $D$ (%)"),
    }[quantity]
    for law in LAWS:
        cells = [sheared(law.name, FRICTION, strain, quantity) for strain in modulus.STRAINS]
        draw_line(axis, law.name, list(modulus.STRAINS), [mean(c).scaled(scale) for c in cells])
    axis.set(xscale="log", xlabel="amplitude of the shear strain", ylabel=name)
    if quantity == "damping":
        axis.set_yscale("log")


def draw_shear(axis: Axes) -> None:
    """Draw the stress ratio against the inertial number."""
    numbers = sorted(shear.LENGTHS)
    for law in LAWS:
        cells = [flowing(law.name, FRICTION, number, "ratio") for number in numbers]
        draw_line(axis, law.name, numbers, [over_blocks(cell) for cell in cells])
    axis.set(xscale="log", xlabel="inertial number $I$", ylabel="stress ratio $\\tau/p$")


def draw_gas(axis: Axes) -> None:
    """Draw the circle: energies of a gas by events as lines, by time stepping as points."""
    for quantity, color in (("translational", style.BLUE), ("rotational", style.VERMILION)):
        for friction, marker in zip(gas.SEEDS, "so^", strict=True):
            pairs = [both_ways(friction, quantity, float(time)) for time in gas.TIMES]
            stepped, events = zip(*pairs, strict=True)
            axis.plot(gas.TIMES, [m.value for m in events], color=color, lw=0.9)
            few = slice(0, None, 3)
            y, bars = np.array(stepped)[few].T
            look = {"ls": "", "marker": marker, "mfc": "w", "ms": 3.0, "capsize": 1.5}
            label = f"$\\mu$ = {friction:g}" if quantity == "translational" else None
            axis.errorbar(gas.TIMES[few], y, bars, color=color, elinewidth=0.7, label=label, **look)
    axis.set(yscale="log", xlabel="time (mean free times)", ylabel="energy over that of the start")
    axis.set_ylim(0.02, 1.3)
    axis.legend(loc="upper right")
    axis.text(40.5, 0.33, "translational", color=style.BLUE, ha="right")
    axis.text(17, 0.029, "rotational", color=style.VERMILION, ha="right")


@style.styled
def draw() -> None:
    """Draw the figure and store it."""
    figure, axes = style.new_figure(2, 3, width=style.DOUBLE, height=132.0)
    draw_decay(axes[0, 0], 1.0)
    draw_decay(axes[0, 1], 0.9)
    draw_gas(axes[0, 2])
    draw_modulus(axes[1, 0], "modulus")
    draw_modulus(axes[1, 1], "damping")
    draw_shear(axes[1, 2])
    titles = (
        *("Vibrations, friction alone", "Vibrations, $e$ = 0.9", "Gas, exact law"),
        *("Small shear: modulus", "Small shear: damping", "Steady shear: stress"),
    )
    for axis, title in zip(axes.flat, titles, strict=True):
        axis.set_title(title)
    handles, labels = axes[0, 0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside upper center", ncols=3)
    store_small(figure, PICTURE)
