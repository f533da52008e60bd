"""What an impact loses energy to, and what it then comes to, free of units."""

from enum import IntEnum
from typing import Any, NamedTuple, Protocol, TypeVar, runtime_checkable

import numpy as np
from numpy.typing import NDArray

from carom.dimensionless.elastic.phases import Status
from carom.dimensionless.lossy import layout
from carom.dimensionless.numerics.arrays import Array
from carom.dimensionless.numerics.kernels import kernel
from carom.quantities.refusals import refusal

LARGEST_CHI = 1000.0  # beyond, few impacts are solved
Law = TypeVar("Law", bound="ScaleFreeLaw")
LARGEST_PSI = 1e4  # that is solved: at every such chi all slides, and would beyond as well


class Loss(IntEnum):
    """What the impact loses energy to; the parameter that goes with it."""

    VISCOUS = 1  # alpha, the loss time in units of d_max/V_1
    PLASTIC = 2  # b at yield, (V_y/V_1)^(2/5)
    RELAXING = 3  # the relaxation time in units of d_max/V_1, and the extra modulus E_0/E - 1
    PLATE = 4  # lambda, how far a plate gives way (Zener 1941); 0 is an elastic impact
    METAL = 5  # b at yield, as for PLASTIC, and the yield strength over the plane modulus


class LossNumbers(NamedTuple):
    """What the impact loses energy to, in numbers or arrays of them; see Loss."""

    loss: int
    parameter: Any
    extra: Any = 0.0


@runtime_checkable
class ScaleFreeLaw(Protocol):
    """What an impact needs of a law of losses, free of units."""

    def _scale_free(self) -> LossNumbers:
        """Return the loss and its parameters; InputError if they depend on the speed."""


class LossyRebounds(NamedTuple):
    """What impacts with losses come to, in the units of elastic ones; arrays of one shape."""

    psi_out: Array
    restitution: Array
    duration: Array
    max_penetration: Array
    max_force: Array
    max_radius: Array
    max_pressure: Array
    shear_lost: Array
    status: NDArray[np.int8]


def scale_free(losses: ScaleFreeLaw) -> LossNumbers:
    """Return what is given as a law of losses in numbers, or raise InputError."""
    return checked_law(losses)._scale_free()


def checked_law(losses: Law) -> Law:
    """Return a law of losses, or raise InputError if this is none."""
    if isinstance(losses, type) or not isinstance(losses, ScaleFreeLaw):
        allowed = "must be a law of losses, e.g. carom.KelvinVoigt(restitution=0.9)"
        raise refusal("losses", losses, allowed)
    return losses


def named(numbers: Array, loss: int, status: Any) -> LossyRebounds:
    """Return what impacts come to by name, from numbers along a last axis."""
    force, radius = numbers[..., layout.STRONGEST], numbers[..., layout.WIDEST]
    return LossyRebounds(
        psi_out=numbers[..., layout.PSI_OUT],
        restitution=numbers[..., layout.RESTITUTION],
        duration=numbers[..., layout.TIME],
        max_penetration=numbers[..., layout.DEEPEST],
        max_force=force,
        max_radius=radius,
        max_pressure=_largest_pressure(loss, force, radius),
        shear_lost=numbers[..., layout.SHEAR_LOST],
        status=status,
    )


def _largest_pressure(loss: int, force: Array, radius: Array) -> Array:
    """Return Hertz's, of a yielded sphere on its true radius, of a metal cut where it yields."""
    if loss == Loss.PLASTIC:
        return np.asarray(force / radius**2)
    if loss == Loss.METAL:
        share = np.minimum(force / radius**3, 1.0)
        return np.asarray(2.0 * radius * np.sin(np.arcsin(share) / 3.0))
    return np.asarray(np.cbrt(force))


@kernel
def keep_energy(speed: float, numbers: Array) -> None:
    """Cut errors by which friction would give energy: |psi_2| <= |psi_1|, and the shear loss."""
    out = min(max(numbers[layout.PSI_OUT], -speed), speed)
    numbers[layout.PSI_OUT] = out
    rest = 0.5 * (speed - out) * (speed + out)
    numbers[layout.SHEAR_LOST] = min(numbers[layout.SHEAR_LOST], rest)


@kernel
def why_not(psi: float, chi: float) -> int:
    """Return the status of an impact that cannot be run, SOLVED if it can."""
    if not np.isfinite(psi):
        return Status.PSI_NOT_FINITE.value
    if not (0.0 < chi < np.inf):
        return Status.CHI_NOT_POSITIVE.value
    return Status.TOO_MANY_PHASES.value if chi > LARGEST_CHI else Status.SOLVED.value
