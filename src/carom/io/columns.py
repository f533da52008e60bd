"""Reading the columns of a user's table in SI units, and telling those that are not known."""

from collections.abc import Collection, Iterable
from contextlib import suppress
from dataclasses import replace
from difflib import get_close_matches
from math import nan, pi
from typing import Any

import numpy as np

from carom.io.tables import GAP
from carom.io.user_table import UserTable, spelled
from carom.quantities.arrays import Array, in_unit
from carom.quantities.faults import Faults
from carom.quantities.glossary import GLOSSARY
from carom.quantities.refusals import InputError
from carom.quantities.symbols import meant
from carom.quantities.texts import UNCHANGED
from carom.quantities.units import PURE, WHY_POSITIVE, factor_of, number

ERROR = "_error"  # ends the name of a column of standard deviations
DELETE = "correct or delete it"
EMPTY = ("", "nan")
HEIGHTS = ("drop_height", "rebound_height")  # which are measured in cm and mm as well
HIGHEST = 3.0  # m, of a drop that is given without a unit
NEAR = 0.8  # similarity of names from which a column is taken for a misspelt one
UNITS = {"_deg": "deg", "_rad_s": "rad/s", "_rad": "rad", "_rpm": "rpm", "_m_s": "m/s"}  # in names


def in_units(
    table: UserTable, known: Iterable[str], gaps: Collection[str] = (), faults: Faults | None = None
) -> UserTable:
    """Return a table with those columns in SI units whose names are known; the others are NaN.

    Columns without a unit are SI; heights of drops in files need one. In columns of `gaps`, and of
    their errors, a cell "-" stands for what was not measured: NaN.

    Adds to the faults, which are raised as InputError if they are not given, a cell that is not a
    number, a unit that does not fit, an error that has no unit where its column has one, angles
    that cannot be in rad, and speeds of bodies that do not approach.

    Examples
    --------
    >>> from carom.io.columns import in_units
    >>> from carom.io.tables import read_table
    >>> table = read_table({"angle [deg]": [0.0, 60.0], "spin_out [rpm]": ["-", -600]})
    >>> given = in_units(table, ("angle", "spin_out"), gaps=("spin_out",))
    >>> given["angle"].round(4), given["spin_out"].round(2)
    (array([0.    , 1.0472]), array([   nan, -62.83]))
    """
    columns = {name: np.full(len(table), nan) for name in table.names}
    read = replace(table, columns=columns, faults=faults or Faults())
    wanted = {*known}
    for name in filter(wanted.__contains__, table.names):
        try:
            _check_error_unit(name, table)
            columns[name] = _column(name, table, entry(name) in gaps)
        except InputError as error:
            read.faults.add(str(error))
        else:
            _check_values(name, read)
    return read


def with_errors(names: Iterable[str]) -> tuple[str, ...]:
    """Return names of columns, and of the columns of their standard deviations.

    Examples
    --------
    >>> from carom.io.columns import with_errors
    >>> with_errors(["angle", "spin_out"])
    ('angle', 'angle_error', 'spin_out', 'spin_out_error')
    """
    return tuple(each for name in names for each in (name, name + ERROR))


def others(table: UserTable, known: Iterable[str], faults: Faults | None = None) -> tuple[str, ...]:
    """Return the columns that are not known and mean nothing here, for a user to be told.

    Adds to the faults, which are raised as InputError if they are not given, one that is likely to
    be a known one misspelt, with the nearest, and an error without its column.

    Examples
    --------
    >>> from carom.io.columns import others
    >>> from carom.io.tables import read_table
    >>> others(read_table({"angle": [0.1], "run": [1]}), ["angle", "spin_out"])
    ('run',)
    """
    known, faults = list(known), faults or Faults()
    unknown = tuple(name for name in table.names if name not in known)
    for name in unknown:
        if hint := _likely(name, known):
            faults.add(f"{name}: unknown column; did you mean {hint!r}?")
    for name in table.names:
        if entry(name) not in table.names and name not in unknown:
            faults.add(f"{name}: its column {entry(name)!r} is missing")
    return unknown


def entry(name: str) -> str:
    """Return the name in the glossary of what a column holds, be it values or their errors.

    Examples
    --------
    >>> from carom.io.columns import entry
    >>> entry("spin_out"), entry("spin_out_error")
    ('spin_out', 'spin_out')
    """
    return name.removesuffix(ERROR)


