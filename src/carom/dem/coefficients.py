"""A contact law as numbers: what the forces of one impact need, in the units of Hertz's impact.

Lengths are in units of the largest penetration d_max of the elastic impact, times of d_max/V_1,
tangential displacements of mu d_max/kappa, normal forces of the largest one P_max, tangential ones
of mu P_max. Then d'' = -(5/4) f and psi' = -(5/2) chi t for any law. The contact radius is
b = sqrt(d), in units of the largest one.
"""

from enum import IntEnum
from typing import Any, NamedTuple

import numpy as np

from carom.dimensionless.numerics.kernels import kernel

ELASTIC_PULL = 1.25  # d'' = -1.25 f: Johnson (1985), 11.4
SPRING = 0.8  # of a linear contact that is pressed as far as Hertz's by the same energy
MINDLIN = 1.5  # 2 G* a of the widest contact


class Normal(IntEnum):
    """How the elastic part of the normal force grows."""

    HERTZ = 0
    LINEAR = 1


class Shear(IntEnum):
    """How the tangential force remembers."""

    SPRING = 0
    MINDLIN_DERESIEWICZ = 1
    WALTON_BRAUN = 2


class Coefficients(NamedTuple):
    """The numbers of a contact law.

    Normal force: f = elastic(d) + normal_damping b^damping_power v, where the elastic part of a
    linear law is steeper by `unloading` after the turning point.
    Tangential: dt = stiffness b^stiffness_power dU; a spring also scales with the contact, as the
    power `kept_loading` of its radius while it grows and `kept_unloading` while it shrinks; to it
    comes the damping shear_damping b^damping_power psi. It is limited by |f|: with its damping if
    `limits_damping`, else without it; a sliding contact then has no damping.
    """

    chi: float
    normal: int = Normal.HERTZ.value
    unloading: float = 1.0
    normal_damping: float = 0.0
    damping_power: float = 0.0
    pulls: bool = True
    shear: int = Shear.SPRING.value
    stiffness: float = MINDLIN
    stiffness_power: float = 1.0
    kept_loading: float = 0.0
    kept_unloading: float = 0.0
    shear_damping: float = 0.0
    limits_damping: bool = True


def hertzian(chi: float, damping: float, **more: Any) -> Coefficients:
    """Return a law with Hertz's normal force and a damping that grows as the root of the radius."""
    return Coefficients(chi=chi, normal_damping=damping, damping_power=0.5, **more)


def linear(chi: float, kappa: float, ratio: float | None, **more: Any) -> Coefficients:
    """Return a law with springs of constant stiffness, k_t/k_n as given or else kappa."""
    stiffness = SPRING * (ratio or kappa) / kappa
    return Coefficients(
        chi=chi, normal=Normal.LINEAR.value, stiffness=stiffness, stiffness_power=0.0, **more
    )


@kernel
def normal_force(law: Coefficients, peak: float, loading: bool, b: float, v: float) -> float:
    """Return f at contact radius b and speed v; `peak` is the largest penetration."""
    if law.normal == Normal.HERTZ.value:
        f = b * b * b
    elif loading:
        f = SPRING * b * b
    else:
        f = SPRING * (b * b + (law.unloading - 1.0) * (b * b - peak))
    f += law.normal_damping * b**law.damping_power * v
    return float(f) if law.pulls else max(float(f), 0.0)


@kernel
def shear_stiffness(law: Coefficients, b: float) -> float:
    """Return dt/dU of a contact that sticks."""
    return float(law.stiffness * b**law.stiffness_power)


@kernel
def kept(law: Coefficients, loading: bool) -> float:
    """Return the power of the contact radius with which a spring scales."""
    return law.kept_loading if loading else law.kept_unloading


FIRST, BACK, AGAIN = 0, 1, 2  # first loading, unloading, reloading


@kernel
def softening(shear: int, branch: int, t: float, f: float, upper: float, lower: float) -> float:
    """Return theta, 1 to 0, of the stiffness; unloading began at `upper`, reloading at `lower`."""
    if shear == Shear.MINDLIN_DERESIEWICZ.value:
        if branch == FIRST:
            part = t / f
        elif branch == BACK:
            part = (upper - t) / (2.0 * f)
        else:
            part = (t - lower) / (2.0 * f)
    elif branch == BACK:
        part = (upper - t) / (f + upper)
    elif branch == FIRST:
        part = t / f
    else:
        part = (t - lower) / (f - lower)
    return float(np.cbrt(min(1.0, max(0.0, 1.0 - part))))


@kernel
def force_change(
    shear: int, branch: int, theta: float, elastic: float, limit_change: float
) -> float:
    """Return dt for the change `elastic` of a sticking contact while the limit mu F_n changes.

    Thornton & Yin (1991): dT = theta k dU +- (1 - theta) mu dN; theta = 1 while k |dU| < mu dN.
    """
    if shear == Shear.WALTON_BRAUN.value:
        return theta * elastic
    if limit_change > 0.0 and abs(elastic) < limit_change:
        return elastic
    turned = -1.0 if branch == BACK else 1.0
    return theta * elastic + turned * (1.0 - theta) * limit_change
