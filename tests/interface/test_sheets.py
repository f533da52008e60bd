"""Sheets of spreadsheets: which is read, cells without a value, what is hidden or merged."""

import io
from datetime import datetime

import openpyxl
import pytest
from odf.opendocument import OpenDocumentSpreadsheet
from odf.table import CoveredTableCell, Table, TableCell, TableColumn, TableRow
from odf.text import P
from tests.checks import PAIR, refused

import carom
from carom.io.tables import read_table


def sheets(**rows):
    book = openpyxl.Workbook()
    book.remove(book.active)
    for name, cells in rows.items():
        sheet = book.create_sheet(name)
        for row in cells:
            sheet.append(row)
    return of_book(book)


def of_book(book):
    file = io.BytesIO()
    book.save(file)
    return file.getvalue()


ROWS = [["psi_1", "psi_2"], [1.0, -0.1], [2.0, -0.5], [3.0, -1.0]]


def test_a_sheet_is_named_where_several_may_be_meant(stored):
    other = [ROWS[0], [4.0, 0.5], [5.0, 0.6]]
    file = stored(sheets(One=ROWS, Two=other, Text=[["psi_1"], ["x"]]), "lab.xlsx")
    refused(r"its sheets 'One', 'Two' may be meant; say which, by .*lab.xlsx:One", read_table, file)
    for table in (read_table(f"{file}:Two"), read_table(file, sheet="Two")):
        assert table.cells["psi_in"].cells.tolist() == [4.0, 5.0]
    refused("no such sheet; did you mean 'Two'", read_table, file, sheet="two")
    refused("leave one of them out", read_table, f"{file}:One", sheet="Two")
    alone = read_table(stored(sheets(One=ROWS, Text=[["psi_1"], ["x"]]), "lab.xlsx"))
    assert alone.notes == ("the sheet 'One' was read, not 'Text'",)
    refused("is no spreadsheet; leave it out", read_table, stored("a,b\n1,2\n"), sheet="One")


def test_cells_of_sheets_keep_their_types(stored):
    damaged = [["speed", "angle [deg]"], [datetime(2026, 5, 1), 10.0], [True, "20,5"], [1.5, 30.0]]
    line = refused(
        "speed: not a number in cells A2 and A3", carom.fit, stored(sheets(A=damaged)), pair=PAIR
    )
    assert "'2026-05-01' cannot be used" in line
    texts = [["psi_1", "psi_2"], ["0,5", -0.1], ["1,25", "0,5"]]
    table = read_table(stored(sheets(A=texts)))
    assert table.column("psi_in").cells.tolist() == [0.5, 1.25]


def test_what_is_a_comment_in_a_sheet_stands_alone(stored):
    """A label of a row, which begins as a comment does, is none."""
    rows = [["# by hand"], ['# case: {"friction": 0.3}'], ["ball", *ROWS[0]], ["#1", *ROWS[1]]]
    table = read_table(stored(sheets(A=[*rows, ["% warm"], [], ["#2", *ROWS[2]]])))
    assert table.rows.tolist() == [4, 7]
    assert table.case == {"friction": 0.3}
    assert read_table(stored("a;b;c\n;\n1;2;3\n")).names == ("a", "b", "c")


def test_a_percentage_of_a_sheet_is_not_taken_for_a_ratio_of_one(stored):
    rows = [["normal_speed", "normal_restitution [%]"], [1.0, 0.95], [2.0, 0.93]]
    refused("may show as 95 %; write ratios", carom.fit, stored(sheets(A=rows)), pair=PAIR)
    rows = [rows[0], [1.0, 95.0], [2.0, 93.0], [3.0, 92.0]]
    assert carom.fit(stored(sheets(A=rows)), pair=PAIR).restitution.value == pytest.approx(
        0.93, abs=0.02
    )


def document(*rows, hidden=(), hidden_columns=()):
    """Return an .ods of rows of numbers, texts, or attributes of a cell and what it shows.

    Of columns it says that one is shown, and so many after it are hidden.
    """
    book, sheet, file = OpenDocumentSpreadsheet(), Table(name="A"), io.BytesIO()
    for place, count in enumerate(hidden_columns):
        look = {"visibility": "collapse"} if place else {}
        sheet.addElement(TableColumn(numbercolumnsrepeated=count, **look))
    for number, cells in enumerate(rows, 1):
        row = TableRow(**({"visibility": "filter"} if number in hidden else {}))
        for cell in cells:
            own, shown = cell if isinstance(cell, tuple) else ({}, cell)
            if isinstance(shown, float):
                own, shown = {"valuetype": "float", "value": shown, **own}, f"{shown:g}"
            elif shown and not own:
                own = {"valuetype": "string"}
            extended = own.pop("extended", None)
            element = (CoveredTableCell if own.pop("covered", 0) else TableCell)(**own)
            if extended:  # as LibreOffice marks errors
                element.setAttrNS(CALCEXT, "value-type", extended)
            element.addElement(P(text=shown))
            row.addElement(element)
        sheet.addElement(row)
    book.spreadsheet.addElement(sheet)
    book.write(file)
    return file.getvalue()


