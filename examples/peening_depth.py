r"""Find how deep shot peening shears
=================================

`hit.peaks()` gives depth and size of the largest stresses of a whole impact, in each body.

Here it is the shear stress below a steel shot, against its angle of incidence. Below
:math:`\mu = 0.28` it lies below the surface, and its depth shrinks with the contact, as
:math:`\cos^{2/5}` of the angle. At a right angle it is at 0.48 of the radius of the contact and has
0.31 of its pressure (Johnson 1985, section 4.2). With more friction it is at the surface where the
shot slides, but not at steep incidence, where the shot sticks: there friction counts for little.
"""

import numpy as np

import carom
from carom.plots.style import BLACK, DASHES, DOUBLE, LINES, new_figure, save_figure, styled

SPEED = 0.5  # m/s, of elastic impacts; the shapes do not depend on it
steel = carom.material("steel")
ball = carom.Sphere(radius="0.3 mm", material=steel)
pair = carom.Pair(ball, carom.HalfSpace(material=steel), friction=0.2)
hit = carom.impact(pair, speed=SPEED, angle="30 deg")
largest = hit.peaks().sel(body="second")
print(
    f"shear stress of {largest.peak_shear / 1e9:.2f} GPa, {1e6 * largest.peak_shear_z:.1f} um deep"
)

# %%
# The figure: all angles, for four frictions.
FRICTIONS = (0.0, 0.2, 0.3, 0.5)
ANGLES = np.arange(0.0, 86.0)  # deg; at the last all of them slide throughout
SURFACE = 0.1  # radii: what is less deep is at the surface


def peaks(friction, angle):
    """Return depth in radii and stress in pressures of the largest contact, and that radius."""
    shot = carom.Pair(ball, carom.HalfSpace(material=steel), friction=friction)
    hit = carom.impact(shot, speed=SPEED, angle=np.radians(angle))
    found = hit.peaks().sel(body="second")
    depth, stress = float(found.peak_shear_z), float(found.peak_shear)
    return depth / hit.max_radius, stress / hit.max_pressure, hit.max_radius


@styled
def draw(tables):
    """Draw depth and stress against the angle for each friction."""
    figure, ((left, right),) = new_figure(1, 2, width=DOUBLE, height=78.0)
    shrinks = np.cos(np.radians(ANGLES)) ** 0.4
    for i, (mu, table) in enumerate(tables.items()):
        line = {"color": LINES[i], "ls": DASHES[i]}
        depth, stress = table[:, 0] * shrinks, table[:, 1]
        below = np.flatnonzero(table[:, 0] > SURFACE)
        shown = np.union1d(below[::4], below[-1:])
        left.plot(ANGLES[shown], depth[shown], label=rf"$\mu$ = {mu:g}", **line)
        if below.size < ANGLES.size:
            last = below[-1]
            left.plot(ANGLES[[last, last]], [depth[last], 0.0], color=LINES[i], lw=0.7, ls=":")
            left.plot(ANGLES[last], depth[last], "o", color=LINES[i], mfc="white")
        right.plot(ANGLES, stress, **line)
        if mu:
            right.axhline(stress[-1], color=LINES[i], ls=DASHES[i], lw=0.5)
    left.plot([], [], "o:", color="0.4", mfc="white", lw=0.7, label="leaps to the surface")
    right.plot([], [], color="0.4", lw=0.5, label="slides throughout (thin)")
    left.axhline(0.0, color=BLACK, lw=0.6)
    left.text(84.0, -0.012, "surface", ha="right")
    left.set(title="depth of the largest shear stress", xlim=(0.0, 85.0), ylim=(0.5, -0.04))
    left.set_ylabel("depth over contact radius, $z/a_0$")
    right.set(title="largest shear stress", xlim=(0.0, 85.0), ylim=(0.3, 0.55))
    right.set_ylabel(r"stress over pressure, $\tau/p_0$")
    for axis in (left, right):
        axis.set_xlabel(r"angle from the normal, $\theta$ (deg)")
    left.legend(loc="upper right", bbox_to_anchor=(1.0, 0.9))
    right.legend(loc="upper left")
    return figure


tables = {mu: np.array([peaks(mu, angle) for angle in ANGLES]) for mu in FRICTIONS}
depth, stress, radius = tables[0.0].T
np.testing.assert_allclose(depth, 0.48, atol=3e-3)
np.testing.assert_allclose(stress, 0.31, atol=5e-4)
np.testing.assert_allclose(radius / radius[0], np.cos(np.radians(ANGLES)) ** 0.4, rtol=1e-9)
surfaces = {mu: ANGLES[table[:, 0] < SURFACE] for mu, table in tables.items()}
assert surfaces[0.0].size == surfaces[0.2].size == 0
first = [float(surfaces[mu][0]) for mu in (0.3, 0.5)]

save_figure(draw(tables), "peening_depth.png")
print(
    f"without friction at {depth[0]:.3f} a, {stress[0]:.3f} p_0; at the surface above"
    f" {first[0] - 1:g} and {first[1] - 1:g} deg with mu = 0.3 and 0.5"
)
