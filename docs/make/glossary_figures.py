"""Draw docs/figures/glossary_{kappa,psi,chi,signs}.png: what three numbers mean, and signs.

python docs/make/glossary_figures.py
"""

import sys
import tempfile
from math import atan, cos, degrees, pi, radians, sin, tan
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Arc, Circle, Polygon, Rectangle
from measuring_drawing import arrow
from scipy.interpolate import CubicSpline

import carom
from carom.plots import style
from carom.plots.bands import Band
from carom.plots.regimes import REGIMES

DOCS = Path(__file__).parents[1]
sys.path.append(str(DOCS.parent / "studies"))

from small_pictures import store_small  # noqa: E402

NORMAL, SIDEWAYS, PLAIN, PALE = style.VERMILION, style.BLUE, style.BLACK, "#E4E4E4"
ANGLE = radians(30.0)  # of incidence, of the impact in the figure of psi
DASHED = (0, (4, 3))
MIDDLE: Any = {"ha": "center", "va": "center"}
STEEL = carom.Pair(
    carom.Sphere(radius="5 mm", material="steel"), carom.HalfSpace(material="steel"), friction=0.2
)


def bare(axis: Axes, x: tuple[float, float], y: tuple[float, float]) -> None:
    """Let axes be a sheet to draw on."""
    axis.set(xlim=x, ylim=y, aspect="equal", anchor="N")
    axis.set_axis_off()


def letter(axis: Axes, name: str) -> None:
    """Write the letter of a panel above its upper left corner."""
    axis.set_title(f"({name})", loc="left", fontweight="bold")


# kappa: a circle pushed down and sideways


def pushed(points: Any, along: int) -> Any:
    """Return how a circle of radius 1, pushed along an axis by 1, displaces rubber below it.

    Displacements of points (n, 3), below the surface, of an incompressible half-space: sums of
    point forces (Boussinesq, Cerruti; Johnson 1985, sections 3.2 and 3.6) on the circle.
    """
    turns = np.linspace(0.0, 0.5 * pi, 121)
    rise = 0.5 * (turns[1:] + turns[:-1])[:, np.newaxis]
    about = np.linspace(0.0, 2.0 * pi, 240, endpoint=False)
    places = np.sin(rise) * np.array([np.cos(about), np.sin(about)])[:, np.newaxis, :]
    weights = np.broadcast_to(np.sin(rise), places[0].shape).ravel()  # of A/sqrt(1 - r^2)
    weights = weights / weights.sum() * 2.0 / pi
    x, y = places.reshape(2, -1)
    found = np.empty((len(points), 3))
    for row, (px, py, pz) in enumerate(points):
        away = np.array([px - x, py - y, np.full_like(x, pz)])
        distance = np.sqrt((away**2).sum(axis=0))
        found[row] = (away * away[along] / distance**3) @ weights
        found[row, along] += (weights / distance).sum()
    return found / (1.0 if along == 2 else 1.5)


def on_surface(x: Any, along: int) -> Any:
    """Return the same at the surface, along the x axis: (2.1) and (3.3) of the theory."""
    lag = np.arcsin(1.0 / np.maximum(np.abs(x), 1.0))
    found = np.zeros((len(x), 3))
    found[:, along] = 2.0 / pi * lag
    if along == 0:
        found[:, 0] += np.sin(2.0 * lag) / (3.0 * pi)
    return found


def grid(along: int) -> tuple[Any, Any]:
    """Return the points of a grid below the surface, and how they are displaced."""
    x, z = np.linspace(-3.0, 3.0, 241), np.linspace(0.0, 2.4, 13)
    points = np.stack(np.broadcast_arrays(x, 0.0, z[:, np.newaxis]), axis=-1)
    below = pushed(points[1:].reshape(-1, 3), along).reshape(len(z) - 1, len(x), 3)
    return points, np.concatenate([on_surface(x, along)[np.newaxis], below])


