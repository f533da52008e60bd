"""Fits for the page: a table as it arrives is read, checked and fitted, or its bodies asked for.

What is shown of a fit: parameters, laws, charts with residuals, bodies, notes.
"""

from base64 import b64decode
from collections.abc import Iterable, Mapping
from math import isfinite, isnan
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from carom.bodies.observables import INCIDENCE, OBSERVABLES
from carom.bodies.pairs import Pair
from carom.bodies.shapes import Cup, Sphere
from carom.io.cells import Column
from carom.io.heads import TableFormat, table_format
from carom.io.remedies import Remedies, offering
from carom.lab.datasets import shipped
from carom.lab.fitting import Estimate, Fit, fit
from carom.lab.fitting.comparison import LawFit
from carom.lab.fitting.intervals import significant
from carom.lab.fitting.reading import read_measurements, read_problem, read_rebounds
from carom.page.columns import lists, plain_words, taken
from carom.page.limits import LARGEST_UPLOAD, MOST_UPLOADED_ROWS
from carom.page.views import LONGEST_NAME, PAGE, Refused, View, in_words
from carom.quantities.arrays import Array
from carom.quantities.glossary import GLOSSARY
from carom.quantities.prefixes import prefixed, shared, text
from carom.quantities.refusals import Faults, InputError, refusal

BODIES_ASKED = (
    "{name} does not say which bodies struck each other. The fit needs their radius, their "
    "density and their elastic constants."
)
LISTS = Remedies(
    lambda _: "choose it in the list of the column",
    "choose one in the list of sheets",
    "choose it in the list of decimal signs",
    "with carom fit",
    "with carom fit",
)
PAGE_SUBJECTS = {"data": "file", "results": "file", "pair": "bodies"}  # by those of Python
SHOWN_DIGITS = 6
NO_NUMBER = "-"
LEAST_WEIGHT = 1e-3  # of a law; of less it is said that it is below
PARAMETERS: dict[str, tuple[str, str]] = PAGE["parameters"]
SHOWN_ELSEWHERE = "columns that were not used"


def answer(asked: dict[str, str]) -> dict[str, Any]:
    """Return the fit of a data set that comes along, by its name, or of a file that was sent.

    A file is written into the working directory meanwhile, which `worker.Desk` has made for it, and
    so is what its columns hold. Raises Refused, with lists to choose that from, if it cannot be
    fitted, and InputError if it is too large.
    """
    how = table_format(None)
    if "data" in asked:
        return _fitted(shipped.path(asked["data"]), asked["data"], None, how)
    file, name, said = Path.cwd() / "upload.csv", shown_name(asked["name"]), Path("map.toml")
    file.write_bytes(_decoded(asked["contents"]))
    said.write_text(asked.get("columns", ""), "utf-8", "replace")
    try:
        with offering(LISTS):
            how = table_format(said)
            view = View.of(asked["bodies"]) if asked["bodies"] else None
            return _fitted(file, name, view, how) | {"lists": lists(file, how)}
    except Refused:  # of the bodies that the page sent
        raise
    except InputError as error:
        subject, colon, rest = str(error).replace(str(file), name).partition(": ")
        words = in_words(PAGE_SUBJECTS.get(subject, subject) + colon + rest)
        offer = lists(file, how)
        raise Refused("", words, **({"lists": offer} if offer else {})) from None
    finally:
        file.unlink()
        said.unlink()


def shown_name(name: str) -> str:
    """Return the name of a user's file, fit to be shown."""
    last = str(name).replace("\\", "/").rpartition("/")[2]
    return "".join(letter for letter in last if letter.isprintable())[:LONGEST_NAME] or "file"


def _decoded(contents: str) -> bytes:
    try:
        content = b64decode(contents.partition(",")[2], validate=True)
    except ValueError:  # no Base64, or characters beyond ASCII
        raise InputError("file: it did not arrive whole; choose it again") from None
    if len(content) > LARGEST_UPLOAD:
        allowed = f"must be at most {LARGEST_UPLOAD} bytes; leave out what is not needed"
        raise refusal("file", f"{len(content)} bytes", allowed)
    return content


def _fitted(file: Path, name: str, view: View | None, how: TableFormat) -> dict[str, Any]:
    table = read_rebounds(file, what="file", **how._asdict())
    if len(table) > MOST_UPLOADED_ROWS:
        allowed = f"must be at most {MOST_UPLOADED_ROWS} rows; use carom fit for more"
        raise refusal("file", f"{len(table)} rows", allowed)
    if table.case is None and (view is None or view.in_numbers):
        with Faults() as faults:  # what no bodies make right is said before they are asked for
            there = {*read_measurements(table.told(faults))[0].columns}
        if not there & {*OBSERVABLES} or not there & {*INCIDENCE, "normal_speed"}:
            read_problem(table, View().pair)
        return {"asks": "bodies", "name": name, "message": BODIES_ASKED.format(name=name)}
    pair: Pair | None = view.pair if table.case is None and view is not None else None
    return shown_fit(fit(table, pair=pair), name, "page" if pair else "file", table.cells)


