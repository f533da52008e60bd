"""The cells of a user's table: a CSV file, a mapping of columns, a data frame, a dataset."""

import json
import re
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.io.csv_cells import MOST_COLUMNS, read_csv
from carom.io.paths import checked_path
from carom.quantities.refusals import InputError, clipped, nearest, refusal
from carom.quantities.texts import LONGEST

ALIASES = {"psi_1": "psi_in", "psi_2": "psi_out", "angle_deg": "angle [deg]"}
SPELLINGS = {name: alias for alias, name in ALIASES.items()}
CASE = "# case:"  # begins a comment that holds the bodies as JSON
KEPT = ("case", "doi")  # attributes of a dataset that are comments of a file
HEAD = re.compile(r"\s*(.*?)\s*(?:\[(.*)\]|\((.*)\))?\s*")
PLAIN = ("", "-", "1")  # units of what has none
GAP = "-"  # a cell of what was not measured
SHOWN = 5  # rows that a message names


class Rows:
    """Rows by their numbers, and what they are called: lines of a file, or rows."""

    rows: NDArray[np.int64]
    word: str

    def named(self, where: NDArray[np.bool_]) -> str:
        """Return the rows where something is so, e.g. "lines 3, 7 and 9"."""
        return named(self.word, self.rows[where], len(self.rows))

    def one(self, index: int) -> str:
        """Return what one row is called, e.g. "line 3"."""
        return named(self.word, self.rows[index : index + 1])


@dataclass(frozen=True, eq=False)
class Cells(Rows):
    """Cells as given, by head of column, what the rows are called, and the comments by key."""

    cells: Mapping[str, Any]
    rows: NDArray[np.int64]
    word: str
    comments: Mapping[str, str]

    @property
    def names(self) -> tuple[str, ...]:
        """The names of the columns, without units."""
        return tuple(name_and_unit(head)[0] for head in self.cells)

    @property
    def case(self) -> Mapping[str, Any] | None:
        """The bodies as a comment holds them, if any; InputError if that is not JSON."""
        if "case" not in self.comments:
            return None
        try:
            return dict(json.loads(self.comments["case"], object_pairs_hook=_given_once))
        except InputError:
            raise
        except (ValueError, TypeError, RecursionError):
            raise InputError(f"results: after '{CASE}' there is no JSON of the bodies") from None


def read_table(
    source: Any, columns: Mapping[str, str] | None = None, *, what: str = "results", fewest: int = 2
) -> Cells:
    """Return the cells of a CSV file, a mapping of columns, a data frame or an xarray dataset.

    A file has a header, at least so many columns separated by commas, semicolons or tabs, and
    comments after #. `columns` tells what heads stand for, {"omega [rpm]": "spin_out"}.

    Raises InputError, in which the table is called `what`, if it cannot be read, has no rows, too
    many columns, or columns of one name or unequal length.

    Examples
    --------
    >>> from carom.io.tables import read_table
    >>> table = read_table({"angle [deg]": [10.0, 20.0], "omega": [-2.0, -5.0]}, {"omega": "spin"})
    >>> table.names, table.word, len(table.rows)
    (('angle', 'spin'), 'row', 2)
    """
    if isinstance(source, str | Path):
        found = read_csv(what, checked_path(what, source), fewest)
        heads, cells = found.heads, found.columns
        table = Cells({}, found.lines, "line", found.comments)
    else:
        table = _counted(what, *_columns_of(what, source))
        heads, cells = list(table.cells), list(table.cells.values())
    heads = _renamed(heads, _checked_columns(columns), what)
    _check_names(what, [name_and_unit(head)[0] for head in heads])
    if not len(table.rows):
        raise InputError(f"{what}: no rows; there must be names of columns, and numbers below them")
    return replace(table, cells=dict(zip(heads, cells, strict=True)))


def _columns_of(what: str, source: Any) -> tuple[Any, dict[str, str]]:
    """Return the columns of what is no file, and its comments."""
    if hasattr(source, "data_vars"):
        return _of_dataset(source), {n: source.attrs[n] for n in KEPT if n in source.attrs}
    if not hasattr(source, "items"):  # which a data frame has, too
        raise refusal(what, source, "must be the name of a CSV file, or columns by name")
    if len(source.keys()) > MOST_COLUMNS:
        raise refusal(what, f"{len(source.keys())} columns", f"{MOST_COLUMNS} are read at most")
    return source, {}


def _checked_columns(columns: Any) -> Mapping[str, str]:
    names = {} if columns is None else columns
    if not isinstance(names, Mapping) or not all(isinstance(n, str) for n in names.values()):
        example = "{'omega': 'spin_out'}"
        raise refusal("columns", columns, f"must tell what names stand for, e.g. {example}")
    return names


