"""Draw docs/figures/measuring.png: what to measure of a rebound, from where, with which sign.

python docs/make/measuring_drawing.py
"""

from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Arc, Circle, Rectangle

from carom.plots import style

FIGURE = Path(__file__).parents[1] / "figures" / "measuring.png"
BEFORE, AFTER, PLAIN = style.BLUE, style.VERMILION, style.BLACK
RADIUS = 0.32
ANGLE, REBOUND = np.radians(50.0), np.radians(38.0)
DASHED = (0, (4, 3))


def sheet(axis: Axes, x: tuple[float, float], y: tuple[float, float]) -> None:
    """Let axes be a sheet to draw on."""
    axis.set(xlim=x, ylim=y, aspect="equal", anchor="N")
    axis.set_axis_off()


def write(axis: Axes, x: float, y: float, words: str, colour: str = PLAIN, **look: Any) -> None:
    """Write words around a place, unless they are aligned otherwise."""
    axis.text(x, y, words, color=colour, **{"ha": "center", "va": "center", **look})


def title(axis: Axes, x: float, y: float, words: str) -> None:
    """Write what a drawing shows above it."""
    write(axis, x, y, words, fontweight="bold")


def arrow(
    axis: Axes, start: Any, end: Any, colour: str, words: str = "", beside: Any = 0.0, **look: Any
) -> None:
    """Draw an arrow, with words beside its middle."""
    plain = {"arrowstyle": "-|>", "color": colour, "lw": 1.1, "mutation_scale": 7}
    line = {**plain, "shrinkA": 0, "shrinkB": 0, **look}
    axis.annotate("", end, start, arrowprops=line, zorder=2.5)
    write(axis, *(0.5 * np.add(start, end) + beside), words, colour)


def turn(axis: Axes, centre: Any, radius: float, first: float, last: float, colour: str) -> None:
    """Draw an arrow around a centre from one angle to another, in degrees."""
    turned = radius * np.exp(1j * np.radians(np.linspace(first, last, 60)))
    line = np.column_stack([centre[0] + turned.real, centre[1] + turned.imag])
    axis.plot(*line[:-4].T, color=colour, lw=1.1)
    arrow(axis, line[-6], line[-1], colour)


def floor(axis: Axes, left: float, right: float, depth: float = 0.16) -> None:
    """Draw the second body."""
    axis.add_patch(Rectangle((left, -depth), right - left, depth, fc="#E4E4E4", ec="none"))
    axis.plot([left, right], [0.0, 0.0], color=PLAIN, lw=1.0)


def ball(axis: Axes, place: Any, colour: str, dashes: str = "-") -> None:
    """Draw a ball and its centre."""
    axis.add_patch(Circle(place, RADIUS, fc="white", ec=colour, lw=1.1, ls=dashes, zorder=3))
    axis.plot(*place, "o", ms=2, color=colour, zorder=4)


def oblique(axis: Axes) -> None:
    """Draw an oblique impact: angles, speeds, spins."""
    touch = np.array([0.0, RADIUS])
    towards = np.array([np.sin(ANGLE), -np.cos(ANGLE)])
    away = np.array([np.sin(REBOUND), np.cos(REBOUND)])
    first, last = touch - 1.75 * towards, touch + 1.95 * away
    floor(axis, -1.9, 1.8)
    axis.plot([0.0, 0.0], [RADIUS, 1.95], color=PLAIN, lw=0.7, ls=DASHED)
    write(axis, 0.04, 1.97, "normal", ha="left")
    ball(axis, touch, PLAIN, "--")
    for place, move, colour in ((first, 0.75 * towards, BEFORE), (last, 0.6 * away, AFTER)):
        axis.plot(*zip(place, touch, strict=True), color=colour, lw=0.7, ls=(0, (1.5, 1.5)))
        ball(axis, place, colour)
        arrow(axis, place, place + move, colour)
    write(axis, first[0] + 0.38, first[1] + 0.12, "speed", BEFORE, ha="left", va="baseline")
    write(axis, last[0] + 0.46, last[1] + 0.42, "rebound_speed", AFTER, ha="left")
    angles = 90.0 + np.degrees([ANGLE, -REBOUND])
    axis.add_patch(Arc(touch, 1.7, 1.7, theta1=90.0, theta2=angles[0], color=BEFORE, lw=0.9))
    axis.add_patch(Arc(touch, 2.1, 2.1, theta1=angles[1], theta2=90.0, color=AFTER, lw=0.9))
    write(axis, -0.42, 1.3, "angle", BEFORE, va="baseline")
    write(axis, 0.05, 1.6, "rebound_angle\n> 0: flies on", AFTER, ha="left", fontsize=6.5)
    turn(axis, first, 1.35 * RADIUS, 175.0, 270.0, BEFORE)
    write(axis, first[0] - 0.52, first[1] - 0.6, "spin > 0\n(backspin)", BEFORE)
    turn(axis, last, 1.35 * RADIUS, 100.0, 0.0, AFTER)
    write(axis, last[0] + 0.12, last[1] - 0.52, "spin_out < 0\n(topspin)", AFTER, ha="left")
    arrow(axis, (0.0, 0.0), (0.5, 0.0), PLAIN)
    write(axis, 0.42, -0.08, "$+x$: contact point before", ha="left", fontsize=6.5)
    rim = touch + 0.7 * RADIUS * np.array([-1.0, 1.0])
    axis.plot(*zip(touch, rim, strict=True), color=PLAIN, lw=0.8, zorder=5)
    write(axis, -0.12, 0.53, "$R$", zorder=5)
    title(axis, 0.1, 2.72, "Oblique impact")
    sheet(axis, (-2.15, 2.35), (-0.22, 2.8))


def drop(axis: Axes) -> None:
    """Draw a vertical drop: heights of the lowest point."""
    floor(axis, -0.9, 1.5)
    places = ((0.0, 1.75, BEFORE, "drop_height"), (0.85, 1.05, AFTER, "rebound_height"))
    for x, bottom, colour, words in places:
        ball(axis, (x, bottom + RADIUS), colour)
        axis.plot([x - 0.42, x + 0.42], [bottom, bottom], color=colour, lw=0.6)
        arrow(axis, (x - 0.36, 0.0), (x - 0.36, bottom), colour, arrowstyle="<|-|>")
        write(axis, x - 0.43, 0.5 * bottom, words, colour, rotation=90, ha="right")
    title(axis, 0.3, 2.72, "Vertical drop")
    sheet(axis, (-1.0, 1.6), (-0.22, 2.8))


@style.styled
def main() -> None:
    """Draw and store."""
    figure, axes = style.new_figure(1, 2, width=style.DOUBLE, height=73.0, width_ratios=(4.5, 2.6))
    oblique(axes[0, 0])
    drop(axes[0, 1])
    figure.savefig(FIGURE, dpi=200)


if __name__ == "__main__":
    main()
