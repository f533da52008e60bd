"""A document as pages of a PDF."""

from collections.abc import Iterator, Sequence
from io import BytesIO
from itertools import chain
from pathlib import Path
from textwrap import wrap
from typing import TYPE_CHECKING, Any, NamedTuple

from matplotlib.backends.backend_pdf import PdfPages
from matplotlib.figure import Figure
from matplotlib.image import imread
from matplotlib.lines import Line2D

from carom.plots import look
from carom.plots.legends import text_width
from carom.plots.result import png

if TYPE_CHECKING:
    from carom.plots.documents import Section

PAGE, MARGIN = (595.3, 841.9), 45.0  # A4 in points
ROOM, GAP = PAGE[0] - 2.0 * MARGIN, 8.0  # of texts, and between columns of a table
TALLEST = 650.0  # figure
ADVANCE, NARROW, EVEN = 1.4, 0.35, 0.61  # line to line, narrow letters, those of code, in sizes
FONTS: dict[str, Any] = {
    "title": {"size": 16.0, "weight": "bold"},
    "heading": {"size": 11.0, "weight": "bold"},
    "head": {"size": 9.0, "weight": "bold"},
    "text": {"size": 9.0},
    "code": {"size": 7.5, "family": "monospace"},
}


class Block(NamedTuple):
    """What is not parted: its height, texts and where they begin, a rule below, or a picture."""

    height: float
    texts: Sequence[tuple[float, str]] = ()
    font: str = "text"
    ruled: bool = False
    picture: Figure | None = None


def write_pdf(where: Path, title: str, sections: Sequence["Section"]) -> None:
    """Write a title and sections on pages of A4."""
    with look.using(look.carom_settings()), look.quiet(), PdfPages(where) as pdf:
        pieces = [piece for section in sections for piece in _pieces(section)]
        pages = _pages([_text(title, "title"), *pieces])
        for number, blocks in enumerate(pages, 1):
            pdf.savefig(_drawn(blocks, f"{number}"))


def _pieces(section: "Section") -> Iterator[list[Block]]:
    """Yield what stands together on a page: heading, figure or table, and what is said of it."""
    above = [Block(8.0), *_text(section.heading, "heading")]
    texts, codes = map(_text, section.paragraphs), section.code.split("\n\n")
    shown = _table(section.table) if section.table else []
    if section.draw:
        figure = section.draw()
        shown = [Block(min(72.0 * figure.get_figheight(), TALLEST), picture=figure)]
    first = [[*shown, *chain(*texts)]] if shown else texts
    for part in (*first, *(_text(code.strip(), "code") for code in codes if code.strip())):
        yield [*above, *part]
        above = []


def _text(words: str, font: str = "text") -> list[Block]:
    return [_row([(0.0, ROOM, words)], font)]


def _table(table: Sequence[Sequence[str]]) -> list[Block]:
    """Return the rows of a table, the widest column of which is made narrower until all fit."""
    widths = [max(_width(cell, "text") for cell in column) for column in zip(*table, strict=True)]
    while sum(widths) + GAP * len(widths) > ROOM:
        widths[widths.index(max(widths))] -= 2.0
    starts = [sum(widths[:place]) + GAP * place for place in range(len(widths))]
    rows = [list(zip(starts, widths, row, strict=True)) for row in table]
    return [_row(row, "text" if place else "head", True) for place, row in enumerate(rows)]


def _row(
    cells: Sequence[tuple[float, float, str]], font: str = "text", ruled: bool = False
) -> Block:
    """Return texts beside each other, each from where it begins, in as much room as it has."""
    texts = [(start, _fitting(words, font, room)) for start, room, words in cells]
    lines = 1 + max(words.count("\n") for _, words in texts)
    return Block(ADVANCE * FONTS[font]["size"] * lines + 5.0, texts, font, ruled)


def _fitting(text: str, font: str, room: float) -> str:
    """Return a text on lines that are no wider than some points."""
    plain = text.encode(errors="replace").decode()
    most = int(room / FONTS[font]["size"] / (EVEN if font == "code" else NARROW))
    for letters in range(most, 0, -1):
        lines = [part for line in plain.splitlines() for part in wrap(line, letters)]
        if font == "code" or all(_width(line, font) <= room for line in lines):
            break
    return "\n".join(lines)


def _width(words: str, font: str) -> float:
    return text_width(words.replace("$", "S"), FONTS[font]["size"])  # they are no formulas


def _pages(pieces: Sequence[list[Block]]) -> Iterator[list[Block]]:
    """Yield the blocks of each page; a piece that is higher than a page goes on on the next."""
    page: list[Block] = []
    left = whole = PAGE[1] - 2.0 * MARGIN
    for piece in pieces:
        needed = sum(block.height for block in piece)
        for block in piece:
            if page and (needed if needed < whole else block.height) > left:
                yield page
                page, left = [], whole
            page.append(block)
            left, needed = left - block.height, needed - block.height
    yield page


def _drawn(blocks: Sequence[Block], number: str) -> Figure:
    width, height = PAGE
    page, top = Figure(figsize=(width / 72.0, height / 72.0)), height - MARGIN
    page.text(0.5, 0.5 * MARGIN / height, number, ha="center", **FONTS["text"])
    for block in blocks:
        for start, words in block.texts:
            place = (MARGIN + start) / width, top / height
            page.text(*place, words, va="top", parse_math=False, **FONTS[block.font])
        top -= block.height
        if block.ruled:
            ends = MARGIN / width, 1.0 - MARGIN / width
            page.add_artist(Line2D(ends, [(top + 2.0) / height] * 2, color="0.8", lw=0.5))
        if block.picture:
            pixels = imread(BytesIO(png(block.picture, look.DPI)))
            across = block.height * pixels.shape[1] / pixels.shape[0]
            box = MARGIN / width, top / height, across / width, block.height / height
            axis = page.add_axes(box, frameon=False, xticks=[], yticks=[])
            axis.imshow(pixels, interpolation="none", aspect="auto")
    return page
