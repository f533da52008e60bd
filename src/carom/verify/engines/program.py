"""What DEM programs have in common: where they are, how they are called."""

from __future__ import annotations

import re
import shutil
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar


@dataclass(frozen=True)
class Program:
    """A program at a path, else the one that is found by its name.

    Parameters
    ----------
    path : str or Path, optional
        Where the program is.
    """

    path: str | Path | None = None

    called: ClassVar[str]  # its executable
    arguments: ClassVar[tuple[str, ...]]  # that run its inputs
    advice: ClassVar[str]  # how to get it
    greeting: ClassVar[str]  # the pattern in which it prints its version

    @property
    def remedy(self) -> str:
        """What to do where it is absent."""
        if self.path is not None:
            return f"{str(self.path)!r} is not an executable; give another path"
        return f"not found; {self.advice}"

    def executable(self) -> Path | None:
        """Return where the program is, or None."""
        found = shutil.which(self.called if self.path is None else self.path)
        return Path(found).absolute() if found else None

    def command(self, folder: Path) -> list[str]:
        """Return the command that runs the inputs in a folder."""
        return [str(self.executable() or self.called), *self.arguments]

    def version(self, printed: str) -> str:
        """Return the version that the program has printed."""
        found = re.search(self.greeting, printed, re.MULTILINE)
        return found.group(1) if found else "unknown"
