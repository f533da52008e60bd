"""The largest stresses of an impact as a dataset, and what the strengths of its bodies say."""

from collections.abc import Iterator
from math import isfinite, isnan, nan
from typing import TYPE_CHECKING, Any

import numpy as np

from carom.bodies.pairs import Pair, Scales
from carom.dimensionless.lossy.solution import LossySolution
from carom.dimensionless.lossy.viscoelastic_solution import ViscoelasticSolution
from carom.dimensionless.solution import Solution
from carom.dimensionless.strength.searching import Contacts, Peak
from carom.impacts.strength import BODIES, MEASURES, StruckBody, strengths_of, units_of
from carom.impacts.validity import WEAK_COUPLING
from carom.io.labels import Finding, labelled_dataset
from carom.quantities.glossary import GLOSSARY, PEAKS
from carom.quantities.prefixes import shared, text
from carom.quantities.units import or_none

if TYPE_CHECKING:
    import xarray as xr

DEPTH = 0.2  # of viscous bodies, in radii of the largest contact: what lies deeper is told
RATIOS = {  # what they are a share of, and what tells how much the body bears
    "yield_ratio": ("von Mises stress/Y", ("yield_strength",)),
    "tension_ratio": ("tension/strength", ("tensile_strength",)),
    "toughness_ratio": ("K/K_c", ("fracture_toughness", "flaw_size")),
}
VERDICTS = {  # of whom, and the ending of the verb
    "yield_ratio": (
        "{0} stay{1} elastic",
        "{0} yield{1}, so the real restitution is below 1 and stresses are upper bounds",
    ),
    "tension_ratio": ("{0} bear{1} the tensile stress", "{0} may crack"),
    "toughness_ratio": ("flaws in {0} do not grow into cracks", "flaws in {0} grow into cracks"),
}
WHERE = " (give them to carom.Material or carom.material(name, ...))"
UPPER_BOUND = (
    "a body yields, so these stresses, which are those of elastic bodies, are upper bounds"
)
UNCOUPLED = (
    "the radial tractions of unlike materials, which the theory neglects, change the tension "
    "beside the contact (Johnson, O'Connor & Woodward 1973)"
)


def struck_bodies(
    pair: Pair, scales: Scales, solution: Solution | LossySolution, depth: float | None = None
) -> dict[str, StruckBody]:
    """Return the bodies of an impact that deform, by name; `depth` as of `Impact.peaks`, in m."""
    singular = isinstance(solution, ViscoelasticSolution)
    usual = DEPTH * solution.max_radius if singular else 0.0
    contacts = Contacts(solution, pair.friction, usual if depth is None else depth / scales.radius)
    bodies = {}
    for name, side in zip(BODIES, (-1.0, 1.0), strict=True):
        stuff = getattr(pair, name).material
        if not stuff.is_rigid:
            given = contacts, stuff.poisson, units_of(scales), strengths_of(stuff)
            bodies[name] = StruckBody(*given, side)
    return bodies


def peaks_dataset(
    pair: Pair, bodies: dict[str, StruckBody], attributes: dict[str, Any]
) -> "xr.Dataset":
    """Return the largest stresses of an impact along `body`; as `Impact.peaks`."""
    columns: dict[str, list[float]] = {}
    for body in bodies.values():
        for name, value in _numbers(body):
            columns.setdefault(name, []).append(value)
    known = {name: ("body", np.array(v)) for name, v in columns.items() if not np.all(np.isnan(v))}
    words = list(bodies)
    yields = any(ratio > 1.0 for ratio in columns["yield_ratio"])
    depth = next(iter(bodies.values())).searched_depth
    notes = [f"stresses were searched only below a depth of {text(depth, 'm', 4)}"] * (depth > 0.0)
    notes += [UPPER_BOUND] * yields + [UNCOUPLED] * (abs(pair.dundurs_beta) > WEAK_COUPLING)
    missing = "; ".join(f"{name} body: {_missing(body)}" for name, body in bodies.items())
    return labelled_dataset(
        {**known, "searched_depth": depth},
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
    found = body.intensity()
    yield from _places("stress_intensity", found._replace(z=0.0 * found.z))
    yield "critical_flaw", found.z
    for name in RATIOS:
        yield name, getattr(body, name)()


def _places(name: str, peak: Peak) -> Iterator[tuple[str, float]]:
    yield name, peak.value
    yield from ((f"{name}_{part}", getattr(peak, part)) for part in ("x", "y", "z", "time"))


def _missing(body: StruckBody) -> str:
    """Return what is not known of a body, in words."""
    names = [name for name in body.strengths._fields if isnan(getattr(body.strengths, name))]
    lost = [] if body.judges_flaws else ["stress_intensity (not bounded with losses)"]
    return ", ".join(names + lost) or "nothing"


def peaks_record(dataset: "xr.Dataset") -> dict[str, Any]:
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


def peaks_text(dataset: "xr.Dataset") -> str:
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
        found = {
            (body, name): row[name]
            for body, row in rows.items()
            for name in PEAKS
            if GLOSSARY[name].unit == unit and not isnan(row.get(name, nan))
        }
        numbers, prefixed = shared(found.values(), unit, 4)
        texts |= {key: f"{number} {prefixed}" for key, number in zip(found, numbers, strict=True)}
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
    findings = []
    for name, (told, needed) in RATIOS.items():
        lacks = {which: _lacking(body, needed) for which, body in bodies.items()}
        known = {which: getattr(bodies[which], name)() for which in bodies if not lacks[which]}
        known = {which: ratio for which, ratio in known.items() if isfinite(ratio)}
        partly = any(0 < len(names) < len(needed) for names in lacks.values())
        if known:
            findings.append(_finding(name, told, known, bodies))
        elif name == "yield_ratio" or partly or not all(lacks.values()):
            findings.append(Finding(told, nan, 1.0, None, _why_not(needed, lacks)))
    return tuple(findings)


def _lacking(body: StruckBody, needed: tuple[str, ...]) -> list[str]:
    """Return the strengths that are not known of those that are needed."""
    return [name for name in needed if isnan(getattr(body.strengths, name))]


def _why_not(needed: tuple[str, ...], lacks: dict[str, list[str]]) -> str:
    """Return why none of the bodies is judged."""
    partly = {which: names for which, names in lacks.items() if 0 < len(names) < len(needed)}
    for which, names in partly.items():
        return f"not judged, as {' and '.join(names)} of the {which} body is not known"
    if all(lacks.values()):
        return f"not judged, as the {needed[0].replace('_', ' ')} is not known"
    return "not judged with losses, as stresses at the surface have no bound"


def _finding(
    name: str, told: str, known: dict[str, float], bodies: dict[str, StruckBody]
) -> Finding:
    which, ratio = max(known.items(), key=lambda one: one[1])
    broken = [body for body, share in known.items() if share > 1.0]
    depth = bodies[which].searched_depth
    several = len(broken or known) == 2
    whose = "both bodies" if several else f"the {(broken or [which])[0]} body"
    if depth > 0.0 and not broken:
        below = f"known only below a depth of {text(depth, 'm', 3)}"
        words = f"the stresses in {whose} are {below}; the surface is not judged"
        return Finding(told, ratio, 1.0, None, words)
    good, bad = VERDICTS[name]
    words = (bad if broken else good).format(whose, "" if several else "s")
    return Finding(told, ratio, 1.0, not broken, words)
