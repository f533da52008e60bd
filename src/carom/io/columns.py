"""Reading a user's results in SI units: from a CSV file, a mapping of columns or a data frame."""

from collections.abc import Collection, Iterable, Mapping
from contextlib import suppress
from dataclasses import dataclass
from difflib import get_close_matches
from math import nan, pi
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.io.tables import GAP, Cells, Rows, name_and_unit, spelled
from carom.quantities.arrays import Array
from carom.quantities.glossary import GLOSSARY
from carom.quantities.units import InputError, nearest, number

Mask = NDArray[np.bool_]

ERROR = "_error"  # ends the name of a column of standard deviations
DELETE = "correct or delete what is there"
NEAR = 0.8  # similarity of names from which a column is taken for a misspelt one
SYMBOLS = {  # what people call a column that has a name of its own here
    "theta": "angle",
    "incident_angle": "angle",
    "impact_angle": "angle",
    "omega": "spin_out",
    "e": "normal_restitution",
    "e_n": "normal_restitution",
    "e_t": "tangential_restitution",
    "beta": "contact_beta",
    "e_c": "contact_restitution",
    "psi1": "psi_in",
    "psi2": "psi_out",
}
UNITS = {"_deg": "deg", "_rad_s": "rad/s", "_rad": "rad", "_rpm": "rpm", "_m_s": "m/s"}  # in names


@dataclass(frozen=True, eq=False)
class Results(Rows):
    """Columns of results in SI units, and what their rows are called: lines of a file, or rows."""

    columns: Mapping[str, Array]
    rows: NDArray[np.int64]
    word: str

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
        """Raise InputError for a column that is bad in some rows, naming them."""
        if bad.any():
            value = f"{float(self[name][bad][0]):g}"
            where = self.named(bad)
            raise InputError(f"{spelled(name)}: {value} in {where} cannot be used; {allowed}")


def in_units(table: Cells, known: Iterable[str], gaps: Collection[str] = ()) -> Results:
    """Return the columns whose names are known, in SI units; the others are there, but NaN.

    Columns without a unit are SI. In columns of `gaps`, and of their errors, a cell "-" stands for
    what was not measured: NaN.

    Raises InputError for a cell of them that is not a number, a unit that does not fit, an error
    that has no unit where its column has one, or angles that cannot be in rad.

    Examples
    --------
    >>> from carom.io.columns import in_units
    >>> from carom.io.tables import read_table
    >>> table = read_table({"angle [deg]": [0.0, 60.0], "spin_out [rpm]": ["-", -600]})
    >>> given = in_units(table, ("angle", "spin_out"), gaps=("spin_out",))
    >>> given["angle"].round(4), given["spin_out"].round(2)
    (array([0.    , 1.0472]), array([   nan, -62.83]))
    """
    columns: dict[str, Array] = {}
    units = dict(name_and_unit(head) for head in table.cells)
    known = set(known)
    for name, cells in zip(units, table.cells.values(), strict=True):
        if name not in known:
            columns[name] = np.full(len(table.rows), nan)
            continue
        _check_error_unit(name, units)
        columns[name] = _column(name, units[name], cells, table, entry(name) in gaps)
    results = Results(columns, table.rows, table.word)
    for name, unit in units.items():
        if name in known and name in GLOSSARY and GLOSSARY[name].unit == "rad":
            _check_angle(results, name, unit)
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


def others(table: Cells, known: Iterable[str]) -> tuple[str, ...]:
    """Return the columns that are not known and mean nothing here, for a user to be told.

    Raises InputError for one that is likely to be a known one misspelt, with the nearest.

    Examples
    --------
    >>> from carom.io.columns import others
    >>> from carom.io.tables import read_table
    >>> others(read_table({"angle": [0.1], "run": [1]}), ["angle", "spin_out"])
    ('run',)
    """
    known = list(known)
    unknown = tuple(name for name in table.names if name not in known)
    for name in unknown:
        if hint := _likely(name, known):
            raise InputError(f"{name}: unknown column; did you mean {hint!r}?")
    for name in table.names:
        if entry(name) not in table.names:
            raise InputError(f"{name}: the column {entry(name)!r} it goes with is missing")
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
    found = get_close_matches(SYMBOLS.get(plain, plain) + end, known, n=1, cutoff=NEAR)
    return spelled(found[0]) + (f" [{UNITS[unit]}]" if unit else "") if found else ""


def _check_error_unit(name: str, units: Mapping[str, str]) -> None:
    """Raise InputError for an error whose unit can only be guessed."""
    whole = entry(name)
    if name != whole and units.get(whole) and not units[name]:
        raise InputError(
            f"{name}: no unit, but {whole} is in {units[whole]}; write '{name} [{units[whole]}]'"
        )


def _check_angle(results: Results, name: str, unit: str) -> None:
    """Raise InputError for angles from the normal that no impact has: degrees taken for radians."""
    allowed = "must be below pi/2, 90 deg, from the normal"
    if not unit:
        allowed += f"; the head of a column in degrees is '{name} [deg]'"
    elif unit in ("rad", "radian", "radians"):
        allowed += f"; the column is headed {unit}: if it is in degrees write '{name} [deg]'"
    results.refuse(name, np.abs(results[name]) >= 0.5 * pi, allowed)


def _column(name: str, unit: str, cells: list[Any], table: Cells, open_ended: bool) -> Array:
    """Return a column in SI units, or raise InputError for what is not a number in it."""
    gap = np.array([open_ended and isinstance(c, str) and c.strip() == GAP for c in cells])
    filled = [nan if g else cell for cell, g in zip(cells, gap, strict=True)]
    values, reason = _numbers(name, unit, filled)
    missing = ~np.isfinite(values) & ~gap
    if missing.any():
        todo = f"write '{GAP}' where nothing was measured" if open_ended else DELETE
        message = f"not a number in {table.named(missing)}; {reason or todo}"
        raise InputError(f"{spelled(name)}: {message}")
    return values


def _numbers(name: str, unit: str, cells: list[Any]) -> tuple[Array, str]:
    """Return a column in SI units, NaN where there is no number, and what is wrong there first."""
    scale = number(spelled(name), f"1 {unit}", GLOSSARY[entry(name)].unit) if unit else 1.0
    with suppress(TypeError, ValueError):
        return np.array(cells, dtype=np.float64) * scale, ""
    values, reason = np.full(len(cells), nan), ""
    for i, cell in enumerate(cells):
        try:
            values[i] = _cell(name, cell, scale)
        except InputError as error:
            reason = reason or str(error)
    return values, reason


def _cell(name: str, cell: Any, scale: float) -> float:
    """Return one number, NaN for an empty cell; a text with a unit of its own has that unit."""
    if cell is None or (isinstance(cell, str) and not cell.strip()):
        return nan
    with suppress(TypeError, ValueError):
        return float(cell) * scale
    return number(spelled(name), cell, GLOSSARY[entry(name)].unit)
