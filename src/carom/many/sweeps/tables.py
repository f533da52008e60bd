"""Tables of cases from a CSV file or a mapping, and the table [sweep] of a case file."""

import hashlib
import re
from collections.abc import Hashable, Iterable, Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from carom.bodies.cases import SWEEP_TABLE, Case
from carom.io.cells import is_missing
from carom.io.heads import TableFormat, table_format
from carom.io.tables import read_table
from carom.io.user_table import UserTable, column_in_si
from carom.many.sweeps import inputs as known
from carom.many.sweeps.designs import Box, Design, Grid, LatinHypercube
from carom.quantities.glossary import GLOSSARY
from carom.quantities.refusals import Faults, InputError, checked_type, heading, refusal, refuse
from carom.quantities.texts import Unreadable, factor


@dataclass(frozen=True, eq=False, init=False)
class Table(Design):
    """Cases from a table, one per row.

    Parameters
    ----------
    source : str, Path or mapping
        A file, CSV or a spreadsheet, or a mapping of columns. Columns have the names of inputs,
        with a unit where there is one: "speed [km/h]"; a cell may have a unit of its own: "5 mm". A
        row with a cell that cannot be read gets a status that says so.
    columns : mapping or str, optional
        Inputs by the heads of columns that have other names, e.g. {"omega [rpm]": "spin"}; or a
        TOML file with them in a table [columns].
    sheet : str, optional
        The sheet of a spreadsheet, if several could be meant.
    decimal : str, optional
        "," or ".", the decimal sign of a file where numbers such as 1,234 leave it open.

    Raises
    ------
    InputError
        If the file cannot be read, an input is not known or given in two ways, a unit does not
        fit, or columns differ in length.

    Examples
    --------
    >>> carom.Table({"angle [deg]": [10, 20], "friction": [0.1, 0.2]}).names
    ('angle', 'friction')
    """

    _notes: tuple[str, ...] = field(repr=False)

    def __init__(
        self,
        source: str | Path | Mapping[str, Any],
        columns: Mapping[str, str] | str | Path | None = None,
        *,
        sheet: str | None = None,
        decimal: str | None = None,
    ) -> None:
        how: dict[str, Any] = {"sheet": sheet, "decimal": decimal, "what": "table", "fewest": 1}
        table = read_table(source, columns, **how, lenient=True)
        super().__init__(*_read(table), _notes=table.notes)

    def _doubts(self) -> tuple[str, ...]:
        return (*self._notes, *super()._doubts())

    @property
    def shape(self) -> tuple[int, ...]:
        return (self._by_input[self.names[0]].size,)

    def inputs(self, box: Box) -> dict[str, NDArray[Any]]:
        return {name: values[box[0]] for name, values in self._by_input.items()}

    def _description(self) -> dict[str, Any]:
        digest = hashlib.sha256()
        for values in self._by_input.values():
            digest.update(np.ascontiguousarray(values).tobytes())
        choices = {
            name: [one.description() for one in some] for name, some in self._choices.items()
        }
        whole = {"inputs": list(self.names), "rows": self.shape[0], "choices": choices}
        return {"kind": "table", **whole, "sha256": digest.hexdigest()}


def _read(table: UserTable) -> tuple[known.Choices, dict[str, NDArray[Any]]]:
    """Return what the codes of names stand for, and the inputs by name."""
    inputs: dict[str, NDArray[Any]] = {}
    choices: dict[str, tuple[known.Choice, ...]] = {}
    unknown = [name for name in table.names if name not in known.INPUTS] or [""]
    with Faults() as faults:
        table = table.told(faults)
        for name in table.names:
            with faults.catching():
                known.checked_names([name], listing=name == unknown[0])
                _, cells, unit, *_ = table.column(name)
                if name in known.CHOSEN:
                    inputs[name], choices[name] = _chosen(name, cells)
                else:
                    key = known.leaf(name)
                    inputs[name] = column_in_si(key, GLOSSARY[key].unit, unit, cells)[0]
                    _refuse_units(table, name, inputs[name])
        known.refuse_contradictions(table.names)
        faults.settle()
        _refuse_words(table, [name for name in inputs if name not in known.CHOSEN])
    return choices, inputs


def _refuse_units(table: UserTable, name: str, values: NDArray[Any]) -> None:
    """Raise InputError for a cell that is a unit: what stands below it would be read without."""
    cells = table.cells[name].cells
    for place in np.flatnonzero(np.isnan(values)) if isinstance(cells, list) else ():
        text = str(cells[place]).strip("[]() ")
        with suppress(Unreadable):
            if text and factor(text, GLOSSARY[known.leaf(name)].unit):
                raise InputError(
                    f"{name}: {text!r} in {table.one(int(place))} is a unit without a number; "
                    f"write it into the head of the column, '{name} [{text}]'"
                )


