"""By which code and which contact law results were computed, as files or arguments tell."""

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.io.cells import GAP, Column
from carom.io.user_table import UserTable
from carom.quantities.refusals import refusal

NAMES = ("code", "law")  # columns, or comments "# code: ..." of a file
MOST_ORIGINS = 8  # that are told apart in one table
LONGEST_NAME = 60
NO_NAME = ("", GAP, "nan", "None")


class Origin(NamedTuple):
    """The name of a code and that of a contact law, empty where it is not known."""

    code: str = ""
    law: str = ""

    @property
    def label(self) -> str:
        """Both names, "" for none."""
        return ", ".join(filter(None, self))


class Origins(NamedTuple):
    """The distinct origins of results in their order, and the places there of those of all rows."""

    distinct: tuple[Origin, ...]
    places: NDArray[np.int64]


def origins_of(
    table: UserTable, names: Mapping[str, Any], most: int = MOST_ORIGINS
) -> tuple[Origins, tuple[str, ...]]:
    """Return the origins of the rows of a table, and notes on columns that do not tell them.

    Given names count for all rows, else columns, else comments; names that differ are left out if
    there are more than `most`; with one, all rows are one impact.
    """
    rows = len(table.rows)
    columns = {name: _names(name, names[name], table) for name in NAMES}
    varied = [name for name, column in columns.items() if len(set(column)) > 1]
    notes: tuple[str, ...] = ()
    pairs = [*zip(*(each * (rows // len(each)) for each in columns.values()), strict=True)]
    distinct = {pair: place for place, pair in enumerate(dict.fromkeys(pairs))}
    if varied and len(distinct) > most:
        words = f"the names in {' and '.join(varied)} are left out: {len(distinct)} of them"
        notes = (f"{words}, at most {most} are told apart",)
        pairs = [tuple("" if name in varied else columns[name][0] for name in NAMES)] * rows
        distinct = {pairs[0]: 0}
    places = np.array([distinct[pair] for pair in pairs], dtype=np.int64)
    origins = tuple(Origin(*pair) for pair in distinct)
    return Origins(origins, places if most > 1 else places[:1]), notes


def _names(name: str, value: Any, table: UserTable) -> list[str]:
    """Return a name for every row of a table, or one for all."""
    if value is not None:
        if not isinstance(value, str) or not _clean(value):
            raise refusal(name, value, "must be a text, e.g. 'mindlin'")
        return [_clean(value)]
    column = table.cells.get(name, Column(name, (), "", "none"))
    if column.fault:
        return [_clean(table.comments.get(name, ""))]
    cells = [_clean(cell) for cell in column.cells]
    return cells if len(set(cells)) > 1 else cells[:1]


def _clean(cell: Any) -> str:
    """Return a name in one line, "" for none."""
    text = f"{cell:g}" if isinstance(cell, float) else str(cell)
    line = " ".join("".join(c if c.isprintable() else " " for c in text).split())
    return "" if line in NO_NAME else line[:LONGEST_NAME]