def shown_fit(
    result: Fit, name: str, bodies_from: str, cells: Mapping[str, Column]
) -> dict[str, Any]:
    """Return all that the page shows of a fit, as JSON can hold it."""
    problem, dataset = result._best.model.problem, result.to_dataset()
    drops = problem.is_normal and result.losses is not None
    regimes = () if problem.is_normal else result.regimes.items()
    charts = [_drops(dataset)] if drops else [_chart(dataset, str(n)) for n in problem.responses]
    return {
        "name": name,
        "values": problem.count,
        "rows": len(problem.rows),
        "confidence": f"{100.0 * result.confidence:g} %",
        "parameters": [_parameter(each) for each in result.estimates.values() if _counts(each)],
        "laws": _losses(result) if problem.is_normal else _laws(result),
        "verdict": result.losses.verdict if drops and result.losses else result.comparison.verdict,
        "regimes": [{"name": name, "rows": n} for name, n in regimes if n],
        "notes": [in_words(note) for note in result.notes if not note.startswith(SHOWN_ELSEWHERE)],
        "charts": charts,
        "columns": taken(cells, problem.ignored),
        "bodies": {"from": bodies_from, "text": words_of(problem.pair)},
        "words": str(result),
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


def _laws(result: Fit) -> list[dict[str, str]]:
    def values(law: LawFit) -> str:
        named = law.values.items()
        return ", ".join(f"{PARAMETERS[n][0]} = {GLOSSARY[n].text(value, 4)}" for n, value in named)

    standings = sorted(result.comparison, key=lambda each: each.excess)
    return [_standing(each, values(each)) for each in standings]


def _losses(result: Fit) -> list[dict[str, str]]:
    """Return the laws of losses, compared where speeds differ."""
    if result.losses is None:
        return []
    return [
        _standing(each, f"{PARAMETERS[each.parameter.name][0]} = {each.parameter}")
        for each in result.losses.standings
    ]


def _standing(law: Any, parameters: str) -> dict[str, str]:
    excess = weight = NO_NUMBER
    if isfinite(law.excess):
        seen = law.weight >= LEAST_WEIGHT
        excess = f"{law.excess:.1f}"
        weight = f"{100.0 * law.weight:.3g} %" if seen else f"below {100.0 * LEAST_WEIGHT:g} %"
    return {"law": law.law, "excess": excess, "weight": weight, "parameters": parameters}


def _chart(dataset: xr.Dataset, name: str) -> dict[str, Any]:
    """Return a response against incidence: measured, by laws, and what is left."""
    one, scale, unit = dataset.sel(response=name), float(np.degrees(1.0)), "deg"
    if GLOSSARY[name].unit != "rad":
        scale, unit = prefixed(one["measured"].values, GLOSSARY[name].unit)
    along, laws = np.degrees(one["curve_incidence"].values), one["law"].values
    lines = {str(law): scale * one["curve_expected"].sel(law=law).values for law in laws}
    spinning = bool(dataset.attrs["spinning"])
    measured, residual, error = (scale * one[k].values for k in ("measured", "residual", "error"))
    return {
        **_points(one, np.degrees(one["incidence"].values), measured, residual, error),
        **_lines(along, lines),
        "response": name.replace("_", " "),
        "meaning": plain_words(name),
        "unit": _or_none(unit),
        "along": "incidence of the contact point" if spinning else "angle of incidence",
        "along_unit": "deg",
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
        **_points(dataset, speeds, measured, residual, error),
        **_lines(along, lines),
        "response": "restitution",
        "meaning": "normal speed, after to before",
        "unit": "",
        "along": "normal speed before",
        "along_unit": "m/s",
        "band": [],
        "borders": [],
    }


def _points(
    dataset: xr.Dataset, x: Array, measured: Array, residual: Array, error: Array
) -> dict[str, Any]:
    with np.errstate(all="ignore"):
        scaled = residual / error
    points = {"x": x, "measured": measured, "error": error, "residual": residual, "scaled": scaled}
    outlier = (dataset["outlier"].values.reshape(len(x), -1) == 1).any(axis=1)
    labels = {"row": dataset["row"].values.tolist(), "outlier": outlier.tolist()}
    return {**labels, **{name: _plain(values) for name, values in points.items()}}


def _lines(x: Array, lines: dict[str, Array]) -> dict[str, Any]:
    return {"lines": [{"law": law, "x": _plain(x), "y": _plain(y)} for law, y in lines.items()]}


def _plain(values: Iterable[float]) -> list[float | None]:
    """Return numbers of a few digits, None for what is none."""
    return [float(f"{each:.{SHOWN_DIGITS}g}") if isfinite(each) else None for each in values]


def words_of(pair: Pair) -> str:
    """Return the bodies of a fit in words."""
    first = f"ball of {text(pair.first.radius, 'm', 4)} radius, {_material(pair.first)}"
    second: Any = pair.second
    shape = "half-space" if pair.thickness is None else f"plate of {text(pair.thickness, 'm', 4)}"
    if isinstance(second, Sphere | Cup):
        kind = "sphere" if isinstance(second, Sphere) else "cup"
        shape = f"{kind} of {text(second.radius, 'm', 4)} radius"
    return f"{first}; on a {shape}, {_material(second)}"


def _material(body: Any) -> str:
    stuff = body.material
    if stuff.name:
        return str(stuff.name)
    return f"E = {text(stuff.young, 'Pa', 3)}, ν = {stuff.poisson:.3g}"
