"""The numbers of an impact and the findings on its theory, in rows that the page shows."""

import re
from collections.abc import Iterable, Mapping
from math import degrees, isinf, isnan
from typing import Any

from carom.io.labels import MARKS, Finding
from carom.quantities.glossary import GLOSSARY
from carom.quantities.prefixes import shared

Row = Mapping[str, Any]

SIGNS = {  # what the page writes for a quantity, in the order of its rows
    "psi_in": "ψ₁",
    "psi_out": "ψ₂",
    "chi": "χ",
    "kappa": "κ",
    "rebound_angle": "θ′",
    "rebound_speed": "V′",
    "spin_out": "ω′",
    "contact_restitution": "e_c",
    "tangential_restitution": "e_t",
    "dissipated_energy": "W",
    "duration": "t_c",
    "max_force": "P_max",
    "max_radius": "a_max",
}
OF_LOSSES = {"normal_restitution": "e", "lost_energy": "W_n", "shear_lost_energy": "W_s"}
IN_WORDS = {  # what findings of the library call an argument or a letter, and the page's words
    r", which method='halfspace' solves": ", which boundary elements solve",
    r"method='halfspace' solves": "boundary elements solve",
    r"Dundurs beta": "Dundurs' β",
    r"'carom materials' lists them all": "the list of materials in the controls has them all",
    r"^(\w+): (not a number in [^;]+); \1: ": r"\1: \2; ",
    r"\bpsi_1\b": "ψ₁",
    r"\bpsi_2\b": "ψ₂",
    r"\bp_0\b": "p₀",
    r"\bV_1\b": "V₁",
    r"\bchi\b": "χ",
    r"\bkappa\b": "κ",
    r"\bmu\b": "µ",
}


def rows_of(numbers: Mapping[str, float], *, lossy: bool = False) -> tuple[Row, ...]:
    """Return a row for each of these quantities of the glossary that the page shows."""
    signs = SIGNS | (OF_LOSSES if lossy else {})
    return tuple(_row(name, sign, numbers[name]) for name, sign in signs.items() if name in numbers)


def _row(name: str, sign: str, number: float) -> Row:
    meaning, (value, unit) = GLOSSARY[name].meaning, _told(number, GLOSSARY[name].unit)
    return {"name": name, "symbol": sign, "meaning": meaning, "value": value, "unit": unit}


def _told(number: float, unit: str) -> tuple[str, str]:
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
        {"mark": MARKS[each.holds].strip(), "text": in_words(f"{each.told}: {each.verdict}")}
        for each in ordered
    )


def in_words(text: str) -> str:
    """Return a text of the library without its arguments and letters spelt out."""
    for said, meant in IN_WORDS.items():
        text = re.sub(said, meant, text)
    return text
