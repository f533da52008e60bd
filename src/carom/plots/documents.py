"""Texts, tables and figures as one file that stands alone: HTML or PDF."""

from collections.abc import Callable, Iterator, Sequence
from html import escape
from pathlib import Path
from textwrap import wrap
from typing import TYPE_CHECKING, Any, NamedTuple

from carom.io.files import DOCUMENTS
from carom.io.paths import ending_of, replace_whole
from carom.plots.result import image

if TYPE_CHECKING:
    from matplotlib.figure import Figure

DPI = 200
PAGE, MARGIN = (210.0 / 25.4, 297.0 / 25.4), 0.75  # A4, in inches
LETTERS, LINES, LETTER_SIZE = 92, 70, 8.5  # of a page of text
GAP = 2  # letters between columns
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
.figures { display: flex; flex-wrap: wrap; gap: 1rem; }
.figures img { width: min(100%, 26rem); height: auto; }
@media print { body { font-size: 10pt; padding: 0; } tr, img, pre { break-inside: avoid; }
  h2 { break-after: avoid; } .figures img { width: 47%; } }
"""


class Section(NamedTuple):
    """A part of a document: paragraphs, then a table whose first row is its head, then code."""

    heading: str
    paragraphs: Sequence[str] = ()
    table: Sequence[Sequence[str]] = ()
    code: str = ""


def write_document(
    target: Path, title: str, sections: Sequence[Section], draw: Callable[[bool], Any]
) -> Path:
    """Write a document whole or not at all; figures by `draw` stand behind the first section."""
    if ending_of(target, DOCUMENTS) == ".pdf":
        figures = draw(False).values()
        return replace_whole(target, lambda where: _write_pdf(where, title, sections, figures))
    content = _html(title, sections, draw(True))

    def write(where: Path) -> None:
        where.write_text(content, encoding="utf-8", errors="replace", newline="\n")

    return replace_whole(target, write)


def _html(title: str, sections: Sequence[Section], figures: dict[str, "Figure"]) -> str:
    first, *others = map(_section, sections)
    images = "".join(image(name, figure, DPI) for name, figure in figures.items())
    return (
        '<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n'
        '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
        '<meta http-equiv="Content-Security-Policy" '
        "content=\"default-src 'none'; style-src 'unsafe-inline'; img-src data:\">\n"
        f"<title>{escape(title)}</title>\n<style>{STYLE}</style>\n</head>\n<body>\n"
        f"<h1>{escape(title)}</h1>\n{first}"
        f'<div class="figures">{images}</div>\n{"".join(others)}</body>\n</html>\n'
    )


def _section(section: Section) -> str:
    parts = [f"<h2>{escape(section.heading)}</h2>"]
    parts += [f"<p>{escape(words)}</p>" for words in section.paragraphs]
    if section.table:
        head, *rows = section.table
        lines = [_row("th", head), *(_row("td", row) for row in rows)]
        parts.append(f'<div class="wide"><table>{"".join(lines)}</table></div>')
    if section.code:
        parts.append(f"<pre>{escape(section.code)}</pre>")
    return "\n".join([*parts, ""])


def _row(tag: str, cells: Sequence[str]) -> str:
    return f"<tr>{''.join(f'<{tag}>{escape(cell)}</{tag}>' for cell in cells)}</tr>"


def _write_pdf(where: Path, title: str, sections: Sequence[Section], figures: Any) -> None:
    """Write the texts on pages of A4, then each figure on one of its own."""
    from matplotlib.backends.backend_pdf import PdfPages
    from matplotlib.transforms import Bbox

    from carom.plots import look

    with look.using(look.carom_settings()), look.quiet(), PdfPages(where) as pdf:
        for page in _pages([*wrap(title, LETTERS), *_lines(sections)]):
            pdf.savefig(page)
        for figure in figures:
            width, height = figure.get_size_inches()
            tall = max(PAGE[1], height + 2.0 * MARGIN)
            left, low = 0.5 * (width - PAGE[0]), height + MARGIN - tall
            pdf.savefig(figure, bbox_inches=Bbox.from_bounds(left, low, PAGE[0], tall))


def _lines(sections: Sequence[Section]) -> Iterator[str]:
    for section in sections:
        yield from ("", section.heading, "-" * len(section.heading))
        for words in section.paragraphs:
            yield from wrap(words, LETTERS)
        yield from _table_lines(section.table)
        for line in section.code.splitlines():
            yield from wrap(line, LETTERS) or [""]


def _table_lines(table: Sequence[Sequence[str]]) -> Iterator[str]:
    """Yield the rows of a table in columns, the widest of them wrapped until all fit."""
    widths = [max(map(len, column)) for column in zip(*table, strict=True)]
    while sum(widths) + GAP * len(widths) > LETTERS:
        widths[widths.index(max(widths))] -= 1
    for row in table:
        cells = [wrap(cell, max(width, 1)) for cell, width in zip(row, widths, strict=True)]
        for place in range(max(map(len, cells))):
            parts = (cell[place] if place < len(cell) else "" for cell in cells)
            padded = (part.ljust(width) for part, width in zip(parts, widths, strict=True))
            yield (GAP * " ").join(padded).rstrip()


def _pages(lines: Sequence[str]) -> Iterator["Figure"]:
    from matplotlib.figure import Figure

    for start in range(0, len(lines), LINES):
        page = Figure(figsize=PAGE)
        text = "\n".join(lines[start : start + LINES]).encode(errors="replace").decode()
        place = MARGIN / PAGE[0], 1.0 - MARGIN / PAGE[1]
        letters: Any = {"family": "monospace", "size": LETTER_SIZE, "parse_math": False}
        page.text(*place, text, va="top", linespacing=1.3, **letters)
        yield page
