"""Cells of a spreadsheet that have no value: errors, formulas without results, merged ones.

The reader of values gives these as blank, as what was not measured, and what is hidden as the rest.
"""

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import reduce
from posixpath import join
from typing import IO, Any, NamedTuple
from xml.etree.ElementTree import Element, fromstring, iterparse
from zipfile import ZipFile

from carom.io.decimals import is_number
from carom.io.rows import ERROR_CELL, letter_of

BOOK, RELATIONS, ODS = "xl/workbook.xml", "xl/_rels/workbook.xml.rels", "content.xml"
CALLED = re.compile(r"([A-Z]+)([0-9]+)")
LONGEST_FORMULA = 30  # that is shown
NO_RESULT = "{} has no result; store the file in a spreadsheet program"


class Mark(NamedTuple):
    """What stands in so many rows and columns from a place on, counted from 0; merged without."""

    row: int
    column: int
    rows: int
    columns: int
    text: str


@dataclass
class Marks:
    """The marks of a sheet, how far it extends, and its hidden rows and columns, from 0 on."""

    marks: list[Mark] = field(default_factory=list)
    height: int = 0
    width: int = 0
    hidden_rows: list[range] = field(default_factory=list)
    hidden_columns: list[range] = field(default_factory=list)

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
            return dict(_of_ods(file))
    targets = {each.get("Id"): each.get("Target", "") for each in _read(archive, RELATIONS)}
    sheets = {}
    for element in filter(lambda each: _kind(each) == "sheet", _read(archive, BOOK).iter()):
        (identity,) = (value for key, value in element.items() if key.endswith("}id"))
        with archive.open(join("xl", targets[identity]).lstrip("/")) as file:
            sheets[element.get("name", "")] = _of_xlsx(file)
    return sheets


def _read(archive: ZipFile, name: str) -> Element:
    return fromstring(archive.read(name))


def _kind(element: Element) -> str:
    return element.tag.rpartition("}")[2]


def _place(called: str) -> tuple[int, int]:
    """Return row and column of a cell that is called as C7 is."""
    letters, number = re.fullmatch(CALLED, called).groups()  # type: ignore[union-attr]
    column = reduce(lambda place, letter: 26 * place + ord(letter) - ord("A") + 1, letters, 0)
    return int(number) - 1, column - 1


def _column(cell: Element, place: int) -> int:
    return _place(cell.attrib["r"])[1] if "r" in cell.attrib else place


def _of_xlsx(file: IO[bytes]) -> Marks:
    sheet = Marks()
    for _, element in iterparse(file):
        is_hidden = element.get("hidden") in ("1", "true")
        if _kind(element) == "mergeCell":
            first, _, last = element.get("ref", "").partition(":")
            (top, left), (bottom, right) = _place(first), _place(last or first)
            sheet.marks.append(Mark(top, left, bottom - top + 1, right - left + 1, ""))
        if _kind(element) == "col" and is_hidden:
            columns = range(int(element.attrib["min"]) - 1, int(element.attrib["max"]))
            sheet.hidden_columns.append(columns)
        if _kind(element) != "row":
            continue
        sheet.height = int(element.get("r", sheet.height + 1))
        row = sheet.height - 1
        sheet.hidden_rows += [range(row, row + 1)] * is_hidden
        for place, cell in enumerate(element):
            is_formula = len(cell) and _kind(cell[0]) == "f"
            text = cell.get("t") == "e" and cell.findtext("{*}v")
            if is_formula and not cell.findtext("{*}v") and cell.get("t") != "str":  # of texts ""
                text = NO_RESULT.format(f"={cell[0].text or ''}"[:LONGEST_FORMULA])
            if text:
                sheet.marks.append(Mark(row, _column(cell, place), 1, 1, text))
        if len(element):
            sheet.width = max(sheet.width, _column(element[-1], len(element) - 1) + 1)
        element.clear()
    return sheet


def _of_ods(file: IO[bytes]) -> Iterator[tuple[str, Marks]]:
    sheet, row, seen = Marks(), 0, 0
    for _, element in iterparse(file):
        own = _by_name(element)
        is_hidden = own.get("visibility", "visible") != "visible"
        if _kind(element) == "table":
            yield own["name"], sheet
            sheet, row, seen = Marks(), 0, 0
        if _kind(element) == "table-column":
            first, seen = seen, seen + int(own.get("number-columns-repeated", 1))
            sheet.hidden_columns += [range(first, seen)] * is_hidden
        if _kind(element) != "table-row":
            continue
        column, rows = 0, int(own.get("number-rows-repeated", 1))
        sheet.hidden_rows += [range(row, row + rows)] * is_hidden
        for cell in element:
            own = _by_name(cell)
            columns = int(own.get("number-columns-repeated", 1))
            shown = "".join("".join(part.itertext()) for part in cell if _kind(part) == "p")
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
            if text or kinds or shown:
                sheet.height, sheet.width = row + rows, max(sheet.width, column)
        row += rows
        element.clear()


def _by_name(element: Element) -> dict[str, str]:
    return {key.rpartition("}")[2]: value for key, value in element.items()}
