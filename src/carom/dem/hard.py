"""Impacts without duration, with rigid Coulomb friction or Walton's parameters."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from carom.dem.base import CodeLaw
from carom.dimensionless.law import Codes, status_of
from carom.quantities.arrays import Array
from carom.quantities.units import within


@dataclass(frozen=True)
class HardSphere(CodeLaw):
    """Rigid spheres, which slide or keep a fixed fraction of the tangential velocity.

        psi_2 = psi_1 - min(2 chi (1 + e), (1 + beta_0) psi_1) for psi_1 >= 0

    With beta_0 = 0 this is rigid Coulomb friction (Routh 1891), otherwise the law with Walton's
    three parameters (Foerster et al. 1994, (11)-(13)), that of `carom.laws.WaltonLaw` in psi.

    Parameters
    ----------
    tangential_restitution : float
        Tangential restitution beta_0 = -psi_2/psi_1 without sliding, from -1 to 1.
    restitution

    Examples
    --------
    >>> carom.dem.HardSphere(0.4).rebound([1.0, 10.0], 1.5)
    array([-0.4,  4. ])
    """

    name: ClassVar[str] = "hard sphere"
    source: ClassVar[str] = (
        "Walton (1993); Foerster, Louge, Chang & Allia (1994), Phys. Fluids 6:1108"
    )

    tangential_restitution: float = 0.0
    restitution: float = 1.0

    def __post_init__(self) -> None:
        super().__post_init__()
        beta = within("tangential_restitution", self.tangential_restitution, -1.0, 1.0, "1")
        object.__setattr__(self, "tangential_restitution", beta)

    def _solved(
        self, psi: Array, chi: Array, kappa: Array, steps: int | None, threads: int | None
    ) -> tuple[Array, Codes]:
        status = status_of(psi, chi, kappa, self._largest_chi)
        with np.errstate(over="ignore", invalid="ignore"):
            most = 2.0 * chi * (1.0 + self.restitution)
            lost = np.minimum(most, (1.0 + self.tangential_restitution) * np.abs(psi))
            return np.where(status, np.nan, psi - np.copysign(lost, psi)), status
