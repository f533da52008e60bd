"""The XML of a spreadsheet, unpacked from its archive within limits, for whoever reads it.

What an archive tells of its sizes may be false: all is counted as it is unpacked, before it is
read. Readers get a copy of just that, so that no other reader of archives finds more in it.
"""

import io
from collections.abc import Iterator
from typing import IO
from xml.etree.ElementTree import Element, iterparse
from zipfile import ZIP_DEFLATED, ZIP_STORED, BadZipFile, ZipFile

MOST_PACKED = 1 << 26  # bytes, with pictures, which are left packed
MOST_UNPACKED = 1 << 26  # bytes of XML
MOST_TAGS = 5_000_000  # in it, where a cell with a number has four
MOST_PARTS = 10_000  # of an archive
LONGEST_TEXT = 1 << 20  # bytes without a tag
MOST_ELEMENTS = 400_000  # and attributes of a row, or between rows: a full one has 16,384 cells
BOM = b"\xef\xbb\xbf \t\r\n"
PIECE = 1 << 18  # bytes unpacked at a time
PART = b"PK\x01\x02"  # begins what an archive tells of each of its parts
XML = (".xml", ".rels")
BESIDE = ("docProps/", "customXml/")  # of which nobody reads anything here
MIMETYPE, LONGEST_TYPE = "mimetype", 100  # of an .ods
ENTITY = b"<!ENTITY"  # which stands for a text again and again
ROWS = ("row", "table-row", "si")  # of sheets; of texts that cells share


class TooMuch(Exception):
    """There is more in a spreadsheet than is read; the message says what, and what to do."""

    def __init__(self, words: str, remedy: str = "store the table as CSV") -> None:
        super().__init__(f"{words}; {remedy}")


def unpacked(file: IO[bytes]) -> io.BytesIO:
    """Return the XML of a spreadsheet as an archive of its own; raise TooMuch at the first excess.

    A damaged archive raises what its reader does.
    """
    content = file.read(MOST_PACKED + 1)
    if len(content) > MOST_PACKED:
        raise TooMuch(f"it has more than {MOST_PACKED} bytes")
    if content.count(PART) > MOST_PARTS:
        raise TooMuch(f"its archive has more than {MOST_PARTS} parts")
    size, tags, bare, copy = 0, 0, 0, io.BytesIO()
    with ZipFile(io.BytesIO(content)) as archive, _new(copy) as whole:
        for name in dict.fromkeys(archive.namelist()):
            if name == MIMETYPE:
                whole.writestr(name, archive.open(name).read(LONGEST_TYPE))
            if not name.endswith(XML) or name.startswith(BESIDE):
                continue
            for piece in _pieces(archive, whole, name):
                size, tags = size + len(piece), tags + piece.count(b"<")
                bare = 0 if b"<" in piece else bare + len(piece)
                if bare > LONGEST_TEXT:
                    raise TooMuch(f"a text in it has more than {LONGEST_TEXT} characters")
                if size > MOST_UNPACKED:
                    raise TooMuch(f"it unpacks to more than {MOST_UNPACKED} bytes")
                if tags > MOST_TAGS:
                    raise TooMuch(f"it unpacks to more than {MOST_TAGS} tags of XML")
    copy.seek(0)
    return copy


def _new(copy: io.BytesIO) -> ZipFile:
    return ZipFile(copy, "w", ZIP_DEFLATED, compresslevel=1)


def _pieces(archive: ZipFile, whole: ZipFile, name: str) -> Iterator[bytes]:
    """Yield a part of an archive piece by piece, and put it into another one.

    Raises BadZipFile if it is not packed, or not written, as spreadsheet programs do.
    """
    if archive.getinfo(name).compress_type not in (ZIP_STORED, ZIP_DEFLATED):
        raise BadZipFile(f"{name} is packed as in no spreadsheet")
    before = b""
    with archive.open(name) as source, whole.open(name, "w") as target:
        while piece := source.read(PIECE):
            seen = before + piece
            is_utf8 = b"\0" not in piece and (before or seen.lstrip(BOM)[:1] == b"<")
            if ENTITY in seen or not is_utf8:
                raise BadZipFile(f"{name} is written as in no spreadsheet")
            yield piece
            target.write(piece)
            before = piece[-len(ENTITY) :]


def elements(file: IO[bytes]) -> Iterator[Element]:
    """Yield each element of XML at its end; rows come with what is in them, and are dropped then.

    Raises TooMuch where so many are open, in a row or outside of rows, that they fill the memory.
    """
    above: list[Element] = []
    held, row = 0, 0  # row: how deep the open one is, 0 outside of rows
    for event, element in iterparse(file, ("start", "end")):
        if event == "start":
            above.append(element)
            held += 1 + len(element.attrib)
            if held > MOST_ELEMENTS:
                words = "elements and attributes of XML"
                raise TooMuch(f"a row has more than {MOST_ELEMENTS} {words}")
            if not row and kind(element) in ROWS:
                row = len(above)
            continue
        depth = len(above)
        above.pop()
        if row and depth > row:
            continue
        yield element
        if depth == row:
            element.clear()
            for parent in above[-1:]:
                parent.remove(element)
            held, row = 0, 0


def kind(element: Element) -> str:
    """Return the name of an element without that of its namespace."""
    return element.tag.rpartition("}")[2]
