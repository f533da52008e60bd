"""Cells of a grid and their quarters: which are beside which, and how borders cross them."""

from collections import Counter
from collections.abc import Iterator
from typing import NamedTuple, TypeAlias

import numpy as np

from carom.impacts.joined_curves import Point, Segment

Node: TypeAlias = tuple[int, int]  # where lines cross, in smallest cells
Cell: TypeAlias = tuple[int, int, int]  # its lower left node, and its side in smallest cells
Line: TypeAlias = tuple[int, int]  # 0 along x or 1 along y, and its place in smallest cells
Edge: TypeAlias = tuple[Line, int, int]  # from one place on a line to another

WHOLE = 64  # a cell of the grid, in smallest cells


class Change(NamedTuple):
    """Where the label changes along the outline of a cell, anticlockwise, and on which side."""

    place: Point
    before: int
    after: int
    side: int


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
