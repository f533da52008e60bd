"""Draw the figures of examples/README.md: its scripts' own, at two thirds of their size.

python docs/make_gallery_figures.py
"""

import runpy
import tempfile
from pathlib import Path

from PIL import Image

ROOT = Path(__file__).parents[1]
SHOWN = ROOT / "docs" / "figures" / "gallery"
COLORS = 256  # enough for lines and bands; a map of tractions keeps all of its own
MAPS = {"patch_in_microslip"}


def shrunk(path: Path) -> Image.Image:
    """Return a figure at two thirds of its size."""
    figure = Image.open(path).convert("RGB")
    size = (2 * figure.width // 3, 2 * figure.height // 3)
    small = figure.resize(size, Image.Resampling.LANCZOS)
    return small if path.stem in MAPS else small.quantize(COLORS, dither=Image.Dither.NONE)


def main() -> None:
    """Draw every figure that is there anew."""
    for figure in sorted(SHOWN.glob("*.png")):
        with tempfile.TemporaryDirectory() as folder:
            script = runpy.run_path(str(ROOT / "examples" / f"{figure.stem}.py"))
            print(f"{figure.stem}: {script['main'](folder)}")
            shrunk(Path(folder) / figure.name).save(figure, optimize=True)


if __name__ == "__main__":
    main()
