"""Draw docs/figures/glossary_{kappa,psi,chi,signs}.png: what three numbers mean, and signs.

python docs/make/glossary_figures.py
"""

from functools import partial
from math import atan, cos, degrees, pi, radians, sin, tan
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Arc, Circle, Polygon, Rectangle
from measuring_drawing import DASHED, PLAIN, arrow, floor, sheet, turn, write
from run_pages import DOCS, store_small

import carom
from carom.plots import style
from carom.plots.regimes import REGIMES

NORMAL, SIDEWAYS, SPIN, DARK = style.VERMILION, style.BLUE, style.GREEN, "#9A6A12"
DEEP = 0.5  # by which the circle is pressed down
ANGLE = radians(30.0)  # of incidence, of the impact in the figure of psi
STEEL = carom.Pair(
    carom.Sphere(radius="5 mm", material="steel"), carom.HalfSpace(material="steel"), friction=0.2
)
PHASES = (
    "stick,\nslip \N{MINUS SIGN},\ngross slip \N{MINUS SIGN}",
    "gross slip +,\nstick, slip \N{MINUS SIGN},\ngross slip \N{MINUS SIGN}",
    "gross slip +,\nslip \N{MINUS SIGN},\ngross slip \N{MINUS SIGN}",
    "gross slip +",
)


def displaced(x: Any, z: Any, sideways: bool) -> tuple[Any, Any]:
    """Return where points below a rigid circle of radius 1 on rubber go if it is pushed by 1.

    The traction A/sqrt(1 - r^2) is that of point forces (Boussinesq, Cerruti; Johnson 1985, 3.2
    and 3.6) at imaginary depths from -i to i, over which their displacements integrate in closed
    form. The body is incompressible, and y = 0.
    """
    depth = z + 1j
    distance = np.sqrt(x**2 + depth**2)
    slope = 1.0 / (distance + depth)
    across = -z * (x * slope / distance).imag
    if sideways:
        along = 1.5 * np.log(distance + depth) + depth * slope * (0.5 + z / distance)
        return along.imag / (0.75 * pi), across / (0.75 * pi)
    along = np.log(distance + depth) - z / distance
    return across / (0.5 * pi), along.imag / (0.5 * pi)


def rubber(axis: Axes, amount: float, sideways: bool) -> None:
    """Draw a grid below a circle that has been pushed by an amount."""
    x, z = np.linspace(-3.0, 3.0, 601), np.linspace(1e-9, 2.4, 97)
    lines = [*((x, level) for level in z[::8]), *((place, z) for place in x[::20])]
    for px, pz in [*lines, (x, z[0]), (x[np.abs(x) <= 1.0], z[0])]:
        right, down = displaced(px, pz, sideways)
        axis.plot(px + amount * right, -pz - amount * down, color="0.62", lw=0.5)
    colour = SIDEWAYS if sideways else NORMAL
    axis.lines[-2].set(color=PLAIN, lw=1.0)
    axis.lines[-1].set(color=colour, lw=3.0, solid_capstyle="butt", zorder=4)
    axis.plot([-3.0, 3.0], [0.0, 0.0], color=PLAIN, lw=0.6, ls=DASHED)
    sheet(axis, (-3.2, 3.2), (-2.7, 1.1))


def kappa_of(nu: Any) -> Any:
    return 2.0 * (1.0 - nu) / (2.0 - nu)


def kappa_curve(axis: Axes) -> None:
    """Draw kappa against Poisson's ratio, of like bodies; points are materials."""
    nu = np.linspace(0.0, 0.5, 101)
    axis.plot(nu, kappa_of(nu), color=PLAIN)
    for name in ("fused-silica", "soda-lime-glass", "steel", "lead", "rubber"):
        stuff = carom.materials()[name]
        ball, plate = carom.Sphere(radius="5 mm", material=stuff), carom.HalfSpace(material=stuff)
        point = stuff.poisson, carom.Pair(ball, plate, friction=0.2).kappa
        np.testing.assert_allclose(point[1], kappa_of(point[0]), rtol=1e-12)
        axis.plot(*point, "o", ms=3.5, color=PLAIN, mfc="white", clip_on=False)
        side, ha = (1, "left") if stuff.poisson < 0.4 else (-1, "right")
        words = name.removeprefix("soda-lime-").replace("-", " ")
        write(axis, point[0] + 0.022 * side, point[1] + 0.03 * side, words, ha=ha)
    axis.set(xlim=(0.0, 0.5), ylim=(0.6, 1.02))
    axis.set(xlabel=style.label("poisson"), ylabel=style.label("kappa"))


