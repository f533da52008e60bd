"""The lines of a user's CSV file: its encoding, its separator, its comments, and limits."""

import csv
import io
import re
from collections import Counter
from collections.abc import Iterator
from functools import partial
from itertools import chain, islice
from typing import Any

from carom.io.cells import Column, is_missing, is_number
from carom.io.table_rows import HEAD_ROWS, RowSource
from carom.io.user_table import UserTable

QUOTED = re.compile(r'"((?:[^"]|"")*)"[\s,;]*')  # by a spreadsheet, as a comment with commas is
PERCENT = re.compile(r"%\s*[,;\t]|%\s*$")  # which is a unit
SEPARATORS = ",;\t"
BLANKS = " "  # one or more between cells
UNIT_ALONE = {*"[("}  # begin no name
NO_CELL = '#%" \t\n\r\v\f\x1c\x1d\x1e\x1f'  # begins a comment, or a line that may be blank
NAMED_SEPARATOR = re.compile(rf"sep=([{SEPARATORS}])\s*", re.IGNORECASE)  # Excel's first line
LONGEST_LINE = 1_000_000  # characters
UTF16 = (b"\xff\xfe", b"\xfe\xff")
WESTERN = "cp1252"  # of Windows; Latin-1, with letters where that has none
LABVIEW, LABVIEW_END = "LabVIEW Measurement", "***End_of_Header***"
LABVIEW_PREAMBLES = 2  # of the file and of its channels


