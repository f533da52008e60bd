"""What all figures share: sizes, fonts, colours and hatches, labels with units, storing."""

import logging
import textwrap
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import wraps
from inspect import signature
from pathlib import Path
from typing import Any, NamedTuple, ParamSpec, TypeVar

import matplotlib
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import ArrayLike

from carom.io.files import FIGURES
from carom.io.paths import checked_output, ending_of, replace_whole
from carom.quantities.arrays import Array
from carom.quantities.glossary import GLOSSARY
from carom.quantities.refusals import InputError

P = ParamSpec("P")
T = TypeVar("T")

MM = 1.0 / 25.4  # in inches, which matplotlib counts in
SINGLE, DOUBLE = 86.0, 178.0  # widths of one and two columns of a paper, in mm
DPI = 300

# Okabe & Ito's colours, which the colour-blind tell apart.
BLACK, GREEN = "#000000", "#009E73"
BLUE, VERMILION, PURPLE = "#0072B2", "#D55E00", "#CC79A7"
LINES = (BLUE, VERMILION, GREEN, PURPLE, BLACK)
DASHES: tuple[Any, ...] = ("-", (0, (5, 1.5)), (0, (1.5, 1)), (0, (6, 1.5, 1.5, 1.5)), (0, (9, 2)))
MAP = "cividis"

STYLE: Any = {  # typed differently by the versions of matplotlib
    "font.family": "sans-serif",
    "font.size": 7.5,
    "axes.labelsize": 7.5,
    "axes.titlesize": 7.5,
    "xtick.labelsize": 7.0,
    "ytick.labelsize": 7.0,
    "legend.fontsize": 7.0,
    "legend.title_fontsize": 7.0,
    "figure.titlesize": 7.5,
    "mathtext.fontset": "dejavusans",
    "axes.linewidth": 0.6,
    **{
        f"{axis}tick.major.{what}": value
        for axis in "xy"
        for what, value in (("size", 2.5), ("width", 0.6), ("pad", 2.0))
    },
    "axes.formatter.useoffset": False,
    "lines.linewidth": 1.2,
    "lines.markersize": 3.5,
    "hatch.linewidth": 0.4,
    "legend.frameon": False,
    "legend.handlelength": 2.4,
    "legend.columnspacing": 1.2,
    "legend.borderaxespad": 0.2,
    "legend.labelspacing": 0.3,
    "savefig.dpi": DPI,
    "svg.fonttype": "none",
    "pdf.fonttype": 42,
}

POINTS: Any = {
    "fmt": "o",
    "ms": 2.6,
    "color": BLACK,
    "mfc": "white",
    "lw": 0.0,
    "elinewidth": 0.7,
}  # of measured values, with error bars
LOGGERS = ("matplotlib", "fontTools")  # which log what does not help a user
TICKS = ("labelsize", "major.size", "major.width", "major.pad")

PREFIXES = {-12: "p", -9: "n", -6: "µ", -3: "m", 0: "", 3: "k", 6: "M", 9: "G", 12: "T"}


def styled(draw: Callable[P, T]) -> Callable[P, T]:
    """Make a function draw in the style of this package, whatever the user's settings are."""

    @wraps(draw)
    def drawn(*args: P.args, **kwargs: P.kwargs) -> T:
        with style():
            return draw(*args, **kwargs)

    return drawn


def draws(
    what: str, *needed: str, along: str | tuple[str, ...] = ()
) -> Callable[[Callable[P, T]], Callable[P, T]]:
    """Style a function whose first argument is a dataset, and refuse what it cannot draw.

    `what` tells what it draws and what makes such a dataset; all of `needed` must be in it, and
    the first of them must go along these dimensions, if any are named, and have values.
    """

    def decorate(draw: Callable[P, T]) -> Callable[P, T]:
        parameters, styled_draw = signature(draw), styled(draw)

        @wraps(draw)
        def checked(*args: P.args, **kwargs: P.kwargs) -> T:
            given: Any = next(iter(parameters.bind(*args, **kwargs).arguments.values()))
            lacks = _lacking(given, needed, (along,) if isinstance(along, str) else along)
            name = getattr(draw, "__name__", "")
            if lacks:
                raise InputError(f"{name} draws {what}; what was given {lacks}")
            try:
                with quiet():
                    return styled_draw(*args, **kwargs)
            except InputError:
                raise
            except (ValueError, LookupError, ArithmeticError) as error:  # of numbers or words in it
                reason = " ".join(str(error).split())
                raise InputError(f"{name}: this dataset cannot be drawn; {reason}") from error

        return checked

    return decorate


