"""Draw docs/figures/halfspace_slip.png and normal_spin.png, by boundary elements; some minutes.

python docs/make/full_contact_figures.py [slip] [spin]
"""

import sys
from math import gamma, pi, sqrt
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from scipy.interpolate import griddata

import carom
from carom.halfspace.compliance import Materials
from carom.halfspace.motion import NormalSpin
from carom.halfspace.solution import Resolution, solve
from carom.plots.style import BLUE, DASHES, DOUBLE, SIGNED_MAP, VERMILION, new_figure, styled

DOCS = Path(__file__).parents[1]
sys.path.append(str(DOCS.parent / "studies"))

from small_pictures import store_small  # noqa: E402

PSI, INSTANT = 0.5, 2.2  # psi_1; in d_max/V_1, while a ring slips
COLOURS = {0.3: BLUE, 0.5: VERMILION}  # by Poisson's ratio
FINE = carom.BoundaryElements(elements=128, steps=600)

KAPPA, CHI = 0.8235294117647058, 1.4411764705882353  # a solid ball of steel on steel
LIGHTNESS = 0.01  # m_n a_max^2/I: a_max/R = 0.063 of a solid sphere on a half-space
PSIS = np.array([0.1, 0.3, 0.5, 0.75, 1.0, 1.25, 1.5, 2.0, 2.5, 3.0, 3.5, 4.0, 4.5, 4.8, 5.2, 6.0])
SPINS = (0.0, 0.1, 0.25, 0.5, 1.0, 2.0)
TURNS = np.geomspace(0.02, 20.0, 13)
ALONE = 1e-3  # psi_1 of an impact that has next to no tangential motion
COARSE = Resolution(24, 112)


def impacts(poisson: float) -> tuple[carom.results.Impact, carom.results.Impact]:
    """Return the impact of a solid sphere on a half-space of the same material: theory and full."""
    stuff = carom.Material(young=5e6, poisson=poisson, density=1100.0)
    ball = carom.Sphere(radius=0.02, material=stuff)
    pair = carom.Pair(ball, carom.HalfSpace(material=stuff), friction=0.5)
    motion = {"normal_speed": 0.5, "tangential_speed": PSI * 0.5 * 0.5 / pair.kappa}
    return carom.impact(pair, **motion), carom.impact(pair, **motion, method=FINE)


def turned(along: np.ndarray, across: np.ndarray) -> np.ndarray:
    """Return the angle of slip from the line of the motion, in degrees, either way."""
    return np.degrees(np.arctan(across / along))


class Ring:
    """The slip ring of both solutions at one instant, and places in it."""

    def __init__(self, poisson: float) -> None:
        theory, full = impacts(poisson)
        time = INSTANT * theory.max_penetration / theory.normal_speed
        patch = full.fields(time)
        self.theory, self.time = theory, float(patch.time)
        profile = theory.radial(self.time)
        self.front, self.edge = float(profile.stick_radius), float(profile.contact_radius)
        slips = (patch.zone == 2).values
        x, y = np.meshgrid(patch.x, patch.y)
        self.places = np.column_stack([x[slips], y[slips]])
        self.angles = turned(patch.traction_x.values[slips], patch.traction_y.values[slips])

    def by_theory(self, points: np.ndarray) -> np.ndarray:
        """Return the angles of slip at points in the ring."""
        at = np.column_stack([points, np.zeros(len(points))])[:, :2]
        found = self.theory.fields(self.time, points=at)
        return turned(found.slip_velocity_x.values, found.slip_velocity_y.values)

    def in_full(self, points: np.ndarray) -> np.ndarray:
        """Return the angles of slip at points in the ring, between the elements."""
        lines, nearest = (
            griddata(self.places, self.angles, points, method=how) for how in ("linear", "nearest")
        )
        return np.where(np.isnan(lines), nearest, lines)


def draw_map(axis: Axes, ring: Ring, full: bool) -> object:
    """Colour the ring by the angle of slip."""
    radii = np.linspace(ring.front * (1 + 1e-6), ring.edge * (1 - 1e-6), 40)
    turn = np.linspace(0.0, 2.0 * np.pi, 241)
    r, angle = np.meshgrid(radii, turn, indexing="ij")
    x, y = r * np.cos(angle), r * np.sin(angle)
    points = np.column_stack([x.ravel(), y.ravel()])
    values = (ring.in_full if full else ring.by_theory)(points).reshape(x.shape)
    scale = 1.0 / ring.edge
    image = axis.pcolormesh(
        *(scale * x, scale * y, values),
        **{"cmap": SIGNED_MAP, "vmin": -20.0, "vmax": 20.0, "shading": "gouraud"},
    )
    for radius, style in ((ring.front, "--"), (ring.edge, "-")):
        axis.plot(*(scale * radius * f(turn) for f in (np.cos, np.sin)), "k", ls=style, lw=0.7)
    name = "full contact" if full else "theory"
    axis.set(aspect="equal", xlabel="$x/b$", ylabel="$y/b$", title=rf"{name}, $\nu$ = 0.5")
    return image


