"""Small spreadsheets that would fill the memory: refused in a line, or read, within 300 MB."""

import io
import struct
import subprocess
import sys
import zipfile

import openpyxl
import pytest
from tests.checks import refused
from tests.interface.test_sheets import document

from carom.io import spreadsheets, unpacking
from carom.io.tables import read_table

MOST = 300.0  # MB more than without a file
SHEET, SHARED = "xl/worksheets/sheet1.xml", "xl/sharedStrings.xml"
ROWS = [["angle [deg]", "speed [m/s]"], *([10.0 + i, 1.0] for i in range(5))]
END = b"</sheetData>"
MB = 1 << 20
NAMESPACE = b'"http://schemas.openxmlformats.org/spreadsheetml/2006/main"'
MEASURED = """
import sys
import carom.cli, pandas, python_calamine
from carom.io.tables import read_table

def memory(name):
    lines = open("/proc/self/status").read().splitlines()
    return next(int(line.split()[1]) / 1024.0 for line in lines if line.startswith(name))

before = memory("VmHWM")
for path in sys.argv[1:]:
    open("/proc/self/clear_refs", "w").write("5")  # what is most from now on
    try:
        told = str(len(read_table(path)))
    except carom.InputError as error:
        told = str(error)
    print(f"{memory('VmHWM') - before:.0f} {told}", flush=True)
"""


def plain(change=lambda book: None):
    file, book = io.BytesIO(), openpyxl.Workbook()
    for row in ROWS:
        book.active.append(row)
    change(book)
    book.save(file)
    return file.getvalue()


def with_parts(content, method=zipfile.ZIP_DEFLATED, parts=()):
    """A spreadsheet with parts, in pieces, in the place of its own or beside them."""
    file = io.BytesIO()
    with zipfile.ZipFile(io.BytesIO(content)) as old, zipfile.ZipFile(file, "w", method) as new:
        whole = {name: [old.read(name)] for name in old.namelist()} | dict(parts)
        for name, pieces in whole.items():
            with new.open(name, "w", force_zip64=True) as part:
                for piece in pieces:
                    part.write(piece)
    return file.getvalue()


def in_sheet(pieces, before=END, end=b""):
    """An .xlsx with more in its sheet, before the end of its rows or elsewhere."""
    content = plain()
    with zipfile.ZipFile(io.BytesIO(content)) as archive:
        first, rest = archive.read(SHEET).split(before, 1)
    return with_parts(content, parts={SHEET: [first, *pieces, end, before, rest]})


def in_document(cell):
    """An .ods with one more row, as it is written."""
    content = document(*ROWS)
    with zipfile.ZipFile(io.BytesIO(content)) as archive:
        text = archive.read("content.xml")
    first, end, rest = text.partition(b"</table:table>")
    return with_parts(content, parts={"content.xml": [first, *cell, end, rest]})


def shared(texts, cells):
    """An .xlsx of which cells refer to texts that they share."""
    content = in_sheet(cells)
    kinds = "[Content_Types].xml"
    said = "application/vnd.openxmlformats-officedocument.spreadsheetml.sharedStrings+xml"
    with zipfile.ZipFile(io.BytesIO(content)) as archive:
        types, relations = (archive.read(name) for name in (kinds, spreadsheets.RELATIONS))
    own = f'<Override PartName="/{SHARED}" ContentType="{said}"/></Types>'.encode()
    target = b'<Relationship Id="rS" Type="http://schemas.openxmlformats.org/officeDocument/2006/'
    target += b'relationships/sharedStrings" Target="sharedStrings.xml"/></Relationships>'
    parts = {
        SHARED: [b"<sst xmlns=", NAMESPACE, b">", *texts, b"</sst>"],
        kinds: [types.replace(b"</Types>", own)],
        spreadsheets.RELATIONS: [relations.replace(b"</Relationships>", target)],
    }
    return with_parts(content, parts=parts)


def lying(size):
    """The headers of the archive tell another size than its sheet has."""
    content = bytearray(in_sheet([b" " * MB] * 100))
    with zipfile.ZipFile(io.BytesIO(content)) as archive:
        own = archive.getinfo(SHEET).file_size
    for place in range(len(content) - 4):
        if content[place : place + 4] == struct.pack("<I", own):
            content[place : place + 4] = struct.pack("<I", size)
    return bytes(content)


def text_in_one_cell(count):
    return in_sheet([CELL[0], *[b"a" * MB] * count, CELL[1]])


