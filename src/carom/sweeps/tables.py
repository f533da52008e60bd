"""Tables of cases: columns of numbers with units, or of names, from a CSV file or a mapping."""

import hashlib
import re
import warnings
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from carom.quantities.arrays import Array
from carom.quantities.units import InputError, number, refusal
from carom.sweeps.inputs import (
    CHOSEN,
    CODE,
    UNREADABLE,
    Box,
    Choice,
    Choices,
    checked_choices,
    checked_names,
    fill_record,
    leaf,
    read_choice,
)

if TYPE_CHECKING:
    import pandas as pd

Columns = dict[str, NDArray[Any]]

HEAD = re.compile(r"\s*([^\[]*?)\s*(?:\[(.*)\])?\s*")
CELL = r"^\s*([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?|[+-]?inf)\s*(.*?)\s*$"


@dataclass(frozen=True, eq=False, init=False)
class Table:
    """Cases one by one, the rows of a table.

    Parameters
    ----------
    source : str, Path or mapping
        A CSV file, or a mapping of columns. Columns are called as inputs are, with a unit if they
        have one, "speed [km/h]"; a cell may have its own, "5 mm". A row with a cell that cannot be
        read gets a status that says so.

    Raises
    ------
    InputError
        If the file cannot be read, an input is not known or given in two ways, a unit does not
        fit, or columns differ in length.

    Examples
    --------
    >>> import carom
    >>> carom.Table({"angle [deg]": [10, 20], "friction": [0.1, 0.2]}).names
    ('angle', 'friction')
    """

    names: tuple[str, ...]
    choices: Choices
    _columns: tuple[NDArray[Any], ...] = field(repr=False)
    dims: ClassVar[tuple[str, ...]] = ("point",)
    sampled: ClassVar[bool] = True

    def __init__(self, source: str | Path | Mapping[str, Any]) -> None:
        columns, choices = read_columns(source)
        fill_record(self, names=tuple(columns), choices=choices, _columns=tuple(columns.values()))

    @property
    def shape(self) -> tuple[int, ...]:
        """Number of rows."""
        return (self._columns[0].size,)

    def coords(self) -> dict[str, Any]:
        """Return no coordinates: the inputs are variables."""
        return {}

    def inputs(self, box: Box) -> dict[str, NDArray[Any]]:
        """Return the inputs of the points of a box."""
        return {n: values[box[0]] for n, values in zip(self.names, self._columns, strict=True)}

    def description(self) -> dict[str, Any]:
        """Return a hash of the values."""
        digest = hashlib.sha256()
        for values in self._columns:
            digest.update(np.ascontiguousarray(values).tobytes())
        choices = {name: [one.description() for one in self.choices[name]] for name in self.choices}
        names, rows = list(self.names), self.shape[0]
        whole = {"inputs": names, "rows": rows, "choices": choices, "sha256": digest.hexdigest()}
        return {"kind": "table", **whole}


def read_columns(source: str | Path | Mapping[str, Any]) -> tuple[Columns, Choices]:
    """Return the inputs of a table by name, and what the codes of its names stand for."""
    if isinstance(source, str | Path):
        given = _read_csv(source)
    elif hasattr(source, "items"):  # a data frame, too
        given = _series(source)
    else:
        raise refusal("table", source, "must be the name of a CSV file, or a mapping of columns")
    heads = [_head(text) for text in given]
    names = checked_names(name for name, _ in heads)
    columns: Columns = {}
    choices: dict[str, tuple[Choice, ...]] = {}
    for (name, unit), column in zip(heads, given.values(), strict=True):
        if name in columns:
            raise InputError(f"{name}: two columns of this name; a table needs one")
        if name in CHOSEN:
            columns[name], choices[name] = _chosen(name, column)
        else:
            columns[name] = _numbers(leaf(name), unit, column)
    if not columns[names[0]].size:
        raise InputError("table: it has no rows; give at least one case")
    return columns, choices


def _head(text: str) -> tuple[str, str | None]:
    """Return name and unit of a column from its head, "speed [m/s]"."""
    match = HEAD.fullmatch(text)
    return (match[1], match[2]) if match else (text, None)


def _read_csv(path: str | Path) -> "dict[str, pd.Series[Any]]":
    import pandas as pd

    how: dict[str, Any] = {"comment": "#", "skipinitialspace": True, "low_memory": False}
    if tuple(map(int, pd.__version__.split(".")[:2])) < (3, 1):
        how["float_precision"] = "round_trip"  # from then on numbers are always read exactly
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error", pd.errors.ParserWarning)  # rows longer than the header
            frame = pd.read_csv(Path(path), index_col=False, **how)
    except OSError as error:
        reason = error.strerror or error
        raise InputError(f"table: {str(path)!r} cannot be read; {reason}") from None
    except (ValueError, pd.errors.ParserWarning) as error:  # ValueError: of pandas' parser, too
        raise InputError(f"table: {str(path)!r} is not CSV; {str(error).strip()}") from None
    return {str(head): frame[head] for head in frame}


def _series(columns: Mapping[str, Any]) -> "dict[str, pd.Series[Any]]":
    import pandas as pd

    try:
        series = {
            str(name): pd.Series(values if np.ma.isMaskedArray(values) else np.asarray(values))
            for name, values in columns.items()
        }
    except ValueError:
        raise InputError("table: every column must be a list of numbers or of texts") from None
    lengths = {name: len(values) for name, values in series.items()}
    if len(set(lengths.values())) > 1:
        listed = ", ".join(f"{name} {length}" for name, length in lengths.items())
        raise InputError(f"table: columns must be equally long; rows are {listed}")
    return series


def _numbers(key: str, unit: str | None, column: "pd.Series[Any]") -> Array:
    scale = number(key, f"1 {unit}") if unit else 1.0
    if column.dtype.kind in "iuf":
        return np.asarray(column, dtype=np.float64) * scale
    cells = column.astype(str).str.extract(CELL)
    read = cells[0].notna().to_numpy()
    values = np.full(len(column), np.nan)
    values[read] = cells.loc[read, 0].to_numpy(dtype=object).astype(np.float64)
    codes, units = cells[1].factorize()
    scales = np.array([_scale(key, text, scale) for text in units] + [np.nan])
    return np.asarray(values * scales[codes])


def _scale(key: str, unit: str, scale: float) -> float:
    """Return what numbers with this unit are multiplied by; NaN for a unit that does not fit."""
    try:
        return number(key, f"1 {unit}") if unit else scale
    except InputError:
        return np.nan


def _chosen(name: str, column: "pd.Series[Any]") -> tuple[NDArray[Any], tuple[Choice, ...]]:
    codes, values = column.factorize()
    read = [_choice(name, value) for value in values]
    known = [choice for choice in read if choice is not None]
    place = np.full(len(values) + 1, UNREADABLE, dtype=CODE)
    choices = checked_choices(name, known) if known else ()
    place[[i for i, choice in enumerate(read) if choice is not None]] = np.arange(len(choices))
    return place[codes], choices


def _choice(name: str, value: Any) -> Choice | None:
    try:
        return read_choice(name, value.strip() if isinstance(value, str) else value)
    except InputError:
        return None
