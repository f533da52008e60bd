"""Texts, tables and figures as one file that stands alone: HTML, or pages of a PDF."""

from collections.abc import Iterable, Iterator, Sequence
from html import escape
from io import BytesIO
from itertools import chain
from pathlib import Path
from textwrap import wrap
from typing import Any, NamedTuple

from matplotlib.backends.backend_pdf import PdfPages
from matplotlib.figure import Figure
from matplotlib.image import imread
from matplotlib.lines import Line2D

from carom.io.files import DOCUMENTS
from carom.io.paths import ending_of, replace_whole
from carom.plots import look
from carom.plots.result import Section, png, source

DPI, DENSE = 200, "1.7x"  # of images, and how many pixels of theirs are one of a screen
NARROW = 86.0  # mm, width of figures on a small screen
PAGE, MARGIN = (595.3, 841.9), 45.0  # A4 in points
ROOM, TALLEST = PAGE[0] - 2.0 * MARGIN, 650.0  # width of texts, height of a figure
LETTER, ADVANCE, GAP = 0.6, 1.4, 8.0  # of a letter and of a line, in sizes; between columns
FONTS: dict[str, Any] = {
    "title": {"size": 16.0, "weight": "bold"},
    "heading": {"size": 11.0, "weight": "bold"},
    "head": {"size": 9.0, "weight": "bold"},
    "text": {"size": 9.0},
    "code": {"size": 7.5, "family": "monospace"},
}
STYLE = """
body { font: 16px/1.5 system-ui, sans-serif; color: #1a1a1a; background: #fff; margin: 0 auto;
  max-width: 54rem; padding: 1rem; }
h1 { font-size: 1.5rem; line-height: 1.25; } h2 { font-size: 1.15rem; margin: 2rem 0 0.5rem; }
h1, p { overflow-wrap: anywhere; } td, th { overflow-wrap: break-word; }
table { border-collapse: collapse; font-size: 0.94rem; } .wide { overflow-x: auto; }
th, td { text-align: left; vertical-align: top; padding: 0.25rem 1rem 0.25rem 0;
  border-bottom: 1px solid #ddd; }
pre { white-space: pre-wrap; overflow-wrap: anywhere; background: #f4f4f4; padding: 0.7rem;
  font-size: 0.85rem; }
img { display: block; max-width: 100%; }
@media (max-width: 40rem) { table { font-size: 0.8rem; } th, td { padding-right: 0.5rem; } }
@media print { body { font-size: 10pt; padding: 0; } tr, img, pre { break-inside: avoid; }
  h2 { break-after: avoid; } }
"""


def write_document(target: Path, title: str, sections: Sequence[Section]) -> Path:
    """Write a document whole or not at all."""
    if ending_of(target, DOCUMENTS) == ".pdf":
        return replace_whole(target, lambda where: _write_pdf(where, title, sections))
    content = _html(title, sections)

    def write(where: Path) -> None:
        where.write_text(content, encoding="utf-8", errors="replace", newline="\n")

    return replace_whole(target, write)


def _html(title: str, sections: Sequence[Section]) -> str:
    return (
        '<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
        '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
        '<meta http-equiv="Content-Security-Policy" '
        "content=\"default-src 'none'; style-src 'unsafe-inline'; img-src data:\">\n"
        f"<title>{escape(title)}</title>\n<style>{STYLE}</style>\n</head>\n<body>\n"
        f"<h1>{escape(title)}</h1>\n{''.join(map(_section, sections))}</body>\n</html>\n"
    )


def _section(section: Section) -> str:
    parts = [f"<h2>{escape(section.heading)}</h2>"]
    if section.draw:
        wide, narrow = (source(section.draw(width=width), DPI) for width in (None, NARROW))
        image = f'<img alt="{escape(section.heading)}" srcset="{narrow} {DENSE}">'
        large = f'<source media="(min-width: 44rem), print" srcset="{wide} {DENSE}">'
        parts.append(f"<picture>{large}{image}</picture>")
    if section.table:
        head, *rows = section.table
        lines = [_row("th", head), *(_row("td", row) for row in rows)]
        parts.append(f'<div class="wide"><table>{"".join(lines)}</table></div>')
    parts += [f"<p>{escape(words)}</p>" for words in section.paragraphs]
    if section.code:
        parts.append(f"<pre>{escape(section.code)}</pre>")
    return "\n".join([*parts, ""])


def _row(tag: str, cells: Sequence[str]) -> str:
    return f"<tr>{''.join(f'<{tag}>{escape(cell)}</{tag}>' for cell in cells)}</tr>"


class Block(NamedTuple):
    """What is not parted: its height, texts and where they begin, a rule below, or a picture."""

    height: float
    texts: Sequence[tuple[float, str]] = ()
    font: str = "text"
    ruled: bool = False
    picture: Figure | None = None


def _write_pdf(where: Path, title: str, sections: Sequence[Section]) -> None:
    content = BytesIO()  # on a full disk matplotlib's file ends with an error of another kind
    with look.using(look.carom_settings()), look.quiet(), PdfPages(content) as pdf:
        pieces = chain([_text(title, "title")], *map(_pieces, sections))
        for number, blocks in enumerate(_pages(pieces), 1):
            pdf.savefig(_drawn(blocks, f"{number}"))
    where.write_bytes(content.getvalue())


def _pieces(section: Section) -> Iterator[list[Block]]:
    """Yield what stands together on a page: heading, figure or table, and what is said of it."""
    above = [Block(8.0), *_text(section.heading, "heading")]
    texts, codes = map(_text, section.paragraphs), section.code.split("\n\n")
    shown = _table(section.table) if section.table else []
    if section.draw:
        figure = section.draw()
        shown = [Block(min(72.0 * figure.get_figheight(), TALLEST), picture=figure), Block(4.0)]
    first = [[*shown, *chain(*texts)]] if shown else texts
    for part in (*first, *(_text(code.strip(), "code") for code in codes if code.strip())):
        yield [*above, *part]
        above = []


def _text(words: str, font: str = "text") -> list[Block]:
    return [_beside([(0.0, ROOM, words)], font)]


def _table(table: Sequence[Sequence[str]]) -> list[Block]:
    """Return the rows of a table, the widest column of which is made narrower until all fit."""
    letter = LETTER * FONTS["text"]["size"]
    widths = [letter * max(map(len, column)) for column in zip(*table, strict=True)]
    while sum(widths) + GAP * len(widths) > ROOM:
        widths[widths.index(max(widths))] -= letter
    starts = [sum(widths[:place]) + GAP * place for place in range(len(widths))]
    rows = [list(zip(starts, widths, row, strict=True)) for row in table]
    return [_beside(row, "text" if place else "head", True) for place, row in enumerate(rows)]


def _beside(cells: Sequence[tuple[float, float, str]], font: str, ruled: bool = False) -> Block:
    """Return texts beside each other, each from where it begins, in as much room as it has."""
    size, texts, count = FONTS[font]["size"], [], 1
    for start, room, words in cells:
        letters = max(int(room / size / LETTER + 0.5), 1)
        plain = words.encode(errors="replace").decode().splitlines()
        lines = [part for line in plain for part in wrap(line, letters)]
        texts.append((start, "\n".join(lines)))
        count = max(count, len(lines))
    return Block(ADVANCE * size * count + 5.0, texts, font, ruled)


def _pages(pieces: Iterable[list[Block]]) -> Iterator[list[Block]]:
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
