"""Laws by which the normal motion of an impact loses energy, for its argument `losses`."""

from collections.abc import Callable
from dataclasses import dataclass, fields
from functools import partial, reduce
from math import pi
from typing import Any, ClassVar, TypeVar, cast, dataclass_transform

import numpy as np

from carom.bodies.materials import set_fields
from carom.bodies.pairs import Pair, Scales
from carom.dimensionless.lossy.law import Loss, LossNumbers
from carom.dimensionless.lossy.springs.metal import YIELD_PRESSURE
from carom.dimensionless.lossy.viscoelastic.normal import viscous_loss
from carom.io.citations import PLATE, VISCOUS
from carom.quantities.arrays import numbers, sqrt
from carom.quantities.refusals import known_keywords, refusal, refuse
from carom.quantities.units import not_negative, positive, within

SMALLEST_RESTITUTION = 1e-3
STIFFEST = 1000.0  # modulus at once over the relaxed one
ZENER = 1.25**0.4  # his inelasticity parameter over lambda
LARGEST_INELASTICITY = 2.18  # lambda = 2
READERS: dict[str, Callable[[str, Any], float]] = {
    "restitution": partial(within, least=SMALLEST_RESTITUTION, most=1.0),
    "loss_time": not_negative,
    "yield_velocity": positive,
    "flow_stress": positive,
    "modulus_ratio": partial(within, least=1.0, most=STIFFEST),
    "relaxation_time": not_negative,
    "inelasticity": partial(within, least=0.0, most=LARGEST_INELASTICITY),
}
NUMBERS = "must be a number or text with a unit, or an array of them"
OF_SPEED = "it depends on the speed; use carom.impact, or KelvinVoigt(restitution=...)"
NO_STRENGTH = "{}: missing; give it, or a yield_strength of a material"
Law = TypeVar("Law")
LARGEST_STRAIN = 0.05  # Y/E' of a metal, twice that of the strongest glasses


@dataclass_transform(frozen_default=True)
def law(kind: type[Law]) -> type[Law]:
    """Return a law as a frozen record that refuses keywords it does not know."""
    record: Any = dataclass(frozen=True)(kind)
    record.__init__ = known_keywords(record.__init__)
    return cast(type[Law], record)


@dataclass(frozen=True)
class LossLaw:
    """A law of losses: which loss it is, what it depends on, and what to cite."""

    _source: ClassVar[str]  # the key in data/citations.bib
    _alone: ClassVar[str] = ""  # the value that decides the loss at any speed

    def __post_init__(self) -> None:
        """Keep each value as one number that is checked, or an array, checked point by point."""
        for name, value in self._describe().items():
            if value is not None:
                array = numbers(name, value, NUMBERS)
                set_fields(self, **{name: array if array.ndim else READERS[name](name, value)})

    def _loss(self, pair: Pair, scales: Scales) -> LossNumbers:
        """Return which loss it is, and its dimensionless parameters, numbers or arrays."""
        raise NotImplementedError

    def _scale_free(self) -> LossNumbers:
        """Return the same if it does not depend on bodies and speed, else raise InputError."""
        value = getattr(self, self._alone, None)
        allowed = OF_SPEED if value is None else f"give one {self._alone}, or use carom.sweep"
        refuse((value is None or np.ndim(value)) and refusal("losses", self, allowed))
        nothing: Any = None
        return self._loss(nothing, nothing)

    def _describe(self) -> dict[str, Any]:
        """Return the law as plain numbers and words: what was given."""
        return {each.name: getattr(self, each.name) for each in fields(self)}


