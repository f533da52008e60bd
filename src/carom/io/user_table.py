"""A table that a user gives: its cells, its columns in SI units, and where each value stands."""

import json
from collections import Counter
from collections.abc import Collection, Iterable, Mapping
from contextlib import suppress
from dataclasses import dataclass, field, replace
from difflib import get_close_matches
from itertools import compress
from math import nan, pi
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.quantities.arrays import Array, in_unit
from carom.quantities.glossary import GLOSSARY
from carom.quantities.refusals import Faults, InputError, heading, nearest
from carom.quantities.shown import Printed
from carom.quantities.symbols import meant
from carom.quantities.texts import UNCHANGED
from carom.quantities.units import PURE_UNITS, WHY_POSITIVE, factor_of, finite_or_text, number

Mask = NDArray[np.bool_]

ALIASES = {"psi_1": "psi_in", "psi_2": "psi_out", "angle_deg": "angle [deg]"}
SPELLINGS = {name: alias for alias, name in ALIASES.items()}
CASE = "# case:"  # begins a comment that holds the bodies as JSON
BODIES = {  # comments that hold them one by one, as a spreadsheet leaves them
    "ball_radius": ("first", "radius"),
    "ball_material": ("first", "material"),
    "plate_material": ("second", "material"),
    "plate_thickness": ("second", "thickness"),
}
MOST_NAMED_ROWS, MOST_NAMED_VALUES, SHOWN_ROWS = 5, 3, 20  # that a message names, print shows
GAP = "-"  # a cell of what was not measured
ERROR = "_error"  # ends the name of a column of standard deviations
CORRECT_OR_DELETE = "correct or delete it"
EMPTY = ("", "nan")
HEIGHTS = ("drop_height", "rebound_height")  # which are measured in cm and mm as well
HIGHEST_DROP = 3.0  # m, of a drop that is given without a unit
LEAST_SIMILARITY = 0.8  # from which a column is taken for a misspelt one
UNITS_IN_NAMES = {"_deg": "deg", "_rad_s": "rad/s", "_rad": "rad", "_rpm": "rpm", "_m_s": "m/s"}


class Column(NamedTuple):
    """Head and cells as given, an array of numbers or a list, and a unit: a text or one of pint's.

    If there is a fault, it is no column; that is told to whoever asks for it.
    """

    head: str
    cells: Any
    unit: Any = ""
    fault: str = ""


class Rows:
    """Rows by their numbers, and what they are called: lines of a file, or rows."""

    rows: NDArray[np.int64]
    word: str

    def named(self, where: Mask) -> str:
        """Return the rows where something is so, e.g. "lines 3, 7 and 9"."""
        return named(self.word, self.rows[where], len(self.rows))

    def one(self, index: int) -> str:
        """Return what one row is called, e.g. "line 3"."""
        return named(self.word, self.rows[index : index + 1])


@dataclass(frozen=True, eq=False)
class UserTable(Rows, Printed):
    """Columns by name as given, `cells`, and in SI units, `columns`, as far as they were read.

    `rows` are the numbers of the rows, `word` is what they are called, lines of a file or rows,
    and `comments` are those of a file, by key. `faults` collects what is wrong with it.
    """

    cells: Mapping[str, Column]
    rows: NDArray[np.int64]
    word: str = "row"
    comments: Mapping[str, str] = field(default_factory=dict)
    columns: Mapping[str, Array] = field(default_factory=dict)
    faults: Faults = field(default_factory=Faults)

    def __len__(self) -> int:
        return len(self.rows)

    def __getitem__(self, name: str) -> Any:
        return self.columns[name]

    def __str__(self) -> str:
        import pandas as pd

        columns = self.columns or {name: column.cells for name, column in self.cells.items()}
        return str(pd.DataFrame(dict(columns), index=self.rows).to_string(max_rows=SHOWN_ROWS))

    @property
    def names(self) -> tuple[str, ...]:
        """The names of the columns, without units."""
        return tuple(self.cells)

    def column(self, name: str) -> Column:
        """Return a column as given, or raise InputError if it is none."""
        column = self.cells[name]
        if column.fault:
            raise InputError(f"{spelled(name)}: {column.fault}")
        return column

    @property
    def case(self) -> Mapping[str, Any] | None:
        """The bodies as comments hold them, if any; InputError if one of a case is not JSON."""
        if "case" not in self.comments:
            return self._bodies or None
        try:
            read = json.loads(
                self.comments["case"],
                parse_float=finite_or_text,
                object_pairs_hook=_with_unique_keys,
            )
            return dict(read)
        except InputError:
            raise
        except (ValueError, TypeError, RecursionError):
            raise InputError(f"results: after '{CASE}' there is no JSON of the bodies") from None

    @property
    def _bodies(self) -> dict[str, dict[str, str]]:
        """The bodies that comments of their own hold, without what separates empty cells."""
        bodies: dict[str, dict[str, str]] = {}
        for comment, (body, key) in BODIES.items():
            if comment in self.comments:
                bodies.setdefault(body, {})[key] = self.comments[comment].rstrip(" \t,;")
        return bodies

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
            values = list(dict.fromkeys(f"{value:g}" for value in self[name][bad].tolist()))
            some = ", ".join(values[:MOST_NAMED_VALUES]) + ", ..." * (
                len(values) > MOST_NAMED_VALUES
            )
            where = self.named(bad)
            self.faults.add(f"{spelled(name)}: {some} in {where} cannot be used; {allowed}")

    def kept(self, where: Mask) -> "UserTable":
        """Return a table of some of the rows."""
        cells = {n: c._replace(cells=[*compress(c.cells, where)]) for n, c in self.cells.items()}
        columns = {name: values[where] for name, values in self.columns.items()}
        return replace(self, cells=cells, columns=columns, rows=self.rows[where])


