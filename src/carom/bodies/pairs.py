"""A pair of bodies: what of them enters an impact, and the scales that make it dimensionless."""

from dataclasses import dataclass
from functools import cached_property, reduce
from math import inf, pi
from operator import and_

from carom.bodies.materials import Material
from carom.bodies.shapes import Cup, HalfSpace, Sphere
from carom.quantities.elementwise import isfinite, quotient, sqrt, where
from carom.quantities.keywords import known_keywords
from carom.quantities.refusals import InputError, refusal
from carom.quantities.units import Value, not_negative

Counterbody = Sphere | HalfSpace | Cup
SAME = 1e-6  # part by which numbers of the same bodies may differ: they are written in few digits


@dataclass(frozen=True)
class ContactScales:
    """What a dimensionless contact is multiplied by, in SI units."""

    length: float
    radius: float
    force: float
    pressure: float
    tangential_length: float
    tangential_force: float


@dataclass(frozen=True)
class Scales(ContactScales):
    """What a dimensionless impact is multiplied by, in SI units."""

    time: float
    energy: float
    tangential_speed: float


def representable(scales: Scales, contact_velocity: float) -> bool:
    """Return whether these scales are numbers that floating point can hold."""
    finite = [isfinite(value) for value in (*vars(scales).values(), contact_velocity)]
    sizes = (scales.length, scales.radius, scales.force, scales.pressure)
    return reduce(and_, [*finite, *(size > 0.0 for size in sizes)])


def checked_scales(pair: "Pair", normal_speed: float, contact_velocity: float = 0.0) -> Scales:
    """Return the scales of an impact, or raise InputError if floating point cannot hold them."""
    try:
        scales = pair.scales(normal_speed)
        fits = representable(scales, contact_velocity)
    except (OverflowError, ZeroDivisionError):
        fits = False
    if not fits:
        raise InputError(
            f"speed: {normal_speed:g} m/s at a radius of {pair.first.radius:g} m gives numbers "
            "that floating point cannot hold; check the units"
        )
    return scales


def alike(one: "Pair", other: "Pair", *, friction: bool = False) -> bool:
    """Tell whether impacts of two pairs are the same, but for the friction unless that counts."""
    names = ("chi", "kappa", "effective_radius", "normal_mass", *(["friction"] * friction))
    values = ((getattr(one, name), getattr(other, name)) for name in names)
    return all(abs(a - b) <= SAME * abs(b) for a, b in values)


def _representable(pair: "Pair") -> bool:
    """Return whether masses and stiffnesses of two bodies together are positive numbers."""
    try:
        values = (
            *(pair.effective_modulus, pair.effective_shear_modulus, pair.effective_radius),
            *(pair.normal_mass, pair.tangential_mass, pair.kappa, pair.chi),
        )
    except (OverflowError, ZeroDivisionError):
        return False
    return all(0.0 < value < inf for value in values)


