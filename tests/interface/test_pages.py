"""The pages of the manual for users run as they stand, and print what they show."""

import re
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
sys.path[:0] = [str(ROOT / "docs/make"), str(ROOT / "studies")]

from page_blocks import blocks  # noqa: E402
from run_pages import PAGES, pictures, run  # noqa: E402
from speed import PAGE, lines, read  # noqa: E402

ACCURACY = ROOT / "docs" / "accuracy.md"


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_page_runs_and_prints_what_it_shows(page, tmp_path, monkeypatch):
    """Every block in order; what is printed is what stands there; every picture is stored."""
    monkeypatch.setattr("carom.plots.style.DPI", 50)  # sooner stored
    differing = [f"line {line}: {came}" for line, _, came in run(page, tmp_path)]
    assert differing == []
    assert all((tmp_path / picture.name).exists() for picture in pictures(page))


@pytest.mark.parametrize("page", [*PAGES, ACCURACY], ids=lambda page: page.stem)
def test_page_shows_pictures_and_links_that_are_there(page):
    text = page.read_text(encoding="utf-8")
    for target in re.findall(r"\]\(([^)#:]+)[^)]*\)", text):
        assert (page.parent / target).exists(), target


def test_accuracy_names_tests_that_are_there_and_times_of_the_table():
    text = ACCURACY.read_text(encoding="utf-8")
    named = re.findall(r"`((?:tests|studies|benchmarks|docs)/[\w/]+\.py)`", text)
    assert len(named) > 20
    assert [name for name in named if not (ROOT / name).exists()] == []
    assert blocks(PAGE)["speed"] == lines(read())


def written(folder, text):
    page = folder / "page.md"
    page.write_text(text, encoding="utf-8")
    return page


def test_a_page_that_shows_something_else_is_found(tmp_path):
    text = "```python\nx = 1.5\nprint(x)\n```\nis\n```text\n1.6\n```\n"
    assert list(run(written(tmp_path, text), tmp_path)) == [(7, "1.6\n", "1.5\n")]


def test_blocks_share_names_and_files(tmp_path):
    """A block that begins with the name of a file is one; `...` stands for what may differ."""
    text = (
        "```toml\n# ball.toml\na = 1\n```\n```python\nfrom pathlib import Path\n```\n"
        "```python\nprint(Path('ball.toml').read_text(), 2.5)\n```\n"
        "```text\n# ball.toml and so on\n```\n```text\n...\na = 1\n ...\n```\n"
    )
    assert [line for line, *_ in run(written(tmp_path, text), tmp_path)] == [12]


def test_a_script_of_the_page_is_written_and_run(tmp_path):
    text = "```python\n# own.py\nimport sys\nsys.exit(int(sys.argv[1]))\n```\n"
    good = f"{text}```sh\npython own.py 0\npython own.py 3  # exit code 3\n```\n"
    assert list(run(written(tmp_path, good), tmp_path)) == []
    with pytest.raises(RuntimeError, match="line 7"):
        list(run(written(tmp_path, f"{text}```sh\npython own.py 1\n```\n"), tmp_path))


def test_a_command_must_exit_as_the_page_says(tmp_path):
    good = "```sh\ncarom curve --chi -1  # exit code 2\n```\n"
    assert list(run(written(tmp_path, good), tmp_path)) == []
    with pytest.raises(RuntimeError, match="line 2"):
        list(run(written(tmp_path, good.replace("code 2", "code 0")), tmp_path))
