"""Compare the licences of all that Carom needs, as it is installed, with docs/licences.md.

python release/licences.py [--write]    exit code 1 if a package or its licence is not on the page
"""

import re
import sys
from importlib.metadata import Distribution, PackageNotFoundError, distribution
from pathlib import Path

from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

PAGE = Path(__file__).parents[1] / "docs/licences.md"
TABLE = re.compile(r"(?<=<!-- begin: dependencies -->\n).*?(?=<!-- end -->)", re.DOTALL)
EXTRAS = ("", "cluster", "explore", "fit", "jit", "verify")  # what users install
NAMES = (  # of licences as packages write them, by a part of that
    ("GNU General Public License v2", "GPL-2.0-only"),
    ("BSD-2", "BSD-2-Clause"),
    ("BSD-3", "BSD-3-Clause"),
    ("BSD", "BSD"),
    ("MIT", "MIT"),
    ("Apache", "Apache-2.0"),
    ("Python Software Foundation", "PSF-2.0"),
    ("PSF", "PSF-2.0"),
    ("MPL", "MPL-2.0"),
    ("ISC", "ISC"),
    ("ZPL", "ZPL-2.1"),
)


def needed(extras: tuple[str, ...] = EXTRAS) -> dict[str, str]:
    """Return the licence of each package that Carom needs with extras, if it is installed."""
    found: dict[str, str] = {}
    waiting = [("carom", extras)]
    seen = set()
    while waiting:
        name, wanted = waiting.pop()
        if (name, wanted) in seen:
            continue
        seen.add((name, wanted))
        try:
            package = distribution(name)
        except PackageNotFoundError:
            continue
        if name != "carom":
            found[name] = licence(package)
        for each in map(Requirement, package.requires or ()):
            if each.marker is None or any(
                each.marker.evaluate({"extra": e}) for e in ("", *wanted)
            ):
                waiting.append((canonicalize_name(each.name), tuple(sorted(each.extras))))
    return found


def licence(package: Distribution) -> str:
    """Return the licence of a package, by its expression, its classifiers or its own words."""
    if expression := package.metadata.get("License-Expression"):
        return str(expression)
    classifiers = package.metadata.get_all("Classifier") or ()
    told = [each.rpartition(" :: ")[2] for each in classifiers if each.startswith("License :: OSI")]
    words = (package.metadata.get("License") or "").strip().partition("\n")[0]
    for text in (words, *told):  # words tell which BSD
        for part, name in NAMES:
            if part in text and name != "BSD":
                return name
    if "BSD License" in told or "BSD" in words:
        return "BSD-3-Clause" if _has_third_clause(package) else "BSD-2-Clause"
    return words or ", ".join(told) or "unknown"


def _has_third_clause(package: Distribution) -> bool:
    """Tell whether a BSD licence, as a package ships it, forbids the use of names."""
    files = [each for each in package.files or () if "LICENSE" in each.name.upper()]
    return any("endorse or promote" in each.read_text() for each in files[:1])


def table(licences: dict[str, str]) -> str:
    """Return the table of the page: a row for each licence."""
    by_licence: dict[str, list[str]] = {}
    for name, text in sorted(licences.items()):
        by_licence.setdefault(text, []).append(name)
    rows = [f"| {text} | {', '.join(names)} |" for text, names in sorted(by_licence.items())]
    return "\n".join(("| licence | packages |", "|---|---|", *rows)) + "\n"


def told(page: str) -> dict[str, str]:
    """Return the licences that the page tells, by package."""
    found = TABLE.search(page)
    rows = re.findall(r"(?m)^\| ([^|]+) \| ([^|]+) \|$", found[0] if found else "")[1:]
    return {name: text for text, names in rows for name in names.split(", ")}


if __name__ == "__main__":
    now, text = needed(), PAGE.read_text("utf-8")
    if "--write" in sys.argv:
        PAGE.write_text(TABLE.sub(lambda _: table(now), text), "utf-8")
    elif new := {
        name: f"{name}: {kind}" for name, kind in now.items() if told(text).get(name) != kind
    }:
        raise SystemExit("not in docs/licences.md, or otherwise there:\n" + "\n".join(new.values()))
    else:
        print(f"{len(now)} packages have the licences of docs/licences.md")
