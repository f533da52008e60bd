"""A pair of bodies: its effective constants, and the scales that make an impact dimensionless."""

from contextlib import suppress
from dataclasses import dataclass
from functools import cached_property
from math import inf, pi
from typing import Any

import numpy as np

from carom.bodies.materials import Material, set_fields
from carom.bodies.shapes import Cup, HalfSpace, Sphere, describe
from carom.bodies.smooth_body import Body, as_body, axes_of, check_shapes
from carom.dimensionless.ellipse import Ellipse, contact_ellipse, stiffness_ratios
from carom.dimensionless.numerics.hertz import DURATION
from carom.quantities.arrays import Array, quotient, sqrt, where
from carom.quantities.prefixes import Printed, text
from carom.quantities.refusals import (
    Faults,
    InputError,
    checked_type,
    known_keywords,
    refusal,
    refuse,
)
from carom.quantities.units import Value, not_negative

Counterbody = Sphere | HalfSpace | Cup
ROUND = (Sphere, HalfSpace, Cup)
OF_BOTH = ("friction", "roughness")  # what belongs to both bodies together
UNCOUPLED = 1e-12  # b_nt over b_nn of bodies that are struck through their centres
LEAST, MOST = 1e-100, 1e100  # of the numbers of an impact


@dataclass(frozen=True)
class ContactScales:
    """SI scales of a contact: length, radius, force, pressure, tangential length and force."""

    length: float
    radius: float
    force: float
    pressure: float
    tangential_length: float
    tangential_force: float


@dataclass(frozen=True)
class Scales(ContactScales):
    """SI scales of an impact: those of its contact, and speed, time, energy, tangential speed."""

    speed: float
    time: float
    energy: float
    tangential_speed: float


def holds(value: float) -> bool:
    """Tell whether floating point holds products and quotients of three such numbers."""
    return (value >= LEAST) & (value <= MOST)


def pair_fits(pair: "Pair") -> bool:
    """Return whether floating point holds masses and stiffnesses of two bodies together."""
    with suppress(OverflowError, ZeroDivisionError):
        return all(map(holds, pair.constants))
    return False


