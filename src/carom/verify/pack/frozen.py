"""The frozen part of the benchmark pack: files of the package, copied as they are.

Cases, inputs, reference numbers and texts. What a number is does not depend on the machine that
writes a pack; to change one takes a new version of the pack.
"""

import csv
import json
import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from io import StringIO
from pathlib import Path
from typing import Any

import numpy as np

from carom.folder import DATA
from carom.quantities.arrays import Array

VERSION = "1"
ACCURACY = 1e-10  # of psi_2, in max(1, |psi_1|); of forces and speeds in a history, in their scales
BYTECODE_FOLDER = "__pycache__"  # which installers add
CASE, INPUTS, REFERENCE = "case.toml", "results.csv", "reference.csv"  # in the folder of a set


@dataclass(frozen=True)
class DecimalTable:
    """Columns of decimals as they are printed, and lines of notes above them."""

    notes: tuple[str, ...]
    columns: Mapping[str, Sequence[str]]

    def as_csv(self) -> str:
        """Return the table as CSV below its notes, which start with #."""
        stream = StringIO()
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow(self.columns)
        writer.writerows(zip(*self.columns.values(), strict=True))
        return "".join(f"# {note}\n" for note in self.notes) + stream.getvalue()

    def as_json(self) -> str:
        """Return the table as JSON: notes, and columns by name; what is no number stays text."""
        columns = {name: [_parsed(cell) for cell in cells] for name, cells in self.columns.items()}
        inside = ",\n".join(f"  {json.dumps(name)}: {json.dumps(v)}" for name, v in columns.items())
        notes = json.dumps(list(self.notes), ensure_ascii=False)
        return f'{{"notes": {notes},\n "columns": {{\n{inside}\n}}}}\n'

    def numbers(self, name: str) -> Array:
        return np.array([float(cell) for cell in self.columns[name]])


def read_table(text: str) -> DecimalTable:
    """Return the table of which `DecimalTable.as_csv` made this text."""
    lines = text.splitlines()
    notes = tuple(line[1:].removeprefix(" ") for line in lines if line.startswith("#"))
    head, *rows = csv.reader(line for line in lines if not line.startswith("#"))
    return DecimalTable(notes, {name: [row[i] for row in rows] for i, name in enumerate(head)})


@lru_cache(maxsize=1)
def frozen_files() -> dict[str, str]:
    """Return the text of each frozen file by its path in the pack, in order."""
    root = DATA / "benchmarks" / "pack"
    return dict(sorted(_texts(root, "").items()))


def folders_with(name: str) -> list[str]:
    """Return the folders of the pack that hold a frozen file of this name."""
    ending = f"/{name}"
    return [path.removesuffix(ending) for path in frozen_files() if path.endswith(ending)]


def inputs_of(folder: str) -> DecimalTable:
    """Return the inputs of a set: its table of results, the outputs blank."""
    return read_table(frozen_files()[f"{folder}/{INPUTS}"])


def case_of(folder: str) -> dict[str, Any]:
    """Return the case of a set."""
    return tomllib.loads(frozen_files()[f"{folder}/{CASE}"])


def title_of(folder: str) -> tuple[str, ...]:
    """Return what a set is, in words: the first lines of its case."""
    lines = frozen_files()[f"{folder}/{CASE}"].splitlines()
    return tuple(line.removeprefix("# ") for line in lines if line.startswith("# "))


def _texts(folder: Path, prefix: str) -> dict[str, str]:
    texts: dict[str, str] = {}
    for entry in folder.iterdir():
        path = f"{prefix}{entry.name}"
        if entry.is_dir():
            texts |= {} if entry.name == BYTECODE_FOLDER else _texts(entry, f"{path}/")
        else:
            texts[path] = entry.read_bytes().decode("utf-8")
    return texts


def _parsed(cell: str) -> float | str | None:
    try:
        return float(cell) if cell else None
    except ValueError:
        return cell
