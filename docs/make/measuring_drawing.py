"""Draw docs/figures/measuring.png: what to measure of a rebound, from where, with which sign.

python docs/make/measuring_drawing.py
"""

from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Arc, Circle, FancyArrowPatch, Rectangle

from carom.plots import style

FIGURE = Path(__file__).parents[1] / "figures" / "measuring.png"
BEFORE, AFTER, PLAIN = style.BLUE, style.VERMILION, style.BLACK
RADIUS = 0.32
ANGLE, REBOUND = np.radians(50.0), np.radians(38.0)


def arrow(
    axis: Axes, start: Any, end: Any, colour: str, *, ends: str = "-|>", bend: float = 0.0
) -> None:
    """Draw an arrow, straight or bent."""
    axis.add_patch(
        FancyArrowPatch(
            *(start, end),
            arrowstyle=ends,
            mutation_scale=7,
            lw=1.1,
            color=colour,
            shrinkA=0,
            shrinkB=0,
            connectionstyle=f"arc3,rad={bend}",
        )
    )


def ball(axis: Axes, place: Any, colour: str, dashes: str = "-") -> None:
    """Draw a ball and its centre."""
    axis.add_patch(Circle(place, RADIUS, fc="white", ec=colour, lw=1.1, ls=dashes, zorder=3))
    axis.plot(*place, "o", ms=2, color=colour, zorder=4)


def floor(axis: Axes, left: float, right: float) -> None:
    """Draw the second body."""
    body = Rectangle((left, -0.16), right - left, 0.16, fc="#E4E4E4", ec="none")
    axis.add_patch(body)
    axis.plot([left, right], [0.0, 0.0], color=PLAIN, lw=1.0)


def oblique(axis: Axes) -> None:
    """Draw an oblique impact: angles, speeds, spins."""
    touch = np.array([0.0, RADIUS])
    towards = np.array([np.sin(ANGLE), -np.cos(ANGLE)])
    away = np.array([np.sin(REBOUND), np.cos(REBOUND)])
    first, last = touch - 1.75 * towards, touch + 1.95 * away
    floor(axis, -1.9, 1.8)
    axis.plot([0.0, 0.0], [RADIUS, 1.95], color=PLAIN, lw=0.7, ls=(0, (4, 3)))
    axis.text(0.04, 1.97, "normal", ha="left", va="center")
    for place, end, colour in ((first, touch, BEFORE), (last, touch, AFTER)):
        axis.plot(*zip(place, end, strict=True), color=colour, lw=0.7, ls=(0, (1.5, 1.5)))
    ball(axis, touch, PLAIN, "--")
    ball(axis, first, BEFORE)
    ball(axis, last, AFTER)
    arrow(axis, first, first + 0.75 * towards, BEFORE)
    arrow(axis, last, last + 0.6 * away, AFTER)
    axis.text(*np.add(first, [0.3, 0.12]), "speed", color=BEFORE)
    axis.text(*np.add(last, [0.46, 0.42]), "rebound_speed", color=AFTER, ha="left", va="center")
    degrees = np.degrees([ANGLE, REBOUND])
    axis.add_patch(
        Arc(touch, 1.7, 1.7, theta1=90.0, theta2=90.0 + degrees[0], color=BEFORE, lw=0.9)
    )
    axis.add_patch(Arc(touch, 2.1, 2.1, theta1=90.0 - degrees[1], theta2=90.0, color=AFTER, lw=0.9))
    axis.text(-0.42, 1.3, "angle", color=BEFORE, ha="center")
    axis.text(0.05, 1.62, "rebound_angle\n> 0: flies on", color=AFTER, ha="left", va="center")
    turn = 1.35 * RADIUS
    arrow(axis, np.add(first, [-turn, 0.1]), np.add(first, [0.0, -turn]), BEFORE, bend=0.45)
    axis.text(
        *np.add(first, [-0.52, -0.6]),
        "spin > 0\n(backspin)",
        color=BEFORE,
        va="center",
        ha="center",
    )
    arrow(axis, np.add(last, [-0.1, turn]), np.add(last, [turn, 0.0]), AFTER, bend=-0.45)
    axis.text(*np.add(last, [0.12, -0.52]), "spin_out < 0\n(topspin)", color=AFTER, va="center")
    arrow(axis, (0.0, 0.0), (0.5, 0.0), PLAIN)
    axis.text(0.42, -0.08, "$+x$: contact point before", va="center", ha="left", fontsize=6.5)
    axis.plot(
        [touch[0], touch[0] - RADIUS * 0.7],
        [touch[1], touch[1] + RADIUS * 0.7],
        color=PLAIN,
        lw=0.8,
        zorder=5,
    )
    axis.text(-0.12, 0.53, "$R$", ha="center", va="center", zorder=5)
    axis.set(xlim=(-2.15, 2.35), ylim=(-0.22, 2.55))


def drop(axis: Axes) -> None:
    """Draw a vertical drop: heights of the lowest point."""
    floor(axis, -0.9, 1.5)
    places = ((0.0, 1.75, BEFORE, "drop_height"), (0.85, 1.05, AFTER, "rebound_height"))
    for x, bottom, colour, words in places:
        ball(axis, (x, bottom + RADIUS), colour)
        axis.plot([x - 0.42, x + 0.42], [bottom, bottom], color=colour, lw=0.6)
        arrow(axis, (x - 0.36, 0.0), (x - 0.36, bottom), colour, ends="<|-|>")
        axis.text(x - 0.43, 0.5 * bottom, words, color=colour, rotation=90, va="center", ha="right")
    axis.set(xlim=(-1.0, 1.6), ylim=(-0.22, 2.55))


@style.styled
def main() -> None:
    """Draw and store."""
    figure, axes = style.new_figure(1, 2, width=style.DOUBLE, height=78.0, width_ratios=(4.5, 2.6))
    for axis, draw in zip(axes[0], (oblique, drop), strict=True):
        draw(axis)
        axis.set_aspect("equal")
        axis.set_axis_off()
    figure.savefig(FIGURE, dpi=200)


if __name__ == "__main__":
    main()
