"""Reading a user's table: a CSV file, a mapping of columns, a data frame, a dataset."""

import re
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from carom.io.csv_cells import MOST_COLUMNS, read_csv
from carom.io.paths import checked_path
from carom.io.user_table import ALIASES, GAP, Column, UserTable, spelled
from carom.quantities.arrays import along_the_same, floats
from carom.quantities.refusals import InputError, nearest, refusal, refuse
from carom.quantities.texts import LONGEST_TEXT, UNCHANGED
from carom.quantities.units import REAL_KINDS, factor_of, two_units, without_unit

COMMENT_ATTRIBUTES = ("case", "code", "doi", "law")  # of a dataset; comments of a file
HEAD = re.compile(r"\s*(.*?)\s*(?:\[(.*)\]|\((.*)\))?\s*")
TEXT_TYPES = (str, bytes, bytearray, memoryview)  # sequences that are no lists


def read_table(
    source: Any, columns: Mapping[str, str] | None = None, *, what: str = "results", fewest: int = 2
) -> UserTable:
    """Return the cells of a CSV file, columns by name, a data frame, a structured array, a dataset.

    A file has a header, at least so many columns separated by commas, semicolons or tabs, and
    comments after #. `columns` tells what heads stand for, {"omega [rpm]": "spin_out"}. A table
    that was read is returned as it is.

    Raises InputError, in which the table is called `what`, if it cannot be read, has no rows, too
    many columns, or columns of one name or unequal length.

    Examples
    --------
    >>> from carom.io.tables import read_table
    >>> table = read_table({"angle [deg]": [10.0, 20.0], "omega": [-2.0, -5.0]}, {"omega": "spin"})
    >>> table.names, table.word, len(table)
    (('angle', 'spin'), 'row', 2)
    """
    if isinstance(source, UserTable) and not columns:
        return source
    if isinstance(source, str | Path):
        source_columns, table = read_csv(what, checked_path(what, source), fewest)
    else:
        source_columns, table = _of_object(what, source)
    named = _renamed([column.head for column in source_columns], _checked_columns(columns), what)
    for name, count in Counter(name for name, _ in named).items():
        if count > 1:
            words = "two columns have this name; leave one of them out"
            raise InputError(f"{spelled(name)!r}: {words}")
    refuse(not len(table) and f"{what}: no rows; give names of columns, and numbers below them")
    cells = {
        name: column._replace(unit=_one_unit(name, unit, column.unit))
        for (name, unit), column in zip(named, source_columns, strict=True)
    }
    return replace(table, cells=cells)


def _of_object(what: str, source: Any) -> tuple[list[Column], UserTable]:
    """Return the columns of what is no file by their heads, and a table of its rows."""
    comments: dict[str, str] = {}
    if hasattr(source, "data_vars"):
        there = filter(source.attrs.__contains__, COMMENT_ATTRIBUTES)
        comments = {name: str(source.attrs[name]) for name in there}
        columns = list(_of_dataset(source))
    else:
        columns = [_column(str(name), cells) for name, cells in _by_name(what, source).items()]
    if len(columns) > MOST_COLUMNS:
        raise refusal(what, f"{len(columns)} columns", f"{MOST_COLUMNS} are read at most")
    lengths = {column.head: len(column.cells) for column in columns if not column.fault}
    if len({*lengths.values()}) > 1:
        listed = ", ".join(f"{head} {length}" for head, length in lengths.items())
        raise InputError(f"{what}: columns must be equally long; rows are {listed}")
    rows = np.arange(1, 1 + max(lengths.values(), default=0))
    return columns, UserTable({}, rows, comments=comments)


def _by_name(what: str, source: Any) -> Any:
    """Return the columns of a mapping, a data frame or a structured array; an index is one, too."""
    if fields := getattr(getattr(source, "dtype", None), "names", None):
        source = {name: source[name] for name in fields}  # of a structured array
    if any(name is not None for name in getattr(getattr(source, "index", None), "names", ())):
        try:
            source = source.reset_index()
        except ValueError:
            words = f"{what}: its index has the name of a column; leave one of them out"
            raise InputError(words) from None
    if not hasattr(source, "items"):  # which a data frame has, too
        raise refusal(what, source, "must be the name of a CSV file, or columns by name")
    along_the_same(**{str(name): values for name, values in source.items()})
    return source


