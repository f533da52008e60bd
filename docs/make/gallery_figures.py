"""Draw the figures of examples/README.md: its scripts' own, at two thirds of their size.

python docs/make/gallery_figures.py
"""

import runpy
import tempfile
from pathlib import Path

from run_pages import DOCS, store_small

MAPS = {"contact_through_impact", "patch_in_microslip"}  # of tractions: they keep all colours


def main() -> None:
    """Draw every figure that is there anew."""
    for figure in sorted(DOCS.glob("figures/gallery/*.png")):
        with tempfile.TemporaryDirectory() as folder:
            script = runpy.run_path(str(DOCS.parent / "examples" / f"{figure.stem}.py"))
            print(f"{figure.stem}: {script['main'](folder)}")
            store_small(Path(folder) / figure.name, figure, all_colors=figure.stem in MAPS)


if __name__ == "__main__":
    main()
