"""State diagrams, written in the words of Mermaid, drawn as SVG while the manual is built.

Where the sources are kept, such a block is shown as a diagram by itself; the pages of the manual
would need a program of megabytes to do so.
"""

import re
from collections import defaultdict
from html import escape
from math import hypot
from typing import Any, NamedTuple

from docutils import nodes
from docutils.parsers.rst import Directive
from sphinx.application import Sphinx

EDGE = re.compile(r"\s*(\S+) --> (\S+?): (.+)")


class Place(NamedTuple):
    """A point of the drawing."""

    x: float
    y: float


SIZE = (1000, 470)
PLACES = {  # centre of each state, and where its start and its end are
    "stick": (Place(250, 90), Place(60, 90), Place(250, 20)),
    "slip": (Place(800, 235), Place(800, 235), Place(955, 235)),
    "gross_slip": (Place(250, 380), Place(60, 380), Place(250, 450)),
}
BOX = (58, 22)  # half width and height of a state
LINE = 17  # height of a line of text
POINT = "[*]"


class StateDiagram(Directive):
    """A `stateDiagram-v2` of known states."""

    has_content = True

    def run(self) -> list[nodes.Node]:
        return [nodes.raw("", drawing(list(self.content)), format="html")]


def drawing(lines: list[str]) -> str:
    """Return a diagram as SVG, in the colour of the text around it."""
    arrows = defaultdict(list)
    for line in lines[1:]:
        origin, target, words = EDGE.fullmatch(line).groups()
        arrows[origin, target].append(words)
    parts = [arrow(*ends, words) for ends, words in arrows.items()]
    parts += [state(name) for name in PLACES]
    return (
        f'<svg class="diagram" viewBox="0 0 {SIZE[0]} {SIZE[1]}" role="img">'
        "<title>Which phase follows which</title>"
        '<defs><marker id="tip" viewBox="0 0 8 8" refX="7" refY="4" markerWidth="8"'
        ' markerHeight="8" orient="auto"><path d="M0,0 L8,4 L0,8 z"/></marker></defs>'
        f"{''.join(parts)}</svg>"
    )


def state(name: str) -> str:
    """Return the box of a state."""
    (x, y), (w, h) = PLACES[name][0], BOX
    return (
        f'<rect x="{x - w}" y="{y - h}" width="{2 * w}" height="{2 * h}" rx="10"/>'
        f'<text class="state" x="{x}" y="{y + 5}">{name.replace("_", " ")}</text>'
    )


def arrow(origin: str, target: str, words: list[str]) -> str:
    """Return an arrow with what is said of it; starts and ends are dots."""
    if origin == POINT:
        place, dot = PLACES[target][1], '<circle cx="{}" cy="{}" r="7"/>'
        return dot.format(*place) + straight(place, PLACES[target][0], words)
    if target == POINT:
        place = PLACES[origin][2]
        dot = '<circle class="end" cx="{0}" cy="{1}" r="9"/><circle cx="{0}" cy="{1}" r="5"/>'
        return dot.format(*place) + straight(PLACES[origin][0], place, words)
    if origin == target:
        return loop(PLACES[origin][0], words)
    return bent(PLACES[origin][0], PLACES[target][0], words)


def straight(start: Place, end: Place, words: list[str]) -> str:
    """Return a short arrow from or to a dot, the words above it or beside it."""
    first, last = border(start, end, 9), border(end, start, 11)
    if start.x == end.x:
        return line(first, last) + text(Place(end.x + 14, end.y + 5), words, "start")
    middle = Place((first.x + last.x) / 2, start.y - 10)
    return line(first, last) + text(middle, words, "middle")


def border(centre: Place, other: Place, radius: float) -> Place:
    """Return where a line from here to there leaves the box, or the dot, that is here."""
    dx, dy = other.x - centre.x, other.y - centre.y
    length = hypot(dx, dy)
    if any(centre == place[0] for place in PLACES.values()):
        w, h = BOX
        share = min(w / abs(dx) if dx else 9.0, h / abs(dy) if dy else 9.0)
        return Place(centre.x + share * dx, centre.y + share * dy)
    return Place(centre.x + radius * dx / length, centre.y + radius * dy / length)


def bent(start: Place, end: Place, words: list[str]) -> str:
    """Return an arrow that keeps to its left, so that its opposite has room."""
    dx, dy = end.x - start.x, end.y - start.y
    length = hypot(dx, dy)
    left = Place(dy / length, -dx / length)
    bend = Place((start.x + end.x) / 2 + 46 * left.x, (start.y + end.y) / 2 + 46 * left.y)
    side = "start" if left.x >= 0 else "end"
    share = 0.36 if start.x < end.x else 0.64 if start.x > end.x else 0.5
    near = [
        (1 - share) ** 2 * a + 2 * share * (1 - share) * b + share**2 * c
        for a, b, c in zip(start, bend, end, strict=True)
    ]
    at = Place(near[0] + 10 * left.x, near[1] + 17 * left.y + 4)
    return line(border(start, bend, 0), border(end, bend, 0), bend) + text(at, words, side)


def loop(centre: Place, words: list[str]) -> str:
    """Return an arrow from a state to itself, over its top."""
    top = centre.y - BOX[1]
    path = f"M{centre.x - 24},{top} C{centre.x - 44},{top - 60} {centre.x + 44},{top - 60}"
    curve = f'<path class="edge" d="{path} {centre.x + 24},{top}"/>'
    return curve + text(Place(centre.x, top - 56 - LINE * (len(words) - 1)), words, "middle")


def line(start: Place, end: Place, bend: Place | None = None) -> str:
    way = f"Q{bend.x:.0f},{bend.y:.0f} " if bend else "L"
    return f'<path class="edge" d="M{start.x:.0f},{start.y:.0f} {way}{end.x:.0f},{end.y:.0f}"/>'


def text(place: Place, words: list[str], anchor: str) -> str:
    """Return lines of text that begin, end or are centred at a place."""
    spans = (
        f'<tspan x="{place.x:.0f}" y="{place.y + number * LINE:.0f}">{escape(said)}</tspan>'
        for number, said in enumerate(words)
    )
    return f'<text text-anchor="{anchor}">{"".join(spans)}</text>'


def setup(app: Sphinx) -> dict[str, Any]:
    app.add_directive("mermaid", StateDiagram)
    return {"parallel_read_safe": True}