def deformed(axis: Axes, along: int, amount: float, colour: str) -> None:
    """Draw rubber below a circle that has been pushed."""
    points, shift = grid(along)
    there = points + amount * shift
    for row in there:
        axis.plot(row[:, 0], -row[:, 2], color="0.62", lw=0.5)
    fine = np.linspace(points[0, 0, 2], points[-1, 0, 2], 97)
    for column in range(0, points.shape[1], 8):
        line = CubicSpline(points[:, column, 2], there[:, column])(fine)
        axis.plot(line[:, 0], -line[:, 2], color="0.62", lw=0.5)
    axis.plot(there[0, :, 0], -there[0, :, 2], color=PLAIN, lw=1.0)
    patch = there[0, np.abs(points[0, :, 0]) <= 1.0]
    axis.plot(patch[:, 0], -patch[:, 2], color=colour, lw=3.0, solid_capstyle="butt", zorder=4)
    axis.plot([-3.0, 3.0], [0.0, 0.0], color=PLAIN, lw=0.6, ls=DASHED)
    bare(axis, (-3.2, 3.2), (-2.7, 1.1))


def kappa_of(nu: Any) -> Any:
    return 2.0 * (1.0 - nu) / (2.0 - nu)


def kappa_curve(axis: Axes) -> None:
    """Draw kappa against Poisson's ratio, of like bodies; points are materials."""
    nu = np.linspace(0.0, 0.5, 101)
    axis.plot(nu, kappa_of(nu), color=PLAIN)
    for name, words, side in (
        ("fused-silica", "fused silica", "left"),
        ("soda-lime-glass", "glass", "left"),
        ("steel", "steel", "left"),
        ("lead", "lead", "right"),
        ("rubber", "rubber", "right"),
    ):
        stuff = carom.materials()[name]
        ball, plate = carom.Sphere(radius="5 mm", material=stuff), carom.HalfSpace(material=stuff)
        kappa = carom.Pair(ball, plate, friction=0.2).kappa
        np.testing.assert_allclose(kappa, kappa_of(stuff.poisson), rtol=1e-12)
        axis.plot(stuff.poisson, kappa, "o", ms=3.5, color=PLAIN, mfc="white", clip_on=False)
        shift = (5, 3) if side == "left" else (-5, -3)
        axis.annotate(
            words,
            (stuff.poisson, kappa),
            shift,
            textcoords="offset points",
            ha=side,
            va="bottom" if side == "left" else "top",
        )
    axis.set(xlim=(0.0, 0.5), ylim=(0.6, 1.02), xlabel=style.label("poisson"))
    axis.set(ylabel=style.label("kappa"))
    axis.spines[["top", "right"]].set_visible(False)


def kappa() -> Figure:
    figure, axes = style.new_figure(
        1, 3, width=style.DOUBLE, height=48.0, width_ratios=(3.0, 3.0, 2.0)
    )
    down, side, curve = axes[0]
    deep = 0.5
    far = deep / kappa_of(0.5)  # by the same force
    deformed(down, 2, deep, NORMAL)
    arrow(down, (0.0, 1.0), (0.0, -deep), NORMAL)
    down.text(0.12, 0.7, "$F$", color=NORMAL, va="center")
    arrow(down, (0.6, 0.0), (0.6, -deep), PLAIN, ends="<|-|>")
    down.text(0.6, 0.1, r"$\delta_n$", ha="center", va="bottom")
    deformed(side, 0, far, SIDEWAYS)
    arrow(side, (-1.0 + far - 1.3, 0.14), (-1.0 + far, 0.14), SIDEWAYS)
    side.text(-1.0 + far - 0.7, 0.25, "$F$", color=SIDEWAYS, ha="center", va="bottom")
    for place in (1.0, 1.0 + far):
        side.plot([place, place], [0.0, 0.62], color=PLAIN, lw=0.5)
    arrow(side, (1.0, 0.5), (1.0 + far, 0.5), PLAIN, ends="<|-|>")
    side.text(1.0 + 0.5 * far, 0.62, r"$\delta_t = \delta_n/\kappa$", ha="center", va="bottom")
    kappa_curve(curve)
    for axis, name in zip(axes[0], "abc", strict=True):
        letter(axis, name)
    return figure


# psi: the direction in which the contact point comes, and the cone of friction


