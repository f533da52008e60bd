"""Labels of a map's regions: sequences of phases in letters, and where each of them goes."""

from functools import lru_cache
from typing import NamedTuple

import matplotlib
import numpy as np
from matplotlib.font_manager import FontProperties
from matplotlib.textpath import TextPath

from carom.plots.bands import MINUS
from carom.plots.leaders import arranged
from carom.plots.placing import Block, Middle, Placed, Sheet, middle
from carom.plots.regions import Region
from carom.quantities.arrays import Array

SMALLEST = 0.2  # width in mm of a region that has a label
MOST = 60  # labels
UNSEEN = 0.02  # width in mm of one that is not even listed, if its sequence is elsewhere
SPOTS = 5000  # places for labels with leader lines that are compared
PITCH = 1.2  # of lines of text, in sizes of the font
MM = 25.4 / 72.0  # a point
HINTS = 1.1  # by which text can be wider on a screen than its outlines
LETTERS = {"gross slip": "G", "stick": "S", "slip": "s"}


class Labels(NamedTuple):
    """Labels by the number of their region, what has a number instead, and what has no room."""

    placed: dict[int, Placed]
    numbered: list[str]
    lost: list[str]


def signed(name: str) -> str:
    """Return a text with true minus signs."""
    return name.replace("-", MINUS)


def in_letters(name: str) -> list[str]:
    """Return the phases of a sequence in letters, with their sense of slip."""
    for words, letter in LETTERS.items():
        name = name.replace(words, letter)
    return signed(name).replace(" +", "+").replace(f" {MINUS}", MINUS).split(", ")


def wrapped(text: str, room: float) -> str:
    """Return small text on lines that are no wider than some mm."""
    lines = [""]
    for word in text.split(" "):
        longer = f"{lines[-1]} {word}".strip()
        lines = [*lines[:-1], longer] if _width(longer) <= room else [*lines, word]
    return "\n".join(lines)


def find_labels(
    found: list[Region],
    wide: list[int],
    lines: list[Array],
    to_mm: Array,
    size: tuple[float, float],
) -> Labels:
    """Return where the labels of wide regions go on a map of a size in mm, clear of some lines.

    Inside their region, else at the end of a leader line. Where there is no room even for that, a
    number takes the place of the sequence.
    """
    sheet = Sheet(found, to_mm, size)
    for line in lines:
        sheet.keep_off(line * to_mm[0] + to_mm[1])
    ways = [_blocks(region.name) for region in found]
    middles = {n: middle(found[n], to_mm) for n in wide}
    first = sorted(wide, key=lambda n: -middles[n].width)[:MOST]
    inside = {n: sheet.inside(n, ways[n]) for n in first}
    placed = {n: label for n, label in inside.items() if label}
    marked = sorted(inside.keys() - placed.keys())
    ways = [[block for block in blocks if not block.turned] for blocks in ways]
    short: list[int] = []
    while True:
        outside = _beside(sheet, marked, middles, ways)
        full = sorted(set(marked) - outside.keys() - set(short), key=lambda n: -middles[n].at[1])
        if not full:
            break
        for n in full:
            short.append(n)
            ways[n] = [_block([str(len(short))])]
            within = sheet.inside(n, ways[n])
            if within:
                placed[n] = within
                marked.remove(n)
    placed |= outside
    names = list(dict.fromkeys(found[n].name for n in short if n in placed))
    for n in set(short) & placed.keys():
        number = _block([str(names.index(found[n].name) + 1)])
        placed[n] = placed[n]._replace(block=number)
    return Labels(placed, names, [found[n].name for n in wide if n not in placed])


def _beside(
    sheet: Sheet, marked: list[int], middles: dict[int, Middle], ways: list[list[Block]]
) -> dict[int, Placed]:
    """Return labels with leader lines, of the regions for which there is room."""
    most = SPOTS // max(1, len(marked))
    anchors = [middles[n].at for n in marked]
    spots = [sheet.spots(k, anchors, ways[n], most) for k, n in enumerate(marked)]
    return {
        n: Placed(spot.block, spot.at, np.array([middles[n].at, spot.end]))
        for n, spot in zip(marked, arranged(anchors, spots), strict=True)
        if spot
    }


def _blocks(name: str) -> list[Block]:
    """Return the ways to write a sequence: on one line, on more, or upwards; the best first."""
    letters = in_letters(name) if name else ["not", "resolved"]
    flat = [
        _block([" ".join(part) for part in np.array_split(letters, lines)])
        for lines in range(1, min(4, len(letters) + 1))
    ]
    upright = [block._replace(turned=True) for block in flat[:2]]
    return [*flat[:2], upright[0], *flat[2:], *upright[1:]]


def _block(lines: list[str]) -> Block:
    return Block("\n".join(lines), max(map(_width, lines)), PITCH * _small() * len(lines))


def _width(text: str) -> float:
    """Return how wide small text is, in mm."""
    family = str(matplotlib.rcParams["font.family"])
    words = text.split(" ")
    spaces = (len(words) - 1) * _em_width(" ", family)
    return HINTS * _small() * (sum(_em_width(word, family) for word in words) + spaces)


def _small() -> float:
    """Return the size of small text, in mm."""
    return FontProperties(size="small").get_size_in_points() * MM


@lru_cache
def _em_width(word: str, family: str) -> float:
    """Return how wide a word is in a family of fonts, in sizes of the font."""
    ends = [TextPath((0, 0), text, size=100.0).get_extents().x1 for text in ("||", f"|{word}|")]
    return float(ends[1] - ends[0]) / 100.0
