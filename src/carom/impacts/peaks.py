"""What an impact does to its bodies: the largest stresses, against the strengths of each."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from math import inf, isfinite, isnan, nan, pi, sqrt
from typing import TYPE_CHECKING, Any

import numpy as np

from carom.bodies.materials import STRENGTHS, Material
from carom.bodies.pairs import Pair, Scales
from carom.dimensionless.fields.peaks import SHEAR, TENSION, VON_MISES
from carom.dimensionless.lossy.solution import LossySolution
from carom.dimensionless.lossy.viscoelastic.solution import ViscoelasticSolution
from carom.dimensionless.solution import Solution
from carom.dimensionless.strength.cracking import cracking_width, intensity
from carom.dimensionless.strength.peaks import Contacts, Peak, peaks
from carom.impacts.findings import judged, lacking
from carom.impacts.validity import WEAK_COUPLING
from carom.io.labels import labelled_dataset
from carom.quantities.glossary import GLOSSARY, PEAKS
from carom.quantities.prefixes import shared, text
from carom.quantities.units import or_none
from carom.quantities.verdicts import Finding

if TYPE_CHECKING:
    import xarray as xr

MEASURES = {"peak_von_mises": VON_MISES, "peak_shear": SHEAR, "peak_tension": TENSION}
GROWTH = 2.5  # speeds go with stresses to this power: stress ~ sqrt(d_max) ~ V^(2/5)
DEPTH = 0.2  # of viscous bodies, in radii of the largest contact: what lies deeper is told
RATIOS = {  # their labels, of what they are, and over which strength
    "yield_ratio": ("von Mises stress/Y", "peak_von_mises", "yield_strength"),
    "tension_ratio": ("tension/strength", "peak_tension", "tensile_strength"),
    "toughness_ratio": ("K/K_c", "stress_intensity", "fracture_toughness"),
}
VERDICTS = {  # of whom, and the ending of the verb: it holds, it fails, it may fail
    "yield_ratio": (
        "{0} stay{1} elastic",
        "{0} yield{1}, so the real restitution is below 1 and stresses are upper bounds",
        "{0} may yield; e is then still above 0.99, and stresses are upper bounds",
    ),
    "tension_ratio": ("{0} bear{1} the tensile stress", "", "{0} may crack"),
    "toughness_ratio": (
        "flaws in {0} do not grow into cracks",
        "flaws in {0} grow into cracks",
        "flaws in {0} may grow into cracks",
    ),
}
UNSURE = "{0} may yield: the yield strength in an impact is not known well enough"
MAY_YIELD = 1.09  # stress over Y up to which e is above 0.99: V_1/V_y = 1.24, Thornton (1997)
YIELD_PRESSURE = 1.60  # p_0/Y at first yield of a sphere, von Mises (Johnson 1985, 6.1)
WHERE = " (give them to carom.Material or carom.material(name, ...))"
UPPER_BOUND = (
    "a body yields, so these stresses, which are those of elastic bodies, are upper bounds"
)
UNCOUPLED = (
    "the radial tractions of unlike materials, which the theory neglects, change the tension "
    "beside the contact (Johnson, O'Connor & Woodward 1973)"
)


@dataclass(frozen=True, eq=False)
class StruckBody:
    """One body of an impact; stress grows as V^(2/5) where all velocities grow alike.

    `side` is 1 for the second body, -1 for the first, whose stresses are mirrored.
    """

    contacts: Contacts = field(repr=False)
    material: Material
    scales: Scales
    side: float = 1.0

    def bears(self, strength: str) -> float:
        """Return a strength of the material by its name, NaN where that is not known."""
        value = getattr(self.material, strength)
        return nan if value is None else value

    def peak(self, name: str) -> Peak:
        """Return a peak of stress by its name in `MEASURES`, in SI units."""
        peak = peaks(self.contacts, self.material.poisson, (MEASURES[name],))[0]
        return self._in_units(peak, self.scales.pressure)

    def intensity(self, flaw: float | None = None) -> Peak:
        """Return the largest stress intensity at flaws; NaN if unknown, or without bound."""
        flaw, width = self.bears("flaw_size") if flaw is None else flaw, self.scales.radius
        if not (flaw > 0.0 and self.judges_flaws):
            return Peak(*(nan,) * 5)
        peak = intensity(self.contacts, self.material.poisson, flaw / width)
        return self._in_units(peak, self.scales.pressure * sqrt(pi * width))

    @property
    def is_brittle(self) -> bool:
        """Whether it may crack: so far as is known of its material."""
        by_hardness = self.bears("hardness") > 0.0 and isnan(self.bears("yield_strength"))
        return (
            by_hardness or self.bears("fracture_toughness") > 0.0 or self.bears("flaw_size") > 0.0
        )

    @property
    def judges_flaws(self) -> bool:
        """Whether the stress is known up to the surface."""
        return isinstance(self.contacts.solution, Solution)

    @property
    def searched_depth(self) -> float:
        """Depth in m from which on peaks of stress are searched for."""
        return self.contacts.depth * self.scales.radius

    def ratio(self, name: str, flaw: float | None = None) -> float:
        """Return a share of a strength by its name in `RATIOS`; NaN where that is not known."""
        _, measure, strength = RATIOS[name]
        if not self.bears(strength) > 0.0:
            return nan
        peak = self.peak(measure) if measure in MEASURES else self.intensity(flaw)
        return peak.value / self.bears(strength)

    def cracking(self) -> float:
        """Return the factor by which all velocities must grow for flaws to crack; inf for never."""
        toughness, flaw = self.bears("fracture_toughness"), self.bears("flaw_size")
        if not (toughness > 0.0 and flaw > 0.0 and self.judges_flaws):
            return nan
        width = self.scales.radius
        wanted = toughness / (self.scales.pressure * sqrt(pi * width))
        ratio = cracking_width(self.contacts, self.material.poisson, flaw / width, wanted)
        return float(ratio**GROWTH)

    def _in_units(self, peak: Peak, unit: float) -> Peak:
        width = self.scales.radius
        place = self.side * peak.x * width + 0.0, peak.y * width, peak.z * width
        return Peak(peak.value * unit, *place, peak.time * self.scales.time)


def growth(ratio: float) -> float:
    """Return the factor by which all velocities must grow for a share of a strength to be 1."""
    return float(ratio**-GROWTH) if ratio > 0.0 else (inf if ratio <= 0.0 else nan)


def struck_bodies(
    pair: Pair, scales: Scales, solution: Solution | LossySolution, depth: float | None = None
) -> dict[str, StruckBody]:
    """Return the bodies of an impact that deform, by name; `depth` as of `Impact.peaks`, in m."""
    singular = isinstance(solution, ViscoelasticSolution)
    usual = DEPTH * solution.max_radius if singular else 0.0
    contacts = Contacts(solution, pair.friction, usual if depth is None else depth / scales.radius)
    return {
        name: StruckBody(contacts, stuff, scales, 1.0 if name == "second" else -1.0)
        for name, stuff in pair.materials.items()
        if not stuff.is_rigid
    }


def peaks_dataset(
    pair: Pair, bodies: dict[str, StruckBody], attributes: dict[str, Any]
) -> xr.Dataset:
    """Return the largest stresses of an impact along `body`; as `Impact.peaks`."""
    columns: dict[str, list[float]] = {}
    for body in bodies.values():
        for name, value in _numbers(body):
            columns.setdefault(name, []).append(value)
    present = {name: values for name, values in columns.items() if not np.all(np.isnan(values))}
    words = list(bodies)
    yields = any(ratio > 1.0 for ratio in columns["yield_ratio"])
    depth = next(iter(bodies.values())).searched_depth
    notes = [f"stresses were searched only below a depth of {text(depth, 'm', 4)}"] * (depth > 0.0)
    notes += [UPPER_BOUND] * yields + [UNCOUPLED] * (abs(pair.dundurs_beta) > WEAK_COUPLING)
    missing = "; ".join(f"{name} body: {_missing(body)}" for name, body in bodies.items())
    return labelled_dataset(
        {name: ("body", values) for name, values in present.items()} | {"searched_depth": depth},
        {"body": ("body", words, {"long_name": "body"})},
        {
            "title": "largest stresses of an impact",
            "missing": f"{missing}{WHERE}",
            "notes": "; ".join(notes),
            **attributes,
        },
    )


def _numbers(body: StruckBody) -> Iterator[tuple[str, float]]:
    for name in MEASURES:
        yield from _places(name, body.peak(name))
    peak = body.intensity()
    yield from _places("stress_intensity", peak._replace(z=0.0 * peak.z))
    yield "critical_flaw", peak.z
    for name in RATIOS:
        yield name, body.ratio(name)


def _places(name: str, peak: Peak) -> Iterator[tuple[str, float]]:
    yield name, peak.value
    yield from ((f"{name}_{part}", getattr(peak, part)) for part in ("x", "y", "z", "time"))


def _missing(body: StruckBody) -> str:
    """Return what is not known of a body, in words."""
    names = [name for name in STRENGTHS if isnan(body.bears(name))]
    lost = [] if body.judges_flaws else ["stress_intensity (not bounded with losses)"]
    return ", ".join(names + lost) or "nothing"


def peaks_record(dataset: xr.Dataset) -> dict[str, Any]:
    """Return peaks as what JSON can hold, by body; what is not known is None."""
    bodies = {
        str(body): {
            str(name): or_none(float(values.sel(body=body)))
            for name, values in dataset.data_vars.items()
            if "body" in values.dims
        }
        for body in dataset["body"].values
    }
    depth = float(dataset["searched_depth"])
    words = {name: dataset.attrs[name] for name in ("missing", "notes")}
    return {**bodies, "searched_depth": depth, **words}


def peaks_text(dataset: xr.Dataset) -> str:
    """Return peaks as text to read."""
    lines = []
    rows = {
        str(body): {str(name): float(of) for name, of in dataset.sel(body=body).items()}
        for body in dataset["body"].values
    }
    shown = _values(rows)
    for body, row in rows.items():
        lines.append(f"Largest stresses in the {body} body")
        lines += [_line(name, row, shown[body, name]) for name in PEAKS if (body, name) in shown]
    lines += [f"  {note}" for note in (dataset.attrs["notes"],) if note]
    lines.append(f"  These values are not known of the {dataset.attrs['missing']}")
    return "\n".join(lines)


def _values(rows: dict[str, dict[str, float]]) -> dict[tuple[str, str], str]:
    """Return the known peaks by body and name as texts, all stresses in one unit."""
    texts: dict[tuple[str, str], str] = {}
    for unit in dict.fromkeys(GLOSSARY[name].unit for name in PEAKS):
        values = {
            (body, name): row[name]
            for body, row in rows.items()
            for name in PEAKS
            if GLOSSARY[name].unit == unit and not isnan(row.get(name, nan))
        }
        numbers, prefixed = shared(values.values(), unit, 4)
        texts |= {key: f"{number} {prefixed}" for key, number in zip(values, numbers, strict=True)}
    return texts


def _line(name: str, row: dict[str, float], value: str) -> str:
    places, unit = shared([row[f"{name}_{axis}"] for axis in "xyz"], "m", 4)
    at = ", ".join(f"{axis} = {place} {unit}" for axis, place in zip("xyz", places, strict=True))
    if name == "stress_intensity":
        at += f", of {text(row['critical_flaw'], 'm', 4)}"
    instant = text(row[f"{name}_time"], "s", 4)
    return f"  {GLOSSARY[name].meaning:40s} {value:18s} at {at}, t = {instant}"


def judge_strength(bodies: dict[str, StruckBody]) -> tuple[Finding, ...]:
    """Return whether the bodies of an impact bear it: yield with friction, tension, toughness."""
    tension = _ratios("tension_ratio", bodies)  # falls so fast below that flaws hardly feel it
    tears = _finding("tension_ratio", tension, bodies, []) if tension else None
    findings = (_yields(bodies), tears, _cracks(bodies))
    return tuple(finding for finding in findings if finding is not None)


def _yields(bodies: dict[str, StruckBody]) -> Finding:
    """Return the finding on yield; brittle bodies do from a third of the hardness (Johnson 6.3)."""
    ratios, broken = _ratios("yield_ratio", bodies), []
    for which, body in bodies.items():
        if which in ratios:
            limit = MAY_YIELD * _hardened(body)
        elif body.bears("hardness") > 0.0:
            ratios[which] = 3.0 * body.peak("peak_von_mises").value / body.bears("hardness")
            limit = 3.0
        else:
            continue
        broken += [which] * (ratios[which] > limit)
    without = {which: body.material for which, body in bodies.items() if which not in ratios}
    if ratios and (broken or not without or any(b.searched_depth for b in bodies.values())):
        return _finding("yield_ratio", ratios, bodies, broken)
    worst = max(ratios.values(), default=nan)
    return lacking("von Mises stress/Y", 1.0, "yield_strength", without, worst)


def _cracks(bodies: dict[str, StruckBody]) -> Finding | None:
    """Return the finding on flaws of brittle bodies, of any depth where that is not known."""
    label = RATIOS["toughness_ratio"][0]
    brittle = {name: body for name, body in bodies.items() if body.is_brittle}
    if not brittle:
        return None
    if not all(body.judges_flaws for body in brittle.values()):
        words = "not judged with losses, as stresses at the surface have no bound"
        return Finding(label, nan, 1.0, None, words)
    ratios = _ratios("toughness_ratio", brittle)
    broken = [name for name, ratio in ratios.items() if ratio > 1.0]
    deep = {n: b for n, b in brittle.items() if n not in ratios}
    ratios |= _ratios("toughness_ratio", deep, inf)
    for key in ("fracture_toughness", "flaw_size"):
        open_ = {n: b for n, b in deep.items() if not ratios.get(n, inf) <= 1.0}
        unsure = {n: b.material for n, b in open_.items() if isnan(b.bears(key))}
        if unsure and not broken:
            return lacking(label, 1.0, key, unsure, max(ratios.values(), default=nan))
    return _finding("toughness_ratio", ratios, brittle, broken)


def _ratios(
    name: str, bodies: dict[str, StruckBody], flaw: float | None = None
) -> dict[str, float]:
    """Return the shares of a strength, of the bodies of which it is known."""
    ratios = {which: body.ratio(name, flaw) for which, body in bodies.items()}
    return {which: ratio for which, ratio in ratios.items() if isfinite(ratio)}


def _finding(
    name: str, ratios: dict[str, float], bodies: dict[str, StruckBody], broken: list[str]
) -> Finding:
    """Return a finding on known shares of a strength, some of which are surely `broken`."""
    label = RATIOS[name][0]
    which, ratio = max(ratios.items(), key=lambda one: one[1])
    beyond = broken or [body for body, share in ratios.items() if share > 1.0]
    depth = bodies[which].searched_depth
    several = len(beyond or ratios) == 2
    whose = "both bodies" if several else f"the {(beyond or [which])[0]} body"
    if depth > 0.0 and not beyond:
        below = f"known only below a depth of {text(depth, 'm', 3)}"
        words = f"the stresses in {whose} are {below}; the surface is not judged"
        return Finding(label, ratio, 1.0, None, words)
    good, bad, perhaps = VERDICTS[name]
    if ratio > MAY_YIELD and name == "yield_ratio" and not broken:
        perhaps = UNSURE
    words = (bad if broken else perhaps if beyond else good).format(whose, "" if several else "s")
    return Finding(label, ratio, 1.0, False if broken else None if beyond else True, words)


def _hardened(body: StruckBody) -> float:
    """Return by what the yield strength is larger at the rate of strain of the impact."""
    hardening = body.material.rate_hardening
    if hardening is None:
        return 1.0
    strain = body.peak("peak_von_mises").value / body.material.young
    rate = strain / (0.5 * body.contacts.solution.duration * body.scales.time)
    return 1.0 + float((rate / hardening["coefficient"]) ** (1.0 / hardening["exponent"]))


def judge_pressure(pair: Pair, pressure: float, *, yields: bool) -> Finding:
    """Return the finding on yield by the pressure alone, without friction (Johnson 1985, 6.1)."""
    stuffs = pair.materials
    without = {w: m for w, m in stuffs.items() if not (m.yield_strength or m.is_rigid)}
    strengths = [m.yield_strength for m in stuffs.values() if m.yield_strength]
    ratio = pressure / min(strengths, default=nan)
    name = "p_0/Y"
    if yields:
        return Finding(name, ratio, YIELD_PRESSURE, True, "what yields is in the law of losses")
    if without and not ratio > YIELD_PRESSURE:
        return lacking(name, YIELD_PRESSURE, "yield_strength", without, ratio)
    bad = f"a body yields above {YIELD_PRESSURE}, so the real restitution is below 1"
    return judged(name, ratio, YIELD_PRESSURE, "the bodies stay elastic", bad)
