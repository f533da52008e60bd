"""The sheets of a user's spreadsheet, .xlsx or .ods, of which one holds the table.

The reader of values gives cells without one as blank, as what was not measured: errors, formulas
without results, merged ones; and what is hidden as the rest. So these are marked.
"""

import re
from collections.abc import Iterable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from functools import reduce
from itertools import chain
from pathlib import Path
from posixpath import join
from typing import IO, Any, NamedTuple
from xml.etree.ElementTree import Element
from zipfile import BadZipFile, ZipFile

import numpy as np

from carom.io.cells import ERROR_CELL, is_blank, is_number, letter_of, named
from carom.io.extras import extra
from carom.io.remedies import REMEDIES
from carom.io.table_rows import RowSource
from carom.io.unpacking import TooMuch, elements, kind, unpacked
from carom.quantities.refusals import nearest, refusal, refuse

OLD = b"\xd0\xcf\x11\xe0"  # begins what Excel stored before 2007, or stores with a password
STARTS = (b"PK\x03\x04", OLD)
MOST_CELLS = 2_000_000  # of all sheets, with all between cells that are far apart
MOST_MARKS = 500_000  # of a sheet, with its hidden rows and columns
MOST_TEXT = 1 << 26  # characters in them
TEXTS = "xl/sharedstrings.xml"  # in any case, as the reader of values looks for it
BOOK, RELATIONS, ODS = "xl/workbook.xml", "xl/_rels/workbook.xml.rels", "content.xml"
CALLED = re.compile(r"([A-Z]+)([0-9]+)")
LONGEST_FORMULA = 30  # that is shown
NO_RESULT = "{} has no result; store the file in a spreadsheet program"


class Sheet(RowSource):
    """The sheet of a spreadsheet that holds the table; dates and times are texts, not numbers."""

    word, kind = "row", "a table"

    def __init__(self, what: str, path: str, file: Any, sheet: str) -> None:
        super().__init__(what, path)
        calamine: Any = extra("python_calamine", "a spreadsheet", "fit")
        if file.peek(4).startswith(OLD):
            words = "it is no spreadsheet, .xlsx or .ods, but of Excel before 2007, or has a "
            raise self.refusal(f"{words}password; store it as .xlsx without one")
        try:
            content = unpacked(file)
            with ZipFile(content) as archive:
                marks = read_marks(archive)
            content.seek(0)
            book, names = _opened(calamine, content, sheet)
            _limit(marks[name] for name in names)
            sheets = {name: marks[name].put(_values(book, name)) for name in names}
        except TooMuch as error:
            raise self.refusal(str(error)) from None
        except Exception as error:  # as damaged archives and their XML make the readers raise
            raise self.refusal(f"it is no spreadsheet, .xlsx or .ods; {error}") from None
        name = self._chosen(sheets, sheet)
        self.cells = sheets[name]
        rows = [str(i + 1) for i in _filled(marks[name].hidden_rows, self.cells)]
        across = [*zip(*self.cells, strict=True)]
        columns = [*map(letter_of, _filled(marks[name].hidden_columns, across))]
        hidden = [named(word, own) for word, own in (("row", rows), ("column", columns)) if own]
        told = f"hidden, as by a filter, and read all the same: {' and '.join(hidden)}"
        self.notes += [f"{told}; delete what is not meant"] if hidden else []

    def rows(self) -> Iterator[Sequence[Any]]:
        """Yield the rows that are no comments."""
        for number, row in enumerate(self.cells, 1):
            cells = [cell for cell in row if not is_blank(cell)]
            is_text = len(cells) == 1 and isinstance(cells[0], str)
            if not (is_text and self.is_comment(cells[0])):
                self.numbers.append(number)
                yield [cell if isinstance(cell, str | float | int) else str(cell) for cell in row]

    def _chosen(self, sheets: dict[str, list[Any]], sheet: str) -> str:
        """Return the name of the sheet to read, and note if others have something in them.

        Raises InputError if there is none of the name, or several could be meant.
        """
        if sheet:
            hint = nearest(sheet, sheets) or f"its sheets are {_listed(sheets)}"
            missing = f"{self.path} has no such sheet; {hint}"
            refuse(sheet not in sheets and refusal("sheet", sheet, missing))
            return sheet
        filled = [name for name, rows in sheets.items() if not all(map(is_blank, chain(*rows)))]
        likely = [n for n in filled if any(map(is_number, chain(*sheets[n][1:])))] or filled
        if not likely:
            raise self.refusal("it is empty; there must be a header and numbers")
        if len(likely) > 1:
            say = REMEDIES.get().sheet.format(path=self.path, sheet=likely[0])
            raise self.refusal(f"its sheets {_listed(likely)} may be meant; {say}")
        if others := {*filled} - {*likely}:
            self.notes.append(f"the sheet {likely[0]!r} was read, not {_listed(others)}")
        return likely[0]


