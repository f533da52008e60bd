"""Whether this may be published: a line for each thing that is missing, and exit code 1 if any is.

python release/ready.py [--tag v0.3.0] [FILE ...]    FILE: wheels and the archive of the sources
"""

import argparse
import re
import tarfile
import zipfile
from collections.abc import Iterator, Sequence
from pathlib import Path

from metadata import CITATION, CODEMETA, LINKS, citation, codemeta, project, released

RELATIVE_LINK = re.compile(r"\]\((?!https?://|#)[^)]*\)")


def missing(tag: str | None = None, files: Sequence[Path] = ()) -> Iterator[str]:
    """Yield what must be put right before these files are published."""
    version, urls = project()["version"], project().get("urls", {})
    for link in LINKS.values():
        if not re.fullmatch(r"https://[\w.-]+\.[a-z]{2,}(?<!\.example)/\S*", urls.get(link, "")):
            yield f"pyproject.toml: [project.urls] has no public address {link}"
    head, date = released()
    if head != version:
        yield f"CHANGELOG.md: begins with {head}, and pyproject.toml has {version}"
    if date == "unreleased":
        yield f"CHANGELOG.md: {head} has no date"
    for path, text in ((CITATION, citation()), (CODEMETA, codemeta())):
        if path.read_text("utf-8") != text:
            yield f"{path.name}: is out of date; python release/metadata.py writes it"
    if tag is not None and tag != f"v{version}":
        yield f"tag: is {tag}, and pyproject.toml has {version}"
    for path in files:
        yield from _missing_in(path, version)


def _missing_in(path: Path, version: str) -> Iterator[str]:
    """Yield what is wrong with a wheel or an archive of sources."""
    if path.suffix == ".whl":
        with zipfile.ZipFile(path) as wheel:
            names = wheel.namelist()
            (place,) = (name for name in names if name.endswith(".dist-info/METADATA"))
            text = wheel.read(place).decode()
        if not any("/lib/libcarom" in name for name in names):
            yield f"{path.name}: has no compiled library"
        if not any(name.endswith("/lib/carom.wasm") for name in names):
            yield f"{path.name}: has nothing compiled for browsers"
        if "-linux_" in path.name:
            yield f"{path.name}: is for this machine; auditwheel makes it one for all (manylinux)"
    else:
        with tarfile.open(path) as archive:
            (place,) = (
                name for name in archive.getnames() if name.count("/") == 1 and "PKG-" in name
            )
            content = archive.extractfile(place)
            text = content.read().decode() if content else ""
    head, _, description = text.partition("\n\n")
    if f"\nVersion: {version}\n" not in f"{head}\n":
        yield f"{path.name}: is not of version {version}"
    if not description or RELATIVE_LINK.search(description):
        yield f"{path.name}: its description has links that lead nowhere on an index"


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--tag")
    parser.add_argument("files", nargs="*", type=Path)
    asked = parser.parse_args()
    if found := list(missing(asked.tag, asked.files)):
        raise SystemExit("\n".join(found))
    print("ready to be published")