def workbook(*rows, merged=()):
    """Return an .xlsx of rows of cells; a text that begins with # is an error, with = a formula."""
    book = openpyxl.Workbook()
    for cells in rows:
        book.active.append(cells)
        for cell in book.active[book.active.max_row]:
            cell.data_type = "e" if str(cell.value).startswith("#") else cell.data_type
    for cells in merged:
        book.active.merge_cells(cells)
    return of_book(book)


CALCEXT = "urn:org:documentfoundation:names:experimental:calc:xmlns:calcext:1.0"
HEADS = ["angle [deg]", "speed [m/s]", "spin_out [rpm]"]
DIVIDED = {"formula": "of:=1/0", "valuetype": "string", "stringvalue": "", "extended": "error"}
OLD_ERROR = {"formula": "of:=1/0", "valuetype": "float", "value": 0.0}  # of OpenOffice
NO_RESULT = {"formula": "of:=-[.A5]*9.5"}
DATE = {"valuetype": "date", "datevalue": "2026-05-01"}
TRUE = {"valuetype": "boolean", "booleanvalue": "true"}
ODD_CELLS = [  # in a column of spins of .xlsx and .ods, and what is said of it
    ("#N/A", (DIVIDED, "#N/A"), "missing"),
    ("#N/A", (DIVIDED, "#NV"), "missing"),
    ("#DIV/0!", (DIVIDED, "#DIV/0!"), "'#DIV/0!' cannot be used"),
    ("#REF!", (OLD_ERROR, "#REF!"), "'#REF!' cannot be used"),
    ("#VALUE!", (DIVIDED, "#WERT!"), "' cannot be used"),
    ("#NUM!", (OLD_ERROR, "Err:502"), "' cannot be used"),
    ("=-A5*9.5", (NO_RESULT, ""), "has no result; store the file in a spreadsheet program"),
    (datetime(2026, 5, 1), (DATE, "1. Mai"), "'2026-05-01' cannot be used"),
    (True, (TRUE, "WAHR"), "True cannot be used"),
    ("rund 500", "rund 500", "'rund 500' cannot be used"),
]


@pytest.mark.first_case
@pytest.mark.parametrize(("excel", "other", "words"), ODD_CELLS)
def test_cells_without_a_value_are_never_silently_missing(excel, other, words, stored):
    """An error, a formula that no program has calculated: told by its cell; #N/A is counted."""
    rows = [[10.0 * i, 1.0, -200.0 * i] for i in (1, 2, 3)]
    for cell, make in ((excel, workbook), (other, document)):
        file = stored(make(HEADS, *rows, [40.0, 1.0, cell], [50.0, 1.0, -800.0]))
        if words == "missing":
            result = carom.fit(file, pair=PAIR, fixed={"restitution": 1.0})
            assert "1 value missing: spin_out in cell C5" in result.notes
        else:
            line = refused("^spin_out: not a number in cell C5; ", carom.fit, file, pair=PAIR)
            assert words in line


def test_errors_at_the_edges_of_a_sheet_are_found(stored):
    """In the last row and column, where no cell has a value; in cells that are repeated."""
    rows = [*HEADS, "spin"], [10.0, 1.0, -200.0, "=A2"], [20.0, 1.0, "#NUM!", "=A3"]
    line = refused("^2 faults: ", carom.fit, stored(workbook(*rows)), pair=PAIR)
    assert "spin_out: not a number in cell C3; '#NUM!'" in line
    assert "spin: not a number in every row of column D; '=A2 has no result" in line
    twice = {**DIVIDED, "numbercolumnsrepeated": 2}
    table = read_table(stored(document(["a", "b", "c"], [1.0, (twice, "#DIV/0!")], [1.0] * 3)))
    assert [column.cells[0] for column in table.cells.values()] == [1.0, "#DIV/0!", "#DIV/0!"]


