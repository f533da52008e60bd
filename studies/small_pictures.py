"""Pictures as pages show them: at two thirds of their size, with few colours."""

from pathlib import Path

from PIL import Image


def store_small(source: Path, target: Path, all_colors: bool = False) -> None:
    """Store a picture with no more pixels than a page shows; lines need few colours, maps all."""
    figure = Image.open(source).convert("RGB")
    size = (2 * figure.width // 3, 2 * figure.height // 3)
    small = figure.resize(size, Image.Resampling.LANCZOS)
    target.parent.mkdir(parents=True, exist_ok=True)
    if not all_colors:
        small = small.quantize(256, dither=Image.Dither.NONE)
    small.save(target, optimize=True)