def _lacking(given: Any, needed: tuple[str, ...], along: tuple[str, ...]) -> str:
    """Return what keeps an object from being a dataset of a kind; nothing if it is one."""
    if not hasattr(given, "data_vars"):
        return f"is no dataset but of type {type(given).__name__}"
    missing = [name for name in needed if name not in given.variables]
    if missing:
        return f"has no {missing[0]}"
    lies = given[needed[0]].dims
    if lies != along if along else not lies:
        return f"has no {needed[0]} along {' and '.join(along) or 'a dimension'}"
    return "" if given[needed[0]].size else f"has no values of {needed[0]}"


@contextmanager
def quiet() -> Iterator[None]:
    """Let matplotlib not complain of numbers that are not finite, of glyphs, of fonts and room."""
    levels = {logger: logger.level for logger in map(logging.getLogger, LOGGERS)}
    for logger in levels:
        logger.setLevel(logging.ERROR)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            yield
    finally:
        for logger, level in levels.items():
            logger.setLevel(level)


def check_grid(dataset: Any, name: str, *dims: str) -> None:
    """Refuse fields that do not lie on a grid with two rising positions or more along each side."""
    places = [np.asarray(dataset[dim].values) for dim in dims if dim in dataset.coords]
    known = name in getattr(dataset, "data_vars", ()) and dataset[name].dims == dims
    if not known or any(line.size < 2 or np.any(np.diff(line) <= 0.0) for line in places):
        wanted = " and ".join(reversed(dims))
        raise InputError(f"{name}: a map needs it on a grid of rising {wanted}, two or more each")


def span(axis: Axes, x: ArrayLike = (), y: ArrayLike = ()) -> None:
    """Let axes go from the first to the last of these values, where they differ."""
    for values, limit in ((np.asarray(x), axis.set_xlim), (np.asarray(y), axis.set_ylim)):
        if values.size and values[0] != values[-1]:
            limit(float(values[0]), float(values[-1]))


@contextmanager
def style() -> Iterator[None]:
    """Set matplotlib to the style of this package for a while.

    In the block of `with`, fonts have 7 to 7.5 points and lines are as in Carom's own figures,
    whatever the user's settings are; after it, these are as they were.

    Returns
    -------
    context manager
        It yields nothing.

    Examples
    --------
    >>> import carom
    >>> import matplotlib
    >>> with carom.plots.style.style():
    ...     matplotlib.rcParams["font.size"]
    7.5
    """
    with matplotlib.rc_context():
        matplotlib.rcdefaults()
        matplotlib.rcParams.update(STYLE)
        yield


def new_figure(
    rows: int = 1, columns: int = 1, *, width: float = SINGLE, height: float = 62.0, **options: Any
) -> tuple[Figure, Any]:
    """Return a figure of a width and height in mm, and its axes as an array of two dimensions.

    What else is given goes to `Figure.subplots`, for instance sharex=True. The size is that of the
    figure as it is stored; draw within `style` to have its fonts and lines.

    Parameters
    ----------
    rows, columns : int
        How many axes there are below and beside each other.
    width, height : float
        Of the whole figure in mm; one column of a paper is 86 mm wide, two are 178 mm.

    Returns
    -------
    tuple of matplotlib.figure.Figure and numpy.ndarray, shape (rows, columns)
        The figure and its axes.

    Examples
    --------
    >>> import carom
    >>> with carom.plots.style.style():
    ...     figure, axes = carom.plots.style.new_figure(2, 1, width=178.0, height=100.0)
    >>> (25.4 * figure.get_size_inches()).round(9), axes.shape
    (array([178., 100.]), (2, 1))
    """
    figure = Figure(figsize=(width * MM, height * MM), layout="constrained")
    axes = figure.subplots(rows, columns, squeeze=False, **options)
    for axis in axes.flat:  # ticks are made when drawn, with the settings of that moment
        size, length, width, pad = (STYLE[f"xtick.{name}"] for name in TICKS)
        axis.tick_params(labelsize=size, length=length, width=width, pad=pad)
    return figure, axes


