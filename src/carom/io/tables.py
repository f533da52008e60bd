"""The cells of a user's table: a CSV file, a mapping of columns, a data frame, a dataset."""

import json
import re
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.io.csv_cells import MOST_COLUMNS, read_csv
from carom.io.paths import checked_path
from carom.quantities.arrays import along_the_same, floats
from carom.quantities.refusals import InputError, clipped, nearest, refusal
from carom.quantities.texts import LONGEST, UNCHANGED
from carom.quantities.units import REAL, factor_of, finite_or_text, told_unit, two_units

ALIASES = {"psi_1": "psi_in", "psi_2": "psi_out", "angle_deg": "angle [deg]"}
SPELLINGS = {name: alias for alias, name in ALIASES.items()}
CASE = "# case:"  # begins a comment that holds the bodies as JSON
KEPT = ("case", "code", "doi", "law")  # attributes of a dataset that are comments of a file
HEAD = re.compile(r"\s*(.*?)\s*(?:\[(.*)\]|\((.*)\))?\s*")
GAP = "-"  # a cell of what was not measured
RAW = (str, bytes, bytearray, memoryview)  # sequences that are no lists
SHOWN = 5  # rows that a message names


class Rows:
    """Rows by their numbers, and what they are called: lines of a file, or rows."""

    rows: NDArray[np.int64]
    word: str

    def named(self, where: NDArray[np.bool_]) -> str:
        """Return the rows where something is so, e.g. "lines 3, 7 and 9"."""
        return named(self.word, self.rows[where], len(self.rows))

    def one(self, index: int) -> str:
        """Return what one row is called, e.g. "line 3"."""
        return named(self.word, self.rows[index : index + 1])


class Column(NamedTuple):
    """Cells as given, an array of numbers or a list, and their unit: a text, empty, or pint's.

    If there is a fault, it is no column; that is told to whoever asks for it.
    """

    unit: Any
    cells: Any
    fault: str = ""


@dataclass(frozen=True, eq=False)
class Cells(Rows):
    """Columns as given, by name, what the rows are called, and the comments by key."""

    columns: Mapping[str, Column]
    rows: NDArray[np.int64]
    word: str
    comments: Mapping[str, str]

    @property
    def names(self) -> tuple[str, ...]:
        """The names of the columns, without units."""
        return tuple(self.columns)

    def column(self, name: str) -> tuple[Any, Any]:
        """Return unit and cells of a column, or raise InputError if it is none."""
        unit, cells, fault = self.columns[name]
        if fault:
            raise InputError(f"{spelled(name)}: {fault}")
        return unit, cells

    @property
    def case(self) -> Mapping[str, Any] | None:
        """The bodies as a comment holds them, if any; InputError if that is not JSON."""
        if "case" not in self.comments:
            return None
        try:
            read = json.loads(
                self.comments["case"], parse_float=finite_or_text, object_pairs_hook=_given_once
            )
            return dict(read)
        except InputError:
            raise
        except (ValueError, TypeError, RecursionError):
            raise InputError(f"results: after '{CASE}' there is no JSON of the bodies") from None


def read_table(
    source: Any, columns: Mapping[str, str] | None = None, *, what: str = "results", fewest: int = 2
) -> Cells:
    """Return the cells of a CSV file, columns by name, a data frame, a structured array, a dataset.

    A file has a header, at least so many columns separated by commas, semicolons or tabs, and
    comments after #. `columns` tells what heads stand for, {"omega [rpm]": "spin_out"}.

    Raises InputError, in which the table is called `what`, if it cannot be read, has no rows, too
    many columns, or columns of one name or unequal length.

    Examples
    --------
    >>> from carom.io.tables import read_table
    >>> table = read_table({"angle [deg]": [10.0, 20.0], "omega": [-2.0, -5.0]}, {"omega": "spin"})
    >>> table.names, table.word, len(table.rows)
    (('angle', 'spin'), 'row', 2)
    """
    if isinstance(source, str | Path):
        found = read_csv(what, checked_path(what, source), fewest)
        given = [(head, Column("", cells)) for head, cells in zip(*found[:2], strict=True)]
        table = Cells({}, found.lines, "line", found.comments)
    else:
        given, comments = _columns_of(what, source)
        table = Cells({}, _counted(what, given), "row", comments)
    named = _renamed([head for head, _ in given], _checked_columns(columns), what)
    _check_names(what, [name for name, _ in named])
    if not len(table.rows):
        raise InputError(f"{what}: no rows; give names of columns, and numbers below them")
    read = {
        name: column._replace(unit=_one_unit(name, unit, column.unit))
        for (name, unit), (_, column) in zip(named, given, strict=True)
    }
    return replace(table, columns=read)


