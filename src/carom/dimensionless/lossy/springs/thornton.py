"""A yielding sphere (Thornton 1997): its motion in closed form, and what its springs bear.

In units of the elastic impact: P = d^(3/2) up to yield at d = y^2, P = y^3 + (3/2) y (d - y^2)
from there on, P = sqrt(rho) (d - d_p)^(3/2) while unloading, rho = R_p/R* = d^(3/2)/P at the
turning point, where d_p = d (1 - 1/rho). The edge is the true one, b^2 = d and rho (d - d_p).

Abel's transform of Hertz's pressure, cut at that of yield, is what springs bear that yield each for
itself: N(w) = w up to w = y^2, (2/pi) (y sqrt(w - y^2) + w asin(y/sqrt(w))) beyond, w = d - x^2.
While unloading N = (b^2 - x^2)/rho.
"""

import numpy as np

from carom.dimensionless.lossy.springs.work import (
    DEPTH,
    EDGE,
    LIMIT,
    LOAD,
    NEXT,
    RATE,
    SOFTER,
    SPEED,
    TIME,
    WEIGHT,
    S,
    U,
)
from carom.dimensionless.numerics import hertz
from carom.dimensionless.numerics.arrays import Array
from carom.dimensionless.numerics.kernels import kernel


@kernel
def hertzian(angle: float) -> tuple[float, float, float]:
    """Return edge, speed and time of Hertz's impact at an angle whose sine is the edge.

    v^2 = 1 - b^5 is divided by 1 - b^2, so that the turning point is regular.
    """
    b = np.sin(angle)
    quotient = (1.0 + b * (1.0 + b * (1.0 + b * (1.0 + b)))) / (1.0 + b)
    v = np.cos(angle) * np.sqrt(quotient)
    return b, v, hertz.time(b * b, v)


@kernel
def lay_motion(y: float, steps: int, motion: Array) -> None:
    """Fill in the motion: so many steps of loading, by time before yield and after it, and back.

    After yield P = peak sin(omega t + phase), as P'' = -(15/8) y P.
    """
    v, omega = np.sqrt(1.0 - y**5), np.sqrt(1.875 * y)
    peak, phase = np.sqrt(1.2 * y - 0.2 * y**6), np.arctan2(y**3, 1.5 * y * v / omega)
    began, left = hertz.time(y * y, v), 0.5 * np.pi - phase
    share = steps * began / (began + left / omega)
    for i in range(steps + 1):
        if i < share:
            b, motion[i, SPEED], motion[i, TIME] = hertzian(np.arcsin(y) * i / share)
            motion[i, DEPTH], motion[i, EDGE], motion[i, LOAD] = b * b, b, b * b * b
        else:
            ahead = left * (i - share) / (steps - share)
            load, rate = peak * np.sin(phase + ahead), peak * omega * np.cos(phase + ahead)
            depth = y * y + (load - y**3) / (1.5 * y)
            motion[i, TIME], motion[i, SPEED] = began + ahead / omega, rate / (1.5 * y)
            motion[i, DEPTH], motion[i, EDGE], motion[i, LOAD] = depth, np.sqrt(depth), load
    _unloading(steps, motion[steps:])


@kernel
def _unloading(steps: int, motion: Array) -> None:
    """Hertz's motion, outwards and on a sphere of the radius R_p."""
    turned, deepest, peak = motion[0, TIME], motion[0, DEPTH], motion[0, LOAD]
    elastic = peak / np.sqrt(deepest)  # d - d_p at the turning point, d/rho
    e = np.sqrt(peak * elastic)  # v^2 = sqrt(rho) (d - d_p)^(5/2)
    motion[0, SPEED] = 0.0
    for i in range(1, steps + 1):
        b, v, time = hertzian(0.5 * np.pi * (1.0 + i / steps))
        if i == steps:
            b, v, time = 0.0, -1.0, hertz.DURATION
        motion[i, TIME] = turned + (time - 0.5 * hertz.DURATION) * elastic / e
        motion[i, DEPTH], motion[i, SPEED] = deepest - elastic * (1.0 - b * b), e * v
        motion[i, EDGE], motion[i, LOAD] = np.sqrt(deepest) * b, peak * b * b * b


@kernel
def turn(turned: Array, springs: Array, count: int) -> float:
    """Put springs to what they bear as unloading begins; return the force in shear.

    The pressure becomes that of an elastic contact at once, which may cut springs in shear.
    """
    force, shrunk = 0.0, turned[LOAD] / turned[EDGE] ** 3
    for j in range(count):
        most = (turned[EDGE] ** 2 - springs[S, j]) * shrunk
        springs[NEXT, j], springs[SOFTER, j] = most, 0.0
        springs[U, j] = max(min(springs[U, j], most), -most)
        force += springs[WEIGHT, j] * springs[U, j]
    return force


@kernel
def press(y: float, before: Array, after: Array, shrunk: float, springs: Array, count: int) -> None:
    """Fill in what springs bear before and after a step, and its rate before.

    shrunk is 1/rho while unloading, else 0.
    """
    for j in range(count):
        springs[LIMIT, j] = springs[NEXT, j]
        springs[RATE, j] = (1.0 - springs[SOFTER, j]) * before[SPEED]
        w = after[DEPTH] - springs[S, j]
        if shrunk > 0.0:
            springs[NEXT, j] = (after[EDGE] ** 2 - springs[S, j]) * shrunk
        elif w <= y * y:
            springs[NEXT, j] = w
        else:
            slope = np.arcsin(y / np.sqrt(w)) * 2.0 / np.pi
            springs[NEXT, j] = 2.0 / np.pi * y * np.sqrt(w - y * y) + w * slope
            springs[SOFTER, j] = 1.0 - slope


@kernel
def stored(depth: float, load: float) -> float:
    """Return the energy that unloading from here would give back, P (d - d_p), of m_n V_1^2/2."""
    return load * load / np.sqrt(depth) if depth > 0.0 else 0.0
