"""How results look in a notebook: a small table beside a picture."""

from base64 import b64encode
from collections.abc import Mapping
from html import escape
from io import BytesIO
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from matplotlib.figure import Figure

DPI = 80


def card(title: str, rows: Mapping[str, str], figure: "Figure", notes: str = "") -> str:
    """Return HTML with a table of named texts beside a picture, and lines of text below."""
    cells = "".join(
        f"<tr><th style='text-align:left'>{escape(name)}</th><td>{escape(text)}</td></tr>"
        for name, text in rows.items()
    )
    below = f"<pre style='margin:0.5em 0'>{escape(notes)}</pre>" if notes else ""
    return (
        f"<div><strong>{escape(title)}</strong>"
        "<div style='display:flex;flex-wrap:wrap;gap:1em;align-items:center'>"
        f"<table style='font-size:90%'>{cells}</table>"
        f"<img alt='{escape(title)}' src='data:image/png;base64,{_png(figure)}'></div>{below}</div>"
    )


def _png(figure: "Figure") -> str:
    from carom.plots.style import style

    stream = BytesIO()
    with style():
        figure.savefig(stream, format="png", dpi=DPI)
    return b64encode(stream.getvalue()).decode("ascii")
