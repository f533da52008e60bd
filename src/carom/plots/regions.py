"""Regions of a map of regimes: the polygons that its borders and its rim make."""

from collections.abc import Iterator
from itertools import pairwise
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from matplotlib.path import Path
from numpy.typing import NDArray

from carom.quantities.arrays import Array

Point: TypeAlias = tuple[float, float]
WIDER = 0.05  # by which a map of a single value is wider than nothing


class Region(NamedTuple):
    """Where one sequence of phases holds: an outline, anticlockwise, and those of its holes."""

    name: str
    rings: tuple[Array, ...]

    def path(self) -> Path:
        """Return the region as a path to fill."""
        return Path.make_compound_path(*(Path(ring, closed=True) for ring in self.rings))

    def holds(self, points: Array) -> NDArray[np.bool_]:
        """Tell which points lie in the region: inside an odd number of its rings."""
        inside = np.zeros(len(points), dtype=np.bool_)
        for ring in self.rings:
            inside ^= Path(ring).contains_points(points)
        return inside


class Curve(NamedTuple):
    """A border, with the sequences on its left and right."""

    left: str
    right: str
    points: Array


class Frame(NamedTuple):
    """The limits of a map."""

    left: float
    right: float
    bottom: float
    top: float

    @property
    def corners(self) -> Array:
        """The corners, anticlockwise from the lower left."""
        x, y = (self.left, self.right), (self.bottom, self.top)
        return np.array([(x[0], y[0]), (x[1], y[0]), (x[1], y[1]), (x[0], y[1])])

    def along(self, point: Array) -> float | None:
        """Return how far along the rim a point lies, in sides, anticlockwise; None if inside."""
        x, y = point
        across, up = (
            (x - self.left) / (self.right - self.left),
            (y - self.bottom) / (self.top - self.bottom),
        )
        if y == self.bottom:
            return float(across)
        if x == self.right:
            return float(1.0 + up)
        if y == self.top:
            return float(3.0 - across)
        return float(4.0 - up) if x == self.left else None


def frame_of(dataset: Any) -> Frame:
    """Return the limits of a map; a single value gets some room."""
    limits: list[float] = []
    for name in ("psi_in", "chi"):
        values = dataset[name].values
        room = WIDER * max(1.0, abs(values[0])) if values.min() == values.max() else 0.0
        limits += [float(values.min() - room), float(values.max() + room)]
    return Frame(*limits)


def regions(dataset: Any) -> list[Region]:
    """Return the regions of a map of regimes, the largest first."""
    dataset = dataset.sortby(["chi", "psi_in"])
    frame, names = frame_of(dataset), np.array([*dataset["sequence_name"].values.tolist(), ""])
    cells = names[dataset["sequence"].values]
    bordered = "border_psi" in dataset and min(cells.shape) > 1
    curves = list(_stored(dataset) if bordered else _steps(dataset, cells, frame))
    edges: dict[str, dict[Point, list[Array]]] = {name: {} for name in np.unique(cells)}
    for name, line in (*_sides(curves), *_rim(curves, cells, frame)):
        edges.setdefault(str(name), {}).setdefault(tuple(line[0].tolist()), []).append(line)
    found = [region for name in edges for region in _pieces(name, list(_rings(edges[name])))]
    return sorted(found, key=lambda region: -area(region.rings[0]))


def area(ring: Array) -> float:
    """Return the area within a ring, positive if it goes anticlockwise."""
    x, y = (ring - ring[0]).T
    return float(0.5 * np.sum(x[:-1] * y[1:] - x[1:] * y[:-1]))


def _stored(dataset: Any) -> Iterator[Curve]:
    points = np.column_stack([dataset["border_psi"].values, dataset["border_chi"].values])
    ends = np.cumsum(np.bincount(dataset["border_number"].values))[:-1]
    for left, right, line in zip(
        *(dataset[name].values.tolist() for name in ("border_left", "border_right")),
        np.split(points, ends) if len(points) else (),
        strict=True,
    ):
        yield Curve(left, right, line)


def _steps(dataset: Any, cells: NDArray[np.str_], frame: Frame) -> Iterator[Curve]:
    """Yield the edges of cells between which the sequence changes, of a map without borders."""
    x = _between(dataset["psi_in"].values, frame.left, frame.right)
    y = _between(dataset["chi"].values, frame.bottom, frame.top)
    for j, i in np.argwhere(cells[:, 1:] != cells[:, :-1]):
        line = np.array([(x[i + 1], y[j]), (x[i + 1], y[j + 1])])
        yield Curve(str(cells[j, i]), str(cells[j, i + 1]), line)
    for j, i in np.argwhere(cells[1:] != cells[:-1]):
        line = np.array([(x[i], y[j + 1]), (x[i + 1], y[j + 1])])
        yield Curve(str(cells[j + 1, i]), str(cells[j, i]), line)


def _between(centres: Array, low: float, high: float) -> Array:
    return np.concatenate([[low], 0.5 * (centres[1:] + centres[:-1]), [high]])


def _sides(curves: list[Curve]) -> Iterator[tuple[str, Array]]:
    """Yield every curve in the direction in which a sequence is on its left."""
    for curve in curves:
        yield curve.left, curve.points
        yield curve.right, curve.points[::-1]


def _rim(curves: list[Curve], cells: NDArray[np.str_], frame: Frame) -> Iterator[tuple[str, Array]]:
    """Yield the pieces of the rim between curves that end there, with the sequences inside."""
    rows, columns = (0, 0, -1, -1), (0, -1, -1, 0)
    stops = [
        (float(side), corner, str(cells[rows[side], columns[side]]))
        for side, corner in enumerate(frame.corners)
    ]
    for curve in curves:
        if np.array_equal(curve.points[0], curve.points[-1]):
            continue
        for point, after in ((curve.points[0], curve.right), (curve.points[-1], curve.left)):
            place = frame.along(point)
            if place is not None:
                stops.append((place, point, after))
    stops.sort(key=lambda stop: stop[0])
    for (_, start, name), (_, end, _) in pairwise([*stops, stops[0]]):
        if not np.array_equal(start, end):
            yield name, np.array([start, end])


def _rings(following: dict[Point, list[Array]]) -> Iterator[Array]:
    """Yield closed lines that pieces make, each given with where it starts."""
    for start, lines in following.items():
        while lines:
            ring, at = [], start
            while following.get(at):
                line = following[at].pop()
                ring.append(line[:-1])
                at = tuple(line[-1].tolist())
                if at == start:
                    break
            yield np.concatenate([*ring, [start]])


def _pieces(name: str, rings: list[Array]) -> Iterator[Region]:
    """Yield the regions of a sequence that do not touch each other, with their holes."""
    areas = [area(ring) for ring in rings]
    outer = [ring for ring, size in zip(rings, areas, strict=True) if size > 0.0]
    holes: list[list[Array]] = [[] for _ in outer]
    for ring in (ring for ring, size in zip(rings, areas, strict=True) if size < 0.0):
        around = [k for k, one in enumerate(outer) if Path(one).contains_point(ring[0])]
        if around:
            holes[min(around, key=lambda k: area(outer[k]))].append(ring)
    for ring, inside in zip(outer, holes, strict=True):
        yield Region(name, (ring, *inside))
