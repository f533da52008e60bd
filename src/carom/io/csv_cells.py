"""The cells of a user's CSV file, read in parts: strictly, and within limits that are told."""

import csv
import re
from array import array
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from io import StringIO
from pathlib import Path
from typing import Any, NamedTuple, TextIO
from warnings import catch_warnings, simplefilter

import numpy as np
from numpy.typing import NDArray

from carom.io.paths import opened
from carom.io.progress import advancing
from carom.quantities.arrays import plain_numbers
from carom.quantities.refusals import InputError, refusal

COMMENT = re.compile(r"#\s*([A-Za-z]\w*)\s*:\s*(.*)")
SPREADSHEET_ERRORS = ("#N/A", "#DIV/0!", "#VALUE!", "#REF!", "#NAME?", "#NUM!", "#NULL!")
SEPARATORS = ",;\t"
TOLD = re.compile(rf"sep=([{SEPARATORS}])\s*", re.IGNORECASE)  # with which Excel begins a file
BLOCK = 1 << 22  # characters that are texts at a time, before their numbers are
PLAIN = {mark: re.compile(rf"[0-9.+\-eE \n{mark}]*") for mark in SEPARATORS}
TINY = re.compile(r"[eE]-[0-9]{3}|[0-9.]{200}")
MOST_COLUMNS = 1000
MOST_ROWS = 10_000_000
LONGEST_LINE = 1_000_000  # characters


class CsvCells(NamedTuple):
    """What a CSV file holds: heads, columns, the line of each row, and the comments by key.

    A column is an array where all its cells are plain numbers, else a list of texts and numbers.
    """

    heads: list[str]
    columns: list[Any]
    lines: NDArray[np.int64]
    comments: dict[str, str]


@dataclass
class _File:
    """A file that is read: what it is called, how far it is read, and what was found."""

    what: str
    path: Path
    text: TextIO
    line: int = 0
    separator: str = ""
    lines: "array[int]" = field(default_factory=lambda: array("q"))
    comments: dict[str, str] = field(default_factory=dict)

    def head(self) -> str:
        """Return the first line that has cells; find what separates them."""
        while line := self.text.readline(LONGEST_LINE + 1):
            self.line += 1
            self.check(line)
            if self.line == 1 and (told := TOLD.fullmatch(line)):
                self.separator = told[1]
            elif self.has_cells(line):
                self.separator = self.separator or max(SEPARATORS, key=line.count)
                return line
        raise self.refusal("it is empty; there must be a header and numbers")

    def blocks(self) -> Iterator[str]:
        """Return the rest in parts of whole lines."""
        left = ""
        while text := self.text.read(BLOCK):
            whole, end, tail = text.rpartition("\n")
            if end:
                yield f"{left}{whole}\n"
            left = tail if end else left + tail
            self.check(left)
        if left:
            yield f"{left}\n"

    def has_cells(self, line: str) -> bool:
        """Return whether a line is neither empty nor a comment; of comments the first counts."""
        text = line.strip()
        if match := COMMENT.fullmatch(text):
            self.comments.setdefault(match[1].lower(), match[2].strip())
        return bool(text) and (not text.startswith("#") or text.startswith(SPREADSHEET_ERRORS))

    def check(self, line: str) -> None:
        """Raise InputError for a line that is too long, or no text."""
        if "\0" in line:
            raise self.refusal("it is not text; give a CSV file")
        if len(line) > LONGEST_LINE:
            raise self.refusal(f"a line has more than {LONGEST_LINE} characters")

    def refusal(self, allowed: str) -> InputError:
        """Return the error that refuses the file."""
        return refusal(self.what, str(self.path), allowed)


def read_csv(what: str, path: Path, fewest: int = 2) -> CsvCells:
    """Return the cells of a CSV file; columns are separated by commas, semicolons or tabs.

    Raises InputError, in which the file is called `what`, if it cannot be read, is not such a file,
    or has fewer columns than are allowed.
    """
    try:
        with opened(path, encoding="utf-8-sig") as text:
            return _read(_File(what, path, text), fewest)
    except OSError as error:
        reason = error.strerror or error
        raise InputError(f"{what}: {str(path)!r} cannot be read; {reason}") from None
    except UnicodeDecodeError:
        allowed = "it is not text in UTF-8; give a CSV file"
        raise refusal(what, str(path), allowed) from None


