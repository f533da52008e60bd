"""What the documents say about the code is what the code says."""

import re
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
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


def test_architecture_names_every_module():
    text = (ROOT / "docs/architecture.md").read_text(encoding="utf-8")
    modules = {path.stem for path in (ROOT / "src/carom").rglob("*.py")} - {"__init__"}
    assert [name for name in sorted(modules) if name not in text] == []
