"""What the Cookbook does beside running the examples: their pictures, and their order."""

from pathlib import Path
from shutil import copy, rmtree
from typing import Any

from sphinx_gallery.scrapers import figure_rst

EXAMPLES = Path(__file__).parents[2] / "examples"
TAKEN: dict[Path, int] = {}  # pictures, and when they were stored


def take_picture(block: Any, variables: dict[str, Any], gallery: dict[str, Any]) -> str:
    """Take what a cell has drawn, a file of its script's name; return how a page shows it."""
    script = Path(variables["src_file"])
    written = [path for path in map(script.with_suffix, (".png", ".gif")) if path.exists()]
    stored = {path: path.stat().st_mtime_ns for path in written}
    new = [path for path in written if TAKEN.get(path) != stored[path]]
    TAKEN.update(stored)
    places = map(Path, variables["image_path_iterator"])
    taken = [copy(path, next(places).with_suffix(path.suffix)) for path in new]
    return figure_rst(taken, gallery["src_dir"])


def clear(gallery: dict[str, Any], script: str | None, when: str) -> None:
    """Remove what else a script has left beside it: tables, reports, stores of its name."""
    for path in EXAMPLES.glob(f"{Path(script).stem}.*") if script else ():
        if path.is_dir():
            rmtree(path)
        elif path.name != Path(script).name:
            path.unlink()


def place_in_index(script: str) -> int:
    """Return where the index of the examples names a script: their order."""
    return (EXAMPLES / "README.md").read_text(encoding="utf-8").find(f"[{Path(script).name}]")
