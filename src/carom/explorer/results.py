"""The numbers of an impact and the findings on its theory, in rows that the page shows."""

import re
from collections.abc import Iterable, Mapping
from math import degrees, isinf, isnan
from typing import Any

from carom.explorer.views import PAGE
from carom.io.labels import MARKS, Finding
from carom.quantities.glossary import GLOSSARY
from carom.quantities.prefixes import shared

Row = Mapping[str, Any]

SIGNS: dict[str, str] = PAGE["signs"]
SIGNS_OF_LOSSES: dict[str, str] = PAGE["signs_of_losses"]
WORDING: dict[str, str] = PAGE["wording"]


def rows_of(numbers: Mapping[str, float], *, lossy: bool = False) -> tuple[Row, ...]:
    """Return a row for each of these quantities of the glossary that the page shows."""
    signs = SIGNS | (SIGNS_OF_LOSSES if lossy else {})
    return tuple(_row(name, sign, numbers[name]) for name, sign in signs.items() if name in numbers)


def _row(name: str, sign: str, number: float) -> Row:
    meaning, (value, unit) = GLOSSARY[name].meaning, _readable(number, GLOSSARY[name].unit)
    return {"name": name, "symbol": sign, "meaning": meaning, "value": value, "unit": unit}


def _readable(number: float, unit: str) -> tuple[str, str]:
    """Return a number and its unit to read; words where there is none."""
    if isinf(number):
        return "none: it slides freely", ""
    if isnan(number):
        return "none: it was zero before", ""
    if unit == "rad":
        number, unit = degrees(number), "deg"
    (value,), shown = shared((number,), unit)
    return value, "" if shown == "1" else shown


def findings_of(findings: Iterable[Finding]) -> tuple[Row, ...]:
    """Return the findings in the page's words, those first in which the theory does not hold."""
    first = {False: 0, None: 1, True: 2}
    ordered = sorted(findings, key=lambda finding: first[finding.holds])
    return tuple(
        {"mark": MARKS[each.holds].strip(), "text": in_words(f"{each.label}: {each.verdict}")}
        for each in ordered
    )


def in_words(text: str) -> str:
    """Return a text of the library without its arguments and letters spelt out."""
    for pattern, words in WORDING.items():
        text = re.sub(pattern, words, text)
    return text
