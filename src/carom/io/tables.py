"""The cells of a user's table: a CSV file, a mapping of columns, a data frame, a dataset."""

import csv
import json
import re
from collections.abc import Iterable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.io.files import read_text
from carom.quantities.units import InputError, refusal

ALIASES = {"psi_1": "psi_in", "psi_2": "psi_out", "angle_deg": "angle [deg]"}
SPELLINGS = {name: alias for alias, name in ALIASES.items()}
CASE = "# case:"  # begins a comment that holds the bodies as JSON
KEPT = ("case", "doi")  # attributes of a dataset that are comments of a file
COMMENT = re.compile(r"#\s*([A-Za-z]\w*)\s*:\s*(.*)")
HEAD = re.compile(r"\s*(.*?)\s*(?:\[(.*)\]|\((.*)\))?\s*")
PLAIN = ("", "-", "1")  # units of what has none
SEPARATORS = ",;\t"
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
            return dict(json.loads(self.comments["case"]))
        except (ValueError, TypeError):
            raise InputError(f"results: after '{CASE}' there is no JSON of the bodies") from None


def read_table(source: Any) -> Cells:
    """Return the cells of a CSV file, a mapping of columns, a data frame or an xarray dataset.

    A file has a header, columns separated by commas, semicolons or tabs, and comments after #.

    Raises InputError if it cannot be read, has no rows, columns of one name or unequal length.

    Examples
    --------
    >>> from carom.io.tables import read_table
    >>> table = read_table({"angle [deg]": [10.0, 20.0], "spin_out": [-200.0, -500.0]})
    >>> table.names, table.word, len(table.rows)
    (('angle', 'spin_out'), 'row', 2)
    """
    if isinstance(source, str | Path):
        table = _read_csv(Path(source))
    elif hasattr(source, "data_vars"):
        comments = {name: source.attrs[name] for name in KEPT if name in source.attrs}
        table = _counted(_of_dataset(source), comments)
    elif hasattr(source, "items"):  # a data frame, too
        table = _counted(source, {})
    else:
        raise refusal("results", source, "must be the name of a CSV file, or columns by name")
    if not len(table.rows):
        raise InputError("results: no rows; there must be names of columns, and numbers below them")
    _check_once(table.names)
    return table


def name_and_unit(head: str) -> tuple[str, str]:
    """Return name and unit of a column from its head, "spin [rpm]" or "spin (rpm)"."""
    head = ALIASES.get(head.strip(), head)
    match = HEAD.fullmatch(head)
    name, unit = (match[1], match[2] or match[3] or "") if match else (head, "")
    return ALIASES.get(name, name), "" if unit in PLAIN else unit


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


def _read_csv(path: Path) -> Cells:
    text = _text(path)
    lines = [
        (place, line)
        for place, line in enumerate(text.splitlines(), 1)
        if line.strip() and not line.lstrip().startswith("#")
    ]
    if not lines:
        raise refusal("results", str(path), "it is empty; there must be a header and numbers")
    head, body = _split(path, [line for _, line in lines])
    for (place, _), row in zip(lines[1:], body, strict=True):
        if len(row) != len(head):
            message = f"line {place} has {len(row)} values, the header has {len(head)} names"
            raise refusal("results", str(path), f"it is not CSV; {message}")
    cells = {name: [row[i] for row in body] for i, name in enumerate(head)}
    places = np.array([place for place, _ in lines[1:]], dtype=np.int64)
    return Cells(cells, places, "line", _comments(text))


def _split(path: Path, lines: list[str]) -> tuple[list[str], list[list[str]]]:
    """Return the header and the rows of CSV, separated as the header is."""
    separator = max(SEPARATORS, key=lines[0].count)
    try:
        cells = list(csv.reader(lines, delimiter=separator, skipinitialspace=True, strict=True))
    except csv.Error as error:
        raise refusal("results", str(path), f"it is not CSV; {error}") from None
    head, body = [text.strip() for text in cells[0]], cells[1:]
    if len(cells) != len(lines) or len(head) < 2:
        allowed = "it is not CSV; give columns separated by commas, semicolons or tabs"
        raise refusal("results", str(path), allowed)
    _check_head(head)
    return head, body


def _comments(text: str) -> dict[str, str]:
    """Return the comments "# key: value" by key; the first of a key counts."""
    found = [COMMENT.fullmatch(line.strip()) for line in text.splitlines()]
    return {match[1].lower(): match[2].strip() for match in reversed(found) if match}


def _text(path: Path) -> str:
    try:
        text = read_text("results", path)
    except UnicodeDecodeError:
        raise refusal("results", str(path), "it is not text in UTF-8; give a CSV file") from None
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
    with suppress(ValueError):
        float(text)
        return True
    return False


def _counted(source: Any, comments: Mapping[str, str]) -> Cells:
    """Return columns as cells whose rows are counted from 1."""
    cells = {str(name): _line(str(name), values) for name, values in source.items()}
    require_equal_lengths("results", cells)
    rows = np.arange(1, 1 + len(next(iter(cells.values()), [])))
    return Cells(cells, rows, "row", comments)


def require_equal_lengths(what: str, columns: Mapping[str, Any]) -> None:
    """Raise InputError for columns that differ in length."""
    lengths = {name: len(values) for name, values in columns.items()}
    if len(set(lengths.values())) > 1:
        listed = ", ".join(f"{name} {length}" for name, length in lengths.items())
        raise InputError(f"{what}: columns must be equally long; rows are {listed}")


def _line(name: str, values: Any) -> Any:
    if isinstance(values, np.ma.MaskedArray):
        values = np.ma.filled(values.astype(np.float64), np.nan)
    if np.ndim(values) != 1:
        raise refusal(name, values, "a column must be a list of numbers")
    return list(values)


def _of_dataset(dataset: Any) -> dict[str, list[Any]]:
    """Return the columns of an xarray dataset; what is missing there was not measured."""
    cells = {}
    for name, item in dataset.variables.items():
        if item.ndim == 1:
            head = f"{name} [{item.attrs.get('units', '1')}]"
            cells[head] = [GAP if value != value else value for value in item.values.tolist()]
    return cells
