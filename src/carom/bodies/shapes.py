"""Shapes of bodies: a sphere, a half-space, a cup."""

import math
from contextlib import suppress
from dataclasses import dataclass
from functools import cached_property
from typing import Any, cast

from carom.bodies.materials import VALUES, Material, as_material, set_fields
from carom.quantities.arrays import isfinite, quotient, sqrt, where
from carom.quantities.prefixes import Printed, text
from carom.quantities.refusals import Faults, known_keywords, refusal, refuse
from carom.quantities.units import Value, not_negative, positive

DESCRIBED = {  # of what a body is made, round ones and others
    True: ("radius", "gyration_radius", "inner_radius", "thickness", "width"),
    False: ("mass", "inertia", "contact", "curvatures"),
}


class Shape(Printed):
    """A body of a material."""

    material: Material

    def __str__(self) -> str:
        return named(self)


@dataclass(frozen=True, init=False)
class Sphere(Shape):
    """A sphere, solid or hollow, or with a given radius of gyration.

        M = (4/3) pi rho (R^3 - R_i^3), K^2 = (2/5) (R^5 - R_i^5)/(R^3 - R_i^3)

    All is given by name, as a bare length could be a radius or a diameter.

    Parameters
    ----------
    radius : float or str
        Radius R in m.
    material : Material or str
        Material with a density, or the name of a material of the catalogue.
    gyration_radius, inner_radius : float or str, optional
        Radius of gyration K or inner radius R_i of a hollow sphere in m; only one can be given.

    Raises
    ------
    InputError
        If a size is not positive, the inner radius is not below the radius, K and R_i are both
        given, the material has no density, or the mass is too large or small for floating point.

    Examples
    --------
    >>> ball = carom.Sphere(radius="5 mm", material="steel")
    >>> round(ball.mass * 1e3, 4)
    4.1103
    """

    radius: float
    material: Material
    gyration_radius: float | None
    inner_radius: float

    @known_keywords
    def __init__(
        self,
        *,
        radius: Value,
        material: Material | str,
        gyration_radius: Value | None = None,
        inner_radius: Value | None = None,
    ) -> None:
        hole, turning = inner_radius, gyration_radius
        with Faults() as faults:
            if turning is not None and hole is not None:
                faults.add("sphere: give gyration_radius or inner_radius, not both")
            outer = faults.trying(positive, "radius", radius)
            stuff = faults.trying(as_material, material)
            gyration = faults.if_given(positive, "gyration_radius", turning)
            inner = 0.0 if hole is None else faults.trying(not_negative, "inner_radius", hole)
        set_fields(self, radius=outer, material=stuff)
        set_fields(self, gyration_radius=gyration, inner_radius=inner)
        if not self.inner_radius < self.radius:
            raise refusal("inner_radius", inner_radius, f"must be below the radius, {radius!r}")
        if self.material.density is None:
            raise refusal("density", None, "a sphere that moves needs a material with a density")
        if not sphere_fits(self):
            allowed = "floating point cannot hold its mass or inertia; check the units"
            raise refusal("radius", radius, allowed)

    @cached_property
    def mass(self) -> float:
        """Mass M, in kg."""
        volume = 4.0 / 3.0 * math.pi * (self.radius**3 - self.inner_radius**3)
        return volume * cast(float, self.material.density)

    @cached_property
    def gyration_ratio(self) -> float:
        """Ratio K^2/R^2, which is 2/5 for a solid sphere and 2/3 for a thin shell."""
        if self.gyration_radius is not None:
            return (self.gyration_radius / self.radius) ** 2
        hole = self.inner_radius / self.radius
        return 0.4 * (1.0 - hole**5) / (1.0 - hole**3)

    @property
    def curvature(self) -> float:
        """Curvature 1/R, in 1/m."""
        return 1.0 / self.radius

    @property
    def reach(self) -> float:
        """Distance of the contact from the centre, in m."""
        return self.radius


