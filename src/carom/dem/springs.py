"""Contact laws of DEM codes: springs of constant stiffness, Mindlin's, and those that soften.

Codes with Hertz's normal force and Mindlin's tangential stiffness use increments dF = k_t dU with
k_t = 2 G* a at a contact radius a. They differ in their damping, and in how the force F changes
when a becomes a', which is F (a'/a)^n.
"""

from dataclasses import dataclass
from math import sqrt
from typing import ClassVar

from carom.dem import damping as damped
from carom.dem.base import ContactLaw
from carom.dem.coefficients import MINDLIN, SPRING, Coefficients, Shear, hertzian, linear
from carom.quantities.refusals import one_of

KEPT = {  # powers n, while the contact grows and while it shrinks
    "mindlin": (1.0, 1.0),
    "mindlin/force": (0.0, 0.0),
    "mindlin_rescale": (1.0, 2.0),
    "mindlin_rescale/force": (0.0, 1.0),
}


@dataclass(frozen=True)
class LammpsMindlin(ContactLaw):
    """The four variants of Hertz-Mindlin in LAMMPS, `pair_style granular`.

        F_t = k_t(a) U in mindlin, dF_t = k_t(a) dU in mindlin/force
        k_t = 2 G* a, |F_t| <= mu F_n

    In the variants with `_rescale` the stored U or F_t shrinks with a while the contact unloads
    (Thornton, Cummins & Cleary 2013). LAMMPS writes k_t as 8 G_eff a; the limit mu F_n includes the
    damping. Without rescaling an impact may gain energy, up to 13 % for some chi from 1.5 to 1.9.
    With tangential damping the displacement is singular at the first touch, and near psi_1 = 1 a
    code needs more than a million steps to reach the rebound of this law.

    Parameters
    ----------
    variant : str
        "mindlin", "mindlin/force", "mindlin_rescale" or "mindlin_rescale/force".
    stiffness, restitution
    damping : str
        Damping model of LAMMPS, "coeff_restitution" or "tsuji".
    tangential_damping

    Examples
    --------
    >>> round(carom.dem.LammpsMindlin("mindlin_rescale").rebound(0.75, 1.4412), 3)
    0.441
    """

    name: ClassVar[str] = "LAMMPS"
    source: ClassVar[str] = "LAMMPS documentation, pair_style granular"

    variant: str = "mindlin"
    stiffness: float = 1.0
    restitution: float = 1.0
    damping: str = damped.COEFF_RESTITUTION
    tangential_damping: float = 0.0

    def __post_init__(self) -> None:
        one_of("variant", self.variant, KEPT)
        one_of("damping", self.damping, damped.RULES)
        super().__post_init__()

    def _coefficients(self, chi: float, kappa: float) -> Coefficients:
        loading, unloading = KEPT[self.variant]
        damping = damped.hertz_damping(self.restitution, self.damping)
        return hertzian(
            chi,
            damping,
            stiffness=MINDLIN * self.stiffness,
            kept_loading=loading,
            kept_unloading=unloading,
            shear_damping=self.tangential_damping * damping / kappa,
        )


@dataclass(frozen=True)
class LiggghtsHertz(ContactLaw):
    """The model `hertz` of LIGGGHTS with tangential history, a spring of stored displacement.

        F_t = k_t(a) U, k_t = 2 G* a
        c = 2 beta sqrt((5/6) S m_n), beta = -ln e/sqrt(pi^2 + ln^2 e)

    The damping c has S = 2 E* a in the normal direction and S = k_t in the tangential one. The
    force of the spring alone is limited by mu F_n, and a contact that slides has no damping.

    Parameters
    ----------
    restitution

    Examples
    --------
    >>> elastic = carom.dem.LammpsMindlin("mindlin").rebound(0.75, 1.4412)
    >>> carom.dem.LiggghtsHertz().rebound(0.75, 1.4412) == elastic
    True
    """

    name: ClassVar[str] = "LIGGGHTS hertz"
    source: ClassVar[str] = "LIGGGHTS-PUBLIC documentation, gran model hertz, tangential history"

    restitution: float = 1.0

    def _coefficients(self, chi: float, kappa: float) -> Coefficients:
        damping = damped.hertz_damping(self.restitution)
        return hertzian(
            chi,
            damping,
            kept_loading=1.0,
            kept_unloading=1.0,
            shear_damping=damping * kappa**-0.5,
            limits_damping=False,
        )


@dataclass(frozen=True)
class EdemHertzMindlin(LiggghtsHertz):
    """Hertz-Mindlin (no slip) of EDEM, with the spring and damping of `LiggghtsHertz`.

    The sum of both forces, and not that of the spring alone, is limited by mu F_n.

    Parameters
    ----------
    restitution

    Examples
    --------
    >>> laws = carom.dem.EdemHertzMindlin(restitution=0.9), carom.dem.LiggghtsHertz(restitution=0.9)
    >>> [round(law.rebound(2.0, 1.4412), 3) for law in laws]
    [-0.451, -0.416]
    """

    name: ClassVar[str] = "EDEM Hertz-Mindlin"
    source: ClassVar[str] = "EDEM documentation, Hertz-Mindlin (no slip)"

    def _coefficients(self, chi: float, kappa: float) -> Coefficients:
        return super()._coefficients(chi, kappa)._replace(limits_damping=True)


