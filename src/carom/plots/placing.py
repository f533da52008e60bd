"""Where labels of a map's regions go: inside, or in free room at the end of a leader line."""

from itertools import pairwise
from typing import NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw
from scipy.ndimage import distance_transform_edt

from carom.plots.regions import Region
from carom.quantities.arrays import Array

Mask: TypeAlias = NDArray[np.bool_]

PIXEL, PIXELS = 0.25, 700  # mm, and how many across a large map
ROOM = (3.0, 2.0, 1.2, 0.7, 0.3)  # around a label in its region, in mm: the widest that there is
APART = 0.6  # of other labels, in mm
LEADER = 2.5  # shortest leader line, in mm
LONGEST = 0.25  # leader line, in widths of the map
GRAIN = 48  # points along a region for its middle
STRIDE = 8  # between places for labels with a leader line, in pixels
ON_BORDER = 3.0  # by how much more a leader line costs where it is on a border
BY_OTHER, CLOSE = 6.0, 0.9  # the same for a line that is close to where another begins, in mm


class Block(NamedTuple):
    """A text on some lines, width and height in mm, upright or turned by a right angle."""

    text: str
    width: float
    height: float
    turned: bool = False

    @property
    def size(self) -> tuple[float, float]:
        """Width and height as it lies."""
        return (self.height, self.width) if self.turned else (self.width, self.height)


class Placed(NamedTuple):
    """A label, the place of its middle, and its leader line from the region on, (2, 2), in mm."""

    block: Block
    at: Array
    line: Array | None = None


class Spot(NamedTuple):
    """A place for a label with a leader line: its middle and the end of the line, in mm."""

    cost: float
    block: Block
    at: Array
    end: Array


class Middle(NamedTuple):
    """The point of a region that is farthest from its outline, and twice how far, in mm."""

    at: Array
    width: float


def middle(region: Region, to_mm: Array) -> Middle:
    """Return the middle of a region whose coordinates are multiplied and shifted to be mm."""
    outline = region.rings[0]
    low, high = outline.min(axis=0), outline.max(axis=0)
    shares = (np.arange(GRAIN) + 0.5) / GRAIN
    x, y = (low[k] + (high[k] - low[k]) * shares for k in (0, 1))
    points = np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2)
    inside = np.pad(region.holds(points).reshape(GRAIN, GRAIN), 1)
    steps = (high - low) * to_mm[0] / GRAIN
    depth = distance_transform_edt(inside, sampling=steps[::-1])[1:-1, 1:-1]
    best = points[depth.argmax()] * to_mm[0] + to_mm[1]
    return Middle(best, max(0.0, float(2.0 * depth.max() - steps.min())))


