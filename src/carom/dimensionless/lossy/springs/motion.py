"""The normal motion of a marched impact, a step of it, and the inertia of the bodies.

    v' = -(5/4) (P + D v + (3/2) eps Q),  psi' = -(5/4) (3 chi Q + zeta P)

D v is what a wall takes that gives way. Spheres have eps = zeta = 0; bodies that are struck off
their centre have both. In space the inertia is a matrix of three by three, and psi and Q vectors.

Steps are even in a clock, d(clock) = dt/(2 b), in which the edge grows and recedes at a finite
rate. The first time that the bodies turn, a step ends.
"""

from typing import NamedTuple

from carom.dimensionless.lossy.law import Loss
from carom.dimensionless.numerics.arrays import Array
from carom.dimensionless.numerics.kernels import kernel

# Of the motion at the end of a step; KEPT is what a solid has to remember of its load, PACE by how
# much longer steps are while unloading.
TIME, DEPTH, SPEED, EDGE, LOAD, DRAG, KEPT, PACE = range(8)
MOTION = 8
# The tangential state: psi, U, Q, rate at which shear loses energy, and what it lost.
PSI, MOVED, FORCE, LOSING, LOST = range(5)
STATE = 5


class Inertia(NamedTuple):
    """The inverse mass at the contact: chi, and what couples both motions."""

    chi: float
    eps: float = 0.0
    zeta: float = 0.0


class Solid(NamedTuple):
    """What the contact is of, in numbers; see `Loss`."""

    loss: int
    parameter: float
    extra: float = 0.0


ELASTIC = Solid(Loss.PLATE.value, 0.0, 0.0)


@kernel
def copy(motion: Array, to: Array) -> None:
    """Copy a motion; an assignment of arrays would allocate."""
    for i in range(MOTION):
        to[i] = motion[i]


@kernel
def slowing(inertia: Inertia, load: float, force: float) -> float:
    """Return -v' of what the contact bears."""
    return 1.25 * (load + 1.5 * inertia.eps * force)


@kernel
def braking(inertia: Inertia, load: float, force: float) -> float:
    """Return -psi' of what the contact bears."""
    return 1.25 * (3.0 * inertia.chi * force + inertia.zeta * load)


@kernel
def drift(inertia: Inertia, h: float, now: Array, force: float, new: Array) -> float:
    """Fill in time, depth and, to first order, speed after a step; return which part of it is made.

    That is 1 unless the bodies turn at its end.
    """
    v, b, part = now[SPEED], now[EDGE], 1.0
    rate = slowing(inertia, now[LOAD], force) + 1.25 * now[DRAG] * v
    dt = 2.0 * b * h * now[PACE]
    if v > 0.0:
        dt = h * (2.0 * b + h * max(v - h * b * rate, 0.0))
        if v < dt * rate:
            part = v / (dt * rate)
            dt = v / rate
    new[TIME], new[PACE] = now[TIME] + dt, now[PACE]
    new[DEPTH] = now[DEPTH] + dt * (v - 0.5 * dt * rate)
    new[SPEED] = v - dt * rate
    return part


@kernel
def settle(inertia: Inertia, now: Array, new: Array, force: float, force_end: float) -> None:
    """Fill in the speed after a step, from what the contact bears before and after it."""
    half = 0.5 * (new[TIME] - now[TIME])
    before = slowing(inertia, now[LOAD], force) + 1.25 * now[DRAG] * now[SPEED]
    after = slowing(inertia, new[LOAD], force_end)
    new[SPEED] = (now[SPEED] - half * (before + after)) / (1.0 + 1.25 * half * new[DRAG])
