"""Blocks of a page that a study writes: what lies between `<!-- begin: name -->` and `end`."""

import re
from collections.abc import Iterable
from pathlib import Path

BLOCK = re.compile(r"(<!-- begin: (\w+) -->)(.*?)(<!-- end -->)", re.DOTALL)


def blocks(page: Path) -> dict[str, str]:
    """Return the blocks of a page by name."""
    return {found[2]: found[3] for found in BLOCK.finditer(page.read_text(encoding="utf-8"))}


def page_with(page: Path, texts: dict[str, str]) -> str:
    """Return the page with these texts in its blocks; others stay."""

    def filled(found: re.Match[str]) -> str:
        return found[1] + texts.get(found[2], found[3]) + found[4]

    return BLOCK.sub(filled, page.read_text(encoding="utf-8"))


def table(head: str, rows: Iterable[str]) -> str:
    """Return a table of Markdown, its head and rows given without the outer bars."""
    rule = " | ".join("---" for _ in head.split(" | "))
    return "\n" + "\n".join(f"| {row} |" for row in (head, rule, *rows)) + "\n"