def in_cells(unit, count, row=b"<row>", end=b"</row>"):
    return in_sheet([row, *[unit * 10_000] * (count // 10_000), end])


CELL = b'<row r="7"><c r="A7" t="inlineStr"><is><t>', b"</t></is></c></row>"
CDATA = b"<![CDATA[" + b"<" * 1000 + b"a" * (MB // 2) + b"]]>"
REPEATED = (
    b'<table:table-row table:number-rows-repeated="%d"><table:table-cell office:value-type="%s" '
    b'office:%s="%s" table:number-columns-repeated="%d"/></table:table-row>'
)
XL = "it unpacks to more than"
BOMBS = {
    "text": (lambda: text_in_one_cell(60), "a text in it has more than"),
    "text of 160 MB": (lambda: text_in_one_cell(160), "a text in it has more than"),
    "blanks": (lambda: in_sheet([b" " * MB] * 900), "a text in it has more than"),
    "blanks between tags": (lambda: in_sheet([b"<x/>" + b" " * MB] * 900), XL),
    "marked text": (
        lambda: in_sheet([CELL[0], *[CDATA] * 110, CELL[1]]),
        "",
    ),
    "cells in a row": (lambda: in_cells(b"<c/>", 4_000_000), "a row has more than 400000"),
    "cells with attributes": (lambda: in_cells(b'<c r="A8" s="1"/>', 3_000_000), "a row has"),
    "rows": (lambda: in_cells(b"<row/>", 4_500_000, b"", b""), ""),
    "hidden rows": (lambda: in_cells(b'<row hidden="1"/>', 3_000_000, b"", b""), "are marked"),
    "what is no row": (lambda: in_cells(b"<x/>", 4_000_000, b"", b""), "a row has more than"),
    "nested": (lambda: in_cells(b"<x>", 4_000_000, b"", b""), "a row has more than"),
    "errors": (
        lambda: in_cells(b'<row><c t="e"><v>#N</v></c></row>', 800_000, b"", b""),
        "are marked",
    ),
    "attributes": (
        lambda: in_sheet([b"<x", *(b' a%d="1"' % i for i in range(4_000_000)), b"/>"]),
        "a text in it has more than",
    ),
    "merged": (
        lambda: in_cells(b'<mergeCell ref="A1:XFD1048576"/>', 300_000, b"<mergeCells>", b""),
        "",
    ),
    "hidden columns": (
        lambda: in_cells(b'<col min="1" max="16384" hidden="1"/>', 90_000, b"<cols>", b"</cols>"),
        "",
    ),
    "far apart": (lambda: in_sheet([b'<row r="1048576"><c r="XFD1048576"><v>1</v></c></row>']), ""),
    "tags": (lambda: in_cells(b"<row><c><v>1</v></c></row>", 1_500_000, b"", b""), "tags of XML"),
    "shared text": (
        lambda: shared(
            [b"<si><t>", b"a" * 30_000, b"</t></si>"],
            [b"<row>" + b'<c t="s"><v>0</v></c>' * 10 + b"</row>"] * 3_000,
        ),
        "its cells hold more than 67108864 characters",
    ),
    "shared texts": (lambda: shared([b"<si/>" * 10_000] * 490, []), ""),
    "one shared text": (
        lambda: shared([b"<si><t>", *[b"a" * MB] * 60, b"</t></si>"], []),
        "a text in it has more than",
    ),
    "entities": (
        lambda: in_sheet([], before=b"<worksheet", end=b'<!DOCTYPE x [<!ENTITY a "aaaa">]>'),
        "is written as in no spreadsheet",
    ),
    "another encoding": (
        lambda: with_parts(plain(), parts={SHEET: ["<worksheet/>".encode("utf-16")]}),
        "is written as in no spreadsheet",
    ),
    "lzma": (lambda: with_parts(plain(), zipfile.ZIP_LZMA), "is packed as in no spreadsheet"),
    "bzip2": (lambda: with_parts(plain(), zipfile.ZIP_BZIP2), "is packed as in no spreadsheet"),
    "sizes that are false": (lambda: lying(100), "no spreadsheet"),
    "sizes that are false and large": (lambda: lying(0xFFFFFFF0), ""),
    "parts": (
        lambda: with_parts(plain(), parts={f"x{i}": [] for i in range(11_000)}),
        "its archive has more than 10000 parts",
    ),
    "repeated numbers": (
        lambda: in_document([REPEATED % (1_000_000, b"float", b"value", b"1", 16_000)]),
        "a sheet extends to",
    ),
    "repeated texts": (
        lambda: in_document([REPEATED % (1000, b"string", b"string-value", b"a" * 60_000, 1000)]),
        "its cells hold more than",
    ),
    "repeated blanks": (
        lambda: in_document(
            [b'<table:table-row table:number-rows-repeated="2000000000"><table:table-cell/>'
             b"</table:table-row>", REPEATED % (1, b"float", b"value", b"1", 1)]
        ),
        "a sheet extends to",
    ),
    "a blank column repeated": (
        lambda: in_document(
            [b'<table:table-row><table:table-cell table:number-columns-repeated="2000000000"/>'
             b"</table:table-row>"]
        ),
        "",
    ),
    "texts of an .ods": (
        lambda: in_document(
            [b'<table:table-row><table:table-cell office:value-type="string"><text:p>',
             *[b"a" * MB] * 60, b"</text:p></table:table-cell></table:table-row>"]
        ),
        "a text in it has more than",
    ),
    "styles": (
        lambda: with_parts(
            plain(), parts={"xl/styles.xml": [b"<styleSheet><cellXfs>", *[b"<xf/>" * 1000] * 4500]}
        ),
        "",
    ),
    "relations": (
        lambda: with_parts(
            plain(), parts={spreadsheets.RELATIONS: [b"<R>", *[b"<Relationship/>" * 1000] * 3000]}
        ),
        "a row has more than",
    ),
}  # fmt: skip


@pytest.mark.slow
@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="its memory is told elsewhere")
def test_what_unpacks_to_much_is_refused_or_read_within_the_memory(tmp_path):
    """Each of these is below 12 MB; without limits they take up to some GB, or hours."""
    paths = []
    for name, (make, _) in BOMBS.items():
        paths.append(tmp_path / f"{name.replace(' ', '_')}.xlsx")
        paths[-1].write_bytes(make())
        assert paths[-1].stat().st_size < 12 * MB
    run = [sys.executable, "-c", MEASURED, *map(str, paths)]
    ran = subprocess.run(run, capture_output=True, text=True, check=True, timeout=300)
    for name, line in zip(BOMBS, ran.stdout.splitlines(), strict=True):
        more, told = line.split(" ", 1)
        print(name, more, told)
        assert float(more) < MOST, line
        assert BOMBS[name][1] in told, line


def counted(content, count):
    with zipfile.ZipFile(io.BytesIO(content)) as archive:
        names = [name for name in archive.namelist() if not name.startswith(unpacking.BESIDE)]
        return sum(count(archive.read(name)) for name in names)


def hidden(book):
    """Two marks."""
    book.active.row_dimensions[2].hidden = True
    book.active.column_dimensions["B"].hidden = True


LIMITS = {  # each with what a small spreadsheet has of it
    "MOST_PACKED": (unpacking, len, "it has more than"),
    "MOST_PARTS": (unpacking, lambda content: content.count(b"PK\x01\x02"), "parts"),
    "MOST_UNPACKED": (unpacking, lambda content: counted(content, len), "it unpacks to more"),
    "MOST_TAGS": (unpacking, lambda content: counted(content, lambda xml: xml.count(b"<")), "tags"),
    "MOST_CELLS": (spreadsheets, lambda _: 2 * 6, "a sheet extends to B6; delete what stands far"),
    "MOST_MARKS": (spreadsheets, lambda _: 2, "of its rows, columns and cells are marked"),
}


@pytest.mark.parametrize("name", LIMITS)
def test_a_limit_is_where_it_is_said(name, stored, monkeypatch):
    """As much is read, one more is not."""
    module, count, words = LIMITS[name]
    file = stored(plain(hidden), "lab.xlsx")
    most = count(file.read_bytes())
    monkeypatch.setattr(module, name, most)
    assert len(read_table(file)) == 5
    monkeypatch.setattr(module, name, most - 1)
    assert "lab.xlsx' cannot be used; " in refused(words, read_table, file)


def test_a_text_counts_as_often_as_cells_share_it(stored, monkeypatch):
    row = b'<row r="7"><c r="A7" t="s"><v>1</v></c><c r="B7" t="s"><v>1</v></c></row>'
    texts = [b"<si><t>a</t></si><si><r><t>twelve-</t></r><r><t>signs</t></r></si>"]
    file = stored(shared(texts, [row]), "lab.xlsx")
    monkeypatch.setattr(spreadsheets, "MOST_TEXT", 24)
    assert read_table(file).cells["angle"].cells[-1] == "twelve-signs"
    monkeypatch.setattr(spreadsheets, "MOST_TEXT", 23)
    refused("its cells hold more than 23 characters", read_table, file)


def test_a_row_is_as_long_as_programs_make_it(stored):
    """16,384 cells, each with a formula, are fewer elements than a row may have."""
    cell = '<c r="XFD7" s="1" t="n"><f t="shared" si="1">A1</f><v>1</v></c>'
    sheet = f"<row>{cell * 16_384}</row>".encode()
    assert [len(row) for row in unpacking.elements(io.BytesIO(sheet))] == [16_384]
    with pytest.raises(unpacking.TooMuch, match="a row has more than 400000 elements"):
        list(unpacking.elements(io.BytesIO(f"<row>{cell * 60_000}</row>".encode())))


def test_a_text_of_a_million_characters_is_read_and_a_longer_one_is_not(stored):
    file = stored(in_sheet([CELL[0], b"a" * (MB - unpacking.PIECE), CELL[1]]), "lab.xlsx")
    assert len(read_table(file)) == 6
    file = stored(in_sheet([CELL[0], b"a" * (MB + 2 * unpacking.PIECE), CELL[1]]), "lab.xlsx")
    refused("a text in it has more than 1048576 characters", read_table, file)


def test_the_page_lists_no_sheets_of_what_unpacks_to_much(stored):
    assert spreadsheets.sheets_of(stored(plain(), "lab.xlsx")) == ["Sheet"]
    assert spreadsheets.sheets_of(stored(in_sheet([b" " * MB] * 100), "lab.xlsx")) == []


def test_what_is_not_read_may_be_of_any_kind(stored):
    """Pictures stay packed; what Excel keeps of its queries is in another encoding."""
    parts = {"xl/media/image1.png": [bytes(MB)] * 70}
    parts["customXml/item1.xml"] = ["<DataMashup/>".encode("utf-16")]
    assert len(read_table(stored(with_parts(plain(), parts=parts), "lab.xlsx"))) == 5