def pressed(axis: Axes) -> None:
    """Draw a circle that is pressed down."""
    rubber(axis, DEEP, sideways=False)
    arrow(axis, (0.0, 1.0), (0.0, -DEEP), NORMAL, "$F$", (0.2, 0.45))
    arrow(axis, (0.6, 0.0), (0.6, -DEEP), PLAIN, r"$\delta_n$", (0, 0.53), arrowstyle="<|-|>")


def pushed(axis: Axes) -> None:
    """Draw a circle that is pushed sideways by the same force."""
    far = DEEP / kappa_of(0.5)
    rubber(axis, far, sideways=True)
    arrow(axis, (far - 2.3, 0.14), (far - 1.0, 0.14), SIDEWAYS, "$F$", (0, 0.25))
    axis.vlines([1.0, 1.0 + far], 0.0, 0.62, color=PLAIN, lw=0.5)
    words = r"$\delta_t = \delta_n/\kappa$"
    arrow(axis, (1.0, 0.5), (1.0 + far, 0.5), PLAIN, words, (0, 0.28), arrowstyle="<|-|>")


def cone(axis: Axes) -> None:
    """Draw how the contact point comes, beside the cone of friction."""
    friction, high = atan(STEEL.friction), 2.6
    x, y = -2.3 * sin(ANGLE), 2.3 * cos(ANGLE)
    floor(axis, -1.7, 1.2, 0.32)
    sides = [(-high * tan(friction), high), (0.0, 0.0), (high * tan(friction), high)]
    axis.add_patch(Polygon(sides, fc="#FDF1DA", ec="none", zorder=0))
    axis.plot(*zip(*sides, strict=True), color="#C98A1B", lw=0.8, zorder=1)
    axis.plot([0.0, 0.0], [0.0, high], color=PLAIN, lw=0.7, ls=DASHED)
    arrow(axis, (x, y), (x, 0.0), NORMAL, "$V_1$", (-0.15, 0))
    arrow(axis, (x, 0.0), (-0.05, 0.0), SIDEWAYS, "$V_x$", (0, -0.16))
    arrow(axis, (x, y), (-0.025, 0.05), PLAIN, r"$\mathbf{V}$", (0, 0.38))
    write(axis, sides[2][0] + 0.06, high, "cone of\nfriction", DARK, ha="left", va="top")
    turned, wide = 90.0 + degrees(ANGLE), 90.0 - degrees(friction)
    axis.add_patch(Arc((0.0, 0.0), 1.9, 1.9, theta1=90.0, theta2=turned, color=PLAIN, lw=0.8))
    axis.add_patch(Arc((0.0, 0.0), 1.3, 1.3, theta1=wide, theta2=90.0, color=DARK, lw=0.8))
    write(axis, -0.29, 1.03, r"$\theta_c$")
    write(axis, 0.21, 0.66, r"$\arctan\,\mu$", DARK, ha="left")
    axis.plot(0.0, 0.0, "o", ms=3.0, color=PLAIN, zorder=5)
    write(axis, 0.08, -0.16, "contact point", ha="left")
    sheet(axis, (-1.75, 1.25), (-0.35, 2.65))


def rebound(axis: Axes) -> None:
    """Draw psi_2 against psi_1, the impact of the other panel, and the regimes above."""
    ends = [0.0, *carom.curve(STEEL.chi, [1.0]).border.values[0], 7.0]
    psi = np.linspace(1e-3, ends[-1], 400)
    style.zero_line(axis)
    axis.plot(psi, psi - 4.0 * STEEL.chi, color="0.5", lw=0.8, ls=DASHED)
    axis.plot(psi, carom.rebound(psi, STEEL.chi), color=PLAIN)
    for start, end, band, text in zip(ends[:-1], ends[1:], REGIMES.values(), PHASES, strict=True):
        axis.axvspan(start, end, 0.76, facecolor=band.face, edgecolor="white", lw=1.0)
        write(axis, 0.5 * (start + end), 2.2, text, fontsize=6.0)
    axis.vlines(ends[1:-1], -2.0, 1.52, color="0.75", lw=0.6, zorder=0)
    scale = STEEL.kappa / STEEL.friction
    one = scale * tan(ANGLE)
    out = float(carom.rebound(one, STEEL.chi))
    axis.plot(one, out, "o", ms=4.0, color=PLAIN, mfc="white")
    write(axis, one - 0.2, out - 0.1, f"as in (a),\n$\\psi_1$ = {one:.2f}", ha="right")
    write(axis, 3.5, -1.78, r"$\psi_1 - 4\chi$", "0.35")
    write(axis, 3.02, 0.0, "leaves forward\nleaves backward", "0.35", ha="left", linespacing=1.7)
    names = ["0", "1", f"$2\\chi$ = {ends[2]:.2f}", f"$4\\chi-1$ = {ends[3]:.2f}", "7"]
    axis.set_xticks(ends, names)
    axis.set(xlim=(0.0, ends[-1]), ylim=(-2.0, 2.8), yticks=range(-2, 2))
    axis.set(xlabel=style.label("psi_in"), ylabel=style.label("psi_out"))
    top, angles = axis.secondary_xaxis("top"), np.arange(0, 51, 10)
    top.set_xticks(scale * np.tan(np.radians(angles)), [f"{angle}°" for angle in angles])
    top.set_xlabel(rf"$\theta_c$ of steel on steel, $\mu$ = {STEEL.friction:g}", labelpad=4)


