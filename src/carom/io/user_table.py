"""A table that a user gives: its cells, its columns in SI units, and where each value stands."""

import json
from collections import Counter
from collections.abc import Collection, Iterable, Mapping
from contextlib import suppress
from dataclasses import dataclass, field, replace
from difflib import get_close_matches
from itertools import compress
from math import nan, pi
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.io.cells import MOST_NAMED_ROWS, Column, Mask, Rows, is_missing, named
from carom.io.heads import is_open, spelled
from carom.io.remedies import REMEDIES
from carom.quantities.arrays import Array, in_unit
from carom.quantities.glossary import GLOSSARY, meant
from carom.quantities.prefixes import Printed
from carom.quantities.refusals import Faults, InputError, clipped, heading, nearest, refuse
from carom.quantities.texts import UNCHANGED
from carom.quantities.units import PURE_UNITS, WHY_POSITIVE, factor_of, finite_or_text, number

CASE = "# case:"  # begins a comment that holds the bodies as JSON
BODIES = {  # comments that hold them one by one, as a spreadsheet leaves them
    "ball_radius": ("first", "radius"),
    "ball_material": ("first", "material"),
    "plate_material": ("second", "material"),
    "plate_thickness": ("second", "thickness"),
}
MOST_NAMED_VALUES, SHOWN_ROWS = 3, 20  # that a message names, print shows
ERROR = "_error"  # ends the name of a column of standard deviations
CORRECT_OR_DELETE = "correct or delete it"
HEIGHTS = ("drop_height", "rebound_height")  # which are measured in cm and mm as well
HIGHEST_DROP = 3.0  # m, of a drop that is given without a unit
EARLIER, LATER = ("before", "vor", "vorher"), ("after", "nach", "nachher")
AFTERWARDS = {  # what is called like it, after an impact
    "angle": "rebound_angle",
    "speed": "rebound_speed",
    "contact_angle": "contact_rebound_angle",
    "surface_angle": "surface_angle_out",
    **{name: f"{name}_out" for name in ("spin", "normal_speed", "tangential_speed")},
}
LEAST_SIMILARITY = 0.8  # from which a column is taken for a misspelt one
UNITS_IN_NAMES = {"_deg": "deg", "_rad_s": "rad/s", "_rad": "rad", "_rpm": "rpm", "_m_s": "m/s"}
ANGLES = ("angle", "rebound_angle")
USUAL_UNITS = {"rad": "deg", "rad/s": "rpm", "m": "cm"}
PERCENT = ("%", "percent")


