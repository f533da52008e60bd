"""One impact in time
==================

A steel ball strikes a steel plate at 30 degrees: force, velocities, radii, energy in time.

The contact slides, sticks for a moment, slips from the edge inwards and slides back. Friction first
brakes the ball and then drives it. A part of the energy of the tangential springs comes back; the
rest is lost where the patch slips.

Barber (1979), ZAMP 30:468; checked by momentum and energy, which the solver does not use.
"""

from pathlib import Path

import numpy as np
from scipy.integrate import simpson

import carom
from carom.plots import plot_impact, save_figure

BALL = carom.Sphere(radius="5 mm", material="steel")
PAIR = carom.Pair(BALL, carom.HalfSpace(material="steel"), friction=0.2)
SHARES = (
    "normal_kinetic_energy",
    "tangential_kinetic_energy",
    "spin_kinetic_energy",
    "normal_elastic_energy",
    "tangential_elastic_energy",
    "frictional_work",
)


def main(folder: str | Path = ".") -> str:
    """Check impulse, spin, energy and Coulomb's law over the impact; draw the histories."""
    hit = carom.impact(PAIR, speed="2 m/s", angle="30 deg")
    history = hit.history(4001)
    t, force = history.time.values, history.tangential_force.values
    impulse = simpson(force, x=t)
    brakes = BALL.mass * (hit.tangential_speed - hit.tangential_speed_out)
    np.testing.assert_allclose(impulse, brakes, rtol=1e-6, err_msg="momentum")
    turns = -0.4 * BALL.mass * BALL.radius**2 * hit.spin_out
    np.testing.assert_allclose(impulse * BALL.radius, turns, rtol=1e-6, err_msg="moment")
    pushes = simpson(history.normal_force.values, x=t)
    np.testing.assert_allclose(pushes, 2 * BALL.mass * hit.normal_speed, rtol=1e-6)
    energy = sum(history[name].values for name in SHARES)
    drift = np.ptp(energy) / energy[0]
    assert drift < 1e-10, f"energy drifts by {drift:.1e}"
    limit = PAIR.friction * history.normal_force.values
    assert np.all(np.abs(force) <= limit + 1e-12 * limit.max()), "Coulomb's law"
    save_figure(plot_impact(hit.history(400)), Path(folder) / "impact_history.png")
    return f"momentum, moment and Coulomb's law hold; energy within {drift:.0e}"


if __name__ == "__main__":
    print(main())
