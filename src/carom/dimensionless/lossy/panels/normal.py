"""Normal motion with losses, in units of the elastic impact: d_max, V_1, d_max/V_1, P_max.

The clock d(tau) = dt/(2 b), with b^2 = s at the edge of the contact, makes all of it analytic:

- Kelvin & Voigt: springs D - s, D = d + alpha v, no tension. While loading the edge is where the
  surfaces meet, b^2 = d; b' = v, v' = -(5/2) b^2 (b^2 + (3/2) alpha v). While unloading it is where
  the springs let go, b^2 = D; b' = v - (5/4) alpha b^3, v' = -(5/2) b^4.
- Elastic-plastic (Thornton 1997): P rises linearly from yield on, and falls as the load on a sphere
  of a larger radius. The contact is taken for the elastic one that bears the same load, b^3 = P.
"""

from enum import IntEnum
from typing import Any, NamedTuple, Protocol

import numpy as np

from carom.dimensionless.numerics.kernels import kernel
from carom.quantities.refusals import refusal


class Loss(IntEnum):
    """What the impact loses energy to; the parameter that goes with it."""

    NONE = 0
    VISCOUS = 1  # alpha, the loss time in units of d_max/V_1
    PLASTIC = 2  # b at yield, (V_y/V_1)^(2/5)


class Stage(IntEnum):
    """Part of the normal motion that one set of equations rules."""

    LOADING = 0
    YIELDING = 1
    UNLOADING = 2


class ScaleFreeLaw(Protocol):
    """What an impact needs of a law of losses, free of units."""

    def scale_free(self) -> tuple[int, float]:
        """Return the loss and its parameter; ValueError if they depend on the speed."""


def scale_free(losses: Any) -> tuple[int, float]:
    """Return loss and parameter of what is given as a law of losses, or raise InputError."""
    return checked_law(losses, "scale_free")()  # type: ignore[no-any-return]


def checked_law(losses: Any, method: str) -> Any:
    """Return a method of a law of losses, or raise InputError if this is none."""
    found = getattr(losses, method, None)
    if isinstance(losses, type) or not callable(found):
        allowed = "must be a law of losses, e.g. carom.KelvinVoigt(restitution=0.9)"
        raise refusal("losses", losses, allowed)
    return found


class Motion(NamedTuple):
    """What rules the motion at a time: the loss, its stage and its numbers; and chi.

    `growth` is (R_p/R*)^(1/3), by which the edge of a yielded contact recedes faster than v.
    """

    loss: int
    stage: int
    parameter: float
    growth: float
    chi: float


@kernel
def is_shifted(motion: Motion) -> bool:
    """Tell whether the limit is ahead of the edge: viscous springs while loading."""
    return motion.loss == Loss.VISCOUS.value and motion.stage != Stage.UNLOADING.value


@kernel
def edge_rate(motion: Motion, b: float, v: float) -> float:
    """Return b', which is the speed of the edge, d(b^2)/dt."""
    if motion.loss == Loss.PLASTIC.value:
        return (
            motion.parameter * v / b if motion.stage == Stage.YIELDING.value else motion.growth * v
        )
    if motion.loss == Loss.VISCOUS.value and motion.stage == Stage.UNLOADING.value:
        return v - 1.25 * motion.parameter * b * b * b
    return v


@kernel
def speed_rate(motion: Motion, b: float, v: float) -> float:
    """Return v' = -(5/2) b P/P_max."""
    return -2.5 * b * normal_force(motion, b, v)


@kernel
def normal_force(motion: Motion, b: float, v: float) -> float:
    """Return P/P_max, the integral of (3/2) (D - s) over the contact."""
    if is_shifted(motion):
        return b * (b * b + 1.5 * motion.parameter * v)
    return b * b * b


@kernel
def limit(motion: Motion, b: float, v: float) -> float:
    """Return D: springs at s bear D - s."""
    return b * b + motion.parameter * v if is_shifted(motion) else b * b


@kernel
def limit_rate(motion: Motion, b: float, v: float) -> float:
    """Return dD/dt."""
    if is_shifted(motion):
        return v - 1.25 * motion.parameter * b * (b * b + 1.5 * motion.parameter * v)
    return edge_rate(motion, b, v)


@kernel
def stored(motion: Motion, b: float, d: float) -> float:
    """Return the elastic energy that is left in the normal springs, in units of m_n V_1^2/2."""
    if motion.loss == Loss.PLASTIC.value:
        growth = motion.growth
        if motion.stage == Stage.YIELDING.value:
            growth = released_growth(motion, b)
        return b**5 / growth
    return b * (1.875 * d * d - b * b * (1.25 * d - 0.375 * b * b))


@kernel
def loss_rate(motion: Motion, b: float, v: float) -> float:
    """Return the rate of viscous loss by the clock, in dashpots and in springs that let go."""
    rate = 7.5 * motion.parameter * v * v * b * b
    if motion.stage == Stage.UNLOADING.value:
        let_go = motion.parameter * v
        rate -= 1.875 * let_go * let_go * edge_rate(motion, b, v)
    return rate


@kernel
def released_growth(motion: Motion, b: float) -> float:
    """Return (R_p/R*)^(1/3) at the turning point, where the load is b^3.

    R_p/R* = d^(3/2)/P, d and P those of the yielding sphere (Thornton 1997).
    """
    if motion.loss != Loss.PLASTIC.value or b <= motion.parameter:
        return 1.0
    y, load = motion.parameter, b * b * b
    d = y * y + (load - y * y * y) / (1.5 * y)
    return float(np.sqrt(d) / b)
