"""Tables of decimal numbers, each with its error, as CSV and JSON."""

import csv
import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from decimal import ROUND_UP, Context, Decimal
from io import StringIO

import numpy as np
from numpy.typing import ArrayLike

from carom.quantities.arrays import Array

DIGITS = 12  # of every number
ERROR_DIGITS = Context(prec=2, rounding=ROUND_UP)
ERROR = "_error"  # the column of errors of a column ends so

Columns = dict[str, list[str]]


@dataclass(frozen=True)
class DecimalTable:
    """Columns of decimals as they are printed, and lines of notes above them."""

    notes: tuple[str, ...]
    columns: Mapping[str, Sequence[str]]

    @property
    def rows(self) -> list[tuple[str, ...]]:
        """The cells, row by row."""
        return list(zip(*self.columns.values(), strict=True))

    def as_csv(self) -> str:
        """Return the table as CSV below its notes, which start with #."""
        stream = StringIO()
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow(self.columns)
        writer.writerows(self.rows)
        return "".join(f"# {note}\n" for note in self.notes) + stream.getvalue()

    def as_json(self) -> str:
        """Return the table as JSON: notes, and columns by name; what is no number stays text."""
        columns = {name: [_parsed(cell) for cell in cells] for name, cells in self.columns.items()}
        inside = ",\n".join(f"  {json.dumps(name)}: {json.dumps(v)}" for name, v in columns.items())
        notes = json.dumps(list(self.notes), ensure_ascii=False)
        return f'{{"notes": {notes},\n "columns": {{\n{inside}\n}}}}\n'

    def numbers(self, name: str) -> Array:
        """Return a column as numbers."""
        return np.array([float(cell) for cell in self.columns[name]])


def read_table(text: str) -> DecimalTable:
    """Return the table of which `DecimalTable.as_csv` made this text.

    Examples
    --------
    >>> from carom.verify.pack.tables import read_table
    >>> table = read_table("# two impacts\\npsi_in,psi_out\\n0.5,0.05\\n1,-0.06\\n")
    >>> table.notes, table.numbers("psi_out")
    (('two impacts',), array([ 0.05, -0.06]))
    """
    lines = text.splitlines()
    notes = tuple(line[1:].removeprefix(" ") for line in lines if line.startswith("#"))
    head, *rows = csv.reader(line for line in lines if not line.startswith("#"))
    return DecimalTable(notes, {name: [row[i] for row in rows] for i, name in enumerate(head)})


def exact(name: str, values: ArrayLike) -> Columns:
    """Return a column of numbers that are given, not computed."""
    return {name: [_decimal(value) for value in _flat(values)]}


def uncertain(name: str, values: ArrayLike, errors: ArrayLike) -> Columns:
    """Return a column of computed numbers and one of their errors, rounding to 12 digits included.

    Examples
    --------
    >>> from carom.verify.pack.tables import uncertain
    >>> uncertain("psi_out", [-1.23456789012345], [1e-10])
    {'psi_out': ['-1.23456789012'], 'psi_out_error': ['1.1e-10']}
    """
    numbers = _flat(values)
    bounds = np.broadcast_to(_flat(errors), numbers.shape)
    cells = [_decimal(value) for value in numbers]
    sums = [bound + _half_unit(cell) for bound, cell in zip(bounds, cells, strict=True)]
    return {name: cells, name + ERROR: [_rounded_up(error) for error in sums]}


def _flat(values: ArrayLike) -> Array:
    return np.atleast_1d(np.asarray(values, dtype=np.float64))


def _decimal(value: float) -> str:
    return f"{value + 0.0:.{DIGITS}g}"  # + 0.0: no negative zero


def _half_unit(cell: str) -> float:
    """Return half a unit of the last of the digits."""
    number = Decimal(cell)
    return 0.5 * 10.0 ** (number.adjusted() - DIGITS + 1) if number else 0.0


def _rounded_up(error: float) -> str:
    return f"{float(ERROR_DIGITS.create_decimal(repr(float(error)))):.2g}"


def _parsed(cell: str) -> float | str | None:
    try:
        return float(cell) if cell else None
    except ValueError:
        return cell
