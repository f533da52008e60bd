"""Pictures as pages show them: at two thirds of their size, with few colours."""

from io import BytesIO
from pathlib import Path

from matplotlib.figure import Figure
from PIL import Image

from carom.plots.look import DPI


def store_small(source: Path | Figure, target: Path, all_colors: bool = False) -> None:
    """Store a picture with no more pixels than a page shows; lines need few colours, maps all."""
    large: Path | BytesIO = BytesIO() if isinstance(source, Figure) else source
    if isinstance(source, Figure):
        source.savefig(large, format="png", dpi=DPI)
    picture = Image.open(large).convert("RGB")
    size = (2 * picture.width // 3, 2 * picture.height // 3)
    small = picture.resize(size, Image.Resampling.LANCZOS)
    target.parent.mkdir(parents=True, exist_ok=True)
    if not all_colors:
        small = small.quantize(256, dither=Image.Dither.NONE)
    small.save(target, optimize=True)
