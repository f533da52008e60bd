"""Hertz's normal force with Mindlin's tangential stiffness, as DEM codes have it.

All of them are increments dF = k_t dU with k_t = 2 G* a of a contact of radius a; they differ in
what becomes of the force F that is there when a changes to a', F (a'/a)^n, and in their damping.
"""

from dataclasses import dataclass
from math import sqrt
from typing import ClassVar

from carom.laws.dem.base import ContactLaw
from carom.laws.dem.coefficients import MINDLIN, SPRING, Coefficients, hertzian
from carom.laws.dem.damping import COEFF_RESTITUTION, RULES, hertz_damping, thornton_damping
from carom.quantities.refusals import one_of

KEPT = {  # powers n, while the contact grows and while it shrinks
    "mindlin": (1.0, 1.0),
    "mindlin/force": (0.0, 0.0),
    "mindlin_rescale": (1.0, 2.0),
    "mindlin_rescale/force": (0.0, 1.0),
}


@dataclass(frozen=True)
class LammpsMindlin(ContactLaw):
    """Hertz-Mindlin in the four variants of LAMMPS, pair_style granular.

    mindlin: F_t = k_t(a) U; mindlin/force: the force is accumulated, dF_t = k_t(a) dU; with
    _rescale what is stored, U or F_t, shrinks with a while the contact unloads (Thornton, Cummins &
    Cleary 2013). Here k_t = 2 G* a, which is 8 G_eff a of LAMMPS, and F_t, with its damping, is
    limited by mu F_n. mindlin and mindlin/force may gain energy, up to 13 % for some chi of 1.5 to
    1.9. With tangential damping the displacement is singular at the first touch: near psi_1 = 1 a
    code needs more than a million steps to come to the rebound of this law.

    Parameters
    ----------
    variant : str
        "mindlin", "mindlin/force", "mindlin_rescale" or "mindlin_rescale/force".
    stiffness : float
        k_t in units of Mindlin's, positive.
    restitution : float
        e that the damping is made for, above 0 and at most 1; at 1 there is none.
    damping : str
        "coeff_restitution" or "tsuji", as LAMMPS calls them.
    tangential_damping : float
        x_gamma: tangential damping in units of the normal one.

    Raises
    ------
    InputError
        If a parameter is out of range.

    Examples
    --------
    >>> import carom
    >>> round(carom.LammpsMindlin("mindlin_rescale").rebound(0.75, 1.4412), 3)
    0.441
    """

    name: ClassVar[str] = "LAMMPS"
    source: ClassVar[str] = "LAMMPS documentation, pair_style granular"

    variant: str = "mindlin"
    stiffness: float = 1.0
    restitution: float = 1.0
    damping: str = COEFF_RESTITUTION
    tangential_damping: float = 0.0

    def __post_init__(self) -> None:
        one_of("variant", self.variant, KEPT)
        one_of("damping", self.damping, RULES)
        super().__post_init__()

    def coefficients(self, chi: float, kappa: float) -> Coefficients:
        """Return the law as numbers in the units of Hertz's impact."""
        loading, unloading = KEPT[self.variant]
        damping = hertz_damping(self.restitution, self.damping)
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
    """LIGGGHTS, model hertz with tangential history: a spring of stored displacement.

    F_t = k_t(a) U with k_t = 2 G* a; dampings 2 beta sqrt((5/6) S m_n) with S_n = 2 E* a and
    S_t = k_t, beta = -ln e/sqrt(pi^2 + ln^2 e). The spring alone is limited by mu F_n, and a
    contact that slides has no damping.

    Parameters
    ----------
    restitution : float
        e that the damping is made for, above 0 and at most 1.

    Raises
    ------
    InputError
        If the restitution is out of range.

    Examples
    --------
    >>> import carom
    >>> elastic = carom.LammpsMindlin("mindlin").rebound(0.75, 1.4412)
    >>> carom.LiggghtsHertz().rebound(0.75, 1.4412) == elastic
    True
    """

    name: ClassVar[str] = "LIGGGHTS hertz"
    source: ClassVar[str] = "LIGGGHTS-PUBLIC documentation, gran model hertz, tangential history"

    restitution: float = 1.0

    def coefficients(self, chi: float, kappa: float) -> Coefficients:
        """Return the law as numbers in the units of Hertz's impact."""
        damping = hertz_damping(self.restitution)
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
    """EDEM, Hertz-Mindlin (no slip): F_t = k_t(a) U and dampings as LIGGGHTS, their sum limited.

    Parameters
    ----------
    restitution : float
        e, above 0 and at most 1, which sets the damping.

    Raises
    ------
    InputError
        If it is out of range.

    Examples
    --------
    >>> import carom
    >>> laws = carom.EdemHertzMindlin(restitution=0.9), carom.LiggghtsHertz(restitution=0.9)
    >>> [round(law.rebound(2.0, 1.4412), 3) for law in laws]
    [-0.451, -0.416]
    """

    name: ClassVar[str] = "EDEM Hertz-Mindlin"
    source: ClassVar[str] = "EDEM documentation, Hertz-Mindlin (no slip)"

    def coefficients(self, chi: float, kappa: float) -> Coefficients:
        """Return the law as numbers in the units of Hertz's impact."""
        return super().coefficients(chi, kappa)._replace(limits_damping=True)


@dataclass(frozen=True)
class YadeMindlin(ContactLaw):
    """YADE, MindlinPhys with the law Mindlin: the force is accumulated, dF_t = k_t(a) dU.

    k_t = 2 G* a; dampings 2 beta sqrt(m_n S) with S = 2 E* a or k_t, and beta after Thornton,
    Cummins & Cleary (2013), (B6). The contact does not pull: F_n >= 0. The spring alone is limited
    by mu F_n, and a contact that slides has no damping.

    Parameters
    ----------
    restitution : float
        e that the damping is made for, e_n and e_s of YADE; above 0 and at most 1.

    Raises
    ------
    InputError
        If the restitution is out of range.

    Examples
    --------
    >>> import carom
    >>> elastic = carom.LammpsMindlin("mindlin/force").rebound(0.75, 1.4412)
    >>> carom.YadeMindlin().rebound(0.75, 1.4412) == elastic
    True
    """

    name: ClassVar[str] = "YADE Mindlin"
    source: ClassVar[str] = "YADE documentation, Law2_ScGeom_MindlinPhys_Mindlin"

    restitution: float = 1.0

    def coefficients(self, chi: float, kappa: float) -> Coefficients:
        """Return the law as numbers in the units of Hertz's impact."""
        damping = 2.0 * sqrt(SPRING * MINDLIN) * thornton_damping(self.restitution)
        return hertzian(
            chi, damping, pulls=False, shear_damping=damping * kappa**-0.5, limits_damping=False
        )