@dataclass(frozen=True, init=False)
class Pair:
    """Two bodies that meet: a sphere, and a sphere, half-space or cup; with their friction.

    1/E* = sum (1 - nu^2)/E, 1/G* = sum (2 - nu)/(4 G), 1/R* = sum of curvatures, 1/m_n = sum 1/M,
    1/m_t = sum (1/M)(1 + R^2/K^2), kappa = G*/E*, chi = (kappa/2)(m_n/m_t) (Johnson 1985, sections
    4.2 and 7.2). For equal materials chi is that of Barber (1979), (16).

    Parameters
    ----------
    first : Sphere
        The body that moves.
    second : Sphere, HalfSpace or Cup
        The other one; a half-space and a cup stay where they are.
    friction : float or str
        Coefficient mu, not negative.

    Raises
    ------
    InputError
        If the friction is negative, a sphere does not fit its cup, both materials are rigid, or
        numbers are beyond floating point.

    Examples
    --------
    >>> import carom
    >>> steel = carom.material("steel")
    >>> ball = carom.Sphere(radius="5 mm", material=steel)
    >>> pair = carom.Pair(ball, carom.HalfSpace(material=steel), friction=0.2)
    >>> round(pair.chi, 4), round(pair.kappa, 4)
    (1.4412, 0.8235)
    """

    first: Sphere
    second: Counterbody
    friction: float

    @known_keywords
    def __init__(self, first: Sphere, second: Counterbody, friction: Value) -> None:
        if not isinstance(first, Sphere):
            raise refusal("first body", first, "must be a Sphere; the other one comes second")
        if not isinstance(second, Sphere | HalfSpace | Cup):
            raise refusal("second body", second, "must be a Sphere, HalfSpace or Cup")
        if isinstance(second, Cup) and not second.radius > first.radius:
            raise InputError(
                f"radius: a cup of {second.radius:g} m cannot take a sphere of {first.radius:g} m; "
                "the cup must be the larger"
            )
        if first.material.is_rigid and second.material.is_rigid:
            raise InputError("material: both bodies are rigid; one of them must deform")
        object.__setattr__(self, "first", first)
        object.__setattr__(self, "second", second)
        object.__setattr__(self, "friction", not_negative("friction", friction))
        if not _representable(self):
            raise InputError(
                "pair: sizes, densities and stiffnesses of the bodies give numbers that floating "
                "point cannot hold; check the units"
            )

    @cached_property
    def effective_modulus(self) -> float:
        """E* in Pa."""
        return 1.0 / sum((1.0 - m.poisson**2) / m.young for m in self._materials)

    @cached_property
    def effective_shear_modulus(self) -> float:
        """G* in Pa."""
        return 1.0 / sum((2.0 - m.poisson) / (4.0 * m.shear_modulus) for m in self._materials)

    @cached_property
    def effective_radius(self) -> float:
        """R* in m."""
        return 1.0 / (self.first.curvature + self.second.curvature)

    @cached_property
    def normal_mass(self) -> float:
        """m_n in kg."""
        return 1.0 / sum(1.0 / body.mass for body in self.moving)

    @cached_property
    def tangential_mass(self) -> float:
        """m_t in kg."""
        return 1.0 / sum((1.0 + 1.0 / body.gyration_ratio) / body.mass for body in self.moving)

    @property
    def kappa(self) -> float:
        """Ratio of tangential to normal contact stiffness, G*/E*."""
        return self.effective_shear_modulus / self.effective_modulus

    @property
    def chi(self) -> float:
        """(kappa/2)(m_n/m_t), the one parameter of the dimensionless impact."""
        return 0.5 * self.kappa * self.normal_mass / self.tangential_mass

    @property
    def dundurs_beta(self) -> float:
        """Dundurs' second parameter; zero where normal and tangential contact do not couple."""
        one, two = ((1.0 - 2.0 * m.poisson) / m.shear_modulus for m in self._materials)
        whole = sum((1.0 - m.poisson) / m.shear_modulus for m in self._materials)
        return 0.5 * (one - two) / whole

    @property
    def moving(self) -> tuple[Sphere, ...]:
        """The bodies that move: the spheres."""
        return tuple(body for body in (self.first, self.second) if isinstance(body, Sphere))

    @property
    def lateral_ratio(self) -> float:
        """How far tangential traction moves surfaces sideways: nu/(2 - nu) of equal materials.

        The ratio of sum nu/(4 G) to sum (2 - nu)/(4 G), from Barber (1979), (29).
        """
        lateral = sum(m.poisson / (4.0 * m.shear_modulus) for m in self._materials)
        return lateral * self.effective_shear_modulus

    def contact_scales(self, length: float) -> ContactScales:
        """Return the scales of a contact of one penetration (Hertz 1882; Johnson 1985, 4.2).

        Parameters
        ----------
        length : float
            Penetration in m.

        Returns
        -------
        ContactScales
            SI units: length d, radius sqrt(R* d), force, the largest pressure, tangential_length mu
            d/kappa, and tangential_force, (3/2) mu times the force.

        Examples
        --------
        >>> import carom
        >>> ball = carom.Sphere(radius="5 mm", material="steel")
        >>> pair = carom.Pair(ball, carom.HalfSpace(material="steel"), friction=0.2)
        >>> round(pair.contact_scales(2e-6).radius * 1e6, 6)  # of the contact, in um
        100.0
        """
        force = 4.0 / 3.0 * self.effective_modulus * sqrt(self.effective_radius) * length**1.5
        return ContactScales(
            length=length,
            radius=sqrt(self.effective_radius * length),
            force=force,
            pressure=2.0 * self.effective_modulus / pi * sqrt(length / self.effective_radius),
            tangential_length=self.friction * length / self.kappa,
            tangential_force=1.5 * self.friction * force,
        )

    def scales(self, normal_speed: float) -> Scales:
        """Return the scales of an impact at one normal speed (Hertz 1882; Johnson 1985, 11.4).

        Parameters
        ----------
        normal_speed : float
            V_1 in m/s, positive.

        Returns
        -------
        Scales
            What `contact_scales` has at the largest penetration d_max; time d_max/V_1 in s, energy
            m_n V_1^2/2 in J, and tangential_speed mu V_1/kappa in m/s.

        Examples
        --------
        >>> import carom
        >>> ball = carom.Sphere(radius="5 mm", material="steel")
        >>> pair = carom.Pair(ball, carom.HalfSpace(material="steel"), friction=0.2)
        >>> round(pair.scales(1.0).length * 1e6, 2)  # d_max in um
        11.74
        """
        stiffness = self.effective_modulus * sqrt(self.effective_radius)
        length = (15.0 * self.normal_mass * normal_speed**2 / (16.0 * stiffness)) ** 0.4
        return Scales(
            **vars(self.contact_scales(length)),
            time=length / normal_speed,
            energy=0.5 * self.normal_mass * normal_speed**2,
            tangential_speed=self.friction * normal_speed / self.kappa,
        )

    def psi(self, contact_velocity: float, normal_speed: float) -> float:
        """Return kappa V_x/(mu V_1), infinite without friction.

        Parameters
        ----------
        contact_velocity : float
            V_x in m/s.
        normal_speed : float
            V_1 in m/s, positive.

        Returns
        -------
        float
            psi_1, with the sign of V_x; zero where V_x is zero.

        Examples
        --------
        >>> import carom
        >>> ball = carom.Sphere(radius="5 mm", material="steel")
        >>> pair = carom.Pair(ball, carom.HalfSpace(material="steel"), friction=0.2)
        >>> round(pair.psi(0.5, 1.0), 4)
        2.0588
        """
        ratio = quotient(self.kappa * contact_velocity, self.friction * normal_speed)
        return where(contact_velocity == 0.0, 0.0, ratio)

    @property
    def _materials(self) -> tuple[Material, Material]:
        return self.first.material, self.second.material
