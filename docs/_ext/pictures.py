"""What the gallery does beside running the examples: their pictures, and where they are."""

import builtins
from pathlib import Path
from shutil import move
from typing import Any

from sphinx_gallery.scrapers import figure_rst

EXAMPLES = Path(__file__).parents[2] / "examples"


def take_picture(block: Any, variables: dict[str, Any], gallery: dict[str, Any]) -> str:
    """Take what a script has drawn, a file of its own name; return how a page shows it."""
    script = Path(variables["src_file"])
    taken = []
    for suffix in (".png", ".gif"):
        written = script.with_suffix(suffix)
        if written.exists():
            place = Path(next(variables["image_path_iterator"])).with_suffix(suffix)
            taken.append(move(written, place))
    return figure_rst(taken, gallery["src_dir"])


def give_file(gallery: dict[str, Any], script: str | None) -> None:
    """Let a script know where it is: the gallery runs its text without `__file__`."""
    vars(builtins)["__file__"] = str(EXAMPLES / (script or ""))


class IndexOrder:
    """The order of the examples: that of their index, as a key to sort by."""

    def __init__(self, folder: str) -> None:
        self.index = (EXAMPLES / "README.md").read_text(encoding="utf-8")

    def __repr__(self) -> str:  # it is part of what decides whether the gallery is built anew
        return "IndexOrder"

    def __call__(self, script: str) -> int:
        return self.index.find(f"[{script}]")
