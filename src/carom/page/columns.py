"""The columns of a file for the page: what each was taken for, and what it may hold instead."""

from collections.abc import Iterable, Mapping
from contextlib import suppress
from pathlib import Path
from typing import Any

from carom.bodies.observables import BEFORE, OBSERVABLES
from carom.io.cells import Column, is_number
from carom.io.heads import ALIASES, TableFormat, parts_of
from carom.io.spreadsheets import sheets_of
from carom.io.tables import file_columns
from carom.io.user_table import entry, suggested, with_errors
from carom.lab.fitting.bounces import BOUNCES, base
from carom.lab.fitting.groups import GROUP
from carom.lab.fitting.plates import DURATION, THICKNESS
from carom.lab.fitting.reading import FROM_SURFACE, UNSIGNED
from carom.quantities.glossary import GLOSSARY
from carom.quantities.refusals import InputError, clipped
from carom.quantities.texts import is_unit
from carom.quantities.units import factor_of

KINDS = {
    **dict.fromkeys(BEFORE, "before the impact"),
    "surface_angle": "before the impact",
    **dict.fromkeys((*OBSERVABLES, *FROM_SURFACE, UNSIGNED), "after the impact"),
    DURATION: "after the impact",
    **dict.fromkeys(BOUNCES, "drop and rebound"),
    THICKNESS: "the plate",
    GROUP: "repeats",
}
UNITS = {
    "rad": ["deg", "rad"],
    "rad/s": ["rpm", "rad/s", "rps"],
    "m/s": ["m/s", "cm/s", "mm/s"],
    "m": ["m", "cm", "mm"],
    "s": ["s", "ms", "us"],
}
SHOWN_CELLS = 3


def taken(columns: Mapping[str, Column], ignored: Iterable[str]) -> list[dict[str, str]]:
    """Return for each column its head, what it was taken for, and the unit it was read in."""
    empty = [name.partition(" ")[0] for name in ignored if "(" in name]
    rows = []
    for name, column in columns.items():
        kind, meaning, unit, quantity = "not used", "", "", entry(base(name))
        if quantity in KINDS:
            si, kind, meaning = GLOSSARY[quantity].unit, KINDS[quantity], plain_words(quantity)
            if name != quantity:
                kind, meaning = "standard deviation", f"of {meaning}"
            if entry(name) in empty:
                kind = "not used: no value in it"
            unit = str(column.unit) or ("" if si == "1" else f"{si} (the head names no unit)")
        rows.append({"head": column.head, "kind": kind, "meaning": meaning, "unit": unit})
    return rows


def lists(file: Path, how: TableFormat) -> dict[str, Any] | None:
    """Return what a reader may choose for a file, and what is chosen; None if that is no table."""
    columns: list[Column] = []
    written: list[Column] = []
    with suppress(InputError):  # which is told as the fault of the file
        columns, _ = file_columns("file", file, how, 1)
        written, _ = file_columns("file", file, how._replace(decimal="."), 1)  # with commas as such
    if len({column.head for column in columns}) < len(columns) or not any(
        is_number(cell) for column in columns for cell in column.cells
    ):
        columns = []
    sheets = sheets_of(file)
    if not columns and len(sheets) < 2:
        return None
    rows = [_row(*both, how.columns) for both in zip(columns, written, strict=False)]
    numbered = {entry(row[key]) for row in rows for key in ("own", "name")} - {"", *KINDS}
    return {
        "sheets": sheets if len(sheets) > 1 else [],
        "sheet": how.sheet,
        "asks_decimal": bool(how.decimal) or any(column.fault for column in columns),
        "decimal": how.decimal,
        "columns": rows,
        "quantities": [_quantity(name) for name in (*KINDS, *sorted(numbered))],
        "units": UNITS,
    }


def _quantity(name: str) -> dict[str, str]:
    quantity = base(name)
    si, words = GLOSSARY[quantity].unit, plain_words(quantity)
    return {"name": name, "kind": KINDS[quantity], "words": words, "si": si}


def _row(column: Column, written: Column, columns: Mapping[str, str]) -> dict[str, Any]:
    """Return a column with what it is by its head, by what is said of it, or by what is likely.

    `own` is the quantity in its head, with `own_unit` if that is no part of the head in brackets.
    """
    bare, unit = parts_of(column.head)
    own, own_unit = _parts(column.head)
    said = columns.get(column.head) or columns.get(bare) or ""
    likely = ""
    if not _is_known(own):
        likely = suggested(own, column._replace(unit=unit), with_errors(KINDS))[1]
    name, chosen = _parts(said or likely or own)
    return {
        "head": column.head,
        "letter": column.letter,
        "first": [
            clipped(cell if isinstance(cell, str) else f"{cell:g}")
            for cell in written.cells[:SHOWN_CELLS]
        ],
        "own": own if _is_known(own) else "",
        "own_unit": "" if own_unit == unit else own_unit,
        "fits": [si for si in UNITS if _fits(unit, si)],
        "likely": bool(likely),
        "suggested": bool(likely and not said),
        "name": name if _is_known(name) else "",
        "chosen": chosen if is_unit(chosen) and chosen != unit else "",
    }


def _parts(words: str) -> tuple[str, str]:
    name, unit = parts_of(ALIASES.get(words, words))
    return ALIASES.get(name, name), unit


def _is_known(name: str) -> bool:
    return entry(base(name)) in KINDS


def _fits(unit: str, si: str) -> bool:
    with suppress(InputError):
        return bool(unit) and bool(factor_of("unit", unit, si))
    return False


def plain_words(name: str) -> str:
    """Return what a quantity means, without the marks of formulas."""
    return GLOSSARY[name].meaning.replace("$", "")
