"""Write docs/phases.md and draw its figure from the table of phases that the solver follows."""

from collections import defaultdict
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from matplotlib.axes import Axes
from run_pages import store_small

from carom.dimensionless.elastic.phases import OPPOSITE, SAME, TRANSITIONS, Kind
from carom.dimensionless.states import KIND_NAMES
from carom.plots import style
from carom.quantities.causes import Cause

PAGE = Path(__file__).parents[1] / "phases.md"
FIGURE = PAGE.parent / "figures" / "phases.png"
HALVES = {False: "loading", True: "unloading"}
SIGNS = {SAME: ", same sign", OPPOSITE: ", opposite sign"}
HEAD = """\
# Diagram of the phases

*Through which phases does an impact go, and what ends each of them?*

The diagram and the table show every transition of the solver: the phase that ends, what ends it,
whether this happens while loading or unloading, and the phase that follows. An impact with
$\\lvert\\psi_1\\rvert \\le 1$ begins with stick, any other with gross slip. The contact may also
separate in any phase: slip and gross slip end so, and stick only where the load retraces its path.
The transitions are derived in [the theory](theory/sequences.md).

![The phases as boxes, and arrows from each to those that may follow](figures/phases.png)
"""
TAIL = """
This page is made by `python docs/make/phase_diagram.py` from `TRANSITIONS` in
`src/carom/dimensionless/elastic/phases.py`, the one place that decides which phase follows.
"""
PLACES = {Kind.STICK: (25.0, 41.0), Kind.SLIP: (84.0, 24.0), Kind.GROSS_SLIP: (25.0, 7.0)}
WORDS = {  # where it stands what ends a phase, and how it is aligned
    (Kind.STICK, Kind.SLIP): (55.0, 39.0, "left"),
    (Kind.SLIP, Kind.STICK): (47.0, 28.5, "right"),
    (Kind.SLIP, Kind.SLIP): (87.0, 34.5, "left"),
    (Kind.SLIP, Kind.GROSS_SLIP): (55.0, 8.5, "left"),
    (Kind.GROSS_SLIP, Kind.STICK): (21.0, 24.0, "right"),
    (Kind.GROSS_SLIP, Kind.SLIP): (46.0, 20.0, "right"),
}
STARTS = {Kind.STICK: r"$|\psi_1| \leq 1$", Kind.GROSS_SLIP: r"$|\psi_1| > 1$"}
ENDS = {Kind.STICK: (0, 9), Kind.SLIP: (12, 0), Kind.GROSS_SLIP: (0, -9)}  # from where a phase is


def page() -> str:
    """Return the whole page."""
    rows = ["| phase | ends while | because | then |", "|---|---|---|---|"]
    for (kind, cause, unloading), (after, sign) in TRANSITIONS.items():
        then = KIND_NAMES[after] + SIGNS.get(sign, "")
        half = HALVES[unloading]
        rows.append(f"| {KIND_NAMES[kind]} | {half} | {cause.message} | {then} |")
    return "\n".join([HEAD, *rows, TAIL])


def arrow(axis: Axes, start: Any, end: Any, bend: float = 0.0, **boxes: Any) -> None:
    """Draw an arrow from one place to another, between the boxes that are there."""
    look = {"arrowstyle": "-|>", "connectionstyle": f"arc3,rad={bend}", "color": "0.2", "lw": 0.9}
    axis.annotate("", end, start, arrowprops={**look, **boxes})


@style.styled
def draw() -> None:
    """Draw the diagram."""
    figure, ((axis,),) = style.new_figure(width=style.DOUBLE, height=82)
    axis.set(xlim=(0, 117), ylim=(-4, 52))
    axis.set_axis_off()
    boxes, endings = {}, defaultdict(list)
    for kind, (x, y) in PLACES.items():
        look = {"boxstyle": "round,pad=0.6", "facecolor": "0.93"}
        name = axis.text(x, y, KIND_NAMES[kind], ha="center", va="center", weight="bold", bbox=look)
        boxes[kind] = name.get_bbox_patch()
        if kind in STARTS:
            axis.plot(x - 22, y, "ko")
            arrow(axis, (x - 22, y), (x, y), patchB=boxes[kind])
            axis.text(x - 20, y + 1, STARTS[kind], va="bottom")
        end = x + ENDS[kind][0], y + ENDS[kind][1]
        axis.plot(*end, "ko", mfc="white", ms=8)
        axis.plot(*end, "ko", ms=4)
        arrow(axis, (x, y), end, patchA=boxes[kind], shrinkB=5)
        axis.text(end[0] + 2, end[1], Cause.SEPARATION.message, va="center")
    for (kind, cause, unloading), (after, _) in TRANSITIONS.items():
        endings[kind, after].append(f"{cause.message}, {HALVES[unloading]}")
    for (kind, after), words in endings.items():
        x, y, side = WORDS[kind, after]
        axis.text(x, y, "\n".join(words), ha=side, va="center")
        x, y = PLACES[kind]
        if kind == after:
            arrow(axis, (x - 3, y + 2), (x + 3, y + 2), -2.0)
        else:
            arrow(axis, (x, y), PLACES[after], -0.12, patchA=boxes[kind], patchB=boxes[after])
    with TemporaryDirectory() as folder:
        style.save_figure(figure, Path(folder) / FIGURE.name)
        store_small(Path(folder) / FIGURE.name, FIGURE)


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
    draw()