def _listed(names: Iterable[str]) -> str:
    return ", ".join(map(repr, names))


def _filled(hidden: Sequence[range], lines: Sequence[Sequence[Any]]) -> list[int]:
    """Return which of the hidden rows, or columns, have something in them."""
    is_hidden = np.zeros(len(lines), dtype=bool)
    for each in hidden:
        is_hidden[each.start : each.stop] = True
    there = np.flatnonzero(is_hidden).tolist()
    return [i for i in there if not all(map(is_blank, lines[i]))]


def _limit(sheets: Iterable["Marks"]) -> None:
    """Raise TooMuch where the cells of sheets would fill the memory."""
    cells, merged, text = 0, 0, 0
    for sheet in sheets:
        cells, text = cells + sheet.width * sheet.height, text + sheet.text
        if cells > MOST_CELLS:
            last = f"{letter_of(max(sheet.width - 1, 0))}{sheet.height}"
            raise TooMuch(f"a sheet extends to {last}", "delete what stands far from the table")
        for mark in sheet.marks:
            merged += min(mark.rows, sheet.height) * min(mark.columns, sheet.width)
        if merged > MOST_CELLS:
            raise TooMuch(f"more than {MOST_CELLS} of its cells are merged")
        if text > MOST_TEXT:
            raise TooMuch(f"its cells hold more than {MOST_TEXT} characters")


def _values(book: Any, name: str) -> list[list[Any]]:
    return book.get_sheet_by_name(name).to_python(skip_empty_area=False)  # type: ignore[no-any-return]


def sheets_of(path: Path) -> list[str]:
    """Return the names of the sheets that may be read, none of a file that is no spreadsheet."""
    with path.open("rb") as file:
        if file.peek(4).startswith(STARTS):
            calamine: Any = extra("python_calamine", "a spreadsheet", "fit")
            with suppress(TooMuch, BadZipFile, calamine.CalamineError):
                return _opened(calamine, unpacked(file), "")[1]
    return []


def _opened(calamine: Any, file: Any, sheet: str) -> tuple[Any, list[str]]:
    """Return a workbook, and the names of the sheets with cells: not hidden, or asked for."""
    book = calamine.CalamineWorkbook.from_filelike(file)
    visible = calamine.SheetVisibleEnum.Visible
    sheets = [m for m in book.sheets_metadata if m.typ == calamine.SheetTypeEnum.WorkSheet]
    return book, [m.name for m in sheets if m.name == sheet or m.visible == visible]


class Mark(NamedTuple):
    """What stands in so many rows and columns from a place on, counted from 0; merged without."""

    row: int
    column: int
    rows: int
    columns: int
    text: str


@dataclass
class Marks:
    """The marks of a sheet, its size and characters, its hidden rows and columns, from 0 on."""

    marks: list[Mark] = field(default_factory=list)
    height: int = 0
    width: int = 0
    text: int = 0
    hidden_rows: list[range] = field(default_factory=list)
    hidden_columns: list[range] = field(default_factory=list)

    def limit(self) -> None:
        """Raise TooMuch where marks alone would fill the memory."""
        if len(self.marks) + len(self.hidden_rows) + len(self.hidden_columns) > MOST_MARKS:
            raise TooMuch(f"more than {MOST_MARKS} of its rows, columns and cells are marked")

    def put(self, values: list[list[Any]]) -> list[list[Any]]:
        """Return rows of values with the marks; cells merged with that of a number say so."""
        height, width = max(self.height, len(values)), max([self.width, *map(len, values)])
        full = [[*row, *[""] * (width - len(row))] for row in values]
        full += [[""] * width for _ in range(height - len(values))]
        for row, column, rows, columns, text in self.marks:
            is_inside = row < height and column < width  # not all that is merged
            value = text or (full[row][column] if is_inside else "")
            if text or is_number(value):
                beside = text or f"merged with {letter_of(column)}{row + 1}"
                for each in full[row : row + rows]:
                    each[column : column + columns] = [beside] * min(columns, width - column)
                full[row][column] = value
        return full


def read_marks(archive: ZipFile) -> dict[str, Marks]:
    """Return the marks of sheets by name; a damaged file raises what its readers do."""
    if ODS in archive.namelist():
        with archive.open(ODS) as file:
            sheets = dict(_of_ods(file))
        _limit(sheets.values())  # whoever reads values reads those of all sheets at once
        return sheets
    lengths = _lengths(archive)
    with archive.open(RELATIONS) as file:
        targets = {each.get("Id"): each.get("Target", "") for each in elements(file)}
    with archive.open(BOOK) as file:
        listed = [each for each in elements(file) if kind(each) == "sheet"]
    sheets = {}
    for element in listed:
        (identity,) = (value for key, value in element.items() if key.endswith("}id"))
        with archive.open(join("xl", targets[identity]).lstrip("/")) as file:
            sheets[element.get("name", "")] = _of_xlsx(file, lengths)
    return sheets