def name_and_unit(head: str) -> tuple[str, str]:
    """Return name and unit of a column from its head, "spin [rpm]" or "spin (rpm)"."""
    name, unit = _parts(ALIASES.get(head.strip(), head))
    return ALIASES.get(name, name), "" if unit in PLAIN else unit


def _given_once(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    """Return an object of JSON, or raise InputError for keys that are alike: it takes the last."""
    for name, count in Counter(name for name, _ in pairs).items():
        if count > 1:
            words = f"it is given twice after '{CASE}'; leave one of them out"
            raise InputError(f"{clipped(name)}: {words}")
    return dict(pairs)


def spelled(name: str) -> str:
    """Return how a user may call a column."""
    return SPELLINGS.get(name, name)


def named(word: str, rows: Iterable[int], total: int = 0) -> str:
    """Return rows in words, of so many in total.

    Examples
    --------
    >>> from carom.io.tables import named
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


def _check_names(what: str, names: Sequence[str]) -> None:
    """Raise InputError for more columns than are read, and for names given twice."""
    if len(names) > MOST_COLUMNS:
        raise refusal(what, f"{len(names)} columns", f"{MOST_COLUMNS} are read at most")
    twice = [spelled(name) for name, count in Counter(names).items() if count > 1]
    if twice:
        listed = " and ".join(map(repr, twice))
        raise InputError(f"{listed}: two columns of this name; leave one of them out")


def _renamed(heads: Iterable[str], columns: Mapping[str, str], what: str) -> list[str]:
    """Return heads in which users' names are replaced by Carom's; a unit stays unless it is told.

    Raises InputError for a name that no column has.
    """
    heads, left, new = list(heads), dict(columns), []
    for head in heads:
        name, unit = _parts(head)
        wanted = left.pop(head, None) or left.pop(name, None)
        own = unit and wanted and not _parts(wanted)[1]
        new.append(head if wanted is None else f"{wanted} [{unit}]" if own else wanted)
    for name in left:
        hint = nearest(name, heads) or f"found are {', '.join(heads)}"
        raise refusal("columns", name, f"{what} has no column of that name; {hint}")
    return new


def _parts(head: str) -> tuple[str, str]:
    """Return what stands before and in the brackets of a head."""
    match = HEAD.fullmatch(head) if len(head) <= LONGEST else None
    return (match[1], match[2] or match[3] or "") if match else (head, "")


def _counted(what: str, source: Any, comments: Mapping[str, str]) -> Cells:
    """Return columns as cells whose rows are counted from 1."""
    cells = dict(_with_unit(str(name), values) for name, values in source.items())
    require_equal_lengths(what, cells)
    rows = np.arange(1, 1 + len(next(iter(cells.values()), [])))
    return Cells(cells, rows, "row", comments)


def _with_unit(name: str, values: Any) -> tuple[str, Any]:
    """Return head and cells of a column; pint's quantities and xarray's arrays tell their unit."""
    unit = ""
    if hasattr(values, "to_root_units"):
        values, unit = values.magnitude, str(values.units)
    elif isinstance(getattr(values, "attrs", None), Mapping):
        unit = str(values.attrs.get("units", ""))
    if unit in (*PLAIN, "dimensionless"):
        return name, _line(name, values)
    if _parts(name)[1]:
        allowed = f"it has two units, {_parts(name)[1]} in its head and {unit}; leave one out"
        raise refusal(name, values, allowed)
    return f"{name} [{unit}]", _line(name, values)


def require_equal_lengths(what: str, columns: Mapping[str, Any]) -> None:
    """Raise InputError for columns that differ in length."""
    lengths = {name: len(values) for name, values in columns.items()}
    if len(set(lengths.values())) > 1:
        listed = ", ".join(f"{name} {length}" for name, length in lengths.items())
        raise InputError(f"{what}: columns must be equally long; rows are {listed}")


def _line(name: str, values: Any) -> Any:
    """Return a column: an array of numbers, or a list of whatever else it holds."""
    if isinstance(values, np.ma.MaskedArray):
        values = np.ma.filled(values.astype(np.float64), np.nan)
    if isinstance(values, str | bytes) or np.ndim(values) != 1:
        raise refusal(name, values, "a column must be a list of numbers")
    kind = getattr(getattr(values, "dtype", None), "kind", "O")
    return np.asarray(values, dtype=np.float64) if kind in "iuf" else list(values)


def _of_dataset(dataset: Any) -> dict[str, list[Any]]:
    """Return the columns of an xarray dataset; what is missing there was not measured."""
    cells = {}
    for name, item in dataset.variables.items():
        if item.ndim == 1:
            head = f"{name} [{item.attrs.get('units', '1')}]"
            cells[head] = [GAP if value != value else value for value in item.values.tolist()]
    return cells
