"""The regions of a map of psi_1 and chi and the borders between them, as variables of its dataset.

An image of sequences, finer than the map where three regions meet, is solved where they differ;
contourpy outlines its regions, and bisection finds where outlines cross lines of the image.
"""

from collections.abc import Callable, Iterator
from itertools import groupby
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from scipy.ndimage import distance_transform_edt, label

from carom.impacts.sequences import Sequences
from carom.io.progress import Progress, advancing
from carom.plots import outlines
from carom.plots.outlines import KEPT, MEETING, RIM, Labels, Ring
from carom.quantities.arrays import Array

Tell: TypeAlias = Callable[[Array, Array], Labels]

FINER = 2.0  # than the tolerance: brackets of borders, which may be slanted
OFF_LINE = 0.49  # of the way to the next line: halfway, where values may be special
INSET = 0.2  # of the tolerance: how far within the map its image ends
ENOUGH_LINES = 40  # lines on which borders are found


class Fineness(NamedTuple):
    """Lines of an image along either axis, `closest` where regions meet, `smallest` piece kept."""

    lines: tuple[int, int]
    closest: float
    smallest: int
    tolerance: float


ELASTIC = Fineness((48, 30), 1e-3, 24, 1e-6)
LOSSY = Fineness((30, 20), 1e-3, 12, 1e-3)  # such an impact takes a hundred times as long


def border_variables(
    psi: Array, chi: Array, numbers: Labels, sequences: Sequences, progress: Progress
) -> dict[str, Any]:
    """Return the borders on a map whose sequences have these numbers, shape (chi, psi)."""
    (x, columns), (y, rows) = (np.unique(line, return_index=True) for line in (psi, chi))
    fineness = ELASTIC if sequences.losses is None else LOSSY
    shown = False if callable(progress) else progress  # which counts the rows of the map
    rings: list[Ring] = []
    if min(x.size, y.size) > 1:
        what = "finding the borders of the regimes"
        with advancing(what, None, shown, unit="impacts") as advance:

            def tell(psis: Array, chis: Array) -> Labels:
                advance(psis.size)
                return sequences.of(psis, chis)

            with np.errstate(over="ignore", invalid="ignore"):  # values out of all proportion
                image = Image(x, y, numbers[np.ix_(rows, columns)], tell)
                image.move_sides(INSET * fineness.tolerance)
                image.refine(fineness)
                places, kept = bisected(image, fineness.tolerance)
                places[:, [0, -1], 0], places[[0, -1], :, 1] = x[[0, -1]], y[[0, -1], np.newaxis]
                rings += outlines.outlines(image.labels, places, kept)
    names = np.array(sequences.names, dtype=np.str_)
    borders = [border for ring in rings for border in _borders(ring)]
    sides = np.array([border[:2] for border in borders], dtype=np.int64).reshape(-1, 2)
    inside = {"long_name": "sequence of phases in the region of an outline"}
    side = "sequence of phases on the {} of a border, in the direction of its points"
    return {
        **_points("border", [points for _, _, points in borders]),
        "border_left": ("border_curve", names[sides[:, 0]], {"long_name": side.format("left")}),
        "border_right": ("border_curve", names[sides[:, 1]], {"long_name": side.format("right")}),
        "border_tolerance": fineness.tolerance,
        **_points("outline", [ring.points for ring in rings]),
        "outline_region": ("outline", np.array([r.region for r in rings], dtype=np.int32)),
        "outline_sequence": ("outline", names[[ring.label for ring in rings]], inside),
    }


def _points(kind: str, lines: list[Array]) -> dict[str, Any]:
    points = np.concatenate([np.empty((0, 2)), *lines])
    belongs = np.repeat(np.arange(len(lines), dtype=np.int32), [len(line) for line in lines])
    values = {"psi": points[:, 0], "chi": points[:, 1], "number": belongs}
    return {f"{kind}_{name}": (f"{kind}_point", line) for name, line in values.items()}


def _borders(ring: Ring) -> Iterator[tuple[int, int, Array]]:
    """Yield the parts of an outline along one other region, each from one of its two sides only."""
    cuts = np.flatnonzero(np.isin(ring.beyond, (RIM, outlines.JUNCTION)))
    turned = np.roll(np.arange(len(ring.points)), -cuts[0] if cuts.size else 0)
    turned = np.append(turned, turned[0])
    for beyond, run in groupby(range(len(turned)), lambda k: int(ring.beyond[turned[k]])):
        places = list(run)
        if beyond > ring.label:
            first, last = places[0], places[-1]
            first -= first > 0 and ring.beyond[turned[first - 1]] == outlines.JUNCTION
            last += last + 1 < len(turned) and ring.beyond[turned[last + 1]] == outlines.JUNCTION
            yield ring.label, beyond, ring.points[turned[first : last + 1]]


