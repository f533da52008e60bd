"""Outlines of the regions of an image of labels, by contourpy.

Its lattice is the points of the image and all that is halfway between them: middles of edges, at
even rows or columns, and of cells. Outlines go through edges; where an edge is crossed may be known
better than by its middle.
"""

from collections.abc import Iterator
from itertools import pairwise
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from contourpy import FillType, contour_generator
from numpy.typing import NDArray
from scipy.ndimage import find_objects

from carom.quantities.arrays import Array

Labels: TypeAlias = NDArray[np.int64]
RIM, JUNCTION = -1, -2  # what lies beyond the image, and where more than two labels meet
KEPT, MEETING = 1, 2  # places of a lattice that outlines go through; where a third label is near


class Ring(NamedTuple):
    """A line around a region, anticlockwise, or a hole; `beyond` are labels, RIM or JUNCTION."""

    label: int
    region: int
    points: Array
    beyond: Labels


def lattice(x: Array, y: Array) -> Array:
    """Return the lattice of an image with these columns and rows, shape (rows, columns, 2)."""
    lines = (np.interp(0.5 * np.arange(2 * a.size - 1), np.arange(a.size), a) for a in (x, y))
    return np.stack(np.meshgrid(*lines), axis=-1)


def changes(labels: Labels) -> Labels:
    """Return on how many edges labels change, for each edge and around each cell of the lattice."""
    count = np.zeros([2 * side - 1 for side in labels.shape], dtype=np.int64)
    count[::2, 1::2], count[1::2, ::2] = (np.diff(labels, axis=k) != 0 for k in (1, 0))
    count[1::2, 1::2] = _around(count)
    return count


def _around(values: Any) -> Any:
    """Return the sums of values on the four edges of every cell."""
    beside = values[1::2, :-1:2] + values[1::2, 2::2]
    return values[:-1:2, 1::2] + values[2::2, 1::2] + beside


def outlines(labels: Labels, places: Array, kept: Labels | None = None) -> Iterator[Ring]:
    """Yield outlines of regions, each with its holes, through places KEPT or MEETING, or all."""
    count = changes(labels)
    places, kept = places.copy(), np.full(count.shape, KEPT) if kept is None else kept
    cells = count[1::2, 1::2]
    crossed = places * (count == 1)[..., np.newaxis]
    places[1::2, 1::2] = _around(crossed) / np.maximum(cells, 1)[..., np.newaxis]
    image, region = _Padded(labels, places, kept, count), 0
    for label, window in enumerate(find_objects(image.labels + 1)):
        if window is None:
            continue
        rows, columns = (slice(part.start - 1, part.stop + 1) for part in window)
        inside = image.labels[rows, columns] == label
        contours = contour_generator(z=inside.astype(float), fill_type=FillType.OuterOffset)
        for points, offsets in zip(*contours.filled(0.5, 2.0), strict=True):
            for start, end in pairwise(offsets):
                line = 2.0 * (points[start : end - 1] + np.array([columns.start, rows.start]))
                ring = Ring(label, region, *image.located(label, line.astype(np.int64)))
                if len(ring.points) > 2:
                    yield ring
            region += 1


class _Padded:
    """An image with RIM around it, and its lattice with what is kept of it and where many meet."""

    def __init__(self, labels: Labels, places: Array, kept: Labels, count: Labels) -> None:
        self.labels = np.pad(labels, 1, constant_values=RIM)
        self.places = np.pad(places, ((2, 2), (2, 2), (0, 0)), mode="edge")
        self.kept, self.many = np.pad(kept, 2), np.pad(count > 2, 2)
        self.kept[np.ix_((1, -2), (2, -3))] = KEPT  # the corners

    def located(self, label: int, line: NDArray[np.int64]) -> tuple[Array, Labels]:
        """Return a line of the lattice at its places, and what lies beyond it."""
        (i, j), (low, high) = line.T, (line // 2, (line + 1) // 2)
        beyond = self.labels[low[:, 1], low[:, 0]] + self.labels[high[:, 1], high[:, 0]] - label
        beyond[self.kept[j, i] == MEETING], rim = JUNCTION, beyond == RIM
        kept = (self.kept[j, i] > 0) | (rim & ~(np.roll(rim, 1) & np.roll(rim, -1)))
        column, row = ((line + np.roll(line, -1, axis=0)) // 2 | 1).T  # of the cells between
        after = np.flatnonzero(self.many[row, column])
        middles = self.places[row[after], column[after]]
        points = np.insert(self.places[j, i], after + 1, middles, axis=0)
        beyond = np.insert(beyond, after + 1, JUNCTION)
        kept = np.insert(kept, after + 1, True)
        return points[kept], beyond[kept]
