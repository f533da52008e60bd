"""Draw docs/figures/rig.png: a bench for oblique impacts, from the camera and from the side.

python docs/make/rig_drawing.py
"""

from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Arc, Circle, Polygon, Rectangle
from measuring_drawing import AFTER, BEFORE, DASHED, PLAIN, arrow, sheet, title, turn, write

from carom.plots import style

FIGURE = Path(__file__).parents[1] / "figures" / "rig.png"
TILT, RADIUS, THICK = np.radians(25.0), 0.2, 1.0
ALONG, NORMAL = np.array([np.cos(TILT), -np.sin(TILT)]), np.array([np.sin(TILT), np.cos(TILT)])
GREY = "#E4E4E4"


def marked_ball(axis: Axes, place: np.ndarray, colour: str, degrees: float) -> None:
    """Draw a ball with a mark, a line through its centre with a dot at one end."""
    axis.add_patch(Circle(tuple(place), RADIUS, fc="white", ec=colour, lw=1.1, zorder=3))
    reach = RADIUS * np.array([np.cos(np.radians(degrees)), np.sin(np.radians(degrees))])
    axis.plot(*zip(place - reach, place + reach, strict=True), color=colour, lw=1.0, zorder=4)
    axis.plot(*(place + 0.6 * reach), "o", ms=3.0, color=colour, zorder=4)


def view(axis: Axes) -> None:
    """Draw what the camera sees: the plane of the motion."""
    ends = -1.1 * ALONG, 1.5 * ALONG, 1.5 * ALONG - THICK * NORMAL, -1.1 * ALONG - THICK * NORMAL
    axis.add_patch(Polygon(ends, fc=GREY, ec=PLAIN, lw=0.8))
    touch = RADIUS * NORMAL
    top = touch + np.array([0.0, 1.75])
    axis.plot([touch[0], top[0]], [touch[1], top[1]], color=BEFORE, lw=0.7, ls=(0, (1.5, 1.5)))
    axis.add_patch(Rectangle((top[0] - 0.07, top[1] + RADIUS), 0.14, 0.3, fc=GREY, ec=PLAIN))
    write(axis, top[0] + 0.2, top[1] + 0.4, "nozzle: suction lets go\nwithout spin", ha="left")
    marked_ball(axis, top, BEFORE, 60.0)
    arrow(axis, (top[0], top[1] - RADIUS), (top[0], top[1] - 0.75), BEFORE)
    arrow(axis, (-0.55, touch[1] - RADIUS), (-0.55, top[1] - RADIUS), BEFORE, arrowstyle="<|-|>")
    for centre in (top, touch):
        axis.plot([-0.6, centre[0]], 2 * [centre[1] - RADIUS], color=BEFORE, lw=0.5, zorder=4)
    axis.add_patch(Circle(tuple(touch), RADIUS, fc="none", ec=PLAIN, lw=1.0, ls=DASHED, zorder=3))
    write(axis, -0.62, 1.15, "fall $h$", BEFORE, ha="right")
    out = np.radians(90.0) - TILT - np.radians(20.0)
    last = touch + 1.35 * np.array([np.cos(out), np.sin(out)])
    axis.plot(*zip(touch, last, strict=True), color=AFTER, lw=0.7, ls=(0, (1.5, 1.5)))
    for part, degrees in ((0.5, 60.0), (1.0, -10.0)):
        marked_ball(axis, touch + part * (last - touch), AFTER, degrees)
    turn(axis, last, 1.35 * RADIUS, 110.0, 10.0, AFTER)
    write(
        axis,
        last[0] + 0.34,
        last[1] + 0.05,
        "rebound_angle,\nspin_out, by the mark",
        AFTER,
        ha="left",
    )
    axis.plot(*zip(touch, touch + 1.45 * NORMAL, strict=True), color=PLAIN, lw=0.7, ls=DASHED)
    degrees = 90.0 - np.degrees(TILT)
    axis.add_patch(Arc(tuple(touch), 1.7, 1.7, theta1=degrees, theta2=90.0, color=BEFORE, lw=0.9))
    write(axis, touch[0] + 0.25, touch[1] + 1.12, "angle", BEFORE)
    arrow(axis, 0.9 * ALONG, 0.9 * ALONG - THICK * NORMAL, PLAIN, arrowstyle="<|-|>")
    write(axis, *(0.82 * ALONG - 0.5 * THICK * NORMAL), "thicker than\n6 radii", ha="right")
    low, high = ends[2], ends[3]
    axis.plot([-1.9, 2.2], 2 * [low[1]], color=PLAIN, lw=1.0)
    axis.add_patch(Polygon([low, high, (high[0], low[1])], fc="none", ec=PLAIN))
    write(axis, high[0] + 0.08, low[1] + 0.15, "wedge: tilt = angle", ha="left")
    axis.plot([1.5, 2.5], [0.25, 0.25], color=PLAIN, lw=2.0)
    write(axis, 2.1, 0.1, "scale, in the plane of the motion")
    title(axis, 0.7, 2.75, "What the camera sees")
    sheet(axis, (-1.95, 3.4), (-1.85, 2.85))


def side(axis: Axes) -> None:
    """Draw the same from the side."""
    axis.add_patch(Rectangle((-0.6, -1.4), 1.2, 1.4, fc=GREY, ec=PLAIN, lw=0.8))
    marked_ball(axis, np.array([0.0, 1.0]), BEFORE, 90.0)
    axis.plot([0.0, 0.0], [0.0, 0.8], color=BEFORE, lw=0.7, ls=(0, (1.5, 1.5)))
    axis.add_patch(Rectangle((2.1, 0.2), 0.7, 0.5, fc=GREY, ec=PLAIN))
    axis.add_patch(Polygon([(2.1, 0.35), (1.9, 0.25), (1.9, 0.65), (2.1, 0.55)], fc=GREY, ec=PLAIN))
    axis.plot([0.0, 1.9], [0.45, 0.45], color=PLAIN, lw=0.7, ls=DASHED)
    write(axis, 2.45, -0.05, "camera, at right\nangles to the motion")
    axis.plot([-1.3, -1.3], [-0.2, 1.4], color=PLAIN, lw=2.0)
    write(axis, -1.3, 1.65, "bright screen")
    axis.plot([-1.6, 3.2], [-1.4, -1.4], color=PLAIN, lw=1.0)
    title(axis, 0.7, 2.75, "From the side")
    sheet(axis, (-1.9, 3.4), (-1.85, 2.85))


@style.styled
def main() -> None:
    """Draw and store."""
    figure, axes = style.new_figure(1, 2, width=style.DOUBLE, height=90.0, width_ratios=(4.9, 4.0))
    view(axes[0, 0])
    side(axes[0, 1])
    figure.savefig(FIGURE, dpi=200)


if __name__ == "__main__":
    main()