@law
class KelvinVoigt(LossLaw):
    """A Kelvin-Voigt solid, which loses energy to viscosity in compression and in shear.

        sigma = (1 + tau d/dt) sigma_el
        P/P_max = (3/2) integral of (d + tau v - x^2) dx

    Here sigma_el is the elastic stress, and the integral is taken where the pressure is positive. A
    spring in shear bears u + tau u', at most mu times the load of the spring in compression, and
    Poisson's ratio does not depend on time. Either e is given, which is then the same at all
    speeds, or the retardation time tau, so that 1 - e grows as V_1^(1/5). The value of e alone does
    not determine psi_2, because other solids of the same e lose more or less in shear.

    Parameters
    ----------
    restitution : float or array, optional
        Coefficient of restitution e, from 0.001 to 1; alpha = tau V_1/d_max follows to 1e-12.
    loss_time : float or str, optional
        Retardation time tau in s of both bodies, viscosity over modulus, zero or positive.

    Raises
    ------
    InputError
        If none or both are given, or one is out of range.

    Notes
    -----
    Kuwabara & Kono (1987), Jpn. J. Appl. Phys. 26:1230-1233; Brilliantov et al. (1996), Phys. Rev.
    E 53:5382-5392; without tension as in Schwager & Poeschel (2008), Phys. Rev. E 78:051304.
    Because shear has the same retardation time, Coulomb's law holds at every point of the contact.

    Examples
    --------
    >>> ball = carom.Sphere(radius="5 mm", material="steel")
    >>> pair = carom.Pair(ball, carom.HalfSpace(material="steel"), friction=0.2)
    >>> law = carom.KelvinVoigt(restitution=0.9)
    >>> hit = carom.impact(pair, speed=2.0, angle="30 deg", losses=law)
    >>> round(hit.normal_restitution, 10), round(hit.contact_restitution, 4)
    (0.9, -0.3938)
    """

    _source: ClassVar[str] = VISCOUS  # Kuwabara & Kono (1987)
    _alone: ClassVar[str] = "restitution"
    restitution: Any = None
    loss_time: Any = None

    def __post_init__(self) -> None:
        alone = (self.restitution is None) != (self.loss_time is None)
        refuse(not alone and "restitution: give either restitution or loss_time")
        super().__post_init__()

    def _loss(self, pair: Pair, scales: Scales) -> LossNumbers:
        """Return the kind of loss and alpha = tau V_1/d_max."""
        if self.restitution is not None:
            return LossNumbers(Loss.VISCOUS, _alphas(self.restitution))
        return LossNumbers(Loss.VISCOUS, self.loss_time / scales.time)

    def _describe(self) -> dict[str, Any]:
        return {name: value for name, value in super()._describe().items() if value is not None}


@law
class ElasticPlastic(LossLaw):
    """An elastic, perfectly plastic sphere, such as a metal above its yield velocity.

        P = P_y + 2 E* a_y (d - d_y) while loading beyond yield
        P = (4/3) E* sqrt(R_p) (d - d_p)^(3/2) while unloading
        R_p/R* = (4/3) E* sqrt(R*) d^(3/2)/P at the largest penetration

    At high speeds e falls as V_1^(-1/4). The contact is divided into springs that yield one by one;
    its radius is sqrt(R* d) while loading and sqrt(R_p (d - d_p)) while unloading. The springs in
    shear are elastic, and each bears at most mu times the load of the spring in compression. psi_2
    is within 0.05 of a solution by rings of traction up to V_1 = 10 V_y, and within
    3e-5 max(1, psi_1) of what springs converge to up to V_1 = 100 V_y for chi from 0.3 to 8.

    Parameters
    ----------
    yield_velocity : float or str, optional
        Normal velocity V_y in m/s at which the contact first yields; by default the velocity at
        which the largest pressure is 1.6 times the lower yield strength of the materials.

    Raises
    ------
    InputError
        If it is not positive, or neither it nor a yield strength is known.

    Notes
    -----
    Thornton (1997), J. Appl. Mech. 64:383-386, (14)-(28).

    Examples
    --------
    >>> ball = carom.Sphere(radius="5 mm", material="steel")
    >>> pair = carom.Pair(ball, carom.HalfSpace(material="steel"), friction=0.2)
    >>> law = carom.ElasticPlastic(yield_velocity="0.1 m/s")
    >>> hit = carom.impact(pair, normal_speed=1.0, tangential_speed=0.5, losses=law)
    >>> round(hit.normal_restitution, 6)
    0.658558
    """

    _source: ClassVar[str] = "thornton1997"
    yield_velocity: Any = None

    def _loss(self, pair: Pair, scales: Scales) -> LossNumbers:
        """Return the kind of loss and the radius of the contact at yield, (V_y/V_1)^(2/5)."""
        own = self.yield_velocity
        velocity = yield_velocity(pair) if own is None else own
        return LossNumbers(Loss.PLASTIC, (velocity / scales.speed) ** 0.4)