def cone(axis: Axes) -> None:
    """Draw how the contact point comes, beside the cone of friction."""
    friction, length = atan(STEEL.friction), 2.3
    start = np.array([-length * sin(ANGLE), length * cos(ANGLE)])
    corner = np.array([start[0], 0.0])
    axis.add_patch(Rectangle((-1.7, -0.32), 2.9, 0.32, fc=PALE, ec="none"))
    axis.plot([-1.7, 1.2], [0.0, 0.0], color=PLAIN, lw=0.6, zorder=0.5)
    high = 2.6
    sides = [(-high * tan(friction), high), (0.0, 0.0), (high * tan(friction), high)]
    axis.add_patch(Polygon(sides, closed=True, fc="#FDF1DA", ec="none", zorder=0))
    for side in (sides[0], sides[2]):
        axis.plot([0.0, side[0]], [0.0, side[1]], color="#C98A1B", lw=0.8, zorder=1)
    axis.plot([0.0, 0.0], [0.0, high], color=PLAIN, lw=0.7, ls=DASHED)
    arrow(axis, start, corner, NORMAL)
    arrow(axis, corner, (-0.05, 0.0), SIDEWAYS)
    arrow(axis, start, (-0.025, 0.05), PLAIN)
    axis.text(0.5 * corner[0], -0.16, "$V_x$", color=SIDEWAYS, **MIDDLE)
    axis.text(*np.add(corner, [-0.08, 1.0]), "$V_1$", color=NORMAL, ha="right", va="center")
    axis.text(*(0.62 * start + 0.08), r"$\mathbf{V}$", ha="left", va="bottom")
    axis.text(*np.add(sides[2], [0.06, 0.0]), "cone of\nfriction", va="top", color="#9A6A12")
    arcs = (
        (1.9, 90.0, 90.0 + degrees(ANGLE), r"$\theta_c$", (-0.29, 1.03), PLAIN),
        (1.3, 90.0 - degrees(friction), 90.0, r"$\arctan\,\mu$", (0.21, 0.66), "#9A6A12"),
    )
    for size, first, last, words, place, colour in arcs:
        axis.add_patch(Arc((0.0, 0.0), size, size, theta1=first, theta2=last, color=colour, lw=0.8))
        side = "left" if place[0] > 0.0 else "center"
        axis.text(*place, words, ha=side, va="center", color=colour)
    axis.plot(0.0, 0.0, "o", ms=3.0, color=PLAIN, zorder=5)
    axis.text(0.08, -0.16, "contact point", va="center")
    bare(axis, (-1.75, 1.25), (-0.35, 2.65))


def strip(axis: Axes, borders: list[float], last: float) -> None:
    """Draw the regimes as a strip over psi_1, with the angles of a steel ball above it."""
    words = (
        "stick,\nslip \N{MINUS SIGN},\ngross slip \N{MINUS SIGN}",
        "gross slip +,\nstick, slip \N{MINUS SIGN},\ngross slip \N{MINUS SIGN}",
        "gross slip +,\nslip \N{MINUS SIGN},\ngross slip \N{MINUS SIGN}",
        "gross slip +",
    )
    bands: list[Band] = list(REGIMES.values())
    ends = [0.0, *borders, last]
    for start, end, band, text in zip(ends[:-1], ends[1:], bands, words, strict=True):
        axis.axvspan(start, end, facecolor=band.face, edgecolor="white", lw=1.0)
        axis.text(0.5 * (start + end), 0.5, text, **MIDDLE, fontsize=6.0)
    axis.set(ylim=(0.0, 1.0), yticks=[])
    axis.tick_params(bottom=False, labelbottom=False)
    axis.spines[["left", "right", "bottom", "top"]].set_visible(False)
    scale = STEEL.kappa / STEEL.friction
    top = axis.secondary_xaxis(
        "top",
        functions=(
            lambda psi: np.degrees(np.arctan(psi / scale)),
            lambda angle: scale * np.tan(np.radians(np.minimum(angle, 89.0))),
        ),
    )
    top.set_xticks([0, 10, 20, 30, 40, 50], [f"{angle}°" for angle in (0, 10, 20, 30, 40, 50)])
    top.set_xlabel(rf"$\theta_c$ of steel on steel, $\mu$ = {STEEL.friction:g}", labelpad=4)