def _likely(name: str, known: list[str]) -> str:
    """Return the head of a known column that another one stands for, or nothing."""
    plain = name.lower().replace(" ", "_").replace("-", "_")
    unit = next((end for end in UNITS if plain.endswith(end)), "")
    plain = plain.removesuffix(unit)
    end = ERROR if plain.endswith(ERROR) else ""
    plain = plain.removesuffix(ERROR)
    stands = meant(plain, known) or plain
    found = get_close_matches(stands + end, known, n=1, cutoff=NEAR)
    return spelled(found[0]) + (f" [{UNITS[unit]}]" if unit else "") if found else ""


def _check_error_unit(name: str, table: UserTable) -> None:
    """Raise InputError for an error whose unit can only be guessed."""
    whole = entry(name)
    unit = str(table.cells[whole].unit) if whole in table.cells else ""
    if name != whole and unit not in ("", *PURE) and not str(table.cells[name].unit):
        raise InputError(f"{name}: no unit, but {whole} is in {unit}; write '{name} [{unit}]'")


def _check_values(name: str, table: UserTable) -> None:
    """Add to the faults what cannot be, as it is of another unit, or of bodies that part."""
    values, unit = table[name], str(table.cells[name].unit)
    if name in WHY_POSITIVE:
        table.refuse(name, values <= 0.0, f"must be positive{WHY_POSITIVE[name]}")
    if entry(name) in HEIGHTS:
        cells = table.cells[name].cells
        bare = not isinstance(cells, list) or any(
            str(cell).strip()[-1:].isdigit() for cell in cells
        )
        if bare and not unit and (table.word == "line" or np.any(np.abs(values) > HIGHEST)):
            heads = " or ".join(f"'{name} [{each}]'" for each in ("m", "cm", "mm"))
            table.faults.add(f"{name}: no unit, and heights may be in m, cm or mm; write {heads}")
    if name in GLOSSARY and GLOSSARY[name].unit == "rad":
        allowed = "must be below pi/2, 90 deg, from the normal"
        if not unit:
            allowed += f"; for degrees write '{name} [deg]' at the head of the column"
        elif unit in ("rad", "radian", "radians"):
            allowed += f"; the head of the column says {unit}; for degrees write '{name} [deg]'"
        table.refuse(name, np.abs(values) >= 0.5 * pi, allowed)


def _column(name: str, table: UserTable, open_ended: bool) -> Array:
    """Return a column in SI units, or raise InputError for what is not a number in it."""
    _, cells, unit, _ = table.column(name)
    gap = np.zeros(len(cells), dtype=bool)
    if open_ended and isinstance(cells, list):
        gap[:] = [isinstance(cell, str) and cell.strip() == GAP for cell in cells]
        cells = [nan if empty else cell for cell, empty in zip(cells, gap, strict=True)]
    values, reason = column_in_si(spelled(name), GLOSSARY[entry(name)].unit, unit, cells)
    missing = ~np.isfinite(values) & ~gap
    if missing.any():
        todo = f"write '{GAP}' where nothing was measured" if open_ended else DELETE
        message = f"not a number in {table.named(missing)}; {reason or todo}"
        raise InputError(f"{spelled(name)}: {message}")
    return values


def column_in_si(name: str, si: str, unit: Any, cells: Any) -> tuple[Array, str]:
    """Return a column in SI units, NaN where there is no number, and what is wrong there first.

    A bare number is in the unit of the column, SI if that is empty; a cell may have its own.

    Raises InputError if the unit of the column does not fit.

    Examples
    --------
    >>> from carom.io.columns import column_in_si
    >>> column_in_si("radius", "m", "mm", [5, "6", "0.7 cm", ""])[0]
    array([0.005, 0.006, 0.007,   nan])
    """
    own = factor_of(name, unit, si) if str(unit) else UNCHANGED
    with suppress(InputError):  # where a number overflows, it is sought
        if isinstance(cells, np.ndarray):
            return in_unit(name, cells, own), ""
    values, reason = np.full(len(cells), nan), ""
    for i, cell in enumerate(cells):
        if cell is None or (isinstance(cell, str | float) and str(cell).strip().lower() in EMPTY):
            continue
        try:
            values[i] = number(name, cell, si, own)
        except InputError as error:
            reason = reason or str(error)
    return values, reason