@dataclass(frozen=True)
class YadeMindlin(ContactLaw):
    """The law Mindlin of YADE with MindlinPhys, which accumulates the force.

        dF_t = k_t(a) dU, k_t = 2 G* a, c = 2 beta sqrt(m_n S)

    The damping c has S = 2 E* a in the normal direction and S = k_t in the tangential one, with
    beta after Thornton, Cummins & Cleary (2013), (B6), for e, `en` and `es` of YADE. The contact
    does not pull, F_n >= 0. The force of the spring alone is limited by mu F_n, and a contact that
    slides has no damping.

    Parameters
    ----------
    restitution

    Examples
    --------
    >>> elastic = carom.dem.LammpsMindlin("mindlin/force").rebound(0.75, 1.4412)
    >>> carom.dem.YadeMindlin().rebound(0.75, 1.4412) == elastic
    True
    """

    name: ClassVar[str] = "YADE Mindlin"
    source: ClassVar[str] = "YADE documentation, Law2_ScGeom_MindlinPhys_Mindlin"

    restitution: float = 1.0

    def _coefficients(self, chi: float, kappa: float) -> Coefficients:
        damping = 2.0 * sqrt(SPRING * MINDLIN) * damped.thornton_damping(self.restitution)
        return hertzian(
            chi, damping, pulls=False, shear_damping=damping * kappa**-0.5, limits_damping=False
        )


@dataclass(frozen=True)
class LinearSpring(ContactLaw):
    """A linear spring and dashpot in each direction, with a slider in the tangential one.

        F_n = k_n d + c_n d', F_t = k_t U + c_t U', |F_t| <= mu F_n

    This law (Cundall & Strack 1979) is the model of LAMMPS (`hooke` with `linear_history`), YADE
    (`CundallStrack`) and, with another limit of the force, of most codes. psi_2 does not depend on
    k_n, only on k_t/k_n.

    Parameters
    ----------
    stiffness_ratio, restitution, tangential_damping

    Examples
    --------
    >>> round(carom.dem.LinearSpring(2 / 7).rebound(3.0, 1.4412), 3)  # the default of many codes
    -2.765
    """

    name: ClassVar[str] = "linear spring"
    source: ClassVar[str] = "Cundall & Strack (1979), Geotechnique 29:47"

    stiffness_ratio: float | None = None
    restitution: float = 1.0
    tangential_damping: float = 0.0

    def _coefficients(self, chi: float, kappa: float) -> Coefficients:
        damping = 2.0 * SPRING * damped.damping_ratio(self.restitution)
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
    restitution, tangential_damping

    Examples
    --------
    >>> round(carom.dem.HertzLinearHistory(0.8).rebound(0.75, 1.4412), 3)
    0.337
    """

    name: ClassVar[str] = "Hertz, linear history"
    source: ClassVar[str] = "LAMMPS documentation, pair_style granular: linear_history"

    stiffness: float = 1.0
    restitution: float = 1.0
    tangential_damping: float = 0.0

    def _coefficients(self, chi: float, kappa: float) -> Coefficients:
        damping = damped.hertz_damping(self.restitution)
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

    def _coefficients(self, chi: float, kappa: float) -> Coefficients:
        return linear(chi, kappa, self.stiffness_ratio, unloading=self.restitution**-2)


@dataclass(frozen=True)
class StrongeLaw(BilinearLaw):
    """Bilinear compliance, a normal spring that is stiffer in unloading and a tangential spring.

        F_n = k_n d while loading, F_n = k_n/e^2 (d - d_p) while unloading
        F_t = k_t U, |F_t| <= mu F_n

    The law is that of Stronge (2000), Impact Mechanics, chapter 5. e is his energetic coefficient,
    and k_t/k_n is 1/eta^2 of the loading contact.

    Parameters
    ----------
    stiffness_ratio, restitution

    Examples
    --------
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
    >>> law = carom.dem.ThorntonLaw()
    >>> round(law.rebound(0.75, 1.4412), 3), round(carom.rebound(0.75, 1.4412), 3)
    (0.178, 0.014)
    """

    name: ClassVar[str] = "Thornton, incremental"
    source: ClassVar[str] = "Thornton & Yin (1991), Powder Technol. 65:153"

    def _coefficients(self, chi: float, kappa: float) -> Coefficients:
        return Coefficients(chi=chi, shear=Shear.MINDLIN_DERESIEWICZ.value)


@dataclass(frozen=True)
class WaltonBraunLaw(BilinearLaw):
    """Walton & Braun's law, with a stiffer normal spring in unloading and softening in shear.

        F_n = K_1 d while loading, F_n = K_1/e^2 (d - d_p) while unloading
        dT = K_0 (1 - (T - T*)/(mu N - T*))^(1/3) dU

    T* is the force at the last turning point, in proportion to N; for dU < 0 the law is mirrored
    (Walton & Braun 1986, J. Rheol. 30:949). k_t/k_n is K_0/K_1.

    Parameters
    ----------
    stiffness_ratio, restitution

    Examples
    --------
    >>> round(carom.dem.WaltonBraunLaw().rebound(0.75, 1.4412), 3)
    -0.078
    """

    name: ClassVar[str] = "Walton & Braun"
    source: ClassVar[str] = "Walton & Braun (1986), J. Rheol. 30:949"

    def _coefficients(self, chi: float, kappa: float) -> Coefficients:
        return super()._coefficients(chi, kappa)._replace(shear=Shear.WALTON_BRAUN.value)
