"""Rows of cells, of a CSV file or of a sheet, made columns: the head, units below it, the rest."""

import re
from array import array
from collections.abc import Iterator, Sequence
from functools import partial
from itertools import chain, islice
from operator import itemgetter
from typing import Any, NamedTuple

import numpy as np

from carom.io.decimals import Cells, is_number, sign_of
from carom.io.heads import parts_of
from carom.io.progress import advancing
from carom.io.rows import Column, is_blank, is_missing, letter_of
from carom.io.user_table import UserTable
from carom.quantities.refusals import InputError, refusal, refuse
from carom.quantities.texts import is_unit

BLOCK_ROWS = 1 << 16  # rows that are texts at a time, before their numbers are
MOST_COLUMNS = 1000
MOST_ROWS = 10_000_000
HEAD_ROWS = 30  # among which the head is sought
NO_HEAD = "put a line without # before it that names the columns, e.g. psi_1,psi_2,chi"


COMMENT = re.compile(r"[#%]+\s*([A-Za-z]\w*)\s*:\s*(.*)", re.DOTALL)
SPREADSHEET_ERRORS = ("#N/A", "#DIV/0!", "#VALUE!", "#REF!", "#NAME?", "#NUM!", "#NULL!")


CSV = "CSV"


class RowSource:
    """A file while its rows are read: what it is called, the numbers of its rows, its comments.

    `numbers` are those of the rows that were taken; they are called `word`.
    """

    word = "line"
    kind = CSV

    def __init__(self, what: str, path: str) -> None:
        self.what, self.path = what, path
        self.numbers = array("q")
        self.comments: dict[str, str] = {}
        self.notes: list[str] = []
        self.comment = ""  # the last before the first row

    def rows(self) -> Iterator[Sequence[Any]]:
        """Yield the cells of each row that is no comment."""
        raise NotImplementedError

    def commented_head(self) -> list[str]:
        """Return the cells of the last comment before the first row."""
        return []

    def is_comment(self, text: str) -> bool:
        """Tell whether a text is a comment, and keep it: by its key, of which the first counts."""
        if not text.startswith(("#", "%")) or text == "%" or text.startswith(SPREADSHEET_ERRORS):
            return False
        if comment := COMMENT.fullmatch(text):
            self.comments.setdefault(comment[1].lower(), comment[2].strip())
        if not self.numbers:
            self.comment = text
        return True

    def check(self, count: int) -> None:
        """Raise InputError if the rows that were taken, so many, are not of one line each."""

    def refusal(self, allowed: str) -> InputError:
        """Return the error that refuses the file."""
        return refusal(self.what, self.path, allowed)


class _Head(NamedTuple):
    """Names of columns, how many rows are above the first below, how many were taken, and those."""

    heads: list[str]
    above: int
    taken: int
    rows: Iterator[Sequence[Any]]


def read_rows(source: RowSource, fewest: int, decimal: str) -> tuple[list[Column], UserTable]:
    """Return the columns of a file by their heads, and a table of its rows, yet without them.

    A column is an array where all its cells are plain numbers, else a list of texts and numbers.
    Blank rows are left out, and so are blank columns without a name.

    Raises InputError if there are fewer columns than are allowed, or a row does not fit the head.
    """
    head = _head_of(source, fewest)
    columns = [Cells(decimal) for _ in head.heads]
    numbers: list[array[int]] = []
    start, width = head.above, 0
    with advancing("reading the table", None, unit="rows") as advance:
        while block := list(islice(head.rows, BLOCK_ROWS)):
            stop = start + len(block)
            source.check(max(stop, head.taken))
            where, block = _without_blanks(source.numbers[start:stop], block)
            width = width or min(len(block[0]) if block else 0, len(columns))
            _make_even(source, where, block, width, len(columns))
            numbers.append(where)
            if stop - head.above > MOST_ROWS:
                raise source.refusal(f"it has more than {MOST_ROWS} rows")
            for column, cells in zip(columns, zip(*block, strict=True), strict=False):
                (column.add_texts if source.kind == CSV else column.add)(cells)
            start = stop
            advance(len(block))
    rows = np.concatenate([np.asarray(each, np.int64) for each in numbers or [array("q")]])
    for column in columns[width:]:  # to which no row extends
        column.add([""] * len(rows))
    read = _with_signs(head.heads, columns, rows)
    return read, UserTable({}, rows, source.word, source.comments, notes=tuple(source.notes))


