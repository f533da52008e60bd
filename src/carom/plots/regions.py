"""Regions of a map of regimes: the outlines that its dataset holds, or those of its points."""

from typing import Any, NamedTuple

import numpy as np
from matplotlib.path import Path
from numpy.typing import ArrayLike, NDArray
from scipy.spatial import KDTree

from carom.plots.outlines import changes, lattice, outlines
from carom.quantities.arrays import Array

DENSE, PIXELS = 20, 700  # points on a piece of a border, and how many across a map, of version 0.2
WIDER = 0.05  # by which a map of a single value is wider than nothing


class Region(NamedTuple):
    """Where one sequence of phases holds: an outline, anticlockwise, and those of its holes."""

    name: str
    rings: list[Array]

    def path(self) -> Path:
        rings = (np.concatenate([ring, ring[:1]]) for ring in self.rings)
        return Path.make_compound_path(*(Path(ring, closed=True) for ring in rings))

    def holds(self, points: ArrayLike) -> NDArray[np.bool_]:
        """Tell which points lie in the region: inside an odd number of its rings."""
        inside = np.zeros(len(np.asarray(points)), dtype=np.bool_)
        for ring in self.rings:
            inside ^= Path(ring).contains_points(points)
        return inside


def limits(dataset: Any, name: str) -> tuple[float, float]:
    """Return the ends of an axis of a map; a single value gets some room."""
    values = dataset[name].values
    room = WIDER * max(1.0, abs(values[0])) if values.min() == values.max() else 0.0
    return float(values.min() - room), float(values.max() + room)


def regions(dataset: Any) -> list[Region]:
    """Return the regions of a map of regimes, the largest first."""
    by_number: dict[int, Region] = {}
    read = _of_points
    if dataset.sizes.get("outline"):
        read = _stored
    elif "outline_psi" not in dataset and dataset.sizes.get("border_curve"):
        read = _of_borders
    for number, name, points in read(dataset):
        by_number.setdefault(number, Region(name, [])).rings.append(points)
    return sorted(by_number.values(), key=lambda region: -area(region.rings[0]))


def area(ring: Array) -> float:
    """Return the area within a ring, positive if it goes anticlockwise."""
    x, y = (ring - ring[0]).T
    return float(0.5 * np.sum(x[:-1] * y[1:] - x[1:] * y[:-1]))


def _stored(dataset: Any) -> Any:
    names = dataset["outline_sequence"].values.tolist()
    rings = _lines(dataset, "outline")
    return zip(dataset["outline_region"].values, names, rings, strict=True)


def _lines(dataset: Any, kind: str) -> list[Array]:
    points = np.column_stack([dataset[f"{kind}_psi"].values, dataset[f"{kind}_chi"].values])
    return np.split(points, np.cumsum(np.bincount(dataset[f"{kind}_number"].values))[:-1])


def _of_borders(dataset: Any) -> Any:
    """Return outlines of an image, by the nearest border of a map of version 0.2."""
    low, high = np.transpose([limits(dataset, name) for name in ("psi_in", "chi")])
    lines = [(line - low) / (high - low) for line in _lines(dataset, "border")]
    fine = [np.asarray(Path(line).interpolated(DENSE).vertices) for line in lines]
    points = np.concatenate([0.5 * (line[1:] + line[:-1]) for line in fine])
    along = np.concatenate([np.diff(line, axis=0) for line in fine])
    curve = np.repeat(np.arange(len(fine)), [len(line) - 1 for line in fine])
    sides = [dataset[f"border_{side}"].values for side in ("right", "left")]
    names, codes = np.unique(sides, return_inverse=True)
    nearest, places = KDTree(points), lattice(*np.linspace((0.0, 0.0), (1.0, 1.0), PIXELS).T)
    k = nearest.query(places[::2, ::2])[1]
    (x, y), (u, v) = along[k].T, (places[::2, ::2] - points[k]).T
    left = (x * v - y * u > 0.0).T.astype(np.int64)
    labels = codes.reshape(2, -1)[left, curve[k]]
    crossed = changes(labels) == 1
    crossed[1::2, 1::2] = False
    places[crossed] = points[nearest.query(places[crossed])[1]]
    rings = outlines(labels, places * (high - low) + low)
    return ((ring.region, names[ring.label], ring.points) for ring in rings)


def _of_points(dataset: Any) -> Any:
    """Return outlines halfway between points, of a map without finer ones."""
    dataset = dataset.sortby(["chi", "psi_in"])
    names = ["", *dataset["sequence_name"].values.tolist()]
    labels, axes = dataset["sequence"].values.astype(np.int64) + 1, []
    for k, name in enumerate(("psi_in", "chi")):
        axes.append(dataset[name].values)
        if axes[k].size == 1:
            axes[k], labels = np.array(limits(dataset, name)), np.repeat(labels, 2, axis=1 - k)
    rings = outlines(labels, lattice(*axes))
    return ((ring.region, names[ring.label], ring.points) for ring in rings)
