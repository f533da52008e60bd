"""The cells of a user's CSV file: read strictly, and within limits that are told."""

import csv
import re
from array import array
from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import partial
from itertools import islice
from pathlib import Path
from typing import Any, TextIO

import numpy as np

from carom.io.paths import accessing, opened
from carom.io.progress import advancing
from carom.io.user_table import Column, UserTable
from carom.quantities.arrays import plain_numbers
from carom.quantities.refusals import InputError, refusal, refuse

COMMENT = re.compile(r"#\s*([A-Za-z]\w*)\s*:\s*(.*)")
SPREADSHEET_ERRORS = ("#N/A", "#DIV/0!", "#VALUE!", "#REF!", "#NAME?", "#NUM!", "#NULL!")
SEPARATORS = ",;\t"
NAMED_SEPARATOR = re.compile(rf"sep=([{SEPARATORS}])\s*", re.IGNORECASE)  # Excel's first line
BLOCK_ROWS = 1 << 16  # rows that are texts at a time, before their numbers are
MOST_COLUMNS = 1000
MOST_ROWS = 10_000_000
LONGEST_LINE = 1_000_000  # characters


@dataclass
class _CsvFile:
    """A file while it is read: its name, the numbers of the lines with cells, its comments."""

    what: str
    path: Path
    text: TextIO
    separator: str = ""
    lines: "array[int]" = field(default_factory=lambda: array("q"))
    comments: dict[str, str] = field(default_factory=dict)

    def lines_with_cells(self) -> Iterator[str]:
        """Yield the lines that are neither empty nor comments; of comments the first counts."""
        read_line = partial(self.text.readline, LONGEST_LINE + 1)
        for number, line in enumerate(iter(read_line, ""), 1):
            long = len(line) > LONGEST_LINE and f"a line has more than {LONGEST_LINE} characters"
            if allowed := "it is not text; give a CSV file" if "\0" in line else long:
                raise self.refusal(allowed)
            text = line.strip()
            if number == 1 and (separator := NAMED_SEPARATOR.fullmatch(line)):
                self.separator = separator[1]
            elif text.startswith("#") and not text.startswith(SPREADSHEET_ERRORS):
                if comment := COMMENT.fullmatch(text):
                    self.comments.setdefault(comment[1].lower(), comment[2].strip())
            elif text:
                self.separator = self.separator or max(SEPARATORS, key=line.count)
                self.lines.append(number)
                yield line

    def rows(self) -> Iterator[list[str]]:
        """Yield the cells of each line that has any, that of the heads first."""
        lines = self.lines_with_cells()
        first = next(lines, None)
        if first is None:
            raise self.refusal("it is empty; there must be a header and numbers")
        try:
            for texts in ((first,), lines):
                yield from csv.reader(
                    texts, delimiter=self.separator, skipinitialspace=True, strict=True
                )
        except csv.Error as error:
            raise self.refusal(f"it is not CSV; {error}") from None

    def refusal(self, allowed: str) -> InputError:
        """Return the error that refuses the file."""
        return refusal(self.what, str(self.path), allowed)


def read_csv(what: str, path: Path, fewest: int) -> tuple[list[Column], UserTable]:
    """Return the columns of a CSV file by their heads, and a table of its lines, yet without them.

    Columns are separated by commas, semicolons or tabs. One is an array where all its cells are
    plain numbers, else a list of texts and numbers.

    Raises InputError, in which the file is called `what`, if it cannot be read, is not such a file,
    or has fewer columns than are allowed.
    """
    try:
        with accessing(what, path, "read"), opened(path, encoding="utf-8-sig") as text:
            return _read(_CsvFile(what, path, text), fewest)
    except UnicodeDecodeError:
        allowed = "it is not text in UTF-8; give a CSV file"
        raise refusal(what, str(path), allowed) from None


def _read(file: _CsvFile, fewest: int) -> tuple[list[Column], UserTable]:
    rows = file.rows()
    heads = [text.strip() for text in next(rows)]
    _check_heads(file, heads, fewest)
    parts: list[list[Any]] = [[] for _ in heads]
    with advancing("reading the table", None, unit="rows") as advance:
        while block := list(islice(rows, BLOCK_ROWS)):
            lines = file.lines[-len(block) :]
            if len(file.lines) - 1 - len(block) != sum(map(len, parts[0])):
                raise file.refusal("it is not CSV; a text in quotes extends over several lines")
            if {*map(len, block)} != {len(heads)}:
                wrong = next(i for i, row in enumerate(block) if len(row) != len(heads))
                message = f"line {lines[wrong]} has {len(block[wrong])} values"
                raise file.refusal(f"it is not CSV; {message}, the header has {len(heads)} names")
            if len(file.lines) - 1 > MOST_ROWS:
                raise file.refusal(f"it has more than {MOST_ROWS} rows")
            for part, cells in zip(parts, zip(*block, strict=True), strict=True):
                numbers = plain_numbers(cells)
                part.append(cells if numbers is None else numbers)
            advance(len(block))
    columns = [Column(head, _joined(part)) for head, part in zip(heads, parts, strict=True)]
    return columns, UserTable({}, np.array(file.lines[1:], np.int64), "line", file.comments)


def _check_heads(file: _CsvFile, heads: list[str], fewest: int) -> None:
    """Raise InputError for too few or too many names, or for numbers instead."""
    fewer, count = "" if fewest == 1 else f", at least {fewest}", len(heads)
    names = "put a line without # before it that names the columns, e.g. psi_1,psi_2,chi"
    allowed = f"give columns separated by commas, semicolons or tabs{fewer}"
    many = f"it has {count} columns; at most {MOST_COLUMNS} are allowed"
    refuse(
        count < fewest and file.refusal(f"it is not CSV; {allowed}"),
        count > MOST_COLUMNS and file.refusal(many),
        plain_numbers(heads) is not None and f"{file.what}: the first line holds numbers; {names}",
    )


def _joined(parts: list[Any]) -> Any:
    if parts and all(isinstance(part, np.ndarray) for part in parts):
        return np.concatenate(parts)
    return [cell for part in parts for cell in (part if isinstance(part, tuple) else part.tolist())]
