"""A yielding sphere (Thornton 1997): its load, what its springs bear, and what it comes to.

In units of the elastic impact: P = d^(3/2) up to yield at d = y^2, P = y^3 + (3/2) y (d - y^2)
from there on, P = sqrt(rho) (d - d_p)^(3/2) while unloading, rho = R_p/R* = d^(3/2)/P at the
turning point, where d_p = d (1 - 1/rho). The edge is the true one, b^2 = d and rho (d - d_p).

Abel's transform of Hertz's pressure, cut at that of yield, is what springs bear that yield each for
itself: N(w) = w up to w = y^2, (2/pi) (y sqrt(w - y^2) + w asin(y/sqrt(w))) beyond, w = d - x^2.
While unloading N = (b^2 - x^2)/rho.
"""

import numpy as np

from carom.dimensionless.lossy import layout
from carom.dimensionless.lossy.springs import motion as at, springs as of
from carom.dimensionless.numerics import hertz
from carom.dimensionless.numerics.arrays import Array
from carom.dimensionless.numerics.kernels import kernel


@kernel
def press(y: float, now: Array, new: Array, turned: Array, springs: Array, laid: int) -> int:
    """Fill in what springs bear after a step, return how many touch; `turned` is 0 at first."""
    d, shrunk = new[at.DEPTH], 0.0
    edge, load = np.sqrt(max(d, 0.0)), 0.0
    if turned[at.EDGE] > 0.0:
        shrunk = turned[at.LOAD] / turned[at.EDGE] ** 3
        edge = np.sqrt(max(turned[at.DEPTH] - (turned[at.DEPTH] - d) / shrunk, 0.0))
        load = shrunk * edge**3
    else:
        load = edge**3 if edge <= y else y**3 + 1.5 * y * (d - y * y)
    new[at.EDGE], new[at.LOAD] = edge, load
    touching = int(np.searchsorted(springs[of.X, :laid], edge))
    bear(y, now, new, shrunk, springs, max(touching, 1))
    return touching


@kernel
def bear(y: float, now: Array, new: Array, shrunk: float, springs: Array, count: int) -> None:
    """Fill in what springs bear before and after, and its rate; shrunk is 1/rho, 0 in loading."""
    for j in range(count):
        springs[of.LIMIT, j] = springs[of.NEXT, j]
        springs[of.RATE, j] = (1.0 - springs[of.SOFTER, j]) * now[at.SPEED]
        w = new[at.DEPTH] - springs[of.S, j]
        if shrunk > 0.0:
            springs[of.NEXT, j] = (new[at.EDGE] ** 2 - springs[of.S, j]) * shrunk
        else:
            springs[of.NEXT, j], slope = capped(y, w)
            springs[of.SOFTER, j] = 1.0 - slope


@kernel
def capped(y: float, w: float) -> tuple[float, float]:
    """Return Abel's transform of Hertz's pressure, cut at that of the radius y, and its slope."""
    if w <= y * y:
        return w, 1.0
    slope = np.arcsin(y / np.sqrt(w)) * 2.0 / np.pi
    return 2.0 / np.pi * y * np.sqrt(w - y * y) + w * slope, slope


@kernel
def turn(now: Array, springs: Array, count: int, state: Array, ratio: float) -> None:
    """Put springs to the elastic pressure of unloading at once, which may cut springs in shear."""
    shrunk = now[at.LOAD] / now[at.EDGE] ** 3
    state[at.FORCE], state[at.FORCE_ACROSS] = 0.0, 0.0
    now[at.PACE] = now[at.EDGE] ** -2.5  # 1/(rho e), as the edge recedes faster on a flatter sphere
    for j in range(count):
        most = (now[at.EDGE] ** 2 - springs[of.S, j]) * shrunk
        springs[of.NEXT, j], springs[of.SOFTER, j] = most, 0.0
        of.cut(springs, j, most, ratio)
        state[at.FORCE] += springs[of.WEIGHT, j] * springs[of.U, j]
        state[at.FORCE_ACROSS] += springs[of.WEIGHT, j] * springs[of.U_ACROSS, j]


@kernel
def stored(edge: float, load: float) -> float:
    """Return the energy that unloading gives back, P (d - d_p) = P^2/b, of m_n V_1^2/2."""
    return load * load / edge if edge > 0.0 else 0.0


@kernel
def come_to(y: float, numbers: Array) -> None:
    """Write what the normal motion comes to, in closed form.

    After yield P = peak sin(omega t + phase), as P'' = -(15/8) y P; unloading is Hertz's motion on
    a sphere of the radius R_p, v^2 = sqrt(rho) (d - d_p)^(5/2).
    """
    v, omega = np.sqrt(1.0 - y**5), np.sqrt(1.875 * y)
    peak, phase = np.sqrt(1.2 * y - 0.2 * y**6), np.arctan2(y**3, 1.5 * y * v / omega)
    deepest = y * y + (peak - y**3) / (1.5 * y)
    elastic = peak / np.sqrt(deepest)  # d - d_p at the turning point, d/rho
    e = np.sqrt(peak * elastic)
    turned = hertz.time(y * y, v) + (0.5 * np.pi - phase) / omega
    numbers[layout.RESTITUTION], numbers[layout.LOST] = e, 1.0 - e * e
    numbers[layout.TIME] = turned + 0.5 * hertz.DURATION * elastic / e
    numbers[layout.PENETRATION], numbers[layout.DEEPEST] = deepest - elastic, deepest
    numbers[layout.STRONGEST], numbers[layout.WIDEST] = peak, np.sqrt(deepest)
