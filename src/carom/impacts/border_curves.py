"""Borders between regions of a plane: curves through points found by bisection on lines of a grid.

Where the corners of a cell differ, the changes along its edges are bisected and joined across it.
A cell in which they could be joined in several ways, as three regions meet there, is quartered.
"""

from bisect import bisect_left, bisect_right, insort
from collections import Counter, defaultdict
from collections.abc import Callable, Iterable, Iterator
from itertools import pairwise
from typing import NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from carom.quantities.arrays import Array

Point: TypeAlias = tuple[float, float]
Node: TypeAlias = tuple[int, int]  # where lines cross, in smallest cells
Cell: TypeAlias = tuple[int, int, int]  # its lower left node, and its side in smallest cells
Line: TypeAlias = tuple[int, int]  # 0 along x or 1 along y, and its place in smallest cells
Edge: TypeAlias = tuple[Line, int, int]  # from one place on a line to another
Labels: TypeAlias = NDArray[np.int64]
Tell: TypeAlias = Callable[[Array, Array], Labels]
Bracket: TypeAlias = tuple[tuple[float, int], tuple[float, int]]  # places with their labels

WHOLE = 64  # a cell of the grid, in smallest cells
FINER = 8.0  # than the tolerance: what is found thinner than that between two others is left out
MOST = 5, 2_000  # labels found for each point of the grid, and besides: no more can be seen on it
FINEST = 3, 15_000  # the same to quarter cells
FLAT = 3e-4  # of an axis: how far a curve may be from the straight pieces that are its picture
SHIFT = 0.07  # of new lines, in cells of the grid


class Segment(NamedTuple):
    """A straight piece of a border, with the labels on its left and right."""

    start: Point
    end: Point
    left: int
    right: int


class Border(NamedTuple):
    """A curve between two regions, points of shape (n, 2), with the labels on its left and right.

    It ends where it meets another border or the rim of the map, or where it began.
    """

    left: int
    right: int
    points: Array


class Change(NamedTuple):
    """Where the label changes along the outline of a cell, anticlockwise, and on which side."""

    place: Point
    before: int
    after: int
    side: int


def border_curves(
    axes: tuple[Array, Array], labels: Labels, tell: Tell, tolerance: float, more: float
) -> list[Border]:
    """Return the borders between the regions of points with the same label.

    `axes` are x and y of the lines of a grid, rising, `labels` those of its points, (y, x), and
    `tell` returns the labels of other points. The `tolerance` of places along lines is times the
    larger of 1 and the place. To quarter cells, `more` times as many points as the grid needs may
    be labelled.
    """
    if min(labels.shape) < 2:
        return []
    plane = Plane(axes, labels, tell, tolerance, most=MOST[0] * labels.size + MOST[1])
    around = labels[:-1, :-1], labels[:-1, 1:], labels[1:, :-1], labels[1:, 1:]
    differ = np.argwhere(np.any([corner != around[0] for corner in around], axis=0))
    cells = {(WHOLE * i, WHOLE * j, WHOLE) for j, i in differ.tolist()}
    plane.look_at(cells)
    quartered: set[Cell] = set()
    if plane.asked < plane.most:
        plane.most = plane.asked + min(more * plane.asked, FINEST[0] * labels.size + FINEST[1])
    while plane.asked < plane.most:
        outlines = {cell: plane.outline(cell) for cell in cells if cell[2] > 1}
        coarse = {cell for cell, outline in outlines.items() if not is_plain(outline)}
        coarse |= plane.bent({c: o for c, o in outlines.items() if o and c not in coarse})
        if not coarse:
            break
        quartered |= coarse
        children = {child for cell in coarse for child in quarters(cell)}
        beside = {whole for cell in coarse for whole in wholes_beside(cell, labels.shape)}
        cells = (cells | children | beside) - quartered
        plane.look_at(children | beside)
    return joined(piece for cell in cells for piece in pieces(plane.outline(cell)))


