r"""How deep shot peening shears
============================

Depth and size of the largest shear stress below a steel shot, against its angle of incidence.

The stress is the largest of the whole impact. Below :math:`\mu = 0.28` it lies below the surface,
and its depth shrinks with the contact, as :math:`\cos^{2/5}` of the angle. At a right angle it is
at 0.48 of the radius of the contact and has 0.31 of its pressure (Johnson 1985, section 4.2). With
more friction it is at the surface where the shot slides, but not at steep incidence, where the shot
sticks: there friction counts for little. Thin lines: contacts that slide throughout.
"""

from pathlib import Path

import numpy as np

import carom
from carom.plots.legends import legend_above
from carom.plots.style import BLACK, DASHES, DOUBLE, LINES, new_figure, save_figure, styled

FRICTIONS = (0.0, 0.2, 0.3, 0.5)
ANGLES = np.arange(0.0, 86.0)  # deg; at the last all of them slide throughout
SURFACE = 0.1  # radii: what is less deep is at the surface
SPEED = 0.5  # m/s, of elastic impacts; the shapes do not depend on it


def shot(friction):
    """Return a steel shot on steel of the same kind, nu = 0.3."""
    steel = carom.material("steel")
    ball = carom.Sphere(radius="0.3 mm", material=steel)
    return carom.Pair(ball, carom.HalfSpace(material=steel), friction=friction)


def peaks(friction, angle):
    """Return depth in radii and stress in pressures of the largest contact, and that radius."""
    hit = carom.impact(shot(friction), speed=SPEED, angle=np.radians(angle))
    found = hit.peaks().sel(body="second")
    depth, stress = float(found.peak_shear_z), float(found.peak_shear)
    return depth / hit.max_radius, stress / hit.max_pressure, hit.max_radius


@styled
def draw(tables):
    """Draw depth and stress against the angle for each friction."""
    figure, (axes,) = new_figure(1, 2, width=DOUBLE, height=70.0)
    left, right = axes
    shrinks = np.cos(np.radians(ANGLES)) ** 0.4
    for i, (mu, table) in enumerate(tables.items()):
        line = {"color": LINES[i], "ls": DASHES[i]}
        depth, stress = table[:, 0] * shrinks, table[:, 1]
        below = np.flatnonzero(table[:, 0] > SURFACE)
        shown = np.union1d(below[::4], below[-1:])
        left.plot(ANGLES[shown], depth[shown], label=f"$\\mu$ = {mu:g}", **line)
        if below.size < ANGLES.size:
            last = below[-1]
            left.plot(ANGLES[[last, last]], [depth[last], 0.0], lw=0.7, **line)
            left.plot(ANGLES[last], depth[last], "o", color=LINES[i], mfc="white")
        right.plot(ANGLES, stress, **line)
        if mu:
            right.axhline(stress[-1], color=LINES[i], ls=DASHES[i], lw=0.5)
    left.axhline(0.0, color=BLACK, lw=0.6)
    left.text(84.0, -0.012, "surface", ha="right")
    left.set(xlim=(0.0, 85.0), ylim=(0.5, -0.04))
    left.set_ylabel("$z/a_0$")
    right.set(xlim=(0.0, 85.0), ylim=(0.3, 0.55), ylabel=r"$\tau/p_0$")
    for axis in axes:
        axis.set_xlabel(r"$\theta$ (deg)")
    legend_above(left, 4)
    return figure


def main(folder: str | Path = ".") -> str:
    """Find depth and size of the largest shear stress, compare them with Johnson, draw them."""
    tables = {mu: np.array([peaks(mu, angle) for angle in ANGLES]) for mu in FRICTIONS}
    depth, stress, radius = tables[0.0].T
    np.testing.assert_allclose(depth, 0.48, atol=3e-3)
    np.testing.assert_allclose(stress, 0.31, atol=5e-4)
    np.testing.assert_allclose(radius / radius[0], np.cos(np.radians(ANGLES)) ** 0.4, rtol=1e-9)
    surfaces = {mu: ANGLES[table[:, 0] < SURFACE] for mu, table in tables.items()}
    assert surfaces[0.0].size == surfaces[0.2].size == 0
    first = [float(surfaces[mu][0]) for mu in (0.3, 0.5)]

    save_figure(draw(tables), Path(folder) / "peening_depth.png")
    return (
        f"without friction at {depth[0]:.3f} a, {stress[0]:.3f} p_0; at the surface from"
        f" {first[0]:g} and {first[1]:g} deg on with mu = 0.3 and 0.5"
    )


if __name__ == "__main__":
    print(main())
