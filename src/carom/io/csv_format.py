"""Datasets as CSV: one table to read anywhere, and in comments before it all that it cannot hold.

The first line names the format. Each further comment is a line of JSON: the attributes; the sizes
of the dimensions and those of the table; then each variable with its dimensions, type, attributes,
and its values where the table does not hold them. The table runs along the dimensions of the first
variable that has most of them, one row a point, the last dimension fastest. Floating-point numbers
have as many digits as it takes to give them back to the last bit.
"""

import csv
import json
from collections.abc import Callable, Hashable, Mapping, Sequence
from io import StringIO
from math import isfinite, prod
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from carom.quantities.units import InputError, refusal

if TYPE_CHECKING:
    import xarray as xr

Values = NDArray[Any]
Dims = Sequence[Hashable]
Sizes = Mapping[Hashable, int]

FORMAT = "# carom table 1"
TEXT = "text"
READ: dict[str, Callable[[Any], Any]] = {
    "f": float,
    "i": int,
    "u": int,
    "b": lambda value: {"True": True, "False": False}[str(value)],
    "U": str,
}


def as_csv(dataset: "xr.Dataset") -> str:
    """Return a dataset as CSV, for `from_csv` and for `pandas.read_csv(path, comment="#")`.

    Raises InputError for a variable that holds neither numbers, words nor truth values.
    """
    table = max((tuple(item.dims) for item in dataset.data_vars.values()), key=len, default=())
    sizes = dict(dataset.sizes)
    lines: list[dict[str, Any]] = [
        {"attributes": _packed_all(dataset.attrs)},
        {"dimensions": sizes, "table": table},
    ]
    columns = {}
    for name in [*sorted(dataset.coords, key=_place(table)), *dataset.data_vars]:
        item = dataset.variables[name]
        values = _plain(str(name), item.values)
        is_coordinate = name in dataset.coords
        line = {"coordinate" if is_coordinate else "variable": name, "dims": item.dims}
        line["type"] = _type(values)
        if _is_column(set(item.dims), table, sizes, is_coordinate):
            columns[name] = _spread(values, item.dims, table, sizes).ravel().tolist()
        else:
            line["values"] = _jsonable(values)
        lines.append(line | {"attributes": _packed_all(item.attrs)})
    head = [f"# {json.dumps(line, ensure_ascii=False, allow_nan=False)}\n" for line in lines]
    return f"{FORMAT}\n{''.join(head)}{_body(columns)}"


def from_csv(text: str) -> "xr.Dataset":
    """Return the dataset of which `as_csv` made this text.

    Raises InputError, without the name of the file, if it is another or damaged.
    """
    lines = text.split("\n")
    if lines[0].strip() != FORMAT:
        raise InputError("it was not stored by Carom")
    if not text.endswith("\n"):
        raise InputError("it is damaged; its last line is not whole")
    end = next((i for i, line in enumerate(lines) if not line.startswith("#")), len(lines))
    try:
        head = [json.loads(line[1:]) for line in lines[1:end]]
        return _rebuilt(head, list(csv.reader(StringIO("\n".join(lines[end:]), newline=""))))
    except (ValueError, KeyError, TypeError, IndexError, AttributeError, csv.Error) as error:
        raise InputError(f"it is damaged; {' '.join(str(error).split())}") from None


def _is_column(dims: set[Hashable], table: Dims, sizes: Sizes, is_coordinate: bool) -> bool:
    """Whether the table can hold a variable: along all of it, or a coordinate that repeats."""
    repeats = is_coordinate and bool(dims) and dims < set(table) and prod(sizes.values()) > 0
    return dims == set(table) or repeats


def _place(table: Dims) -> Callable[[Hashable], int]:
    """Return the key that puts coordinates in the order of the dimensions of the table."""
    return lambda name: table.index(name) if name in table else len(table)


def _body(columns: Mapping[Hashable, list[Any]]) -> str:
    stream = StringIO()
    writer = csv.writer(stream, lineterminator="\n")
    if columns:
        writer.writerow(columns)
        writer.writerows(zip(*columns.values(), strict=True))
    return stream.getvalue()


