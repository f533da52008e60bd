"""A fit as the page shows it: parameters, laws, charts with residuals, bodies, notes."""

from collections.abc import Iterable
from math import isfinite, isnan
from typing import Any

import numpy as np
import xarray as xr

from carom.bodies.pairs import Pair
from carom.bodies.shapes import Cup, Sphere
from carom.explorer.results import in_words
from carom.explorer.views import PAGE
from carom.fitting import Estimate, Fit
from carom.fitting.comparison import LawFit
from carom.fitting.estimates import significant
from carom.quantities.arrays import Array
from carom.quantities.glossary import GLOSSARY
from carom.quantities.prefixes import prefixed, shared, text

DIGITS = 6
NO_NUMBER = "-"
LEAST_WEIGHT = 1e-3  # of a law; of less it is said that it is below
PARAMETERS: dict[str, tuple[str, str]] = PAGE["parameters"]
SHOWN_ELSEWHERE = "columns that were not used"


def shown_fit(
    fit: Fit, name: str, bodies_from: str, columns: list[dict[str, str]]
) -> dict[str, Any]:
    """Return all that the page shows of a fit, as JSON can hold it."""
    problem, dataset = fit.best.model.problem, fit.to_dataset()
    drops = problem.is_normal and fit.losses is not None
    charts = [_drops(dataset)] if drops else [_chart(dataset, str(n)) for n in problem.responses]
    return {
        "name": name,
        "values": problem.count,
        "rows": len(problem.rows),
        "confidence": f"{100.0 * fit.confidence:g} %",
        "parameters": [_parameter(each) for each in fit.estimates.values() if _counts(each)],
        "laws": _laws(fit) if not problem.is_normal else _losses(fit),
        "verdict": fit.losses.verdict if drops and fit.losses else fit.comparison.verdict,
        "regimes": [] if problem.is_normal else _regimes(fit),
        "notes": [in_words(note) for note in fit.notes if not note.startswith(SHOWN_ELSEWHERE)],
        "charts": charts,
        "columns": columns,
        "bodies": {"from": bodies_from, "text": words_of(problem.pair)},
        "words": str(fit),
    }


def _counts(each: Estimate) -> bool:
    """Tell whether a parameter is worth a row: a spin that was not sought is not."""
    return each.determined or bool(each.reason) or each.name != "spin_offset" or each.value != 0.0


def _parameter(each: Estimate) -> dict[str, str]:
    symbol, meaning = PARAMETERS[each.name]
    value, interval, unit, note = _with_interval(each)
    if each.determined and not isnan(each.elastic):
        note = f"elastic: {each.elastic:.3g}"
    row = {"name": each.name, "symbol": symbol, "meaning": meaning}
    return {**row, "value": value, "interval": interval, "unit": unit, "note": note}


def _with_interval(each: Estimate) -> tuple[str, str, str, str]:
    """Return value, interval, unit and what is to be said of a parameter."""
    unit = GLOSSARY[each.name].unit
    if each.reason:
        return NO_NUMBER, "", "", f"not determined: {each.reason}"
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


def _laws(fit: Fit) -> list[dict[str, str]]:
    standings = sorted(fit.comparison, key=lambda each: each.excess)
    return [_standing(each, _values(each)) for each in standings]


def _losses(fit: Fit) -> list[dict[str, str]]:
    """Return the laws of losses, compared where speeds differ."""
    if fit.losses is None:
        return []
    return [
        _standing(each, f"{PARAMETERS[each.parameter.name][0]} = {each.parameter}")
        for each in fit.losses.standings
    ]


def _standing(law: Any, parameters: str) -> dict[str, str]:
    excess = weight = NO_NUMBER
    if isfinite(law.excess):
        seen = law.weight >= LEAST_WEIGHT
        excess = f"{law.excess:.1f}"
        weight = f"{100.0 * law.weight:.3g} %" if seen else f"below {100.0 * LEAST_WEIGHT:g} %"
    return {"law": law.law, "excess": excess, "weight": weight, "parameters": parameters}


def _values(law: LawFit) -> str:
    return ", ".join(
        f"{PARAMETERS[name][0]} = {GLOSSARY[name].text(value, 4)}"
        for name, value in law.values.items()
    )


def _regimes(fit: Fit) -> list[dict[str, Any]]:
    return [{"name": name, "rows": count} for name, count in fit.regimes.items() if count]


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
    points = {"x": x, "measured": measured, "error": error, "residual": residual, "scaled": scaled}
    return {name: _plain(values) for name, values in points.items()}


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
    stuff = body.material
    if stuff.name:
        return str(stuff.name)
    return f"E = {text(stuff.young, 'Pa', 3)}, ν = {stuff.poisson:.3g}"


def plain_words(name: str) -> str:
    """Return what a quantity means, without the marks of formulas."""
    return GLOSSARY[name].meaning.replace("$", "")
