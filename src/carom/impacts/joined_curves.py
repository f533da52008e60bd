"""Straight pieces of borders joined into curves."""

from collections import defaultdict
from collections.abc import Iterable, Iterator
from typing import NamedTuple, TypeAlias

import numpy as np

from carom.quantities.arrays import Array

Point: TypeAlias = tuple[float, float]


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
