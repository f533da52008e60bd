"""Run the code of the manual's pages, and draw the figures that it makes.

python docs/make/run_pages.py [PAGE ...]    where none is named, all pages for users

The blocks of a page run in order, in one namespace and an empty folder:

- `python` is executed; in `sh`, lines that begin with `carom ` or `python ` are, and must exit with
  0, or what a comment "exit code 1" says; `console` is shown only;
- `toml`, `text` or `python` whose first line is "# NAME.EXT" is a file, written under that name;
- any other `text` is what the block before it must have printed, "..." standing for anything.

A picture in figures/STEM/ of page STEM is one that the page's code must have stored.
"""

import re
import shlex
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from contextlib import chdir, redirect_stdout
from doctest import ELLIPSIS, OutputChecker
from io import StringIO
from pathlib import Path
from typing import Any, NamedTuple

from carom.cli import main as command

DOCS = Path(__file__).parents[1]
sys.path.append(str(DOCS.parent / "studies"))

from small_pictures import store_small  # noqa: E402

OTHERS = (DOCS / "choosing.md", DOCS / "glossary.md", DOCS / "input.md")
PAGES = (DOCS / "tutorial.md", *sorted(DOCS.glob("how-to/*.md")), *OTHERS)
BLOCK = re.compile(r"^```(\w+)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
NAMED = re.compile(r"# ([\w-]+\.\w+)\n")


class Block(NamedTuple):
    """A fenced block: its language, its text, and the line where it begins."""

    language: str
    text: str
    line: int

    @property
    def file(self) -> str:
        """The name of the file that it is, if it is one."""
        named = NAMED.match(self.text) if self.language in ("toml", "text", "python") else None
        return named[1] if named else ""


def blocks(page: Path) -> list[Block]:
    """Return the fenced blocks of a page."""
    text = page.read_text(encoding="utf-8")
    return [
        Block(found[1], found[2], text.count("\n", 0, found.start()) + 2)
        for found in BLOCK.finditer(text)
    ]


def as_promised(line: str) -> bool:
    """Run a command; return whether its exit code is that of a comment "exit code N", else 0."""
    told = re.search(r"# .*exit code (\d)", line)
    program, *words = shlex.split(line, comments=True)
    if program == "carom":
        code = command(words)
    else:
        code = subprocess.run([sys.executable, *words], check=False).returncode
    return code == int(told[1] if told else 0)


def printed(block: Block, page: Path, names: dict[str, Any]) -> str:
    """Run a block where we are, and return what it printed."""
    caught = StringIO()
    with redirect_stdout(caught):
        if block.language == "python":  # behind empty lines, so that errors name lines of the page
            source = "\n" * (block.line - 1) + block.text
            exec(compile(source, str(page), "exec"), names)
        for line in block.text.splitlines() if block.language == "sh" else ():
            if line.startswith(("carom ", "python ")) and not as_promised(line):
                raise RuntimeError(f"{page}, line {block.line}: failed, {line}")
    return caught.getvalue()


def run(page: Path, folder: Path) -> Iterator[tuple[int, str, str]]:
    """Run a page in a folder; yield the line, what was expected and what came where they differ."""
    names: dict[str, Any] = {"__name__": "__main__"}
    checker, came = OutputChecker(), ""
    with chdir(folder):
        for block in blocks(page):
            if block.file:
                Path(block.file).write_text(block.text, encoding="utf-8")
            elif block.language == "text":
                if not checker.check_output(block.text, came, ELLIPSIS):
                    yield block.line, block.text, came
            elif block.language in ("python", "sh"):
                came = printed(block, page, names)


def pictures(page: Path) -> list[Path]:
    """Return the pictures that the code of a page makes, as the page links them."""
    links = re.findall(r"\]\(([^)]+\.png)\)", page.read_text(encoding="utf-8"))
    own = [Path(link) for link in links if Path(link).parent.parts[-2:] == ("figures", page.stem)]
    return [Path(DOCS / "figures" / page.stem / link.name) for link in own]


def main() -> int:
    """Run the pages, store their pictures, and tell what differs."""
    import matplotlib

    matplotlib.use("agg")
    wrong = 0
    for page in [Path(name).resolve() for name in sys.argv[1:]] or PAGES:
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
