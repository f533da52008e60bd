"""Rows of cells, of a CSV file or of a sheet, made columns: the head, units below it, the rest."""

import re
from array import array
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import replace
from itertools import chain, islice, zip_longest
from operator import itemgetter
from typing import Any

import numpy as np

from carom.io.cells import (
    ERROR_CELL,
    Cells,
    Column,
    is_blank,
    is_missing,
    is_number,
    letter_of,
    named,
)
from carom.io.heads import parts_of
from carom.io.progress import advancing
from carom.io.user_table import UserTable
from carom.quantities.refusals import InputError, refusal, refuse
from carom.quantities.texts import is_unit

BLOCK_ROWS = 1 << 16  # rows that are texts at a time, before their numbers are
MOST_COLUMNS = 1000
MOST_ROWS = 10_000_000
HEAD_ROWS = 30  # among which the head is sought
NO_HEAD = "put a line without # before it that names the columns, e.g. psi_1,psi_2,chi"
COMMENT = re.compile(r"[#%]+\s*([A-Za-z]\w*)\s*:\s*(.*)", re.DOTALL)
DEEPLABCUT, ITS_AXES = "scorer", "coords"  # the first cells of its first row, and of the last head


class RowSource:
    """A file while its rows are read: what it is called, the numbers of its rows, its comments.

    `numbers` are those of the rows that were taken; they are called `word`. `wrong` is why some
    rows are none.
    """

    word = "line"
    kind = "CSV"

    def __init__(self, what: str, path: str) -> None:
        self.what, self.path = what, path
        self.numbers = array("q")
        self.comments: dict[str, str] = {}
        self.notes: list[str] = []
        self.wrong: list[str] = []
        self.comment = ""  # the last before the first row

    def rows(self) -> Iterator[Sequence[Any]]:
        """Yield the cells of each row that is no comment, none of one that cannot be read."""
        raise NotImplementedError

    def commented_head(self) -> list[str]:
        """Return the cells of the last comment before the first row, if that may be a head."""
        return []

    def is_comment(self, text: str) -> bool:
        """Tell whether a text is a comment, and keep it: by its key, of which the first counts."""
        if not text.startswith(("#", "%")) or text == "%" or ERROR_CELL.match(text):
            return False
        if comment := COMMENT.fullmatch(text):
            self.comments.setdefault(comment[1].lower(), comment[2].strip())
        if not self.numbers:
            self.comment = text
        return True

    def refusal(self, allowed: str) -> InputError:
        """Return the error that refuses the file."""
        return refusal(self.what, self.path, allowed)

    def read(self, fewest: int, decimal: str) -> tuple[list[Column], UserTable]:
        """Return the columns by their heads, and a table of the rows, yet without them.

        A column is an array where all its cells are plain numbers, else a list of texts and
        numbers. Blank rows are left out, and so are blank columns without a name, and rows of
        another length than most, which the table is told of.

        Raises InputError if there is no head, or there are fewer columns than are allowed.
        """
        try:
            heads, start, width, below = _head_of(self, fewest)
        except InputError as error:
            raise InputError(*self.wrong, *error.faults) from None
        columns = [Cells(letter_of(place), decimal) for place in range(len(heads))]
        above, numbers = start, list["array[int]"]()
        odd: dict[int, list[int]] = {}
        with advancing("reading the table", None, unit="rows") as advance:
            while block := list(islice(below, BLOCK_ROWS)):
                stop = start + len(block)
                where, block = _even(self.numbers[start:stop], block, width, odd)
                numbers.append(where)
                if stop - above > MOST_ROWS:
                    raise self.refusal(f"it has more than {MOST_ROWS} rows")
                for column, cells in zip(columns, zip(*block, strict=True), strict=False):
                    column.add(cells)
                start = stop
                advance(len(block))
        rows = np.concatenate([np.asarray(each, np.int64) for each in numbers or [array("q")]])
        for column in columns[width:]:  # to which no row extends
            column.add([""] * len(rows))
        told = {sign for column in columns for sign in column.sure}
        names = [head or f"column {each.letter}" for head, each in zip(heads, columns, strict=True)]
        read = [each.column(name, told, rows) for name, each in zip(names, columns, strict=True)]
        read = [c for c, head in zip(read, heads, strict=True) if head or not c.missing.all()]
        wrong = (*self.wrong, *_uneven(self, odd, width, len(heads)))
        table = UserTable({}, rows, self.word, self.comments)
        return read, replace(table, notes=tuple(self.notes), wrong=wrong)


