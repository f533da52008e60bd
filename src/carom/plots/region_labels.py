"""Labels of a map's regions: sequences of phases in letters, and where each of them goes."""

from itertools import pairwise
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw
from scipy.ndimage import distance_transform_edt, find_objects, maximum_filter, minimum_filter

from carom.plots.bands import MINUS
from carom.plots.legends import font_size, text_width
from carom.plots.regions import Region
from carom.quantities.arrays import Array

Mask: TypeAlias = NDArray[np.bool_]

PIXEL, PIXELS = 0.15, 1000  # mm, and how many across a large map
SMALLEST = 0.2  # width in mm of a region that has a label
APART = 0.8  # of labels and of what is around them, in mm
LEADER, LONGEST = 2.5, 40.0  # leader lines, in mm
STRIDE = 5  # of the places for a label with a leader line, of which each is tried
DOT = 4  # pixels around the beginning of a leader line, which others keep clear of
FEW = 16  # leader lines that have sequences at their ends; more have numbers
CENTRAL = 0.25  # of the distance from the middle of a region, against that from its edge
PITCH = 1.2  # of lines of text, in sizes of the font
MM = 25.4 / 72.0  # a point
LETTERS = {"gross slip": "G", "stick": "S", "slip": "s"}


class Block(NamedTuple):
    """A text on some lines, width and height in mm, upright or turned by a right angle."""

    text: str
    width: float
    height: float
    turned: bool = False


class Label(NamedTuple):
    """A label, the place of its middle, and where its leader line begins, if it has one, in mm."""

    block: Block
    at: Array
    start: Array | None = None


class Labels(NamedTuple):
    """Labels by the number of their region, what numbers mean, and what is not marked, and why."""

    placed: dict[int, Label]
    numbered: list[str]
    narrow: list[str]
    lost: list[str]


def signed(name: str) -> str:
    """Return a text with true minus signs."""
    return name.replace("-", MINUS)


def in_letters(name: str) -> list[str]:
    """Return the phases of a sequence in letters, with their sense of slip."""
    for words, letter in LETTERS.items():
        name = name.replace(words, letter)
    return signed(name).replace(" +", "+").replace(f" {MINUS}", MINUS).split(", ")


def find_labels(
    regions: list[Region], lines: list[Array], to_mm: Array, size: tuple[float, float]
) -> Labels:
    """Return where the labels of regions go on a map of a size in mm, clear of some lines.

    Inside their region, else at the end of a leader line. Where there is no room for the sequence,
    a number takes its place.
    """
    sheet = Sheet(regions, to_mm, size)
    for line in lines:
        sheet.keep_off(line * to_mm[0] + to_mm[1])
    names, poles = [region.name for region in regions], [sheet.pole(n) for n in range(len(regions))]
    wide = [
        n
        for n, (pole, width) in enumerate(poles)
        if width >= SMALLEST and regions[n].holds([(pole - to_mm[1]) / to_mm[0]])[0]
    ]
    blocks = {n: _blocks(names[n]) for n in wide}
    placed = {n: sheet.inside(n, blocks[n]) for n in wide}
    outside = sorted((n for n in wide if not placed[n]), key=lambda n: -poles[n][0][1])
    for n in outside:
        sheet.keep_lines_off(poles[n][0])
    few, numbered = len(outside) <= FEW, list[str]()
    for n in outside:
        label = sheet.beside(poles[n][0], blocks[n][:2]) if few else None
        if not label:
            number = numbered.index(names[n]) if names[n] in numbered else len(numbered)
            short = [_block([str(number + 1)])]
            label = sheet.inside(n, short) or sheet.beside(poles[n][0], short)
            numbered += [names[n]] if label and number == len(numbered) else []
        placed[n] = label
    seen = {names[n] for n in wide}
    narrow = [name for name in names if name not in seen]
    lost = [names[n] for n in wide if not placed[n]]
    return Labels({n: label for n, label in placed.items() if label}, numbered, narrow, lost)


def _blocks(name: str) -> list[Block]:
    """Return the ways to write a sequence: on one line, on more, or upwards; the best first."""
    letters = in_letters(name) if name else ["not", "resolved"]
    flat = [
        _block([" ".join(part) for part in np.array_split(letters, lines)])
        for lines in range(1, min(4, len(letters) + 1))
    ]
    upright = [Block(one.text, one.height, one.width, turned=True) for one in flat[:2]]
    return [*flat, *upright]


def _block(lines: list[str]) -> Block:
    height = PITCH * font_size("small") * len(lines)
    return Block("\n".join(lines), MM * max(map(text_width, lines)), MM * height)


