"""A simulation of the study: its name, LAMMPS on its input, the table of what it gave."""

import csv
import subprocess
import sysconfig
from collections.abc import Iterable
from pathlib import Path
from typing import NamedTuple

from carom.io.files import replace_whole

LMP = Path(sysconfig.get_path("scripts"), "lmp")
COMMON = """\
units lj
atom_style sphere
newton off
comm_modify vel yes
neigh_modify every 1 delay 0 check yes
"""
TABLE = Path(__file__).parents[1] / "bulk.csv"
HEAD = """\
# simulations of packings, flows, drums and gases by six contact laws; docs/bulk_study.md
# made by studies/bulk_study.py; units: mass and diameter of a sphere and Young's modulus are 1
# at: strain amplitude, inertial number, Froude number; size: spheres, of a drum its diameter;
# step: time step over that of the study; where: time in durations of an impact, else as `at`
"""


class Run(NamedTuple):
    """One simulation: `at` is what is varied beside law and friction, `step` the time step over
    that of the study."""

    experiment: str
    law: str
    friction: float
    restitution: float
    at: float
    seed: int
    size: int
    step: float = 1.0


class Found(NamedTuple):
    """A number that a simulation gave: `where` in time or strain."""

    quantity: str
    where: float
    value: float


COLUMNS = (*Run._fields, *Found._fields)
Table = dict[Run, list[Found]]


def run(text: str, folder: Path) -> str:
    """Run an input in a folder and return what LAMMPS printed, or raise RuntimeError."""
    command = [str(LMP), "-log", "none"]
    done = subprocess.run(
        command, cwd=folder, input=COMMON + text, capture_output=True, text=True, check=False
    )
    if done.returncode:
        raise RuntimeError(done.stdout[-400:] + done.stderr[-400:])
    return done.stdout


def read() -> Table:
    """Return the table, empty if there is none."""
    table: Table = {}
    if not TABLE.exists():
        return table
    lines = [line for line in TABLE.read_text().splitlines() if not line.startswith("#")]
    for row in csv.DictReader(lines):
        asked = Run(*(kind(row[name]) for name, kind in Run.__annotations__.items()))
        found = Found(row["quantity"], float(row["where"]), float(row["value"]))
        table.setdefault(asked, []).append(found)
    return table


def write(table: Table, order: Iterable[Run]) -> None:
    """Store the table whole, in the order of the plan."""
    rows = [
        [*map(str, asked), found.quantity, f"{found.where:g}", f"{found.value:.6g}"]
        for asked in order
        for found in table.get(asked, ())
    ]
    text = HEAD + "\n".join(",".join(row) for row in [list(COLUMNS), *rows]) + "\n"
    replace_whole(TABLE, lambda file: file.write_text(text))
