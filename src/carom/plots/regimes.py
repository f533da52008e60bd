"""Rebound curves with their regimes, and the map of regimes over psi_1 and chi."""

from typing import Any, Unpack

import matplotlib
import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.colors import BoundaryNorm, ListedColormap
from matplotlib.figure import Figure
from matplotlib.patches import Patch
from matplotlib.patheffects import withStroke
from numpy.typing import NDArray
from scipy.ndimage import distance_transform_cdt

from carom.plots import style
from carom.plots.bands import BANDS, MINUS, STICK, Band, mirrored, shade
from carom.plots.drawing import Drawable, draws
from carom.plots.legends import legend_above
from carom.plots.look import Look
from carom.quantities.arrays import Array

MARKERS = "os^Dv"
LETTERS = "ABCDEFGHIJKLMNOPQRSTUVWX"
KEY = "G gross slip, S stick, s slip ring"
SHADES = matplotlib.colormaps["cividis"]
SMALLEST = 2  # half the width of a region with its letter in it, in cells
REGIMES = {
    "stick": STICK,
    "gross slip, stick": BANDS["slip", 1],
    "gross slip, slip": BANDS["gross slip", 1],
    "gross slip only": Band("#BDBDBD", "#BDBDBD", ""),
}


@draws(
    "rebound curves, what carom.curve returns",
    *("psi_out", "psi_in", "chi", "contact_restitution"),
    along=("chi", "psi_in"),
)
def plot_curve(dataset: Drawable, **look: Unpack[Look]) -> Figure:
    """Draw psi_2 against psi_1, one line per chi, with the borders of the regimes if it has them.

    Of a single chi the regimes are bands, told by how the impact begins; of several, marks on the
    lines are the borders.

    Parameters
    ----------
    dataset : xarray.Dataset
        What `carom.curve` returns.
    width, font_size, style : optional
        Width in mm, size of labels in points, style of matplotlib; see `carom.plots.style.style`.

    Returns
    -------
    matplotlib.figure.Figure
        The figure.

    Raises
    ------
    InputError
        If the dataset is another one.

    Examples
    --------
    >>> import carom
    >>> axis = carom.plots.plot_curve(carom.curve(1.44, [0.0, 0.5, 1.0, 1.5, 2.0])).axes[0]
    >>> [text.get_text() for text in axis.get_legend().get_texts()[1:]]
    ['stick', 'gross slip, stick']
    """
    figure, axis = style.single_axis(height=66.0)
    psi = dataset["psi_in"].values
    style.zero_line(axis)
    single, regimes = dataset.sizes["chi"] == 1, "border" in dataset
    for row in range(dataset.sizes["chi"]):
        _draw_line(axis, dataset.isel(chi=row), row, dots=regimes and not single)
    if regimes and not single:
        axis.plot([], [], MARKERS[0], color=style.BLACK, label="regime borders")
    lines, _ = axis.get_legend_handles_labels()
    ends = dataset["border"].values[0] if regimes and single else None
    bands = shade_regimes(axis, ends, psi.min(), psi.max())
    style.span(axis, psi)
    axis.set_xlabel(style.label("psi_in"))
    axis.set_ylabel(style.label("psi_out"))
    entries = [*lines, *bands]
    legend_above(axis, 2 if single or len(entries) < 5 else 3, handles=entries)
    return figure


def _draw_line(axis: Axes, one: xr.Dataset, row: int, dots: bool) -> None:
    psi, out = one["psi_in"].values, one["psi_out"].values
    color, marker = style.LINES[row % len(style.LINES)], MARKERS[row % len(MARKERS)]
    ends = np.array([])
    if dots:
        ends = np.concatenate([-one["border"].values[::-1], one["border"].values])
        ends = ends[(ends > psi[0]) & (ends < psi[-1])]
        axis.plot(ends, np.interp(ends, psi, out), marker, color=color)
    axis.plot(psi, out, color=color, ls=style.DASHES[row % len(style.DASHES)])
    handle = {
        "color": color,
        "ls": style.DASHES[row % len(style.DASHES)],
        "marker": marker if dots else "",
    }
    axis.plot([], [], **handle, label=rf"$\chi$ = {float(one['chi']):g}")


def shade_regimes(axis: Axes, borders: Array | None, low: float, high: float) -> list[Patch]:
    """Shade the regimes between two psi_1, if their borders are known; return the keys to them."""
    shown = {}
    if borders is not None:
        for name, start, end in mirrored(REGIMES, [0.0, *borders, np.inf], low, high):
            shade(axis, start, end, REGIMES[name])
            shown[name] = REGIMES[name].key(name)
    return list(shown.values())


def _short(name: str) -> str:
    """Return a sequence of phases in letters, e.g. "G+ S s- G-"."""
    for words, letter in (("gross slip", "G"), ("stick", "S"), ("slip", "s")):
        name = name.replace(words, letter)
    return name.replace(",", "").replace(" +", "+").replace(" -", MINUS)


