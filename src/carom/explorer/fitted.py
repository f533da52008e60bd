"""A fit as the page shows it: parameters, laws, charts with residuals, bodies, notes."""

from collections.abc import Iterable
from math import isfinite, isnan
from typing import Any

import numpy as np
import xarray as xr

from carom.bodies.pairs import Pair
from carom.bodies.shapes import Cup, Sphere
from carom.explorer.results import in_words
from carom.fitting import Estimate, Fit
from carom.fitting.comparison import LawFit
from carom.fitting.estimates import significant
from carom.quantities.arrays import Array
from carom.quantities.glossary import GLOSSARY
from carom.quantities.prefixes import prefixed, shared, text

DIGITS = 6
NONE = "-"  # in place of a number
LEAST = 1e-3  # weight of a law that is told as a number
PARAMETERS = {
    "friction": ("µ", "friction"),
    "kappa": ("κ", "stiffness ratio"),
    "chi": ("χ", "inertia to stiffness"),
    "restitution": ("e", "restitution"),
    "spin_offset": ("δω", "spin before that was not intended"),
    "loss_time": ("τ", "retardation time"),
    "yield_velocity": ("V_y", "speed from which it yields"),
    "tangential_restitution": ("e_t", "tangential restitution while it sticks"),
}
TOLD_ELSEWHERE = "columns that were not used"


def shown_fit(
    found: Fit, name: str, bodies_from: str, columns: list[dict[str, str]]
) -> dict[str, Any]:
    """Return all that the page shows of a fit, as JSON can hold it."""
    problem, dataset = found.best.model.problem, found.to_dataset()
    drops = problem.is_normal and found.losses is not None
    charts = [_drops(dataset)] if drops else [_chart(dataset, str(n)) for n in problem.responses]
    return {
        "name": name,
        "values": problem.count,
        "rows": len(problem.rows),
        "confidence": f"{100.0 * found.confidence:g} %",
        "parameters": [_parameter(each) for each in found.estimates.values() if _counts(each)],
        "laws": _laws(found) if not problem.is_normal else _losses(found),
        "verdict": found.losses.verdict if drops and found.losses else found.comparison.verdict,
        "regimes": [] if problem.is_normal else _regimes(found),
        "notes": [in_words(note) for note in found.notes if not note.startswith(TOLD_ELSEWHERE)],
        "charts": charts,
        "columns": columns,
        "bodies": {"from": bodies_from, "text": words_of(problem.pair)},
        "words": str(found),
    }


def _counts(each: Estimate) -> bool:
    """Tell whether a parameter is worth a row: a spin that was not sought is not."""
    return each.determined or bool(each.reason) or each.name != "spin_offset" or each.value != 0.0


def _parameter(each: Estimate) -> dict[str, str]:
    symbol, meaning = PARAMETERS[each.name]
    value, interval, unit, note = _told(each)
    if each.determined and not isnan(each.elastic):
        note = f"elastic: {each.elastic:.3g}"
    row = {"name": each.name, "symbol": symbol, "meaning": meaning}
    return {**row, "value": value, "interval": interval, "unit": unit, "note": note}


def _told(each: Estimate) -> tuple[str, str, str, str]:
    """Return value, interval, unit and what is to be said of a parameter."""
    unit = GLOSSARY[each.name].unit
    if each.reason:
        return NONE, "", "", f"not determined: {each.reason}"
    if each.determined and not each.open:
        ends = (each.low, each.value, each.high)
        (low, value, high), unit = shared(ends, unit, significant(each.value, each.high - each.low))
        return value, f"{low} to {high}", _or_none(unit), ""
    (value,), own = shared((each.value,), unit, 4)
    if not each.determined:
        return value, "not varied", _or_none(own), ""
    word, end = ("at most", each.high) if isfinite(each.high) else ("at least", each.low)
    if each.name == "restitution" and each.high == 1.0:
        word, end = "at least", each.low
    return value, f"{word} {text(end, unit, 4)}", _or_none(own), ""


def _or_none(unit: str) -> str:
    return "" if unit == "1" else unit


def _laws(found: Fit) -> list[dict[str, str]]:
    standings = sorted(found.comparison, key=lambda each: each.excess)
    return [
        {"law": each.law, **_standing(each.excess, each.weight), "parameters": _values(each)}
        for each in standings
    ]


def _losses(found: Fit) -> list[dict[str, str]]:
    """Return the laws of losses, compared where speeds differ."""
    if found.losses is None:
        return []
    return [
        {
            "law": each.law,
            **_standing(each.excess, each.weight),
            "parameters": f"{PARAMETERS[each.parameter.name][0]} = {each.parameter}",
        }
        for each in found.losses.standings
    ]