@dataclass(frozen=True, eq=False)
class UserTable(Rows, Printed):
    """Columns by name as given, `cells`, and in SI units, `columns`, as far as they were read.

    `rows` are the numbers of the rows, `word` is what they are called, lines of a file or rows,
    and `comments` are those of a file, by key. `missing` says where columns have no value, `notes`
    how a file was read, `wrong` what makes it no table, which whoever asks for a column is told,
    `faults` collects what else is wrong, and `hinted` columns that misspelt ones likely are.
    """

    cells: Mapping[str, Column]
    rows: NDArray[np.int64]
    word: str = "row"
    comments: Mapping[str, str] = field(default_factory=dict)
    columns: Mapping[str, Array] = field(default_factory=dict)
    missing: Mapping[str, Mask] = field(default_factory=dict)
    notes: tuple[str, ...] = ()
    wrong: tuple[str, ...] = ()
    faults: Faults = field(default_factory=Faults)
    hinted: set[str] = field(default_factory=set)

    def __len__(self) -> int:
        return len(self.rows)

    def __getitem__(self, name: str) -> Any:
        return self.columns[name]

    def __str__(self) -> str:
        import pandas as pd

        columns = self.columns or {name: column.cells for name, column in self.cells.items()}
        return str(pd.DataFrame(dict(columns), index=self.rows).to_string(max_rows=SHOWN_ROWS))

    @property
    def is_of_file(self) -> bool:
        """Whether its columns have letters, as those of a file."""
        return any(column.letter for column in self.cells.values())

    @property
    def names(self) -> tuple[str, ...]:
        """The names of the columns, without units."""
        return tuple(self.cells)

    def column(self, name: str) -> Column:
        """Return a column as given, or raise InputError if it is none."""
        column = self.cells[name]
        refuse(*self.wrong, column.fault and f"{spelled(name)}: {column.fault}")
        return column

    def told(self, faults: Faults) -> "UserTable":
        """Return the table as far as it could be read; what is wrong is added to its faults."""
        faults.add(*self.wrong)
        return replace(self, wrong=(), faults=faults)

    @property
    def case(self) -> Mapping[str, Any] | None:
        """The bodies as comments hold them, if any; InputError if one of a case is not JSON."""
        if "case" not in self.comments:
            return self._bodies or None
        try:
            how: Any = {"parse_float": finite_or_text, "object_pairs_hook": _with_unique_keys}
            return dict(json.loads(self.comments["case"], **how))
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
        for name in (each for each in names if each not in {*self.columns, *self.hinted}):
            there = [spelled(key) for key in self.columns if key not in names]
            near = nearest(spelled(name), there)
            found = near or f"found {', '.join(there) or 'no other'};"
            remedy = REMEDIES.get().columns({"ITS HEAD": name})
            there_as = f"; if it is there by another name, {remedy}"
            asked = there_as if self.is_of_file and not near else ""
            words = f"column missing; {found} needed are {', '.join(map(spelled, names))}"
            raise InputError(f"{spelled(name)}: {words}{asked}")

    def require_rows(self, fewest: int) -> None:
        """Raise InputError if there are too few rows."""
        if len(self) < fewest:
            why = "".join(f"; {note}" for note in self.notes)
            few = f"results: too few points: {len(self)}, at least {fewest} are needed"
            raise InputError(few + why)

    def refuse(self, name: str, bad: Mask, allowed: str) -> None:
        """Add to the faults that a column is bad in some rows, naming them."""
        if bad.any():
            values = list(dict.fromkeys(f"{value:g}" for value in self[name][bad].tolist()))
            more = ["..."] * (len(values) > MOST_NAMED_VALUES)
            some = ", ".join([*values[:MOST_NAMED_VALUES], *more])
            where = self.cells_named(name, bad)
            self.faults.add(f"{spelled(name)}: {some} in {where} cannot be used; {allowed}")

    def cells_named(self, name: str, where: Mask) -> str:
        """Return the cells of a column, e.g. "cells B3 and B4"; rows if no file has letters."""
        letter = self.cells[name].letter if name in self.cells else ""
        if not letter:
            return self.named(where)
        if len(where) > 1 and where.all():
            return f"every {self.word} of column {letter}"
        return named("cell", [f"{letter}{row}" for row in self.rows[where]])

    def about_missing(self) -> tuple[str, ...]:
        """Return a note on the values that are missing in columns that have others, if any."""
        total, listed = 0, []
        for name, gone in self.missing.items():
            count, called = int(gone.sum()), spelled(name)
            if name != entry(name) or gone.all():
                continue
            where = f"{called} in {self.cells_named(name, gone)}"
            listed.append(f"{count} of {called}" if count > MOST_NAMED_ROWS else where)
            total += count
        missing = f"{total} value{'s' * (total > 1)} missing: {', '.join(listed)}"
        return (missing,) if total else ()

    def kept(self, where: Mask) -> "UserTable":
        """Return a table of some of the rows."""
        cells = {n: c._replace(cells=[*compress(c.cells, where)]) for n, c in self.cells.items()}
        columns = {name: values[where] for name, values in self.columns.items()}
        missing = {name: gone[where] for name, gone in self.missing.items() if gone[where].any()}
        return replace(self, cells=cells, columns=columns, missing=missing, rows=self.rows[where])


