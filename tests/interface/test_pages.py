"""The pages of the manual for users run as they stand, and print what they show."""

import re
import sys
from pathlib import Path

import pytest
from matplotlib.figure import Figure

ROOT = Path(__file__).parents[2]
sys.path[:0] = [str(ROOT / "docs/make"), str(ROOT / "studies")]

import accuracy  # noqa: E402
from page_blocks import blocks  # noqa: E402
from run_pages import NOT_RUN, PAGES, pictures, run  # noqa: E402
from speed import PAGE, lines, read  # noqa: E402

import carom  # noqa: E402

ACCURACY = ROOT / "docs" / "accuracy.md"
SLOW = (
    *("fitting", "halfspace", "normal_spin", "glass", "dem-codes", "contact-mechanics"),
    *("drop-test", "validity", "measuring", "simulations", "collisions", "erosion", "peening"),
    *("cluster", "cheatsheet"),
)


def run_as(page):
    """A page as a parameter: some take long, some run LAMMPS."""
    marks = [pytest.mark.slow] if page.stem in SLOW else []
    if "carom verify lammps" in page.read_text(encoding="utf-8") or "verification" in page.stem:
        absent = carom.verify.Lammps().executable() is None
        marks += [pytest.mark.engine, pytest.mark.skipif(absent, reason="LAMMPS is not installed")]
    return pytest.param(page, id=str(page.relative_to(ROOT)), marks=marks)


def test_every_page_with_code_is_run_and_nothing_is_left_out_for_nothing():
    """Those in folders, too; what is not run is on a page, and would be run otherwise."""
    python = {
        page for page in (ROOT / "docs").rglob("*.md") if "```python" in page.read_text("utf-8")
    }
    assert python | {ROOT / "README.md"} <= set(PAGES)
    text = "\n".join(page.read_text(encoding="utf-8") for page in (ROOT / "docs").rglob("*.md"))
    assert [line for line in NOT_RUN if f"\n$ {line}" not in text] == []


@pytest.mark.parametrize("page", [run_as(page) for page in PAGES])
def test_page_runs_and_prints_what_it_shows(page, tmp_path, monkeypatch):
    """Every block in order; what is printed is what stands there; every picture is stored."""
    monkeypatch.setattr("carom.plots.style.DPI", 50)  # sooner stored
    differing = [f"line {line}: {came}" for line, _, came in run(page, tmp_path)]
    assert differing == []
    assert all((tmp_path / picture.name).exists() for picture in pictures(page))


def test_accuracy_names_tests_that_are_there_and_times_of_the_table():
    text = ACCURACY.read_text(encoding="utf-8")
    named = re.findall(r"`((?:tests|studies|benchmarks|docs)/[\w/]+\.py)`", text)
    assert len(named) > 20
    assert [name for name in named if not (ROOT / name).exists()] == []
    assert blocks(PAGE)["speed"] == lines(read())


@pytest.mark.parametrize(
    ("claim", "part"),
    [(r"\$\\psi_2\$ to \$10\^\{-10\}", "draw_table"), ("energy balance", "draw_energy")],
)
def test_accuracy_claims_what_its_script_finds(claim, part):
    """One number for one thing: the table of claims has what the figure above it shows."""
    page = ACCURACY.read_text(encoding="utf-8")
    claimed = float(re.search(rf"(?m)^\| {claim}[^|]*\|[^|]*\| ([\de.-]+) \|", page)[1])
    value = float(re.search(r"[\de.-]+$", getattr(accuracy, part)(Figure().subplots()))[0])
    assert 0.3 * claimed < value < 1.5 * claimed


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


def test_python_must_show_what_it_prints(tmp_path):
    shown = "```python\nprint(1)\n```\n"
    assert list(run(written(tmp_path, shown), tmp_path)) == [(2, "", "1\n")]
    assert list(run(written(tmp_path, shown + "```text\n1\n```\n"), tmp_path)) == []


def test_a_console_is_run_and_compared(tmp_path):
    """But for what comes after a line that needs something else, and what is no command of ours."""
    text = (
        "```console\n$ pip install .\n$ python -c 'print(1)'\n1\n$ carom --version\n2\n"
        "$ carom explore\n$ python -c '1/0'\n```\n"
    )
    ((line, shown, came),) = run(written(tmp_path, text), tmp_path)
    assert (line, shown) == (2, "2\n")
    assert came.strip() == carom.__version__


def test_a_command_must_exit_as_the_page_says(tmp_path):
    good = "```sh\ncarom curve --chi -1  # exit code 2\n```\n"
    assert list(run(written(tmp_path, good), tmp_path)) == []
    with pytest.raises(RuntimeError, match="line 2"):
        list(run(written(tmp_path, good.replace("code 2", "code 0")), tmp_path))
