r"""See what the contact does
=========================

`carom.plots.plot_contact` draws the contact patch, its traction and the force through one impact.

Red patches push the plate forward and slow the ball, blue ones do the opposite, and white ones bear
no traction. (a) At first the whole patch slides. (b) Then it sticks. (c, d, e) From the edge a ring
slips backwards and grows inwards, while the centre still bears the traction of the time when it
stuck. (f) Before the end the whole patch slides backwards. Arrows are slip velocities, each patch
on its own scale. Dashed lines are the limits :math:`\pm\mu p` of the traction :math:`f_x`, and
:math:`\pm\mu F_z` of the force :math:`F_x`.
"""

from itertools import pairwise

import numpy as np

import carom

ball = carom.Sphere(radius="5 mm", material="bearing-steel")
pair = carom.Pair(ball, carom.HalfSpace(material="bearing-steel"), friction=0.2)
hit = carom.impact(pair, speed="0.6 m/s", angle="25 deg")
kinds = [phase.kind for phase in hit.phases]
print(*kinds, sep=", ")
figure = carom.plots.plot_contact(hit)
carom.plots.save_figure(figure, "contact_through_impact.png")

# %%
# Check: Coulomb's law at every point, and the sum of the tractions, in the middle of each phase.
assert kinds == ["gross slip", "stick", "slip", "gross slip"], kinds
side = np.linspace(-1.0, 1.0, 401) * hit.max_radius
for start, end in pairwise([phase.start for phase in hit.phases] + [hit.duration]):
    fields = hit.fields((start + end) / 2, x=side, y=side)
    limit, traction = pair.friction * fields.pressure.values, fields.traction_x.values
    assert np.all(np.abs(traction) <= limit * (1 + 1e-9) + 1e-3), "Coulomb's law"
    force = traction.sum() * (side[1] - side[0]) ** 2
    worst = abs(force - float(fields.tangential_force)) / (pair.friction * hit.max_force)
    assert worst < 1e-3, f"tractions add up to the force but for {worst:.1e}"
