"""Hertz's contact on a wall that may give way, as a plate does (Zener 1941).

    d'' = -(5/4) (P + lambda P'),  P = d^(3/2),  N = d - s

The sphere pushes the plate's middle at a speed that goes with the force, so that what approaches is
slower than the sphere by (5/4) lambda P. lambda = 0 is a thick wall.
"""

import numpy as np

from carom.dimensionless.lossy.springs import springs as of
from carom.dimensionless.lossy.springs.motion import DEPTH, DRAG, EDGE, LOAD, PACE, SPEED
from carom.dimensionless.numerics.arrays import Array
from carom.dimensionless.numerics.kernels import kernel


@kernel
def press(give: float, now: Array, new: Array, springs: Array, laid: int) -> int:
    """Fill in what the contact and its springs bear after a step; return how many touch."""
    edge = np.sqrt(max(new[DEPTH], 0.0))
    new[EDGE], new[LOAD], new[DRAG] = edge, edge**3, 1.5 * give * edge
    touching = int(np.searchsorted(springs[of.X, :laid], edge))
    for j in range(max(touching, 1)):
        springs[of.LIMIT, j], springs[of.RATE, j] = springs[of.NEXT, j], now[SPEED]
        springs[of.NEXT, j] = new[DEPTH] - springs[of.S, j]
    return touching


@kernel
def turn(give: float, now: Array) -> None:
    """Make steps longer as unloading begins, as a plate that gives way takes longer."""
    now[PACE] = 1.0 + give


@kernel
def stored(depth: float) -> float:
    """Return the energy in compression, of m_n V_1^2/2."""
    return float(max(depth, 0.0) ** 2.5)
