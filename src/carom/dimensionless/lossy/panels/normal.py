"""Normal motion of a viscoelastic impact, in units of the elastic one, d_max, V_1, P_max.

Springs bear D - s, D = d + alpha v, without tension. The clock d(tau) = dt/(2 b), with b^2 = s at
the edge of the contact, makes all of it analytic. While loading the edge is where the surfaces
meet, b^2 = d; b' = v, v' = -(5/2) b^2 (b^2 + (3/2) alpha v). While unloading it is where the
springs let go, b^2 = D; b' = v - (5/4) alpha b^3, v' = -(5/2) b^4.
"""

from enum import IntEnum
from typing import NamedTuple

from carom.dimensionless.numerics.kernels import kernel


class Stage(IntEnum):
    """Part of the normal motion that one set of equations rules."""

    LOADING = 0
    UNLOADING = 1


class Motion(NamedTuple):
    """What rules the motion at a time: its stage, and the numbers of the impact."""

    stage: int
    alpha: float
    chi: float


@kernel
def is_shifted(motion: Motion) -> bool:
    """Tell whether the limit is ahead of the edge: while loading."""
    return motion.stage == Stage.LOADING.value


@kernel
def edge_rate(motion: Motion, b: float, v: float) -> float:
    """Return b', which is the speed of the edge, d(b^2)/dt."""
    return v if is_shifted(motion) else v - 1.25 * motion.alpha * b * b * b


@kernel
def speed_rate(motion: Motion, b: float, v: float) -> float:
    """Return v' = -(5/2) b P/P_max."""
    return -2.5 * b * normal_force(motion, b, v)


@kernel
def normal_force(motion: Motion, b: float, v: float) -> float:
    """Return P/P_max, the integral of (3/2) (D - s) over the contact."""
    if is_shifted(motion):
        return b * (b * b + 1.5 * motion.alpha * v)
    return b * b * b


@kernel
def limit(motion: Motion, b: float, v: float) -> float:
    """Return D: springs at s bear D - s."""
    return b * b + motion.alpha * v if is_shifted(motion) else b * b


@kernel
def limit_rate(motion: Motion, b: float, v: float) -> float:
    """Return dD/dt."""
    if is_shifted(motion):
        return v - 1.25 * motion.alpha * b * (b * b + 1.5 * motion.alpha * v)
    return edge_rate(motion, b, v)


@kernel
def stored(b: float, d: float) -> float:
    """Return the elastic energy that is left in the normal springs, in units of m_n V_1^2/2."""
    return b * (1.875 * d * d - b * b * (1.25 * d - 0.375 * b * b))


@kernel
def loss_rate(motion: Motion, b: float, v: float) -> float:
    """Return the rate of viscous loss by the clock, in dashpots and in springs that let go."""
    rate = 7.5 * motion.alpha * v * v * b * b
    if motion.stage == Stage.UNLOADING.value:
        let_go = motion.alpha * v
        rate -= 1.875 * let_go * let_go * edge_rate(motion, b, v)
    return rate