class Sheet:
    """A map in pixels: which region is where, and where labels and their lines are."""

    def __init__(self, regions: list[Region], to_mm: Array, size: tuple[float, float]) -> None:
        self.pixel = max(PIXEL, size[0] / PIXELS)
        self.shape = int(size[1] / self.pixel), int(size[0] / self.pixel)
        image = Image.new("I", (self.shape[1], self.shape[0]), -1)
        draw = ImageDraw.Draw(image)
        for number, region in enumerate(regions):  # the largest first: holes are drawn over
            points = (region.rings[0] * to_mm[0] + to_mm[1]) / self.pixel - 0.5
            draw.polygon([tuple(point) for point in points.tolist()], fill=number)
        self.owner = np.asarray(image)
        change = np.zeros(self.shape, dtype=np.bool_)
        across, up = (np.diff(self.owner, axis=axis) != 0 for axis in (1, 0))
        change[:, 1:] |= across
        change[:, :-1] |= across
        change[1:] |= up
        change[:-1] |= up
        change[[0, -1]] = change[:, [0, -1]] = True
        self.lines, self.busy = change, np.zeros(self.shape, dtype=np.bool_)

    def keep_off(self, points: Array) -> None:
        """Keep labels off a line through points in mm."""
        for start, end in pairwise(points):
            rows, columns = self._along(start, end)
            self.lines[rows, columns] = True

    def inside(self, number: int, blocks: list[Block]) -> Placed | None:
        """Place the first of some blocks that fits into a region, as far inside as may be."""
        own = self.owner == number
        if not own.any():
            return None
        rows, columns = (np.flatnonzero(own.any(axis=k)) for k in (1, 0))
        window = slice(rows[0], rows[-1] + 1), slice(columns[0], columns[-1] + 1)
        free = own[window] & ~self.lines[window] & ~self.busy[window]
        sums, heart = _sums(free), np.argwhere(own[window]).mean(axis=0)
        for block in blocks:
            for room in ROOM:
                places = _free(sums, block, room, self.pixel)
                if len(places):
                    nearest = places[np.sum((places - heart) ** 2, axis=1).argmin()]
                    return self._put(block, nearest + np.array([rows[0], columns[0]]))
        return None

    def spots(
        self, number: int, anchors: list[Array], blocks: list[Block], most: int
    ) -> list[Spot]:
        """Return places for a label in free room, the best first, with lines to its anchor.

        The lines are short, cross few borders, and keep away from the anchors of other labels.
        """
        found, anchor, sums = [], anchors[number], _sums(~self.lines & ~self.busy)
        others = np.array([*anchors[:number], *anchors[number + 1 :]]).reshape(-1, 2)
        for block in blocks:
            half = 0.5 * np.array(block.size)
            places = _free(sums, block, APART, self.pixel)
            centres = (places[np.all(places % STRIDE == 0, axis=1)][:, ::-1] + 0.5) * self.pixel
            ends = np.clip(anchor, centres - half, centres + half)
            away = np.hypot(*(ends - anchor).T)
            near = np.argsort(np.where(away < LEADER, np.inf, away))[: 2 * most]
            near = near[
                (away[near] >= LEADER) & (away[near] <= LONGEST * self.pixel * self.shape[1])
            ]
            lines = self._along(anchor, ends[near])
            costs = away[near] * (1.0 + ON_BORDER * self.lines[lines].mean(axis=-1))
            costs += BY_OTHER * np.sum(_distances(others, anchor, ends[near]) < CLOSE, axis=-1)
            clear = np.logical_not(self.busy[lines].any(axis=-1))
            found += [
                Spot(float(costs[i]), block, centres[k], ends[k])
                for i, k in enumerate(near.tolist())
                if clear[i]
            ]
        return sorted(found, key=lambda spot: spot.cost)[:most]

    def _put(self, block: Block, place: NDArray[np.int64]) -> Placed:
        wide, high = (int(np.ceil((0.5 * side + 0.5 * APART) / self.pixel)) for side in block.size)
        row, column = place.tolist()
        self.busy[
            max(0, row - high) : row + high + 1, max(0, column - wide) : column + wide + 1
        ] = 1
        return Placed(block, np.array([column + 0.5, row + 0.5]) * self.pixel)

    def _along(self, start: Array, ends: Array) -> tuple[NDArray[np.int64], ...]:
        """Return rows and columns of the pixels of straight lines, to one end or many."""
        length = np.hypot(*np.moveaxis(ends - start, -1, 0)).max(initial=0.0)
        shares = np.linspace(0.0, 1.0, int(length / (0.7 * self.pixel)) + 2)[:, np.newaxis]
        lines = (start + shares * (ends[..., np.newaxis, :] - start)) / self.pixel
        columns, rows = np.moveaxis(lines.astype(np.int64), -1, 0)
        return np.clip(rows, 0, self.shape[0] - 1), np.clip(columns, 0, self.shape[1] - 1)


def _distances(points: Array, start: Array, ends: Array) -> Array:
    """Return the distances of points from straight lines to many ends, shape (ends, points)."""
    along, out = (ends - start)[:, np.newaxis], points - start
    shares = np.sum(along * out, axis=-1) / np.sum(along * along, axis=-1)
    nearest = np.clip(shares, 0.0, 1.0)[..., np.newaxis] * along
    return np.asarray(np.hypot(*np.moveaxis(out - nearest, -1, 0)))


def _sums(mask: Mask) -> NDArray[np.int64]:
    """Return how many pixels of a mask are above and left of each corner of a pixel."""
    sums = np.zeros((mask.shape[0] + 1, mask.shape[1] + 1), dtype=np.int64)
    sums[1:, 1:] = mask.cumsum(axis=0).cumsum(axis=1)
    return sums


def _free(sums: NDArray[np.int64], block: Block, room: float, pixel: float) -> NDArray[np.int64]:
    """Return the pixels around which a block fits into a mask, by its sums."""
    wide, high = (int(np.ceil((side + 2.0 * room) / pixel)) for side in block.size)
    if wide >= sums.shape[1] or high >= sums.shape[0]:
        return np.empty((0, 2), dtype=np.int64)
    inner = sums[high:, wide:] - sums[:-high, wide:] - sums[high:, :-wide] + sums[:-high, :-wide]
    return np.asarray(np.argwhere(inner == wide * high) + np.array([high // 2, wide // 2]))
