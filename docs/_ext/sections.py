"""The sections of the manual: which pages follow the page that opens each."""

import re
from collections.abc import Iterable
from fnmatch import fnmatch
from math import inf
from pathlib import Path

SECTIONS = {
    "index": [
        "Tutorial <tutorial>",
        "How to <how-to/index>",
        "Theory <theory>",
        "DEM laws <laws>",
        "gallery/index",
        "reference/index",
        "Accuracy <accuracy>",
        "Architecture <architecture>",
    ],
    "how-to/index": [
        "install",
        "how-to/*",
        "choosing",
        "input",
        "collisions",
        "sweeps",
        "fitting",
        "losses",
        "halfspace",
        "normal_spin",
    ],
    "theory": ["theory/*", "phases", "scripts"],
    "laws": ["bulk"],
    "reference/index": [
        "reference/impacts",
        "reference/many",
        "reference/loads",
        "reference/contact_laws",
        "reference/fits",
        "reference/verify",
        "reference/figures",
        "reference/commands",
        "glossary",
        "schema",
    ],
    "accuracy": ["twin", "halfspace_study", "coupling"],
}
TITLED = re.compile(r"(.+) <(.+)>")


def entries(section: str, pages: dict[str, Path]) -> list[str]:
    """Return the lines of a section's table of contents for the pages that there are, by name.

    What is not there is left out: whoever links to it will miss it.
    """
    lines: list[str] = []
    for entry in SECTIONS[section]:
        titled = TITLED.fullmatch(entry)
        title, pattern = titled.groups() if titled else ("", entry)
        found = [page for page in pages if fnmatch(page, pattern) and page != section]
        found.sort(key=lambda page: heading(pages[page]))
        lines += [f"{title} </{page}>" if title else f"/{page}" for page in found]
    return lines


def heading(page: Path) -> tuple[float, str]:
    """Return the first line of a page, to sort by: numbered headings first, in order."""
    with page.open(encoding="utf-8") as text:
        words = text.readline().lstrip("# ").strip()
    number = words.partition(" ")[0]
    return (float(number) if number.isdigit() else inf, words.casefold())


def missing(pages: Iterable[str]) -> set[str]:
    """Return the pages that no section has."""
    patterns = [TITLED.sub(r"\2", entry) for section in SECTIONS.values() for entry in section] + [
        "index"
    ]
    return {page for page in pages if not any(fnmatch(page, pattern) for pattern in patterns)}
