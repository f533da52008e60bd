"""Files that a command reads and writes: none of them twice."""

from collections.abc import Mapping
from itertools import combinations
from pathlib import Path

from carom.quantities import refusal


def refuse_same(files: Mapping[str, str | Path | None]) -> None:
    """Raise InputError if two of the files, by what they are for, are one."""
    given = {name: Path(file).resolve() for name, file in files.items() if file is not None}
    for (one, path), (other, same) in combinations(given.items(), 2):
        if path == same:
            raise refusal(other, str(files[other]), f"it is the file of {one}; give another name")