def _head_of(source: RowSource, fewest: int) -> _Head:
    """Return the head: the first row that is not blank, no title, and holds no numbers."""
    rows = source.rows()
    first = list(islice(rows, HEAD_ROWS))
    source.check(len(first))
    place = next((i for i, row in enumerate(first) if not _is_title(row, first[i + 1 :])), None)
    if place is None:
        raise source.refusal("it is empty; there must be a header and numbers")
    heads, above = [_text(cell) for cell in first[place]], place + 1
    if all(map(is_number, filter(None, heads))):
        commented = source.commented_head()
        if len(commented) != len(heads) or all(map(is_number, commented)):
            raise InputError(f"{source.what}: the first line holds numbers; {NO_HEAD}")
        heads, above = commented, place
    elif units := _units(heads, first[above : above + 1]):
        heads = [f"{head} [{unit}]" if unit else head for head, unit in units]
        above += 1
    _check_heads(source, heads, fewest)
    return _Head(heads, above, len(first), chain(first[above:], rows))


def _text(cell: Any) -> str:
    return cell.strip() if isinstance(cell, str) else f"{cell:g}" if cell else ""


def _is_title(row: Sequence[Any], below: Sequence[Sequence[Any]]) -> bool:
    """Tell whether a row is blank, or one text above rows of several cells."""
    cells = [cell for cell in row if not is_blank(cell)]
    if len(cells) != 1 or is_number(cells[0]):
        return not cells
    following = next((each for each in below if not all(map(is_blank, each))), ())
    return sum(not is_blank(cell) for cell in following) > 1


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


def _check_heads(source: RowSource, heads: list[str], fewest: int) -> None:
    """Raise InputError for too few or too many names."""
    fewer, count = "" if fewest == 1 else f", at least {fewest}", len(heads)
    separated = " separated by commas, semicolons or tabs" if source.word == "line" else ""
    allowed = f"it is not {source.kind}; give columns{separated}{fewer}"
    many = f"it has {count} columns; at most {MOST_COLUMNS} are allowed"
    refuse(
        count < fewest and source.refusal(allowed), count > MOST_COLUMNS and source.refusal(many)
    )


def _without_blanks(
    numbers: "array[int]", block: list[Sequence[Any]]
) -> tuple["array[int]", list[Sequence[Any]]]:
    """Return the rows with something in them, and their numbers."""
    if all(map(itemgetter(0), block)):  # as in most files
        return numbers, block
    kept = [i for i, row in enumerate(block) if not all(map(is_blank, row))]
    return array("q", [numbers[i] for i in kept]), [block[i] for i in kept]


def _make_even(
    source: RowSource, numbers: "array[int]", block: list[Sequence[Any]], width: int, names: int
) -> None:
    """Cut blank cells at the ends of rows, or raise InputError for a row of another length."""
    if {*map(len, block)} <= {width}:
        return
    for i, row in enumerate(block):
        if len(row) != width and (len(row) < width or not all(map(is_blank, row[width:]))):
            message = f"{source.word} {numbers[i]} has {len(row)} values"
            other = f"the header has {names} names"
            if len(row) == names:
                other = f"the first {source.word} has {width}"
            raise source.refusal(f"it is not {source.kind}; {message}, {other}")
        block[i] = row[:width]


def _with_signs(heads: list[str], columns: list[Cells], rows: Any) -> list[Column]:
    """Return the columns with decimal points; without a name they are called by their letters."""
    told = {sign for column in columns for sign in column.sure}
    read = []
    for place, (head, column) in enumerate(zip(heads, columns, strict=True)):
        letter = letter_of(place)
        sign, fault = sign_of(column, told, partial(_cell, letter, rows))
        cells = column.with_points(sign)
        if head or not all(map(is_missing, cells)):
            read.append(Column(head or f"column {letter}", cells, "", fault, letter))
    return read


def _cell(letter: str, rows: Any, place: int) -> str:
    return f"cell {letter}{rows[place]}"
