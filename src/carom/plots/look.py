"""The style of a figure: Carom's own, what a user wants besides, and a figure that keeps both."""

import logging
import warnings
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from contextvars import ContextVar
from io import BytesIO
from pathlib import Path
from threading import RLock
from typing import Any, TypedDict

import matplotlib
import matplotlib.style
import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import to_rgba
from matplotlib.figure import Figure

from carom.quantities.refusals import refusal, refuse
from carom.quantities.units import pure_number

DPI, SCREEN = 300, 110  # in files and on screens
FONT_SIZE = 7.5  # of labels, in points
SMALLER = 0.5  # by how much ticks and legends are

RC: Any = matplotlib.rcParams  # typed differently by the versions of matplotlib
FIXED: Any = {  # settings that do not go with the size of fonts
    "font.family": "sans-serif",
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
    "hatch.linewidth": 0.3,
    "legend.frameon": False,
    "legend.handlelength": 2.4,
    "legend.columnspacing": 1.2,
    "legend.borderaxespad": 0.2,
    "legend.labelspacing": 0.3,
    "savefig.dpi": DPI,
    "svg.fonttype": "none",
    "pdf.fonttype": 42,
}
LABELS = ("font.size", "axes.labelsize", "axes.titlesize", "figure.titlesize")
SMALL = ("xtick.labelsize", "ytick.labelsize", "legend.fontsize", "legend.title_fontsize")

LOGGERS = ("matplotlib", "fontTools")  # which log what does not help a user
LUMINANCE, DARK = (0.2126, 0.7152, 0.0722), 0.5  # of red, green, blue (ITU-R BT.709)
WIDTHS, FONT_SIZES = (20.0, 1000.0), (3.0, 72.0)
STYLES = "must be a style of matplotlib, a style file or a dictionary of its settings (rcParams)"


class Look(TypedDict, total=False):
    """How a figure looks: what every function that draws takes besides its data.

    width : the whole figure in mm. font_size : of labels, in points. style : what goes on top of
    Carom's own style: the name of a style of matplotlib, a style file, or settings (rcParams).
    ax : a user's own Axes, which a figure of one panel is drawn into.
    """

    width: float | None
    font_size: float | None
    style: str | Path | Mapping[str, Any] | None
    ax: Axes | None


def _read(name: str, value: Any, limits: tuple[float, float], unit: str) -> float:
    """Return a size, or refuse it in one line."""
    allowed = f"must be a number of {unit} from {limits[0]:g} to {limits[1]:g}"
    size = pure_number(name, value, allowed)
    refuse(not limits[0] <= size <= limits[1] and refusal(name, value, allowed))
    return size


def carom_sizes(font_size: float) -> dict[str, Any]:
    """Return the sizes of all texts that go with that of labels."""
    return dict.fromkeys(LABELS, font_size) | dict.fromkeys(SMALL, font_size - SMALLER)


def carom_settings() -> dict[str, Any]:
    """Return the settings of matplotlib that make Carom's style."""
    return {**FIXED, **carom_sizes(FONT_SIZE)}


LOCK = RLock()
WIDTH: ContextVar[float | None] = ContextVar("width", default=None)
SETTINGS: ContextVar[dict[str, Any] | None] = ContextVar("settings", default=None)
AXES: ContextVar[Axes | None] = ContextVar("axes", default=None)


def settings(look: Look) -> dict[str, Any]:
    """Return the settings of the style that is in use, Carom's by default, with more on top."""
    for word in look:
        if word not in Look.__annotations__ or word == "ax":
            raise TypeError(f"style() got an unexpected keyword argument {word!r}")
    size = look.get("font_size")
    wanted: Any = look.get("style")
    chosen = SETTINGS.get() or carom_settings()
    if size is not None:
        chosen = chosen | carom_sizes(_read("font_size", size, FONT_SIZES, "points"))
    if wanted is None:
        return chosen
    kept = () if isinstance(wanted, Mapping) else (*LABELS, *SMALL)  # a style has its own sizes
    with using(chosen), quiet():
        before = dict(RC)
        try:
            matplotlib.style.use(dict(wanted) if isinstance(wanted, Mapping) else wanted)
        except (OSError, KeyError, ValueError, TypeError, AttributeError) as error:
            raise refusal("style", wanted, STYLES) from error
        changed = {n: v for n, v in RC.items() if before[n] != v and n not in kept}
        for ground in ("figure.facecolor", "axes.facecolor"):
            *color, opacity = to_rgba(RC[ground])
            if opacity and np.dot(color, LUMINANCE) < DARK:
                raise refusal("style", wanted, "its ground is dark, and Carom draws black lines")
    return chosen | changed


def wanted_width(look: Look) -> float | None:
    """Return the width of a figure in mm, if a user wants another than the usual one."""
    width = look.get("width")
    return WIDTH.get() if width is None else _read("width", width, WIDTHS, "mm")


@contextmanager
def using(chosen: dict[str, Any]) -> Iterator[None]:
    """Set matplotlib to settings for a while, for all threads: they draw one after the other."""
    with LOCK, matplotlib.rc_context():
        matplotlib.rcdefaults()
        RC.update(chosen)
        yield


class Drawing(Figure):
    """A figure that keeps the style it was made in, whoever draws or stores it, and when."""

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        self.settings = SETTINGS.get() or carom_settings()

    def draw(self, renderer: Any) -> None:
        """Draw in the style of the figure: matplotlib makes ticks only now."""
        files = {name: value for name, value in RC.items() if name.startswith(("pdf.", "ps."))}
        with using(self.settings | files), quiet():  # a file is begun and ended by its writer
            super().draw(renderer)

    def savefig(self, *args: Any, **kwargs: Any) -> None:
        """Store the figure in its style, whatever the user's settings are."""
        with using(self.settings), quiet():
            super().savefig(*args, **kwargs)

    def _repr_png_(self) -> bytes:
        """Return the picture for a notebook that has not loaded matplotlib itself."""
        stream = BytesIO()
        self.savefig(stream, format="png", dpi=SCREEN)
        return stream.getvalue()


@contextmanager
def into(axes: Axes | None) -> Iterator[None]:
    """Let the next figure be drawn into a user's Axes, if there are any, as they are."""
    if axes is not None and getattr(axes, "name", None) != "rectilinear":
        raise refusal("ax", axes, "must be Axes of matplotlib with x and y")
    kept = AXES.set(axes)
    try:
        yield
    finally:
        AXES.reset(kept)


def own_figure(axes: Axes) -> Figure:
    """Return the figure that Axes belong to, maybe by way of figures in it."""
    figure: Any = axes.figure
    return figure if isinstance(figure, Figure) else own_figure(figure)


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