@draws(
    "a map of regimes, what carom.regime_map returns",
    *("sequence", "sequence_name", "psi_in", "chi"),
    along=("chi", "psi_in"),
)
def plot_regime_map(dataset: Drawable, **look: Unpack[Look]) -> Figure:
    """Draw which phases follow which over psi_1 and chi, with the borders 1, 2 chi, 4 chi - 1.

    The shading tells the number of phases; letters name the sequences, the commonest first.

    Parameters
    ----------
    dataset : xarray.Dataset
        What `carom.regime_map` returns.
    width, font_size, style : optional
        Width in mm, size of labels in points, style of matplotlib; see `carom.plots.style.style`.

    Returns
    -------
    matplotlib.figure.Figure
        The figure, 178 mm wide.

    Raises
    ------
    InputError
        If the dataset is another one.

    Examples
    --------
    >>> import carom
    >>> figure = carom.plots.plot_regime_map(carom.regime_map([0.5, 2.0, 6.0], [1.0, 1.44]))
    >>> len(figure.legends[0].get_texts())
    4
    """
    figure, axis = style.single_axis(width=style.DOUBLE, height=88.0)
    codes, names = dataset["sequence"].values, [str(n) for n in dataset["sequence_name"].values]
    counts = np.array([name.count(",") + 1 for name in names])
    shades = ListedColormap([SHADES(place) for place in np.linspace(1.0, 0.15, counts.max())])
    psi, chi = dataset["psi_in"].values, dataset["chi"].values
    shown = np.ma.masked_less(np.append(counts, -1)[codes], 0)
    norm = BoundaryNorm(np.arange(0.5, counts.max() + 1.0), shades.N)
    axis.pcolormesh(psi, chi, shown, cmap=shades, norm=norm, shading="nearest", rasterized=True)
    axis.add_collection(_outlines(psi, chi, codes), autolim=False)
    style.span(axis, psi, chi)
    axis.set(xlabel=style.label("psi_in"), ylabel=style.label("chi"))
    _letter_regions(axis, dataset)
    draw_borders(axis, float(dataset.get("restitution", 1.0)))
    patches = [
        Patch(fc=shades(int(count) - 1), ec="0.3", lw=0.4, label=f"{LETTERS[i]}  {_short(name)}")
        for i, (name, count) in enumerate(zip(names[: len(LETTERS)], counts, strict=False))
    ]
    figure.legend(handles=patches, loc="outside right upper", title=KEY, alignment="left")
    return figure


def _outlines(psi: Array, chi: Array, codes: NDArray[np.int16]) -> LineCollection:
    """Return the edges of cells across which the sequence changes."""
    x, y = _edges(psi), _edges(chi)
    right, above = (np.argwhere(np.diff(codes, axis=axis)) for axis in (1, 0))
    sides = [((x[j + 1], y[i]), (x[j + 1], y[i + 1])) for i, j in right]
    tops = [((x[j], y[i + 1]), (x[j + 1], y[i + 1])) for i, j in above]
    return LineCollection([*sides, *tops], colors="white", linewidths=0.5, capstyle="projecting")


def _edges(centres: Array) -> Array:
    middle = 0.5 * (centres[1:] + centres[:-1])
    return np.concatenate([centres[:1], middle, centres[-1:]])


def _letter_regions(axis: Axes, dataset: xr.Dataset) -> None:
    """Write the letter of each sequence where its region is widest."""
    psi, chi = dataset["psi_in"].values, dataset["chi"].values
    for code in range(min(dataset.sizes["sequence_name"], len(LETTERS))):
        inside = np.pad(dataset["sequence"].values == code, 1)
        depth = distance_transform_cdt(inside)[1:-1, 1:-1]
        row, column = np.unravel_index(depth.argmax(), depth.shape)
        if depth[row, column] >= SMALLEST:
            at = float(psi[column]), float(chi[row])
            text = axis.text(*at, LETTERS[code], ha="center", va="center")
            text.set_path_effects([withStroke(linewidth=2.0, foreground="white")])


def draw_borders(axis: Axes, restitution: float = 1.0) -> None:
    """Draw the borders of the regimes over a map, 1, 2 chi and 2 chi (1 + e) - e, with names."""
    (left, right), (bottom, top) = axis.get_xlim(), axis.get_ylim()
    chi = np.linspace(max(bottom, 0.5), top, 201)
    slides = r"$4\chi-1$" if restitution == 1.0 else r"$2\chi(1+e)-e$"
    lines = {r"$1$": 0.0 * chi + 1.0, r"$2\chi$": 2.0 * chi}
    lines[slides] = 2.0 * chi * (1.0 + restitution) - restitution
    for dash, (name, psi) in zip(style.DASHES, lines.items(), strict=False):
        axis.plot(psi, chi, color="black", ls=dash, lw=1.0)
        inside = psi <= right
        if not inside.any() or not left <= psi[inside][-1]:
            continue
        last = psi[inside][-1], chi[inside][-1]
        place: dict[str, Any] = {"xy": (right, last[1]), "xytext": (3, 0), "va": "center"}
        if inside.all():
            place = {"xy": last, "xytext": (0, 3), "ha": "center", "va": "bottom"}
        axis.annotate(rf"$\psi_1 = ${name}", textcoords="offset points", **place)
    if bottom < 0.5:
        axis.plot([1.0, 1.0], [bottom, 0.5], color="black", ls="-", lw=1.0)
