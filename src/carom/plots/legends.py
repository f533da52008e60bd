"""Legends above axes and figures, in as many columns as there is room: they cover no data."""

from contextlib import suppress
from functools import lru_cache
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.font_manager import FontProperties
from matplotlib.textpath import TextPath
from matplotlib.transforms import Bbox

from carom.plots.look import AXES, RC, own_figure

SPARE = 1.03  # letters on a screen are wider than their outlines
SPACES = ("handlelength", "handletextpad", "columnspacing", "borderpad")  # of a legend
SPACE = 0.5  # between the outlines of words, in sizes of the font
HINTS = 1.1  # by which text can be wider on a screen than its outlines
FONTS = [name for name in RC if name.startswith(("font.", "mathtext.", "text.usetex"))]
LOWEST = 0.1  # of the height of a figure: axes are left at least so high
LABEL_ROOM = 5.0  # beside axes, in sizes of the font


def legend_above(axis: Axes, columns: int, **options: Any) -> None:
    """Put the legend above the axes in as many columns as fit: a wider one makes axes narrower."""
    handles = options.pop("handles", None) or axis.get_legend_handles_labels()[0]
    grid = axis.get_subplotspec()
    across = grid.get_gridspec().ncols / len(grid.colspan) if grid else 1
    room = own_figure(axis).get_figwidth() * 72.0 / across - LABEL_ROOM * RC["font.size"]
    columns = fitting_columns(handles, columns, room, **options)
    place: dict[str, Any] = {"loc": "lower left", "bbox_to_anchor": (-0.02, 1.0)}
    axis.legend(handles=handles, ncols=columns, **{**place, **options})


def legend_outside(figure: Figure, handles: list[Any], columns: int, **options: Any) -> None:
    """Put a legend above all axes of a figure, or a user's Axes, in as many columns as fit."""
    axis = AXES.get()
    if axis is not None:
        legend_above(axis, columns, handles=handles, **options)
        return
    columns = fitting_columns(handles, columns, 72.0 * figure.get_figwidth(), **options)
    figure.legend(handles=handles, loc="outside upper center", ncols=columns, **options)


def make_room_around(axis: Any) -> None:
    """Let a user's figure hold what stands around Axes, unless a layout of its own does that."""
    figure, cell = axis.figure, axis.get_subplotspec()
    if cell is None or figure.get_layout_engine() is not None:
        return
    own_figure(axis).draw_without_rendering()

    def extent(each: Any) -> Any:
        return each.get_tightbbox().transformed(figure.transSubfigure.inverted())

    box, pars = extent(axis), figure.subplotpars
    above = [extent(each).y0 for each in figure.axes if each.bbox.y0 >= axis.bbox.y1]
    excess = max(box.y1 - min(above, default=1.0), 0.0)
    room = {"left": pars.left + max(-box.x0, 0.0), "right": pars.right - max(box.x1 - 1.0, 0.0)}
    room |= {"bottom": pars.bottom + max(-box.y0, 0.0), "top": pars.top - excess * (not above)}
    if excess and above:  # between rows of axes
        rows = cell.get_topmost_subplotspec().get_gridspec().nrows
        whole = room["top"] - room["bottom"]
        gap = excess + pars.hspace * whole / (rows + pars.hspace * (rows - 1))
        room["hspace"] = gap * rows / max(whole - gap * (rows - 1), LOWEST)
    with suppress(ValueError):  # of a figure that is too small
        figure.subplots_adjust(**room)


def fitting_columns(handles: list[Any], most: int, room: float, **options: Any) -> int:
    """Return how many columns of a legend fit into a width in points."""
    settings = {n: options.get(n, RC[f"legend.{n}"]) for n in SPACES}
    em = font_size(options.get("fontsize", RC["legend.fontsize"]))
    labels = [str(handle.get_label()).strip() or "-" for handle in handles]
    fonts = _fonts()
    widths = [_outline(label, em, fonts).width for label in labels]
    beside = em * (settings["handlelength"] + settings["handletextpad"])
    for columns in range(min(most, len(handles)), 1, -1):
        wide = [part.max() for part in np.array_split(widths, columns)]
        spaces = em * (settings["columnspacing"] * (len(wide) - 1) + 2.0 * settings["borderpad"])
        if SPARE * (sum(wide) + beside * len(wide) + spaces) <= room:
            return columns
    return 1


def font_size(size: str | float) -> float:
    """Return the size of a font in points, of that of `small` text, for instance."""
    return FontProperties(size=size).get_size_in_points()


def text_width(text: str) -> float:
    """Return how wide a line of small text may be, in points."""
    size, fonts, words = font_size("small"), _fonts(), text.split(" ")
    inked = sum(_outline(word, size, fonts).width for word in filter(None, words))
    return HINTS * (inked + SPACE * size * (len(words) - 1))


@lru_cache(4096)
def _outline(text: str, size: float, fonts: tuple[str, ...]) -> Bbox:
    """Return the box around a text in the fonts that are set; they tell kept boxes apart."""
    return TextPath((0, 0), text, size=size).get_extents()


def _fonts() -> tuple[str, ...]:
    return tuple(str(RC[name]) for name in FONTS)


def wrapped(text: str, room: float) -> str:
    """Return small text on lines that are no wider than some points."""
    lines = [""]
    for word in text.split(" "):
        longer = f"{lines[-1]} {word}".strip()
        lines = [*lines[:-1], longer] if text_width(longer) <= room else [*lines, word]
    return "\n".join(lines)
