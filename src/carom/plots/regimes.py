"""Rebound curves with their regimes, and the borders of regimes over a map of psi_1 and chi."""

from typing import Any, TypeAlias, Unpack

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch
from matplotlib.textpath import TextPath

from carom.plots import style
from carom.plots.bands import BANDS, STICK, Band, mirrored, shade
from carom.plots.drawing import Drawable, draws
from carom.plots.legends import font_size, legend_above
from carom.plots.look import RC, Look
from carom.quantities.arrays import Array

Named: TypeAlias = tuple[str, tuple[float, float]]  # a name and the place that it is for

MARKERS = "os^Dv"
ABOVE = 1.1  # where a key to a user's Axes begins, above the names of borders
REGIMES = {  # of all figures: how the impact begins
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

    Examples
    --------
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
    axis.set(xlabel=style.label("psi_in"), ylabel=style.label("psi_out"))
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
    stroke: Any = {"color": color, "ls": style.DASHES[row % len(style.DASHES)]}
    axis.plot(psi, out, **stroke)
    label = rf"$\chi$ = {float(one['chi']):g}"
    axis.plot([], [], **stroke, marker=marker if dots else "", label=label)


def shade_regimes(axis: Axes, borders: Array | None, low: float, high: float) -> list[Patch]:
    """Shade the regimes between two psi_1, if their borders are known; return the keys to them."""
    shown = {}
    if borders is not None:
        for name, start, end in mirrored(REGIMES, [0.0, *borders, np.inf], low, high):
            shade(axis, start, end, REGIMES[name])
            shown[name] = REGIMES[name].key(name)
    return list(shown.values())


def regime_of(sequence: str) -> str:
    """Return the regime of a sequence of phases."""
    kinds = [phase.rstrip(" +-") for phase in sequence.split(", ")]
    later = next((kind for kind in kinds if kind != "gross slip"), "only")
    return "stick" if kinds[0] == "stick" else f"gross slip{', ' * (later != 'only') or ' '}{later}"


def draw_borders(axis: Axes, restitution: float = 1.0) -> None:
    """Draw the borders of the regimes over a map, 1, 2 chi and 2 chi (1 + e) - e, with names."""
    (left, right), (bottom, top) = axis.get_xlim(), axis.get_ylim()
    chi = np.linspace(max(bottom, 0.5), top, 201)
    slides = r"$4\chi-1$" if restitution == 1.0 else r"$2\chi(1+e)-e$"
    lines = {r"$1$": 0.0 * chi + 1.0, r"$2\chi$": 2.0 * chi}
    lines[slides] = 2.0 * chi * (1.0 + restitution) - restitution
    above: list[Named] = []
    beside: list[Named] = []
    for dash, (name, psi) in zip(style.DASHES, lines.items(), strict=False):
        axis.plot(psi, chi, color="black", ls=dash, lw=1.0)
        inside = psi <= right
        if not inside.any() or not left <= psi[inside][-1]:
            continue
        at = (float(psi[inside][-1]), float(chi[inside][-1]))
        (above if inside.all() else beside).append((rf"$\psi_1 = ${name}", at))
    _name_above(axis, above)
    _name_beside(axis, beside)
    if bottom < 0.5:
        axis.plot([1.0, 1.0], [bottom, 0.5], color="black", ls="-", lw=1.0)


def _name_above(axis: Axes, named: list[Named]) -> None:
    """Write names over the ends of lines at the top, higher where one would be in another's way."""
    size, lines, last = font_size(RC["font.size"]), 0, -np.inf
    for name, at in named:
        half = 0.5 * TextPath((0, 0), name, size=size).get_extents().width + 0.4 * size
        place = _points(axis, at)[0]
        lines = lines + 1 if place - half < last else 0
        last = place + half
        offset = (0.0, 3.0 + 1.4 * size * lines)
        axis.annotate(name, at, offset, textcoords="offset points", ha="center", va="bottom")


def _name_beside(axis: Axes, named: list[Named]) -> None:
    """Write names beside the ends of lines at the right, the lower ones lower if need be."""
    size, right, last = font_size(RC["font.size"]), axis.get_xlim()[1], np.inf
    for name, at in named:
        place = _points(axis, at)[1]
        written = min(place, last - 1.4 * size)
        last, offset = written, (3.0, written - place)
        xy = (right, at[1])
        axis.annotate(name, xy, offset, textcoords="offset points", va="center")


def _points(axis: Axes, at: tuple[float, float]) -> Array:
    """Return the place of a point within axes, in points."""
    return np.asarray(axis.transData.transform(at)) * 72.0 / float(axis.figure.dpi)
