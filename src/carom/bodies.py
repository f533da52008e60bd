"""Materials and shapes of bodies."""

import math
import tomllib
from dataclasses import dataclass
from functools import cached_property, lru_cache
from importlib.resources import files
from typing import Any, TypeVar, cast

from carom.quantities import (
    InputError,
    nearest,
    not_negative,
    number,
    positive,
    refusal,
)

Value = float | str
VALUES = ("young", "poisson", "density", "yield_strength")
T = TypeVar("T")


def _set(record: object, **values: object) -> None:
    """Fill a frozen record."""
    for name, value in values.items():
        object.__setattr__(record, name, value)


def unchecked(kind: type[T], **values: object) -> T:
    """Return a frozen record with fields as they are: arrays, checked point by point elsewhere."""
    record = object.__new__(kind)
    _set(record, **values)
    return record


@dataclass(frozen=True, init=False)
class Material:
    """An isotropic elastic material; numbers are SI, text may carry a unit.

    G = E/(2 (1 + nu)).

    Parameters
    ----------
    young : float or str
        Young's modulus, positive; math.inf for a material that does not deform.
    poisson : float
        Poisson's ratio, -1 < nu <= 0.5.
    density : float or str, optional
        Needed only for a body that moves.
    yield_strength : float or str, optional
        Used only to judge whether the impact stays elastic.
    name : str, optional
        How results call it.

    Raises
    ------
    InputError
        If a value is out of range or its unit does not fit.

    Examples
    --------
    >>> import carom
    >>> steel = carom.Material(young="210 GPa", poisson=0.3, density=7850)
    >>> round(steel.shear_modulus / 1e9, 3)
    80.769
    """

    young: float
    poisson: float
    density: float | None
    yield_strength: float | None
    name: str | None

    def __init__(
        self,
        *,
        young: Value,
        poisson: Value,
        density: Value | None = None,
        yield_strength: Value | None = None,
        name: str | None = None,
    ) -> None:
        ratio = number("poisson", poisson)
        if not -1.0 < ratio <= 0.5:
            raise refusal("poisson", poisson, "must be above -1 and at most 0.5, e.g. 0.3")
        _set(
            self,
            young=math.inf if young == math.inf else positive("young", young),
            poisson=ratio,
            density=None if density is None else positive("density", density),
            yield_strength=None
            if yield_strength is None
            else positive("yield_strength", yield_strength),
            name=name,
        )

    @property
    def shear_modulus(self) -> float:
        """Shear modulus in Pa."""
        return self.young / (2.0 * (1.0 + self.poisson))

    @property
    def is_rigid(self) -> bool:
        """Whether the material does not deform."""
        return math.isinf(self.young)


@lru_cache(maxsize=1)
def _catalogue() -> dict[str, dict[str, Any]]:
    text = files("carom").joinpath("data/materials.toml").read_text(encoding="utf-8")
    catalogue: dict[str, dict[str, Any]] = tomllib.loads(text)
    return catalogue


def materials() -> dict[str, Material]:
    """Return the catalogue of materials by name, without "rigid".

    Typical values at room temperature; `material_sources` tells where each comes from.

    Returns
    -------
    dict
        Each `Material` by name, E in Pa, density in kg/m^3.

    Examples
    --------
    >>> import carom
    >>> "soda-lime-glass" in carom.materials()
    True
    """
    return {name: material(name) for name in _catalogue()}


def material(name: str) -> Material:
    """Return a material of the catalogue by its name or an alias; "rigid" does not deform.

    Parameters
    ----------
    name : str
        As `materials` has it, or an alias of it such as "glass".

    Returns
    -------
    Material
        E in Pa, nu, density in kg/m^3, yield strength in Pa; what is not known is None.

    Raises
    ------
    InputError
        If there is none of that name; the message offers the nearest.

    Examples
    --------
    >>> import carom
    >>> carom.material("steel").young
    210000000000.0
    """
    wanted = str(name).strip().lower()
    if wanted == "rigid":
        return Material(young=math.inf, poisson=0.0, name="rigid")
    for key, entry in _catalogue().items():
        if wanted in (key, *entry.get("aliases", ())):
            values: dict[str, Any] = {k: entry.get(k) for k in VALUES}
            return Material(**values, name=key)
    known = [alias for key, entry in _catalogue().items() for alias in (key, *entry["aliases"])]
    hint = nearest(wanted, [*known, "rigid"]) or "carom materials lists what there is"
    raise refusal("material", name, f"no material of that name; {hint}")


