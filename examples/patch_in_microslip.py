r"""The patch from above in microslip
=================================

The patch from above while a ring slips: traction, stick region and the direction of slip.

The theory assumes that all points slip along :math:`x`, and they nearly do. The lateral
displacements, of the order of :math:`\nu`, turn the slip off :math:`x`, most at the front of the
ring. The sine of the angle is :math:`\nu/(2 - \nu)` there: 10 degrees for :math:`\nu = 0.3`.
Weighted with the work of friction it is far less.

Barber (1979), ZAMP 30:468, equations (6) and (29), section 7.
"""

from pathlib import Path

import numpy as np

import carom
from carom.plots import plot_patch, save_figure

BALL = carom.Sphere(radius="5 mm", material="steel")
PAIR = carom.Pair(BALL, carom.HalfSpace(material="steel"), friction=0.2)


def angles(patch):
    """Angle between slip and traction, where they are, in degrees."""
    slips = patch.zone.values == 2
    along = (patch.slip_velocity_x / np.sign(patch.traction_x)).values[slips]
    return np.degrees(np.arctan2(patch.slip_velocity_y.values[slips], along))


def main(folder: str | Path = ".") -> str:
    """Check the largest angle, its bound and its mean; draw the patch."""
    hit = carom.impact(PAIR, speed="2 m/s", angle="25 deg")
    (place,) = (i for i, phase in enumerate(hit.phases) if phase.kind == "slip")
    phase, told = hit.phases[place], hit.slip_angles[place]
    time = 0.35 * phase.start + 0.65 * phase.end
    contact = hit.contact(time)
    nu = BALL.material.poisson
    bound = np.degrees(np.arcsin(nu / (2 - nu)))
    np.testing.assert_allclose(np.degrees(told.largest), bound, rtol=1e-12)
    stick = contact.stick_radius * contact.scales.radius
    theta = np.linspace(0, 2 * np.pi, 721)
    front = 1.00001 * stick * np.column_stack([np.cos(theta), np.sin(theta)])
    largest = np.abs(angles(hit.fields(time, points=front))).max()
    assert 0.98 * bound < largest < bound, f"{largest:.3f} degrees at the front, bound {bound:.3f}"
    assert np.abs(angles(hit.fields(time))).max() < bound
    before = hit.fields(0.5 * hit.phases[0].end)
    assert hit.phases[0].kind == "gross slip"
    assert np.abs(angles(before)).max() < 1e-9, "in gross slip all slip is along x, (30)"
    sliding, mean = hit.slip_angles[0].largest, np.degrees(told.mean)
    assert sliding == 0
    assert mean < 0.5 * bound
    line = np.linspace(-1.1, 1.1, 141) * contact.radius
    save_figure(plot_patch(hit.fields(time, line, line)), Path(folder) / "patch_in_microslip.png")
    return (
        f"slip is off by {largest:.2f} deg at the front (bound {bound:.2f}), {mean:.2f} on average"
    )


if __name__ == "__main__":
    print(main())
