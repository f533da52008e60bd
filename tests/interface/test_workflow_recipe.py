"""The workflow that a page offers for continuous integration is the lines that the page runs."""

import re
from pathlib import Path

from carom.cli import main

PAGE = Path(__file__).parents[2] / "docs" / "how-to" / "own-law.md"
TEXT = PAGE.read_text(encoding="utf-8")


def block(language):
    (found,) = re.findall(rf"^```{language}\n(.*?)^```$", TEXT, re.MULTILINE | re.DOTALL)
    return found


def test_the_workflow_has_the_lines_of_the_shell_in_their_order():
    steps = re.findall(r"- run: (.*)", block("yaml"))
    assert steps[0].startswith("pip install carom")
    assert steps[1:] == block("sh").splitlines()


def test_what_is_uploaded_is_what_the_lines_leave():
    listed = re.search(r"path: \|\n((?: +\S+\n?)+)", block("yaml"))[1].split()
    left = re.findall(r"(?:--plot |--output |results\.csv )(\S+\.\w+)", block("sh"))
    assert sorted(listed) == sorted(left)


def test_the_exit_codes_are_those_of_the_page(tmp_path, monkeypatch):
    """0 for results that pass, 1 for those that fail, 2 for a file that cannot be used."""
    monkeypatch.chdir(tmp_path)
    Path("own.csv").write_text("psi_1,psi_2\n5.5,-0.26\n6,0.24\n7,1.24\n")
    given = ["verify", "score", "own.csv", "--chi", "1.44"]
    assert main(given) == 0
    assert main([*given[:-1], "1.3"]) == 1
    Path("own.csv").write_text("omega\n1\n")
    assert main(given) == 2
