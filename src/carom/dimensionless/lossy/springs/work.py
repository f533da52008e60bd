"""The arrays in which an impact is marched, and the springs that its contact is cut into."""

from typing import NamedTuple

import numpy as np

from carom.dimensionless.lossy.layout import NUMBERS
from carom.dimensionless.numerics.arrays import Array, Matrix, Vector
from carom.dimensionless.numerics.kernels import kernel

MOST_SPRINGS = 800
PER_SPRING = 2  # steps of the loading to a spring, at most
LONGEST = 5  # whole impact, in times of that many steps

# Columns of the motion, a row at the end of each step.
TIME, DEPTH, SPEED, EDGE, LOAD = range(5)
MOTION = 5
# Columns of the springs: place, its square, weights in the integral over the contact, of which the
# outer part; deflection in shear, and that of the branch that relaxes; the latter in compression,
# or by how much a spring that yields is softer; Coulomb's limit before and after, and its rate.
X, S, WEIGHT, OUTER, U, RELAXING, PRESSED, LIMIT, NEXT, RATE = range(10)
SOFTER = PRESSED
SPRINGS = 10

# The tangential state after a step: psi, U, Q, rate at which shear loses energy, and what it lost.
PSI, MOVED, FORCE, LOSING, LOST = range(5)
STATE = 5


class Arrays(NamedTuple):
    """Arrays that an impact needs, made once and used for many."""

    motion: Matrix  # (steps + 1, MOTION)
    springs: Matrix  # (SPRINGS, springs + 1)
    state: Vector  # (STATE,)
    coarse: Vector  # what the impact comes to with half the springs
    no_rows: Matrix


def new_work() -> Arrays:
    """Return the arrays that an impact needs."""
    return Arrays(
        motion=np.zeros((LONGEST * PER_SPRING * MOST_SPRINGS + 1, MOTION)),
        springs=np.zeros((SPRINGS, MOST_SPRINGS + 1)),
        state=np.zeros(STATE),
        coarse=np.zeros(NUMBERS),
        no_rows=np.zeros((0, 0)),
    )


@kernel
def share(near: float, far: float) -> float:
    """Return the weight at `near` of the integral to `far` of what is linear in x^2."""
    return float(abs(far - near) * (2.0 * far + near) / (3.0 * (far + near)))


@kernel
def lay_springs(motion: Array, per_spring: int, count: int, springs: Array) -> None:
    """Place springs where the edge is after so many steps of the loading each, and weigh them.

    The weights integrate what is linear in x^2 between springs and zero at the edge.
    """
    springs[:] = 0.0
    for j in range(count + 1):
        springs[X, j] = motion[per_spring * j, EDGE]
        springs[S, j] = springs[X, j] ** 2
    for j in range(count):
        here = springs[X, j]
        springs[OUTER, j] = share(here, springs[X, j + 1])
        springs[WEIGHT, j] = springs[OUTER, j]
        if j > 0:
            springs[WEIGHT, j] += share(here, springs[X, j - 1])


@kernel
def rim(springs: Array, last: int, edge: float) -> float:
    """Return by how much the last spring's weight differs, as the contact ends at the edge."""
    return float(share(springs[X, last], edge) - springs[OUTER, last])
