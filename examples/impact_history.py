r"""Solve one impact and draw it
============================

`carom.impact` returns how a ball leaves, and `plot` draws force, velocities, radii and energy in
time.

The contact slides, sticks for a moment, slips from the edge inwards and slides back. Friction first
brakes the ball and then drives it. A part of the energy of the tangential springs comes back; the
rest is lost where the patch slips.
"""

import numpy as np
from scipy.integrate import simpson

import carom

ball = carom.Sphere(radius="5 mm", material="steel")
wall = carom.HalfSpace(material="steel")
pair = carom.Pair(ball, wall, friction=0.2)

hit = carom.impact(pair, speed="2 m/s", angle="30 deg")  # from the normal
print(f"leaves at {np.degrees(hit.rebound_angle):.2f} deg with {hit.spin_out:.0f} rad/s")
hit.plot("impact_history.png")

# %%
# Check: momentum, energy and Coulomb's law, which the solver does not use.
history = hit.history(4001)
t, force = history.time.values, history.tangential_force.values
impulse = simpson(force, x=t)
brakes = ball.mass * (hit.tangential_speed - hit.tangential_speed_out)
np.testing.assert_allclose(impulse, brakes, rtol=1e-6, err_msg="momentum")
turns = -0.4 * ball.mass * ball.radius**2 * hit.spin_out
np.testing.assert_allclose(impulse * ball.radius, turns, rtol=1e-6, err_msg="moment")
pushes = simpson(history.normal_force.values, x=t)
np.testing.assert_allclose(pushes, 2 * ball.mass * hit.normal_speed, rtol=1e-6)
shares = [f"{name}_kinetic_energy" for name in ("normal", "tangential", "spin")]
shares += ["normal_elastic_energy", "tangential_elastic_energy", "frictional_work"]
energy = sum(history[name].values for name in shares)
assert np.ptp(energy) < 1e-10 * energy[0], "energy is kept"
limit = pair.friction * history.normal_force.values
assert np.all(np.abs(force) <= limit + 1e-12 * limit.max()), "Coulomb's law"
