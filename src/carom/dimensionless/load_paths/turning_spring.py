"""One spring of the contact through a straight step in two directions, in closed form.

A spring bears q, |q| <= r, while its limit r and the bodies move at constant rates, rho and v. Once
it slips, it slips to the end, and the angle theta from v to q decays as that of a dog on its lead:

    tan(theta/2) = tan(theta_0/2) exp(-tau),    d tau = (v/r) dt.
"""

from typing import NamedTuple

import numpy as np

from carom.dimensionless.numerics.kernels import kernel

HIGHEST = 1e6  # of tan^2(theta/2) in the fraction; beyond, the spring pulls straight ahead
SMALLEST = 1e-300


class Turned(NamedTuple):
    """The spring after a step: its deflection, the work of its slip."""

    x: float
    y: float
    work: float


@kernel
def saved(ratio: float, z: float) -> float:
    """Return int_0^1 y^(b - 1) z/(1 + z y) dy, b = 1 - ratio > 0, as Gauss' continued fraction.

    r^2 times it is the work that a spring still saves as it does not yet pull straight back.
    """
    if z > HIGHEST:
        return -1.0 / ratio
    b = 1.0 - ratio
    value, c = 1.0, b + 1.0
    for n in range(int(12.0 + 9.0 * np.sqrt(z)), 0, -1):
        odd = (b + n) * (c + n - 1.0) / ((c + 2.0 * n - 1.0) * (c + 2.0 * n))
        even = n * (c - b + n - 1.0) / ((c + 2.0 * n - 2.0) * (c + 2.0 * n - 1.0))
        value = 1.0 + even * z / (1.0 + odd * z / value)
    return float(z / b / (1.0 + b / c * z / value))


@kernel
def time_of_slip(x: float, y: float, r: float, u: float, v: float, rise: float) -> float:
    """Return when a spring that sticks comes to its limit; rates are those of a step of length 1.

    |q + v t| = r + rho t; infinite where that is never.
    """
    a = u * u + v * v - rise * rise
    b = x * u + y * v - r * rise
    c = min(x * x + y * y - r * r, 0.0)
    square = b * b - a * c
    if square < 0.0:
        return np.inf
    root = np.sqrt(square)
    if b > 0.0:
        return float(-c / (b + root))
    return float((root - b) / a) if a > 0.0 else np.inf


@kernel
def slid(x: float, y: float, r: float, end: float, u: float, v: float, time: float) -> Turned:
    """Return a spring that slips from its limit r to the limit `end`; u and v in this time."""
    speed, rise = np.hypot(u, v), (end - r) / time
    mean = 0.5 * (r + end)
    if speed == 0.0:
        return Turned(x * end / r, y * end / r, -mean * rise * time)
    work = mean * (speed - rise) * time
    if r == 0.0:
        return Turned(end * u / speed, end * v / speed, work)
    cosine, sine = (x * u + y * v) / (r * speed), (y * u - x * v) / (r * speed)
    decay = 0.0
    if end > 0.0:
        change = (end - r) / r
        decay = np.exp(-speed * time / r * (np.log1p(change) / change if change != 0.0 else 1.0))
    if cosine < 0.0:
        behind = 1.0 - cosine
        ahead = max(sine * sine / behind, SMALLEST)
    else:
        ahead = 1.0 + cosine
        behind = sine * sine / ahead
    left = behind * decay * decay
    ratio = rise / speed
    if behind > 0.0 and ratio < 1.0:
        work -= r * r * saved(ratio, behind / ahead) - end * end * saved(ratio, left / ahead)
    along = end * (ahead - left) / (ahead + left)
    aside = end * 2.0 * decay * sine / (ahead + left)
    return Turned((along * u - aside * v) / speed, (along * v + aside * u) / speed, work)


@kernel
def turned(x: float, y: float, s: float, d0: float, d1: float, u: float, v: float) -> Turned:
    """Return the spring at s after a step from depth d0 to d1 in which the bodies move by u, v."""
    rise = d1 - d0
    start = (s - d0) / rise if s > d0 else 0.0
    end = (s - d0) / rise if s > d1 else 1.0
    if s >= d0 and s >= d1:
        return Turned(0.0, 0.0, 0.0)
    r = max(d0 - s, 0.0)
    slips = start + time_of_slip(x, y, r, u, v, rise)
    if slips >= end:
        return Turned(x + (end - start) * u, y + (end - start) * v, 0.0)
    stuck = slips - start
    reached = max(r + stuck * rise, 0.0)
    x, y = x + stuck * u, y + stuck * v
    return slid(x, y, reached, max(d1 - s, 0.0), u, v, end - slips)
