"""Which sign is decimal in the numbers of a file: a point or a comma, or nobody can tell.

A number such as 0,5 or 12,25 has a decimal comma: no separator of thousands stands there. 1,234 may
be either. So a column is read with commas if one of its numbers must have them, or if all other
columns of the file that tell have them; otherwise it is asked.
"""

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from carom.io.remedies import REMEDIES
from carom.quantities.arrays import Array, plain_numbers
from carom.quantities.texts import BLANKS, LONGEST_TEXT, SIGN

POINT, COMMA = ".", ","
NUMBER = re.compile(
    rf"([{BLANKS}]*{SIGN})([0-9][0-9.,]*|[.,][0-9]+)((?:[eE]{SIGN}[0-9]+)?[{BLANKS}]*[^,;]*)"
)
BARE = re.compile(rf"[{BLANKS}]*{SIGN}(?:[0-9][0-9.,]*|[.,][0-9]+)(?:[eE]{SIGN}[0-9]+)?[{BLANKS}]*")
GROUPED = re.compile(r"[1-9][0-9]{0,2}[.,][0-9]{3}")  # maybe thousands
LOOKED_AT = 1000  # plain numbers of a block, to see whether a point must be decimal


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

    decimal: str = ""
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

    def with_points(self, sign: str) -> Any:
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


def sign_of(column: Cells, told: set[str], cell_of: Callable[[int], str]) -> tuple[str, str]:
    """Return the decimal sign of a column, and what is wrong with it, or nothing.

    `told` holds the signs that are sure in columns of the file, `cell_of` says where a place is.
    """
    there = column.unsure | column.sure
    shown = {sign: f"{text} in {cell_of(place)}" for sign, (place, text) in there.items()}
    if column.decimal:
        wrong = column.decimal == COMMA and POINT in there
        return column.decimal, f"{shown[POINT]} has a decimal point, not a comma" if wrong else ""
    if len(there) == 2:
        words = f"{shown[COMMA]} and {shown[POINT]} have different decimal signs"
        return POINT, f"{words}; write one, and no separators of thousands"
    for sign in (COMMA, POINT):
        if sign in column.unsure and sign not in column.sure and told != {sign}:
            if sign == POINT and COMMA not in told:
                continue
            return sign, _asked(shown[sign], there[sign][1], sign)
    return (COMMA if COMMA in there else POINT), ""


def _asked(shown: str, text: str, sign: str) -> str:
    less, thousand = text.replace(sign, POINT), text.replace(sign, "")
    remedy = f"for {less}, {REMEDIES.get().decimal.format(sign=sign)}"
    words = f"{shown} may be {less} or {thousand}, with a separator of thousands"
    return f"{words}; {remedy}; for {thousand}, leave the separators out"
