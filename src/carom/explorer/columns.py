"""What the columns of a user's table were taken for."""

from collections.abc import Mapping

from carom.datasets.observables import BEFORE, OBSERVABLES
from carom.fitting import Fit
from carom.fitting.heights import HEIGHTS
from carom.io.columns import entry
from carom.io.user_table import Column
from carom.quantities.glossary import GLOSSARY

KINDS = {
    **dict.fromkeys(BEFORE, "before the impact"),
    **dict.fromkeys(OBSERVABLES, "after the impact"),
    **dict.fromkeys(HEIGHTS, "drop and rebound"),
}


def taken(columns: Mapping[str, Column], found: Fit | None = None) -> list[dict[str, str]]:
    """Return for each column its head, what it was taken for, and the unit it was read in."""
    ignored = () if found is None else found.best.model.problem.ignored
    empty = [name.partition(" ")[0] for name in ignored if "(" in name]
    return [_taken(name, columns[name], entry(name) in empty) for name in columns]


def _taken(name: str, column: Column, empty: bool) -> dict[str, str]:
    quantity = entry(name)
    if quantity not in KINDS:
        return {"head": column.head, "kind": "not used", "meaning": "", "unit": ""}
    si, kind, meaning = GLOSSARY[quantity].unit, KINDS[quantity], plain_words(quantity)
    if name != quantity:
        kind, meaning = "standard deviation", f"of {meaning}"
    if empty:
        kind = "not used: no value in it"
    unit = str(column.unit) or ("" if si == "1" else f"{si} (the head names no unit)")
    return {"head": column.head, "kind": kind, "meaning": meaning, "unit": unit}


def plain_words(name: str) -> str:
    """Return what a quantity means, without the marks of formulas."""
    return GLOSSARY[name].meaning.replace("$", "")