def _place(called: str) -> tuple[int, int]:
    """Return row and column of a cell that is called as C7 is."""
    letters, number = re.fullmatch(CALLED, called).groups()  # type: ignore[union-attr]
    column = reduce(lambda place, letter: 26 * place + ord(letter) - ord("A") + 1, letters, 0)
    return int(number) - 1, column - 1


def _column(cell: Element, place: int) -> int:
    return _place(cell.attrib["r"])[1] if "r" in cell.attrib else place


def _lengths(archive: ZipFile) -> list[int]:
    """Return the lengths of the texts of an .xlsx that cells share, each as often as it likes."""
    lengths = []
    for name in archive.namelist():
        if name.lower() == TEXTS:
            with archive.open(name) as file:
                texts = (each for each in elements(file) if kind(each) == "si")
                lengths += [sum(map(len, each.itertext())) for each in texts]
    return lengths


def _of_xlsx(file: IO[bytes], lengths: Sequence[int]) -> Marks:
    sheet = Marks()
    for element in elements(file):
        is_hidden = element.get("hidden") in ("1", "true")
        if kind(element) == "mergeCell":
            first, _, last = element.get("ref", "").partition(":")
            (top, left), (bottom, right) = _place(first), _place(last or first)
            sheet.marks.append(Mark(top, left, bottom - top + 1, right - left + 1, ""))
        if kind(element) == "col" and is_hidden:
            columns = range(int(element.attrib["min"]) - 1, int(element.attrib["max"]))
            sheet.hidden_columns.append(columns)
        if kind(element) != "row":
            continue
        sheet.height = int(element.get("r", sheet.height + 1))
        row = sheet.height - 1
        sheet.hidden_rows += [range(row, row + 1)] * is_hidden
        for place, cell in enumerate(element):
            is_formula = len(cell) and kind(cell[0]) == "f"
            text = cell.get("t") == "e" and cell.findtext("{*}v")
            if cell.get("t") == "s":
                sheet.text += lengths[int(cell.findtext("{*}v") or 0)]
            if is_formula and not cell.findtext("{*}v") and cell.get("t") != "str":  # of texts ""
                text = NO_RESULT.format(f"={cell[0].text or ''}"[:LONGEST_FORMULA])
            if text:
                sheet.marks.append(Mark(row, _column(cell, place), 1, 1, text))
        if len(element):
            sheet.width = max(sheet.width, _column(element[-1], len(element) - 1) + 1)
        sheet.limit()
    return sheet


def _of_ods(file: IO[bytes]) -> Iterator[tuple[str, Marks]]:
    sheet, row, seen = Marks(), 0, 0
    for element in elements(file):
        own = _by_name(element)
        is_hidden = own.get("visibility", "visible") != "visible"
        if kind(element) == "table":
            yield own["name"], sheet
            sheet, row, seen = Marks(), 0, 0
        if kind(element) == "table-column":
            first, seen = seen, seen + int(own.get("number-columns-repeated", 1))
            sheet.hidden_columns += [range(first, seen)] * is_hidden
        if kind(element) != "table-row":
            continue
        column, rows = 0, int(own.get("number-rows-repeated", 1))
        sheet.hidden_rows += [range(row, row + rows)] * is_hidden
        for cell in element:
            own = _by_name(cell)
            columns = int(own.get("number-columns-repeated", 1))
            shown = "".join("".join(part.itertext()) for part in cell if kind(part) == "p")
            kinds = [value for key, value in cell.items() if key.endswith("}value-type")]
            text, formula = "", own.get("formula", "").removeprefix("of:")
            if "error" in kinds or (formula and ERROR_CELL.match(shown)):
                text = shown
            elif formula and not kinds:
                text = NO_RESULT.format(formula[:LONGEST_FORMULA])
            if text:
                sheet.marks.append(Mark(row, column, rows, columns, text))
            elif {"number-rows-spanned", "number-columns-spanned"} & {*own}:
                down, along = (int(own.get(f"number-{n}-spanned", 1)) for n in ("rows", "columns"))
                sheet.marks.append(Mark(row, column, down, along, ""))
            column += columns
            sheet.text += rows * columns * (len(shown) + len(own.get("string-value", "")))
            if text or kinds or shown:
                sheet.height, sheet.width = row + rows, max(sheet.width, column)
        row += rows
        sheet.limit()


def _by_name(element: Element) -> dict[str, str]:
    return {key.rpartition("}")[2]: value for key, value in element.items()}
