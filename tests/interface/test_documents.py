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


def test_the_tree_of_the_architecture_is_that_of_the_sources():
    from tree import page

    assert page(ARCHITECTURE) == ARCHITECTURE
    assert "    lossy/ " in ARCHITECTURE


def test_the_architecture_is_short():
    assert len(ARCHITECTURE.split()) <= 3000


def test_paths_in_the_architecture_are_there():
    paths = re.findall(r"`((?:src|tests|docs|studies|benchmarks|examples)/[\w./]+)`", ARCHITECTURE)
    assert [path for path in paths if not (ROOT / path).exists()] == []


def test_short_paths_in_the_architecture_are_there():
    """Those below src/carom; one is made by the build."""
    paths = set(re.findall(r"`([a-z_]+/[\w./]*)`", ARCHITECTURE))
    here = {
        path for path in paths if (ROOT / "src/carom" / path).exists() or (ROOT / path).exists()
    }
    assert paths - here <= {"lib/"}


def test_ten_files_to_read_are_there():
    section = re.search(
        r"^#+ Ten files to read$(.*?)(?=^#|\Z)", ARCHITECTURE, re.MULTILINE | re.DOTALL
    )
    paths = re.findall(r"`(src/carom/[\w/]+\.py)`", section[1])
    assert len(paths) == len(set(paths)) == 10
    assert [path for path in paths if not (ROOT / path).is_file()] == []
