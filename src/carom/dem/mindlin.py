"""Hertz's normal force with Mindlin's tangential stiffness, as in DEM codes.

All of them use increments dF = k_t dU with k_t = 2 G* a at a contact radius a. They differ in their
damping, and in how the force F changes when a becomes a', which is F (a'/a)^n.
"""

from dataclasses import dataclass
from math import sqrt
from typing import ClassVar

from carom.dem.base import ContactLaw
from carom.dem.coefficients import MINDLIN, SPRING, Coefficients, hertzian
from carom.dem.damping import COEFF_RESTITUTION, RULES, hertz_damping, thornton_damping
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
    stiffness : float
        k_t in units of Mindlin's stiffness, positive.
    restitution : float
        Restitution e that the damping is designed for, above 0 and at most 1 (no damping).
    damping : str
        Damping model of LAMMPS, "coeff_restitution" or "tsuji".
    tangential_damping : float
        Tangential damping in units of the normal damping, `x_gamma` of LAMMPS.

    Raises
    ------
    InputError
        If a parameter is out of range.

    Examples
    --------
    >>> import carom
    >>> round(carom.dem.LammpsMindlin("mindlin_rescale").rebound(0.75, 1.4412), 3)
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
    """The model `hertz` of LIGGGHTS with tangential history, a spring of stored displacement.

        F_t = k_t(a) U, k_t = 2 G* a
        c = 2 beta sqrt((5/6) S m_n), beta = -ln e/sqrt(pi^2 + ln^2 e)

    The damping c has S = 2 E* a in the normal direction and S = k_t in the tangential one. The
    force of the spring alone is limited by mu F_n, and a contact that slides has no damping.

    Parameters
    ----------
    restitution : float
        Restitution e that the damping is designed for, above 0 and at most 1.

    Raises
    ------
    InputError
        If the restitution is out of range.

    Examples
    --------
    >>> import carom
    >>> elastic = carom.dem.LammpsMindlin("mindlin").rebound(0.75, 1.4412)
    >>> carom.dem.LiggghtsHertz().rebound(0.75, 1.4412) == elastic
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
    """Hertz-Mindlin (no slip) of EDEM, with the spring and damping of `LiggghtsHertz`.

    The sum of both forces, and not that of the spring alone, is limited by mu F_n.

    Parameters
    ----------
    restitution : float
        Restitution e that the damping is designed for, above 0 and at most 1.

    Raises
    ------
    InputError
        If the restitution is out of range.

    Examples
    --------
    >>> import carom
    >>> laws = carom.dem.EdemHertzMindlin(restitution=0.9), carom.dem.LiggghtsHertz(restitution=0.9)
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
    """The law Mindlin of YADE with MindlinPhys, which accumulates the force.

        dF_t = k_t(a) dU, k_t = 2 G* a, c = 2 beta sqrt(m_n S)

    The damping c has S = 2 E* a in the normal direction and S = k_t in the tangential one, with
    beta after Thornton, Cummins & Cleary (2013), (B6). The contact does not pull, F_n >= 0. The
    force of the spring alone is limited by mu F_n, and a contact that slides has no damping.

    Parameters
    ----------
    restitution : float
        Restitution e that the damping is designed for (`en` and `es` of YADE), in (0, 1].

    Raises
    ------
    InputError
        If the restitution is out of range.

    Examples
    --------
    >>> import carom
    >>> elastic = carom.dem.LammpsMindlin("mindlin/force").rebound(0.75, 1.4412)
    >>> carom.dem.YadeMindlin().rebound(0.75, 1.4412) == elastic
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
