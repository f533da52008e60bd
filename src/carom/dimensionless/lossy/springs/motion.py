"""The normal motion of a marched impact, a step of it, and the inertia of the bodies.

    v' = -(5/4) (P + D v + (3/2) eps . Q),  psi' = -(5/4) (3 chi Q + zeta P)

D v is what a wall takes that gives way. Spheres have eps = zeta = 0; bodies that are struck off
their centre have both. In space psi, Q, eps and zeta are vectors, and chi is a symmetric matrix;
the other direction is across. Springs may be `ratio` times as stiff there, as in an ellipse: then
psi = kappa V/(mu V_1) has the kappa of each direction, and mixed of psi across is that of psi times
the ratio.

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
# The tangential state: psi, U, Q, rate at which shear loses energy, and what it lost; the first
# three across.
PSI, MOVED, FORCE, LOSING, LOST, PSI_ACROSS, MOVED_ACROSS, FORCE_ACROSS = range(8)
STATE = 8


class Inertia(NamedTuple):
    """The inverse mass at the contact: chi, coupling of both motions, the same `across`, if any."""

    chi: float
    eps: float = 0.0
    zeta: float = 0.0
    across: float = 0.0  # chi across
    mixed: float = 0.0  # between both directions
    eps_across: float = 0.0
    zeta_across: float = 0.0
    ratio: float = 1.0  # of the stiffness across to that along


class Solid(NamedTuple):
    """What the contact is of, in numbers; see `Loss`."""

    loss: int
    parameter: float
    extra: float = 0.0  # by which springs relax, in shear as in compression
    strain: float = 0.0  # of a metal at yield


AT_ONCE = 1e-12  # relaxation time of a solid that is as viscous as Kelvin & Voigt's
ELASTIC = Solid(Loss.PLATE.value, 0.0)


@kernel
def made_of(loss: int, parameter: float, extra: float) -> Solid:
    """Return a solid from its loss and both numbers; of most kinds the second means nothing."""
    if loss == Loss.METAL.value:
        return Solid(loss, parameter, 0.0, extra)
    if loss == Loss.VISCOUS.value:
        return Solid(loss, AT_ONCE, parameter / AT_ONCE, 0.0)
    return Solid(loss, parameter, extra if loss == Loss.RELAXING.value else 0.0, 0.0)


@kernel
def viscosity(solid: Solid) -> float:
    """Return what a spring bears over the rate of its change, where it bears that at once."""
    return float(solid.parameter * solid.extra) if solid.loss == Loss.VISCOUS.value else 0.0


@kernel
def copy(motion: Array, to: Array) -> None:
    """Copy a motion; an assignment of arrays would allocate."""
    for i in range(MOTION):
        to[i] = motion[i]


@kernel
def is_central(inertia: Inertia) -> bool:
    """Tell whether the normal motion is that of bodies that are struck through their centres."""
    i = inertia
    return bool(i.eps == 0.0 == i.zeta and i.eps_across == 0.0 == i.zeta_across)


@kernel
def turned(inertia: Inertia) -> Inertia:
    """Return the inertia in directions that are turned by half a circle."""
    i = inertia
    aside = -i.eps_across, -i.zeta_across
    return Inertia(i.chi, -i.eps, -i.zeta, i.across, i.mixed, aside[0], aside[1], i.ratio)


@kernel
def slowing(inertia: Inertia, load: float, state: Array) -> float:
    """Return -v' of what the contact bears."""
    pull = inertia.eps * state[FORCE] + inertia.eps_across * state[FORCE_ACROSS]
    return float(1.25 * (load + 1.5 * pull))


@kernel
def braking(inertia: Inertia, load: float, state: Array) -> tuple[float, float]:
    """Return -psi' of what the contact bears, and that across."""
    force, across = state[FORCE], state[FORCE_ACROSS]
    along = 3.0 * inertia.chi * force + 3.0 * inertia.mixed * across + inertia.zeta * load
    aside = 3.0 * inertia.ratio * inertia.mixed * force + 3.0 * inertia.across * across
    return 1.25 * along, 1.25 * (aside + inertia.zeta_across * load)


@kernel
def drift(inertia: Inertia, h: float, now: Array, state: Array, new: Array) -> float:
    """Fill in time, depth and speed after a step; return its share, below 1 if the bodies turn."""
    v, b, part = now[SPEED], now[EDGE], 1.0
    rate = slowing(inertia, now[LOAD], state) + 1.25 * now[DRAG] * v
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
def settle(inertia: Inertia, now: Array, new: Array, before: float, state: Array) -> None:
    """Fill in the speed after a step, from how much the contact slowed it before, and after."""
    half = 0.5 * (new[TIME] - now[TIME])
    both = before + 1.25 * now[DRAG] * now[SPEED] + slowing(inertia, new[LOAD], state)
    new[SPEED] = (now[SPEED] - half * both) / (1.0 + 1.25 * half * new[DRAG])
