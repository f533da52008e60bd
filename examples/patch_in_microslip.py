r"""See the contact patch from above
================================

`carom.plots.plot_patch` draws traction, stick region and the direction of slip at one instant.

A ring slips here. The theory assumes that all points slip along :math:`x`, and they nearly do. The
lateral displacements, of the order of :math:`\nu`, turn the slip off :math:`x`, most at the front
of the ring. The sine of the angle is :math:`\nu/(2 - \nu)` there: 10 degrees for :math:`\nu = 0.3`.
Weighted with the work of friction it is far less. Barber (1979), ZAMP 30:468, (6), (29), section 7.
"""

import numpy as np

import carom

ball = carom.Sphere(radius="5 mm", material="steel")
pair = carom.Pair(ball, carom.HalfSpace(material="steel"), friction=0.2)
hit = carom.impact(pair, speed="2 m/s", angle="25 deg")
place = [phase.kind for phase in hit.phases].index("slip")
ring, angles = hit.phases[place], hit.slip_angles[place]
time = 0.35 * ring.start + 0.65 * ring.end

line = np.linspace(-1.1, 1.1, 141) * hit.contact(time).radius
figure = carom.plots.plot_patch(hit.fields(time, line, line))
carom.plots.save_figure(figure, "patch_in_microslip.png")
bound, mean = np.degrees(angles.largest), np.degrees(angles.mean)
print(f"slip turns off x by {mean:.2f} deg on average, {bound:.2f} deg at most")


# %%
# Check: the largest angle, its bound and its mean.
def turned(patch):
    """Angle between slip and traction, where they are, in degrees."""
    slips = patch.zone.values == 2
    along = (patch.slip_velocity_x / np.sign(patch.traction_x)).values[slips]
    return np.abs(np.degrees(np.arctan2(patch.slip_velocity_y.values[slips], along))).max()


nu = ball.material.poisson
np.testing.assert_allclose(bound, np.degrees(np.arcsin(nu / (2 - nu))), rtol=1e-12)
contact = hit.contact(time)
theta = np.linspace(0, 2 * np.pi, 721)
front = 1.00001 * contact.stick_radius * contact.scales.radius
edge = hit.fields(time, points=front * np.column_stack([np.cos(theta), np.sin(theta)]))
assert 0.98 * bound < turned(edge) < bound
assert turned(hit.fields(time)) < bound
assert turned(hit.fields(0.5 * hit.phases[0].end)) < 1e-9, "gross slip is along x, (30)"
assert hit.slip_angles[0].largest == 0
assert mean < 0.5 * bound
