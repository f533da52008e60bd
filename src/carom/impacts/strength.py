"""What an impact does to its bodies: the largest stresses, against the strengths of each."""

from __future__ import annotations

from dataclasses import dataclass, field
from math import inf, nan, pi, sqrt
from typing import TYPE_CHECKING, NamedTuple

from carom.dimensionless.solution import Solution
from carom.dimensionless.strength.cracking import cracking_width, intensity
from carom.dimensionless.strength.peaks import SHEAR, TENSION, VON_MISES, peaks
from carom.dimensionless.strength.searching import Contacts, Peak

if TYPE_CHECKING:
    from carom.bodies.materials import Material
    from carom.bodies.pairs import Scales

BODIES = ("first", "second")
MEASURES = {"peak_von_mises": VON_MISES, "peak_shear": SHEAR, "peak_tension": TENSION}
GROWTH = 2.5  # speeds go with stresses to this power: stress ~ sqrt(d_max) ~ V^(2/5)


class Strengths(NamedTuple):
    """What a body bears, NaN where that is not known, in SI units."""

    yield_strength: float
    tensile_strength: float
    fracture_toughness: float
    flaw_size: float


def strengths_of(material: Material) -> Strengths:
    """Return what a material bears."""
    given = (getattr(material, name) for name in Strengths._fields)
    return Strengths(*(nan if value is None else value for value in given))


class Units(NamedTuple):
    """Units of a dimensionless impact: pressure p_L in Pa, width sqrt(R* L) in m, time in s."""

    pressure: float
    width: float
    time: float


def units_of(scales: Scales) -> Units:
    """Return the units of an impact."""
    return Units(scales.pressure, scales.radius, scales.time)


@dataclass(frozen=True, eq=False)
class StruckBody:
    """One body of an impact; stress grows as V^(2/5) where all velocities grow alike.

    `side` is 1 for the second body, -1 for the first, in which friction acts the other way: its
    stresses are those of the second, mirrored.
    """

    contacts: Contacts = field(repr=False)
    poisson: float
    units: Units
    strengths: Strengths
    side: float = 1.0

    def peak(self, name: str) -> Peak:
        """Return a peak of stress by its name in `MEASURES`, in SI units."""
        return self._told(
            peaks(self.contacts, self.poisson, (MEASURES[name],))[0], self.units.pressure
        )

    def intensity(self) -> Peak:
        """Return the largest stress intensity at flaws up to `flaw_size`, z the depth of the flaw.

        NaN where the depth of flaws is not known, or viscous bodies have no bound at the surface.
        """
        if not (self.strengths.flaw_size > 0.0 and self.judges_flaws):
            return Peak(*(nan,) * 5)
        found = intensity(self.contacts, self.poisson, self.strengths.flaw_size / self.units.width)
        return self._told(found, self.units.pressure * sqrt(pi * self.units.width))

    @property
    def judges_flaws(self) -> bool:
        """Whether the stress is known up to the surface."""
        return isinstance(self.contacts.solution, Solution)

    @property
    def searched_depth(self) -> float:
        """Depth in m from which on peaks of stress are searched for."""
        return self.contacts.depth * self.units.width

    def yield_ratio(self) -> float:
        """Return the largest von Mises stress over the yield strength."""
        return self._share("peak_von_mises", self.strengths.yield_strength)

    def tension_ratio(self) -> float:
        """Return the largest tensile stress over the tensile strength."""
        return self._share("peak_tension", self.strengths.tensile_strength)

    def toughness_ratio(self) -> float:
        """Return the largest stress intensity over the fracture toughness."""
        toughness = self.strengths.fracture_toughness
        return self.intensity().value / toughness if toughness > 0.0 else nan

    def cracking(self) -> float:
        """Return the factor by which all velocities must grow for flaws to crack; inf for never."""
        toughness, flaw = self.strengths.fracture_toughness, self.strengths.flaw_size
        if not (toughness > 0.0 and flaw > 0.0 and self.judges_flaws):
            return nan
        width = self.units.width
        wanted = toughness / (self.units.pressure * sqrt(pi * width))
        ratio = cracking_width(self.contacts, self.poisson, flaw / width, wanted)
        return float(ratio**GROWTH)

    def _share(self, name: str, strength: float) -> float:
        return self.peak(name).value / strength if strength > 0.0 else nan

    def _told(self, found: Peak, unit: float) -> Peak:
        width = self.units.width
        place = self.side * found.x * width + 0.0, found.y * width, found.z * width
        return Peak(found.value * unit, *place, found.time * self.units.time)


def growth(ratio: float) -> float:
    """Return the factor by which all velocities must grow for a share of a strength to be 1."""
    return float(ratio**-GROWTH) if ratio > 0.0 else (inf if ratio <= 0.0 else nan)
