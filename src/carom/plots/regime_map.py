"""The map of regimes over psi_1 and chi: regions in colours, each with its sequence of phases."""

from collections import Counter
from itertools import chain, groupby
from typing import Any, NamedTuple, Unpack

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import LinearSegmentedColormap
from matplotlib.figure import Figure
from matplotlib.patches import Patch, PathPatch

from carom.plots import style
from carom.plots.drawing import Drawable, draws
from carom.plots.legends import fitting_columns, font_size, wrapped
from carom.plots.look import AXES, Look
from carom.plots.regimes import ABOVE, REGIMES, draw_borders, regime_of
from carom.plots.region_labels import PITCH, SMALLEST_LABEL, Label, Labels, find_labels, in_letters
from carom.plots.regions import Region, area, limits, regions
from carom.quantities.arrays import Array

MANY = 7  # reversals of slip, of which the colour is the darkest at least
DARK = {  # towards which faces go
    "stick": style.BLUE,
    "gross slip, stick": style.VERMILION,
    "gross slip, slip": style.PURPLE,
    "gross slip only": style.BLACK,
}
DARKEST = 0.8  # share of it
NAMED = "sequence_met", "sequence_name", "border_left", "border_right"  # of which all are listed
KEY = (
    "G gross slip, S stick, s slip in a ring around a stick region; "
    "+ and \u2212: sign of the slip velocity"
)
BEGINS = "{}; reversals of slip:"
SHORT = "Colours: how the impact begins, and how often slip reverses. Labels:"
EDGE: Any = {"ec": "0.2", "lw": 0.4}
SPACING: Any = {"handlelength": 1.6, "handletextpad": 0.5, "columnspacing": 1.0}
UNDER = 0.8  # of the way from the middle of a label to its edge: where a leader line ends
UNSEEN = 1e-6  # of the area of the largest region: colours that the key leaves out
LISTED = 40  # sequences below a map, of those that are not marked
HEIGHT = 0.42  # of the map, in widths of the figure
MARGIN = 11.0  # of text beside a figure's edges, in points


class Group(NamedTuple):
    """Impacts of one regime in which slip reverses its sense as often."""

    regime: str
    reversals: int


def group_of(name: str) -> Group:
    """Return to which group a sequence of phases belongs."""
    phases = name.split(", ")
    senses = [phase[-1] for phase in phases if phase[-1] in "+-"]
    return Group(regime_of(name), len(list(groupby(senses))) - 1 if senses else 0)


@draws(
    "a map of regimes, what carom.regime_map returns",
    *("sequence", "sequence_name", "psi_in", "chi"),
    along=("chi", "psi_in"),
)
def plot_regime_map(dataset: Drawable, **look: Unpack[Look]) -> Figure:
    """Draw which phases follow which over psi_1 and chi, with the borders 1, 2 chi, 4 chi - 1.

    The colour of a region is that of its regime, how the impact begins, the darker the more often
    slip reverses. Its label is the sequence of phases in letters, at the end of a line where it has
    no room inside, or a number that is explained below the map. Regions narrower than 0.2 mm are
    listed there. A dataset without outlines is drawn by its points.

    Examples
    --------
    >>> figure = carom.plots.plot_regime_map(carom.regime_map([0.5, 2.0, 6.0], [1.0, 1.44]))
    >>> [text.get_text() for text in figure.axes[0].texts][2:4]
    ['$\\\\psi_1 = $$4\\\\chi-1$', 'G+']
    """
    figure, axis = style.single_axis(width=style.DOUBLE, height=HEIGHT * style.DOUBLE + 30.0)
    drawn = regions(dataset)
    colours = _colours({group_of(region.name) for region in drawn if region.name})
    for region in drawn:
        face = colours[group_of(region.name)] if region.name else "white"
        hatch = None if region.name else "xxxx"
        axis.add_artist(PathPatch(region.path(), fc=face, hatch=hatch, **EDGE))
    axis.set(xlim=limits(dataset, "psi_in"), ylim=limits(dataset, "chi"))
    axis.set(xlabel=style.label("psi_in"), ylabel=style.label("chi"))
    draw_borders(axis, float(dataset.get("restitution", 1.0)))
    least = UNSEEN * area(drawn[0].rings[0])
    shown = {group_of(one.name) for one in drawn if one.name and area(one.rings[0]) > least}
    _add_key(figure, sorted(shown), colours)
    lists = [dataset[name].values.tolist() for name in NAMED if name in dataset]
    _label_regions(figure, axis, drawn, list(dict.fromkeys(chain.from_iterable(lists))))
    return figure


def _colours(groups: set[Group]) -> dict[Group, Any]:
    most = max([MANY, *(group.reversals for group in groups)])
    ends = {name: [REGIMES[name].face, dark] for name, dark in DARK.items()}
    shades = {name: LinearSegmentedColormap.from_list(name, ends[name]) for name in ends}
    return {group: shades[group.regime](DARKEST * group.reversals / most) for group in groups}


