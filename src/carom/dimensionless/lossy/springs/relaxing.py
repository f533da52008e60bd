"""A standard linear solid in compression, constant Poisson's ratio: its normal motion by springs.

A spring at s = x^2 bears N = d - s + g k, k' = d' - k/theta, from its touch at d = s until N = 0;
then it is let go (no tension). While loading, P = b^3 + g K, K' = (b^3)' - K/theta. Units of the
elastic impact of the relaxed modulus.
"""

import numpy as np

from carom.dimensionless.lossy.springs import springs as of
from carom.dimensionless.lossy.springs.motion import DEPTH, EDGE, KEPT, LOAD, SPEED, TIME
from carom.dimensionless.numerics.arrays import Array
from carom.dimensionless.numerics.kernels import kernel

RESOLVING_STEPS = 2.0  # steps to a relaxation time, below which a rate is that of the whole step


@kernel
def press(g: float, theta: float, now: Array, new: Array, springs: Array, laid: int) -> int:
    """Fill in what the contact and its springs bear after a step; return how many touch."""
    dt = new[TIME] - now[TIME]
    left, part, growing = of.faded(dt, theta)
    if now[SPEED] > 0.0:
        b, edge = now[EDGE], np.sqrt(new[DEPTH])
        change = new[SPEED] * edge - now[SPEED] * b
        new[KEPT] = now[KEPT] * left + (edge**3 - b**3) * part + 1.5 * growing * change
        new[EDGE], new[LOAD] = edge, edge**3 + g * new[KEPT]
        bear(g, theta, now, new, springs, laid)
        return laid
    bear(g, theta, now, new, springs, laid + 1)
    return int(of.recede(springs, laid, new))


@kernel
def bear(g: float, theta: float, now: Array, new: Array, springs: Array, count: int) -> None:
    """Fill in what springs bear before and after a step, and its rate before."""
    dt = new[TIME] - now[TIME]
    left, part, growing = of.faded(dt, theta)
    grown = (new[DEPTH] - now[DEPTH]) * part + growing * (new[SPEED] - now[SPEED])
    for j in range(count):
        springs[of.RATE, j] = (1.0 + g) * now[SPEED] - g * springs[of.PRESSED, j] / theta
        springs[of.PRESSED, j] = springs[of.PRESSED, j] * left + grown
        springs[of.LIMIT, j] = springs[of.NEXT, j]
        springs[of.NEXT, j] = new[DEPTH] - springs[of.S, j] + g * springs[of.PRESSED, j]
    if theta < RESOLVING_STEPS * dt:
        for j in range(count):
            springs[of.RATE, j] = (springs[of.NEXT, j] - springs[of.LIMIT, j]) / dt


@kernel
def stored(g: float, edge: float, springs: Array, count: int) -> float:
    """Return the energy in springs in compression, both branches, of m_n V_1^2/2."""
    total = 0.0
    for j in range(count):
        k = springs[of.PRESSED, j]
        w = springs[of.NEXT, j] - g * k
        total += of.weight_of(springs, j, count, edge) * (w * w + g * k * k)
    return 1.875 * total