class Plane:
    """Points of a plane with their labels, in order along the lines of a grid."""

    def __init__(
        self, axes: tuple[Array, Array], labels: Labels, tell: Tell, tolerance: float, most: float
    ) -> None:
        self.axes, self.labels, self.tell, self.tolerance = axes, labels, tell, tolerance
        self.asked, self.most = 0, most
        self.nodes: dict[Node, int] = {}
        self.places: dict[Line, list[float]] = defaultdict(list)
        self.label_at: dict[Line, dict[float, int]] = defaultdict(dict)
        self.crossed: dict[Line, set[float]] = defaultdict(set)
        self.straight: set[Segment] = set()
        self.low, self.high = (np.array([axis[k] for axis in axes]) for k in (0, -1))

    def look_at(self, cells: Iterable[Cell]) -> None:
        """Find the labels of the corners of cells, and where they change along their edges."""
        cells = set(cells)
        nodes = {node for cell in cells for node in corners(cell)} - self.nodes.keys()
        on_grid = {node for node in nodes if not (node[0] % WHOLE or node[1] % WHOLE)}
        asked = sorted(nodes - on_grid)
        x, y = (np.array([self.coordinate(k, node[k]) for node in asked]) for k in (0, 1))
        labels = {node: int(self.labels[node[1] // WHOLE, node[0] // WHOLE]) for node in on_grid}
        labels |= dict(zip(asked, self._labels(x, y).tolist(), strict=True))
        for (i, j), label in labels.items():
            for line, place in (((0, j), self.coordinate(0, i)), ((1, i), self.coordinate(1, j))):
                self._keep(line, place, label)
                self.crossed[line].add(place)
        self.nodes |= labels
        self._bisect({edge for cell in cells for edge in edges(cell)})

    def bent(self, outlines: dict[Cell, list[Change]]) -> set[Cell]:
        """Return the cells in which a border is far from the straight piece that joins its ends.

        There, the label beside the middle of the piece is that which belongs on its other side.
        """
        room = FLAT * (self.high - self.low)
        new = [
            (cell, piece)
            for cell, outline in outlines.items()
            if self.size(cell, room) > 2.0
            for piece in pieces(outline)
            if piece not in self.straight
        ]
        ends = np.array([piece[:2] for _, piece in new]).reshape(-1, 2, 2)
        sides = np.array([piece[2:] for _, piece in new], dtype=np.int64).reshape(-1, 2)
        x, y = ((ends[:, 1] - ends[:, 0]) / room).T
        across = room * np.stack([-y, x], axis=1) / np.maximum(np.hypot(x, y), 1e-300)[:, None]
        wrong = np.zeros(len(new), dtype=np.bool_)
        for other, away in ((sides[:, 1], across), (sides[:, 0], -across)):
            beside = np.clip(ends.mean(axis=1) + away, self.low, self.high)
            wrong |= self._labels(*beside.T) == other
        self.straight |= {piece for (_, piece), bad in zip(new, wrong, strict=True) if not bad}
        return {cell for (cell, _), bad in zip(new, wrong, strict=True) if bad}

    def size(self, cell: Cell, unit: Array) -> float:
        """Return the longer side of a cell, each in a unit of its own."""
        sides = (
            self.coordinate(k, cell[k] + cell[2]) - self.coordinate(k, cell[k]) for k in (0, 1)
        )
        return float(np.max(np.array([*sides]) / unit))

    def coordinate(self, axis: int, place: int) -> float:
        """Return x or y of a line; new lines are not halfway, where values may be special."""
        values, (cell, part) = self.axes[axis], divmod(place, WHOLE)
        if not part:
            return float(values[cell])
        share = part / WHOLE
        share += SHIFT * share * (1.0 - share)
        return float(values[cell] + share * (values[cell + 1] - values[cell]))

    def outline(self, cell: Cell) -> list[Change]:
        """Return the changes of label along the outline of a cell, anticlockwise."""
        along = []
        for side, edge in enumerate(edges(cell)):
            axis, across = edge[0][0], self.coordinate(1 - edge[0][0], edge[0][1])
            changes = self._changes(*edge)
            if side > 1:
                changes = [(place, after, before) for place, before, after in reversed(changes)]
            for place, before, after in changes:
                point = (place, across) if axis == 0 else (across, place)
                along.append(Change(point, before, after, side))
        return along

    def _changes(self, line: Line, start: int, end: int) -> list[tuple[float, int, int]]:
        """Return where the label changes along an edge, and from what to what, without slivers."""
        changes: list[tuple[float, int, int]] = []
        for (low, before), (high, after) in self._brackets(line, start, end):
            place = 0.5 * (low + high)
            if changes and self._is_sliver(line, changes[-1][0], place):
                first, before, _ = changes.pop()
                place = 0.5 * (first + place)
            if before != after:
                changes.append((place, before, after))
        return changes

    def _is_sliver(self, line: Line, low: float, high: float) -> bool:
        """Tell whether what lies between is thin, and no other line shows it."""
        if high - low > self.tolerance * max(1.0, abs(low)):
            return False
        places = self.places[line]
        within = places[bisect_left(places, low) : bisect_right(places, high)]
        return self.crossed[line].isdisjoint(within)

    def _brackets(self, line: Line, start: int, end: int) -> list[Bracket]:
        """Return the neighbours along an edge between which the label changes."""
        places, labels = self.places[line], self.label_at[line]
        low, high = (self.coordinate(line[0], place) for place in (start, end))
        within = places[bisect_left(places, low) : bisect_right(places, high)]
        samples = [(place, labels[place]) for place in within]
        return [pair for pair in pairwise(samples) if pair[0][1] != pair[1][1]]

    def _keep(self, line: Line, place: float, label: int) -> None:
        if place not in self.label_at[line]:
            insort(self.places[line], place)
        self.label_at[line][place] = label

    def _labels(self, x: Array, y: Array) -> Labels:
        self.asked += x.size
        return self.tell(x, y) if x.size else np.zeros(0, dtype=np.int64)

    def _bisect(self, where: set[Edge]) -> None:
        """Narrow every change of label along edges down to less than the tolerance."""
        brackets = [(edge[0], pair) for edge in sorted(where) for pair in self._brackets(*edge)]
        if not brackets:
            return
        lines = [line for line, _ in brackets]
        along, across = np.array([(k, self.coordinate(1 - k, place)) for k, place in lines]).T
        numbers, pairs = np.arange(len(lines)), np.array([pair for _, pair in brackets])
        ends, sides = pairs[:, :, 0], pairs[:, :, 1].astype(np.int64)
        while numbers.size:
            least = self.tolerance / FINER * np.maximum(1.0, abs(ends[:, 0]))
            wide = (ends[:, 1] - ends[:, 0] > least) & (self.asked < self.most)
            for number, places, labels in zip(
                numbers[~wide], ends[~wide].tolist(), sides[~wide].tolist(), strict=True
            ):
                for place, label in zip(places, labels, strict=True):
                    self._keep(lines[number], place, label)
            numbers, ends, sides = numbers[wide], ends[wide], sides[wide]
            middle = 0.5 * (ends[:, 0] + ends[:, 1])
            flat, other = along[numbers] == 0, across[numbers]
            label = self._labels(np.where(flat, middle, other), np.where(flat, other, middle))
            halves = [  # those with a change
                (numbers[at], np.stack([ends_a[at], ends_b[at]], 1), np.stack([a[at], b[at]], 1))
                for ends_a, ends_b, a, b in (
                    (ends[:, 0], middle, sides[:, 0], label),
                    (middle, ends[:, 1], label, sides[:, 1]),
                )
                for at in [a != b]
            ]
            numbers, ends, sides = (np.concatenate(both) for both in zip(*halves, strict=True))


def corners(cell: Cell) -> Iterator[Node]:
    """Yield the corners of a cell."""
    i, j, size = cell
    yield from ((i, j), (i + size, j), (i + size, j + size), (i, j + size))


def edges(cell: Cell) -> Iterator[Edge]:
    """Yield the edges of a cell, anticlockwise; the last two are walked backwards then."""
    i, j, size = cell
    yield from (((0, j), i, i + size), ((1, i + size), j, j + size))
    yield from (((0, j + size), i, i + size), ((1, i), j, j + size))


def quarters(cell: Cell) -> Iterator[Cell]:
    """Yield the quarters of a cell."""
    i, j, half = cell[0], cell[1], cell[2] // 2
    yield from ((i + m * half, j + n * half, half) for m in (0, 1) for n in (0, 1))


def wholes_beside(cell: Cell, shape: tuple[int, ...]) -> Iterator[Cell]:
    """Yield the cells of a grid beside the one that a cell is in."""
    i, j = cell[0] // WHOLE, cell[1] // WHOLE
    for m, n in ((i - 1, j), (i + 1, j), (i, j - 1), (i, j + 1)):
        if 0 <= m < shape[1] - 1 and 0 <= n < shape[0] - 1:
            yield (WHOLE * m, WHOLE * n, WHOLE)


def is_plain(outline: list[Change]) -> bool:
    """Tell whether changes can be joined across a cell in one way only, from side to side."""
    pairs, rest = paired(outline)
    return not rest and all(first.side != second.side for first, second in pairs)


def paired(outline: list[Change]) -> tuple[list[tuple[Change, Change]], list[Change]]:
    """Return the changes that border a region which touches the outline once, and the rest."""
    rest, pairs = list(outline), []
    while rest:
        often = Counter(change.after for change in rest)
        for k, first in enumerate(rest):
            second = rest[(k + 1) % len(rest)]
            if often[first.after] == 1 and first.before == second.after:
                pairs.append((first, second))
                rest = [change for change in rest if change not in (first, second)]
                break
        else:
            break
    return pairs, rest


def pieces(outline: list[Change]) -> Iterator[Segment]:
    """Yield what joins the changes on the outline of a cell; in its middle, where many meet."""
    pairs, rest = paired(outline)
    for first, second in pairs:
        yield Segment(first.place, second.place, first.before, first.after)
    if rest:
        middle = np.mean([change.place for change in rest], axis=0).tolist()
        for change in rest:
            yield Segment(change.place, (middle[0], middle[1]), change.before, change.after)


def joined(segments: Iterable[Segment]) -> list[Border]:
    """Return the curves that segments make, those of the same two labels together."""
    following: dict[tuple[int, int], dict[Point, list[Point]]] = defaultdict(dict)
    for segment in segments:
        start, end, left, right = segment
        if left > right:
            start, end, left, right = end, start, right, left
        if start != end:
            following[left, right].setdefault(start, []).append(end)
    return [
        Border(*sides, np.array(curve))
        for sides, pieces in sorted(following.items())
        for curve in chains(pieces)
    ]


def chains(following: dict[Point, list[Point]]) -> Iterator[list[Point]]:
    """Yield lines of points, each given with those that follow it; open lines first."""
    reached = {end for ends in following.values() for end in ends}
    for start in [*(s for s in following if s not in reached), *following]:
        while following[start]:
            line = [start]
            while following.get(line[-1]):
                line.append(following[line[-1]].pop())
                if line[-1] == start:
                    break
            yield line
