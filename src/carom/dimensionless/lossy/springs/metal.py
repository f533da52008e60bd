"""A metal sphere that yields: finite elements (Jackson & Green 2005) while loading, then elastic.

In units of the yield point, w = d/y^2, load P/y^3 and squared edge A = b^2/y^2:

    P/y^3 = w^(3/2) exp(-w^(5/12)/4) + (4 H/C) w (1 - exp(-w^(5/9)/25)), Hertz's w^(3/2) at most
    A = w (w/1.9)^B, B = 0.14 exp(23 Y/E'), Hertz's w up to w = 1.9
    H = 2.84 - 0.92 (1 - cos(pi a/R)), a/R = (pi C/2) (Y/E') sqrt(A), C = 1.6

H is the mean pressure of the fully plastic contact in yield strengths. The pressure is taken to be
Hertz's of the edge, cut at a level that gives the load: P = (3/2) c b^2 - c^3/2, c the radius of an
elastic contact with that level as its largest pressure, so c = 2 b sin(asin(P/b^3)/3). Springs bear
Abel's transform of it. Unloading is elastic, so that all springs bear less by as much as the bodies
part, from the pressure of the turning point; the edge recedes to where they bear nothing.
"""

import numpy as np

from carom.dimensionless.lossy.springs import motion as at, springs as of
from carom.dimensionless.lossy.springs.thornton import capped
from carom.dimensionless.numerics.arrays import Array
from carom.dimensionless.numerics.kernels import kernel

YIELD_PRESSURE = 1.6  # C: largest pressure at first yield, over Y (Johnson 1985, section 6.1)
FLATTENS = 1.9  # w from which the edge is not Hertz's
ROUNDING = 1e-12


@kernel
def widened(w: float, strain: float) -> tuple[float, float]:
    """Return A, and its rate with w."""
    if w <= FLATTENS:
        return w, 1.0
    power = 0.14 * np.exp(23.0 * strain)
    grown = (w / FLATTENS) ** power
    return w * grown, (1.0 + power) * grown


@kernel
def hardness(area: float, wider: float, strain: float) -> tuple[float, float]:
    """Return 4 H/C, and its rate with w; beyond a = R both stay."""
    angle = min(0.5 * np.pi**2 * YIELD_PRESSURE * strain * np.sqrt(area), np.pi)
    hard = 2.84 - 0.92 * (1.0 - np.cos(angle))
    rate = -0.46 * np.sin(angle) * angle * wider / area
    return 4.0 / YIELD_PRESSURE * hard, 4.0 / YIELD_PRESSURE * rate


@kernel
def pressed(y: float, strain: float, depth: float) -> tuple[float, float, float, float]:
    """Return the load and the squared edge at a depth while loading, and both rates with depth."""
    w = depth / (y * y)
    area, wider = widened(w, strain)
    load, steep = w**1.5, 1.5 * np.sqrt(w)
    if w > 1.0:
        hard, rate = hardness(area, wider, strain)
        power, left = w ** (5.0 / 9.0) / 25.0, np.exp(-0.25 * w ** (5.0 / 12.0))
        plastic = -np.expm1(-power)
        yielded = left * load + hard * plastic * w
        if yielded < load:
            steep = left * (steep - 5.0 / 48.0 * w ** (11.0 / 12.0)) + rate * plastic * w
            steep += hard * (plastic + 5.0 / 9.0 * power * np.exp(-power))
            load = yielded
    return y**3 * load, y * y * area, y * steep, wider


@kernel
def level(load: float, edge: float) -> float:
    """Return the largest pressure: that of an elastic contact of the radius returned."""
    elastic = edge**3
    if load >= elastic * (1.0 - ROUNDING):
        return edge
    return float(2.0 * edge * np.sin(np.arcsin(load / elastic) / 3.0))


@kernel
def press(
    y: float, strain: float, now: Array, new: Array, turned: Array, springs: Array, laid: int
) -> int:
    """Fill in what springs bear after a step, return how many touch; `turned` is 0 at first."""
    if turned[at.EDGE] > 0.0:
        parted = turned[at.DEPTH] - new[at.DEPTH]
        for j in range(laid + 1):
            springs[of.LIMIT, j], springs[of.RATE, j] = springs[of.NEXT, j], now[at.SPEED]
            springs[of.NEXT, j] = springs[of.PRESSED, j] - parted
        return int(of.recede(springs, laid, new))
    new[at.LOAD], square, _, _ = pressed(y, strain, new[at.DEPTH])
    new[at.EDGE] = np.sqrt(square)
    bear(y, strain, now, new, springs, laid)
    return laid


@kernel
def bear(y: float, strain: float, now: Array, new: Array, springs: Array, count: int) -> None:
    """Fill in what springs bear before and after a step of the loading, and its rate before."""
    load, square, steep, wider = pressed(y, strain, now[at.DEPTH])
    was, top = level(load, np.sqrt(square)), level(new[at.LOAD], new[at.EDGE])
    rise, flat = 0.0, square - was * was
    if flat > 0.0:
        rise = (steep - 1.5 * was * wider) / (1.5 * flat)
    for j in range(count):
        within = np.sqrt(max(flat - springs[of.S, j], 0.0))
        rate = (1.0 - springs[of.SOFTER, j]) * wider + 4.0 / np.pi * within * rise
        springs[of.RATE, j], springs[of.LIMIT, j] = rate * now[at.SPEED], springs[of.NEXT, j]
        springs[of.NEXT, j], slope = capped(top, new[at.EDGE] ** 2 - springs[of.S, j])
        springs[of.SOFTER, j] = 1.0 - slope


@kernel
def turn(now: Array, springs: Array, count: int) -> None:
    """Remember what springs bear at turning; steps are those in which the centre lets go."""
    for j in range(count + 1):
        springs[of.PRESSED, j] = springs[of.NEXT, j]
    e = np.sqrt(stored(now[at.EDGE], springs, count))
    now[at.PACE] = springs[of.NEXT, 0] / (now[at.EDGE] ** 2 * e)


@kernel
def stored(edge: float, springs: Array, count: int) -> float:
    """Return the energy in springs in compression, of m_n V_1^2/2."""
    total = 0.0
    for j in range(count):
        total += of.weight_of(springs, j, count, edge) * springs[of.NEXT, j] ** 2
    return 1.875 * total
