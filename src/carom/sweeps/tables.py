"""Tables of cases: columns of numbers with units, or of names, from a CSV file or a mapping."""

import hashlib
import re
import warnings
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from carom.io.tables import require_equal_lengths
from carom.quantities.arrays import Array
from carom.quantities.units import InputError, number, refusal
from carom.sweeps.blocks import Box
from carom.sweeps.designs import Design
from carom.sweeps.inputs import (
    CHOSEN,
    CODE,
    UNREADABLE,
    Choice,
    Choices,
    checked_choices,
    checked_names,
    leaf,
    read_choice,
)

HEAD = re.compile(r"\s*([^\[]*?)\s*(?:\[(.*)\])?\s*")
CELL = r"^\s*([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?|[+-]?inf)\s*(.*?)\s*$"


@dataclass(frozen=True, eq=False, init=False)
class Table(Design):
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

    def __init__(self, source: str | Path | Mapping[str, Any]) -> None:
        super().__init__(*_read(source))

    @property
    def shape(self) -> tuple[int, ...]:
        """Number of rows."""
        return (self._given[self.names[0]].size,)

    def inputs(self, box: Box) -> dict[str, NDArray[Any]]:
        """Return the inputs of the points of a box."""
        return {name: values[box[0]] for name, values in self._given.items()}

    def description(self) -> dict[str, Any]:
        """Return a hash of the values."""
        digest = hashlib.sha256()
        for values in self._given.values():
            digest.update(np.ascontiguousarray(values).tobytes())
        choices = {name: [one.description() for one in self.choices[name]] for name in self.choices}
        whole = {"inputs": list(self.names), "rows": self.shape[0], "choices": choices}
        return {"kind": "table", **whole, "sha256": digest.hexdigest()}


def _read(source: str | Path | Mapping[str, Any]) -> tuple[Choices, dict[str, NDArray[Any]]]:
    """Return what the codes of names stand for, and the inputs by name."""
    if isinstance(source, str | Path):
        given = _read_csv(source)
    elif hasattr(source, "items"):  # a data frame, too
        given = _series(source)
    else:
        raise refusal("table", source, "must be the name of a CSV file, or a mapping of columns")
    heads = [_head(text) for text in given]
    names = checked_names(name for name, _ in heads)
    columns: dict[str, NDArray[Any]] = {}
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
    return choices, columns


def _head(text: str) -> tuple[str, str | None]:
    """Return name and unit of a column from its head, "speed [m/s]"."""
    match = HEAD.fullmatch(text)
    return (match[1], match[2]) if match else (text, None)


def _read_csv(path: str | Path) -> "dict[str, pd.Series[Any]]":
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
    try:
        series = {
            str(name): pd.Series(values if np.ma.isMaskedArray(values) else np.asarray(values))
            for name, values in columns.items()
        }
    except ValueError:
        raise InputError("table: every column must be a list of numbers or of texts") from None
    require_equal_lengths("table", series)
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
    read: dict[int, Choice] = {}
    for i, value in enumerate(values):
        with suppress(InputError):
            read[i] = read_choice(name, value.strip() if isinstance(value, str) else value)
    choices = checked_choices(name, list(read.values())) if read else ()
    place = np.full(len(values) + 1, UNREADABLE, dtype=CODE)
    place[list(read)] = np.arange(len(choices))
    return place[codes], choices
