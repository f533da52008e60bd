"""Materials: elastic, with a density and a strength where they are known; and the catalogue."""

import math
import tomllib
from dataclasses import dataclass
from functools import lru_cache
from typing import Any, TypeVar, cast

from carom.folder import DATA
from carom.quantities.glossary import listed
from carom.quantities.prefixes import Printed
from carom.quantities.refusals import (
    Faults,
    checked_type,
    hint,
    known_keywords,
    nearest,
    refusal,
    refuse,
)
from carom.quantities.units import Value, not_negative, number, positive

STRENGTHS = ("yield_strength", "tensile_strength", "fracture_toughness", "flaw_size")
JUDGED_BY = ("hardness", "surface_energy", "loss_factor")  # verdicts, and nothing else
VALUES = ("young", "poisson", "density", *STRENGTHS, *JUDGED_BY)
RUBBER = 0.49975  # Poisson's ratio
T = TypeVar("T")


def set_fields(record: object, **values: object) -> None:
    """Fill a frozen record."""
    for name, value in values.items():
        object.__setattr__(record, name, value)


def unchecked(kind: type[T], **values: object) -> T:
    """Return a frozen record with fields as they are: arrays, checked point by point elsewhere."""
    record = object.__new__(kind)
    set_fields(record, **values)
    return record


@dataclass(frozen=True, init=False)
class Material(Printed):
    """An isotropic elastic material; numbers are in SI units, texts may carry a unit.

        G = E/(2 (1 + nu))

    Parameters
    ----------
    young : float or str
        Young's modulus E, positive; math.inf for a material that does not deform.
    poisson : float
        Poisson's ratio nu, -1 < nu <= 0.5.
    density : float or str, optional
        Density; only a body that moves needs it.
    yield_strength, tensile_strength : float or str, optional
        Von Mises stress at which the material yields, tensile stress at which it breaks.
    fracture_toughness : float or str, optional
        Stress intensity at which cracks grow, in Pa m^0.5, e.g. `"0.75 MPa m^0.5"`.
    flaw_size : float or str, optional
        Depth of the flaws in the surface from which cracks grow.
    hardness : float or str, optional
        Indentation hardness, as Vickers's, in Pa: a material that is brittle yields at a third of
        it at least.
    surface_energy : float or str, optional
        Energy of the surface per area, e.g. `"40 mJ/m^2"`: half the work of adhesion of two such
        surfaces.
    loss_factor : float or str, optional
        Loss factor eta, the tangent of the loss angle of vibrations.
    name : str, optional
        Name of the material in results.

    Raises
    ------
    InputError
        If a value is out of range or its unit does not fit.

    Examples
    --------
    >>> steel = carom.Material(young="210 GPa", poisson=0.3, density=7850)
    >>> round(steel.shear_modulus / 1e9, 3)
    80.769
    """

    young: float
    poisson: float
    density: float | None
    yield_strength: float | None
    tensile_strength: float | None
    fracture_toughness: float | None
    flaw_size: float | None
    hardness: float | None
    surface_energy: float | None
    loss_factor: float | None
    name: str | None

    @known_keywords
    def __init__(
        self,
        *,
        young: Value,
        poisson: Value,
        density: Value | None = None,
        yield_strength: Value | None = None,
        tensile_strength: Value | None = None,
        fracture_toughness: Value | None = None,
        flaw_size: Value | None = None,
        hardness: Value | None = None,
        surface_energy: Value | None = None,
        loss_factor: Value | None = None,
        name: str | None = None,
    ) -> None:
        strengths = (yield_strength, tensile_strength, fracture_toughness, flaw_size)
        others = (density, *strengths, hardness, surface_energy, loss_factor)
        with Faults() as faults:
            read: dict[str, float | None] = {"young": faults.trying(_stiffness, young)}
            read["poisson"] = faults.trying(_lateral, poisson)
            for key, value in zip(VALUES[2:], others, strict=True):
                check = not_negative if key in VALUES[-2:] else positive
                read[key] = faults.if_given(check, key, value)
            if name is not None:
                faults.trying(checked_type, "name", name, str, "must be a text")
        set_fields(self, **read, name=name)

    @property
    def shear_modulus(self) -> float:
        """Shear modulus in Pa."""
        return self.young / (2.0 * (1.0 + self.poisson))

    @property
    def compressional_speed(self) -> float:
        """Speed of compressional waves, sqrt(2 (1 - nu) G/((1 - 2 nu) rho)), in m/s.

        Of a material that hardly can be compressed, such as rubber, nu is taken as 0.49975 at most.

        >>> round(carom.material("steel").compressional_speed)
        6001
        """
        from carom.quantities.arrays import minimum, sqrt  # by numpy, which start-up does without

        nu = minimum(self.poisson, RUBBER)
        stiffness = 2.0 * (1.0 - nu) / (1.0 - 2.0 * nu) * self.shear_modulus
        return sqrt(stiffness / cast(float, self.density))

    @property
    def is_rigid(self) -> bool:
        """Whether the material does not deform."""
        return math.isinf(self.young)

    @property
    def sources(self) -> dict[str, str]:
        """Sources of the values that are those of the catalogue, each by its name.

        >>> sorted(carom.material("steel").sources)
        ['density', 'loss_factor', 'poisson', 'rate_hardening', 'yield_strength', 'young']
        """
        entry = _catalogue().get(self.name or "", {})
        texts: dict[str, str] = entry.get("sources", {})
        return {key: text for key, text in texts.items() if getattr(self, key) == entry[key]}

    @property
    def rate_hardening(self) -> dict[str, float] | None:
        """Coefficient D in 1/s and exponent q of Cowper & Symonds, 1 + (rate/D)^(1/q).

        This is by what the yield strength of the catalogue is larger at a rate of strain; None
        where it is not known.
        """
        entry = _catalogue().get(self.name or "", {})
        same = self.yield_strength == entry.get("yield_strength")
        return entry.get("rate_hardening") if same else None

    def __str__(self) -> str:
        values = {key: getattr(self, key) for key in VALUES}
        there = {key: value for key, value in values.items() if value not in (None, math.inf)}
        return "\n".join([self.name or "material", *listed(there)])


