"""Write the table of transitions of docs/theory/sequences.md and draw its figure."""

from collections import defaultdict

from measuring_drawing import PLAIN, arrow, sheet, write
from run_pages import DOCS, store_small

from carom.dimensionless.elastic.phases import OPPOSITE, SAME, TRANSITIONS, Kind
from carom.dimensionless.states import KIND_NAMES
from carom.plots import style
from carom.quantities.statuses import Cause

from page_blocks import page_with, table  # isort: skip  # run_pages says where it is

PAGE, FIGURE = DOCS / "theory" / "sequences.md", DOCS / "figures" / "phases.png"
HALVES = {False: "loading", True: "unloading"}
SIGNS = {SAME: ", same sign", OPPOSITE: ", opposite sign"}
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
    """Return the page with the table of now."""
    rows = [
        f"{KIND_NAMES[kind]} | {HALVES[unloading]} | {cause.message} | "
        f"{KIND_NAMES[after]}{SIGNS.get(sign, '')}"
        for (kind, cause, unloading), (after, sign) in TRANSITIONS.items()
    ]
    return page_with(PAGE, {"transitions": table("phase | ends while | because | then", rows)})


@style.styled
def draw() -> None:
    """Draw the diagram."""
    figure, axis = style.single_axis(width=style.DOUBLE, height=82)
    sheet(axis, (0, 117), (-4, 52))
    boxes, endings = {}, defaultdict(list)
    look = {"boxstyle": "round,pad=0.6", "facecolor": "0.93"}
    for kind, (x, y) in PLACES.items():
        write(axis, x, y, KIND_NAMES[kind], weight="bold", bbox=look)
        boxes[kind] = axis.texts[-1].get_bbox_patch()
        if kind in STARTS:
            axis.plot(x - 22, y, "ko")
            arrow(axis, (x - 22, y), (x, y), PLAIN, patchB=boxes[kind])
            write(axis, x - 20, y + 1, STARTS[kind], ha="left", va="bottom")
        end = x + ENDS[kind][0], y + ENDS[kind][1]
        axis.plot(*end, "ko", mfc="white", ms=8)
        axis.plot(*end, "ko", ms=4)
        arrow(axis, (x, y), end, PLAIN, patchA=boxes[kind], shrinkB=5)
        write(axis, end[0] + 2, end[1], Cause.SEPARATION.message, ha="left")
    for (kind, cause, unloading), (after, _) in TRANSITIONS.items():
        endings[kind, after].append(f"{cause.message}, {HALVES[unloading]}")
    for (kind, after), words in endings.items():
        x, y, side = WORDS[kind, after]
        write(axis, x, y, "\n".join(words), ha=side)
        x, y = PLACES[kind]
        ends = {"patchA": boxes[kind], "patchB": boxes[after], "connectionstyle": "arc3,rad=-0.12"}
        if kind == after:
            arrow(axis, (x - 3, y + 2), (x + 3, y + 2), PLAIN, connectionstyle="arc3,rad=-2")
        else:
            arrow(axis, (x, y), PLACES[after], PLAIN, **ends)
    store_small(figure, FIGURE)


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
    draw()
