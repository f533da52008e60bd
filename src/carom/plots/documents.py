"""Texts, tables and figures as one file that stands alone: HTML or PDF."""

from collections.abc import Callable, Sequence
from html import escape
from pathlib import Path
from typing import Any, NamedTuple

from carom.io.files import DOCUMENTS
from carom.io.paths import ending_of, replace_whole
from carom.plots.result import source

DPI, NARROW = 200, 86.0  # of images; mm, how wide they are on a small screen
DENSE = "1.7x"  # pixels of an image for one of the screen
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


class Section(NamedTuple):
    """A part of a document: a figure, a table whose first row is its head, paragraphs, code.

    `draw` makes the figure, in a `width` in mm if one is given.
    """

    heading: str
    paragraphs: Sequence[str] = ()
    table: Sequence[Sequence[str]] = ()
    code: str = ""
    draw: Callable[..., Any] | None = None


def write_document(target: Path, title: str, sections: Sequence[Section]) -> Path:
    """Write a document whole or not at all."""
    if ending_of(target, DOCUMENTS) == ".pdf":
        from carom.plots.pages import write_pdf  # which loads matplotlib

        return replace_whole(target, lambda where: write_pdf(where, title, sections))
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
