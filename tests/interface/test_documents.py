"""What the documents say about the code is what the code says."""

import re
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
ARCHITECTURE = (ROOT / "docs/architecture.md").read_text(encoding="utf-8")
sys.path.insert(0, str(ROOT / "docs/make"))


def test_diagram_of_phases_is_drawn_from_the_table():
    from phase_diagram import page

    assert (ROOT / "docs/phases.md").read_text(encoding="utf-8") == page()


@pytest.mark.parametrize(
    "document",
    [
        "README.md",
        "CONTRIBUTING.md",
        "studies/README.md",
        *(f"docs/{name}.md" for name in ("architecture", "laws", "halfspace", "halfspace_study")),
    ],
)
def test_links_lead_somewhere(document):
    path = ROOT / document
    for target in re.findall(r"\]\(([^)#:]+)\)", path.read_text(encoding="utf-8")):
        assert (path.parent / target).exists(), target


def tree(text):
    """Return the paths of a listing: a name first on each line, two spaces deeper in a folder.

    A name ends in "/" if it is a folder's, and words follow after two or more spaces.
    """
    folders, paths = [], set()
    for indent, name in re.findall(r"^( *)(\S+)(?:  .*)?$", text, re.MULTILINE):
        folders[len(indent) // 2 :] = [name]
        if not name.endswith("/"):
            paths.add("".join(folders))
    return paths


def test_architecture_names_every_module():
    """By its path, in listings that begin with "src/carom/"; none that is not there."""
    listings = re.findall(r"^```\w*\n(src/carom/.*?)^```$", ARCHITECTURE, re.MULTILINE | re.DOTALL)
    named = set().union(*(tree(listing) for listing in listings))
    paths = [path.relative_to(ROOT) for path in (ROOT / "src/carom").rglob("*.py")]
    modules = {str(path) for path in paths if path.name != "__init__.py"}
    assert [path for path in sorted(modules - named) if "/data/" not in path] == []
    assert [path for path in sorted(named) if not (ROOT / path).is_file()] == []


def test_paths_in_the_architecture_are_there():
    paths = re.findall(r"`((?:src|tests|docs|studies|benchmarks|examples)/[\w./]+)`", ARCHITECTURE)
    assert [path for path in paths if not (ROOT / path).exists()] == []


def test_short_paths_in_the_architecture_are_there():
    """Those below src/carom; one is announced, not yet there, one made by the build."""
    paths = set(re.findall(r"`([a-z_]+/[\w./]*)`", ARCHITECTURE))
    here = {
        path for path in paths if (ROOT / "src/carom" / path).exists() or (ROOT / path).exists()
    }
    assert paths - here <= {"laws/memory/", "lib/"}


def test_ten_files_to_read_are_there():
    section = re.search(
        r"^#+ Ten files to read$(.*?)(?=^#|\Z)", ARCHITECTURE, re.MULTILINE | re.DOTALL
    )
    paths = re.findall(r"`(src/carom/[\w/]+\.py)`", section[1])
    assert len(paths) == len(set(paths)) == 10
    assert [path for path in paths if not (ROOT / path).is_file()] == []


def test_a_listing_gives_paths():
    listing = (
        "src/carom/\n  bodies/   what meets\n    pairs.py  two\n    shapes.py\n  classical.py  a b"
    )
    assert tree(listing) == {
        "src/carom/bodies/pairs.py",
        "src/carom/bodies/shapes.py",
        "src/carom/classical.py",
    }
