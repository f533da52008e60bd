"""Run the code of the manual's pages, and draw the figures that it makes.

python docs/make/run_pages.py [PAGE ...]    where none is named, all pages that have code;
examples/README.md stands for the figures of its scripts

The blocks of a page run in order, in one namespace and a folder that holds `examples` alone:

- `python` is executed, and what it prints must be shown by the `text` that follows;
- in `sh`, lines that begin with `carom ` or `python ` are executed, and must exit with 0, or what a
  comment "exit code 1" says;
- in `console`, lines that begin with `$ carom ` or `$ python ` are, and must print what follows;
  those of `NOT_RUN`, and what stands behind them, are shown only;
- `toml`, `text` or `python` whose first line is "# NAME.EXT" is a file, written under that name;
- any other `text` is what the block before it must have printed, "..." standing for anything.

A picture in figures/STEM/ of page STEM is one that the page's code must have stored.
"""

import re
import runpy
import shlex
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from contextlib import chdir, redirect_stdout
from doctest import ELLIPSIS, OutputChecker
from io import StringIO
from itertools import pairwise, takewhile
from pathlib import Path
from typing import Any

import matplotlib

from carom.cli import main as command

DOCS = Path(__file__).parents[1]
EXAMPLES = DOCS.parent / "examples"
MAPS = {"contact_through_impact", "full_contact", "patch_in_microslip"}  # they keep all colours
sys.path.append(str(DOCS.parent / "studies"))

from small_pictures import store_small  # noqa: E402

NOT_RUN = {  # beginnings of commands: what they need that is not here, and where they are tested
    "carom explore": "a server that goes on: tests/browser",
    "carom lammps build": "a place for the plugin: tests/lammps/test_building.py",
    "carom liggghts build": "the sources of LIGGGHTS: tests/liggghts/test_building.py",
    "carom sweep examples/million.toml": "a cluster: tests/invariants/test_sweep_cluster.py",
    "carom verify lammps --law carom": "the plugin: tests/lammps/test_bench.py",
    "python -m pytest": "minutes",
}
BLOCK = re.compile(  # a fenced block, a file if it begins with a name
    r"^```(?P<language>\w+)\n(?P<text>"
    r"(?:(?<=toml\n|text\n|thon\n)# (?P<file>[\w-]+\.\w+)\n)?.*?)^```$",
    re.MULTILINE | re.DOTALL,
)


def blocks(page: Path) -> list[re.Match[str]]:
    """Return the fenced blocks of a page."""
    return [*BLOCK.finditer(page.read_text(encoding="utf-8"))]


def line_of(block: re.Match[str]) -> int:
    return block.string.count("\n", 0, block.start("text")) + 1


def commands(block: re.Match[str]) -> list[tuple[str, str]]:
    """Return the commands of a block that are run, each with what is shown below it."""
    if block["language"] == "sh":
        lines = [(line, "") for line in block["text"].splitlines()]
    elif block["language"] == "console":
        parts = re.split(r"^\$ ", block["text"], flags=re.MULTILINE)[1:]
        lines = [tuple(part.split("\n", 1)) for part in parts]
    else:
        return []
    here = takewhile(lambda line: not line[0].startswith(tuple(NOT_RUN)), lines)
    return [line for line in here if line[0].startswith(("carom ", "python "))]


PAGES = tuple(  # those of which anything is executed
    page
    for page in (DOCS.parent / "README.md", *sorted(DOCS.rglob("*.md")))
    if any(block["language"] == "python" or commands(block) for block in blocks(page))
)


def as_promised(line: str) -> bool:
    """Run a command; return whether its exit code is that of a comment "exit code N", else 0."""
    promised = re.search(r"# .*exit code (\d)|$", line)[1] or "0"
    program, *words = shlex.split(line, comments=True)
    if program == "carom":
        return command(words) == int(promised)
    ended = subprocess.run([sys.executable, *words], check=False, stdout=subprocess.PIPE)
    print(ended.stdout.decode(), end="")
    return ended.returncode == int(promised)


def printed(block: re.Match[str], page: Path, names: dict[str, Any]) -> list[tuple[str, str]]:
    """Run a block where we are; return what is shown below each command, and what it printed."""
    if block["language"] == "python":
        with redirect_stdout(StringIO()) as caught:
            source = "\n" * (line_of(block) - 1) + block["text"]  # errors name lines of the page
            exec(compile(source, str(page), "exec"), names)
        return [("", caught.getvalue())]
    answers = []
    for line, shown in commands(block):
        with redirect_stdout(StringIO()) as caught:
            if not as_promised(line):
                raise RuntimeError(f"{page}, line {line_of(block)}: failed, {line}")
        answers.append((shown, caught.getvalue()))
    return answers


def run(page: Path, folder: Path) -> Iterator[tuple[int, str, str]]:
    """Run a page in a folder; yield the line, what was expected and what came where they differ."""
    names: dict[str, Any] = {"__name__": "__main__"}
    shutil.copytree(EXAMPLES, folder / "examples", dirs_exist_ok=True)
    checker, came = OutputChecker(), ""
    with chdir(folder):
        for block, following in pairwise([*blocks(page), None]):
            compared = []
            if block["file"]:
                Path(block["file"]).write_text(block["text"], encoding="utf-8")
            elif block["language"] == "text":
                compared = [(block["text"], came)]
            else:
                answers = printed(block, page, names)
                came = "".join(answer for _, answer in answers)
                follows = following and following["language"] == "text" and not following["file"]
                compared = [] if follows or block["language"] == "sh" else answers
            for shown, answer in compared:
                if not checker.check_output(shown, answer, ELLIPSIS):
                    yield line_of(block), shown, answer


def pictures(page: Path) -> list[Path]:
    """Return the pictures that the code of a page makes, as the page links them."""
    own = rf"\]\((?:[^)]*/)?figures/{page.stem}/([^)/]+\.png)\)"
    names = re.findall(own, page.read_text(encoding="utf-8"))
    return [DOCS / "figures" / page.stem / name for name in names]


def draw_gallery() -> None:
    """Draw the figures of the index of the examples: its scripts' own."""
    sys.argv[1:] = []
    for figure in sorted(DOCS.glob("figures/gallery/*.png")):
        with tempfile.TemporaryDirectory() as folder:
            with chdir(folder):
                runpy.run_path(str(EXAMPLES / f"{figure.stem}.py"), run_name="__main__")
            store_small(Path(folder) / figure.name, figure, all_colors=figure.stem in MAPS)


def main() -> int:
    """Run the pages, store their pictures, and tell what differs."""
    matplotlib.use("agg")
    wrong = 0
    pages = [Path(name).resolve() for name in sys.argv[1:]] or PAGES
    for page in pages:
        if page == EXAMPLES / "README.md":
            draw_gallery()
        with tempfile.TemporaryDirectory() as folder:
            for line, expected, came in run(page, Path(folder)):
                print(f"{page.name}, line {line}: expected\n{expected}came\n{came}")
                wrong += 1
            for picture in pictures(page):
                store_small(Path(folder) / picture.name, picture)
        print(f"{page.name}: done")
    return int(wrong > 0)


if __name__ == "__main__":
    sys.exit(main())