class CsvFile(RowSource):
    """A CSV file while it is read; the encoding is that of its first letter beyond ASCII."""

    def __init__(self, what: str, path: str, file: Any) -> None:
        super().__init__(what, path)
        is_wide = file.peek(2)[:2] in UTF16
        how = ("utf-16", "strict") if is_wide else ("utf-8-sig", "surrogateescape")
        self.text = io.TextIOWrapper(file, *how)
        self.separator = self.encoding = ""

    def read(self, fewest: int, decimal: str) -> tuple[list[Column], UserTable]:
        """Return columns and table as others do, or raise InputError if it is no such file."""
        try:
            with self.text:
                return super().read(fewest, decimal)
        except csv.Error as error:
            raise self.refusal(f"it is not CSV; {error}") from None
        except UnicodeError:
            raise self.refusal("it is not text; give a CSV file") from None

    def rows(self) -> Iterator[list[str]]:
        """Yield the cells of each line that has any, none of one that is no CSV."""
        lines = self._lines()
        first = list(islice(lines, HEAD_ROWS))
        self.separator = self.separator or self._likely_separator(first)
        for place, line in enumerate(chain(first, lines)):
            try:
                yield _cells(line, self.separator)
            except csv.Error as error:
                where, open_ended = f"line {self.numbers[place]}", line.count('"') % 2
                words = f"a text in quotes extends over several lines, from {where} on"
                self._refuse(f"it is not CSV; {words if open_ended else f'{where}: {error}'}")
                yield []

    def commented_head(self) -> list[str]:
        """Return the cells of the last comment before the first row."""
        return [cell.strip() for cell in _cells(self.comment.lstrip("#% "), self.separator)]

    def _refuse(self, words: str) -> None:
        """Say once what is wrong, and go on."""
        if (message := str(self.refusal(words))) not in self.wrong:
            self.wrong.append(message)

    def _lines(self) -> Iterator[str]:
        """Yield the lines that are neither empty nor comments."""
        numbered = enumerate(iter(partial(self.text.readline, LONGEST_LINE + 1), ""), 1)
        for number, line in self._after_preamble(numbered):
            if len(line) > LONGEST_LINE:
                raise self.refusal(f"a line has more than {LONGEST_LINE} characters")
            if "\0" in line:
                raise self.refusal("it is not text; give a CSV file")
            if line[0] in NO_CELL or not line.isascii():
                line = line if line.isascii() else self._decoded(line)
                if self._is_empty(line.strip()):
                    continue
            self.numbers.append(number)
            yield line

    def _after_preamble(self, lines: Iterator[tuple[int, str]]) -> Iterator[tuple[int, str]]:
        """Return the lines below what Excel or LabVIEW have put first."""
        number, line = next(lines, (1, "\n"))
        if separator := NAMED_SEPARATOR.fullmatch(line):
            self.separator = separator[1]
        elif line.startswith(LABVIEW):
            ends = (number for number, line in lines if line.startswith(LABVIEW_END))
            next(islice(ends, LABVIEW_PREAMBLES - 1, None), None)
        else:
            return chain([(number, line)], lines)
        return lines

    def _decoded(self, line: str) -> str:
        """Return a line beyond ASCII as it is in UTF-8 or UTF-16, else in the Western encoding."""
        try:
            line.encode()
            own = self.text.encoding
        except UnicodeEncodeError:  # of bytes that were none of UTF-8
            own = WESTERN
            line = line.encode(errors="surrogateescape").decode(own)
        if not self.encoding and own == WESTERN:
            words = "its text is not in UTF-8 and was read as Latin-1 (Windows-1252)"
            self.notes.append(f"{words}; look at letters such as ° and µ")
        if own != (self.encoding or own):
            self._refuse("its lines are in two encodings; store it in UTF-8")
        self.encoding = own
        return line

    def _is_empty(self, text: str) -> bool:
        """Tell whether a line is blank or a comment, which may be in quotes of a spreadsheet."""
        if not text or PERCENT.match(text):
            return not text
        if text[0] == '"':
            quoted = QUOTED.fullmatch(text)
            text = quoted[1].replace('""', '"').strip() if quoted else ""
        return self.is_comment(text.rstrip(" \t;,"))

    def _likely_separator(self, lines: list[str]) -> str:
        """Return the separator by which most lines have one number of cells, and most numbers.

        Raises InputError if two are alike.
        """
        there = [each for each in SEPARATORS if any(each in line for line in lines)]
        if there in ([], [","]) and _is_in_blanks(lines[1:]):
            names = lines[0].split()
            begun = {name[0] for name in names}
            if len(names) == len(lines[1].split()) and not begun & UNIT_ALONE:
                return BLANKS
            words = "its columns are separated by blanks, and so are words of its head"
            raise self.refusal(f"{words}; write angle[deg] without blanks, or separate by tabs")
        if len(there) < 2:
            return (there or [","])[0]
        (best, first), (most, second) = sorted(
            ((self._suits(each, lines), each) for each in there), reverse=True
        )[:2]
        if best == most:
            words = f"its columns may be separated by {first!r} or by {second!r}"
            raise self.refusal(f"{words}; begin it with a line sep={first} or sep={second}")
        return first

    def _suits(self, separator: str, lines: list[str]) -> tuple[float, float]:
        rows = [*csv.reader(lines, delimiter=separator, skipinitialspace=True)]
        cells = [cell for row in rows for cell in row if cell]
        alike = Counter(len(row) for row in rows if len(row) > 1)
        numbers = sum(map(is_number, cells)) / max(len(cells), 1)
        return max(alike.values(), default=0), numbers


def _is_in_blanks(lines: list[str]) -> bool:
    """Tell whether lines hold as many numbers each, two or more, with nothing but blanks between.

    Cells that begin or end with a comma have that between.
    """
    rows = [line.split() for line in lines]
    cells = [cell for row in rows for cell in row]
    bare = (
        is_number(cell) or is_missing(cell)
        for cell in cells
        if "," not in cell[:: max(len(cell) - 1, 1)]
    )
    return len({*map(len, rows)}) == 1 and len(rows[0]) > 1 and sum(bare) == len(cells)


def _cells(line: str, separator: str) -> list[str]:
    """Return the cells of a line, of which those with separators are in quotes."""
    if separator == BLANKS:
        return line.split()
    if '"' not in line:
        return [cell.lstrip(" ") for cell in line.rstrip("\n").split(separator)]
    how: dict[str, Any] = {"skipinitialspace": True, "strict": True}
    return next(csv.reader([line], delimiter=separator, **how))
