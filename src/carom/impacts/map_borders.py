"""The regions of a map of psi_1 and chi and the borders between them, as variables of its dataset.

An image of sequences, finer than the map, is solved where they differ; contourpy outlines its
regions, and bisection finds where outlines cross lines of the image.
"""

from collections.abc import Callable, Iterator
from itertools import groupby
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from scipy.ndimage import distance_transform_edt, label, maximum_filter, minimum_filter

from carom.impacts.sequences import Sequences
from carom.io.progress import Progress, advancing
from carom.plots.outlines import (
    JUNCTION,
    KEPT,
    MEETING,
    RIM,
    Labels,
    Ring,
    changes,
    lattice,
    outlines,
)
from carom.quantities.arrays import Array

Tell: TypeAlias = Callable[[Array, Array], Labels]

FINER = 4.0  # than the tolerance: brackets of borders, which may be slanted
SHARE = 0.49  # of the way to the next line: halfway, where values may be special


class Fineness(NamedTuple):
    """How fine borders are: lines of the image, those with points, the error of these.

    Pieces of regions with fewer points than `smallest` are left out: beads of narrow strips.
    """

    columns: int
    rows: int
    smallest: int
    every: int
    tolerance: float


ELASTIC = Fineness(480, 240, 24, 4, 1e-6)
LOSSY = Fineness(100, 60, 12, 4, 1e-3)  # such an impact takes a hundred times as long


def border_variables(
    psi: Array, chi: Array, numbers: Labels, sequences: Sequences, progress: Progress
) -> dict[str, Any]:
    """Return the borders on a map whose sequences have these numbers, shape (chi, psi)."""
    (x, columns), (y, rows) = (np.unique(line, return_index=True) for line in (psi, chi))
    fineness = ELASTIC if sequences.losses is None else LOSSY
    shown = False if callable(progress) else progress  # which counts the rows of the map
    rings: list[Ring] = []
    if min(x.size, y.size) > 1:
        with advancing(
            "finding the borders of the regimes", None, shown, unit="impacts"
        ) as advance:

            def tell(psis: Array, chis: Array) -> Labels:
                advance(psis.size)
                return sequences.of(psis, chis)

            with np.errstate(over="ignore", invalid="ignore"):  # values out of all proportion
                x, y, labels = refined(x, y, numbers[np.ix_(rows, columns)], tell, fineness)
                rings += outlines(labels, *bisected(lattice(x, y), labels, tell, fineness))
    names = np.array(sequences.names, dtype=np.str_)
    borders = [border for ring in rings for border in _borders(ring)]
    sides = np.array([border[:2] for border in borders], dtype=np.int64).reshape(-1, 2)
    side = "sequence of phases on the {} of a border, in the direction of its points"
    return {
        **_points("border", [points for _, _, points in borders]),
        "border_left": ("border_curve", names[sides[:, 0]], {"long_name": side.format("left")}),
        "border_right": ("border_curve", names[sides[:, 1]], {"long_name": side.format("right")}),
        "border_tolerance": fineness.tolerance,
        **_points("outline", [ring.points for ring in rings]),
        "outline_region": ("outline", np.array([r.region for r in rings], dtype=np.int32)),
        "outline_sequence": (
            "outline",
            names[[ring.label for ring in rings]],
            {"long_name": "sequence of phases in the region of an outline"},
        ),
    }


def _points(kind: str, lines: list[Array]) -> dict[str, Any]:
    points = np.concatenate([np.empty((0, 2)), *lines])
    belongs = np.repeat(np.arange(len(lines), dtype=np.int32), [len(line) for line in lines])
    values = {"psi": points[:, 0], "chi": points[:, 1], "number": belongs}
    return {f"{kind}_{name}": (f"{kind}_point", line) for name, line in values.items()}


