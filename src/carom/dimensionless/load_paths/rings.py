"""Springs in two directions, held by friction where it acts: at every radius of the contact.

Springs at x, s = x^2, bear q, and their slopes g = -dq/ds make the traction

    tau(r) = int_r^b g d sqrt(x^2 - r^2),    |tau(r)| <= p(r) = sqrt(b^2 - r^2)

(Barber 1979, (6), in either direction). In a small step all q follow the bodies, and then go to the
nearest q, by elastic energy, that Coulomb's law allows (Moreau 1977, J. Differ. Equations 26:347).
On a line that is the law of springs, |q| <= d - s, of `memory`. Units as there.
"""

from functools import lru_cache
from typing import NamedTuple

import numpy as np

from carom.dimensionless.numerics.arrays import Array, Matrix, Vector
from carom.dimensionless.numerics.kernels import entry_point

SPRINGS = 64
SWEEPS = 2000
SETTLED = 1e-10  # of the radius: the last change of a traction
KEPT = 256  # edges whose rings are kept
TINY = 1e-300


class Rings(NamedTuple):
    """Springs and the rings at their places within an edge b."""

    squares: Array  # s
    weights: Array  # of springs in an integral over x
    limits: Array  # p of the rings
    slopes: Array  # tau = slopes q
    reach: Array  # q = reach tau
    compliance: Array  # of the rings: reach' weights reach


@lru_cache(maxsize=KEPT)
def rings_within(h: float, edge: float) -> Rings:
    """Return the springs at x = k h within an edge; between them q is linear in s."""
    x = np.arange(SPRINGS, dtype=np.float64) * h
    x = x[x < edge]
    ends, inner = np.append(x[1:], edge), x[:, None]
    far = np.sqrt(np.maximum(ends**2 - inner**2, 0.0))
    near = np.sqrt(np.maximum(x**2 - inner**2, 0.0))
    fall = (np.eye(x.size) - np.eye(x.size, k=1)) / (ends**2 - x**2)[:, None]
    slopes = np.triu(far - near) @ fall
    reach = np.asarray(np.linalg.inv(slopes), np.float64)
    weights = (ends - x) * (2.0 * ends + x) / (3.0 * (ends + x))
    weights[1:] += (ends - x - weights)[:-1]
    compliance = reach.T @ (weights[:, None] * reach)
    return Rings(x**2, weights, far[:, -1].copy(), slopes, reach, compliance)


@entry_point()
def relax(
    compliance: Matrix, given: Matrix, limits: Vector, traction: Matrix, settled: float
) -> int:
    """Bring tractions to compliance tau = given, or to their limits; return the sweeps it took.

    Ring by ring the energy falls (projected Gauss-Seidel).
    """
    for sweep in range(SWEEPS):
        change = 0.0
        for k in range(limits.size):
            x, y = given[k, 0], given[k, 1]
            for j in range(limits.size):
                x -= compliance[k, j] * traction[j, 0]
                y -= compliance[k, j] * traction[j, 1]
            x = traction[k, 0] + x / compliance[k, k]
            y = traction[k, 1] + y / compliance[k, k]
            size = np.hypot(x, y)
            if size > limits[k]:
                x, y = x * limits[k] / size, y * limits[k] / size
            change = max(change, abs(x - traction[k, 0]), abs(y - traction[k, 1]))
            traction[k, 0], traction[k, 1] = x, y
        if change <= settled:
            return sweep + 1
    return SWEEPS


def cut(vectors: Array, most: Array) -> Array:
    """Return vectors cut back to lengths."""
    size = np.hypot(vectors[:, 0], vectors[:, 1])
    return np.asarray((most / np.maximum(size, np.maximum(most, TINY)))[:, None] * vectors)


def held(now: Rings, springs: Array) -> Array:
    """Return the traction of the nearest springs that Coulomb's law allows."""
    edge = now.limits[0]
    traction = cut(now.slopes @ cut(springs, edge**2 - now.squares), now.limits)
    given = now.reach.T @ (now.weights[:, None] * springs)
    relax(now.compliance, given, now.limits, traction, SETTLED * edge)
    return traction