def rebound(axis: Axes, borders: list[float], last: float) -> None:
    """Draw psi_2 against psi_1 with the borders, and the impact of the other panel."""
    psi = np.linspace(1e-3, last, 400)
    style.zero_line(axis)
    axis.plot(psi, psi - 4.0 * STEEL.chi, color="0.5", lw=0.8, ls=DASHED)
    axis.plot(psi, carom.rebound(psi, STEEL.chi), color=PLAIN)
    for border in borders:
        axis.axvline(border, color="0.75", lw=0.6, zorder=0)
    one = STEEL.kappa * tan(ANGLE) / STEEL.friction
    axis.plot(one, carom.rebound(one, STEEL.chi), "o", ms=4.0, color=PLAIN, mfc="white")
    axis.annotate(
        f"as in (a),\n$\\psi_1$ = {one:.2f}",
        (one, float(carom.rebound(one, STEEL.chi))),
        (-7, -4),
        textcoords="offset points",
        ha="right",
        va="center",
    )
    axis.text(3.83, -1.78, r"$\psi_1 - 4\chi$", color="0.35", ha="right", va="center")
    axis.text(3.02, 0.1, "leaves forward", va="bottom", color="0.35")
    axis.text(3.02, -0.1, "leaves backward", va="top", color="0.35")
    axis.set(xlim=(0.0, last), ylim=(-2.0, 1.4), ylabel=style.label("psi_out"))
    names = ["0", "1", f"$2\\chi$ = {borders[1]:.2f}", f"$4\\chi-1$ = {borders[2]:.2f}", "7"]
    axis.set_xticks([0.0, *borders, last], names)
    axis.set_xlabel(style.label("psi_in"))
    axis.spines[["top", "right"]].set_visible(False)


def psi() -> Figure:
    borders, last = [1.0, 2.0 * STEEL.chi, 4.0 * STEEL.chi - 1.0], 7.0
    np.testing.assert_allclose(carom.curve(STEEL.chi, [1.0]).border.values[0], borders, rtol=1e-12)
    figure = style.blank_figure(style.DOUBLE, 72.0)
    left, right = figure.subfigures(1, 2, width_ratios=(3.0, 5.0))
    first = left.subplots()
    cone(first)
    above, below = right.subplots(2, 1, sharex=True, height_ratios=(1.3, 4.0))
    strip(above, borders, last)
    rebound(below, borders, last)
    letter(first, "a")
    letter(above, "b")
    return figure


# chi: two oscillations


def spring(axis: Axes, start: Any, end: Any, colour: str) -> None:
    """Draw a spring from one point to another."""
    start, end = np.array(start, dtype=float), np.array(end, dtype=float)
    along = np.linspace(0.0, 1.0, 400)
    wound = np.clip((along - 0.12) / 0.76, 0.0, 1.0)
    across = 0.13 * np.sin(10.0 * pi * wound)
    line = end - start
    side = np.array([-line[1], line[0]]) / np.hypot(*line)
    axis.plot(*(start[:, None] + np.outer(line, along) + np.outer(side, across)), color=colour)


def oscillators(axis: Axes) -> None:
    """Draw the two springs of a contact with the masses that they turn back."""
    axis.plot([0.15, 1.25], [0.0, 0.0], color=PLAIN, lw=1.0)
    axis.add_patch(Rectangle((0.15, -0.14), 1.1, 0.14, fc=PALE, ec="none"))
    spring(axis, (0.7, 0.0), (0.7, 1.1), NORMAL)
    axis.add_patch(Rectangle((0.3, 1.1), 0.8, 0.5, fc="white", ec=NORMAL, lw=1.1))
    axis.text(0.7, 1.35, "$m_n$", color=NORMAL, **MIDDLE)
    axis.text(0.95, 0.55, "$k_n$", color=NORMAL, va="center")
    arrow(axis, (0.7, 2.2), (0.7, 1.66), NORMAL)
    axis.text(0.82, 2.0, "$V_z$", color=NORMAL, va="center")
    axis.plot([2.0, 2.0], [0.9, 1.8], color=PLAIN, lw=1.0)
    axis.add_patch(Rectangle((1.86, 0.9), 0.14, 0.9, fc=PALE, ec="none"))
    spring(axis, (2.0, 1.35), (3.1, 1.35), SIDEWAYS)
    axis.add_patch(Rectangle((3.1, 1.1), 0.8, 0.5, fc="white", ec=SIDEWAYS, lw=1.1))
    axis.text(3.5, 1.35, "$m_t$", color=SIDEWAYS, **MIDDLE)
    axis.text(2.55, 1.06, "$k_t$", color=SIDEWAYS, ha="center", va="top")
    arrow(axis, (3.2, 1.95), (3.8, 1.95), SIDEWAYS)
    axis.text(3.5, 2.06, "$V_x$", color=SIDEWAYS, ha="center", va="bottom")
    formula = r"$\chi = \dfrac{1}{2}\,\dfrac{k_t/m_t}{k_n/m_n}$"
    axis.text(2.05, -0.72, formula, **MIDDLE, fontsize=9.0)
    bare(axis, (0.0, 4.1), (-1.15, 2.5))