class Sheet:
    """A map in pixels: which region is where, and where labels and their lines are."""

    def __init__(self, regions: list[Region], to_mm: Array, size: tuple[float, float]) -> None:
        self.pixel = max(PIXEL, size[0] / PIXELS)
        image = Image.new("I", (int(size[0] / self.pixel), int(size[1] / self.pixel)), -1)
        draw = ImageDraw.Draw(image)
        for number, region in enumerate(regions):  # the largest first: holes are drawn over
            points = (region.rings[0] * to_mm[0] + to_mm[1]) / self.pixel - 0.5
            draw.polygon(points.ravel().tolist(), fill=number)
        self.owner = np.asarray(image)
        self.windows = find_objects(self.owner + 1, len(regions))
        around = (maximum_filter(self.owner, 3), minimum_filter(self.owner, 3))
        self.lines = np.not_equal(*around)
        self.busy = np.zeros(self.owner.shape, dtype=np.bool_)

    def keep_off(self, points: Array) -> None:
        """Keep labels off a line through points in mm."""
        for start, end in pairwise(points):
            self.lines[self._along(start, end)] = True

    def keep_lines_off(self, point: Array) -> None:
        """Keep labels and leader lines off a point in mm, where such a line begins."""
        column, row = (point / self.pixel).astype(int).tolist()
        self.busy[max(0, row - DOT) : row + DOT + 1, max(0, column - DOT) : column + DOT + 1] = True

    def pole(self, number: int) -> tuple[Array, float]:
        """Return the point of a region that is farthest from its edge, and how wide it is there."""
        window = self.windows[number]
        if window is None:
            return np.zeros(2), 0.0
        depth = distance_transform_edt(np.pad(self.owner[window] == number, 1))[1:-1, 1:-1]
        return self._place(window, depth.argmax()), self.pixel * (2.0 * depth.max() - 1.0)

    def inside(self, number: int, blocks: list[Block]) -> Label | None:
        """Place the first of some blocks that fits into a region, where it is farthest inside."""
        window = self.windows[number]
        free = (self.owner[window] == number) & ~self.busy[window] & ~self.lines[window]
        depth = distance_transform_edt(np.pad(free, 1))[1:-1, 1:-1]
        middle = np.argwhere(free).mean(axis=0) if free.any() else np.zeros(2)
        away = np.hypot(*(np.indices(free.shape) - middle[:, np.newaxis, np.newaxis]))
        for block in blocks:
            fits = self._fits(free, block)
            if fits.any():
                best = np.where(fits, depth - CENTRAL * away, -np.inf).argmax()
                return self._put(Label(block, self._place(window, best)))
        return None

    def beside(self, start: Array, blocks: list[Block]) -> Label | None:
        """Place the first block for which there is free room at the end of a short leader line."""
        low = np.maximum(0, (start[::-1] - LONGEST) / self.pixel).astype(int)
        high = ((start[::-1] + LONGEST) / self.pixel).astype(int)
        window = slice(low[0], high[0]), slice(low[1], high[1])
        for block in blocks:
            fits = self._fits(~self.busy[window] & ~self.lines[window], block)
            half = 0.5 * np.array([block.width, block.height])
            places = (np.argwhere(fits)[:, ::-1] + low[::-1] + 0.5) * self.pixel
            ends = np.clip(start, places - half, places + half)
            length = np.hypot(*(ends - start).T)
            near = np.argsort(np.where(length < LEADER, np.inf, length))
            for k in near[: np.sum((length >= LEADER) & (length <= LONGEST)) : STRIDE]:
                line = self._along(start, ends[k])
                if not self.busy[line][3 * DOT :].any():
                    self.busy[line] = self.busy[line[0], line[1] - 1] = True
                    return self._put(Label(block, places[k], start))
        return None

    def _fits(self, free: Mask, block: Block) -> Mask:
        size = [int(np.ceil((side + APART) / self.pixel)) for side in (block.height, block.width)]
        return np.asarray(minimum_filter(free, size, mode="constant", cval=False))

    def _place(self, window: tuple[slice, slice], index: Any) -> Array:
        """Return the place in mm of a pixel that is counted in a window."""
        shape = [part.stop - part.start for part in window]
        row, column = np.unravel_index(index, shape)
        return self.pixel * np.array([window[1].start + column + 0.5, window[0].start + row + 0.5])

    def _put(self, label: Label) -> Label:
        half = 0.5 * np.array([label.block.width, label.block.height]) + 0.5 * APART
        low, high = ((label.at + side) / self.pixel for side in (-half, half))
        column, row = np.maximum(0, low).astype(int)
        self.busy[row : int(high[1]) + 1, column : int(high[0]) + 1] = True
        return label

    def _along(self, start: Array, end: Array) -> tuple[Any, Any]:
        """Return rows and columns of the pixels of a straight line."""
        count = int(np.hypot(*(end - start)) / (0.7 * self.pixel)) + 2
        columns, rows = (np.linspace(start, end, count) / self.pixel).astype(int).T
        return np.clip(rows, 0, self.owner.shape[0] - 1), np.clip(
            columns, 0, self.owner.shape[1] - 1
        )
