r"""Press a contact and push it sideways
====================================

`carom.load_path` follows a contact through slow forces: the edge slips, the middle sticks.

At constant normal force :math:`F_z`, a growing tangential force :math:`F_x` makes a ring slip from
the edge inwards, down to the stick radius :math:`a = b\,(1 - F_x/(\mu F_z))^{1/3}`. The contact
becomes softer until all of it slides. Points: Kalker's program CONTACT on the same problem, with 15
elements across the patch.

Cattaneo (1938), Mindlin (1949); Johnson, Contact Mechanics (1985), section 7.2 (d).
"""

import numpy as np

import carom
from carom.plots.legends import legend_above
from carom.plots.style import DASHES, DOUBLE, LINES, new_figure, save_figure, style

rubber = carom.Material(young="568 MPa", poisson=0.42, density=1000)
ball = carom.Sphere(radius="50 mm", material=rubber)
pair = carom.Pair(ball, carom.HalfSpace(material=rubber), friction=0.4)
load = 9.1954  # N
most = pair.friction * load

share = np.sin(np.linspace(0, np.pi / 2, 101))
path = carom.load_path(pair, normal_force=load, tangential_force=share * most)
pushed = carom.load_path(pair, normal_force=load, tangential_force=[0, 0.875 * most])
a = path.contact_radius[0]
r = np.linspace(0, 0.9999 * a, 400)
traction = pushed.fields(points=np.column_stack([r, 0 * r])).traction_x.values
print(f"moves by {1e6 * path.displacement[-1]:.2f} um before it slides")

# %%
# Check: displacement, stick radius and traction in closed form.
unit = 3 * most / (4 * a * pair.effective_shear_modulus)
np.testing.assert_allclose(
    path.displacement, unit * (1 - (1 - share) ** (2 / 3)), atol=1e-10 * unit
)
np.testing.assert_allclose(path.stick_radius[:-1] / a, (1 - share[:-1]) ** (1 / 3), rtol=1e-10)
c, peak = a * (1 - 0.875) ** (1 / 3), 1.5 * most / (np.pi * a**2)
outer, inner = (np.sqrt(np.maximum(1 - (r / size) ** 2, 0)) for size in (a, c))
np.testing.assert_allclose(traction, peak * (outer - c / a * inner), atol=1e-10 * peak)

# %%
# The figure, with tractions of CONTACT (case 2 of its example cattaneo) on the line y = 0.
at = 0.133333 * np.arange(8)  # mm
contact = np.array([0.879, 0.895, 0.948, 1.09, 1.49, 1.31, 1.06, 0.576])  # MPa
with style():
    figure, ((left, right),) = new_figure(1, 2, width=DOUBLE, height=70)
    left.plot(1e3 * r, traction / 1e6, color=LINES[0], label="$f_x$")
    left.plot(1e3 * r, peak * outer / 1e6, "k", ls=DASHES[1], lw=0.8, label=r"limit, $\mu p$")
    left.plot(at, contact, "o", color=LINES[1], ms=3, label="CONTACT", clip_on=False)
    left.axvline(1e3 * c, color="0.5", lw=0.6)
    left.text(1e3 * c, 0.03, "stick, $r < a$ ", ha="right")
    left.text(1e3 * c, 0.03, " slip")
    left.set(xlim=(0, 1.05e3 * a), ylim=(0, None), xlabel="$r$ (mm)", ylabel="$f_x$ (MPa)")
    moved = path.displacement / path.displacement[-1]
    right.plot(share, moved, color=LINES[0], label="displacement, $U/U_{slide}$")
    stick = path.stick_radius / a
    right.plot(share, stick, color=LINES[1], ls=DASHES[1], label="stick radius, $a/b$")
    right.set(xlabel=r"$F_x/\mu F_z$", ylabel="share", xlim=(0, 1), ylim=(0, 1.05))
    for axis in (left, right):
        legend_above(axis, 3)
    save_figure(figure, "cattaneo_mindlin.png")