@law
class Metal(LossLaw):
    """A metal that yields, with the load and contact radius of finite elements.

        P/P_y = w^(3/2) exp(-w^(5/12)/4) + (4 H/C) w (1 - exp(-w^(5/9)/25)), w = d/d_y
        a/a_y = (w (w/1.9)^B)^(1/2), B = 0.14 exp(23 Y/E')
        H = 2.84 - 0.92 (1 - cos(pi a/R)), C = 1.6

    Up to w = 1.9, V_1 = 2.2 V_y, the impact is elastic. H Y is the mean pressure of a fully plastic
    contact, so that it rises from 1.07 Y at first yield towards 2.84 Y; E' = E/(1 - nu^2) is that
    of the body that yields. Unloading is elastic. The restitution falls more slowly than that of
    `ElasticPlastic`, whose pressure does not rise: at V_1 = 277 V_y it is 0.51 instead of 0.29.

    The pressure is Hertz's for the radius a, cut off at the level that gives the load P, and
    unloads as that of an elastic body with a dent; springs bear Abel's transform of it. Springs in
    shear are elastic, and bear at most mu times the load in compression. psi_2 is within 0.07 of a
    solution by rings of traction up to V_1 = 300 V_y, and within 3e-5 max(1, psi_1) of what springs
    converge to up to V_1 = 1000 V_y for chi from 0.3 to 8. Hardening and strain rates are not
    modelled.

    Parameters
    ----------
    flow_stress : float or str, optional
        Yield strength Y in Pa of the body that yields, as it is at the strains and strain rates of
        the impact; by default the lower yield strength of the materials.

    Raises
    ------
    InputError
        If it is not positive, or more than 0.05 E', or neither it nor a yield strength is known.

    Notes
    -----
    Jackson & Green (2005), J. Tribol. 127:343-354, for load and radius, with H of Jackson, Green &
    Marghitu (2010), Nonlinear Dyn. 60:217-229. They are (23), (24), (27)-(29) of Ghaednia, Brake,
    Berryhill & Jackson (2019), J. Tribol., as a public program of this model quotes them.

    Examples
    --------
    >>> ball = carom.Sphere(radius="5 mm", material="steel")
    >>> pair = carom.Pair(ball, carom.HalfSpace(material="steel"), friction=0.2)
    >>> for law in (carom.Metal(), carom.ElasticPlastic()):
    ...     hit = carom.impact(pair, normal_speed=1.0, tangential_speed=0.5, losses=law)
    ...     print(round(hit.normal_restitution, 3))
    0.512
    0.291
    """

    _source: ClassVar[str] = "jackson2005"
    flow_stress: Any = None

    def _loss(self, pair: Pair, scales: Scales) -> LossNumbers:
        """Return the kind of loss, (V_y/V_1)^(2/5) and Y/E'."""
        own = self.flow_stress
        stress = lowest_strength(pair, "flow_stress") if own is None else own
        velocity = yield_velocity(pair, stress)
        strain = stress / yielding_modulus(pair)
        if np.ndim(strain):
            strain = np.where(strain <= LARGEST_STRAIN, strain, np.nan)
        elif strain > LARGEST_STRAIN:
            allowed = f"a metal bears at most {LARGEST_STRAIN:g} E/(1 - nu^2)"
            raise refusal("flow_stress", stress, allowed)
        return LossNumbers(Loss.METAL, (velocity / scales.speed) ** 0.4, strain)


@law
class StandardLinearSolid(LossLaw):
    """A standard linear solid, which loses little in slow impacts and little in fast ones.

        sigma = E (epsilon + g m), m' = epsilon' - m/tau, g = E_0/E - 1

    E is the relaxed modulus, the one of the material, and E_0 the instantaneous modulus. Shear
    follows the same law as compression. The coefficient of restitution e depends on the speed.

    Parameters
    ----------
    modulus_ratio : float
        E_0/E of both bodies, instantaneous over relaxed modulus, from 1 to 1000.
    relaxation_time : float or str
        Relaxation time tau in s at constant strain, zero or positive. In slow impacts the solid
        behaves as a Kelvin-Voigt solid with the retardation time tau (E_0/E - 1).

    Raises
    ------
    InputError
        If one is missing or out of range.

    Notes
    -----
    Hunter (1960), J. Mech. Phys. Solids 8:219-234, and Ting (1966), J. Appl. Mech. 33:845-854, for
    the normal contact. The error of psi_2 for chi up to 3 is below 1e-6 if tau is longer than
    0.01 d_max/V_1, and below 1e-4 otherwise.

    Examples
    --------
    >>> ball = carom.Sphere(radius="5 mm", material="nylon")
    >>> pair = carom.Pair(ball, carom.HalfSpace(material="nylon"), friction=0.2)
    >>> law = carom.StandardLinearSolid(modulus_ratio=1.5, relaxation_time="50 us")
    >>> for speed in (0.01, 1.0, 100.0):
    ...     hit = carom.impact(pair, normal_speed=speed, tangential_speed=0.5 * speed, losses=law)
    ...     print(round(hit.normal_restitution, 3))
    0.804
    0.859
    0.927
    """

    _source: ClassVar[str] = "ting1966"
    modulus_ratio: Any
    relaxation_time: Any

    def _loss(self, pair: Pair, scales: Scales) -> LossNumbers:
        """Return the kind of loss, tau V_1/d_max and E_0/E - 1."""
        ratio = self.modulus_ratio
        if np.ndim(ratio):
            ratio = np.where((ratio >= 1.0) & (ratio <= STIFFEST), ratio, np.nan)
        time = self.relaxation_time / scales.time
        return LossNumbers(Loss.RELAXING, time, ratio - 1.0)