def _head_of(source: RowSource, fewest: int) -> tuple[list[str], int, int, Iterator[Sequence[Any]]]:
    """Return the head, how many rows end with it, the length of those below, and these.

    It is the first row that is not blank, no title, and holds no numbers. Raises InputError if
    there is none, or too few or too many names are in it.
    """
    rows = source.rows()
    first = list(islice(rows, HEAD_ROWS))
    place = next((i for i, row in enumerate(first) if not _is_title(row, first[i + 1 :])), None)
    if place is None:
        raise source.refusal("it is empty; there must be a header and numbers")
    heads, rows_of_head = _of_points(first[place:])
    above = place + rows_of_head
    if all(map(is_number, filter(None, heads))):
        commented = source.commented_head()
        if len(commented) != len(heads) or all(map(is_number, commented)):
            raise InputError(f"{source.what}: the first line holds numbers; {NO_HEAD}")
        heads, above = commented, place
    elif units := _units(heads, first[above : above + 1]):
        heads = [f"{head} [{unit}]" if unit else head for head, unit in units]
        above += 1
    fewer, count = "" if fewest == 1 else f", at least {fewest}", len(heads)
    separated = " separated by commas, semicolons or tabs" if source.word == "line" else ""
    few = f"it is not {source.kind}; give columns{separated}{fewer}"
    many = f"it has {count} columns; at most {MOST_COLUMNS} are allowed"
    refuse(count < fewest and source.refusal(few), count > MOST_COLUMNS and source.refusal(many))
    lengths = Counter(len(row) for row in first[above:] if not all(map(is_blank, row)))
    width = min(lengths.most_common(1)[0][0], len(heads)) if lengths else 0
    return heads, above, width, chain(first[above:], rows)


def _of_points(rows: Sequence[Sequence[Any]]) -> tuple[list[str], int]:
    """Return the heads, and in how many rows they stand.

    Above x and y Tracker names the points, once each, and so does DeepLabCut, below the scorer.
    """
    heads, last = [_text(cell) for cell in rows[0]], 0
    if heads[0] == DEEPLABCUT:
        last = next((i for i, row in enumerate(rows) if [*row[:1]] == [ITS_AXES]), 0)
    elif {"x", "y"} <= {_text(cell) for row in rows[1:2] for cell in row} - {*heads}:
        last = 1
    if not last:
        return heads, 1
    joined, point = [], ""
    for name, axis in zip_longest(*rows[last - 1 : last + 1], fillvalue=""):
        point = _text(name) or point
        joined.append(f"{point}.{_text(axis)}" if point else _text(axis))
    return ["frame", *joined[1:]] if heads[0] == DEEPLABCUT else joined, last + 1


def _text(cell: Any) -> str:
    return cell.strip() if isinstance(cell, str) else f"{cell:g}" if cell else ""


def _is_title(row: Sequence[Any], below: Sequence[Sequence[Any]]) -> bool:
    """Tell whether a row is blank, or one text, or a few, above rows of several cells."""
    cells, *others = ([cell for cell in each if not is_blank(cell)] for each in (row, *below))
    if len(cells) != 1 or is_number(cells[0]):
        return not cells
    longer = (each for each in others if len(each) > 1 or any(map(is_number, each)))
    return len(next(longer, ())) > 1


def _units(heads: list[str], below: Sequence[Sequence[Any]]) -> list[tuple[str, str]]:
    """Return heads and units if the row below the heads, which have none, holds units alone."""
    cells = [str(cell).strip("[]() ") for row in below for cell in row]
    units = ["" if is_missing(cell) else cell for cell in cells]
    if len(units) != len(heads) or not any(units) or any(map(is_number, cells)):
        return []
    pairs = list(zip(heads, units, strict=True))
    bare = all(not unit or (head and not parts_of(head)[1]) for head, unit in pairs)
    whole = bare and all(is_unit(unit) for unit in filter(None, units))
    return pairs if whole else []


def _even(
    numbers: "array[int]", block: list[Sequence[Any]], width: int, odd: dict[int, list[int]]
) -> tuple["array[int]", list[Sequence[Any]]]:
    """Return the rows with something in them, without blank ends, and their numbers.

    Rows of another length are left out; their numbers are added to `odd`, by length.
    """
    if width and {*map(len, block)} == {width} and all(map(itemgetter(0), block)):  # mostly
        return numbers, block
    kept, even = array("q"), []
    for number, row in zip(numbers, block, strict=True):
        if all(map(is_blank, row)):
            continue
        if len(row) < width or not all(map(is_blank, row[width:])):
            odd.setdefault(len(row), []).append(number)
            continue
        kept.append(number)
        even.append(row[:width])
    return kept, even


def _uneven(source: RowSource, odd: dict[int, list[int]], width: int, names: int) -> list[str]:
    """Return what is wrong with rows of another length, if there are any."""
    lengths = [
        f"{named(source.word, numbers)} {'has' if len(numbers) == 1 else 'have'} {length} values"
        for length, numbers in odd.items()
    ]
    others = f"the others have {width}" if names in odd else f"the header has {names} names"
    words = f"it is not {source.kind}; {', '.join([*lengths, others])}"
    return [str(source.refusal(words))] if odd else []