def _standing(excess: float, weight: float) -> dict[str, str]:
    if not isfinite(excess):
        return {"excess": NONE, "weight": NONE}
    told = f"{100.0 * weight:.3g} %" if weight >= LEAST else f"below {100.0 * LEAST:g} %"
    return {"excess": f"{excess:.1f}", "weight": told}


def _values(law: LawFit) -> str:
    return ", ".join(
        f"{PARAMETERS[name][0]} = {GLOSSARY[name].text(value, 4)}"
        for name, value in law.values.items()
    )


def _regimes(found: Fit) -> list[dict[str, Any]]:
    return [{"name": name, "rows": count} for name, count in found.regimes.items() if count]


def _chart(dataset: xr.Dataset, name: str) -> dict[str, Any]:
    """Return a response against incidence: measured, by laws, and what is left."""
    one = dataset.sel(response=name)
    scale, unit = _scale(name, one["measured"].values)
    along = np.degrees(one["curve_incidence"].values)
    lines = {
        str(law): scale * one["curve_expected"].sel(law=law).values for law in one["law"].values
    }
    spinning = bool(dataset.attrs["spinning"])
    measured, residual, error = (scale * one[k].values for k in ("measured", "residual", "error"))
    return {
        **_points(np.degrees(one["incidence"].values), measured, residual, error),
        "response": name.replace("_", " "),
        "meaning": plain_words(name),
        "unit": _or_none(unit),
        "along": "incidence of the contact point" if spinning else "angle of incidence",
        "along_unit": "deg",
        "row": dataset["row"].values.tolist(),
        "lines": [_line(law, along, line) for law, line in lines.items()],
        "band": [_plain(scale * one[f"curve_{end}"].values) for end in ("low", "high")],
        "borders": _plain(np.degrees(dataset["border"].values)),
    }


def _drops(dataset: xr.Dataset) -> dict[str, Any]:
    """Return restitution against speed: measured, by laws of losses, and what is left."""
    speeds, along = dataset["normal_speed"].values, dataset["loss_speed"].values
    laws = [str(law) for law in dataset["loss_law"].values]
    lines = {law: dataset["loss_restitution"].sel(loss_law=law).values for law in laws}
    measured, error = (dataset[f"restitution{end}"].values for end in ("", "_error"))
    residual = measured - np.interp(speeds, along, lines[laws[0]])
    return {
        **_points(speeds, measured, residual, error),
        "response": "restitution",
        "meaning": "normal speed, after to before",
        "unit": "",
        "along": "normal speed before",
        "along_unit": "m/s",
        "row": dataset["row"].values.tolist(),
        "lines": [_line(law, along, line) for law, line in lines.items()],
        "band": [],
        "borders": [],
    }


def _points(x: Array, measured: Array, residual: Array, error: Array) -> dict[str, Any]:
    with np.errstate(all="ignore"):
        scaled = residual / error
    given = {"x": x, "measured": measured, "error": error, "residual": residual, "scaled": scaled}
    return {name: _plain(values) for name, values in given.items()}


def _line(law: str, x: Array, y: Array) -> dict[str, Any]:
    return {"law": law, "x": _plain(x), "y": _plain(y)}


def _plain(values: Iterable[float]) -> list[float | None]:
    """Return numbers of a few digits, None for what is none."""
    return [float(f"{each:.{DIGITS}g}") if isfinite(each) else None for each in values]


def _scale(name: str, values: Array) -> tuple[float, str]:
    unit = GLOSSARY[name].unit
    return (float(np.degrees(1.0)), "deg") if unit == "rad" else prefixed(values, unit)


def words_of(pair: Pair) -> str:
    """Return the bodies of a fit in words."""
    first = f"ball of {text(pair.first.radius, 'm', 4)} radius, {_material(pair.first)}"
    second: Any = pair.second
    if not isinstance(second, Sphere | Cup):
        return f"{first}; on a half-space, {_material(second)}"
    kind = "sphere" if isinstance(second, Sphere) else "cup"
    return f"{first}; on a {kind} of {text(second.radius, 'm', 4)} radius, {_material(second)}"


def _material(body: Any) -> str:
    given = body.material
    if given.name:
        return str(given.name)
    return f"E = {text(given.young, 'Pa', 3)}, ν = {given.poisson:.3g}"


def plain_words(name: str) -> str:
    """Return what a quantity means, without the marks of formulas."""
    return GLOSSARY[name].meaning.replace("$", "")