def material_sources(name: str) -> dict[str, str]:
    """Return the source of each value of a material of the catalogue.

    Parameters
    ----------
    name : str
        As `material` takes it.

    Returns
    -------
    dict
        The source by the name of the value; empty for "rigid".

    Raises
    ------
    InputError
        If there is none of that name.

    Examples
    --------
    >>> import carom
    >>> sorted(carom.material_sources("steel"))
    ['density', 'poisson', 'yield_strength', 'young']
    """
    return dict(_catalogue().get(material(name).name or "", {}).get("sources", {}))


def as_material(value: Material | str) -> Material:
    """Return a material as it is, or the one of that name."""
    return value if isinstance(value, Material) else material(value)


@dataclass(frozen=True, init=False)
class Sphere:
    """A sphere: solid, hollow with an `inner_radius`, or of any `gyration_radius` K.

    M = (4/3) pi (R^3 - R_i^3) rho, K^2 = (2/5) (R^5 - R_i^5)/(R^3 - R_i^3).

    Parameters
    ----------
    radius : float or str
        R in m.
    material : Material or str
        With a density; or the name of one of the catalogue.
    gyration_radius, inner_radius : float or str, optional
        K or R_i in m, not both.

    Raises
    ------
    InputError
        If a size is not positive, the hole as large as the sphere, the inertia given in both ways,
        or the material without density.

    Examples
    --------
    >>> import carom
    >>> ball = carom.Sphere(radius="5 mm", material="steel")
    >>> round(ball.mass * 1e3, 4)
    4.1103
    """

    radius: float
    material: Material
    gyration_radius: float | None
    inner_radius: float

    def __init__(
        self,
        *,
        radius: Value,
        material: Material | str,
        gyration_radius: Value | None = None,
        inner_radius: Value | None = None,
    ) -> None:
        if gyration_radius is not None and inner_radius is not None:
            raise InputError("sphere: give gyration_radius or inner_radius, not both")
        _set(
            self,
            radius=positive("radius", radius),
            material=as_material(material),
            gyration_radius=None
            if gyration_radius is None
            else positive("gyration_radius", gyration_radius),
            inner_radius=0.0
            if inner_radius is None
            else not_negative("inner_radius", inner_radius),
        )
        if not self.inner_radius < self.radius:
            raise refusal("inner_radius", inner_radius, f"must be below the radius, {radius!r}")
        if self.material.density is None:
            raise refusal("density", None, "a sphere that moves needs a material with a density")

    @cached_property
    def mass(self) -> float:
        """Mass in kg."""
        volume = 4.0 / 3.0 * math.pi * (self.radius**3 - self.inner_radius**3)
        return volume * cast(float, self.material.density)

    @cached_property
    def gyration_ratio(self) -> float:
        """K^2/R^2: 2/5 for a solid sphere, 2/3 for a thin shell."""
        if self.gyration_radius is not None:
            return (self.gyration_radius / self.radius) ** 2
        hole = self.inner_radius / self.radius
        return 0.4 * (1.0 - hole**5) / (1.0 - hole**3)

    @property
    def curvature(self) -> float:
        """Curvature in 1/m, positive where the body is convex."""
        return 1.0 / self.radius


@dataclass(frozen=True, init=False)
class HalfSpace:
    """A flat body that does not move as a whole.

    Parameters
    ----------
    material : Material or str
        What it is made of; or the name of a material of the catalogue.

    Raises
    ------
    InputError
        If there is no material of that name.

    Examples
    --------
    >>> import carom
    >>> carom.HalfSpace(material="rigid").material.is_rigid
    True
    """

    material: Material

    def __init__(self, *, material: Material | str) -> None:
        _set(self, material=as_material(material))

    @property
    def curvature(self) -> float:
        """Curvature in 1/m: none."""
        return 0.0


@dataclass(frozen=True, init=False)
class Cup:
    """A spherical cup, fixed, in which a smaller sphere strikes.

    Parameters
    ----------
    radius : float or str
        In m, larger than that of the sphere.
    material : Material or str
        What it is made of; or the name of a material of the catalogue.

    Raises
    ------
    InputError
        If the radius is not positive, or there is no material of that name.

    Examples
    --------
    >>> import carom
    >>> ball = carom.Sphere(radius="5 mm", material="steel")
    >>> pair = carom.Pair(ball, carom.Cup(radius="10 mm", material="steel"), friction=0.2)
    >>> round(pair.effective_radius * 1e3, 9)
    10.0
    """

    radius: float
    material: Material

    def __init__(self, *, radius: Value, material: Material | str) -> None:
        _set(self, radius=positive("radius", radius), material=as_material(material))

    @property
    def curvature(self) -> float:
        """Curvature in 1/m, negative."""
        return -1.0 / self.radius


def describe(body: Sphere | HalfSpace | Cup) -> dict[str, Any]:
    """Return what a body was made from, as plain numbers and words."""
    entries: dict[str, Any] = {"kind": type(body).__name__}
    for name in ("radius", "gyration_radius", "inner_radius"):
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
