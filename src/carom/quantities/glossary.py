"""Symbol, unit and meaning of every quantity, from which labels and attributes are made.

They stand in `data/glossary.csv`.
"""

import csv
from collections.abc import Mapping
from pathlib import Path
from typing import NamedTuple

from carom.quantities.prefixes import DIGITS, span, text


class Quantity(NamedTuple):
    """An entry of the glossary: mathematical symbol, SI unit, meaning."""

    symbol: str
    unit: str
    meaning: str

    def text(self, value: float, digits: int = DIGITS) -> str:
        """Return a value with its unit, to read; a dash for what is no number."""
        return text(value, self.unit, digits)

    def span(self, low: float, high: float, digits: int = DIGITS) -> str:
        """Return from where to where values go, in one unit, to read."""
        return span(low, high, self.unit, digits)


def listed(numbers: Mapping[str, float], width: int = 0) -> list[str]:
    """Return quantities by name as lines to read."""
    return aligned({GLOSSARY[n].meaning: GLOSSARY[n].text(v) for n, v in numbers.items()}, width)


def aligned(rows: Mapping[str, str], width: int = 0) -> list[str]:
    """Return names and texts as lines to read, without marks of formulas, the texts aligned."""
    plain = {name.replace("$", ""): text for name, text in rows.items()}
    width = width or max(map(len, plain), default=0)
    return [f"  {name:{width}s} {text}" for name, text in plain.items()]


FILE = Path(__file__).parents[1] / "data" / "glossary.csv"


def _read() -> dict[str, Quantity]:
    lines = FILE.read_text(encoding="utf-8").splitlines()
    rows = csv.DictReader(line for line in lines if not line.startswith("#"))
    return {row.pop("name"): Quantity(**row) for row in rows}


GLOSSARY = _read()
PEAKS = ("peak_von_mises", "peak_shear", "peak_tension", "stress_intensity")  # of an impact
NEEDED_STRENGTHS: dict[str, tuple[str, ...]] = {  # of a body, for what a sweep tells of it
    **dict.fromkeys(PEAKS, ()),
    "stress_intensity": ("flaw_size",),
    "yield_speed": ("yield_strength",),
    "tensile_speed": ("tensile_strength",),
    "crack_speed": ("fracture_toughness", "flaw_size"),
}
