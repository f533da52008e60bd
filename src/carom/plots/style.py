"""What all figures share: sizes, fonts, colours and hatches, labels with units, storing."""

import re
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from io import BytesIO
from pathlib import Path
from typing import Any, NamedTuple, ParamSpec, TypeVar, Unpack

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patheffects import withStroke
from numpy.typing import ArrayLike

from carom.io.files import FIGURES
from carom.io.paths import checked_output, ending_of, replace_whole
from carom.plots import look as looks
from carom.plots.look import DPI
from carom.quantities.arrays import Array
from carom.quantities.glossary import GLOSSARY
from carom.quantities.prefixes import prefixed as prefixed
from carom.quantities.refusals import InputError

__all__ = [
    *("BLACK", "BLUE", "DASHES", "DOUBLE", "GREEN", "LINES", "MAP", "POINTS", "PURPLE"),
    *("SIGNED_MAP", "SINGLE", "VERMILION"),
    *("label", "new_figure", "style", "styled", "zero_line"),
]
__dir__ = __all__.copy
P = ParamSpec("P")
T = TypeVar("T")

GREEK = re.compile(r"kappa|chi|mu|psi")
FORMULA = re.compile(r"\bk_t(?:/k_n)?\b|\bpsi_[12]\b|\b(?:kappa|chi|mu)\b")
MM = 1.0 / 25.4  # in inches, which matplotlib counts in
SINGLE, DOUBLE = 86.0, 178.0  # widths of one and two columns of a paper, in mm

# Okabe & Ito's colours, which the colour-blind tell apart.
BLACK, GREEN = "#000000", "#009E73"
BLUE, VERMILION, PURPLE = "#0072B2", "#D55E00", "#CC79A7"
LINES = (BLUE, VERMILION, GREEN, PURPLE, BLACK)
DASHES: tuple[Any, ...] = ("-", (0, (5, 1.5)), (0, (1.5, 1)), (0, (6, 1.5, 1.5, 1.5)), (0, (9, 2)))
MAP = "cividis"
SIGNED_MAP = "RdBu_r"  # white at zero
SIGNED = ("traction_", "sigma_", "principal_")  # how quantities begin that have a sign

# Of measured values, with error bars.
POINTS: Any = {"fmt": "o", "ms": 2.6, "color": BLACK, "mfc": "white", "lw": 0.0, "elinewidth": 0.7}


def check_grid(dataset: Any, name: str, *dims: str) -> None:
    """Refuse fields that do not lie on a grid with two rising positions or more along each side."""
    coords = getattr(dataset, "coords", ())
    places = [np.asarray(dataset[dim].values) for dim in dims if dim in coords]
    on_grid = name in getattr(dataset, "data_vars", ()) and dataset[name].dims == dims
    if not on_grid or any(line.size < 2 or np.any(np.diff(line) <= 0.0) for line in places):
        wanted = " and ".join(reversed(dims))
        raise InputError(f"{name}: a map needs it on a grid of rising {wanted}, two or more each")


def span(axis: Axes, x: ArrayLike = (), y: ArrayLike = ()) -> None:
    """Let axes go from the first to the last of these values, where they differ."""
    for values, limit in ((np.asarray(x), axis.set_xlim), (np.asarray(y), axis.set_ylim)):
        if values.size and values[0] != values[-1]:
            limit(float(values[0]), float(values[-1]))


@contextmanager
def style(**look: Unpack[looks.Look]) -> Iterator[None]:
    """Set matplotlib to Carom's style for a while.

    In the block of `with`, labels have 7.5 points and lines are as in Carom's own figures, whatever
    the user's settings are; after it, these are as they were. `new_figure` makes figures that keep
    the style, whoever stores or shows them later.

    Parameters
    ----------
    **look : width, font_size, style
        `width` in mm is that of figures that `new_figure` makes, and their height goes with it.
        `font_size` in points is that of labels; ticks and legends are half a point smaller. `style`
        goes on top: the name of a style of matplotlib, a style file, or a dictionary of rcParams.

    Returns
    -------
    context manager
        It yields nothing.

    Raises
    ------
    InputError
        If a size is out of range, or matplotlib knows no such style or setting.

    Examples
    --------
    >>> import matplotlib
    >>> with carom.plots.style.style(font_size=9.0):
    ...     matplotlib.rcParams["font.size"]
    9.0
    """
    chosen = looks.settings(look)
    width, kept = looks.WIDTH.set(looks.wanted_width(look)), looks.SETTINGS.set(chosen)
    try:
        with looks.using(chosen):
            yield
    finally:
        looks.WIDTH.reset(width)
        looks.SETTINGS.reset(kept)


def styled(draw: Callable[P, T]) -> Callable[P, T]:
    """Make a function draw in the style of this package, whatever the user's settings are."""
    return style()(draw)


def room(width: float) -> float:
    """Return the width in mm of a figure that is usually this wide, less where fonts are larger."""
    return (looks.WIDTH.get() or width) * looks.FONT_SIZE / float(looks.RC["font.size"])