def _add_key(figure: Figure, groups: list[Group], colours: dict[Group, Any]) -> None:
    """Add what colours and letters mean: a row for each regime, a column for each number."""
    room = _room(figure)
    counts = sorted({group.reversals for group in groups})
    regimes = [name for name in REGIMES if name in {group.regime for group in groups}]
    blank: Any = {"fc": "none", "ec": "none"}
    handles = [Patch(label=BEGINS.format(name), **blank) for name in regimes]
    for group in (Group(name, count) for count in counts for name in regimes):
        face = {"fc": colours[group], **EDGE} if group in groups else blank
        handles.append(Patch(label=str(group.reversals) if group in groups else " ", **face))
    columns, key = len(counts) + 1, KEY
    if fitting_columns(handles, columns, room, **SPACING) < columns:
        key = f"{SHORT} {KEY}"
        handles = [
            Patch(fc=colours[group], label=f"{group.regime}, {group.reversals}", **EDGE)
            for group in groups
        ]
        columns = fitting_columns(handles, 4, room, **SPACING)
    place: Any = {"loc": "outside upper left", "alignment": "left", "title_fontsize": "small"}
    title = wrapped(key, room)
    if AXES.get() is not None:
        place |= {"loc": "lower left", "bbox_to_anchor": (0.0, ABOVE)}
    where: Any = AXES.get() or figure
    where.legend(handles=handles, ncols=columns, title=title, **place, **SPACING)


def _label_regions(figure: Figure, axis: Axes, areas: list[Region], names: list[str]) -> None:
    """Write the sequence of every wide region into it or beside it; list others below the map."""
    lines = [np.asarray(line.get_xydata()) for line in axis.lines]
    _set_height(figure, axis)
    size, to_mm = _laid_out(figure, axis)
    labels = find_labels(areas, lines, to_mm, size)
    drawn = {region.name for region in areas}
    labels.narrow.extend(name for name in names if name not in drawn)
    _list(figure, labels)
    for label in labels.placed.values():
        _write(axis, label, np.array(size))
    _set_height(figure, axis)


def _set_height(figure: Figure, axis: Axes) -> None:
    """Make a figure as high as its map needs, and what is around it."""
    if AXES.get() is not None:
        return
    wanted, (_, height) = HEIGHT * figure.get_figwidth(), _laid_out(figure, axis)[0]
    figure.set_figheight(figure.get_figheight() + wanted - height / 25.4)


def _laid_out(figure: Figure, axis: Axes) -> tuple[tuple[float, float], Array]:
    """Return the size of the axes in mm, and what makes mm of its coordinates: factor, shift."""
    engine = figure.get_layout_engine()
    if engine is None or AXES.get() is not None:
        figure.draw_without_rendering()
    else:  # sooner
        engine.execute(figure)
    box = axis.get_window_extent()
    size = np.array([box.width, box.height]) * 25.4 / figure.dpi
    low, high = np.array([axis.get_xlim(), axis.get_ylim()]).T
    factor = size / (high - low)
    return (float(size[0]), float(size[1])), np.array([factor, -low * factor])


def _list(figure: Figure, labels: Labels) -> None:
    """Write below the map what numbers mean, and which sequences are not marked, and why."""
    numbered = (f"{k}\u00a0=\u00a0{_tied(name)}" for k, name in enumerate(labels.numbered, 1))
    parts = ["; ".join(numbered)]
    reasons = {f"narrower than {SMALLEST_LABEL:g} mm": labels.narrow, "without room": labels.lost}
    for reason, names in reasons.items():
        counted = [
            _tied(name) + f"\u00a0({k}\u00a0regions)" * (k > 1)
            for name, k in Counter(names).items()
        ]
        counted[LISTED:] = [f"and {len(counted) - LISTED} more"] if len(counted) > LISTED else []
        parts.append(f"Not marked, {reason}: {'; '.join(counted)}" if names else "")
    text = "\n".join(wrapped(part, _room(figure)) for part in parts if part)
    axis = AXES.get()
    if text and axis is None:
        figure.supxlabel(text, x=0.01, ha="left", fontsize="small")
        lines = PITCH * font_size("small") * (text.count("\n") + 1)
        height = figure.get_figheight() + lines / 72.0  # which leaves room for a layout
        figure.set_figheight(height)
    elif text and axis is not None:
        axis.set_xlabel(f"{axis.get_xlabel()}\n{text}", fontsize="small")


def _room(figure: Figure) -> float:
    """Return how wide text across a figure may be, in points."""
    axis = AXES.get()
    beside = 0.0 if axis is None else float(axis.get_position().x0)
    return 72.0 * figure.get_figwidth() * (1.0 - beside) - MARGIN


def _tied(name: str) -> str:
    """Return a sequence in letters that stay on one line."""
    return "\u00a0".join(in_letters(name)) if name else "not\u00a0resolved"


def _write(axis: Axes, label: Label, size: Array) -> None:
    """Write a label, with a line to its region if it is not inside."""
    look: Any = {"ha": "center", "va": "center", "fontsize": "small", "linespacing": 1.1}
    look |= {"rotation": 90.0 if label.block.turned else 0.0, "transform": axis.transAxes}
    x, y = label.at / size
    text = axis.text(x, y, label.block.text, zorder=5, **look)
    text.set_in_layout(False)
    if label.start is not None:
        text.set_bbox({"boxstyle": "square,pad=0.12", "fc": "white", "ec": "none"})
        under = label.at + UNDER * (label.end - label.at)  # the box, which hides the end
        ends = np.array([label.start, under]) / size
        (line,) = axis.plot(*ends.T, transform=axis.transAxes, color="black", lw=0.5, zorder=4)
        line.set(marker="o", markevery=[0], ms=1.5)
        line.set_in_layout(False)