class Image:
    """Labels at columns x and rows y, solved where they differ, else those of the point before."""

    def __init__(self, x: Array, y: Array, labels: Labels, tell: Tell) -> None:
        self.lines, self.labels, self.tell = [x.copy(), y.copy()], labels, tell
        self.solved = np.ones(labels.shape, dtype=np.bool_)
        self.whole = [np.arange(n) % max(1, n // ENOUGH_LINES) == 0 for n in (x.size, y.size)]

    def move_sides(self, share: float) -> None:
        """Move the outer lines inside by a share: at psi_1 = 0, or chi = 1/2, all sticks."""
        for line in self.lines:
            line[[0, -1]] += share * (line[[-1, 0]] - line[[0, -1]])
        x, y = np.meshgrid(*self.lines)
        for side in (np.s_[0], np.s_[-1], np.s_[:, 0], np.s_[:, -1]):
            self.labels[side] = self.tell(x[side], y[side])

    def refine(self, fineness: Fineness) -> None:
        """Insert lines everywhere until there are enough, then more where three regions meet."""
        least = [fineness.closest * np.ptp(line) for line in self.lines]
        while True:
            gaps = [np.diff(line) for line in self.lines]
            meeting = outlines.changes(self.labels) > 2
            few = [self.lines[k].size < fineness.lines[k] for k in (0, 1)]
            fill = [np.full(gaps[k].size, few[k]) for k in (0, 1)]
            if not any(few):
                fill = [meeting[1::2, 1::2].any(axis=k) & (gaps[k] > least[k]) for k in (0, 1)]
            if not any(part.any() for part in fill):
                break
            for k in (0, 1):
                new = self.lines[k][:-1] + OFF_LINE * gaps[k]
                self.insert(k, new[fill[k]], whole=any(few))
            self.solve()
        labels = without_specks(self.labels, fineness.smallest)
        self.solved &= labels == self.labels
        self.labels = labels

    def insert(self, k: int, places: Array, whole: bool) -> None:
        """Insert columns or rows with the labels of those before them."""
        at = np.searchsorted(self.lines[k], places)
        self.lines[k] = np.insert(self.lines[k], at, places)
        self.labels = np.insert(self.labels, at, self.labels.take(at - 1, 1 - k), 1 - k)
        self.solved = np.insert(self.solved, at, False, 1 - k)
        self.whole[k] = np.insert(self.whole[k], at, whole)

    def kept(self) -> tuple[Labels, Labels]:
        """Return on how many edges labels change, and which of it outlines keep."""
        count = outlines.changes(self.labels)
        kept = np.zeros_like(count)
        for i, j in np.ndindex(3, 3):
            kept[i : i - 2 or None : 2, j : j - 2 or None : 2][count[1::2, 1::2] > 2] = KEPT
        kept[::2][self.whole[1]] = kept[:, ::2][:, self.whole[0]] = KEPT
        return count, kept

    def solve(self) -> None:
        """Solve points until all are that borders lie between where outlines keep these."""
        while True:
            count, kept = self.kept()
            edges = (kept > 0) & (count > 0)
            ends = np.zeros_like(self.solved)
            for part, edge in ((ends, edges[::2, 1::2]), (ends.T, edges[1::2, ::2].T)):
                part[:, :-1] |= edge
                part[:, 1:] |= edge
            row, column = np.nonzero(ends & ~self.solved)
            if not row.size:
                break
            self.labels[row, column] = self.tell(self.lines[0][column], self.lines[1][row])
            self.solved[row, column] = True


def without_specks(labels: Labels, smallest: int) -> Labels:
    """Return labels without small pieces of regions, but with the largest piece of each."""
    specks = np.zeros(labels.shape, dtype=np.bool_)
    for each in np.unique(labels):
        pieces, _ = label(labels == each, np.ones((3, 3)))
        sizes = np.bincount(pieces.ravel())
        specks |= (pieces > 0) & (sizes[pieces] < min(smallest, sizes[1:].max()))
    rows, columns = distance_transform_edt(specks, return_distances=False, return_indices=True)
    return np.asarray(labels[rows, columns])


def bisected(image: Image, tolerance: float) -> tuple[Array, Labels]:
    """Return a lattice with the places of borders, and which those are, for `outlines`."""
    labels, places, (count, kept) = image.labels, outlines.lattice(*image.lines), image.kept()
    row, column = np.nonzero((kept == KEPT) & (count == 1))
    low = places[row - row % 2, column - column % 2]
    high = places[row + row % 2, column + column % 2]
    before, after = labels[row // 2, column // 2], labels[(row + 1) // 2, (column + 1) // 2]
    sides, least = [before, after], tolerance / FINER
    while True:
        wide = np.flatnonzero(np.any(high - low > least * np.maximum(1.0, np.abs(low)), axis=1))
        if not wide.size:
            break
        middle = 0.5 * (low[wide] + high[wide])
        met = image.tell(*middle.T)
        same = met == sides[0][wide]
        third = ~same & (met != sides[1][wide])  # which may hide others, so as to meet them too
        low = np.concatenate([low, middle[third]])
        high = np.concatenate([high, high[wide][third]])
        sides = [
            np.concatenate([sides[0], met[third]]),
            np.concatenate([sides[1], sides[1][wide][third]]),
        ]
        low[wide] = np.where(same[:, np.newaxis], middle, low[wide])
        high[wide] = np.where(same[:, np.newaxis], high[wide], middle)
        sides[1][wide] = np.where(same, sides[1][wide], met)
    places[row, column] = 0.5 * (low + high)[: row.size]
    other = sides[1][: row.size]
    sure = image.solved[row // 2, column // 2] & image.solved[(row + 1) // 2, (column + 1) // 2]
    kept[row, column] = np.where(sure & (other == after), KEPT, MEETING)  # a third region between
    return places, kept
