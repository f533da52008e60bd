"""Reading a user's results: a CSV file, a mapping of columns or a data frame, in SI units."""

import csv
import json
import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.glossary import GLOSSARY
from carom.quantities import InputError, nearest, number, refusal

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

ALIASES = {"psi_1": "psi_in", "psi_2": "psi_out", "angle_deg": "angle [deg]"}
SPELLINGS = {name: alias for alias, name in ALIASES.items()}
CASE = "# case:"  # begins a comment that holds the bodies as JSON
HEAD = re.compile(r"\s*(.*?)\s*(?:\[(.*)\]|\((.*)\))?\s*")
PLAIN = ("", "-", "1")  # units of what has none
DELETE = "correct or delete what is there"
SHOWN = 5  # rows that a message names


@dataclass(frozen=True, eq=False)
class Results:
    """Columns of results in SI units, and what their rows are called: lines of a file, or rows."""

    columns: Mapping[str, Array]
    rows: NDArray[np.int64]
    word: str

    def named(self, where: Mask) -> str:
        """Return the rows where something is so, e.g. "lines 3, 7 and 9"."""
        return named(self.word, self.rows[where], len(self))

    def one(self, index: int) -> str:
        """Return what one row is called, e.g. "line 3"."""
        return named(self.word, self.rows[index : index + 1])

    def __len__(self) -> int:
        return len(self.rows)

    def __getitem__(self, name: str) -> Any:
        return self.columns[name]

    def get(self, name: str, default: Any) -> Any:
        """Return a column, or something else if there is none of that name."""
        return self.columns.get(name, default)

    def require(self, *names: str) -> None:
        """Raise InputError for a column that is missing, with the nearest of those there are."""
        for name in names:
            if name not in self.columns:
                there = [spelled(key) for key in self.columns if key not in names]
                hint = nearest(spelled(name), there) or f"found {', '.join(there) or 'no other'};"
                needed = ", ".join(spelled(key) for key in names)
                raise InputError(f"{spelled(name)}: column missing; {hint} needed are {needed}")

    def refuse(self, name: str, bad: Mask, allowed: str) -> None:
        """Raise InputError for a column that is bad in some rows, naming them."""
        if bad.any():
            value = f"{float(self[name][bad][0]):g}"
            where = self.named(bad)
            raise InputError(f"{spelled(name)}: {value} in {where} cannot be used; {allowed}")


def spelled(name: str) -> str:
    """Return how a user may call a column."""
    return SPELLINGS.get(name, name)


