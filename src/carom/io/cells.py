"""Cells, columns and rows of a table: what they are called, which are empty, which sign is decimal.

A number such as 0,5 or 12,25 has a decimal comma: no separator of thousands stands there. 1,234 may
be either. So a column is read with commas if one of its numbers must have them, or if all other
columns of the file that tell have them; otherwise it is asked.
"""

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.io.remedies import REMEDIES
from carom.quantities.arrays import Array, plain_numbers
from carom.quantities.texts import BLANKS, LONGEST_TEXT, SIGN

Mask = NDArray[np.bool_]

GAP = "-"
NOT_AVAILABLE = ("#n/a", "#nv", "#n/d")  # in cells of spreadsheets, English, German, Spanish
MISSING = ("", GAP, "\N{EN DASH}", "\N{EM DASH}", "nan", "na", "n/a", *NOT_AVAILABLE)
ERROR_CELL = re.compile(r'#(?:N/A|NV|N/D|[A-ZÄÖÜ/0-9]{2,}[!?])(?=$|["\t,;])|Err:\d')  # #DIV/0!
MISSING_TYPES = ("NAType", "NaTType", "MaskedConstant")  # of pandas, of NumPy
MOST_NAMED_ROWS = 5  # that a message names
LETTERS = 26
POINT, COMMA = ".", ","
NUMBER = re.compile(
    rf"([{BLANKS}]*{SIGN})([0-9][0-9.,]*|[.,][0-9]+)((?:[eE]{SIGN}[0-9]+)?[{BLANKS}]*[^,;]*)"
)
BARE = re.compile(rf"[{BLANKS}]*{SIGN}(?:[0-9][0-9.,]*|[.,][0-9]+)(?:[eE]{SIGN}[0-9]+)?[{BLANKS}]*")
GROUPED = re.compile(r"[1-9][0-9]{0,2}[.,][0-9]{3}")  # maybe thousands
LOOKED_AT = 1000  # plain numbers of a block, to see whether a point must be decimal


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


def is_number(cell: Any) -> bool:
    """Tell whether a cell holds a number without a unit, whatever its decimal sign."""
    if not isinstance(cell, str):
        return isinstance(cell, int | float) and not isinstance(cell, bool)
    return len(cell) <= LONGEST_TEXT and BARE.fullmatch(cell) is not None


@dataclass
class Cells:
    """Cells of one column as they are read, and the first that tell which sign is decimal.

    `sure` and `unsure` have place and text of the first number with a sign that must be, or may be,
    decimal; `decimal` is the sign that a user says, or nothing. Blocks of plain numbers are arrays,
    with decimal commas, too.
    """

    letter: str
    decimal: str
    parts: list[Any] = field(default_factory=list)
    sure: dict[str, tuple[int, str]] = field(default_factory=dict)
    unsure: dict[str, tuple[int, str]] = field(default_factory=dict)
    count: int = 0

    def add(self, cells: Sequence[Any]) -> None:
        """Append cells of a file: texts, or numbers and texts of a spreadsheet."""
        kinds, numbers = {*map(type, cells)}, None
        if kinds <= {str}:
            numbers = self._of_texts(cells)
        else:
            self._look(cells)
            numbers = np.array(cells, dtype=np.float64) if kinds <= {int, float} else None
        self.parts.append(list(cells) if numbers is None else numbers)
        self.count += len(cells)

    def _of_texts(self, texts: Sequence[str]) -> Array | None:
        """Return texts that are plain numbers, with points or with commas, as an array."""
        numbers, whole = plain_numbers(texts), "".join(texts)
        if numbers is None:
            if COMMA not in self.sure or POINT in whole:
                self._look(texts)
            if COMMA in whole and POINT not in whole and self.decimal != POINT:
                numbers = plain_numbers([text.replace(COMMA, POINT) for text in texts])
        elif POINT not in self.sure and POINT in whole:
            self._look(texts[:LOOKED_AT])
            if POINT not in self.sure | self.unsure:
                self._look(texts)
        return numbers

    def _look(self, cells: Sequence[Any]) -> None:
        for place, cell in enumerate(cells, self.count):
            short = isinstance(cell, str) and len(cell) <= LONGEST_TEXT
            match = NUMBER.fullmatch(cell) if short else None
            if match is None or not {POINT, COMMA} & {*match[2]}:
                continue
            last = max(POINT, COMMA, key=match[2].rfind)
            if match[2].count(last) == 1:
                may_be = GROUPED.fullmatch(match[2]) and match[3][:1].lower() != "e"
                (self.unsure if may_be else self.sure).setdefault(last, (place, cell.strip()))
            if len(self.sure) == 2:
                return

    def column(self, head: str, told: set[str], rows: Any) -> Column:
        """Return the column, with decimal points, or with its fault if the sign is not sure.

        `told` holds the signs that are sure in columns of the file, `rows` the numbers of its rows.
        """
        there = self.unsure | self.sure
        shown = {
            sign: f"{text} in cell {self.letter}{rows[place]}"
            for sign, (place, text) in there.items()
        }
        sign, fault = COMMA if COMMA in there else POINT, ""
        open_signs = [each for each in (COMMA, POINT) if self._is_open(each, told)]
        if self.decimal:
            sign = self.decimal
            wrong = sign == COMMA and POINT in there
            fault = f"{shown[POINT]} has a decimal point, not a comma" if wrong else ""
        elif len(there) == 2:
            sign = POINT
            fault = f"{shown[COMMA]} and {shown[POINT]} have different decimal signs; write one, "
            fault += "and no separators of thousands"
        elif open_signs:
            sign = open_signs[0]
            fault = _asked(shown[sign], there[sign][1], sign)
        return Column(head, self._with_points(sign), "", fault, self.letter)

    def _is_open(self, sign: str, told: set[str]) -> bool:
        """Tell whether a sign may part thousands, as far as all columns of the file tell."""
        asked = sign == COMMA or COMMA in told
        return asked and sign in self.unsure and sign not in self.sure and told != {sign}

    def _with_points(self, sign: str) -> Any:
        """Return all cells, an array of numbers or a list, where this sign is the decimal one."""
        if self.parts and all(isinstance(part, np.ndarray) for part in self.parts):
            return np.concatenate(self.parts)
        parts = (part if isinstance(part, list) else part.tolist() for part in self.parts)
        cells = [cell for part in parts for cell in part]
        return cells if sign == POINT else [*map(_with_point, cells)]


def _with_point(cell: Any) -> Any:
    match = NUMBER.fullmatch(cell) if isinstance(cell, str) and len(cell) <= LONGEST_TEXT else None
    if match is None or match[2].count(COMMA) != 1:
        return cell
    return match[1] + match[2].replace(COMMA, POINT) + match[3]


def _asked(shown: str, text: str, sign: str) -> str:
    less, thousand = text.replace(sign, POINT), text.replace(sign, "")
    remedy = f"for {less}, {REMEDIES.get().decimal.format(sign=sign)}"
    words = f"{shown} may be {less} or {thousand}, with a separator of thousands"
    return f"{words}; {remedy}; for {thousand}, leave the separators out"