def _columns_of(what: str, source: Any) -> tuple[list[tuple[str, Column]], dict[str, str]]:
    """Return the heads and the columns of what is no file, and its comments."""
    if hasattr(source, "data_vars"):
        comments = {name: str(source.attrs[name]) for name in KEPT if name in source.attrs}
        return list(_of_dataset(source)), comments
    if fields := getattr(getattr(source, "dtype", None), "names", None):
        source = {name: source[name] for name in fields}  # of a structured array
    if any(name is not None for name in getattr(getattr(source, "index", None), "names", ())):
        source = _with_index(what, source)
    if not hasattr(source, "items"):  # which a data frame has, too
        raise refusal(what, source, "must be the name of a CSV file, or columns by name")
    if len(source.keys()) > MOST_COLUMNS:
        raise refusal(what, f"{len(source.keys())} columns", f"{MOST_COLUMNS} are read at most")
    along_the_same(**{str(name): values for name, values in source.items()})
    return [(str(name), _column(str(name), values)) for name, values in source.items()], {}


def _with_index(what: str, frame: Any) -> Any:
    """Return a data frame whose index, which has a name, is a column."""
    try:
        return frame.reset_index()
    except ValueError:
        words = f"{what}: its index has the name of a column; leave one of them out"
        raise InputError(words) from None


def _checked_columns(columns: Any) -> Mapping[str, str]:
    names = {} if columns is None else columns
    if not isinstance(names, Mapping) or not all(
        isinstance(name, str) and name.strip() for name in names.values()
    ):
        example = "{'omega': 'spin_out'}"
        raise refusal("columns", columns, f"must map heads of columns to names, e.g. {example}")
    return {str(head): name for head, name in names.items()}


def name_and_unit(head: str) -> tuple[str, str]:
    """Return name and unit of a column from its head, "spin [rpm]" or "spin (rpm)"."""
    name, unit = _parts(ALIASES.get(head.strip(), head))
    return ALIASES.get(name, name), unit


