"""The normal impact of elastic bodies: Hertz (1882), in units of d_max, V_1 and P_max.

d'' = -(5/4) d^(3/2) with d(0) = 0, v(0) = 1, hence v^2 = 1 - x with x = d^(5/2): the paper's (4)
and (23). Time is an incomplete beta function, summed here as a series from whichever of the two
singular points, touch (x = 0) and turning point (v = 0), is nearer.
"""

import numpy as np

from carom.dimensionless.numerics.kernels import entry_point, kernel

TERMS = 54  # of either series, for 1e-17 at x = 1/2


def _series(numerator: float, exponent: float) -> np.ndarray:
    """Return the coefficients (numerator)_k / k! * exponent / (exponent + k)."""
    k = np.arange(TERMS)
    factors = np.concatenate([[1.0], (numerator + k[:-1]) / (k[:-1] + 1.0)])
    return np.cumprod(factors) * exponent / (exponent + k)


FROM_TOUCH = _series(1 / 2, 2 / 5)
FROM_TURNING = _series(3 / 5, 1 / 2)

DURATION = 2.94327518432470465738  # (4/5) B(2/5, 1/2)
HALF = DURATION / 2.0


@entry_point()
def elapsed(d: float) -> float:
    """Return the time since touch at penetration d while loading, d^(5/2) <= 1/2 or so."""
    x = d * d * np.sqrt(d)
    total = 0.0
    for k in range(TERMS - 1, -1, -1):
        total = total * x + FROM_TOUCH[k]
    return d * total


@kernel
def until_turning(v: float) -> float:
    """Return the time from speed v to the turning point, |v| <= 0.8 or so; odd in v."""
    y = v * v
    total = 0.0
    for k in range(TERMS - 1, -1, -1):
        total = total * y + FROM_TURNING[k]
    return 0.8 * v * total


HALFWAY = float((2.0**-0.4) * np.polynomial.polynomial.polyval(0.5, FROM_TOUCH))  # x = 1/2


@entry_point()
def time(d: float, v: float) -> float:
    """Return the time since the first touch at penetration d and speed v (of either sign)."""
    if 2.0 * v * v <= 1.0:
        return HALF - until_turning(v)
    if v > 0.0:
        return elapsed(d)
    return DURATION - elapsed(d)


@kernel
def penetration_after(t: float) -> float:
    """Return the penetration at a time t <= HALFWAY after touch."""
    d = t * (1.0 - t * t * np.sqrt(t) / 7.0)
    for _ in range(8):
        correction = (elapsed(d) - t) * np.sqrt(1.0 - d * d * np.sqrt(d))
        d -= correction
        if abs(correction) <= 1e-16 * d:
            break
    return float(d)


@kernel
def speed_before_turning(t: float) -> float:
    """Return the speed at a time |t| <= HALF - HALFWAY before the turning point; odd in t."""
    v = 1.25 * t
    for _ in range(12):
        correction = (until_turning(v) - t) * 1.25 * (1.0 - v * v) ** 0.6
        v -= correction
        if abs(correction) <= 1e-16 * abs(v):
            break
    return v


@kernel
def penetration_and_speed(t: float) -> tuple[float, float]:
    """Return penetration and speed at a time t since the first touch, 0 <= t <= DURATION."""
    nearer = min(t, DURATION - t)
    if nearer <= 0.0:
        return 0.0, 1.0 if t <= 0.0 else -1.0
    if nearer <= HALFWAY:
        d = penetration_after(nearer)
        v = np.sqrt(1.0 - d * d * np.sqrt(d))
    else:
        v = speed_before_turning(HALF - nearer)
        d = (1.0 - v * v) ** 0.4
    return d, v if t < HALF else -v
