"""The normal impact on a plate that gives way under the force (Zener 1941).

    d'' = -(5/4) (d^(3/2) + (3/2) lambda sqrt(d) v),   w = v + (5/4) lambda d^(3/2)

in units of the elastic impact on a thick wall: d is how far both surfaces are pressed, v = d', and
w the speed of the sphere's centre. The contact ends at d = 0, and the restitution is -w there.
"""

import numpy as np

from carom.dimensionless.elastic import motion as at
from carom.dimensionless.elastic.integration import (
    MAX_STEPS,
    RING_CLOSES,
    Work,
    evaluate,
    first_closing,
    move,
    reach,
    write_gap,
)
from carom.dimensionless.numerics.kernels import entry_point


@entry_point()
def normal_motion(give: float, tolerance: float, work: Work) -> tuple[float, float, float]:
    """Return the restitution, the duration and the largest penetration of an impact on a plate."""
    s, gap, duration, widest = work.series, work.gap, 0.0, 0.0
    s[:] = 0.0
    s[0, at.V] = 1.0
    for _ in range(MAX_STEPS):
        at.expand(s, at.SLIDE, at.CONTACT, 0, 1.0, give)
        h = reach(s, at.STICK, tolerance)
        write_gap(s, at.SLIDE, 0, 0.0, RING_CLOSES, gap)
        closing = first_closing(gap, h)
        ends, h = closing <= h, min(closing, h)
        if s[0, at.V] > 0.0:
            for k in range(at.ORDER + 1):
                gap[k] = s[k, at.V]
            turning = first_closing(gap, h)
            if turning <= h:
                widest = evaluate(s[:, at.B], turning)
        for k in range(at.ORDER, -1, -1):
            duration += 2.0 * s[k, at.B] * h ** (k + 1) / (k + 1)
        move(s, h)
        if ends:
            return -s[0, at.V], duration, widest * widest
    return np.nan, np.nan, np.nan


def centre_speed(give: float, penetration: np.ndarray, speed: np.ndarray) -> np.ndarray:
    """Return w, the speed of the sphere's centre in units of V_1."""
    return np.asarray(speed + 1.25 * give * penetration**1.5)


def lost(give: float, penetration: np.ndarray, centre: np.ndarray) -> np.ndarray:
    """Return the energy that waves in the plate have carried away, of m_n V_1^2/2."""
    if give == 0.0:
        return np.zeros(np.shape(penetration))
    return np.asarray(np.maximum(1.0 - centre**2 - penetration**2.5, 0.0))