def course(axis: Axes, chi: float, words: str) -> None:
    """Draw both velocities through an impact in which hardly anything slips."""
    small = 1e-5
    history = carom.solve(small, chi).history(400)
    time = history.time / history.time[-1]
    style.zero_line(axis)
    axis.plot(time, history.speed, color=NORMAL, ls=DASHED, lw=1.3, zorder=3)
    axis.plot(time, history.psi / small, color=SIDEWAYS)
    end = float(history.psi[-1]) / small
    assert abs(end - carom.rebound(small, chi) / small) < 1e-6
    for value, colour in ((-1.0, NORMAL), (end, SIDEWAYS)):
        axis.plot(1.0, value, "o", ms=3.5, color=colour, clip_on=False, zorder=4)
    axis.text(0.97, 0.97, words, ha="right", va="top", transform=axis.transAxes, linespacing=1.4)
    axis.set(xlim=(0.0, 1.0), ylim=(-1.15, 1.15), xticks=[0, 0.5, 1], yticks=[-1, 0, 1])
    axis.set_xlabel("$t/t_c$")
    axis.spines[["top", "right"]].set_visible(False)


def chi() -> Figure:
    figure, axes = style.new_figure(
        1, 4, width=style.DOUBLE, height=56.0, width_ratios=(1.25, 1.0, 1.0, 1.0)
    )
    oscillators(axes[0, 0])
    solid = STEEL.chi
    panels = (
        (1.0 / 3.0, "$\\chi$ = 1/3\nrubber that\ncannot turn"),
        (0.5, "$\\chi$ = 1/2\nin step"),
        (solid, f"$\\chi$ = {solid:.2f}\nsolid steel ball"),
    )
    for axis, (value, words) in zip(axes[0, 1:], panels, strict=True):
        course(axis, value, words)
    for axis in axes[0, 2:]:
        axis.tick_params(labelleft=False)
    axes[0, 1].set_ylabel("velocity over that before")
    axes[0, 1].text(0.55, -0.5, "$V_z$", color=NORMAL, ha="right")
    axes[0, 1].text(0.8, -0.3, "$V_x$", color=SIDEWAYS, ha="left")
    for axis, name in zip(axes[0], "abcd", strict=True):
        letter(axis, name)
    return figure


# signs


def turning(axis: Axes, centre: Any, radius: float, first: float, last: float, colour: str) -> None:
    """Draw an arrow around a centre, counterclockwise if the last angle is the larger one."""
    angles = np.radians(np.linspace(first, last, 60))
    x, y = centre[0] + radius * np.cos(angles), centre[1] + radius * np.sin(angles)
    axis.plot(x[:-4], y[:-4], color=colour, lw=1.1)
    arrow(axis, (x[-6], y[-6]), (x[-1], y[-1]), colour)


def out_of_page(axis: Axes, place: Any, colour: str) -> None:
    """Draw the tip of an arrow that comes out of the page."""
    axis.add_patch(Circle(place, 0.075, fc="white", ec=colour, lw=0.9, zorder=6))
    axis.plot(*place, "o", ms=1.8, color=colour, zorder=7)