def _read(file: _File, fewest: int) -> CsvCells:
    first = file.head()
    separator = file.separator
    heads = [text.strip() for text in _cells(file, [first], separator)[0]]
    if len(heads) < fewest:
        fewer = "" if fewest == 1 else f", at least {fewest}"
        allowed = f"give columns separated by commas, semicolons or tabs{fewer}"
        raise file.refusal(f"it is not CSV; {allowed}")
    _check_heads(file, heads)
    parts: list[list[Any]] = [[] for _ in heads]
    with advancing("reading the table", None, unit="rows") as advance:
        for block in file.blocks():
            before = len(file.lines)
            columns = _quickly(file, block, separator, len(heads))
            if columns is None:
                columns = _cell_by_cell(file, block, separator, len(heads))
            for part, column in zip(parts, columns, strict=True):
                part.append(column)
            if len(file.lines) > MOST_ROWS:
                raise file.refusal(f"it has more than {MOST_ROWS} rows")
            advance(len(file.lines) - before)
    columns = [_joined(part) for part in parts]
    return CsvCells(heads, columns, np.array(file.lines, np.int64), file.comments)


def _check_heads(file: _File, heads: Sequence[str]) -> None:
    """Raise InputError if a header is none: too many names, or numbers."""
    if len(heads) > MOST_COLUMNS:
        raise file.refusal(f"it has {len(heads)} columns; at most {MOST_COLUMNS} are allowed")
    if plain_numbers(heads) is not None:
        raise InputError(
            f"{file.what}: the first line holds numbers; put a line without # before it that "
            "names the columns, e.g. psi_1,psi_2,chi"
        )


def _quickly(file: _File, block: str, separator: str, width: int) -> Sequence[Any] | None:
    """Return the columns of lines that hold nothing but plain numbers, else None.

    Of these letters NumPy reads the numbers of the grammar alone, but for those that round to zero.
    """
    rows = block.count("\n")
    if PLAIN[separator].fullmatch(block) is None or TINY.search(block):
        return None
    if block.count(separator) != rows * (width - 1):
        return None
    try:
        with catch_warnings():
            simplefilter("error")  # of empty input
            found = np.loadtxt(StringIO(block), delimiter=separator, comments=None, ndmin=2)
    except (ValueError, UserWarning):
        return None
    if found.shape != (rows, width) or not np.all(np.isfinite(found)):
        return None
    file.lines.extend(range(file.line + 1, file.line + 1 + rows))
    file.line += rows
    return list(np.ascontiguousarray(found.T))


def _cell_by_cell(file: _File, block: str, separator: str, width: int) -> Sequence[Any]:
    """Return the columns of some lines: arrays of plain numbers, else texts."""
    held = []
    for line in block.split("\n")[:-1]:
        file.line += 1
        file.check(line)
        if file.has_cells(line):
            held.append(line)
            file.lines.append(file.line)
    rows = _cells(file, held, separator)
    for place, row in zip(file.lines[len(file.lines) - len(held) :], rows, strict=True):
        if len(row) != width:
            message = f"has {len(row)} values, the header has {width} names"
            raise file.refusal(f"it is not CSV; line {place} {message}")
    columns = list(zip(*rows, strict=True)) if rows else [()] * width
    numbers = [plain_numbers(cells) for cells in columns]
    return [cells if n is None else n for cells, n in zip(columns, numbers, strict=True)]


def _cells(file: _File, lines: list[str], separator: str) -> list[list[str]]:
    """Return the cells of lines, each a row of its own."""
    how: dict[str, Any] = {"delimiter": separator, "skipinitialspace": True, "strict": True}
    try:
        rows = list(csv.reader(lines, **how))
    except csv.Error as error:
        raise file.refusal(f"it is not CSV; {error}") from None
    if len(rows) != len(lines):
        raise file.refusal("it is not CSV; a text in quotes extends over several lines")
    return rows


def _joined(parts: list[Any]) -> Any:
    if parts and all(isinstance(part, np.ndarray) for part in parts):
        return np.concatenate(parts)
    return [cell for part in parts for cell in (part if isinstance(part, tuple) else part.tolist())]
