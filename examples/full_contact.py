r"""Solve slip in any direction
===========================

`method=carom.BoundaryElements()` solves the full contact, in which traction turns with slip.

The theory assumes that traction is along :math:`x` everywhere. Its slip then turns off :math:`x`,
most at the front of the slip ring, by :math:`\arcsin(\nu/(2 - \nu))`. The full solution has
Coulomb's law as a vector. At the front slip then starts along the traction that stuck there, along
:math:`x`, and turns off further out. The rebound hardly changes.

Barber (1979), ZAMP 30:468, section 7; Kalker (1990), Three-Dimensional Elastic Bodies in Rolling
Contact, chapter 4.
"""

import numpy as np

import carom
from carom.plots.style import DOUBLE, new_figure, save_figure, style

rubber = carom.Material(young="5 MPa", poisson=0.5, density=1100)  # incompressible
ball = carom.Sphere(radius="20 mm", material=rubber)
pair = carom.Pair(ball, carom.HalfSpace(material=rubber), friction=0.5)
motion = {"normal_speed": 0.5, "tangential_speed": 0.3}

theory = carom.impact(pair, **motion)
full = carom.impact(pair, **motion, method=carom.BoundaryElements(elements=40, steps=150))
mean = [np.degrees(hit.slip_angles[-2].mean) for hit in (theory, full)]
print(f"psi_2 differs by {full.psi_out - theory.psi_out:+.4f}; slip turns off x by", end=" ")
print("{:.1f} deg on average in theory, {:.1f} deg in the full contact".format(*mean))

# %%
# Check and figure, at an instant of microslip: the bound on the angle and Coulomb's law.
by_elements = full.fields(0.66 * full.duration)
time, radius = float(by_elements.time), float(by_elements.contact_radius)
line = np.linspace(-1.02, 1.02, 301) * radius
patches = {
    "theory": theory.fields(time, line, line),
    "full contact, 40 elements across": by_elements,
}
bound = np.degrees(np.arcsin(0.5 / 1.5))
assert abs(full.psi_out - theory.psi_out) < 5e-3
pull = np.hypot(by_elements.traction_x, by_elements.traction_y)
assert float((pull - 0.5 * by_elements.pressure).max()) < 1e-9 * theory.max_pressure

with style():
    figure, (axes,) = new_figure(1, 2, width=DOUBLE, height=84, sharex=True, sharey=True)
    for axis, (title, patch), most in zip(axes, patches.items(), (1.0, 1.2), strict=True):
        x, y = patch.slip_velocity_x, patch.slip_velocity_y
        angle = np.degrees(np.arctan2(y * np.sign(x), np.abs(x))).where(patch.zone == 2)
        assert float(np.abs(angle).max()) < most * bound + 1e-9
        grid = 1e3 * patch.x, 1e3 * patch.y
        shown = axis.pcolormesh(*grid, angle, cmap="RdBu_r", vmin=-20, vmax=20, rasterized=True)
        turn = np.linspace(0.0, 2.0 * np.pi, 181)
        axis.plot(1e3 * radius * np.cos(turn), 1e3 * radius * np.sin(turn), "k", lw=1)
        axis.text(0, 0, "sticks", ha="center", va="center")
        axis.set(title=title, xlabel="$x$ (mm)", aspect="equal")
    axes[0].set_ylabel("$y$ (mm)")
    figure.colorbar(shown, ax=axes, label="angle between slip and $x$ (deg)")
    save_figure(figure, "full_contact.png")
