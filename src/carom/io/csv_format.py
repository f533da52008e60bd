"""Datasets as CSV: one table to read anywhere, and in comments before it all that it cannot hold.

The first line names the format. Each further comment is a line of JSON: the attributes; the sizes
of the dimensions and those of the table; then each variable with its dimensions, type, attributes,
and its values where the table does not hold them. The table runs along the dimensions of the first
variable that has most of them, one row a point, the last dimension fastest. Floating-point numbers
have as many digits as it takes to give them back to the last bit. The last comment is the SHA-256
of all other lines.
"""

import csv
import json
import re
from collections.abc import Callable, Hashable, Mapping, Sequence
from hashlib import sha256
from io import StringIO
from math import isfinite, prod
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from carom.quantities.refusals import InputError

if TYPE_CHECKING:
    import xarray as xr

Values = NDArray[Any]
Reader = Callable[[Any], Any]

FORMAT = "# carom table 1"
SEAL = '# {{"sha256": "{}"}}\n'
SEALED = re.compile(r'^# \{"sha256": "([0-9a-f]{64})"\}\r?\n', re.MULTILINE)
TEXT = "text"
FAULTS = (
    *(ValueError, LookupError, TypeError, AttributeError, ArithmeticError, csv.Error),
    *(MemoryError, RecursionError),
)
TRUTH = {"True": True, "False": False}
READ: dict[str, Reader] = {"f": float, "i": int, "u": int, "U": str, "b": lambda x: TRUTH[str(x)]}


def as_csv(dataset: "xr.Dataset") -> str:
    """Return a dataset that is `storable` as CSV, for `from_csv` and for pandas."""
    import xarray as xr

    table = max((tuple(item.dims) for item in dataset.data_vars.values()), key=len, default=())
    sizes = dict(dataset.sizes)
    along = {dim: sizes[dim] for dim in table}
    lines: list[dict[str, Any]] = [
        {"attributes": _packed_all(dataset.attrs)},
        {"dimensions": sizes, "table": table},
    ]
    columns = {}
    coords = sorted(dataset.coords, key=lambda name: [*table, name].index(name))
    for name in [*coords, *dataset.data_vars]:
        item = dataset.variables[name]
        values = _plain(item.values)
        kind = "coordinate" if name in dataset.coords else "variable"
        line = {kind: name, "dims": item.dims, "type": _type(values)}
        # the table holds what runs along all of it, and coordinates, which repeat
        repeats = name in dataset.coords and item.dims and prod(sizes.values()) > 0
        if set(item.dims) == set(table) or (repeats and set(item.dims) < set(table)):
            spread: Any = xr.Variable(item.dims, values)  # whose set_dims has no types
            columns[name] = spread.set_dims(along).values.ravel().tolist()
        else:
            line["values"] = _jsonable(values)
        lines.append(line | {"attributes": _packed_all(item.attrs)})
    told = (f"# {json.dumps(line, ensure_ascii=False, allow_nan=False)}\n" for line in lines)
    head, rows = f"{FORMAT}\n{''.join(told)}", rows_of(columns)
    return head + SEAL.format(_digest(head + rows)) + rows


def from_csv(text: str) -> "xr.Dataset":
    """Return the dataset of which `as_csv` made this text.

    Raises InputError, without the name of the file, if it is another or damaged.
    """
    text = _unsealed(text)
    lines = text.split("\n")
    if lines[0].strip() != FORMAT:
        raise InputError("it was not stored by Carom")
    if not text.endswith("\n"):
        raise InputError("it is damaged; its last line is not complete")
    end = next((i for i, line in enumerate(lines) if not line.startswith("#")), len(lines))
    try:
        head = [json.loads(line[1:]) for line in lines[1:end]]
        return _rebuilt(head, list(csv.reader(StringIO("\n".join(lines[end:]), newline=""))))
    except FAULTS as error:
        raise InputError(f"it is damaged; {' '.join(str(error).split())}") from None


def _unsealed(text: str) -> str:
    """Return what was stored without its checksum; of ends of lines either kind will do.

    Raises InputError if something has changed. Text without a checksum is returned as it is.
    """
    seal = SEALED.search(text)
    if seal is None:
        return text
    rest = text[: seal.start()] + text[seal.end() :]
    for stored in (rest, rest.replace("\r\n", "\n")):
        if _digest(stored) == seal[1]:
            return stored
    raise InputError(
        "it is damaged, or was changed after it was stored; delete its line 'sha256' to read it "
        "anyway"
    )


def _digest(text: str) -> str:
    return sha256(text.encode("utf-8", "surrogatepass")).hexdigest()


def rows_of(columns: Mapping[Any, Sequence[Any]]) -> str:
    """Return columns as CSV: their names, and below them a line for each row."""
    lines: list[str] = []
    stream = SimpleNamespace(write=lambda line: lines.append(f"{line[:-2]}\n"))
    writer = csv.writer(stream, lineterminator="\r\n")  # that it quotes either of them in a text
    if columns:
        writer.writerow(columns)
        writer.writerows(zip(*columns.values(), strict=True))
    return "".join(lines)


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
            values = _gathered(xr.Variable(table, whole), dims)
        into = coords if "coordinate" in line else variables
        into[name] = (dims, values, _unpacked_all(line["attributes"]))
    return xr.Dataset(variables, coords=coords, attrs=_unpacked_all(attributes["attributes"]))


def _name(line: Mapping[str, Any]) -> str:
    return str(line["coordinate"] if "coordinate" in line else line["variable"])


def _columns(names: list[str], rows: list[list[str]]) -> dict[str, list[str]]:
    head, body = (rows[0], rows[1:]) if rows else ([], [])
    if head != names:
        raise ValueError("the columns of the table differ from those of its head")
    if any(len(row) != len(names) for row in body):
        raise ValueError("a row of the table is too short or too long")
    return {name: [row[i] for row in body] for i, name in enumerate(names)}


def _gathered(whole: "xr.Variable", dims: Sequence[Hashable]) -> Values:
    """Return values along some dimensions that are repeated along the others of a table."""
    first: Any = whole.isel({dim: 0 for dim in whole.dims if dim not in dims}).transpose(*dims)
    same = first.set_dims(whole.sizes).values == whole.values
    if not np.all(same | (whole.values != whole.values)):
        raise ValueError(f"what depends on {', '.join(map(str, dims))} varies along others, too")
    return np.asarray(first.values)


def _plain(values: Values) -> Values:
    """Return values with words as words of fixed width."""
    return values.astype(np.str_) if values.dtype.kind in "OT" else values


def _type(values: Values) -> str:
    return TEXT if values.dtype.kind == "U" else values.dtype.str[1:]


def _jsonable(values: Values) -> Any:
    """Return an array as what JSON can hold: flat, numbers that are not finite as words."""
    plain = values.ravel().tolist()
    if values.dtype.kind == "f":
        plain = [value if isfinite(value) else repr(value) for value in plain]
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
    values = np.asarray(value)
    return {"type": _type(values), "values": _jsonable(values)}


def _unpacked_all(attributes: Mapping[str, Any]) -> dict[str, Any]:
    """Return attributes as they were before `_packed`."""
    return {name: _unpacked(value) for name, value in attributes.items()}


def _unpacked(value: Any) -> Any:
    if not isinstance(value, dict):
        return value
    values = _array(value["values"], value["type"])
    return values.tolist() if value["type"] == TEXT else values[()]
