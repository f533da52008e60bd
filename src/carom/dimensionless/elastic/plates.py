"""The normal impact on a plate that gives way under the force (Zener 1941).

    d'' = -(5/4) (d^(3/2) + (3/2) lambda sqrt(d) v),   w = v + (5/4) lambda d^(3/2)

in units of the elastic impact on a thick wall: d is how far both surfaces are pressed, v = d', and
w the speed of the sphere's centre. The contact ends at d = 0, and the restitution is -w there.
"""

import numpy as np

from carom.dimensionless.elastic import integration, motion as at
from carom.dimensionless.elastic.integration import Run, Work
from carom.dimensionless.elastic.motion import Series
from carom.dimensionless.elastic.record import is_full, note_node
from carom.dimensionless.numerics.arrays import Array
from carom.dimensionless.numerics.kernels import entry_point, kernel


@kernel
def expand(s: Series, sign: int, chi: float, give: float) -> None:
    """Expand as `motion.expand` in gross slip; that would be slower if it were called here, too."""
    for k in range(at.ORDER):
        s[k, at.BB] = at.product(s, at.B, at.B, k)
        s[k, at.N] = s[k, at.BB] + 1.5 * give * s[k, at.V]
        s[k + 1, at.B] = s[k, at.V] / (k + 1)
        s[k + 1, at.PSI] = -7.5 * chi * at.product(s, at.B, at.Q, k) / (k + 1)
        s[k + 1, at.Q] = 2.0 * sign * at.product(s, at.BB, at.V, k) / (k + 1)
        s[k + 1, at.V] = -2.5 * at.product(s, at.BB, at.N, k) / (k + 1)


@kernel
def slide(run: Run, sign: int) -> int:
    """Run gross slip to its end, or to that of the contact; return which of both it is."""
    s, gap = run.work.series, run.work.gap
    s[:, at.A : at.STATE_SIZE] = 0.0
    for _ in range(integration.MAX_STEPS):
        if is_full(run.record):
            break
        expand(s, sign, run.chi, run.give)
        event, h = integration.NOTHING, integration.reach(s, at.STICK, run.tolerance)
        for each in (integration.SLIP_STOPS, integration.RING_CLOSES):
            integration.write_gap(s, at.SLIDE, sign, 0.0, each, gap)
            closing = integration.first_closing(gap, h)
            if closing <= h:
                event, h = each, closing
        note_node(run.record, at.SLIDE, at.CONTACT, sign, h, s)
        integration.move(s, h)
        if event == integration.RING_CLOSES:
            s[0, at.B] = 0.0
        if event != integration.NOTHING:
            return event
    return integration.UNRESOLVED


@entry_point()
def normal_motion(give: float, tolerance: float, work: Work) -> tuple[float, float, float]:
    """Return the restitution, the duration and the largest penetration of an impact on a plate."""
    s, gap, duration, widest = work.series, work.gap, 0.0, 0.0
    s[:] = 0.0
    s[0, at.V] = 1.0
    for _ in range(integration.MAX_STEPS):
        expand(s, 0, 0.0, give)
        h = integration.reach(s, at.STICK, tolerance)
        integration.write_gap(s, at.SLIDE, 0, 0.0, integration.RING_CLOSES, gap)
        closing = integration.first_closing(gap, h)
        ends, h = closing <= h, min(closing, h)
        if s[0, at.V] > 0.0:
            integration.write_gap(s, at.STICK, 0, 0.0, 0, gap)  # psi is zero: the speed alone
            turning = integration.first_closing(gap, h)
            if turning <= h:
                widest = integration.evaluate(s[:, at.B], turning)
        for k in range(at.ORDER, -1, -1):
            duration += 2.0 * s[k, at.B] * h ** (k + 1) / (k + 1)
        integration.move(s, h)
        if ends:
            return -s[0, at.V], duration, widest * widest
    return np.nan, np.nan, np.nan


def centre_speed(give: float, penetration: Array, speed: Array) -> Array:
    """Return w, the speed of the sphere's centre in units of V_1."""
    return np.asarray(speed + 1.25 * give * penetration**1.5)


def lost(give: float, penetration: Array, centre: Array) -> Array:
    """Return the energy that waves in the plate have carried away, of m_n V_1^2/2."""
    if give == 0.0:
        return np.zeros(np.shape(penetration))
    return np.asarray(np.maximum(1.0 - centre**2 - penetration**2.5, 0.0))
