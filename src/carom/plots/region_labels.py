"""Labels of a map's regions: sequences of phases in letters, and where each of them goes."""

from collections.abc import Callable, Iterator
from functools import cache
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
SPOTS = 2400  # places for labels with leader lines that are compared
TRIALS, SWEEPS, CHANCE, IN_THE_WAY = 8, 80, 15.0, 400.0
NUMBER, LOST = 200.0, 1000.0  # cost of a number instead of words, and of no label, in mm
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


class Spot(NamedTuple):
    """A place for a label, and what it costs, in mm of leader lines."""

    cost: float
    label: Label


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
        sheet.keep_lines_off(label)
    marked = sorted(inside.keys() - placed.keys(), key=lambda n: -poles[n][0][1])
    anchors = np.array([poles[n][0] for n in marked]).reshape(-1, 2)
    number = _block(["0" * len(str(len(marked)))])
    within = [sheet.inside(n, [number]) for n in marked]
    sheet.keep_off_starts(anchors)
    spots = [
        [
            *sheet.beside(anchors, k, _blocks(names[n])[:-1]),
            *sheet.beside(anchors, k, [number], NUMBER),
            *(Spot(NUMBER, label) for label in within[k : k + 1] if label),
        ]
        for k, n in enumerate(marked)
    ]
    chosen = dict(zip(marked, without_overlaps(spots), strict=True))
    placed |= {n: label for n, label in chosen.items() if label}
    short = [n for n in marked if n in placed and placed[n].block == number]
    numbered = list(dict.fromkeys(names[n] for n in short))
    for n in short:
        placed[n] = placed[n]._replace(block=_block([str(numbered.index(names[n]) + 1)]))
    seen = {names[n] for n in wide}
    narrow = [name for name in names if name not in seen]
    return Labels(placed, numbered, narrow, [names[n] for n in wide if n not in placed])


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
        self.places: dict[tuple[float, float], Array] = {}  # of labels, once nothing more is busy

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

    def beside(
        self, anchors: Array, k: int, blocks: list[Block], extra: float = 0.0
    ) -> Iterator[Spot]:
        """Yield places in free room on short leaders; borders and anchors of others cost more."""
        most = SPOTS // (3 * len(anchors))
        start, others = anchors[k], np.delete(anchors, k, axis=0)
        for block in blocks:
            half = 0.5 * np.array([block.width, block.height])
            places = self._free_places(block)
            ends = np.clip(start, places - half, places + half)
            length = np.hypot(*(ends - start).T)
            allowed = (length >= LEADER) & (length <= LONGEST)
            for i in np.argsort(np.where(allowed, length, np.inf))[: min(most, allowed.sum())]:
                line = self._along(start, ends[i])
                if not self.busy[line].any():
                    cost = length[i] * (1.0 + ON_BORDER * self.lines[line].mean())
                    points = np.column_stack(line[::-1]) * self.pixel
                    close = np.hypot(*(points[:, np.newaxis] - others).T).min(axis=-1) < CLOSE
                    cost += BY_OTHER * close.sum() + extra
                    yield Spot(cost, Label(block, places[i], start))

    def _free_places(self, block: Block) -> Array:
        """Return where a label could stand in free room, in mm: a lattice of places."""
        size = block[1:3]
        if size not in self.places:
            stride = int(np.ceil((_block([""]).height + APART) / self.pixel / 2.0))
            fits = self._fits(~self.busy & ~self.lines, block)[::stride, ::stride]
            at = np.argwhere(fits)[:, ::-1] * stride + 0.5
            self.places[size] = np.asarray(at * self.pixel, dtype=np.float64)
        return self.places[size]

    def _fits(self, free: Mask, block: Block) -> Mask:
        size = [int(np.ceil((side + APART) / self.pixel)) for side in (block.height, block.width)]
        return np.asarray(minimum_filter(free, size, mode="constant", cval=False))

    def _place(self, window: tuple[slice, slice], index: Any) -> Array:
        """Return the place in mm of a pixel that is counted in a window."""
        shape = [part.stop - part.start for part in window]
        row, column = np.unravel_index(index, shape)
        return self.pixel * np.array([window[1].start + column + 0.5, window[0].start + row + 0.5])

    def keep_lines_off(self, label: Label) -> None:
        """Keep other labels and leader lines off a label."""
        half = 0.5 * np.array([label.block.width, label.block.height]) + 0.5 * APART
        low, high = ((label.at + side) / self.pixel for side in (-half, half))
        column, row = np.maximum(0, low).astype(int)
        self.busy[row : int(high[1]) + 1, column : int(high[0]) + 1] = True

    def _along(self, start: Array, end: Array) -> tuple[Any, Any]:
        """Return rows and columns of the pixels of a straight line."""
        count = int(np.hypot(*(end - start)) / (0.7 * self.pixel)) + 2
        columns, rows = (np.linspace(start, end, count) / self.pixel).astype(int).T
        high, wide = self.owner.shape
        return np.clip(rows, 0, high - 1), np.clip(columns, 0, wide - 1)