def _borders(ring: Ring) -> Iterator[tuple[int, int, Array]]:
    """Yield the parts of an outline along one other region, each from one of its two sides only."""
    cuts = np.flatnonzero(np.isin(ring.beyond, (RIM, JUNCTION)))
    turned = np.roll(np.arange(len(ring.points)), -cuts[0] if cuts.size else 0)
    turned = np.append(turned, turned[0])
    for beyond, run in groupby(range(len(turned)), lambda k: int(ring.beyond[turned[k]])):
        places = list(run)
        if beyond > ring.label:
            first, last = places[0], places[-1]
            first -= first > 0 and ring.beyond[turned[first - 1]] == JUNCTION
            last += last + 1 < len(turned) and ring.beyond[turned[last + 1]] == JUNCTION
            yield ring.label, beyond, ring.points[turned[first : last + 1]]


def refined(
    x: Array, y: Array, labels: Labels, tell: Tell, fineness: Fineness
) -> tuple[Array, Array, Labels]:
    """Return a finer image than a map; of its new points those are solved that are near borders.

    The others have the label that is all around them.
    """
    lines, solved = [x, y], np.ones(labels.shape, dtype=np.bool_)
    while lines[0].size < fineness.columns or lines[1].size < fineness.rows:
        for k in (k for k in (0, 1) if lines[k].size < fineness[k]):
            old, new = np.divmod(np.arange(2 * lines[k].size - 1), 2)
            lines[k] = np.interp(old + SHARE * new, np.arange(lines[k].size), lines[k])
            labels, solved = labels.take(old, 1 - k), solved.take(old, 1 - k)
            np.moveaxis(solved, 1 - k, 0)[1::2] = False
        while True:
            mixed = maximum_filter(labels, 3) != minimum_filter(labels, 3)
            row, column = np.nonzero(mixed & ~solved)
            if not row.size:
                break
            labels[row, column] = tell(lines[0][column], lines[1][row])
            solved[row, column] = True
    return lines[0], lines[1], without_specks(labels, fineness.smallest)


def without_specks(labels: Labels, smallest: int) -> Labels:
    """Return labels with those of what is around them where pieces of a region have few points.

    The largest piece of each region stays.
    """
    specks = np.zeros(labels.shape, dtype=np.bool_)
    for each in np.unique(labels):
        pieces, _ = label(labels == each, np.ones((3, 3)))
        sizes = np.bincount(pieces.ravel())
        specks |= (pieces > 0) & (sizes[pieces] < min(smallest, sizes[1:].max()))
    rows, columns = distance_transform_edt(specks, return_distances=False, return_indices=True)
    return np.asarray(labels[rows, columns])


def bisected(places: Array, labels: Labels, tell: Tell, fineness: Fineness) -> tuple[Array, Labels]:
    """Return a lattice with the places of borders on some lines and all around junctions.

    Also which of its places these are, for `outlines`.
    """
    count, step = changes(labels), 2 * fineness.every
    kept = maximum_filter(count > 2, 3).astype(np.int64)
    kept[::step] = kept[:, ::step] = kept[-1] = kept[:, -1] = KEPT
    row, column = np.nonzero((kept == KEPT) & (count == 1))
    low, high = (
        places[row - row % 2, column - column % 2],
        places[row + row % 2, column + column % 2],
    )
    before, after = labels[row // 2, column // 2], labels[(row + 1) // 2, (column + 1) // 2]
    other, least = after.copy(), fineness.tolerance / FINER
    while True:
        wide = np.any(high - low > least * np.maximum(1.0, np.abs(low)), axis=1)
        if not wide.any():
            break
        middle = 0.5 * (low[wide] + high[wide])
        met = tell(*middle.T)
        same = met == before[wide]
        low[wide] = np.where(same[:, np.newaxis], middle, low[wide])
        high[wide] = np.where(same[:, np.newaxis], high[wide], middle)
        other[wide] = np.where(same, other[wide], met)
    places[row, column] = 0.5 * (low + high)
    kept[row, column] = np.where(other == after, KEPT, MEETING)  # a third region between
    return places, kept
