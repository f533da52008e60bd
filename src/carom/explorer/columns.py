"""What the columns of a user's table were taken for."""

from collections.abc import Iterable
from typing import NamedTuple

from carom.datasets.observables import BEFORE, OBSERVABLES
from carom.fitting import Fit
from carom.fitting.heights import HEIGHTS
from carom.io.columns import ERROR, entry
from carom.quantities.glossary import GLOSSARY

KINDS = {
    **dict.fromkeys(BEFORE, "before the impact"),
    **dict.fromkeys(OBSERVABLES, "after the impact"),
    **dict.fromkeys(HEIGHTS, "drop and rebound"),
}


class Given(NamedTuple):
    """A column of a table: its head as it stands there, its name and unit as they were read."""

    head: str
    name: str
    unit: str

    @property
    def is_result(self) -> bool:
        """Whether it tells of the motion after an impact."""
        return self.name in (*OBSERVABLES, *HEIGHTS)


def taken(columns: Iterable[Given], found: Fit | None = None) -> list[dict[str, str]]:
    """Return for each column its head, what it was taken for, and the unit it was read in."""
    ignored = () if found is None else found.best.model.problem.ignored
    empty = [name.partition(" ")[0] for name in ignored if "(" in name]
    return [_taken(column, entry(column.name) in empty) for column in columns]


def _taken(column: Given, empty: bool) -> dict[str, str]:
    quantity = entry(column.name)
    if quantity not in KINDS:
        return {"head": column.head, "kind": "not used", "meaning": "", "unit": ""}
    known = GLOSSARY[quantity]
    kind, meaning = KINDS[quantity], plain_words(quantity)
    if column.name.endswith(ERROR):
        kind, meaning = "standard deviation", f"of {meaning}"
    if empty:
        kind = "not used: no value in it"
    return {
        "head": column.head,
        "kind": kind,
        "meaning": meaning,
        "unit": _unit(column, known.unit),
    }


def plain_words(name: str) -> str:
    """Return what a quantity means, without the marks of formulas."""
    return GLOSSARY[name].meaning.replace("$", "")


def _unit(column: Given, si: str) -> str:
    if column.unit:
        return column.unit
    return "" if si == "1" else f"{si} (the head names no unit)"
