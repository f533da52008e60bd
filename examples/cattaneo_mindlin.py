r"""A growing tangential force: Cattaneo and Mindlin
================================================

A sphere is pressed on a plane and then pushed sideways: the edge slips, the middle sticks.

At constant normal force :math:`F_z`, a growing tangential force :math:`F_x` makes a ring slip from
the edge inwards, down to the stick radius :math:`a = b\,(1 - F_x/(\mu F_z))^{1/3}`. The contact
becomes softer until all of it slides. Points: Kalker's program CONTACT on the same problem, with 15
elements across the patch.

Cattaneo (1938), Mindlin (1949); Johnson, Contact Mechanics (1985), section 7.2 (d).
"""

from pathlib import Path

import numpy as np

import carom
from carom.classical import cattaneo_mindlin
from carom.plots.legends import legend_above
from carom.plots.style import (
    BLACK,
    BLUE,
    DASHES,
    DOUBLE,
    VERMILION,
    new_figure,
    save_figure,
    styled,
)

STUFF = carom.Material(young=2 * 1.42 * 200e6, poisson=0.42, density=1000)  # G = 200 MPa
BALL = carom.Sphere(radius="50 mm", material=STUFF)
PAIR = carom.Pair(BALL, carom.HalfSpace(material=STUFF), friction=0.4)
LOAD, SHARE = 9.1954, 0.875
CONTACT = Path(__file__).parent / "data" / "contact_cattaneo_tractions.csv"


def traction_closed(r, a, c, peak):
    """Return the traction in closed form: sliding of the contact less that of the stick region."""
    outer, inner = (np.sqrt(np.maximum(1 - (r / size) ** 2, 0)) for size in (a, c))
    return peak * (outer - c / a * inner)


@styled
def main(folder: str | Path = ".") -> str:
    """Check traction, stick radius and displacement; draw them with those of CONTACT."""
    share = np.sin(np.linspace(0, np.pi / 2, 101))
    most = PAIR.friction * LOAD
    path = carom.load_path(PAIR, normal_force=LOAD, tangential_force=share * most)
    a = path.contact_radius[0]
    np.testing.assert_allclose(path.stick_radius[:-1] / a, (1 - share[:-1]) ** (1 / 3), rtol=1e-10)
    shear = PAIR.effective_shear_modulus
    moved = 3 * most / (4 * a * shear) * (1 - (1 - share) ** (2 / 3))
    np.testing.assert_allclose(path.displacement, moved, rtol=1e-9, atol=1e-10 * moved[-1])
    np.testing.assert_allclose(cattaneo_mindlin(PAIR, LOAD, share * most), moved, rtol=1e-10)
    pushed = carom.load_path(PAIR, normal_force=LOAD, tangential_force=[0, SHARE * most])
    c, peak = a * (1 - SHARE) ** (1 / 3), 1.5 * most / (np.pi * a**2)
    r = np.linspace(0, 0.9999 * a, 400)
    found = pushed.fields(points=np.column_stack([r, 0 * r])).traction_x.values
    error = np.abs(found - traction_closed(r, a, c, peak)).max() / peak
    assert error < 1e-10, f"traction differs by {error:.1e} of mu p_0"

    x, y, size = np.loadtxt(CONTACT, delimiter=",", skiprows=4, usecols=(0, 1, 4), unpack=True)
    places = np.column_stack([x, y]) * 1e-3
    exact = pushed.fields(points=places).traction_x.values / 1e6
    difference = np.sqrt(np.mean((exact - size) ** 2)) / (peak / 1e6)
    assert difference < 0.03, f"CONTACT's tractions differ by {difference:.1%} of mu p_0"

    figure, (axes,) = new_figure(1, 2, width=DOUBLE, height=66)
    milli = 1e3
    axes[0].plot(r * milli, found / 1e6, color=BLUE, label="$f_x$")
    limit = peak * np.sqrt(1 - (r / a) ** 2) / 1e6
    axes[0].plot(r * milli, limit, color=BLACK, ls=DASHES[1], lw=0.8, label=r"$\mu p$")
    axes[0].plot(np.hypot(x, y), size, ".", color=VERMILION, ms=3, label="CONTACT", clip_on=False)
    axes[0].axvline(c * milli, color="0.5", lw=0.6)
    place = {"y": 0.02, "transform": axes[0].get_xaxis_transform()}
    axes[0].text(c * milli, s="stick, $r < a$ ", ha="right", **place)
    axes[0].text(c * milli, s=" slip", ha="left", **place)
    axes[0].set(xlim=(0, 1.05 * a * milli), ylim=(0, None))
    axes[0].set(xlabel="$r$ (mm)", ylabel="$f_x$ (MPa)")
    axes[1].plot(
        share, path.displacement / moved[-1], color=BLUE, label="displacement, $U/U_{slide}$"
    )
    stick = path.stick_radius / a
    axes[1].plot(share, stick, color=VERMILION, ls=DASHES[1], label="stick radius, $a/b$")
    circles = {"marker": "o", "ls": "", "mfc": "white", "clip_on": False}
    axes[1].plot(share[5::10], moved[5::10] / moved[-1], mec=BLUE, **circles)
    axes[1].plot(share[5::10], (1 - share[5::10]) ** (1 / 3), mec=VERMILION, **circles)
    axes[1].plot([], [], "o", mfc="white", mec=BLACK, label="closed form")
    axes[1].set(xlabel=r"$F_x/\mu F_z$", ylabel="share", xlim=(0, 1), ylim=(0, 1.05))
    for axis in axes:
        legend_above(axis, 2)
    save_figure(figure, Path(folder) / "cattaneo_mindlin.png")
    return f"traction within {error:.0e} of mu p_0; CONTACT within {difference:.1%} of it (rms)"


if __name__ == "__main__":
    print(main())