@dataclass(frozen=True, init=False)
class Pair(Printed):
    """A body, the one that it strikes, and the friction between them.

        1/E* = sum (1 - nu^2)/E, 1/G* = sum (2 - nu)/(4 G), 1/R* = sum 1/R
        1/m_n = sum 1/M, 1/m_t = sum (1/M)(1 + R^2/K^2)
        kappa = G*/E*, chi = (kappa/2)(m_n/m_t)

    The sums are over both bodies (Johnson 1985, sections 4.2 and 7.2). 1/R is the curvature, which
    is zero for a half-space and negative for a cup; the mass of both is infinite. For equal
    materials chi is that of Barber (1979), (16). Of a `Body`, 1/m_n = b_nn and 1/m_t = b_tt; G*, as
    kappa and chi, is that along x, and R* that of the sphere whose contact is as stiff.

    Parameters
    ----------
    first : Sphere or Body
        The body that moves.
    second : Sphere, HalfSpace, Cup or Body
        The other body; a half-space, a cup or a Body without a mass does not move.
    friction : float or str
        Coefficient of friction mu, not negative.
    roughness : float or str, optional
        Root mean square of the heights of both surfaces together, (s_1^2 + s_2^2)^(1/2), in m. It
        changes no result; `validity` judges by it whether the surfaces count as smooth.

    Raises
    ------
    InputError
        If the friction or the roughness is negative, the sphere does not fit into the cup, both
        materials are rigid, the surfaces do not part from their contact on, one body is in a plane
        and the other in space, or the masses or stiffnesses are too large or too small for floating
        point.

    Examples
    --------
    >>> steel = carom.material("steel")
    >>> ball = carom.Sphere(radius="5 mm", material=steel)
    >>> pair = carom.Pair(ball, carom.HalfSpace(material=steel), friction=0.2)
    >>> print(pair)
    sphere (steel, R = 5 mm) on half-space (steel): friction 0.2, chi 1.441, kappa 0.8235
    """

    first: Sphere  # or a Body, which checked_pair keeps from all that takes spheres alone
    second: Counterbody
    friction: float
    roughness: float | None = None

    @known_keywords
    def __init__(
        self,
        first: Sphere | Body,
        second: Counterbody | Body,
        friction: Value,
        *,
        roughness: Value | None = None,
    ) -> None:
        moves = "must be a Sphere or Body that moves; the other one comes second"
        checked_type("first body", first, (Sphere, Body), moves)
        if not isinstance(second, Counterbody | Body):
            raise refusal("second body", second, "must be a Sphere, HalfSpace, Cup or Body")
        refuse(
            isinstance(first, Body) and first.mass is None and refusal("first body", first, moves)
        )
        if (
            isinstance(second, Cup)
            and isinstance(first, Sphere)
            and not second.radius > first.radius
        ):
            raise InputError(
                f"radius: a cup of {text(second.radius, 'm')} cannot take a sphere of "
                f"{text(first.radius, 'm')}; the cup must be the larger"
            )
        if first.material.is_rigid and second.material.is_rigid:
            raise InputError("material: both bodies are rigid; one of them must deform")
        with Faults() as faults:
            mu = faults.trying(not_negative, "friction", friction)
            heights = faults.if_given(not_negative, "roughness", roughness)
        set_fields(self, first=first, second=second, friction=mu, roughness=heights)
        if not self.is_round:
            check_shapes(first, second, self.curvatures)
        if not pair_fits(self):
            raise InputError(
                "pair: sizes, densities and stiffnesses of the bodies give numbers that floating "
                "point cannot hold; check the units"
            )

    @property
    def is_round(self) -> bool:
        """Whether both bodies are spheres, half-spaces or cups, struck through their centres."""
        return isinstance(self.first, ROUND) and isinstance(self.second, ROUND)

    @property
    def is_planar(self) -> bool:
        """Whether the bodies move in a plane of symmetry, that of x and the normal."""
        return all(not isinstance(b, Body) or b.is_planar for b in (self.first, self.second))

    @cached_property
    def bodies(self) -> tuple[Body, Body]:
        """Both as bodies of any shape; those that do not move have no mass."""
        return as_body(self.first, -1.0), as_body(self.second, 1.0)

    @cached_property
    def curvatures(self) -> Array:
        """Sum of both bodies' curvatures along x and y, in 1/m, shape (2, 2)."""
        return np.sum([body.curvatures for body in self.bodies], axis=0)

    @cached_property
    def inverse_mass(self) -> Array:
        """Inverse mass B at the contact along x, y and the normal, in 1/kg, shape (3, 3)."""
        return np.sum([body.inverse_mass for body in self.bodies], axis=0)

    @property
    def is_central(self) -> bool:
        """Whether the bodies are struck through their centres, so that friction only turns them."""
        return bool(np.all(np.abs(self.inverse_mass[:2, 2]) <= UNCOUPLED * self.inverse_mass[2, 2]))

    @cached_property
    def _ellipse(self) -> Ellipse:
        """The shape of the contact; its axes are those of the curvatures, x by x."""
        along, across = axes_of(self.curvatures)[0]
        return contact_ellipse(along, across)

    @cached_property
    def kappas(self) -> tuple[float, float]:
        """Ratios of tangential to normal stiffness along both axes of the contact."""
        bodies = [(m.poisson, m.shear_modulus) for m in self.materials.values()]
        return stiffness_ratios(self._ellipse.share, self.effective_modulus, *bodies)

    @property
    def thickness(self) -> float | None:
        """Thickness of a plate that is struck, in m; None if it is none."""
        return self.second.thickness if isinstance(self.second, HalfSpace) else None

    @cached_property
    def effective_modulus(self) -> float:
        """Effective modulus E*, in Pa."""
        return 1.0 / sum((1.0 - m.poisson**2) / m.young for m in self.materials.values())

    @cached_property
    def effective_shear_modulus(self) -> float:
        """Effective shear modulus G*, in Pa."""
        if not self.is_round:
            return self.kappas[0] * self.effective_modulus
        return 1.0 / sum(
            (2.0 - m.poisson) / (4.0 * m.shear_modulus) for m in self.materials.values()
        )

    @cached_property
    def effective_radius(self) -> float:
        """Effective radius R*, in m."""
        if not self.is_round:
            return self._ellipse.radius
        return 1.0 / (self.first.curvature + self.second.curvature)

    @cached_property
    def normal_mass(self) -> float:
        """Effective mass in the normal direction m_n, in kg."""
        if not self.is_round:
            return float(1.0 / self.inverse_mass[2, 2])
        return 1.0 / sum(1.0 / body.mass for body in self.moving)

    @cached_property
    def tangential_mass(self) -> float:
        """Effective mass of the contact point in the tangential direction m_t, in kg."""
        if not self.is_round:
            return float(1.0 / self.inverse_mass[0, 0])
        return 1.0 / sum((1.0 + 1.0 / body.gyration_ratio) / body.mass for body in self.moving)

    @property
    def kappa(self) -> float:
        """Ratio of tangential to normal contact stiffness, G*/E*."""
        return self.effective_shear_modulus / self.effective_modulus

    @property
    def chi(self) -> float:
        """Ratio (kappa/2)(m_n/m_t), the only parameter of the dimensionless elastic impact."""
        return 0.5 * self.kappa * self.normal_mass / self.tangential_mass

    @property
    def constants(self) -> tuple[float, ...]:
        """E*, G*, R*, m_n, m_t, kappa and chi, and M and K^2/R^2 of the spheres; all positive."""
        moduli = self.effective_modulus, self.effective_shear_modulus
        masses = self.normal_mass, self.tangential_mass, *(body.mass for body in self.moving)
        spheres = [body for body in self.moving if isinstance(body, Sphere)]
        ratios = self.kappa, self.chi, *(body.gyration_ratio for body in spheres)
        return *moduli, self.effective_radius, *masses, *ratios

    @property
    def dundurs_beta(self) -> float:
        """Dundurs' second parameter; zero if normal and tangential contact do not couple."""
        one, two = ((1.0 - 2.0 * m.poisson) / m.shear_modulus for m in self.materials.values())
        whole = sum((1.0 - m.poisson) / m.shear_modulus for m in self.materials.values())
        return 0.5 * (one - two) / whole

    @property
    def moving(self) -> tuple[Sphere, ...]:
        """The bodies that can move, which are those with a mass."""
        bodies: tuple[Any, ...] = self.first, self.second
        return tuple(body for body in bodies if getattr(body, "mass", None) is not None)

    @property
    def lateral_ratio(self) -> float:
        """Lateral displacement of the surface under a tangential traction, as a ratio.

        It is the ratio of sum nu/(4 G) to sum (2 - nu)/(4 G), from Barber (1979), (29), which is
        nu/(2 - nu) for equal materials.
        """
        lateral = sum(m.poisson / (4.0 * m.shear_modulus) for m in self.materials.values())
        return lateral * self.effective_shear_modulus

    def contact_scales(self, length: float) -> ContactScales:
        """Return the scales of a contact at a given penetration (Hertz 1882; Johnson 1985, 4.2).

        Parameters
        ----------
        length : float
            Penetration in m.

        Returns
        -------
        ContactScales
            `length` d, `radius` sqrt(R* d), of an ellipse the larger semi-axis, `force` P,
            `pressure` p_0, `tangential_length` mu d/kappa, and `tangential_force` (3/2) mu P.

        Examples
        --------
        >>> round(pair.contact_scales(2e-6).radius * 1e6, 6)  # of the contact, in um
        100.0
        """
        force = 4.0 / 3.0 * self.effective_modulus * sqrt(self.effective_radius) * length**1.5
        axes = (1.0, 1.0) if self.is_round else self._ellipse[1:3]
        deepest = 2.0 * self.effective_modulus / pi * sqrt(length / self.effective_radius)
        return ContactScales(
            length=length,
            radius=max(axes) * sqrt(self.effective_radius * length),
            force=force,
            pressure=deepest / (axes[0] * axes[1]),
            tangential_length=self.friction * length / self.kappa,
            tangential_force=1.5 * self.friction * force,
        )

    def scales(self, normal_speed: float) -> Scales:
        """Return the scales of an impact at a given normal speed (Hertz 1882; Johnson 1985, 11.4).

        Parameters
        ----------
        normal_speed : float
            Normal speed V_1 in m/s, positive.

        Returns
        -------
        Scales
            Those of `contact_scales` at the largest penetration d_max, the `speed` V_1, `time`
            d_max/V_1 in s, `energy` m_n V_1^2/2 in J, `tangential_speed` mu V_1/kappa in m/s.

        Examples
        --------
        >>> round(pair.scales(1.0).length * 1e6, 2)  # d_max in um
        11.74
        """
        stiffness = self.effective_modulus * sqrt(self.effective_radius)
        length = (15.0 * self.normal_mass * normal_speed**2 / (16.0 * stiffness)) ** 0.4
        return Scales(
            **vars(self.contact_scales(length)),
            speed=normal_speed,
            time=length / normal_speed,
            energy=0.5 * self.normal_mass * normal_speed**2,
            tangential_speed=self.friction * normal_speed / self.kappa,
        )

    def plate_give(self, normal_speed: float) -> float:
        """Return how far a plate gives way, lambda = m_n V_1/(8 sqrt(D rho h) d_max) (Zener 1941).

        Parameters
        ----------
        normal_speed : float
            Normal speed V_1 in m/s, positive.

        Returns
        -------
        float
            lambda; 0 for a thick wall.

        Examples
        --------
        >>> plate = carom.HalfSpace(material="steel", thickness="3 mm")
        >>> round(carom.Pair(ball, plate, friction=0.2).plate_give(0.5), 3)
        0.345
        """
        wall = self.second
        impedance = wall.impedance if isinstance(wall, HalfSpace) else inf
        return quotient(self.normal_mass, impedance * self.scales(normal_speed).time)

    def gives_way(self, scales: Scales) -> bool:
        """Tell whether a plate is struck that gives way: an echo is back before the contact ends.

        Where none is, the impact is one on a thick wall.

        Parameters
        ----------
        scales : Scales
            Those of the impact, as `scales` returns them.

        Returns
        -------
        bool
            False for a thick wall, and for what is no half-space.

        Examples
        --------
        >>> for thickness in ("3 mm", "300 mm"):
        ...     plate = carom.HalfSpace(material="steel", thickness=thickness)
        ...     on_plate = carom.Pair(ball, plate, friction=0.2)
        ...     print(on_plate.gives_way(on_plate.scales(0.5)))
        True
        False
        """
        wall = self.second
        return isinstance(wall, HalfSpace) and DURATION * scales.time >= wall.echo_time

    def psi(self, contact_velocity: float, normal_speed: float) -> float:
        """Return the dimensionless velocity kappa V_x/(mu V_1), infinite without friction.

        Parameters
        ----------
        contact_velocity : float
            Tangential velocity of the contact point V_x, in m/s.
        normal_speed : float
            Normal speed V_1 in m/s, positive.

        Returns
        -------
        float
            psi_1, with the sign of V_x; zero where V_x is zero.

        Examples
        --------
        >>> round(pair.psi(0.5, 1.0), 4)
        2.0588
        """
        ratio = quotient(self.kappa * contact_velocity, self.friction * normal_speed)
        return where(contact_velocity == 0.0, 0.0, ratio)

    @property
    def materials(self) -> dict[str, Material]:
        """Materials of both bodies, "first" and "second"."""
        return {"first": self.first.material, "second": self.second.material}

    def _describe(self) -> dict[str, Any]:
        """Return the bodies and their friction as plain numbers and words."""
        bodies = {"first": describe(self.first), "second": describe(self.second)}
        rough = {} if self.roughness is None else {"roughness": self.roughness}
        return bodies | {"friction": self.friction} | rough

    def __str__(self) -> str:
        bodies = f"{self.first} on {self.second}"
        return f"{bodies}: friction {self.friction:g}, chi {self.chi:.4g}, kappa {self.kappa:.4g}"
