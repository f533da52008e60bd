r"""The force that brakes the contact point
=======================================

The tangential force, once from the tractions and once from the deceleration of the ball.

While the contact sticks, :math:`F_x` is the moment of :math:`g`, (11) to (13), and also mass times
deceleration, (14). As printed, (14) ends on :math:`(1 - c b^5)^{1/2}\,g'(b)`, and the two curves
part. Without the root they agree to rounding, and (15) follows. Here :math:`\psi_1 = 0.8` and
:math:`\chi = 1.44`.

Barber (1979), ZAMP 30:468, equations (10) to (15).
"""

import numpy as np
from scipy.special import hyp2f1

import carom
from carom.plots.legends import legend_above
from carom.plots.style import BLACK, BLUE, DASHES, VERMILION, new_figure, save_figure, style

BALL = carom.Sphere(radius="5 mm", material="steel")
PAIR = carom.Pair(BALL, carom.HalfSpace(material="steel"), friction=0.2)
PSI, SPEED = 0.8, 1.0
G, NU, R, M, MU = (
    BALL.material.shear_modulus,
    BALL.material.poisson,
    BALL.radius,
    BALL.mass,
    PAIR.friction,
)
C = 16 * G / (15 * M * R**2 * SPEED**2 * (1 - NU))  # (5)


def decelerated(b, g, slope, root):
    """Return F_x by (14), with V_1^2 for the printed V_x^2; the root is the other misprint."""
    x = C * b**5
    bracket = 2.5 * C * b**4 * g - (1 - x) ** root * slope
    unit = (2 - NU) * R * SPEED**2 * MU / (4 * (1 - NU) * b)
    return M * unit * bracket / (1 + 1 / BALL.gyration_ratio)


with style():
    velocity = PSI * MU * SPEED / PAIR.kappa
    hit = carom.impact(PAIR, normal_speed=SPEED, tangential_speed=velocity)
    assert abs(hit.psi_in - PSI) < 1e-12
    chi, root = PAIR.chi, np.sqrt(240 * PAIR.chi + 1)
    state = hit.solution.at(np.linspace(0.002, hit.solution.phases[0].end, 120))
    b = state.contact_radius * hit.scales.radius
    force = state.force * hit.scales.tangential_force

    def memory(b):
        """The memory g, (27)."""
        return PSI * hyp2f1((11 + root) / 20, (11 - root) / 20, 0.6, C * b**5)

    step = 1e-4 * b[-1] * np.minimum(1, 4 * (1 - C * b**5))
    slope, curvature = (
        (memory(b + step) - memory(b - step)) / (2 * step),
        (memory(b + step) - 2 * memory(b) + memory(b - step)) / step**2,
    )
    x = C * b**5
    left = (1 - x) * b**2 * curvature - (1 + 6.5 * x) * b * slope
    left += 7.5 * x * (2 * chi - 1) * memory(b)
    assert np.abs(left / (1 + np.abs(b**2 * curvature))).max() < 1e-5, "(15)"
    unit = 4 * G * MU / (R * (1 - NU))
    nodes, weights = np.polynomial.legendre.leggauss(60)
    s = b[:, np.newaxis] * (1 + nodes) / 2
    by_12 = unit * b / 2 * (s**2 * memory(s) @ weights)
    by_14, printed = (decelerated(b, memory(b), slope, root) for root in (1, 0.5))
    largest = force.max()
    error_12 = np.abs(force - by_12).max() / largest
    assert error_12 < 1e-9, f"(12) differs from the impact by {error_12:.1e}"
    error = np.abs(by_14 - by_12).max() / largest
    assert error < 1e-5, f"(14) corrected differs from (12) by {error:.1e}"
    misprint = np.abs(printed - by_12).max() / largest
    assert misprint > 0.1, "(14) as printed should differ"

    figure, ((axis,),) = new_figure()
    micro = 1e6
    axis.plot(b * micro, force, color=BLACK, lw=2.4, alpha=0.35, label="impact")
    axis.plot(b * micro, by_12, color=BLUE, label="moment of $g$, (12)")
    axis.plot(b * micro, by_14, color=VERMILION, ls=DASHES[1], label="(14), corrected")
    axis.plot(b * micro, printed, color="0.4", ls=DASHES[2], label="(14), as printed")
    axis.axhline(0, color="0.5", lw=0.5)
    axis.set(xlim=(0, None), xlabel="$b$ (µm)")
    axis.set(ylabel="$F_x$ (N)")
    legend_above(axis, 2)
    save_figure(figure, "equation_of_motion.png")
    print(f"(12) within {error_12:.0e}, (14) within {error:.0e}, as printed off by {misprint:.0%}")