def new_figure(
    rows: int = 1,
    columns: int = 1,
    *,
    width: float = SINGLE,
    height: float = 62.0,
    keep_height: bool = False,
    **options: Any,
) -> tuple[Figure, Any]:
    """Return a figure of a width and height in mm, and its axes as an array of two dimensions.

    Other arguments go to `Figure.subplots`, for instance sharex=True. The size is that of the
    figure as it is stored; draw within `style` to have its fonts and lines. A width that was given
    to `style` comes first, and the height then changes in proportion, or with the font.

    Parameters
    ----------
    rows, columns : int
        How many axes there are below and beside each other.
    width, height : float
        Of the whole figure in mm; one column of a paper is 86 mm wide, two are 178 mm.
    keep_height : bool
        Whether the height stays as it is at any width: that of rows of text.

    Returns
    -------
    tuple of matplotlib.figure.Figure and numpy.ndarray, shape (rows, columns)
        The figure and its axes.

    Examples
    --------
    >>> with carom.plots.style.style():
    ...     figure, axes = carom.plots.style.new_figure(2, 1, width=178.0, height=100.0)
    >>> (25.4 * figure.get_size_inches()).round(9), axes.shape
    (array([178., 100.]), (2, 1))
    """
    axes = looks.AXES.get()
    if axes is not None and rows * columns == 1:
        return looks.own_figure(axes), np.array([[axes]])
    figure = blank_figure(width, height, keep_height)
    return figure, figure.subplots(rows, columns, squeeze=False, **options)


def blank_figure(width: float, height: float, keep_height: bool = False) -> Figure:
    """Return a figure of a width and height in mm, as `new_figure` does, without axes."""
    if looks.AXES.get() is not None:
        raise InputError("ax: this figure has several panels, and makes its own; leave ax out")
    wanted, letters = looks.WIDTH.get() or width, float(looks.RC["font.size"]) / looks.FONT_SIZE
    height *= max(1.0 if keep_height else wanted / width, letters)
    width = wanted
    return looks.Drawing(figsize=(width * MM, height * MM), layout="constrained")


def single_axis(**options: Any) -> tuple[Figure, Axes]:
    """Return a figure, as `new_figure` does, and its only axes."""
    figure, axes = new_figure(**options)
    return figure, axes[0, 0]


def save_figure(figure: Figure, path: str | Path) -> Path:
    """Store a figure as .png, .pdf or .svg; one that is there is replaced whole or not at all.

    Parameters
    ----------
    figure : matplotlib.figure.Figure
        What a function of `carom.plots` or a result's `plot()` returns.
    path : str or Path
        A name that ends in .png, .pdf or .svg.

    Returns
    -------
    pathlib.Path
        The file that was written.

    Raises
    ------
    InputError
        If the name ends otherwise or the file cannot be written.

    Examples
    --------
    >>> import tempfile
    >>> figure = carom.plots.plot_curve(carom.curve(1.44, [0.0, 1.0, 6.0]))
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     carom.plots.save_figure(figure, folder + "/curve.png").name
    'curve.png'
    """
    target = checked_output(path, FIGURES)
    ending = ending_of(target, FIGURES)

    def write(where: Path) -> None:
        content = BytesIO()  # on a full disk matplotlib's file ends with an error of another kind
        figure.savefig(content, dpi=DPI, format=ending.removeprefix("."))
        where.write_bytes(content.getvalue())

    with looks.using(getattr(figure, "settings", looks.carom_settings())), looks.quiet():
        return replace_whole(target, write, ending)


def label(name: str, unit: str | None = None) -> str:
    """Return the label of an axis: symbol and unit; what the symbol means stands in the caption."""
    entry = GLOSSARY[name]
    unit = (entry.unit if unit is None else unit).replace("^2", "²")
    return entry.symbol if unit == "1" else f"{entry.symbol}\u00a0({unit})"


def with_formulas(text: str) -> str:
    """Return a text whose formulas, written as in a terminal, are set as formulas in figures."""
    return FORMULA.sub(lambda match: "$" + GREEK.sub(r"\\\g<0>", match[0]) + "$", text)


class Scaled(NamedTuple):
    """Values in a unit with a prefix, that unit, and what SI values were multiplied by."""

    values: Array
    unit: str
    scale: float


def scaled(dataset: Any, name: str, like: ArrayLike | None = None) -> Scaled:
    """Return the values of a variable in a unit whose prefix suits them, or those of `like`."""
    values = np.asarray(dataset[name].values, dtype=np.float64)
    scale, unit = prefixed(values if like is None else like, unit_of(dataset, name))
    return Scaled(values * scale, unit, scale)


def unit_of(dataset: Any, name: str) -> str:
    """Return the unit of a variable, as its dataset tells it or else the glossary."""
    return str(dataset[name].attrs.get("units", GLOSSARY[name].unit))


def colours(name: str, values: ArrayLike) -> dict[str, Any]:
    """Return the colours of a quantity and their limits: white at zero where it has a sign."""
    if not name.startswith(SIGNED):
        return {"cmap": MAP}
    largest = float(np.abs(np.asarray(values, dtype=np.float64)).max(initial=0.0)) or 1.0
    return {"cmap": SIGNED_MAP, "vmin": -largest, "vmax": largest}


def stroke_white(artist: Artist, width: float = 2.0) -> None:
    """Draw a text or a mark on a white stroke, which sets it off from what is below."""
    artist.set_path_effects([withStroke(linewidth=width, foreground="white")])


def zero_line(axis: Axes) -> None:
    """Draw a line at zero."""
    axis.axhline(0.0, color="0.5", lw=0.5, zorder=1)


def limit_lines(axis: Axes, x: Array, limit: Array, name: str | None = None) -> None:
    """Draw the limits of friction, which differ in their sign."""
    for values, text in ((limit, name), (-limit, None)):
        axis.plot(x, values, color=BLACK, ls=DASHES[1], lw=0.8, label=text)
