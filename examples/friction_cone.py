r"""Draw the forces in the cone of friction
=======================================

`carom.plots.plot_cone` draws the tangential force against the normal force through one impact.

Gross slip runs along the border of the cone, and stick leaves it with the slope :math:`\mu\,g(b)`.
The slip ring then leads across to the other border: friction first brakes the ball and then drives
it. Barber (1979), ZAMP 30:468, equations (2), (10), (13) and section 7.
"""

import numpy as np

import carom

ball = carom.Sphere(radius="5 mm", material="steel")
pair = carom.Pair(ball, carom.HalfSpace(material="steel"), friction=0.2)
hit = carom.impact(pair, speed="2 m/s", angle="20 deg")
for phase in hit.phases:
    print(f"{1e6 * phase.start:5.2f} to {1e6 * phase.end:5.2f} us  {phase.kind} {phase.sign:+d}")
figure = carom.plots.plot_cone(hit.history(400))
carom.plots.save_figure(figure, "friction_cone.png")

# %%
# Check: where the path lies on the border of the cone, and its slope in stick.
history = hit.history(2000)
t, normal = history.time.values[1:-1], history.normal_force.values[1:-1]
share = history.tangential_force.values[1:-1] / (pair.friction * normal)
for phase in hit.phases:
    inside = (t > phase.start) & (t < phase.end)
    if phase.kind == "gross slip":
        np.testing.assert_allclose(share[inside], phase.sign, rtol=1e-9, err_msg="border")
    else:
        assert np.all(np.abs(share[inside]) < 1), "stick and slip lie inside the cone"
    if phase.kind == "stick":  # dF_x/dF_z = mu g(b) = mu psi V_1/V_z, by (10), (13) and (2)
        velocity, speed = (
            history[name].values[1:-1][inside] for name in ("contact_velocity", "normal_velocity")
        )
        slope = np.gradient(share[inside] * normal[inside], normal[inside], edge_order=2)
        g = pair.kappa * velocity / (pair.friction * speed)
        np.testing.assert_allclose(slope[5:-5], g[5:-5], atol=1e-3)