def oscillators(axis: Axes) -> None:
    """Draw the two springs of a contact with the masses that they turn back."""
    along = np.linspace(0.0, 1.0, 400)
    across = 0.13 * np.sin(10.0 * pi * np.clip((along - 0.12) / 0.76, 0.0, 1.0))
    floor(axis, 0.15, 1.25, 0.14)
    axis.add_patch(Rectangle((1.86, 0.9), 0.14, 0.9, fc="#E4E4E4", ec="none"))
    axis.plot([2.0, 2.0], [0.9, 1.8], color=PLAIN, lw=1.0)
    axis.plot(0.7 + across, 1.1 * along, color=NORMAL)
    axis.plot(2.0 + 1.1 * along, 1.35 + across, color=SIDEWAYS)
    for x, name, colour in ((0.3, "$m_n$", NORMAL), (3.1, "$m_t$", SIDEWAYS)):
        axis.add_patch(Rectangle((x, 1.1), 0.8, 0.5, fc="white", ec=colour, lw=1.1))
        write(axis, x + 0.4, 1.35, name, colour)
    arrow(axis, (0.7, 2.2), (0.7, 1.66), NORMAL, "$V_z$", (0.25, 0.07))
    arrow(axis, (3.2, 1.95), (3.8, 1.95), SIDEWAYS, "$V_x$", (0, 0.23))
    write(axis, 1.08, 0.55, "$k_n$", NORMAL)
    write(axis, 2.55, 0.95, "$k_t$", SIDEWAYS)
    write(axis, 2.05, -0.72, r"$\chi = \dfrac{1}{2}\,\dfrac{k_t/m_t}{k_n/m_n}$", fontsize=9.0)
    sheet(axis, (0.0, 4.1), (-1.15, 2.5))


def course(axis: Axes, chi: float, words: str) -> None:
    """Draw both velocities through an impact in which hardly anything slips."""
    small = 1e-5
    history = carom.solve(small, chi).history(400)
    time, sideways = history.time / history.time[-1], history.psi / small
    np.testing.assert_allclose(sideways[-1], carom.rebound(small, chi) / small, atol=1e-6)
    style.zero_line(axis)
    for speed, colour, look in ((history.speed, NORMAL, DASHED), (sideways, SIDEWAYS, "-")):
        axis.plot(time, speed, color=colour, ls=look, zorder=3 if colour == NORMAL else 2)
        axis.plot(1.0, speed[-1], "o", ms=3.5, color=colour, clip_on=False, zorder=4)
    write(axis, 0.97, 1.08, f"$\\chi$ = {words}", ha="right", va="top", linespacing=1.4)
    axis.set(xlim=(0.0, 1.0), ylim=(-1.15, 1.15), xticks=[0, 0.5, 1], yticks=[-1, 0, 1])
    axis.set_xlabel("$t/t_c$")
    if chi < 0.5:  # the first panel
        axis.set_ylabel("velocity over that before")
        write(axis, 0.52, -0.45, "$V_z$", NORMAL)
        write(axis, 0.85, -0.25, "$V_x$", SIDEWAYS)


def out_of_page(axis: Axes, place: Any) -> None:
    """Draw the tip of an arrow that comes out of the page."""
    axis.add_patch(Circle(place, 0.075, fc="white", ec=SPIN, lw=0.9, zorder=6))
    axis.plot(*place, "o", ms=1.8, color=SPIN, zorder=7)


