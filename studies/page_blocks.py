"""Blocks of a page that a study writes: what lies between `<!-- begin: name -->` and `end`."""

import re
from collections.abc import Iterable
from pathlib import Path

BLOCK = re.compile(r"(<!-- begin: (\w+) -->)(.*?)(<!-- end -->)", re.DOTALL)
GREEK = "beta|chi|gamma|kappa|mu|nu|psi"
LETTER = re.compile(rf"(?<![a-z])({GREEK})(?![a-z])")
FORMULA = re.compile(
    rf"\b(?:(?:{GREEK})(?:_\d)?|x_gamma|[ckK]_\w)\b(?:/[kK]_\w\b)?(?: = (?:kappa|c_n|\d[\d./]*))?"
    r"|\b[eI] = \d[\d.]*"
)


def blocks(page: Path) -> dict[str, str]:
    """Return the blocks of a page by name."""
    return {found[2]: found[3] for found in BLOCK.finditer(page.read_text(encoding="utf-8"))}


def page_with(page: Path, texts: dict[str, str]) -> str:
    """Return the page with these texts in its blocks; others stay."""

    def filled(found: re.Match[str]) -> str:
        return found[1] + texts.get(found[2], found[3]) + found[4]

    return BLOCK.sub(filled, page.read_text(encoding="utf-8"))


def as_maths(text: str) -> str:
    """Return a text with plain formulas such as "k_t/k_n = kappa" set as formulas of the page."""
    return FORMULA.sub(lambda found: "$" + LETTER.sub(r"\\\1", found[0]) + "$", text)


def table(head: str, rows: Iterable[str]) -> str:
    """Return a table of Markdown, its head and rows given without the outer bars."""
    rule = " | ".join("---" for _ in head.split(" | "))
    return "\n" + "\n".join(f"| {row} |" for row in (head, rule, *rows)) + "\n"