def without_overlaps(spots: list[list[Spot]]) -> list[Label | None]:
    """Return a label of each list or none, no two meeting, at least cost: simulated annealing."""
    every = [spot for choice in spots for spot in choice]
    ends = np.cumsum([0, *map(len, spots)])
    own = [slice(*pair) for pair in pairwise(ends) if pair[0] < pair[1]]
    if not own:
        return [None] * len(spots)
    meets = _meeting([spot.label for spot in every])
    costs, rng = np.array([spot.cost for spot in every]), np.random.default_rng(0)
    kept = [_annealed(rng, own, costs, meets) for _ in range(TRIALS)]
    best = min(kept, key=lambda chosen: costs[chosen].sum() - LOST * len(chosen))
    taken = {int(np.searchsorted(ends, k, side="right")) - 1: every[k].label for k in best}
    return [taken.get(k) for k in range(len(spots))]


def _meeting(labels: list[Label]) -> Callable[[int], Mask]:
    """Return what tells which labels one meets: by places, or leaders that cross a diagonal."""
    at, end = (np.array([getattr(label, name) for label in labels]).T for name in ("at", "end"))
    start = np.array([one.at if one.start is None else one.start for one in labels]).T
    half = 0.5 * np.array([one.block[1:3] for one in labels]).T + 0.5 * APART
    falling = half * np.array([[1.0], [-1.0]])
    lines = [(start, end), (at - half, at + half), (at - falling, at + falling)]
    begin, stop = (np.hstack(ends) for ends in zip(*lines, strict=True))

    @cache
    def meets(k: int) -> Mask:
        own = np.s_[:, k : k + 1]
        apart = np.abs(at - at[own]) - half - half[own]
        meet = (apart[0] < 0.0) & (apart[1] < 0.0)
        meet |= _crossing(start[own], end[own], begin, stop).reshape(len(lines), -1).any(axis=0)
        for low, high in lines[1:]:
            meet |= _crossing(low[own], high[own], start, end)
        return np.asarray(meet)

    return meets


def _crossing(a: Array, b: Array, c: Array, d: Array) -> Mask:
    """Tell which of the lines from c to d the line from a to b crosses."""
    crossed = _sides(a, b, c) * _sides(a, b, d) < 0.0
    c, d = c[:, crossed], d[:, crossed]
    crossed[crossed] = _sides(c, d, a) * _sides(c, d, b) < 0.0
    return crossed


def _sides(start: Array, end: Array, points: Array) -> Array:
    """Return on which side of lines points lie, by sign."""
    (x, y), (u, v) = end - start, points - start
    return np.asarray(x * v - y * u)


def _annealed(
    rng: np.random.Generator, own: list[slice], costs: Array, meets: Callable[[int], Mask]
) -> list[int]:
    """Return the spots of most labels, each among its own, of which no two meet."""
    chosen = [part.start + int(costs[part].argmin()) for part in own]
    hits = np.sum([meets(k) for k in chosen], axis=0)
    for late in np.linspace(0.0, 1.0, SWEEPS):
        chance, in_the_way = CHANCE * (1.0 - late), IN_THE_WAY * (0.2 + late)
        for i in rng.permutation(len(own)).tolist():
            hits -= meets(chosen[i])
            cost = costs[own[i]] + in_the_way * hits[own[i]]
            cost -= chance * rng.gumbel(size=cost.size)
            chosen[i] = own[i].start + int(cost.argmin())
            hits += meets(chosen[i])
    while (often := np.sum([meets(k)[chosen] for k in chosen], axis=0)).max() > 1:
        chosen.pop(int(often.argmax()))
    return chosen
