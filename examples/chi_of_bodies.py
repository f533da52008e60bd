r"""Inertia over stiffness: balls, shells, cups
===========================================

The one number that distinguishes bodies, against Poisson's ratio and the shape of the ball.

The ratio :math:`\chi` compares inertia and stiffness along the surface with those across it. Solid
spheres have :math:`\chi` from 1.17 to 1.75, thin shells have less. A contact with
:math:`\chi = 1/2` would never slip, but this needs a flywheel with a radius of gyration
:math:`K \ge \sqrt{2}\,R`. A sphere that cannot turn has :math:`\chi = \kappa/2`. Points: solid
spheres of the materials of the catalogue.

Barber (1979), ZAMP 30:468, equation (16) and section 6 (:math:`K \ge \sqrt{2}\,R` is misprinted
there).
"""

from math import inf, sqrt

import numpy as np

import carom
from carom.plots.style import BLACK, DASHES, LINES, label, new_figure, save_figure, style

SHAPES = {"solid": 0.4, "thin shell": 2 / 3, "ring, $K = R$": 1.0, r"$K = \sqrt{2}\,R$": 2.0}


def chi_16(nu, ratio):
    """Return chi by equation (16) for a ratio K^2/R^2."""
    return (1 - nu) / (2 - nu) * (1 + 1 / ratio)


with style():
    nu = np.linspace(0, 0.5, 26)
    figure, ((axis,),) = new_figure(height=68)
    worst = 0.0
    for (name, ratio), color, dash in zip(SHAPES.items(), LINES, DASHES, strict=False):
        found = []
        for value in nu:
            stuff = carom.Material(young="1 GPa", poisson=value, density=1000)
            ball = carom.Sphere(radius=0.01, material=stuff, gyration_radius=0.01 * sqrt(ratio))
            found.append(carom.Pair(ball, carom.HalfSpace(material=stuff), 0.3).chi)
        worst = max(worst, np.abs(np.array(found) / chi_16(nu, ratio) - 1).max())
        axis.plot(nu, found, color=color, ls=dash, label=name)
    axis.plot(nu, chi_16(nu, inf), color=LINES[4], ls=DASHES[4], label="cannot turn")
    assert worst < 1e-14, f"(16): chi differs by {worst:.1e}"
    np.testing.assert_allclose(chi_16(0.3, 0.4), 1.44, atol=2e-3)
    np.testing.assert_allclose(chi_16(0.5, 2.0), 0.5, rtol=1e-15)
    assert np.all(chi_16(nu, 1.99) > 0.5), "chi <= 1/2 needs K >= sqrt(2) R"

    seen = {}
    for name, stuff in carom.materials().items():
        ball = carom.Sphere(radius="5 mm", material=stuff)
        pair = carom.Pair(ball, carom.HalfSpace(material=stuff), friction=0.2)
        np.testing.assert_allclose(pair.chi, chi_16(stuff.poisson, 0.4), rtol=1e-14)
        seen.setdefault(stuff.poisson, name)
    dots = {"marker": "o", "ls": "", "color": BLACK, "ms": 2.5, "clip_on": False}
    axis.plot(
        list(seen), chi_16(np.array(list(seen)), 0.4), label="materials of the catalogue", **dots
    )
    axis.axhline(0.5, color="0.5", lw=0.5)
    axis.text(0.2, 0.52, r"$\chi = 1/2$")
    axis.set(xlim=(0, 0.5), ylim=(0.2, 2.6), xlabel=label("poisson"), ylabel=label("chi"))
    axis.legend(ncols=2, loc="upper right", columnspacing=0.8)
    save_figure(figure, "chi_of_bodies.png")
    print(
        f"chi of {len(carom.materials())} materials and {len(SHAPES)} shapes is (16), {worst:.0e}"
    )