@law
class ZenerPlate(LossLaw):
    """A wide elastic plate that gives way under the force, by Zener's inelasticity parameter.

        d'' = -(5/4) (d^(3/2) + (3/2) lambda sqrt(d) d')
        lambda_Z = (5/4)^(2/5) lambda, lambda = m_n V_1/(Z d_max)
        Z = 8 sqrt(D rho h)

    The bodies lose nothing; waves in the plate carry energy away, and e is close to
    exp(-1.730 lambda_Z) while that is near 1. For a plate of which the thickness is known use
    `HalfSpace(material, thickness=...)`: its lambda grows as V_1^(1/5).

    Parameters
    ----------
    inelasticity : float
        lambda_Z, from 0 to 2.18. D is the stiffness of the plate in bending, rho h its mass per
        area, and d_max the penetration of the impact on a thick wall.

    Raises
    ------
    InputError
        If it is out of range.

    Notes
    -----
    Zener (1941), Phys. Rev. 59:669-673.

    Examples
    --------
    >>> carom.rebound([0.5, 9.0], 1.44, losses=carom.ZenerPlate(inelasticity=0.4)).round(6)
    array([0.049481, 4.637839])
    """

    _source: ClassVar[str] = PLATE
    _alone: ClassVar[str] = "inelasticity"
    inelasticity: Any

    def _loss(self, pair: Pair, scales: Scales) -> LossNumbers:
        """Return the kind of loss and lambda."""
        return LossNumbers(Loss.PLATE, self.inelasticity / ZENER)


def _alphas(restitution: Any) -> Any:
    if np.ndim(restitution) == 0:
        return viscous_loss(float(restitution))
    unique, places = np.unique(restitution, return_inverse=True)
    good = (unique >= SMALLEST_RESTITUTION) & (unique <= 1.0)
    alphas = [viscous_loss(float(e)) if ok else np.nan for e, ok in zip(unique, good, strict=True)]
    return np.array(alphas)[places].reshape(np.shape(restitution))


def yield_velocity(pair: Pair, strength: Any = None) -> float:
    """Return the normal velocity in m/s at which the largest pressure is 1.6 yield strengths.

    p_0 = (2 E*/pi) sqrt(d_max/R*) = 1.6 Y, V_y^2 = (16/15) E* sqrt(R*) d_max^(5/2)/m_n.

    Johnson (1985), (11.21); Thornton (1997).
    """
    if strength is None:
        strength = lowest_strength(pair, "yield_velocity")
    ratio = pi * YIELD_PRESSURE * strength / (2.0 * pair.effective_modulus)
    length = pair.effective_radius * ratio**2
    stiffness = 16.0 / 15.0 * pair.effective_modulus * sqrt(pair.effective_radius)
    return sqrt(stiffness * length**2.5 / pair.normal_mass)


def lowest_strength(pair: Pair, wanted: str) -> Any:
    """Return the lower yield strength in Pa; `wanted` is what may be given in its place."""
    known = (stuff.yield_strength for stuff in pair.materials.values())
    strengths = [strength for strength in known if strength is not None]
    refuse(not strengths and NO_STRENGTH.format(wanted))
    return reduce(np.fmin, strengths)


def yielding_modulus(pair: Pair) -> Any:
    """Return E/(1 - nu^2) in Pa of the body of lower strength, or else the lower one."""
    bodies = pair.materials.values()
    one, other = (body.young / (1.0 - body.poisson**2) for body in bodies)
    known = [np.nan if body.yield_strength is None else body.yield_strength for body in bodies]
    weak, strong = np.nan_to_num(known[0], nan=np.inf), np.nan_to_num(known[1], nan=np.inf)
    lower = np.where(strong < weak, other, np.fmin(one, other))
    return np.where(weak < strong, one, lower)[()]