def _checked_columns(columns: Any) -> Mapping[str, str]:
    names = {} if columns is None else columns
    if not isinstance(names, Mapping) or not all(
        isinstance(name, str) and name.strip() for name in names.values()
    ):
        example = "{'omega': 'spin_out'}"
        raise refusal("columns", columns, f"must map heads of columns to names, e.g. {example}")
    return {str(head): name for head, name in names.items()}


def _renamed(heads: list[str], columns: Mapping[str, str], what: str) -> list[tuple[str, str]]:
    """Return names and units of heads, users' names replaced by Carom's.

    Raises InputError for a name that no column has, and for a unit that is told otherwise.
    """
    left, new = dict(columns), []
    for head in heads:
        own, unit = _parts(head)
        wanted = left.pop(head, None) or left.pop(own, None)
        words = (head if wanted is None else wanted).strip()
        name, new_unit = _parts(ALIASES.get(words, words))
        new_unit = new_unit if wanted is None else _one_unit(own, unit, new_unit)
        new.append((ALIASES.get(name, name), new_unit))
    for name in left:
        hint = nearest(name, heads) or f"its columns are {', '.join(heads)}"
        raise refusal("columns", name, f"{what} has no column of that name; {hint}")
    return new


def _parts(head: str) -> tuple[str, str]:
    """Return what stands before and in the brackets of a head."""
    match = HEAD.fullmatch(head) if len(head) <= LONGEST_TEXT else None
    return (match[1], (match[2] or match[3] or "").strip()) if match else (head, "")


def _one_unit(name: str, one: Any, other: Any) -> Any:
    """Return the unit that is told in one way or in two, or raise InputError if they differ."""
    if "" in (str(one), str(other)) or str(one) == str(other):
        return one if str(one) else other
    with suppress(InputError):
        if factor_of(name, other, str(one)) == UNCHANGED:
            return other
    raise two_units(name, one, other)


def _column(name: str, values: Any, *, gaps: bool = False) -> Column:
    """Return a column of a user's; a gap is what is masked, with `gaps` what is no number, too."""
    plain, unit = without_unit(name, values)
    cells: Any = None
    if isinstance(plain, Sequence) and not isinstance(plain, TEXT_TYPES):
        cells = list(plain)
    elif _depth(plain) == 1:
        cells = _of_array(name, plain, gaps)
    if cells is None or (isinstance(cells, list) and any(map(_depth, cells))):
        raise refusal(name, values, "a column must be a list of numbers")
    return Column(name, cells, "" if unit is None else unit)


def _depth(value: Any) -> int:
    """Return how many dimensions an array has, 1 for lists, 0 for anything else."""
    shape = () if isinstance(value, TEXT_TYPES) else getattr(value, "shape", ())
    return 1 if isinstance(value, list | tuple) else len(shape) if isinstance(shape, tuple) else 0


def _of_array(name: str, values: Any, gaps: bool) -> Any:
    """Return an array of numbers, or a list of whatever else there is; with gaps, a list."""
    real = getattr(getattr(values, "dtype", None), "kind", "") in REAL_KINDS
    array = np.asanyarray(values)
    if real and array.dtype.kind not in REAL_KINDS:  # with pandas' own sign of what is missing
        array = np.asarray(values, dtype=np.float64)
    if array.dtype.kind == "V":  # of records
        return None
    cells = floats(name, np.ma.getdata(array)) if real else list(np.ma.getdata(array))
    gone = np.ma.getmaskarray(array)
    if gaps:
        gone = gone | (np.isnan(cells) if real else [_is_nan(cell) for cell in cells])
    if not gone.any():
        return cells
    return [GAP if empty else cell for cell, empty in zip(cells, gone.tolist(), strict=True)]


def _is_nan(cell: Any) -> bool:
    return isinstance(cell, float | np.datetime64 | np.timedelta64) and cell != cell


def _of_dataset(dataset: Any) -> Iterator[Column]:
    """Return the columns of an xarray dataset; what is missing there was not measured.

    Rows run along one dimension; one value is that of every row.
    """
    variables = [*dataset.data_vars.values(), *dataset.coords.values()]
    sizes = next(({item.dims[0]: item.size} for item in variables if item.ndim == 1), {})
    for key, item in dataset.variables.items():
        name, whole = str(key), item if item.dims else item.set_dims(sizes)
        if sizes and whole.dims == (*sizes,):
            yield _column(name, whole, gaps=True)
        else:
            along, rows = (" and ".join(map(str, dims)) for dims in (item.dims, sizes))
            fault = f"it runs along {along}, but the rows along {rows}; select with .sel or .isel"
            yield Column(name, (), "", fault)
