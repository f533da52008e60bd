"""The oracles share no code with what they are compared with."""

import ast
from pathlib import Path

import pytest

ORACLES = sorted((Path(__file__).parents[1] / "oracles").glob("*.py"))


def imported(path):
    """Return the packages that a file imports anything from."""
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            yield from (name.name.partition(".")[0] for name in node.names)
        if isinstance(node, ast.ImportFrom):
            yield str(node.module).partition(".")[0]


@pytest.mark.parametrize("path", ORACLES, ids=lambda path: path.stem)
def test_an_oracle_imports_nothing_of_carom(path):
    assert "carom" not in set(imported(path))
    assert "import_module" not in path.read_text(encoding="utf-8")
