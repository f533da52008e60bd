"""Laws after Mindlin & Deresiewicz, which soften as slip spreads from the edge."""

from dataclasses import dataclass
from typing import ClassVar

from carom.dem.base import ContactLaw
from carom.dem.coefficients import Coefficients, Shear
from carom.dem.springs import BilinearLaw


@dataclass(frozen=True)
class ThorntonLaw(ContactLaw):
    """The law of Mindlin & Deresiewicz (1953) in increments, with Hertz's normal force.

        dT = theta k_t dU +- (1 - theta) mu dN, k_t = 2 G* a
        theta^3 = 1 - T/(mu N) in the first loading
        theta^3 = 1 - (T* - T)/(2 mu N) in unloading
        theta^3 = 1 - (T - T**)/(2 mu N) in reloading
        theta = 1 where k_t |dU| < mu dN

    The turning points move with the load, dT* = mu dN and dT** = -mu dN. They also move in contacts
    that stick, so that impacts of small psi_1 may gain energy. Whether theta = 1 is decided at each
    step; if it were kept until sum k_t |dU| > sum mu dN, psi_2 would be about 0.01 further off.

    Examples
    --------
    >>> import carom
    >>> law = carom.dem.ThorntonLaw()
    >>> round(law.rebound(0.75, 1.4412), 3), round(carom.rebound(0.75, 1.4412), 3)
    (0.178, 0.014)
    """

    name: ClassVar[str] = "Thornton, incremental"
    source: ClassVar[str] = "Thornton & Yin (1991), Powder Technol. 65:153"

    def coefficients(self, chi: float, kappa: float) -> Coefficients:
        """Return the law as numbers in the units of Hertz's impact."""
        return Coefficients(chi=chi, shear=Shear.MINDLIN_DERESIEWICZ.value)


@dataclass(frozen=True)
class WaltonBraunLaw(BilinearLaw):
    """Walton & Braun's law, with a stiffer normal spring in unloading and softening in shear.

        F_n = K_1 d while loading, F_n = K_1/e^2 (d - d_p) while unloading
        dT = K_0 (1 - (T - T*)/(mu N - T*))^(1/3) dU

    T* is the force at the last turning point, in proportion to N; for dU < 0 the law is mirrored
    (Walton & Braun 1986, J. Rheol. 30:949).

    Parameters
    ----------
    stiffness_ratio : float, optional
        K_0/K_1, positive; by default kappa = G*/E*.
    restitution : float
        Coefficient of restitution e, above 0 and at most 1.

    Raises
    ------
    InputError
        If a parameter is out of range.

    Examples
    --------
    >>> import carom
    >>> round(carom.dem.WaltonBraunLaw().rebound(0.75, 1.4412), 3)
    -0.078
    """

    name: ClassVar[str] = "Walton & Braun"
    source: ClassVar[str] = "Walton & Braun (1986), J. Rheol. 30:949"

    def coefficients(self, chi: float, kappa: float) -> Coefficients:
        """Return the law as numbers in the units of Hertz's impact."""
        return super().coefficients(chi, kappa)._replace(shear=Shear.WALTON_BRAUN.value)