def single_axis(**options: Any) -> tuple[Figure, Axes]:
    """Return a figure, as `new_figure` does, and its only axes."""
    figure, axes = new_figure(**options)
    return figure, axes[0, 0]


def save_figure(figure: Figure, path: str | Path) -> Path:
    """Store a figure as .png, .pdf or .svg; one that is there is replaced whole or not at all.

    Parameters
    ----------
    figure : matplotlib.figure.Figure
        What a function of this module or a result's `plot()` returns.
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
    >>> import carom
    >>> figure = carom.plots.plot_curve(carom.curve(1.44, [0.0, 1.0, 6.0]))
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     carom.plots.save_figure(figure, folder + "/curve.png").name
    'curve.png'
    """
    target = checked_output(path, FIGURES)
    with style(), quiet():
        return replace_whole(
            target, lambda where: figure.savefig(where, dpi=DPI), ending_of(target, FIGURES)
        )


def prefixed(values: ArrayLike, unit: str) -> tuple[float, str]:
    """Return by what to multiply, and the unit with its prefix, so that the largest is 1 to 1000.

    Examples
    --------
    >>> from carom.plots.style import prefixed
    >>> prefixed([0.0, 2.5e-5], "m")
    (1000000.0, 'µm')
    >>> prefixed([0.0, 0.9], "1")
    (1.0, '1')
    """
    numbers = np.abs(np.asarray(values, dtype=np.float64))
    numbers = numbers[np.isfinite(numbers)]
    largest = float(numbers.max()) if numbers.size else 0.0
    if unit in ("1", "rad") or largest == 0.0:
        return 1.0, unit
    power = 3 * int(np.floor(np.log10(largest * (1.0 + 1e-9)) / 3.0))
    power = min(max(power, min(PREFIXES)), max(PREFIXES))
    return 10.0**-power, PREFIXES[power] + unit


def label(name: str, unit: str | None = None, room: int = 100) -> str:
    """Return the label of an axis: short meaning, symbol and unit, in lines of `room` characters.

    Examples
    --------
    >>> from carom.plots.style import label
    >>> label("tangential_force", "mN")
    'tangential force, $F_x$\\xa0(mN)'
    """
    text = f"{GLOSSARY[name].meaning.split(',')[0]}, {symbol(name, unit)}"
    return textwrap.fill(text, room, break_long_words=False, break_on_hyphens=False)


def symbol(name: str, unit: str | None = None) -> str:
    """Return the label of an axis where there is no room for words."""
    entry = GLOSSARY[name]
    unit = entry.unit if unit is None else unit
    return entry.symbol if unit == "1" else f"{entry.symbol}\u00a0({unit})"


class Scaled(NamedTuple):
    """Values in a unit with a prefix, that unit, and what SI values were multiplied by."""

    values: Array
    unit: str
    scale: float


def scaled(dataset: Any, name: str, like: ArrayLike | None = None) -> Scaled:
    """Return the values of a variable in a unit whose prefix suits them, or those of `like`."""
    values = np.asarray(dataset[name].values, dtype=np.float64)
    scale, unit = prefixed(values if like is None else like, GLOSSARY[name].unit)
    return Scaled(values * scale, unit, scale)


def zero_line(axis: Axes) -> None:
    """Draw a line at zero."""
    axis.axhline(0.0, color="0.5", lw=0.5, zorder=1)


def limit_lines(axis: Axes, x: Array, limit: Array, name: str | None = None) -> None:
    """Draw the limits of friction, which differ in their sign."""
    for values, text in ((limit, name), (-limit, None)):
        axis.plot(x, values, color=BLACK, ls=DASHES[1], lw=0.8, label=text)


def legend_above(axis: Axes, columns: int, **options: Any) -> None:
    """Put the legend above the axes, where it covers no data."""
    place: dict[str, Any] = {"loc": "lower left", "bbox_to_anchor": (-0.02, 1.0)}
    axis.legend(ncols=columns, **place, **options)