@dataclass(frozen=True, init=False)
class HalfSpace(Shape):
    """A flat body that does not move as a whole: a thick wall, or a wide plate that gives way.

        D = E h^3/(12 (1 - nu^2)), v = P/(8 sqrt(D rho h))

    A plate of thickness h moves at the speed v under a force P, until waves have come back from its
    rim (Zener 1941). Without a thickness the wall is taken as infinitely thick.

    Parameters
    ----------
    material : Material or str
        Material of the body, or the name of a material of the catalogue.
    thickness : float or str, optional
        Thickness h of a plate in m, which needs the density of its material.
    width : float or str, optional
        Width of the plate in m, which is struck in its middle; by default it is wide enough.

    Raises
    ------
    InputError
        If there is no material of that name, a size is not positive, there is a width without a
        thickness, or the material of a plate has no density.

    Examples
    --------
    >>> carom.HalfSpace("rigid").material.is_rigid
    True
    >>> print(carom.HalfSpace("steel", thickness="3 mm"))
    plate (steel, h = 3 mm)
    """

    material: Material
    thickness: float | None = None
    width: float | None = None

    @known_keywords
    def __init__(
        self,
        material: Material | str,
        *,
        thickness: Value | None = None,
        width: Value | None = None,
    ) -> None:
        sizes = {"thickness": thickness, "width": width}
        with Faults() as faults:
            stuff = faults.trying(as_material, material)
            read = {name: faults.if_given(positive, name, size) for name, size in sizes.items()}
        set_fields(self, material=stuff, **read)
        needs = "a plate needs a material with a density; leave thickness out for a thick wall"
        missing = thickness is not None and stuff.density is None
        refuse(missing and refusal("density", None, needs))
        alone = width is not None and thickness is None
        refuse(alone and refusal("width", width, "is that of a plate; give its thickness, too"))

    @property
    def impedance(self) -> float:
        """Force over speed of a plate's middle, 8 sqrt(D rho h), infinite if thick, in kg/s."""
        if self.thickness is None:
            return math.inf
        stuff, h = self.material, self.thickness
        modulus = stuff.young / (12.0 * (1.0 - stuff.poisson**2))
        return 8.0 * h * h * sqrt(modulus * cast(float, stuff.density))

    @property
    def echo_time(self) -> float:
        """Time in s after which the first echo from the other face is back, 2 h/c_L.

        An impact that is over by then is one on a thick wall; of such a wall, and of a rigid one,
        it is infinite. c_L is the speed of compressional waves.

        >>> round(carom.HalfSpace("steel", thickness="3 mm").echo_time * 1e6, 2)
        1.0
        """
        if self.thickness is None:
            return math.inf
        speed = self.material.compressional_speed
        return where(isfinite(speed), quotient(2.0 * self.thickness, speed), math.inf)

    @property
    def curvature(self) -> float:
        """Curvature in 1/m, which is zero."""
        return 0.0


@dataclass(frozen=True, init=False)
class Cup(Shape):
    """A fixed spherical cup that a smaller sphere strikes from inside.

    Parameters
    ----------
    radius : float or str
        Radius of the cup in m, larger than that of the sphere.
    material : Material or str
        Material of the body, or the name of a material of the catalogue.

    Raises
    ------
    InputError
        If the radius is not positive, or there is no material of that name.

    Examples
    --------
    >>> ball = carom.Sphere(radius="5 mm", material="steel")
    >>> pair = carom.Pair(ball, carom.Cup(radius="10 mm", material="steel"), friction=0.2)
    >>> round(pair.effective_radius * 1e3, 9)
    10.0
    """

    radius: float
    material: Material

    @known_keywords
    def __init__(self, *, radius: Value, material: Material | str) -> None:
        with Faults() as faults:
            size = faults.trying(positive, "radius", radius)
            stuff = faults.trying(as_material, material)
        set_fields(self, radius=size, material=stuff)

    @property
    def curvature(self) -> float:
        """Curvature -1/R in 1/m, negative because the surface is concave."""
        return -1.0 / self.radius


def sphere_fits(ball: Sphere) -> bool:
    """Return whether mass and inertia of a sphere are positive numbers."""
    with suppress(OverflowError, ZeroDivisionError):
        inertia = ball.mass * ball.gyration_ratio * ball.radius**2
        return all(0.0 < value < math.inf for value in (ball.mass, ball.gyration_ratio, inertia))
    return False


def describe(body: Shape) -> dict[str, Any]:
    """Return what a body was made from, as plain numbers and words."""
    entries: dict[str, Any] = {"kind": type(body).__name__}
    for name in DESCRIBED[isinstance(body, Sphere | HalfSpace | Cup)]:
        value = getattr(body, name, None)
        if value:
            entries[name] = value
    stuff = body.material
    entries["material"] = {
        name: getattr(stuff, name)
        for name in ("name", *VALUES)
        if getattr(stuff, name) is not None and getattr(stuff, name) != math.inf
    }
    return entries


def named(body: Shape) -> str:
    """Return a body in a few words: its kind, material and sizes."""
    stuff = body.material
    words = [stuff.name or f"E = {text(stuff.young, 'Pa')}"]
    sizes = {"R": "radius", "R_i": "inner_radius", "K": "gyration_radius", "h": "thickness"}
    lengths = {symbol: getattr(body, name, None) for symbol, name in sizes.items()}
    words += [f"{symbol} = {text(size, 'm')}" for symbol, size in lengths.items() if size]
    kind = type(body).__name__.lower()
    if isinstance(body, HalfSpace):
        kind = "half-space" if body.thickness is None else "plate"
    return f"{kind} ({', '.join(words)})"
