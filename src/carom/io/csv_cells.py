"""The cells of a user's CSV file, read in parts: strictly, and within limits that are told."""

import csv
import re
from array import array
from collections.abc import Iterator, Sequence
from itertools import chain, islice
from pathlib import Path
from typing import Any, NamedTuple, TextIO

import numpy as np
from numpy.typing import NDArray

from carom.io.progress import advancing
from carom.quantities.arrays import plain_numbers
from carom.quantities.units import InputError, refusal

COMMENT = re.compile(r"#\s*([A-Za-z]\w*)\s*:\s*(.*)")
SEPARATORS = ",;\t"
CHUNK = 1 << 16  # rows that are texts at a time, before their numbers are
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


class _Lines:
    """Lines of a file that hold cells; their numbers and the comments are kept."""

    def __init__(self, what: str, path: Path, file: TextIO) -> None:
        self.what, self.path, self.file = what, path, file
        self.places, self.comments = array("q"), dict[str, str]()

    def __iter__(self) -> Iterator[str]:
        place = 0
        while line := self.file.readline(LONGEST_LINE + 1):
            place += 1
            if "\0" in line:
                raise self.refusal("it is not text; give a CSV file")
            if len(line) > LONGEST_LINE:
                raise self.refusal(f"line {place} has more than {LONGEST_LINE} characters")
            text = line.strip()
            if text.startswith("#"):
                self._note(text)
            elif text:
                self.places.append(place)
                yield line

    def _note(self, text: str) -> None:
        """Keep a comment "# key: value"; the first of a key counts."""
        if match := COMMENT.fullmatch(text):
            self.comments.setdefault(match[1].lower(), match[2].strip())

    def refusal(self, allowed: str) -> InputError:
        """Return the error that refuses the file."""
        return refusal(self.what, str(self.path), allowed)


def read_csv(what: str, path: Path, fewest: int = 2) -> CsvCells:
    """Return the cells of a CSV file; columns are separated by commas, semicolons or tabs.

    Raises InputError, in which the file is called `what`, if it cannot be read, is not such a file,
    or has fewer columns than are allowed.
    """
    try:
        with open(path, encoding="utf-8-sig") as file:
            return _read(_Lines(what, path, file), fewest)
    except OSError as error:
        reason = error.strerror or error
        raise InputError(f"{what}: {str(path)!r} cannot be read; {reason}") from None
    except UnicodeDecodeError:
        allowed = "it is not text in UTF-8; give a CSV file"
        raise refusal(what, str(path), allowed) from None


def _read(lines: _Lines, fewest: int) -> CsvCells:
    texts = iter(lines)
    first = next(texts, None)
    if first is None:
        raise lines.refusal("it is empty; there must be a header and numbers")
    separator = max(SEPARATORS, key=first.count)
    how: dict[str, Any] = {"delimiter": separator, "skipinitialspace": True, "strict": True}
    rows = csv.reader(chain([first], texts), **how)
    try:
        heads = [text.strip() for text in next(rows)]
        if len(heads) < fewest or len(lines.places) > 1:
            raise lines.refusal("it is not CSV; " + _separated(fewest))
        _check_heads(lines, heads)
        columns = _columns(lines, rows, len(heads))
    except csv.Error as error:
        raise lines.refusal(f"it is not CSV; {error}") from None
    return CsvCells(heads, columns, np.array(lines.places[1:], np.int64), lines.comments)


def _separated(fewest: int) -> str:
    fewer = "" if fewest == 1 else f", at least {fewest}"
    return f"give columns separated by commas, semicolons or tabs{fewer}"


def _check_heads(lines: _Lines, heads: Sequence[str]) -> None:
    """Raise InputError if a header is none: too many names, or numbers."""
    if len(heads) > MOST_COLUMNS:
        raise lines.refusal(f"it has {len(heads)} columns; {MOST_COLUMNS} are read at most")
    if plain_numbers(heads) is not None:
        raise InputError(
            f"{lines.what}: the first line holds numbers; before it a line, without #, must name "
            "the columns, e.g. psi_1,psi_2,chi"
        )


def _columns(lines: _Lines, rows: Iterator[list[str]], width: int) -> list[Any]:
    parts: list[list[Any]] = [[] for _ in range(width)]
    done = 0
    with advancing("reading", None, unit="rows") as advance:
        while chunk := list(islice(rows, CHUNK)):
            for place, row in enumerate(chunk, 1 + done):
                if len(row) != width:
                    message = f"has {len(row)} values, the header has {width} names"
                    place = lines.places[min(place, len(lines.places) - 1)]
                    raise lines.refusal(f"it is not CSV; line {place} {message}")
            done += len(chunk)
            if len(lines.places) != done + 1:
                raise lines.refusal("it is not CSV; a text in quotes goes over several lines")
            if done > MOST_ROWS:
                raise lines.refusal(f"it has more than {MOST_ROWS} rows, which are read at most")
            for part, cells in zip(parts, zip(*chunk, strict=True), strict=True):
                numbers = plain_numbers(cells)
                part.append(cells if numbers is None else numbers)
            advance(len(chunk))
    return [_joined(part) for part in parts]


def _joined(parts: list[Any]) -> Any:
    if parts and all(isinstance(part, np.ndarray) for part in parts):
        return np.concatenate(parts)
    return [cell for part in parts for cell in (part if isinstance(part, tuple) else part.tolist())]
