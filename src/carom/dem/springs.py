"""Laws whose tangential spring has a constant stiffness, or softens as slip spreads."""

from dataclasses import dataclass
from typing import ClassVar

from carom.dem.base import ContactLaw
from carom.dem.coefficients import MINDLIN, SPRING, Coefficients, Shear, hertzian, linear
from carom.dem.damping import damping_ratio, hertz_damping


@dataclass(frozen=True)
class LinearSpring(ContactLaw):
    """A linear spring and dashpot in each direction, with a slider in the tangential one.

        F_n = k_n d + c_n d', F_t = k_t U + c_t U', |F_t| <= mu F_n

    This law (Cundall & Strack 1979) is the model of LAMMPS (`hooke` with `linear_history`), YADE
    (`CundallStrack`) and, with another limit of the force, of most codes. psi_2 does not depend on
    k_n, only on k_t/k_n.

    Parameters
    ----------
    stiffness_ratio : float, optional
        k_t/k_n, positive; by default kappa = G*/E* of elastic bodies (Mindlin 1949).
    restitution : float
        Normal coefficient of restitution e, above 0 and at most 1, which sets the dashpot.
    tangential_damping : float
        c_t/c_n, zero or positive.

    Raises
    ------
    InputError
        If a parameter is out of range.

    Examples
    --------
    >>> import carom
    >>> round(carom.dem.LinearSpring(2 / 7).rebound(3.0, 1.4412), 3)  # the default of many codes
    -2.765
    """

    name: ClassVar[str] = "linear spring"
    source: ClassVar[str] = "Cundall & Strack (1979), Geotechnique 29:47"

    stiffness_ratio: float | None = None
    restitution: float = 1.0
    tangential_damping: float = 0.0

    def coefficients(self, chi: float, kappa: float) -> Coefficients:
        """Return the law as numbers in the units of Hertz's impact."""
        damping = 2.0 * SPRING * damping_ratio(self.restitution)
        shear_damping = self.tangential_damping * damping / kappa
        return linear(
            chi, kappa, self.stiffness_ratio, normal_damping=damping, shear_damping=shear_damping
        )


@dataclass(frozen=True)
class HertzLinearHistory(ContactLaw):
    """Hertz's normal force beside a tangential spring of constant stiffness.

        F_n = (4/3) E* sqrt(R*) d^(3/2), F_t = k_t U, |F_t| <= mu F_n

    This is `pair_style granular` of LAMMPS with `hertz` and `linear_history`.

    Parameters
    ----------
    stiffness : float
        k_t in units of 2 G* a_max, the stiffness of the largest contact (Mindlin 1949), positive.
    restitution, tangential_damping : float
        The damping, as for `LammpsMindlin`.

    Raises
    ------
    InputError
        If a parameter is out of range.

    Examples
    --------
    >>> import carom
    >>> round(carom.dem.HertzLinearHistory(0.8).rebound(0.75, 1.4412), 3)
    0.337
    """

    name: ClassVar[str] = "Hertz, linear history"
    source: ClassVar[str] = "LAMMPS documentation, pair_style granular: linear_history"

    stiffness: float = 1.0
    restitution: float = 1.0
    tangential_damping: float = 0.0

    def coefficients(self, chi: float, kappa: float) -> Coefficients:
        """Return the law as numbers in the units of Hertz's impact."""
        damping = hertz_damping(self.restitution)
        return hertzian(
            chi,
            damping,
            stiffness=MINDLIN * self.stiffness,
            stiffness_power=0.0,
            shear_damping=self.tangential_damping * damping / kappa,
        )


@dataclass(frozen=True)
class BilinearLaw(ContactLaw):
    """A normal spring that unloads stiffer, by 1/e^2, and a linear tangential one beside it."""

    stiffness_ratio: float | None = None
    restitution: float = 1.0

    def coefficients(self, chi: float, kappa: float) -> Coefficients:
        """Return the law as numbers in the units of Hertz's impact."""
        return linear(chi, kappa, self.stiffness_ratio, unloading=self.restitution**-2)


@dataclass(frozen=True)
class StrongeLaw(BilinearLaw):
    """Bilinear compliance, a normal spring that is stiffer in unloading and a tangential spring.

        F_n = k_n d while loading, F_n = k_n/e^2 (d - d_p) while unloading
        F_t = k_t U, |F_t| <= mu F_n

    The law is that of Stronge (2000), Impact Mechanics, chapter 5.

    Parameters
    ----------
    stiffness_ratio : float, optional
        k_t/k_n = 1/eta^2 of the loading contact; by default kappa = G*/E*.
    restitution : float
        Energetic coefficient of restitution e, above 0 and at most 1.

    Raises
    ------
    InputError
        If a parameter is out of range.

    Examples
    --------
    >>> import carom
    >>> carom.dem.StrongeLaw().rebound(1.0, 1.44) == carom.dem.LinearSpring().rebound(1.0, 1.44)
    True
    """

    name: ClassVar[str] = "Stronge, bilinear"
    source: ClassVar[str] = "Stronge (2000), Impact Mechanics, chapter 5"


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