def _given_once(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    """Return an object of JSON, or raise InputError for keys that are alike: it takes the last."""
    for name, count in Counter(name for name, _ in pairs).items():
        if count > 1:
            words = f"it is given twice after '{CASE}'; leave one of them out"
            raise InputError(f"{clipped(name)}: {words}")
    return dict(pairs)


def spelled(name: str) -> str:
    """Return how a user may call a column."""
    return SPELLINGS.get(name, name)


def named(word: str, rows: Iterable[int], total: int = 0) -> str:
    """Return rows in words, of so many in total.

    Examples
    --------
    >>> from carom.io.tables import named
    >>> named("line", [3]), named("row", [1, 2, 5]), named("row", [1, 2], 2)
    ('line 3', 'rows 1, 2 and 5', 'every row')
    """
    texts = [str(row) for row in rows]
    if len(texts) == total > 1:
        return f"every {word}"
    if len(texts) > SHOWN + 1:
        texts = [*texts[:SHOWN], f"{len(texts) - SHOWN} more"]
    if len(texts) < 2:
        return " ".join([word, *texts])
    return f"{word}s {', '.join(texts[:-1])} and {texts[-1]}"


def _check_names(what: str, names: Sequence[str]) -> None:
    """Raise InputError for more columns than are read, and for names given twice."""
    if len(names) > MOST_COLUMNS:
        raise refusal(what, f"{len(names)} columns", f"{MOST_COLUMNS} are read at most")
    twice = [spelled(name) for name, count in Counter(names).items() if count > 1]
    if twice:
        listed = " and ".join(map(repr, twice))
        raise InputError(f"{listed}: two columns have this name; leave one of them out")


def _renamed(heads: Iterable[str], columns: Mapping[str, str], what: str) -> list[tuple[str, str]]:
    """Return names and units of heads, users' names replaced by Carom's.

    Raises InputError for a name that no column has, and for a unit that is told otherwise.
    """
    heads, left, new = list(heads), dict(columns), []
    for head in heads:
        own, unit = _parts(head)
        wanted = left.pop(head, None) or left.pop(own, None)
        name, told = name_and_unit(head if wanted is None else wanted)
        new.append((name, told if wanted is None else _one_unit(own, unit, told)))
    for name in left:
        hint = nearest(name, heads) or f"its columns are {', '.join(heads)}"
        raise refusal("columns", name, f"{what} has no column of that name; {hint}")
    return new


def _parts(head: str) -> tuple[str, str]:
    """Return what stands before and in the brackets of a head."""
    match = HEAD.fullmatch(head) if len(head) <= LONGEST else None
    return (match[1], (match[2] or match[3] or "").strip()) if match else (head, "")


def _one_unit(name: str, one: Any, other: Any) -> Any:
    """Return the unit that is told in one way or in two, or raise InputError if they differ."""
    if "" in (str(one), str(other)) or str(one) == str(other):
        return one if str(one) else other
    with suppress(InputError):
        if factor_of(name, other, str(one)) == UNCHANGED:
            return other
    raise two_units(name, one, other)


def _counted(what: str, columns: Iterable[tuple[str, Column]]) -> NDArray[np.int64]:
    """Return the numbers of rows, from 1, or raise InputError for columns that differ in length."""
    lengths = [(head, len(column.cells)) for head, column in columns if not column.fault]
    if len({length for _, length in lengths}) > 1:
        listed = ", ".join(f"{head} {length}" for head, length in lengths)
        raise InputError(f"{what}: columns must be equally long; rows are {listed}")
    return np.arange(1, 1 + (lengths[0][1] if lengths else 0))


def _column(name: str, given: Any, *, gaps: bool = False) -> Column:
    """Return a column of a user's; a gap is what is masked, with `gaps` what is no number, too."""
    plain, told = told_unit(name, given)
    cells: Any = None
    if isinstance(plain, Sequence) and not isinstance(plain, RAW):
        cells = list(plain)
    elif _depth(plain) == 1:
        cells = _of_array(name, plain, gaps)
    if cells is None or (isinstance(cells, list) and any(map(_depth, cells))):
        raise refusal(name, given, "a column must be a list of numbers")
    return Column("" if told is None else told, cells)


def _depth(value: Any) -> int:
    """Return how many dimensions an array has, 1 for lists, 0 for anything else."""
    shape = () if isinstance(value, RAW) else getattr(value, "shape", ())
    return 1 if isinstance(value, list | tuple) else len(shape) if isinstance(shape, tuple) else 0


def _of_array(name: str, values: Any, gaps: bool) -> Any:
    """Return an array of numbers, or a list of whatever else there is; with gaps, a list."""
    real = getattr(getattr(values, "dtype", None), "kind", "") in REAL
    array = np.asanyarray(values)
    if real and array.dtype.kind not in REAL:  # with pandas' own sign of what is missing
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


def _of_dataset(dataset: Any) -> Iterator[tuple[str, Column]]:
    """Return the columns of an xarray dataset; what is missing there was not measured.

    Rows run along one dimension; one value is that of every row.
    """
    variables = [*dataset.data_vars.values(), *dataset.coords.values()]
    sizes = next(({item.dims[0]: item.size} for item in variables if item.ndim == 1), {})
    for key, item in dataset.variables.items():
        name, whole = str(key), item if item.dims else item.set_dims(sizes)
        if sizes and whole.dims == (*sizes,):
            yield name, _column(name, whole, gaps=True)
        else:
            along, rows = (" and ".join(map(str, dims)) for dims in (item.dims, sizes))
            fault = f"it runs along {along}, but the rows along {rows}; select with .sel or .isel"
            yield name, Column("", (), fault)
