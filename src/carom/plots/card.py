"""How results look in a notebook: a small table beside a picture."""

from base64 import b64encode
from collections.abc import Mapping
from html import escape
from io import BytesIO
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from matplotlib.figure import Figure

DPI = 80


def card(
    title: str, rows: Mapping[str, str], figure: "Figure | None" = None, notes: str = ""
) -> str:
    """Return HTML with a table of named texts, beside a picture if any, and lines of text below.

    Colours are those of the notebook; the picture brings its own, light ground.
    """
    cells = "".join(
        f"<tr><th style='text-align:left;padding-right:1em'>{escape(name.replace('$', ''))}</th>"
        f"<td style='text-align:left'>{escape(text)}</td></tr>"
        for name, text in rows.items()
    )
    below = f"<pre style='margin:0.5em 0'>{escape(notes)}</pre>" if notes else ""
    return (
        f"<div><strong>{escape(title)}</strong>"
        "<div style='display:flex;flex-wrap:wrap;gap:1em;align-items:center'>"
        f"<table style='font-size:90%'>{cells}</table>"
        f"{_image(title, figure)}</div>{below}</div>"
    )


def _image(title: str, figure: "Figure | None") -> str:
    if figure is None:
        return ""
    style = "max-width:100%;background:white"
    data = f"data:image/png;base64,{_png(figure)}"
    return f"<img alt='{escape(title)}' style='{style}' src='{data}'>"


def _png(figure: "Figure") -> str:
    from carom.plots.style import style

    stream = BytesIO()
    with style():
        figure.savefig(stream, format="png", dpi=DPI)
    return b64encode(stream.getvalue()).decode("ascii")
