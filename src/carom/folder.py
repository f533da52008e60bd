"""Where the package is installed: the one path from which its files are found."""

from pathlib import Path

PACKAGE = Path(__file__).parent
DATA = PACKAGE / "data"
