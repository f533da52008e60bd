r"""An impact in the cone of friction
=================================

The path of the forces in the cone of friction through one impact.

The tangential force :math:`F_x` is drawn against the normal force :math:`F_z`. Gross slip runs
along the border of the cone, and stick leaves it with the slope :math:`\mu\,g(b)`. The slip ring
then leads across to the other border: friction first brakes the ball and then drives it.

Barber (1979), ZAMP 30:468, equations (2), (10), (13) and section 7.
"""

from pathlib import Path

import numpy as np

import carom
from carom.plots import plot_cone, save_figure

BALL = carom.Sphere(radius="5 mm", material="steel")
PAIR = carom.Pair(BALL, carom.HalfSpace(material="steel"), friction=0.2)


def main(folder: str | Path = ".") -> str:
    """Check where the path lies on the border of the cone, and the slopes in stick; draw it."""
    hit = carom.impact(PAIR, speed="2 m/s", angle="20 deg")
    history = hit.history(2000)
    t, normal = history.time.values, history.normal_force.values
    share = history.tangential_force.values[1:-1] / (PAIR.friction * normal[1:-1])
    for phase in hit.phases:
        inside = (t[1:-1] > phase.start) & (t[1:-1] < phase.end)
        if phase.kind == "gross slip":
            np.testing.assert_allclose(share[inside], phase.sign, rtol=1e-9, err_msg="border")
        else:
            assert np.all(np.abs(share[inside]) < 1), "stick and slip lie inside the cone"
        if phase.kind == "stick":
            # dF_x/dF_z = mu g(b) = mu psi V_1/V_z, by (10), (13) and (2)
            force, velocity, speed = (
                history[name].values[1:-1][inside]
                for name in ("tangential_force", "contact_velocity", "normal_velocity")
            )
            g = PAIR.kappa * velocity / (PAIR.friction * speed)
            slope = np.gradient(force, normal[1:-1][inside], edge_order=2)
            worst = np.abs(slope / PAIR.friction - g)[5:-5].max()
    assert worst < 1e-3, f"slope in stick differs from mu g(b) by {worst:.1e}"
    save_figure(plot_cone(hit.history(400)), Path(folder) / "friction_cone.png")
    return f"on the border in gross slip, inside elsewhere; slope mu g(b) in stick to {worst:.0e}"


if __name__ == "__main__":
    print(main())