def scalars(axis: Axes) -> None:
    """Draw a ball on a plate with its scalar motion."""
    centre = np.array([0.0, 1.0])
    axis.add_patch(Rectangle((-2.0, -1.0), 4.3, 1.0, fc=PALE, ec="none"))
    axis.plot([-2.0, 2.3], [0.0, 0.0], color=PLAIN, lw=1.0)
    axis.add_patch(Circle(centre, 1.0, fc="white", ec=PLAIN, lw=1.1, zorder=0.5))
    arrow(axis, centre, (1.5, 1.0), SIDEWAYS)
    axis.text(1.6, 1.0, "$v_t$", color=SIDEWAYS, va="center")
    arrow(axis, centre, (0.0, 0.25), NORMAL)
    axis.text(0.09, 0.5, "$V_1$", color=NORMAL, va="center", zorder=6)
    out_of_page(axis, centre, style.GREEN)
    turning(axis, centre, 1.2, 125.0, 215.0, style.GREEN)
    axis.text(
        -1.02, 1.95, r"$\omega > 0$" "\n(backspin)", color=style.GREEN, ha="right", va="center"
    )
    arrow(axis, (0.0, -0.22), (0.95, -0.22), SIDEWAYS)
    arrow(axis, (0.95, -0.22), (1.9, -0.22), style.GREEN)
    axis.text(0.47, -0.48, "$v_t$", color=SIDEWAYS, **MIDDLE)
    axis.text(1.42, -0.48, r"$R\,\omega$", color=style.GREEN, **MIDDLE)
    axis.text(0.95, -0.8, r"$V_x = v_t + R\,\omega$", **MIDDLE)
    arrow(axis, (0.0, 0.0), (0.0, -0.8), PLAIN)
    axis.text(-0.1, -0.66, r"$\mathbf{n}$", ha="right", va="center")
    arrow(axis, (0.0, 0.07), (-1.1, 0.07), PLAIN)
    axis.text(-1.18, 0.1, "$F_x > 0$\non the ball", ha="right", va="bottom")
    axis.plot(0.0, 0.0, "o", ms=3.0, color=PLAIN, zorder=6)
    arrow(axis, (1.55, 1.75), (2.15, 1.75), PLAIN)
    arrow(axis, (1.55, 1.75), (1.55, 2.35), PLAIN)
    axis.text(2.2, 1.75, "$x$", va="center")
    axis.text(1.55, 2.38, "$z$ of DEM codes", ha="center", va="bottom")
    bare(axis, (-2.05, 2.4), (-1.0, 2.6))


def vectors(axis: Axes) -> None:
    """Draw two spheres with the vectors of collide."""
    steep = radians(-35.0)
    normal = np.array([cos(steep), sin(steep)])
    along = np.array([-normal[1], normal[0]])
    point = np.array([-0.1, 0.8])
    sizes, colours = (1.0, 1.2), (SIDEWAYS, NORMAL)
    centres = point - sizes[0] * normal, point + sizes[1] * normal
    moves = 0.55 * normal + 0.7 * along, -0.55 * normal + 0.5 * along
    turns = (110.0, 190.0), (-60.0, 20.0)
    for each in zip("12", centres, sizes, colours, moves, turns, strict=True):
        number, centre, size, colour, move, span = each
        axis.add_patch(Circle(centre, size, fc="white", ec=PLAIN, lw=1.1, zorder=0.5))
        arrow(axis, centre, centre + move, colour)
        out_of_page(axis, centre, style.GREEN)
        aside = (0.2 if number == "1" else -0.2) * np.array([-move[1], move[0]]) / np.hypot(*move)
        axis.text(
            *(centre + 0.6 * move + aside), rf"$\mathbf{{v}}_{number}$", color=colour, **MIDDLE
        )
        turning(axis, centre, size + 0.2, *span, style.GREEN)
        middle = radians(0.5 * sum(span))
        place = centre + (size + 0.42) * np.array([cos(middle), sin(middle)])
        axis.text(*place, rf"$\boldsymbol{{\omega}}_{number}$", color=style.GREEN, **MIDDLE)
        axis.text(*np.add(centre, [-0.12, -0.22]), number, **MIDDLE)
    for end, words in ((normal, r"$\mathbf{n}$"), (along, r"$\mathbf{t}$")):
        arrow(axis, point, point + 0.7 * end, PLAIN)
        axis.text(*(point + 0.86 * end), words, **MIDDLE)
    axis.plot(*point, "o", ms=3.0, color=PLAIN, zorder=6)
    out_of_page(axis, (0.75, 2.3), style.GREEN)
    axis.text(0.92, 2.29, r"$\mathbf{n} \times \mathbf{t}$, out of the page", va="center")
    bare(axis, (-2.3, 2.6), (-1.15, 2.6))


def signs() -> Figure:
    figure, axes = style.new_figure(1, 2, width=style.DOUBLE, height=70.0)
    scalars(axes[0, 0])
    vectors(axes[0, 1])
    for axis, name in zip(axes[0], "ab", strict=True):
        letter(axis, name)
    return figure


@style.styled
def main() -> None:
    """Draw and store."""
    with tempfile.TemporaryDirectory() as folder:
        for draw in (kappa, psi, chi, signs):
            large = Path(folder) / "large.png"
            style.save_figure(draw(), large)
            store_small(large, DOCS / "figures" / f"glossary_{draw.__name__}.png", all_colors=True)


if __name__ == "__main__":
    main()