def scalars(axis: Axes) -> None:
    """Draw a ball on a plate with its scalar motion."""
    floor(axis, -2.0, 2.3, 1.0)
    axis.add_patch(Circle((0.0, 1.0), 1.0, fc="white", ec=PLAIN, lw=1.1, zorder=0.5))
    out_of_page(axis, (0.0, 1.0))
    turn(axis, (0.0, 1.0), 1.2, 125.0, 215.0, SPIN)
    arrow(axis, (0.0, 1.0), (1.5, 1.0), SIDEWAYS, "$v_t$", (0.92, 0))
    arrow(axis, (0.0, 1.0), (0.0, 0.25), NORMAL, "$V_1$", (0.18, -0.12))
    arrow(axis, (0.0, -0.22), (0.95, -0.22), SIDEWAYS, "$v_t$", (0, -0.26))
    arrow(axis, (0.95, -0.22), (1.9, -0.22), SPIN, r"$R\,\omega$", (0, -0.26))
    arrow(axis, (0.0, 0.0), (0.0, -0.8), PLAIN, r"$\mathbf{n}$", (-0.16, -0.26))
    arrow(axis, (0.0, 0.07), (-1.1, 0.07), PLAIN, "$F_x > 0$\non the ball", (-1.03, 0.22))
    arrow(axis, (1.55, 1.75), (2.15, 1.75), PLAIN, "$x$", (0.4, 0))
    arrow(axis, (1.55, 1.75), (1.55, 2.35), PLAIN, "$z$ of DEM codes", (0, 0.42))
    axis.plot(0.0, 0.0, "o", ms=3.0, color=PLAIN, zorder=6)
    write(axis, -1.02, 1.95, "$\\omega > 0$\n(backspin)", SPIN, ha="right")
    write(axis, 0.95, -0.8, r"$V_x = v_t + R\,\omega$")
    sheet(axis, (-2.05, 2.4), (-1.0, 2.6))


def vectors(axis: Axes) -> None:
    """Draw two spheres with the vectors of collide."""
    steep = radians(-35.0)
    normal, along = np.array([cos(steep), sin(steep)]), np.array([-sin(steep), cos(steep)])
    point = np.array([-0.1, 0.8])
    for number, size, place, colour, speed, beside, first in (
        ("1", 1.0, -1.0, SIDEWAYS, (0.55, 0.7), (0.02, 0.22), 110.0),
        ("2", 1.2, 1.2, NORMAL, (-0.55, 0.5), (0.17, 0.11), -60.0),
    ):
        centre, move = point + place * normal, speed[0] * normal + speed[1] * along
        axis.add_patch(Circle(centre, size, fc="white", ec=PLAIN, lw=1.1, zorder=0.5))
        arrow(axis, centre, centre + move, colour, rf"$\mathbf{{v}}_{number}$", beside)
        out_of_page(axis, centre)
        turn(axis, centre, size + 0.2, first, first + 80.0, SPIN)
        middle = (size + 0.42) * np.array([cos(radians(first + 40)), sin(radians(first + 40))])
        write(axis, *(centre + middle), rf"$\boldsymbol{{\omega}}_{number}$", SPIN)
        write(axis, *(centre - [0.12, 0.22]), number)
    arrow(axis, point, point + 0.7 * normal, PLAIN, r"$\mathbf{n}$", 0.51 * normal)
    arrow(axis, point, point + 0.7 * along, PLAIN, r"$\mathbf{t}$", 0.51 * along)
    axis.plot(*point, "o", ms=3.0, color=PLAIN, zorder=6)
    out_of_page(axis, (0.75, 2.3))
    write(axis, 0.92, 2.29, r"$\mathbf{n} \times \mathbf{t}$, out of the page", ha="left")
    sheet(axis, (-2.3, 2.6), (-1.15, 2.6))


FIGURES = {  # height in mm, and the panels with their shares of the width
    "kappa": (48.0, {pressed: 3.0, pushed: 3.0, kappa_curve: 2.4}),
    "psi": (72.0, {cone: 3.0, rebound: 5.0}),
    "chi": (
        56.0,
        {
            oscillators: 1.25,
            partial(course, chi=1.0 / 3.0, words="1/3\nrubber that\ncannot turn"): 1.1,
            partial(course, chi=0.5, words="1/2\nin step"): 1.0,
            partial(course, chi=STEEL.chi, words=f"{STEEL.chi:.2f}\nsolid steel ball"): 1.0,
        },
    ),
    "signs": (70.0, {scalars: 1.0, vectors: 1.0}),
}


@style.styled
def main() -> None:
    """Draw and store, with a letter above the upper left corner of each panel."""
    for name, (height, panels) in FIGURES.items():
        figure = style.blank_figure(style.DOUBLE, height)
        parts = figure.subfigures(1, len(panels), width_ratios=[*panels.values()])
        for part, draw, letter in zip(parts, panels, "abcd", strict=False):
            axis = part.subplots()
            draw(axis)
            axis.set_title(f"({letter})", loc="left", fontweight="bold")
            axis.spines[["top", "right"]].set_visible(False)
        store_small(figure, DOCS / "figures" / f"glossary_{name}.png", all_colors=True)


if __name__ == "__main__":
    main()
