"""Find formulas that pages and scripts of the gallery print as plain text: `psi_2`, `k_t/k_n`.

python docs/make/plain_formulas.py [FILE ...]
"""

import re
import sys
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).parents[2]
GREEK = "alpha|beta|chi|delta|epsilon|eta|gamma|kappa|mu|nu|omega|phi|psi|rho|sigma|tau|theta"
PLAIN = re.compile(
    rf"\b(?:{GREEK})\b(?:_\w+)?|\b(?:{GREEK})_\w+\b(?!\.py)|\b[A-Za-z]{{1,2}}_(?:\w|max|min|in|out)\b"
    r"|\b(?:sqrt|exp|sin|cos|tan)\(|[\w)]\^[\d({-]|\b[EGR]\*"
)
CODE = (  # and what else of a page is no prose
    r"(?ms)^ *(`{3,}|~{3,}|:{3,}).*?^ *\1\s*$",
    r"(?s)\$\$.*?\$\$",
    r"(?s)\$[^$\n](?:[^$\n]|\n(?!\n))*?\$",
    r"(?s):math:`[^`]*`",
    r"(?s)(?<!`)(`+)(?!`)(?:(?!\n\n).)*?(?<!`)\1(?!`)",
    r"\]\([^)\s]*\)",
    r"(?m)^\[[^\]]+\]: .*$",
)


def pages() -> list[Path]:
    """Return what users read: the README, the manual and the scripts of its gallery."""
    manual = [p for p in (ROOT / "docs").rglob("*.md") if "gallery" not in p.parts]
    return [ROOT / "README.md", *sorted(manual), *sorted((ROOT / "examples").glob("*.py"))]


def prose(path: Path) -> str:
    """Return the text of a page, or the docstring and text blocks of a script; lines stay."""
    text = path.read_text(encoding="utf-8")
    if path.suffix == ".py":
        text = _text_blocks(text)
    for pattern in CODE:
        text = re.sub(pattern, lambda found: "\n" * found[0].count("\n"), text)
    return text


def _text_blocks(script: str) -> str:
    """Return a gallery script with its code taken out."""
    kept, inside = [], False
    head, _, body = script.partition('"""\n')
    first = head.count("\n")
    for line in body.splitlines():
        inside = line.startswith("# %%") or (inside and line.startswith("#"))
        kept.append(line.lstrip("# %") if inside else "")
    return "\n" * first + head + "\n" + "\n".join(kept)


def found(path: Path) -> Iterator[tuple[int, str]]:
    """Yield the number of each line with a formula in plain text, and the formulas."""
    for number, line in enumerate(prose(path).splitlines(), 1):
        if formulas := [each[0] for each in PLAIN.finditer(line)]:
            yield number, ", ".join(formulas)


def main(names: list[str]) -> int:
    """Print what was found, and return 1 if there is any."""
    total = 0
    for path in [Path(name) for name in names] or pages():
        for number, formulas in found(path):
            print(f"{path}:{number}: {formulas}")
            total += 1
    print(f"{total} lines")
    return bool(total)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
