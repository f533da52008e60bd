"""The tree of docs/architecture.md, from the first lines of the sources; --files: every file."""

import ast
import re
import sys
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).parents[2]
PAGE = ROOT / "docs/architecture.md"
LISTING = re.compile(r"(?<=<!-- tree -->\n).*?(?=<!-- end of the tree -->)", re.DOTALL)


def first_line(path: Path) -> str:
    """Return what a source file says of itself."""
    text = ast.get_docstring(ast.parse(path.read_text(encoding="utf-8"))) or ""
    return text.partition("\n")[0].rstrip(".")


def tree(folder: Path, files: bool = False, depth: int = 1) -> Iterator[str]:
    """Return a line for each package within a folder, and for each module if files are wanted."""
    for path in sorted(folder.iterdir()):
        head = path / "__init__.py" if path.is_dir() else path
        module = path.suffix == ".py" and path.name != "__init__.py"
        if head.is_file() and (path.is_dir() or (files and module)):
            name = path.name + "/" * path.is_dir()
            yield f"{'  ' * depth + name:25} {first_line(head)}"
            yield from tree(path, files, depth + 1) if path.is_dir() else ()


def page(text: str) -> str:
    """Return the text of the page with the tree as it is now."""
    lines = "\n".join(("src/carom/", *tree(ROOT / "src/carom")))
    return LISTING.sub(lambda _: f"```text\n{lines}\n```\n", text)


if __name__ == "__main__":
    if "--files" in sys.argv:
        print(*tree(ROOT / "src/carom", files=True), sep="\n")
    else:
        PAGE.write_text(page(PAGE.read_text(encoding="utf-8")), encoding="utf-8")
