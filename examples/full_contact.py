r"""The full contact in three dimensions
====================================

The direction in which the patch slips: by the theory, and by the full contact in three dimensions.

The theory assumes that traction is along :math:`x` everywhere. Its slip then turns off :math:`x`,
most at the front of the slip ring, by :math:`\arcsin(\nu/(2 - \nu))`. The full solution, by
boundary elements, has Coulomb's law as a vector, so that traction turns with slip. At the front
slip then starts along the traction that stuck there, along :math:`x`, and turns off further out.
The rebound hardly changes.

Barber (1979), ZAMP 30:468, section 7; Kalker (1990), Three-Dimensional Elastic Bodies in Rolling
Contact, chapter 4.
"""

from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

import carom
from carom.plots import save_figure

INCOMPRESSIBLE = carom.Material(young="5 MPa", poisson=0.5, density=1100)
BALL = carom.Sphere(radius="20 mm", material=INCOMPRESSIBLE)
PAIR = carom.Pair(BALL, carom.HalfSpace(material=INCOMPRESSIBLE), friction=0.5)
MOTION = {"normal_speed": 0.5, "tangential_speed": 0.3}
GRID = carom.BoundaryElements(elements=40, steps=150)


def angles(patch):
    """Angle between slip and x either way in degrees, NaN where nothing slips."""
    x, y = patch.slip_velocity_x, patch.slip_velocity_y
    angle = np.degrees(np.arctan2(y * np.sign(x), np.abs(x)))
    return angle.where(patch.zone == 2)


def main(folder: str | Path = ".") -> str:
    """Check rebound and angles; draw the angle of slip over the patch, theory and full."""
    exact = carom.impact(PAIR, **MOTION)
    full = carom.impact(PAIR, **MOTION, method=GRID)
    off = full.psi_out - exact.psi_out
    assert abs(off) < 5e-3
    patch = full.fields(0.66 * full.duration)
    theory = exact.fields(float(patch.time), patch.x, patch.y)
    bound = np.degrees(np.arcsin(0.5 / 1.5))
    assert float(np.abs(angles(theory)).max()) <= bound
    assert float(np.abs(angles(patch)).max()) < 1.2 * bound
    pull = np.hypot(patch.traction_x, patch.traction_y)
    assert float((pull - 0.5 * patch.pressure).max()) < 1e-9 * exact.max_pressure

    figure = Figure(figsize=(7.2, 3.6), layout="constrained")
    axes = figure.subplots(1, 2, sharex=True, sharey=True)
    for axis, fields, title in zip(axes, (theory, patch), ("theory", "full contact"), strict=True):
        shown = axis.pcolormesh(
            1e3 * fields.x, 1e3 * fields.y, angles(fields), cmap="RdBu_r", vmin=-20, vmax=20
        )
        edge = circle(1e3 * float(patch.contact_radius))
        axis.plot(*edge, color="black", lw=1)
        axis.set(title=title, xlabel="$x$ (mm)", aspect="equal")
    axes[0].set_ylabel("$y$ (mm)")
    figure.colorbar(shown, ax=axes, label="angle of slip against $x$ (deg)")
    save_figure(figure, Path(folder) / "full_contact.png")
    mean = [np.degrees(hit.slip_angles[-2].mean) for hit in (exact, full)]
    return (
        f"psi_2 off by {off:+.4f}; slip off x by {mean[0]:.1f} deg in theory, {mean[1]:.1f} in full"
    )


def circle(radius):
    """A circle around the centre."""
    angle = np.linspace(0.0, 2.0 * np.pi, 181)
    return radius * np.cos(angle), radius * np.sin(angle)


if __name__ == "__main__":
    print(main())
