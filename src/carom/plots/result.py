"""What every result offers: a dataset, its figure, a table in notebooks, what to cite."""

from abc import ABC, abstractmethod
from base64 import b64encode
from collections.abc import Callable, Mapping, Sequence
from html import escape
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple, Unpack

if TYPE_CHECKING:
    import xarray as xr
    from matplotlib.figure import Figure

    from carom.plots.look import Look

DPI = 80


class Section(NamedTuple):
    """A part of a report: a figure, a table whose first row is its head, paragraphs, code.

    `draw` makes the figure, in a `width` in mm if one is given.
    """

    heading: str
    paragraphs: Sequence[str] = ()
    table: Sequence[Sequence[str]] = ()
    code: str = ""
    draw: "Callable[..., Figure] | None" = None


class Result(ABC):
    """A result that is stored and drawn from one dataset, shown in notebooks, and cited."""

    @abstractmethod
    def to_dataset(self) -> "xr.Dataset":
        """Return the result as one dataset, which `plot` draws and `carom.save` stores."""

    @abstractmethod
    def cite(self) -> str:
        """Return what to cite for this result, as BibTeX."""

    @abstractmethod
    def _draw(self, dataset: Any, **look: Any) -> "Figure":
        """Return the figure of the dataset."""

    @abstractmethod
    def _repr_html_(self) -> str:
        """Return a table and a picture for a notebook."""

    def plot(self, path: str | Path | None = None, **look: "Unpack[Look]") -> "Figure":
        """Draw the result from its dataset.

        An impact: forces, velocities, radii and energies against time. A load path: the forces
        inside the cone of friction. A fit: data, curves and residuals. A score or a ranking: psi_2
        beside the exact answer, and the errors.

        Parameters
        ----------
        path : str or Path, optional
            Where the figure is stored, too: .png, .pdf or .svg.
        **look : width, font_size, style
            Width in mm, size of labels in points, style of matplotlib; see
            `carom.plots.style.style`.

        Returns
        -------
        matplotlib.figure.Figure
            The figure, as wide as one column of a paper, 86 mm, or two, 178 mm.

        Raises
        ------
        InputError
            If the name ends otherwise or the file cannot be written.

        Examples
        --------
        >>> len(hit.plot().axes)
        4
        """
        from carom.plots.style import save_figure

        figure = self._draw(self.to_dataset(), **look)
        if path is not None:
            save_figure(figure, path)
        return figure


def card(
    title: str, rows: Mapping[str, str], figure: "Figure | None" = None, notes: str = ""
) -> str:
    """Return HTML: named texts beside a picture, which brings its light ground, and lines below."""
    cells = "".join(
        f"<tr><th style='text-align:left;padding-right:1em'>{escape(name.replace('$', ''))}</th>"
        f"<td style='text-align:left'>{escape(text)}</td></tr>"
        for name, text in rows.items()
    )
    look = "max-width:100%;background:white"
    picture = ""
    if figure is not None:
        picture = f"<img alt='{escape(title)}' style='{look}' src='{source(figure, DPI)}'>"
    below = f"<pre style='margin:0.5em 0'>{escape(notes)}</pre>" if notes else ""
    return (
        f"<div><strong>{escape(title)}</strong>"
        "<div style='display:flex;flex-wrap:wrap;gap:1em;align-items:center'>"
        f"<table style='font-size:90%'>{cells}</table>"
        f"{picture}</div>{below}</div>"
    )


def source(figure: "Figure", dpi: float) -> str:
    """Return a figure as the source of an image of HTML."""
    return f"data:image/png;base64,{b64encode(png(figure, dpi)).decode('ascii')}"


def png(figure: "Figure", dpi: float) -> bytes:
    """Return a figure as the content of a PNG file."""
    stream = BytesIO()
    figure.savefig(stream, format="png", dpi=dpi)
    return stream.getvalue()
