"""The sheets of a user's spreadsheet, .xlsx or .ods, of which one holds the table."""

import io
from collections.abc import Iterator, Sequence
from contextlib import suppress
from itertools import chain
from pathlib import Path
from typing import Any
from zipfile import ZipFile

from carom.io.decimals import is_number
from carom.io.extras import extra
from carom.io.remedies import REMEDIES
from carom.io.rows import Column, is_blank, letter_of, named
from carom.io.spreadsheet_marks import read_marks
from carom.io.table_rows import RowSource, read_rows
from carom.io.user_table import UserTable
from carom.quantities.refusals import InputError, nearest, refusal, refuse

OLD = b"\xd0\xcf\x11\xe0"  # begins what Excel stored before 2007, or stores with a password
STARTS = (b"PK\x03\x04", OLD)
LARGEST = 1 << 28  # bytes
MOST_CELLS = 20_000_000  # with all between cells that are far apart


def read_spreadsheet(
    what: str, path: str, file: Any, sheet: str, fewest: int, decimal: str
) -> tuple[list[Column], UserTable]:
    """Return the columns of a sheet by their heads, and a table of its rows, yet without them.

    `file` is open, and gives bytes. Raises InputError if it cannot be read, or if it has several
    sheets that may be meant and none is named.
    """
    calamine: Any = extra("python_calamine", "a spreadsheet", "fit")
    content = file.read(LARGEST + 1)
    if len(content) > LARGEST:
        raise refusal(what, path, f"it has more than {LARGEST} bytes; store the table as CSV")
    if content.startswith(OLD):
        words = "it is no spreadsheet, .xlsx or .ods, but of Excel before 2007, or has a password"
        raise refusal(what, path, f"{words}; store it as .xlsx without one")
    try:
        book = calamine.CalamineWorkbook.from_filelike(io.BytesIO(content))
        with ZipFile(io.BytesIO(content)) as archive:
            marks = read_marks(archive)
        sheets = {}
        for name in _readable(calamine, book, sheet):
            height, width = marks[name].height, marks[name].width
            last = f"{letter_of(max(width - 1, 0))}{height}"
            words = f"a sheet extends to {last}; delete what stands far from the table"
            refuse(width * height > MOST_CELLS and refusal(what, path, words))
            values = book.get_sheet_by_name(name).to_python(skip_empty_area=False)
            sheets[name] = marks[name].put(values)
    except InputError:
        raise
    except Exception as error:  # as damaged archives and their XML make the readers raise
        raise refusal(what, path, f"it is no spreadsheet, .xlsx or .ods; {error}") from None
    name, notes = _chosen(what, path, sheets, sheet)
    cells = sheets[name]
    rows = [str(i + 1) for i in _filled(marks[name].hidden_rows, cells)]
    columns = map(letter_of, _filled(marks[name].hidden_columns, [*zip(*cells, strict=True)]))
    hidden = [named(word, own) for word, own in (("row", rows), ("column", [*columns])) if own]
    told = f"hidden, as by a filter, and read all the same: {' and '.join(hidden)}"
    notes += [f"{told}; delete what is not meant"] if hidden else []
    return read_rows(_Sheet(what, path, cells, notes), fewest, decimal)


def _filled(hidden: Sequence[range], lines: Sequence[Sequence[Any]]) -> list[int]:
    """Return which of the hidden rows, or columns, have something in them."""
    there = (i for each in hidden for i in each[: len(lines)] if i < len(lines))
    return [i for i in there if not all(map(is_blank, lines[i]))]


def sheets_of(path: Path) -> list[str]:
    """Return the names of the sheets that may be read, none of a file that is no spreadsheet."""
    with path.open("rb") as file:
        if file.peek(4).startswith(STARTS):
            calamine: Any = extra("python_calamine", "a spreadsheet", "fit")
            with suppress(calamine.CalamineError):
                return _readable(calamine, calamine.CalamineWorkbook.from_filelike(file), "")
    return []


def _readable(calamine: Any, book: Any, sheet: str) -> list[str]:
    """Return the names of the sheets with cells that are not hidden, and of the one asked for."""
    return [
        each.name
        for each in book.sheets_metadata
        if each.typ == calamine.SheetTypeEnum.WorkSheet
        and (each.name == sheet or each.visible == calamine.SheetVisibleEnum.Visible)
    ]


def _chosen(
    what: str, path: str, sheets: dict[str, list[Any]], sheet: str
) -> tuple[str, list[str]]:
    """Return the name of the sheet to read, and a note if there are others with something in them.

    Raises InputError if there is none of the name, or several could be meant.
    """
    if sheet:
        hint = nearest(sheet, sheets) or f"its sheets are {_listed(sheets)}"
        refuse(sheet not in sheets and refusal("sheet", sheet, f"{path} has no such sheet; {hint}"))
        return sheet, []
    filled = [name for name, rows in sheets.items() if not all(map(is_blank, chain(*rows)))]
    likely = [name for name in filled if any(map(is_number, chain(*sheets[name][1:])))] or filled
    if not likely:
        raise refusal(what, path, "it is empty; there must be a header and numbers")
    if len(likely) > 1:
        say = REMEDIES.get().sheet.format(path=path, sheet=likely[0])
        raise refusal(what, path, f"its sheets {_listed(likely)} may be meant; {say}")
    more = [f"the sheet {likely[0]!r} was read, not {_listed({*filled} - {*likely})}"]
    return likely[0], more if len(filled) > 1 else []


def _listed(names: Any) -> str:
    return ", ".join(map(repr, names))


class _Sheet(RowSource):
    """The rows of a sheet; dates and times are texts, and so are no numbers."""

    word, kind = "row", "a table"

    def __init__(self, what: str, path: str, cells: list[list[Any]], notes: list[str]) -> None:
        super().__init__(what, path)
        self.notes, self.cells = notes, cells

    def rows(self) -> Iterator[Sequence[Any]]:
        """Yield the rows that are no comments."""
        for number, row in enumerate(self.cells, 1):
            cells = [cell for cell in row if not is_blank(cell)]
            is_text = len(cells) == 1 and isinstance(cells[0], str)
            if not (is_text and self.is_comment(cells[0])):
                self.numbers.append(number)
                yield [cell if isinstance(cell, str | float | int) else str(cell) for cell in row]
