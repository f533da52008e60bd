"""The command that writes a copy of the page: where it may write, and what it leaves."""

import json
import re
from functools import partial

import pytest
from tests import checks

pytest.importorskip("flask", reason="the explorer needs flask: pip install 'carom[explore]'")

from carom.page import export as exporting


def names(folder):
    return {each.name for each in folder.iterdir()}


refused = partial(checks.refused, "", exporting.export)


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


def test_an_empty_folder_and_an_older_copy_are_replaced(tmp_path):
    page = tmp_path / "page"
    page.mkdir()
    same = page.stat().st_ino
    exporting.export(page)
    (page / "assets" / "older.js").write_text("")
    html = (page / "index.html").read_text(encoding="utf-8")
    (page / "index.html").write_text(f'{html}<script src="assets/older.js">', encoding="utf-8")
    exporting.export(page)
    assert not (page / "assets" / "older.js").exists()
    assert (page / "index.html").read_text(encoding="utf-8") == html
    assert names(page) == set(exporting.COPIED)
    assert names(tmp_path) == {"page"}
    assert page.stat().st_ino == same  # who works in it still does


def test_a_file_of_ones_own_beside_the_parts_is_kept(tmp_path):
    exporting.export(tmp_path)
    (tmp_path / "assets" / "logo.png").write_text("mine")
    assert "holds other files" in refused(tmp_path)
    assert (tmp_path / "assets" / "logo.png").read_text() == "mine"


@pytest.mark.first_case
@pytest.mark.parametrize("moves", range(6))
def test_an_older_copy_is_put_back_if_the_new_one_cannot_take_its_place(
    tmp_path, monkeypatch, moves
):
    exporting.export(tmp_path)
    before = {each: each.stat().st_ino for each in tmp_path.rglob("*")}
    left, move = iter(range(moves)), exporting._moved

    def stopped(one, other):
        if next(left, None) is None and one.parent.name != "old" and other.parent.name != "new":
            raise KeyboardInterrupt
        move(one, other)

    monkeypatch.setattr(exporting, "_moved", stopped)
    with pytest.raises(KeyboardInterrupt):
        exporting.export(tmp_path)
    assert {each: each.stat().st_ino for each in tmp_path.rglob("*")} == before


def test_what_is_not_a_copy_is_left_alone(tmp_path):
    (tmp_path / "course").mkdir()
    (tmp_path / "course" / "notes.txt").write_text("mine")
    assert "holds other files" in refused(tmp_path / "course")
    assert names(tmp_path / "course") == {"notes.txt"}
    assert "it is a file" in refused(tmp_path / "course" / "notes.txt")
    assert "must exist" in refused(tmp_path / "none" / "page")
    assert "empty" in refused("")
    site = tmp_path / "site"
    (site / "assets").mkdir(parents=True)
    for name in ("index.html", "plotly.min.js"):
        (site / name).write_text("another page")
    assert "holds other files" in refused(site)
    assert names(tmp_path) == {"course", "site"}


def test_what_fails_leaves_nothing(tmp_path, monkeypatch):
    def broken():
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(exporting, "kernels", broken)
    with pytest.raises(OSError, match=r"^\[Errno 28\] folder: .*cannot be written; No space left"):
        exporting.export(tmp_path / "page")
    assert names(tmp_path) == set()


def test_refusal_on_the_command_line(tmp_path, refusal):
    (tmp_path / "notes.txt").write_text("mine")
    refusal("explore", "--export", tmp_path)


def test_command(tmp_path, run):
    code, out, _ = run("explore", "--export", tmp_path / "page", "--json")
    record = json.loads(out)
    assert code == 0
    assert set(record) == {"folder", "bytes", "files"}
    assert record["folder"] == str(tmp_path / "page")
    assert record["bytes"] < 15e6