def named(word: str, rows: Iterable[int], total: int = 0) -> str:
    """Return rows in words, of so many in total.

    Examples
    --------
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


class Table(NamedTuple):
    """Cells as given, by head of column, what the rows are called, and the case if it is there."""

    cells: Mapping[str, Any]
    rows: NDArray[np.int64]
    word: str
    case: Mapping[str, Any] | None = None

    @property
    def names(self) -> tuple[str, ...]:
        """The names of the columns, without units."""
        return tuple(name_and_unit(head)[0] for head in self.cells)


def read_table(source: Any) -> Table:
    """Return the cells of a CSV file, a mapping of columns or a data frame.

    Raises InputError if it cannot be read, has no rows, columns of one name or unequal length.
    """
    if isinstance(source, str | Path):
        table = _read_csv(Path(source))
    elif hasattr(source, "items"):  # a data frame, too
        cells = _columns(source)
        rows = np.arange(1, 1 + len(next(iter(cells.values()), [])))
        table = Table(cells, rows, "row")
    else:
        raise refusal("results", source, "must be the name of a CSV file, or columns by name")
    if not len(table.rows):
        raise InputError("results: no rows; there must be names of columns, and numbers below them")
    _check_once(table.names)
    return table


def in_units(table: Table, known: Iterable[str]) -> Results:
    """Return the columns whose names are known, in SI units; the others are there, but NaN.

    Raises InputError for a cell of them that is not a number, or a unit that does not fit.
    """
    columns: dict[str, Array] = {}
    for head, cells in table.cells.items():
        name, unit = name_and_unit(head)
        if name not in known:
            columns[name] = np.full(len(table.rows), np.nan)
            continue
        columns[name], reason = _numbers(name, unit, cells)
        missing = ~np.isfinite(columns[name])
        if missing.any():
            where = named(table.word, table.rows[missing])
            raise InputError(f"{spelled(name)}: not a number in {where}; {reason or DELETE}")
    return Results(columns, table.rows, table.word)


def _read_csv(path: Path) -> Table:
    text = _text(path)
    lines = [
        (place, line)
        for place, line in enumerate(text.splitlines(), 1)
        if line.strip() and not line.lstrip().startswith("#")
    ]
    if not lines:
        raise refusal("results", str(path), "it is empty; there must be a header and numbers")
    try:
        cells = list(csv.reader((line for _, line in lines), skipinitialspace=True, strict=True))
    except csv.Error as error:
        raise refusal("results", str(path), f"it is not CSV; {error}") from None
    head, body = [text.strip() for text in cells[0]], cells[1:]
    if len(cells) != len(lines) or len(head) < 2:
        raise refusal("results", str(path), "it is not CSV; give columns separated by commas")
    _check_head(head)
    for (place, _), row in zip(lines[1:], body, strict=True):
        if len(row) != len(head):
            message = f"line {place} has {len(row)} values, the header has {len(head)} names"
            raise refusal("results", str(path), f"it is not CSV; {message}")
    table = {name: [row[i] for row in body] for i, name in enumerate(head)}
    places = np.array([place for place, _ in lines[1:]], dtype=np.int64)
    return Table(table, places, "line", _case_in(text, path))


def _case_in(text: str, path: Path) -> Mapping[str, Any] | None:
    """Return the case that a comment holds, if any."""
    for line in text.splitlines():
        if line.startswith(CASE):
            try:
                return dict(json.loads(line.removeprefix(CASE)))
            except (ValueError, TypeError):
                raise refusal("results", str(path), f"after '{CASE}' there is no JSON") from None
    return None


def _text(path: Path) -> str:
    try:
        text = path.read_bytes().decode("utf-8-sig")
    except OSError as error:
        reason = error.strerror or error
        raise refusal("results", str(path), f"it cannot be read; {reason}") from None
    except UnicodeDecodeError:
        raise refusal("results", str(path), "it is not text; give a CSV file") from None
    if "\0" in text:
        raise refusal("results", str(path), "it is not text; give a CSV file")
    return text


def _check_head(head: list[str]) -> None:
    """Raise InputError if a header is none: numbers, or a name twice."""
    if all(_is_number(text) for text in head):
        raise InputError(
            "results: the first line holds numbers; before it a line, without #, must name the "
            "columns, e.g. psi_1,psi_2,chi"
        )
    _check_once(head)


def _check_once(names: Sequence[str]) -> None:
    twice = [name for i, name in enumerate(names) if name in names[:i]]
    if twice:
        raise InputError(f"{spelled(twice[0])!r}: two columns of this name; leave one of them out")


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True


def _columns(source: Any) -> dict[str, Any]:
    table = {str(name): _line(str(name), values) for name, values in source.items()}
    lengths = {name: len(values) for name, values in table.items()}
    if len(set(lengths.values())) > 1:
        listed = ", ".join(f"{name} {length}" for name, length in lengths.items())
        raise InputError(f"results: columns must be equally long; rows are {listed}")
    return table


def _line(name: str, values: Any) -> Any:
    if isinstance(values, np.ma.MaskedArray):
        values = np.ma.filled(values.astype(np.float64), np.nan)
    if np.ndim(values) != 1:
        raise refusal(name, values, "a column must be a list of numbers")
    return list(values)


def name_and_unit(head: str) -> tuple[str, str]:
    """Return name and unit of a column from its head, "spin [rpm]" or "spin (rpm)"."""
    head = ALIASES.get(head.strip(), head)
    match = HEAD.fullmatch(head)
    name, unit = (match[1], match[2] or match[3] or "") if match else (head, "")
    return ALIASES.get(name, name), "" if unit in PLAIN else unit


def entry(name: str) -> str:
    """Return the name in the glossary of what a column holds.

    Examples
    --------
    >>> entry("normal_speed_out"), entry("spin_out")
    ('normal_speed', 'spin_out')
    """
    return name if name in GLOSSARY else name.removesuffix("_out")


def _numbers(name: str, unit: str, cells: list[Any]) -> tuple[Array, str]:
    """Return a column in SI units, NaN where there is no number, and what is wrong there first."""
    scale = number(spelled(name), f"1 {unit}", GLOSSARY[entry(name)].unit) if unit else 1.0
    try:
        return np.array(cells, dtype=np.float64) * scale, ""
    except (TypeError, ValueError):
        pass
    values, reason = np.full(len(cells), np.nan), ""
    for i, cell in enumerate(cells):
        try:
            values[i] = _cell(name, cell, scale)
        except InputError as error:
            reason = reason or str(error)
    return values, reason


def _cell(name: str, cell: Any, scale: float) -> float:
    """Return one number, NaN for an empty cell; a text with a unit of its own has that unit."""
    if cell is None or (isinstance(cell, str) and not cell.strip()):
        return float("nan")
    try:
        return float(cell) * scale
    except (TypeError, ValueError):
        return number(spelled(name), cell, GLOSSARY[entry(name)].unit)
