"""What the Cookbook does beside running the examples: their pictures, and their order."""

from pathlib import Path
from shutil import move, rmtree
from typing import Any

from sphinx_gallery.scrapers import figure_rst

EXAMPLES = Path(__file__).parents[2] / "examples"
PICTURES = (".png", ".gif")


def take_picture(block: Any, variables: dict[str, Any], gallery: dict[str, Any]) -> str:
    """Take what a script has drawn, a file of its own name; return how a page shows it."""
    script = Path(variables["src_file"])
    places = map(Path, variables["image_path_iterator"])
    taken = []
    for path in sorted(script.parent.glob(f"{script.stem}.*")):
        if path.suffix in PICTURES:
            taken.append(move(path, next(places).with_suffix(path.suffix)))
        elif path.is_dir():
            rmtree(path)
        elif path != script:
            path.unlink()
    return figure_rst(taken, gallery["src_dir"])


def place_in_index(script: str) -> int:
    """Return where the index of the examples names a script: their order."""
    return (EXAMPLES / "README.md").read_text(encoding="utf-8").find(f"[{Path(script).name}]")