@pytest.mark.slow
def test_what_is_hidden_is_read_and_said(stored):
    """Rows, as a filter or a hand hides them, and columns; blank ones are not counted."""
    rows = [HEADS, *([10.0 * i, 1.0, -200.0 * i] for i in (1, 2, 3, 4)), [None] * 3]
    book = openpyxl.Workbook()
    for cells in rows:
        book.active.append(cells)
    for number in (3, 4, 6):
        book.active.row_dimensions[number].hidden = True
    odf = document(HEADS, *rows[1:5], [""] * 3, hidden=(3, 4, 6))
    told = "hidden, as by a filter, and read all the same: rows 3 and 4; delete what is not meant"
    for content in (of_book(book), odf):
        result = carom.fit(stored(content), pair=PAIR, fixed={"restitution": 1.0})
        assert told in result.notes
        assert result.to_dict()["rows"] == 4
    book.active.column_dimensions.group("B", "E", hidden=True)
    odf = document(HEADS, *rows[1:5], [""] * 3, hidden=(3, 4, 6), hidden_columns=(1, 3))
    for content in (of_book(book), odf):
        table = read_table(stored(content))
        assert told.replace("4;", "4 and columns B and C;") in table.notes
    shown = carom.fit(stored(workbook(*rows[:5])), pair=PAIR, fixed={"restitution": 1.0})
    assert not [note for note in shown.notes if "hidden" in note]


def test_a_number_of_merged_cells_is_that_of_none_beside(stored):
    """Nor is it missing there: an angle over three rows has to be written into each."""
    rows = [HEADS, [10.0, 1.0, -200.0], [20.0, 1.0, -400.0], [None, 1.0, -420.0]]
    words = "angle: not a number in cell A4; 'merged with A3' cannot be used"
    refused(words, carom.fit, stored(workbook(*rows, merged=["A3:A4"])), pair=PAIR)
    rows[2:] = [({"numberrowsspanned": 2}, 20.0), 1.0, -400.0], [({"covered": 1}, ""), 1.0, -420.0]
    refused(words, carom.fit, stored(document(*rows)), pair=PAIR)
    beyond = ["A9:B9", "C2:E3", "A2:A90"]
    table = read_table(stored(workbook(*ROWS_OF_FIVE, merged=beyond)))
    assert [column.cells[1] for column in table.cells.values()] == [
        "merged with A2",
        1.0,
        "merged with C2",
    ]
    titled = [["Versuche", None, None], *ROWS_OF_FIVE]
    table = read_table(stored(workbook(*titled, merged=["A1:C1"])))
    assert table.rows.tolist() == [3, 4, 5]


ROWS_OF_FIVE = [HEADS, *([10.0 * i, 1.0, -200.0 * i] for i in (1, 2, 3))]


def test_percentages_of_a_sheet_are_ratios(stored):
    rows = [["normal_speed", "normal_restitution"], [1.0, 0.95], [2.0, 0.93], [3.0, 0.92]]
    book = openpyxl.load_workbook(io.BytesIO(workbook(*rows)))
    for cell in book.active["B"]:
        cell.number_format = "0%"
    rows[1:] = [[a, ({"valuetype": "percentage", "value": e}, "95 %")] for a, e in rows[1:]]
    for content in (of_book(book), document(*rows)):
        table = read_table(stored(content))
        assert table.cells["normal_restitution"].cells.tolist() == [0.95, 0.93, 0.92]


BROKEN = {
    b"PK\x03\x04" + b"x" * 100: "it is no spreadsheet",
    b"\xd0\xcf\x11\xe0" + b"\0" * 600: "it is no spreadsheet",
    b"\xd0\xcf\x11\xe0" + b"\0" * 9: "of Excel before 2007, or has a password; store it as .xlsx",
    sheets(A=[]): "it is empty",
    sheets(A=[["a"]]): "it is not a table; give columns, at least 2",
    sheets(A=[["a", "b"]]): "no rows",
    sheets(A=[[1.0, 2.0], [3.0, 4.0]]): "the first line holds numbers",
    sheets(A=[["a", "a"], [1.0, 2.0]]): "two columns, A and B, have this name",
}


@pytest.mark.parametrize("content", BROKEN, ids=BROKEN.values())  # content has its time in it
def test_spreadsheets_without_a_table_are_refused(content, stored):
    refused(BROKEN[content], read_table, stored(content, "lab.xlsx"))


def test_cells_far_apart_take_no_memory(stored):
    book = openpyxl.Workbook()
    book.active["A1"] = "angle"
    book.active["XFD1048576"] = 1.0
    refused("a sheet extends to XFD1048576", read_table, stored(of_book(book)))
