"""Every example runs as a user would run it, checks what it shows, and stores its figure.

A recipe of the Cookbook begins with what a reader copies; its notebook runs as it stands.
"""

import ast
import re
import runpy
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
EXAMPLES = ROOT / "examples"
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


def sections():
    """Return the scripts of each section of the index, by its title."""
    parts = (part.partition("\n") for part in INDEX.split("\n## ")[1:])
    found = {title: re.findall(r"^\| \[([\w.]+)\]", rows, re.MULTILINE) for title, _, rows in parts}
    return {title: scripts for title, scripts in found.items() if scripts}


SUBJECTS = sections()
RECIPES = [name for title, names in SUBJECTS.items() if "theory" not in title for name in names]


@pytest.mark.slow  # together
@pytest.mark.parametrize("script", SCRIPTS, ids=lambda script: script.stem)
def test_example_holds_and_draws(script, tmp_path, monkeypatch, capsys):
    """A script prints what it found and stores a figure of its name, and no file of another."""
    monkeypatch.setattr("carom.plots.style.DPI", 100)  # sooner stored
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("MPLBACKEND", "Agg")
    monkeypatch.setattr("sys.argv", [str(script)])
    runpy.run_path(str(script), run_name="__main__")
    assert len(capsys.readouterr().out.splitlines()) >= 1
    assert {path.stem for path in tmp_path.iterdir()} == {script.stem}
    (figure,) = (path for path in tmp_path.iterdir() if path.suffix in (".png", ".gif"))
    assert figure.stat().st_size > 5_000, "an empty figure is smaller"


@pytest.mark.parametrize("script", SCRIPTS, ids=lambda script: script.stem)
def test_example_checks_what_it_shows(script):
    """Three times at least; a recipe of a screen twice."""
    long = script.read_text(encoding="utf-8").count("\n") > 60
    assert len(checks_in(script)) >= (3 if long else 2)


def test_check_that_fails_stops_a_script(tmp_path, monkeypatch):
    """With a rebound that is wrong in the seventh digit no figure is stored."""
    import carom

    right = carom.curve
    wrong = lambda chi, psi: right(chi, psi) + 1e-7  # noqa: E731
    monkeypatch.setattr(carom, "curve", wrong)
    monkeypatch.chdir(tmp_path)
    with pytest.raises(AssertionError, match="tolerance"):
        runpy.run_path(str(EXAMPLES / "rebound_curves.py"), run_name="__main__")
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("name", RECIPES)
def test_recipe_begins_with_what_a_reader_copies(name):
    """One sentence says how, and some 25 lines without imports do it."""
    _, words, code = (EXAMPLES / name).read_text(encoding="utf-8").split('"""', 2)
    answer = words.split("\n\n")[1]
    assert answer.count(". ") == 0
    assert answer.endswith(".")
    lines = [line for line in code.partition("\n# %%\n")[0].splitlines() if line]
    assert len([line for line in lines if not line.startswith(("import ", "from "))]) <= 26


def test_cookbook_has_thirty_recipes_by_subject():
    assert len(RECIPES) >= 30
    assert len(SUBJECTS) == 7
    assert sum(map(len, SUBJECTS.values())) == len(SCRIPTS)


@pytest.mark.parametrize("stem", ["impact_history", "own_law"])
def test_notebook_runs_as_it_stands_and_shows_its_picture(stem, tmp_path, monkeypatch):
    """As sphinx-gallery makes it, in a folder of its own and without the sources."""
    notebooks = pytest.importorskip("sphinx_gallery.notebook", reason="with the extra [docs]")
    from IPython.core.interactiveshell import InteractiveShell
    from sphinx_gallery.gen_gallery import DEFAULT_GALLERY_CONF
    from sphinx_gallery.py_source_parser import split_code_and_text_blocks

    conf = (ROOT / "docs/conf.py").read_text(encoding="utf-8")
    (last,) = re.findall(r'"last_notebook_cell": """\\\n(.*?)"""', conf, re.DOTALL)
    settings = {**DEFAULT_GALLERY_CONF, "first_notebook_cell": None, "last_notebook_cell": last}
    _, blocks = split_code_and_text_blocks(str(EXAMPLES / f"{stem}.py"))
    notebook = notebooks.jupyter_notebook(blocks, settings, str(tmp_path))
    monkeypatch.chdir(tmp_path)
    shell = InteractiveShell()
    for cell in notebook["cells"]:
        if cell["cell_type"] == "code":
            result = shell.run_cell("".join(cell["source"]))
            assert result.success, result.error_in_exec
    assert result.result.data == (tmp_path / f"{stem}.png").read_bytes()


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
