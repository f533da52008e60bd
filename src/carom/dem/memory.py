"""The exact contact law in time steps, by springs that remember their slip."""

from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from carom.dem import lattice
from carom.dem.base import ContactLaw
from carom.quantities.arrays import Array
from carom.quantities.refusals import flag, refusal, refuse
from carom.quantities.units import counted

FEWEST_SPRINGS, MOST_SPRINGS = 8, 4096
LOADS = 6  # numbers that a kernel wants for forces and velocities


def read_springs(name: str, value: Any) -> int:
    """Return a number of springs, or raise InputError."""
    springs = counted(name, value, FEWEST_SPRINGS, MOST_SPRINGS)
    refuse(springs % 4 and refusal(name, value, "must be a multiple of 4, e.g. 16, 32 or 64"))
    return springs


@dataclass(frozen=True)
class ExactContactLaw(ContactLaw):
    """The exact contact law in time steps, by springs that remember their slip.

        F_t = 2 E* mu int_0^b q dx, |q| <= d - s, s = x^2/R*

    The springs follow Barber (1979) and the method of dimensionality reduction (Popov & Hess 2015).
    The law becomes exact, with second order, for many springs and small steps. With a restitution
    the bodies are Kelvin-Voigt solids; impacts whose steps are too long for that are not solved. In
    C++ the law is in `carom/contact.hpp`, in the folder that
    `carom.get_include()` returns.

    Parameters
    ----------
    springs : int
        Number of springs, a multiple of 4 from 8 to 4096. In small steps the error of psi_2 is at
        most 0.4/N^2 with N springs for chi up to 2.5 (0.001 with 16 for solid spheres, whose chi
        is from 1.17 to 1.75), and at most 4/N^2 for chi up to 10.
    restitution
    viscous_shear : bool
        Whether shear loses energy, too, as in a solid. If not, Coulomb's law holds for the whole
        contact but not at every point.

    Examples
    --------
    >>> law = carom.dem.ExactContactLaw(springs=16)
    >>> round(law.rebound(1.5, 1.4412, steps=200), 3), round(carom.rebound(1.5, 1.4412), 3)
    (-0.428, -0.428)
    """

    name: ClassVar[str] = "exact, by springs"
    source: ClassVar[str] = "Barber (1979); Popov & Hess (2015), method of dimensionality reduction"

    _default_steps: ClassVar[int | None] = 2000  # which cost less than 2e-6 in psi_2
    _most_steps: ClassVar[int] = 2000  # more cannot be compared with a better psi_2

    springs: int = 16
    restitution: float = 1.0
    viscous_shear: bool = True

    def __post_init__(self) -> None:
        super().__post_init__()
        object.__setattr__(self, "springs", read_springs("springs", self.springs))
        object.__setattr__(self, "viscous_shear", flag("viscous_shear", self.viscous_shear))

    def _stepped(
        self, psi: float, chi: float, kappa: float, steps: int, record: Array
    ) -> tuple[int, float]:
        alpha = 0.0
        if self.restitution < 1.0:
            from carom.dimensionless.lossy.viscoelastic.normal import viscous_loss

            alpha = viscous_loss(self.restitution)
        shear_alpha = alpha if self.viscous_shear else 0.0
        memory, loads = np.empty(lattice.places(self.springs)), np.empty(LOADS)
        springs = self.springs
        return lattice.impact(psi, chi, steps, alpha, shear_alpha, springs, memory, loads, record)
