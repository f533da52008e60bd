"""By which code and which contact law results were computed, as files or arguments tell."""

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.io.tables import GAP
from carom.io.user_table import Column, UserTable
from carom.quantities.refusals import refusal

NAMES = ("code", "law")  # columns, or comments "# code: ..." of a file
MOST = 8  # that are told apart in one table
LONGEST = 60  # characters of a name
UNTOLD = ("", GAP, "nan", "None")


class Origin(NamedTuple):
    """The name of a code and that of a contact law, empty where it is not known."""

    code: str = ""
    law: str = ""

    @property
    def label(self) -> str:
        """Both names, "" for none."""
        return ", ".join(filter(None, self))


NOBODY = Origin()


class Origins(NamedTuple):
    """The origins of results in the order in which they come, and the place of each row's there."""

    known: tuple[Origin, ...]
    places: NDArray[np.int64]


def of_all(rows: int, one: Origin = NOBODY) -> Origins:
    """Return one origin for all results, by default none."""
    return Origins((one,), np.zeros(rows, dtype=np.int64))


def origins_of(
    table: UserTable, given: Mapping[str, Any], most: int = MOST
) -> tuple[Origins, tuple[str, ...]]:
    """Return the origins of the rows of a table, and notes on columns that do not tell them.

    Names that are given count for all rows; else columns do, and else comments of the file. Names
    that differ are left out if there are more than `most`; with one, all rows are one impact.
    """
    rows = len(table.rows) if most > 1 else 1
    names = [_named(name, given[name], table) for name in NAMES]
    varied = [name for name, each in zip(NAMES, names, strict=True) if len(set(each)) > 1]
    if not varied:
        one = Origin(*(each[0] for each in names))
        return of_all(rows, one), ()
    pairs = [*zip(*(each * (len(table.rows) // len(each)) for each in names), strict=True)]
    known = {pair: place for place, pair in enumerate(dict.fromkeys(pairs))}
    if len(known) <= most:
        places = np.array([known[pair] for pair in pairs], dtype=np.int64)
        return Origins(tuple(Origin(*pair) for pair in known), places), ()
    one = Origin(*("" if n in varied else each[0] for n, each in zip(NAMES, names, strict=True)))
    told = f"the names in {' and '.join(varied)} are left out: {len(known)} of them"
    notes = (f"{told}, at most {most} are told apart",)
    return of_all(rows, one), notes


def _named(name: str, given: Any, table: UserTable) -> list[str]:
    """Return a name for every row of a table, or one for all."""
    if given is not None:
        if not isinstance(given, str) or not _clean(given):
            raise refusal(name, given, "must be a text, e.g. 'mindlin'")
        return [_clean(given)]
    column = table.cells.get(name, Column(name, (), "", "none"))
    if column.fault:
        return [_clean(table.comments.get(name, ""))]
    found = [_clean(cell) for cell in column.cells]
    return found if len(set(found)) > 1 else found[:1]


def _clean(cell: Any) -> str:
    """Return a name in one line, "" for none."""
    text = f"{cell:g}" if isinstance(cell, float) else str(cell)
    line = " ".join("".join(c if c.isprintable() else " " for c in text).split())
    return "" if line in UNTOLD else line[:LONGEST]