def spelled(name: str) -> str:
    """Return how a user may call a column."""
    return SPELLINGS.get(name, name)


def named(word: str, rows: Iterable[int], total: int = 0) -> str:
    """Return rows in words, of so many in total.

    Examples
    --------
    >>> from carom.io.user_table import named
    >>> named("line", [3]), named("row", [1, 2, 5]), named("row", [1, 2], 2)
    ('line 3', 'rows 1, 2 and 5', 'every row')
    """
    texts = [str(row) for row in rows]
    if len(texts) == total > 1:
        return f"every {word}"
    if len(texts) > MOST_NAMED_ROWS + 1:
        texts = [*texts[:MOST_NAMED_ROWS], f"{len(texts) - MOST_NAMED_ROWS} more"]
    if len(texts) < 2:
        return " ".join([word, *texts])
    return f"{word}s {', '.join(texts[:-1])} and {texts[-1]}"


def _with_unique_keys(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    """Return an object of JSON, or raise InputError for keys that are alike: it takes the last."""
    for name, count in Counter(name for name, _ in pairs).items():
        if count > 1:
            words = f"it is given twice after '{CASE}'; leave one of them out"
            raise InputError(f"{heading(name)}: {words}")
    return dict(pairs)


def in_units(
    table: UserTable, names: Iterable[str], gaps: Collection[str] = (), faults: Faults | None = None
) -> UserTable:
    """Return a table with those columns in SI units whose names are known; the others are NaN.

    Columns without a unit are SI; heights of drops in files need one. In columns of `gaps`, and of
    their errors, a cell "-" stands for what was not measured: NaN.

    Adds to the faults, which are raised as InputError if they are not given, a cell that is not a
    number, a unit that does not fit, an error that has no unit where its column has one, angles
    that cannot be in rad, and speeds of bodies that do not approach.

    Examples
    --------
    >>> from carom.io.user_table import in_units
    >>> from carom.io.tables import read_table
    >>> table = read_table({"angle [deg]": [0.0, 60.0], "spin_out [rpm]": ["-", -600]})
    >>> given = in_units(table, ("angle", "spin_out"), gaps=("spin_out",))
    >>> given["angle"].round(4), given["spin_out"].round(2)
    (array([0.    , 1.0472]), array([   nan, -62.83]))
    """
    columns = {name: np.full(len(table), nan) for name in table.names}
    read = replace(table, columns=columns, faults=faults or Faults())
    wanted = {*names}
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
    """Return names of columns, and of the columns of their standard deviations."""
    return tuple(each for name in names for each in (name, name + ERROR))


def others(table: UserTable, names: Iterable[str], faults: Faults | None = None) -> tuple[str, ...]:
    """Return the columns that are not known and mean nothing here, for a user to be told.

    Adds to the faults, which are raised as InputError if they are not given, one that is likely to
    be a known one misspelt, with the nearest, and an error without its column.
    """
    names, faults = list(names), faults or Faults()
    unknown = tuple(name for name in table.names if name not in names)
    for name in unknown:
        if hint := _likely(name, names):
            faults.add(f"{heading(name)}: unknown column; did you mean {hint!r}?")
    for name in table.names:
        if entry(name) not in table.names and name not in unknown:
            faults.add(f"{heading(name)}: its column {entry(name)!r} is missing")
    return unknown


def entry(name: str) -> str:
    """Return the name in the glossary of what a column holds, be it values or their errors."""
    return name.removesuffix(ERROR)


def _likely(name: str, names: list[str]) -> str:
    """Return the head of a known column that another one stands for, or nothing."""
    plain = name.lower().replace(" ", "_").replace("-", "_")
    unit = next((end for end in UNITS_IN_NAMES if plain.endswith(end)), "")
    plain = plain.removesuffix(unit)
    end = ERROR if plain.endswith(ERROR) else ""
    plain = plain.removesuffix(ERROR)
    stands = meant(plain, names) or plain
    close = get_close_matches(stands + end, names, n=1, cutoff=LEAST_SIMILARITY)
    return spelled(close[0]) + (f" [{UNITS_IN_NAMES[unit]}]" if unit else "") if close else ""


def _check_error_unit(name: str, table: UserTable) -> None:
    """Raise InputError for an error whose unit can only be guessed."""
    whole = entry(name)
    unit = str(table.cells[whole].unit) if whole in table.cells else ""
    if name != whole and unit not in ("", *PURE_UNITS) and not str(table.cells[name].unit):
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
        if bare and not unit and (table.word == "line" or np.any(np.abs(values) > HIGHEST_DROP)):
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
        todo = f"write '{GAP}' where nothing was measured" if open_ended else CORRECT_OR_DELETE
        cause = reason.removeprefix(f"{spelled(name)}: ")
        raise InputError(
            f"{spelled(name)}: not a number in {table.named(missing)}; {cause or todo}"
        )
    return values


def column_in_si(name: str, si: str, unit: Any, cells: Any) -> tuple[Array, str]:
    """Return a column in SI units, NaN where there is no number, and what is wrong there first.

    A bare number is in the unit of the column, SI if that is empty; a cell may have its own.

    Raises InputError if the unit of the column does not fit.
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