def _rebuilt(head: list[dict[str, Any]], rows: list[list[str]]) -> "xr.Dataset":
    import xarray as xr

    attributes, layout, *described = head
    sizes, table = layout["dimensions"], layout["table"]
    columns = _columns([_name(line) for line in described if "values" not in line], rows)
    variables: dict[str, Any] = {}
    coords: dict[str, Any] = {}
    for line in described:
        name, kind, dims = _name(line), line["type"], line["dims"]
        if "values" in line:
            values = _array(line["values"], kind).reshape([sizes[dim] for dim in dims])
        else:
            whole = _array(columns[name], kind).reshape([sizes[dim] for dim in table])
            values = _gathered(whole, dims, table, sizes)
        into = coords if "coordinate" in line else variables
        into[name] = (dims, values, _unpacked_all(line["attributes"]))
    return xr.Dataset(variables, coords=coords, attrs=_unpacked_all(attributes["attributes"]))


def _name(line: Mapping[str, Any]) -> str:
    return str(line["coordinate"] if "coordinate" in line else line["variable"])


def _columns(names: list[str], rows: list[list[str]]) -> dict[str, list[str]]:
    head, body = (rows[0], rows[1:]) if rows else ([], [])
    if head != names:
        raise ValueError("the columns of the table are not those of its head")
    if any(len(row) != len(names) for row in body):
        raise ValueError("a row of the table is too short or too long")
    return {name: [row[i] for row in body] for i, name in enumerate(names)}


def _spread(values: Values, dims: Dims, table: Dims, sizes: Sizes) -> Values:
    """Return values along some dimensions of the table as values along all, repeated."""
    turned = values.transpose([dims.index(dim) for dim in table if dim in dims])
    shape = [sizes[dim] if dim in dims else 1 for dim in table]
    return np.broadcast_to(turned.reshape(shape), [sizes[dim] for dim in table])


def _gathered(whole: Values, dims: Dims, table: Dims, sizes: Sizes) -> Values:
    """Return what `_spread` has repeated."""
    first = whole[tuple(slice(None) if dim in dims else 0 for dim in table)]
    present = [dim for dim in table if dim in dims]
    values = first.transpose([present.index(dim) for dim in dims])
    same = _spread(values, dims, table, sizes) == whole
    if not np.all(same | (whole != whole)):
        raise ValueError(f"what depends on {', '.join(map(str, dims))} varies along others, too")
    return values


def _plain(name: str, values: Values) -> Values:
    """Return values of a kind that text can hold, words as words of fixed width."""
    kind = values.dtype.kind
    if kind in "OT" and all(isinstance(value, str) for value in values.ravel()):
        return values.astype(np.str_)
    if kind not in "biufU" or (kind == "f" and values.dtype.itemsize > 8):
        raise refusal(name, str(values.dtype), "CSV holds numbers, words and truth values")
    return values


def _type(values: Values) -> str:
    return TEXT if values.dtype.kind == "U" else values.dtype.str[1:]


def _jsonable(values: Values) -> Any:
    """Return an array as what JSON can hold: flat, numbers that are not finite as words."""
    if values.dtype.kind == "f" and not np.all(np.isfinite(values)):
        plain = [value if isfinite(value) else repr(value) for value in values.ravel().tolist()]
    else:
        plain = values.ravel().tolist()
    return plain if values.ndim else plain[0]


def _array(values: Any, kind: str) -> Values:
    """Return what text or JSON holds, one value or a list, as an array of its type."""
    dtype = np.dtype(np.str_ if kind == TEXT else kind)
    read = READ[dtype.kind]
    if isinstance(values, list):
        return np.array([read(value) for value in values], dtype)
    return np.array(read(values), dtype)


def _packed_all(attributes: Mapping[Any, Any]) -> dict[str, Any]:
    return {str(name): _packed(value) for name, value in attributes.items()}


def _packed(value: Any) -> Any:
    """Return an attribute for JSON: as it is, or an array with its type."""
    if isinstance(value, np.int64 | np.float64):  # what NetCDF makes of plain numbers
        value = value.item()
    if isinstance(value, str | int) or (isinstance(value, float) and isfinite(value)):
        return value
    values = _plain("attribute", np.asarray(value))
    return {"type": _type(values), "values": _jsonable(values)}


def _unpacked_all(attributes: Mapping[str, Any]) -> dict[str, Any]:
    """Return attributes as they were before `_packed`."""
    return {
        name: _array(value["values"], value["type"]) if isinstance(value, dict) else value
        for name, value in attributes.items()
    }
