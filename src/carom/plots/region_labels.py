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
SMALLEST_LABEL = 0.2  # width in mm of a region that has a label
APART = 0.6  # of labels and of what is around them, in mm
LEADER, LONGEST = 2.5, 40.0  # leader lines, in mm
WORDS = LONGEST, 20.0, 10.0, 0.0  # the longest to words, in turn, until each region has a label
SPOTS = 200  # places for a label with a leader line that are compared
ON_BORDER = 3.0  # by how much more a leader line costs where it is on a border
BY_OTHER, CLOSE = 6.0, 0.9  # the same for a line that is close to where another begins, in mm
DOT = 4  # pixels around the beginning of a leader line, which labels keep clear of
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

    @property
    def end(self) -> Array:
        """Where a leader line meets the label."""
        if self.start is None:
            return self.at
        half = 0.5 * np.array([self.block.width, self.block.height])
        return np.clip(self.start, self.at - half, self.at + half)


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
    """Return labels of regions on a map: inside, else on a leader; a number if there is no room."""
    sheet = Sheet(regions, to_mm, size)
    for line in lines:
        sheet.keep_off(line * to_mm[0] + to_mm[1])
    names, poles = [region.name for region in regions], [sheet.pole(n) for n in range(len(regions))]
    wide = [
        n
        for n, (pole, width) in enumerate(poles)
        if width >= SMALLEST_LABEL and regions[n].holds([(pole - to_mm[1]) / to_mm[0]])[0]
    ]
    inside = {n: sheet.inside(n, _blocks(names[n])) for n in wide}
    placed = {n: label for n, label in inside.items() if label}
    for label in placed.values():
        sheet.keep_off_label(label)
    marked = sorted(inside.keys() - placed.keys(), key=lambda n: -poles[n][0][1])
    number = _block(["0" * len(str(len(marked)))])
    placed |= _find_room(sheet, {n: poles[n][0] for n in marked}, names, number)
    short = [n for n in marked if n in placed and placed[n].block == number]
    numbered = list(dict.fromkeys(names[n] for n in short))
    for n in short:
        placed[n] = placed[n]._replace(block=_block([str(numbered.index(names[n]) + 1)]))
    seen = {names[n] for n in wide}
    narrow = [name for name in names if name not in seen]
    return Labels(placed, numbered, narrow, [names[n] for n in wide if n not in placed])


def _find_room(
    sheet: "Sheet", starts: dict[int, Array], names: list[str], number: Block
) -> dict[int, Label]:
    """Return labels for regions too small for their words: those on a short line, or numbers."""
    anchors, busy = np.array([*starts.values()]).reshape(-1, 2), sheet.busy
    sheet.keep_off_starts(anchors)
    best: dict[int, Label] = {}
    for longest in WORDS:
        sheet.busy, labels = busy.copy(), dict[int, Label]()
        for k, n in enumerate(starts):
            label = sheet.beside(anchors, k, _blocks(names[n])[:-1], longest)
            label = label or sheet.inside(n, [number])
            label = label or sheet.beside(anchors, k, [number], LONGEST)
            if label:
                labels[n] = label
                sheet.keep_off_label(label)
        best = max(best, labels, key=len)
        if len(best) == len(starts):
            break
    return best


def _blocks(name: str) -> list[Block]:
    """Return the ways to write a sequence: on one line, on more, or upwards; the best first."""
    letters = in_letters(name) if name else ["not", "resolved"]
    flat = [
        _block([" ".join(part) for part in np.array_split(letters, lines)])
        for lines in range(1, min(4, len(letters) + 1))
    ]
    upright = [Block(one.text, one.height, one.width, turned=True) for one in flat[:1]]
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

    def keep_off_starts(self, anchors: Array) -> None:
        """Keep labels off points in mm, where leader lines begin."""
        for column, row in (anchors / self.pixel).astype(int).tolist():
            self.lines[max(0, row - DOT) : row + DOT, max(0, column - DOT) : column + DOT] = True

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
                return Label(block, self._place(window, best))
        return None

    def beside(self, anchors: Array, k: int, blocks: list[Block], longest: float) -> Label | None:
        """Place one of some blocks in free room on a short leader, off borders, others' anchors."""
        start, others, spots = anchors[k], np.delete(anchors, k, axis=0), []
        for block in blocks:
            half = 0.5 * np.array([block.width, block.height])
            places = self._free_places(block)
            ends = np.clip(start, places - half, places + half)
            length = np.hypot(*(ends - start).T)
            allowed = (length >= LEADER) & (length <= longest)
            for i in np.argsort(np.where(allowed, length, np.inf))[: min(SPOTS, allowed.sum())]:
                line = self._along(start, ends[i])
                if not self.busy[line].any():
                    points = np.column_stack(line[::-1]) * self.pixel
                    close = np.hypot(*(points[:, np.newaxis] - others).T).min(axis=-1) < CLOSE
                    cost = length[i] * (1.0 + ON_BORDER * self.lines[line].mean())
                    spots.append((cost + BY_OTHER * close.sum(), Label(block, places[i], start)))
        return min(spots, key=lambda spot: spot[0])[1] if spots else None

    def _free_places(self, block: Block) -> Array:
        """Return where a label could stand in free room, in mm: a lattice of places."""
        stride = int(np.ceil((_block([""]).height + APART) / self.pixel / 2.0))
        fits = self._fits(~self.busy & ~self.lines, block)[::stride, ::stride]
        return np.asarray((np.argwhere(fits)[:, ::-1] * stride + 0.5) * self.pixel)

    def _fits(self, free: Mask, block: Block) -> Mask:
        size = [int(np.ceil((side + APART) / self.pixel)) for side in (block.height, block.width)]
        return np.asarray(minimum_filter(free, size, mode="constant", cval=False))

    def _place(self, window: tuple[slice, slice], index: Any) -> Array:
        """Return the place in mm of a pixel that is counted in a window."""
        shape = [part.stop - part.start for part in window]
        row, column = np.unravel_index(index, shape)
        return self.pixel * np.array([window[1].start + column + 0.5, window[0].start + row + 0.5])

    def keep_off_label(self, label: Label) -> None:
        """Keep other labels and leader lines off a label and its own line."""
        half = 0.5 * np.array([label.block.width, label.block.height]) + 0.5 * APART
        low, high = ((label.at + side) / self.pixel for side in (-half, half))
        column, row = np.maximum(0, low).astype(int)
        self.busy[row : int(high[1]) + 1, column : int(high[0]) + 1] = True
        if label.start is not None:
            self.busy[self._along(label.start, label.end)] = True

    def _along(self, start: Array, end: Array) -> tuple[Any, Any]:
        """Return rows and columns of the pixels of a straight line."""
        count = int(np.hypot(*(end - start)) / (0.7 * self.pixel)) + 2
        columns, rows = (np.linspace(start, end, count) / self.pixel).astype(int).T
        high, wide = self.owner.shape
        return np.clip(rows, 0, high - 1), np.clip(columns, 0, wide - 1)