def draw_directions(axis: Axes, poisson: float, ring: Ring) -> None:
    """Draw the angle at 45 degrees to the motion, from the front to the edge."""
    line = np.linspace(ring.front * (1 + 1e-6), ring.edge * (1 - 1e-6), 100)
    points = np.column_stack([line, line]) / np.sqrt(2.0)
    for values, style, name in (
        (ring.by_theory(points), DASHES[1], "theory"),
        (ring.in_full(points), "-", "full contact"),
    ):
        label = rf"{name}, $\nu$ = {poisson:g}"
        axis.plot(line / ring.edge, -values, color=COLOURS[poisson], ls=style, label=label)


@styled
def slip() -> Figure:
    """Draw which way a slip ring slips, by the theory and by boundary elements."""
    figure, (axes,) = new_figure(1, 3, width=DOUBLE, height=62.0, width_ratios=(1.0, 1.0, 1.3))
    for poisson in COLOURS:
        ring = Ring(poisson)
        draw_directions(axes[2], poisson, ring)
    for axis, full in zip(axes[:2], (False, True), strict=True):
        image = draw_map(axis, ring, full)
    bar = figure.colorbar(image, ax=axes[:2], orientation="horizontal", aspect=30.0)
    bar.set_label("angle between slip and motion (deg)")
    axes[2].axhline(0.0, color="0.5", lw=0.5)
    axes[2].set(xlabel="$r/b$", ylabel="angle of slip (deg)", ylim=(-28.0, 20.0))
    axes[2].set_title("on a radius at 45 deg to the motion")
    axes[2].legend(loc="lower right")
    return figure


def rebound(psi: float, spin: float) -> tuple[float, float]:
    """Return psi_2, and the spin about the normal that friction takes over the lightness."""
    hit = solve(psi, CHI, Materials(KAPPA), COARSE, spin=NormalSpin(spin, LIGHTNESS))
    return hit.psi_out, (spin - hit.spin_out) / LIGHTNESS


def most_taken() -> float:
    """Return the spin that friction takes if all slips around the normal, over the lightness.

    The moment is (3 pi/16) mu P b: (15/16)(3 pi/16)(4/3) times the integral of d^2 over time, which
    is (4/5) B(6/5, 1/2).
    """
    path = 0.8 * gamma(1.2) * sqrt(pi) / gamma(1.7)
    return 15.0 / 16.0 * 3.0 * pi / 16.0 * 4.0 / 3.0 * path


@styled
def spin() -> Figure:
    """Draw rebound curves with spin about the normal, and the spin that an impact takes."""
    figure, ((left, right),) = new_figure(1, 2, width=DOUBLE, height=78.0)
    line = np.linspace(0.0, PSIS[-1], 400)
    left.plot(line, carom.rebound(line, CHI), color="0.7", lw=3.0, label="theory, no spin")
    found = np.array([[rebound(psi, turn)[0] for psi in PSIS] for turn in SPINS])
    colours = ("0.1", "#0072B2", "#56B4E9", "#009E73", "#E69F00", "#D55E00")
    for turn, values, colour, mark in zip(SPINS, found, colours, "os^DvP", strict=True):
        label = rf"$\tau_1$ = {turn:g}"
        left.plot(PSIS, values, color=colour, marker=mark, ms=3.0, mfc="white", lw=1.0, label=label)
    left.axhline(0.0, color="0.5", lw=0.5, zorder=0)
    left.set(xlabel=r"$\psi_1$", ylabel=r"$\psi_2$", ylim=(-1.6, 0.75))
    left.set_title("rebound with spin about the normal")
    left.legend(loc="upper center")
    right.axhline(most_taken(), color="0.7", lw=3.0, label="all slips around the normal")
    taken = [rebound(ALONE, turn)[1] for turn in TURNS]
    right.semilogx(TURNS, taken, "o-", color=BLUE, ms=3.0, mfc="white", label="solved")
    right.set(xlabel=r"$\tau_1$", ylabel=r"$(\tau_1 - \tau_2)/\gamma$", ylim=(0.0, 1.2))
    right.set_title("spin lost in an impact without tangential motion")
    right.legend(loc="lower right")
    return figure


if __name__ == "__main__":
    for name in sys.argv[1:] or ("slip", "spin"):
        target = {"slip": "halfspace_slip", "spin": "normal_spin"}[name]
        draw = {"slip": slip, "spin": spin}[name]
        store_small(draw(), DOCS / "figures" / f"{target}.png", all_colors=name == "slip")
