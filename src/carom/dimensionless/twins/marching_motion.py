"""Normal motions cut into small steps, for the marching method.

A normal motion is an array with a row for each end of a step: a parameter, time, d(time)/d(that),
radius b of the edge of the contact, Coulomb's limit D at its centre, dD/dt of the step that begins.
d(time)/d(that) is continuous. A spring at x is in contact while x < b, and its limit is D - x^2.
Rows up to the largest b are loading, on which new springs are met. Kelvin & Voigt's rows go on with
d and its rate v. Lengths in d_max, b in
sqrt(R d_max), time in d_max/V_1, as of the elastic impact.
"""

import numpy as np

from carom.dimensionless.numerics import hertz
from carom.dimensionless.numerics.arrays import Array
from carom.dimensionless.numerics.kernels import kernel

TERMS = 12  # of the power series in one step
STRIDE = 0.02  # of the clock, while looking for the end of loading or of contact
STRIDES = 100_000


@kernel
def elastic(steps: int) -> Array:
    """Return Hertz's motion in equal steps of the angle theta, b = sin(theta): D = d.

    v^2 = 1 - b^5 is divided by 1 - b^2, so that the turning point is regular.
    """
    rows = np.empty((steps + 1, 6))
    for i in range(steps + 1):
        theta = i * (np.pi / steps)
        b = np.sin(min(i, steps - i) * (np.pi / steps))
        quotient = (1.0 + b * (1.0 + b * (1.0 + b * (1.0 + b)))) / (1.0 + b)
        v = np.cos(theta) * np.sqrt(quotient)
        rows[i] = theta, hertz.time(b * b, v), 2.0 * b / np.sqrt(quotient), b, b * b, v
    return rows


@kernel
def _series(b: float, v: float, drag: float, recession: float) -> Array:
    """Return the power series of b, v and time in the clock.

    b' = v - recession b^3, v' = -(5/2) b^2 (b^2 + drag v), t' = 2 b
    """
    rows = np.zeros((3, TERMS + 1))
    square, load = np.zeros(TERMS), np.zeros(TERMS)
    rows[0, 0], rows[1, 0] = b, v
    for k in range(TERMS):
        for i in range(k + 1):
            square[k] += rows[0, i] * rows[0, k - i]
        load[k] = square[k] + drag * rows[1, k]
        cube, force = 0.0, 0.0
        for i in range(k + 1):
            cube += square[i] * rows[0, k - i]
            force += square[i] * load[k - i]
        rows[0, k + 1] = (rows[1, k] - recession * cube) / (k + 1)
        rows[1, k + 1] = -2.5 * force / (k + 1)
        rows[2, k + 1] = 2.0 * rows[0, k] / (k + 1)
    return rows


@kernel
def _value(coefficients: Array, clock: float) -> float:
    total = 0.0
    for k in range(TERMS, -1, -1):
        total = total * clock + coefficients[k]
    return total


@kernel
def _clock_until_zero(which: int, b: float, v: float, drag: float, recession: float) -> float:
    """Return the clock until b (`which` 0) or v (1) falls to zero."""
    passed = 0.0
    series = _series(b, v, drag, recession)
    for _ in range(STRIDES):
        if _value(series[which], STRIDE) <= 0.0:
            break
        series = _series(_value(series[0], STRIDE), _value(series[1], STRIDE), drag, recession)
        passed += STRIDE
    near, far = 0.0, STRIDE
    for _ in range(60):
        middle = 0.5 * (near + far)
        if _value(series[which], middle) > 0.0:
            near = middle
        else:
            far = middle
    return passed + near


@kernel
def kelvin_voigt(alpha: float, steps: int) -> Array:
    """Return the motion with normal losses in equal steps of a clock, as many either side of v = 0.

    d(clock) = dt/(2 b), which makes right-hand sides polynomials of b and v: while loading
    b^2 = d, b' = v, v' = -(5/2) b^2 (b^2 + (3/2) alpha v); then b^2 = D = d + alpha v,
    b' = v - (5/4) alpha b^3, v' = -(5/2) b^4.
    """
    rows = np.empty((steps + 1, 8))
    b, v, t, clock = 0.0, 1.0, 0.0, 0.0
    half = steps // 2
    rows[0] = clock, t, 0.0, b, alpha, v, 0.0, v
    for unloading in range(2):
        drag, recession = (0.0, 1.25 * alpha) if unloading else (1.5 * alpha, 0.0)
        h = _clock_until_zero(1 - unloading, b, v, drag, recession) / half
        for i in range(half):
            series = _series(b, v, drag, recession)
            b, v = _value(series[0], h), _value(series[1], h)
            if i == half - 1:
                b, v = (0.0, v) if unloading else (b, 0.0)
            t += _value(series[2], h)
            clock += h
            limit = b * b + alpha * max(v, 0.0)
            growth = v - 1.25 * alpha * b * (b * b + drag * v)
            depth = b * b - unloading * alpha * v
            rows[unloading * half + i + 1] = clock, t, 2.0 * b, b, limit, growth, depth, v
    return rows
