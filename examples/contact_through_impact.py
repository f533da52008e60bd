r"""The contact through one impact
==============================

What does the contact patch do while a ball strikes at 25 degrees? Red patches push the plate
forward and slow the ball, blue ones do the opposite, and white ones bear no traction.

(a) At first the whole patch slides. (b) Then it sticks. (c, d, e) From the edge a ring slips
backwards and grows inwards, while the centre still bears the traction of the time when it stuck.
(f) Before the end the whole patch slides backwards. Arrows are slip velocities, each patch on its
own scale. Dashed lines are the limits :math:`\pm\mu p` of the traction :math:`f_x`, and
:math:`\pm\mu F_z` of the force :math:`F_x`.

Maw, Barber & Fawcett (1976), Wear 38:101; Barber (1979), ZAMP 30:468.
"""

from itertools import pairwise
from pathlib import Path

import numpy as np

import carom

BALL = carom.Sphere(radius="5 mm", material="bearing-steel")
PAIR = carom.Pair(BALL, carom.HalfSpace(material="bearing-steel"), friction=0.2)


def main(folder: str | Path = ".") -> str:
    """Check force and Coulomb's law in the patches that the figure shows, and draw them."""
    hit = carom.impact(PAIR, speed="0.6 m/s", angle="25 deg")
    kinds = [phase.kind for phase in hit.phases]
    assert kinds == ["gross slip", "stick", "slip", "gross slip"], kinds
    ends = [phase.start for phase in hit.phases] + [hit.duration]
    largest, worst = PAIR.friction * hit.max_force, 0.0
    for start, end in pairwise(ends):
        side = np.linspace(-1.0, 1.0, 401) * hit.max_radius
        fields = hit.fields((start + end) / 2, x=side, y=side)
        limit = PAIR.friction * fields.pressure.values
        traction = fields.traction_x.values
        assert np.all(np.abs(traction) <= limit * (1 + 1e-9) + 1e-3), "Coulomb's law"
        force = traction.sum() * (side[1] - side[0]) ** 2
        worst = max(worst, abs(force - float(fields.tangential_force)) / largest)
    assert worst < 1e-3, f"tractions add up to the force but for {worst:.1e}"
    figure = carom.plots.plot_contact(hit)
    carom.plots.save_figure(figure, Path(folder) / "contact_through_impact.png")
    return f"Coulomb's law holds, and tractions add up to the force within {worst:.0e} of mu F_z"


if __name__ == "__main__":
    print(main())