class Catalogue(dict[str, Material], Printed):
    """Materials by name; printed, a table."""

    def __str__(self) -> str:
        head = f"{'name':22s} {'E (GPa)':>9s} {'nu':>6s} {'rho (kg/m^3)':>13s} {'Y (MPa)':>9s}"
        rows = [
            f"{name:22s} {each.young / 1e9:9.4g} {each.poisson:6.3g} {each.density:13.5g} "
            f"{_in_mega(each.yield_strength):>9s} {_in_mega(each.fracture_toughness):>16s}"
            for name, each in self.items()
        ]
        return "\n".join([f"{head} {'K_c (MPa m^0.5)':>16s}", *rows])


def _in_mega(value: float | None) -> str:
    return "-" if value is None else f"{value / 1e6:.4g}"


def _lateral(poisson: Value) -> float:
    """Return Poisson's ratio, or raise InputError."""
    ratio = number("poisson", poisson)
    if -1.0 < ratio <= 0.5:
        return ratio
    raise refusal("poisson", poisson, "must be above -1 and at most 0.5, e.g. 0.3")


def _stiffness(young: Any) -> float:
    """Return a positive modulus, infinite for what does not deform, or raise InputError."""
    rigid = isinstance(young, float) and young == math.inf
    return math.inf if rigid else positive("young", young)


@lru_cache(maxsize=1)
def _catalogue() -> dict[str, dict[str, Any]]:
    text = (DATA / "materials.toml").read_text(encoding="utf-8")
    catalogue: dict[str, dict[str, Any]] = tomllib.loads(text)
    return catalogue


def materials() -> Catalogue:
    """Return each `Material` of the catalogue by its name, without "rigid"; printed, a table.

    The values are typical of room temperature; `sources` of each names where they are from.

    Examples
    --------
    >>> "soda-lime-glass" in carom.materials()
    True
    """
    return Catalogue({name: material(name) for name in _catalogue()})


def material(name: str, **values: Value) -> Material:
    """Return the material of the catalogue that has this name; "rigid" does not deform.

    Parameters
    ----------
    name : str
        A name that `materials` lists, or an alias of it such as "glass".
    **values : float or str
        Values that replace those of the catalogue, or add to them, named as in `Material`.

    Returns
    -------
    Material
        E in Pa, nu, density in kg/m^3, strengths in Pa, fracture toughness in Pa m^0.5. Values that
        are not known are None.

    Raises
    ------
    InputError
        If there is no material of that name (the message suggests the nearest), or a value has an
        unknown name, is out of range or has a unit that does not fit.

    Examples
    --------
    >>> carom.material("glass", flaw_size="20 um").flaw_size
    2e-05
    """
    checked_type("material", name, str, "give a name, or carom.Material(young=..., poisson=...)")
    unknown = [key for key in values if key not in VALUES]
    refuse(*(f"{key}: unknown in a material; {hint(key, VALUES)}" for key in unknown))
    wanted = name.strip().lower()
    if wanted == "rigid":
        return Material(**{"young": math.inf, "poisson": 0.0, **values}, name="rigid")
    for key, entry in _catalogue().items():
        if wanted in (key, *entry.get("aliases", ())):
            stored: dict[str, Any] = {k: entry.get(k) for k in VALUES}
            return Material(**stored | values, name=key)
    entries = _catalogue().items()
    names = [alias for key, entry in entries for alias in (key, *entry.get("aliases", ()))]
    near = nearest(wanted, [*names, "rigid"]) or "'carom materials' lists them all"
    raise refusal("material", name, f"there is no material of that name; {near}")


def as_material(value: Material | str) -> Material:
    """Return a material as it is, or the one of that name."""
    return value if isinstance(value, Material) else material(value)
