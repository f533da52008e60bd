"""A table that a user gives: its cells, its columns in SI units, and where each value stands."""

import json
from collections import Counter
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.quantities.arrays import Array
from carom.quantities.faults import Faults
from carom.quantities.refusals import InputError, clipped, nearest
from carom.quantities.units import finite_or_text

Mask = NDArray[np.bool_]

ALIASES = {"psi_1": "psi_in", "psi_2": "psi_out", "angle_deg": "angle [deg]"}
SPELLINGS = {name: alias for alias, name in ALIASES.items()}
CASE = "# case:"  # begins a comment that holds the bodies as JSON
SHOWN = 5  # rows that a message names


class Column(NamedTuple):
    """Head and cells as given, an array of numbers or a list, and a unit: a text or one of pint's.

    If there is a fault, it is no column; that is told to whoever asks for it.
    """

    head: str
    cells: Any
    unit: Any = ""
    fault: str = ""


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


@dataclass(frozen=True, eq=False)
class UserTable(Rows):
    """Columns by name as given, `cells`, and in SI units, `columns`, as far as they were read.

    `rows` are the numbers of the rows, `word` is what they are called, lines of a file or rows,
    and `comments` are those of a file, by key.
    """

    cells: Mapping[str, Column]
    rows: NDArray[np.int64]
    word: str = "row"
    comments: Mapping[str, str] = field(default_factory=dict)
    columns: Mapping[str, Array] = field(default_factory=dict)
    faults: Faults = field(default_factory=Faults)

    def __len__(self) -> int:
        return len(self.rows)

    def __getitem__(self, name: str) -> Any:
        return self.columns[name]

    @property
    def names(self) -> tuple[str, ...]:
        """The names of the columns, without units."""
        return tuple(self.cells)

    def column(self, name: str) -> Column:
        """Return a column as given, or raise InputError if it is none."""
        column = self.cells[name]
        if column.fault:
            raise InputError(f"{spelled(name)}: {column.fault}")
        return column

    @property
    def case(self) -> Mapping[str, Any] | None:
        """The bodies as a comment holds them, if any; InputError if that is not JSON."""
        if "case" not in self.comments:
            return None
        try:
            read = json.loads(
                self.comments["case"],
                parse_float=finite_or_text,
                object_pairs_hook=_with_unique_keys,
            )
            return dict(read)
        except InputError:
            raise
        except (ValueError, TypeError, RecursionError):
            raise InputError(f"results: after '{CASE}' there is no JSON of the bodies") from None

    def require(self, *names: str) -> None:
        """Raise InputError for a column that is missing, with the nearest of those there are."""
        for name in names:
            if name not in self.columns:
                there = [spelled(key) for key in self.columns if key not in names]
                hint = nearest(spelled(name), there) or f"found {', '.join(there) or 'no other'};"
                needed = ", ".join(spelled(key) for key in names)
                raise InputError(f"{spelled(name)}: column missing; {hint} needed are {needed}")

    def require_rows(self, fewest: int) -> None:
        """Raise InputError if there are too few rows."""
        if len(self) < fewest:
            raise InputError(f"results: too few points: {len(self)}, at least {fewest} are needed")

    def refuse(self, name: str, bad: Mask, allowed: str) -> None:
        """Add to the faults that a column is bad in some rows, naming them."""
        if bad.any():
            value = f"{float(self[name][bad][0]):g}"
            where = self.named(bad)
            self.faults.add(f"{spelled(name)}: {value} in {where} cannot be used; {allowed}")


def spelled(name: str) -> str:
    """Return how a user may call a column."""
    return SPELLINGS.get(name, name)


def named(word: str, rows: Iterable[int], total: int = 0) -> str:
    """Return rows in words, of so many in total.

    Examples
    --------
    >>> from carom.io.user_table import named
    >>> named("line", [3]), named("row", [1, 2, 5]), named("row", [1, 2], 2)
    ('line 3', 'rows 1, 2 and 5', 'every row')
    """
    texts = [str(row) for row in rows]
    if len(texts) == total > 1:
        return f"every {word}"
    if len(texts) > SHOWN + 1:
        texts = [*texts[:SHOWN], f"{len(texts) - SHOWN} more"]
    if len(texts) < 2:
        return " ".join([word, *texts])
    return f"{word}s {', '.join(texts[:-1])} and {texts[-1]}"


def _with_unique_keys(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    """Return an object of JSON, or raise InputError for keys that are alike: it takes the last."""
    for name, count in Counter(name for name, _ in pairs).items():
        if count > 1:
            words = f"it is given twice after '{CASE}'; leave one of them out"
            raise InputError(f"{clipped(name)}: {words}")
    return dict(pairs)