def _refuse_words(table: UserTable, names: list[str]) -> None:
    """Raise InputError if the first row is none: words where there are numbers below."""
    first = [table.cells[name].cells[0] for name in names]
    words = [cell for cell in first if isinstance(cell, str) and not is_missing(cell)]
    if words and not re.search(r"\d", "".join(map(str, first))):
        allowed = "it has no number; leave it out, and write units into the head, 'speed [mm/s]'"
        raise refusal(f"table, {table.one(0)}", ", ".join(words), allowed)


def _chosen(name: str, cells: Any) -> tuple[NDArray[Any], tuple[known.Choice, ...]]:
    """Return the codes of a column of names, and what they stand for."""
    plain = (cell.strip() if isinstance(cell, str) else cell for cell in cells)
    listed = np.fromiter(plain, dtype=object, count=len(cells))
    try:
        codes, values = pd.factorize(listed)
    except TypeError:
        strange = next((cell for cell in cells if not isinstance(cell, Hashable)), cells)
        raise refusal(name, strange, "a column of names must hold texts, or materials") from None
    read: dict[int, known.Choice] = {}
    for i, value in enumerate(values):
        with suppress(InputError):
            read[i] = known.read_choice(name, value)
    choices = known.checked_choices(name, list(read.values())) if read else ()
    place = np.full(len(values) + 1, known.UNREADABLE, dtype=known.CODE)
    place[list(read)] = np.arange(len(choices))
    return place[codes], choices


EXAMPLE = 'angle = {from = "0 deg", to = "85 deg", points = 86}'


def plan(case: Case, path: Path, how: TableFormat | None = None) -> tuple[Design, list[str] | None]:
    """Return the design and the outputs that a case file asks for."""
    table = case.get(SWEEP_TABLE)
    if not isinstance(table, Mapping):
        raise InputError(f"{SWEEP_TABLE}: missing in {path}; add [sweep.axes] with {EXAMPLE}")
    outputs = table.get("outputs")
    if "outputs" in table:
        checked_type("outputs", outputs, list, 'must be a list of names, e.g. ["rebound_angle"]')
    return _design(table, path, how or table_format(None)), outputs


def _design(table: Mapping[str, Any], path: Path, how: TableFormat) -> Design:
    if "table" in table:
        _refuse(table, ("samples", "seed", "axes"), "a table of cases has none; leave it out")
        name = checked_type("table", table["table"], str, "must be the name of a CSV file")
        words = 'must be a table, e.g. {omega = "spin"}, or the name of a TOML file'
        columns = checked_type("columns", table.get("columns", {}), (Mapping, str), words)
        if isinstance(columns, str):
            columns = str(path.parent / columns)
        own = table_format(columns, table.get("sheet"), table.get("decimal"))
        names = {**own.columns, **how.columns}
        sheet, decimal = how.sheet or own.sheet, how.decimal or own.decimal
        return Table(path.parent / name, names, sheet=sheet, decimal=decimal)
    for_tables = {name: value for name, value in how._asdict().items() if value}
    of_tables = "is for a table of cases; leave it out"
    _refuse({**table, **for_tables}, TableFormat._fields, f"it {of_tables}")
    allowed = f"must be a table, [sweep.axes], with {EXAMPLE}"
    axes = checked_type("axes", table.get("axes"), Mapping, allowed)
    if "samples" in table:
        return LatinHypercube(_flat(axes), samples=table["samples"], seed=table.get("seed", 0))
    _refuse(table, ("seed",), "a grid has none; leave it out")
    return Grid(_flat(axes))


def _refuse(table: Mapping[str, Any], names: Iterable[str], allowed: str) -> None:
    refuse(*(refusal(name, table[name], allowed) for name in names if name in table))


def _flat(axes: Mapping[str, Any], prefix: str = "") -> dict[str, Any]:
    """Return axes by dotted names; first.radius without quotes is a table in a table for TOML."""
    flat: dict[str, Any] = {}
    for name, axis in axes.items():
        nested = isinstance(axis, Mapping) and axis and not axis.keys() & {"from", "to", "points"}
        more = _flat(axis, f"{prefix}{name}.") if nested else {prefix + name: axis}
        words = "it is given twice in [sweep.axes]; leave one of them out"
        refuse(*(f"{heading(twice)}: {words}" for twice in sorted(flat.keys() & more.keys())))
        flat |= more
    return flat
