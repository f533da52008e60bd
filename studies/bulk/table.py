"""The table of the study: a line for each number that a simulation gave."""

import csv
from collections.abc import Iterable
from pathlib import Path

from bulk.experiment import Found, Run
from carom.io.files import replace_whole

TABLE = Path(__file__).parents[1] / "bulk.csv"
HEAD = """\
# simulations of packings, flows, drums and gases by six contact laws; docs/bulk.md
# made by studies/bulk_study.py; units: mass and diameter of a sphere and Young's modulus are 1
# at: strain amplitude, inertial number, Froude number; size: spheres, of a drum its diameter;
# step: time step over that of the study; where: time in durations of an impact, else as `at`
"""
COLUMNS = (*Run._fields, *Found._fields)
Table = dict[Run, list[Found]]


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