def _with_unique_keys(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    """Return an object of JSON, or raise InputError for keys that are alike: it takes the last."""
    twice = f"it is given twice after '{CASE}'; leave one of them out"
    for name, count in Counter(name for name, _ in pairs).items():
        refuse(count > 1 and f"{heading(name)}: {twice}")
    return dict(pairs)


def in_units(
    table: UserTable, names: Iterable[str], gaps: Collection[str] = (), *, whole: bool = False
) -> UserTable:
    """Return a table with those columns in SI units whose names are known; the others are NaN.

    Columns without a unit are SI; heights of drops in files need one. A blank cell, "-", NaN, NA or
    n/a stands for what was not measured: NaN, in columns of `gaps` and of their errors. A row in
    which none of these columns has a value is left out, unless the table is to stay whole.

    Adds to the faults of the table, which raise InputError if nobody collects them, what is no
    number or missing elsewhere, units that do not fit or lack, and values that cannot be in them.
    """
    table, missing = table.told(table.faults), dict[str, Mask]()
    columns = {name: np.full(len(table), nan) for name in table.names}
    read = replace(table, columns=columns, missing=missing)
    there = {*names}.intersection(table.names)
    wanted = [name for name in table.names if name in there]
    for name in wanted:
        there.discard(name)
        with table.faults.catching():
            gone = table.column(name).missing
            if gone.any():
                missing[name] = gone
            if (unit := _unit_of_values(name, table)) and not str(table.cells[name].unit):
                missed = f"no unit, but {entry(name)} is in {unit}; write '{name} [{unit}]'"
                raise InputError(f"{name}: {missed}")
            columns[name] = read_column(table, name, GLOSSARY[entry(name)].unit)
            there.add(name)
    if not whole:
        read = _without_blank_rows(read, wanted)
    for name in filter(there.__contains__, wanted):
        _check_values(name, read, entry(name) in gaps)
    return read


def _without_blank_rows(table: UserTable, wanted: Collection[str]) -> UserTable:
    """Return the rows in which one of these columns has a value."""
    if not wanted or not table.missing.keys() >= {*wanted}:
        return table
    blank = np.all([table.missing[name] for name in wanted], axis=0)
    if not blank.any() or blank.all():
        return table
    note = f"left out, as they have no value: {table.named(blank)}"
    return replace(table.kept(~blank), notes=(*table.notes, note))


def with_errors(names: Iterable[str]) -> tuple[str, ...]:
    """Return names of columns, and of the columns of their standard deviations."""
    return tuple(each for name in names for each in (name, name + ERROR))


def others(table: UserTable, names: Iterable[str]) -> tuple[str, ...]:
    """Return the columns that are not known and mean nothing here, for a user to be told.

    Adds to the faults of the table, which raise InputError if nobody collects them, one that is
    likely to be a known one misspelt, with the nearest, and an error without its column.
    """
    names = list(names)
    unknown = tuple(name for name in table.names if name not in names)
    for name in unknown:
        column = table.cells[name]
        hint, meaning = suggested(name, column, names)
        if not hint:
            continue
        asked, known = f"did you mean {hint!r}?", hint.partition(" [")[0]
        table.hinted.add(known)
        unit = _unit_of_values(known, table)
        meaning += f" [{unit}]" * (unit != "" and "[" not in meaning + column.head)
        if column.letter:
            asked += " It is measured from the normal." * (known in ANGLES)
            asked += " It is that before the impact." * (known == "spin")
            asked += f" If so, {REMEDIES.get().columns({clipped(column.head): meaning})}"
            asked += ", with the unit that it has" * ("[" in meaning and not hint.endswith("]"))
        table.faults.add(f"{heading(name)}: unknown column; {asked}")
    for name in table.names:
        if entry(name) not in table.names and name not in unknown:
            table.faults.add(f"{heading(name)}: its column {entry(name)!r} is missing")
    return unknown


def suggested(name: str, column: Column, names: Iterable[str]) -> tuple[str, str]:
    """Return the head of a known column that another one likely is, and what it is to be called.

    That has a unit where the one of its head is not enough. Both are empty if there is none.
    """
    hint = _likely(name, list(names))
    if not hint or (not column.fault and column.missing.all()):
        return "", ""
    known, unit = hint.partition(" [")[0], str(column.unit)
    si = GLOSSARY[entry(known)].unit if entry(known) in GLOSSARY else "1"
    needs = is_open(known, unit) or (entry(known) in HEIGHTS and column.is_bare)
    if si == "rad" and hint == known and not unit:
        needs = bool(np.any(np.abs(column_in_si(known, si, "", column.cells)[0]) >= 0.5 * pi))
    whole = f"{known} [{USUAL_UNITS.get(si, si)}]"
    return hint, whole if needs else known if unit else hint


def entry(name: str) -> str:
    """Return the name in the glossary of what a column holds, be it values or their errors."""
    return name.removesuffix(ERROR)


def _likely(name: str, names: list[str]) -> str:
    """Return the head of a known column that another one stands for, or nothing."""
    plain = name.lower().replace(" ", "_").replace("-", "_")
    unit = next((end for end in UNITS_IN_NAMES if plain.endswith(end)), "")
    plain = plain.removesuffix(unit)
    whole = entry(plain)
    stands = (_when(whole, names) or meant(whole, names) or whole) + ERROR * (whole != plain)
    close = get_close_matches(stands, names, n=1, cutoff=LEAST_SIMILARITY)
    return spelled(close[0]) + (f" [{UNITS_IN_NAMES[unit]}]" if unit else "") if close else ""


def _when(plain: str, names: Collection[str]) -> str:
    """Return the known name of a quantity of which a word says that it is before or after."""
    stem, _, when = plain.rpartition("_")
    if not stem or when not in (*EARLIER, *LATER):
        return ""
    name = meant(stem, names) or stem
    name = next((early for early, late in AFTERWARDS.items() if late == name), name)
    name = AFTERWARDS.get(name, name) if when in LATER else name
    return name if name in names else ""


def _unit_of_values(name: str, table: UserTable) -> str:
    """Return the unit of the values of which a column has the errors, empty if it has none."""
    whole = entry(name)
    unit = str(table.cells[whole].unit) if name != whole and whole in table.cells else ""
    return "" if unit in PURE_UNITS else unit


def _check_values(name: str, table: UserTable, open_ended: bool) -> None:
    """Add to the faults what cannot be, as it is of another unit, or of bodies that part."""
    values, unit = table[name], str(table.cells[name].unit)
    if name in table.missing and not open_ended:
        where = table.cells_named(name, table.missing[name])
        table.faults.add(f"{spelled(name)}: no value in {where}; write it there, or delete the row")
    if unit in PERCENT and table.word == "row" and table.cells[name].letter:
        _check_percent(name, table)
    if name in WHY_POSITIVE:
        table.refuse(name, values <= 0.0, f"must be positive{WHY_POSITIVE[name]}")
    if entry(name) in HEIGHTS:
        far = table.cells[name].letter or np.any(np.abs(values) > HIGHEST_DROP)
        if far and table.cells[name].is_bare:
            heads = " or ".join(f"'{name} [{each}]'" for each in ("m", "cm", "mm"))
            table.faults.add(f"{name}: no unit, and heights may be in m, cm or mm; write {heads}")
    if name in GLOSSARY and GLOSSARY[name].unit == "rad" and not name.startswith("surface"):
        allowed = "must be below pi/2, 90 deg, from the normal"
        if not unit:
            allowed += f"; for degrees write '{name} [deg]' at the head of the column"
        elif unit in ("rad", "radian", "radians"):
            allowed += f"; the head of the column says {unit}; for degrees write '{name} [deg]'"
        table.refuse(name, np.abs(values) >= 0.5 * pi, allowed)


def _check_percent(name: str, table: UserTable) -> None:
    """Add to the faults what a spreadsheet may show as a percentage, but holds as a ratio."""
    cells = table.cells[name].cells
    numbers = [abs(cell) for cell in cells if isinstance(cell, float) and not is_missing(cell)]
    if numbers and max(numbers) <= 1.0:
        words = f"the head says {table.cells[name].unit}, but the sheet holds {max(numbers):g}"
        shown = f"which its format may show as {100.0 * max(numbers):g} %"
        cure = "write ratios, as 0.95, and no unit into the head"
        table.faults.add(f"{name}: {words} at most, {shown}; {cure}")


def read_column(table: UserTable, name: str, si: str) -> Array:
    """Return a column in SI units, NaN where it is blank, or raise InputError for other cells."""
    column, called = table.column(name), spelled(name)
    values, reason = column_in_si(called, si, column.unit, column.cells)
    wrong = ~np.isfinite(values)
    if wrong.any() and (wrong := wrong & ~column.missing).any():
        where = table.cells_named(name, wrong)
        cause = reason.removeprefix(f"{called}: ") or CORRECT_OR_DELETE
        raise InputError(f"{called}: not a number in {where}; {cause}")
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
        if is_missing(cell):
            continue
        try:
            values[i] = number(name, cell, si, own)
        except InputError as error:
            reason = reason or str(error)
    return values, reason
