"""Regions of a map of regimes: the outlines that its dataset holds, or those of its points."""

from typing import Any, NamedTuple

import numpy as np
from matplotlib.path import Path
from numpy.typing import ArrayLike, NDArray

from carom.plots.outlines import lattice, outlines
from carom.quantities.arrays import Array

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
    read = _stored if dataset.sizes.get("outline") else _of_points
    for number, name, points in read(dataset):
        by_number.setdefault(number, Region(name, [])).rings.append(points)
    return sorted(by_number.values(), key=lambda region: -area(region.rings[0]))


def area(ring: Array) -> float:
    """Return the area within a ring, positive if it goes anticlockwise."""
    x, y = (ring - ring[0]).T
    return float(0.5 * np.sum(x[:-1] * y[1:] - x[1:] * y[:-1]))


def _stored(dataset: Any) -> Any:
    names = dataset["outline_sequence"].values.tolist()
    points = np.column_stack([dataset["outline_psi"].values, dataset["outline_chi"].values])
    rings = np.split(points, np.cumsum(np.bincount(dataset["outline_number"].values))[:-1])
    return zip(dataset["outline_region"].values, names, rings, strict=True)


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
