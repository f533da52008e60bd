"""Rows and cells of a table: what they are called, which cells are empty, and what a column is."""

import re
from collections.abc import Iterable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

Mask = NDArray[np.bool_]

GAP = "-"
NOT_AVAILABLE = ("#n/a", "#nv", "#n/d")  # in cells of spreadsheets, English, German, Spanish
MISSING = ("", GAP, "\N{EN DASH}", "\N{EM DASH}", "nan", "na", "n/a", *NOT_AVAILABLE)
ERROR_CELL = re.compile(r'#(?:N/A|NV|N/D|[A-ZÄÖÜ/0-9]{2,}[!?])(?=$|["\t,;])|Err:\d')  # #DIV/0!
MISSING_TYPES = ("NAType", "NaTType", "MaskedConstant")  # of pandas, of NumPy
MOST_NAMED_ROWS = 5  # that a message names
LETTERS = 26


class Column(NamedTuple):
    """Head and cells as given, an array of numbers or a list, and a unit: a text or one of pint's.

    The letter is that of the column in a file. If there is a fault, it is no column; that is told
    to whoever asks for it.
    """

    head: str
    cells: Any
    unit: Any = ""
    fault: str = ""
    letter: str = ""

    @property
    def missing(self) -> Mask:
        """Where a cell is empty."""
        if isinstance(self.cells, np.ndarray):
            return np.asarray(np.isnan(self.cells))
        return np.fromiter(map(is_missing, self.cells), np.bool_, len(self.cells))

    @property
    def is_bare(self) -> bool:
        """Whether neither the column has a unit nor all its cells have."""
        numbers = (str(cell).strip()[-1:].isdigit() for cell in self.cells)
        return not str(self.unit) and (not isinstance(self.cells, list) or any(numbers))


class Rows:
    """Rows by their numbers, and what they are called: lines of a file, or rows."""

    rows: NDArray[np.int64]
    word: str

    def named(self, where: Mask) -> str:
        """Return the rows where something is so, e.g. "lines 3, 7 and 9"."""
        return named(self.word, self.rows[where], len(self.rows))

    def one(self, index: int) -> str:
        """Return what one row is called, e.g. "line 3"."""
        return named(self.word, self.rows[index : index + 1])


def named(word: str, rows: Iterable[object], total: int = 0) -> str:
    """Return rows, or cells, in words, of so many in total.

    Examples
    --------
    >>> named("line", [3]), named("row", [1, 2, 5]), named("row", [1, 2], 2)
    ('line 3', 'rows 1, 2 and 5', 'every row')
    """
    texts = [str(row) for row in rows]
    if len(texts) == total > 1:
        return f"every {word}"
    if len(texts) > MOST_NAMED_ROWS + 1:
        texts = [*texts[:MOST_NAMED_ROWS], f"{len(texts) - MOST_NAMED_ROWS} more"]
    if len(texts) < 2:
        return " ".join([word, *texts])
    return f"{word}s {', '.join(texts[:-1])} and {texts[-1]}"


def letter_of(place: int) -> str:
    """Return how a spreadsheet calls a column, counted from 0: C is 2, AA is 26."""
    more, last = divmod(place, LETTERS)
    return (letter_of(more - 1) if more else "") + chr(ord("A") + last)


def is_missing(cell: Any) -> bool:
    """Tell whether nothing was measured: the cell is blank, or it says NaN, NA, n/a or a dash."""
    if isinstance(cell, str):
        return cell.strip().lower() in MISSING
    if isinstance(cell, float | np.floating | np.datetime64 | np.timedelta64):
        return bool(cell != cell)
    return cell is None or type(cell).__name__ in MISSING_TYPES


def is_nan(cell: Any) -> bool:
    """Tell whether a cell is the number NaN, or says so: as programs write what they cannot."""
    if isinstance(cell, str):
        return cell.strip().lower() == "nan"
    return isinstance(cell, float | np.floating) and bool(cell != cell)


def is_blank(cell: Any) -> bool:
    """Tell whether a cell has nothing in it."""
    return not (cell.strip() if isinstance(cell, str) else cell is not None)
