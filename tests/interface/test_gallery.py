"""Every example runs as a user would run it, checks what it shows, and stores its figure."""

import ast
import re
import runpy
from pathlib import Path

import pytest

EXAMPLES = Path(__file__).parents[2] / "examples"
SCRIPTS = sorted(EXAMPLES.glob("*.py"))
INDEX = (EXAMPLES / "README.md").read_text(encoding="utf-8")
CHECKS = ("assert_allclose", "assert_array_equal")


def checks_in(script):
    """Return the lines on which a script checks something."""
    tree = ast.walk(ast.parse(script.read_text(encoding="utf-8")))
    calls = (node for node in tree if isinstance(node, ast.Assert | ast.Call))
    return {
        node.lineno
        for node in calls
        if isinstance(node, ast.Assert) or getattr(node.func, "attr", "") in CHECKS
    }


@pytest.mark.slow  # together
@pytest.mark.parametrize("script", SCRIPTS, ids=lambda script: script.stem)
def test_example_holds_and_draws(script, tmp_path, monkeypatch, capsys):
    """A script prints one line when its checks have passed and stores a figure of its name."""
    monkeypatch.setattr("carom.plots.style.DPI", 100)  # sooner stored
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("MPLBACKEND", "Agg")
    monkeypatch.setattr("sys.argv", [str(script)])
    runpy.run_path(str(script), run_name="__main__")
    assert len(capsys.readouterr().out.splitlines()) == 1
    (figure,) = tmp_path.iterdir()
    assert figure.stem == script.stem
    assert figure.stat().st_size > 5_000, "an empty figure is smaller"
    assert len(checks_in(script)) >= 3


def test_check_that_fails_stops_a_script(tmp_path, monkeypatch):
    """With a rebound that is wrong in the seventh digit no figure is stored."""
    import carom

    right = carom.rebound
    monkeypatch.setattr(carom, "rebound", lambda psi, chi: right(psi, chi) + 1e-7)
    example = runpy.run_path(str(EXAMPLES / "rebound_against_chi.py"))
    with pytest.raises(AssertionError, match="tolerance"):
        example["main"](tmp_path)
    assert list(tmp_path.iterdir()) == []


def test_index_names_every_script_and_its_pictures():
    listed = re.findall(r"\]\(([\w./]+)\)", INDEX)
    assert {name for name in listed if name.endswith(".py")} == {path.name for path in SCRIPTS}
    for target in listed:
        assert (EXAMPLES / target).exists(), target


def test_index_leads_from_every_equation_to_a_script():
    """The paper's equations are (1) to (37); the table has a row or a range for each."""
    names = set()
    for row in re.findall(r"^\| (\([^|]*\)) \|.*\.py", INDEX, re.MULTILINE):
        for first, last in re.findall(r"\((\d+)\)(?:-\((\d+)\))?", row):
            names |= set(range(int(first), int(last or first) + 1))
    assert names == set(range(1, 38))
