"""Reading a user's results in SI units: from a CSV file, a mapping of columns or a data frame."""

from collections.abc import Collection, Iterable, Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from difflib import get_close_matches
from math import nan, pi
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.io.tables import GAP, Cells, Rows, spelled
from carom.quantities.arrays import Array, in_unit
from carom.quantities.faults import Faults
from carom.quantities.glossary import GLOSSARY
from carom.quantities.refusals import InputError, nearest
from carom.quantities.symbols import meant
from carom.quantities.texts import UNCHANGED, Factor
from carom.quantities.units import PURE, factor_of, number

Mask = NDArray[np.bool_]

ERROR = "_error"  # ends the name of a column of standard deviations
DELETE = "correct or delete it"
EMPTY = ("", "nan")
HEIGHTS = ("drop_height", "rebound_height")  # which are measured in cm and mm as well
HIGHEST = 3.0  # m, of a drop that is given without a unit
NEAR = 0.8  # similarity of names from which a column is taken for a misspelt one
UNITS = {"_deg": "deg", "_rad_s": "rad/s", "_rad": "rad", "_rpm": "rpm", "_m_s": "m/s"}  # in names


@dataclass(frozen=True, eq=False)
class Results(Rows):
    """Columns of results in SI units, and what their rows are called: lines of a file, or rows."""

    columns: Mapping[str, Array]
    rows: NDArray[np.int64]
    word: str
    faults: Faults = field(default_factory=Faults)

    def __len__(self) -> int:
        return len(self.rows)

    def __getitem__(self, name: str) -> Any:
        return self.columns[name]

    def get(self, name: str, default: Any) -> Any:
        """Return a column, or something else if there is none of that name."""
        return self.columns.get(name, default)

    def require(self, *names: str) -> None:
        """Raise InputError for a column that is missing, with the nearest of those there are."""
        for name in names:
            if name not in self.columns:
                there = [spelled(key) for key in self.columns if key not in names]
                hint = nearest(spelled(name), there) or f"found {', '.join(there) or 'no other'};"
                needed = ", ".join(spelled(key) for key in names)
                raise InputError(f"{spelled(name)}: column missing; {hint} needed are {needed}")

    def require_rows(self, fewest: int) -> None:
        """Raise InputError if there are too few rows."""
        if len(self) < fewest:
            raise InputError(f"results: too few points: {len(self)}, at least {fewest} are needed")

    def refuse(self, name: str, bad: Mask, allowed: str) -> None:
        """Add to the faults that a column is bad in some rows, naming them."""
        if bad.any():
            value = f"{float(self[name][bad][0]):g}"
            where = self.named(bad)
            self.faults.add(f"{spelled(name)}: {value} in {where} cannot be used; {allowed}")


def in_units(
    table: Cells, known: Iterable[str], gaps: Collection[str] = (), faults: Faults | None = None
) -> Results:
    """Return the columns whose names are known, in SI units; the others are there, but NaN.

    Columns without a unit are SI; heights of drops in files need one. In columns of `gaps`, and of
    their errors, a cell "-" stands for what was not measured: NaN.

    Adds to the faults, which are raised as InputError if they are not given, a cell of them that is
    not a number, a unit that does not fit, an error that has no unit where its column has one, and
    angles that cannot be in rad.

    Examples
    --------
    >>> from carom.io.columns import in_units
    >>> from carom.io.tables import read_table
    >>> table = read_table({"angle [deg]": [0.0, 60.0], "spin_out [rpm]": ["-", -600]})
    >>> given = in_units(table, ("angle", "spin_out"), gaps=("spin_out",))
    >>> given["angle"].round(4), given["spin_out"].round(2)
    (array([0.    , 1.0472]), array([   nan, -62.83]))
    """
    columns = {name: np.full(len(table.rows), nan) for name in table.names}
    results = Results(columns, table.rows, table.word, faults or Faults())
    units = {name: str(column.unit) for name, column in table.columns.items()}
    wanted = set(known)
    read = [name for name in columns if name in wanted]
    for name in read:
        try:
            _check_error_unit(name, units)
            columns[name] = _column(name, table, entry(name) in gaps)
            if entry(name) in HEIGHTS:
                _check_height(name, table, columns[name])
        except InputError as error:
            results.faults.add(str(error))
    for name in read:
        if name in GLOSSARY and GLOSSARY[name].unit == "rad":
            _check_angle(results, name, units[name])
    return results


def with_errors(names: Iterable[str]) -> tuple[str, ...]:
    """Return names of columns, and of the columns of their standard deviations.

    Examples
    --------
    >>> from carom.io.columns import with_errors
    >>> with_errors(["angle", "spin_out"])
    ('angle', 'angle_error', 'spin_out', 'spin_out_error')
    """
    return tuple(each for name in names for each in (name, name + ERROR))


def others(table: Cells, known: Iterable[str], faults: Faults | None = None) -> tuple[str, ...]:
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


def _check_error_unit(name: str, units: Mapping[str, str]) -> None:
    """Raise InputError for an error whose unit can only be guessed."""
    whole = entry(name)
    if name != whole and units.get(whole, "") not in ("", *PURE) and not units[name]:
        raise InputError(
            f"{name}: no unit, but {whole} is in {units[whole]}; write '{name} [{units[whole]}]'"
        )


def _check_height(name: str, table: Cells, values: Array) -> None:
    """Raise InputError for heights whose unit can only be guessed: of files, and large ones."""
    unit, cells = table.column(name)
    bare = not isinstance(cells, list) or any(str(cell).strip()[-1:].isdigit() for cell in cells)
    guessed = table.word == "line" or bool(np.any(np.abs(values) > HIGHEST))
    if bare and guessed and not str(unit):
        heads = " or ".join(f"'{name} [{each}]'" for each in ("m", "cm", "mm"))
        raise InputError(f"{name}: no unit, and heights may be in m, cm or mm; write {heads}")


def _check_angle(results: Results, name: str, unit: str) -> None:
    """Raise InputError for angles from the normal that no impact has: degrees taken for radians."""
    allowed = "must be below pi/2, 90 deg, from the normal"
    if not unit:
        allowed += f"; for degrees write '{name} [deg]' at the head of the column"
    elif unit in ("rad", "radian", "radians"):
        allowed += f"; the head of the column says {unit}; for degrees write '{name} [deg]'"
    results.refuse(name, np.abs(results[name]) >= 0.5 * pi, allowed)


def _column(name: str, table: Cells, open_ended: bool) -> Array:
    """Return a column in SI units, or raise InputError for what is not a number in it."""
    unit, cells = table.column(name)
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
        try:
            values[i] = _cell(name, si, own, cell)
        except InputError as error:
            reason = reason or str(error)
    return values, reason


def _cell(name: str, si: str, own: Factor, cell: Any) -> float:
    """Return one number in SI units, NaN for an empty cell."""
    if cell is None or (isinstance(cell, str | float) and str(cell).strip().lower() in EMPTY):
        return nan
    return number(name, cell, si, own)
