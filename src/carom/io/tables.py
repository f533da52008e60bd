"""Reading a user's table: a file, a mapping of columns, a data frame, a dataset."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from carom.io.cells import GAP, Column, is_missing
from carom.io.csv_cells import CsvFile
from carom.io.heads import TableFormat, renamed, spelled, table_format
from carom.io.paths import accessing, checked_path, opened
from carom.io.spreadsheets import STARTS, Sheet
from carom.io.table_rows import MOST_COLUMNS
from carom.io.user_table import UserTable
from carom.quantities.arrays import along_the_same, floats
from carom.quantities.refusals import InputError, refusal, refuse
from carom.quantities.units import REAL_KINDS, without_unit

COMMENT_ATTRIBUTES = ("case", "code", "doi", "law")  # of a dataset; comments of a file
TEXT_TYPES = (str, bytes, bytearray, memoryview)  # sequences that are no lists


def read_table(
    source: Any,
    columns: Mapping[str, str] | str | Path | None = None,
    *,
    sheet: str | None = None,
    decimal: str | None = None,
    what: str = "results",
    fewest: int = 2,
    lenient: bool = False,
) -> UserTable:
    """Return the cells of a file, columns by name, a data frame, a structured array, a dataset.

    A file is CSV, .xlsx or .ods, and has a header and at least so many columns. `columns`
    tells what heads stand for, {"omega [rpm]": "spin_out"}, or names a TOML file that tells it.
    `sheet` is one of a spreadsheet, as in "lab.xlsx:Sheet2"; `decimal` is "," or "." where numbers
    may be read in both ways. A table that was read is returned as it is.

    Raises InputError, in which the table is called `what`, if it cannot be read, has no rows, too
    many columns, columns of one name, or rows or columns of unequal length. A lenient reading goes
    on where it can, and leaves it to the table to say what is `wrong`, with what else is.

    Examples
    --------
    >>> table = read_table({"angle [deg]": [10.0, 20.0], "omega": [-2.0, -5.0]}, {"omega": "spin"})
    >>> table.names, table.word, len(table)
    (('angle', 'spin'), 'row', 2)
    """
    how = table_format(columns, sheet, decimal)
    if isinstance(source, UserTable) and not how.columns:
        return source
    if isinstance(source, str | Path):
        source_columns, table = file_columns(what, source, how, fewest)
    else:
        for name in ("sheet", "decimal"):
            refuse(getattr(how, name) and f"{name}: only a file has it; leave it out")
        source_columns, table = _of_object(what, source)
    wrong, cells, places = list(table.wrong), dict[str, Column](), dict[str, list[str]]()
    for name, column in renamed(source_columns, how.columns, what, wrong):
        places.setdefault(name, []).append(column.letter)
        cells.setdefault(name, column)
    for name, letters in places.items():
        where = f", {' and '.join(letters)}," if all(letters) else ""
        words = f"two columns{where} have this name; leave one of them out"
        wrong += [f"{spelled(name)!r}: {words}"] if len(letters) > 1 else []
    if not len(table) and not wrong:
        wrong = [f"{what}: no rows; give names of columns, and numbers below them"]
    refuse(*(wrong if not lenient or not len(table) else ()))
    return replace(table, cells=cells, wrong=tuple(wrong))


def file_columns(
    what: str, source: str | Path, how: TableFormat, fewest: int
) -> tuple[list[Column], UserTable]:
    """Return the columns of a file by their heads, and a table of its rows; its start tells all."""
    path, sheet = checked_path(what, source), how.sheet
    name, colon, last = str(source).rpartition(":")
    if colon and last and not path.exists() and Path(name).is_file():
        refuse(sheet and f"sheet: {sheet!r} and {last!r} are named; leave one of them out")
        path, sheet = Path(name), last
    with accessing(what, path, "read"), opened(path, "rb") as file:
        if file.peek(4).startswith(STARTS):
            return Sheet(what, str(path), file, sheet).read(fewest, how.decimal)
        refuse(sheet and refusal("sheet", sheet, f"{path} is no spreadsheet; leave it out"))
        return CsvFile(what, str(path), file).read(fewest, how.decimal)


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
            words = "its index has the name of a column; leave one of them out"
            raise InputError(f"{what}: {words}") from None
    if not hasattr(source, "items"):  # which a data frame has, too
        raise refusal(what, source, "must be the name of a file, or columns by name")
    along_the_same(**{str(name): values for name, values in source.items()})
    return source


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
        gone = gone | (np.isnan(cells) if real else [is_missing(cell) for cell in cells])
    if not gone.any():
        return cells
    return [GAP if empty else cell for cell, empty in zip(cells, gone.tolist(), strict=True)]


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
