"""The command that writes a copy of the page: where it may write, and what it leaves."""

import json
import re
import subprocess
import sys

import pytest

pytest.importorskip("flask", reason="the explorer needs flask: pip install 'carom[explore]'")

import carom
from carom.explorer import export as exporting

COMMAND = [sys.executable, "-c", "from carom.cli import run; run()", "explore", "--export"]


@pytest.fixture
def quick(monkeypatch):
    """Export without the tables, which take long."""
    script = "window.Carom = window.Carom || {};\nCarom.tables = {};\n"
    monkeypatch.setattr(exporting, "tables", lambda advance: script)


def names(folder):
    return {each.name for each in folder.iterdir()}


@pytest.mark.usefixtures("quick")
def test_everything_that_the_page_names_is_there(tmp_path):
    copy = exporting.export(tmp_path / "page")
    html = (tmp_path / "page" / "index.html").read_text(encoding="utf-8")
    named = re.findall(r'(?:src|href)="([^"]+)"', html)
    assert named
    for place in named:
        assert place.startswith("data:") or (tmp_path / "page" / place).is_file(), place
    files = [each for each in (tmp_path / "page").rglob("*") if each.is_file()]
    assert (copy.bytes, copy.files) == (sum(each.stat().st_size for each in files), len(files))
    assert names(tmp_path) == {"page"}


@pytest.mark.usefixtures("quick")
def test_an_empty_folder_and_an_older_copy_are_replaced(tmp_path):
    (tmp_path / "page").mkdir()
    exporting.export(tmp_path / "page")
    (tmp_path / "page" / "assets" / "older.js").write_text("")
    exporting.export(tmp_path / "page")
    assert not (tmp_path / "page" / "assets" / "older.js").exists()
    assert names(tmp_path) == {"page"}


def refused(target):
    with pytest.raises(carom.InputError) as error:
        exporting.export(target)
    assert "\n" not in str(error.value)
    return str(error.value)


@pytest.mark.usefixtures("quick")
def test_what_is_not_a_copy_is_left_alone(tmp_path):
    (tmp_path / "course").mkdir()
    (tmp_path / "course" / "notes.txt").write_text("mine")
    assert "holds other files" in refused(tmp_path / "course")
    assert names(tmp_path / "course") == {"notes.txt"}
    assert "it is a file" in refused(tmp_path / "course" / "notes.txt")
    assert "must exist" in refused(tmp_path / "none" / "page")
    assert "empty" in refused("")
    site = tmp_path / "site"
    site.mkdir()
    for name in ("index.html", "plotly.min.js"):
        (site / name).write_text("another page")
    (site / "assets").mkdir()
    assert "holds other files" in refused(site)
    assert names(tmp_path) == {"course", "site"}


def test_what_fails_leaves_nothing(tmp_path, monkeypatch):
    def broken(advance):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(exporting, "tables", broken)
    assert "No space left" in refused(tmp_path / "page")
    assert names(tmp_path) == set()


def test_refusal_on_the_command_line(tmp_path):
    (tmp_path / "notes.txt").write_text("mine")
    ended = subprocess.run([*COMMAND, str(tmp_path)], capture_output=True, text=True)
    assert ended.returncode != 0
    assert len(ended.stderr.strip().splitlines()) == 1
    assert "Traceback" not in ended.stderr


@pytest.mark.slow
def test_command(tmp_path):
    ended = subprocess.run(
        [*COMMAND, str(tmp_path / "page"), "--json"], capture_output=True, text=True, check=True
    )
    told = json.loads(ended.stdout)
    assert set(told) == {"folder", "bytes", "files"}
    assert told["folder"] == str(tmp_path / "page")
    assert told["bytes"] < 15e6
