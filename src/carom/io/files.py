"""Storing results as NetCDF, exporting them as CSV, reading them; files are replaced whole.

NetCDF files end with a checksum of all bytes before, which other programs pass over, and HDF5 drops
where another program changes the file. Nothing is read that does not agree with it.
"""

import re
import tomllib
import warnings
from hashlib import sha256
from io import BytesIO
from pathlib import Path
from textwrap import shorten
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np

from carom.io.extras import extra
from carom.io.paths import accessing, checked_output, checked_path, ending_of, opened, replace_whole
from carom.quantities.refusals import InputError, refusal, refuse
from carom.quantities.units import finite_or_text

if TYPE_CHECKING:
    import xarray as xr

TABLES = (".nc", ".csv")
STORE_ENDING = ".zarr"  # of a sweep
EXPORTED = "CSV is an export; store a dataset as .nc to read it again"
OTHER_ENDING = f"must end in .nc, or be the store of a sweep, {STORE_ENDING}"
LONGEST_TEXT = 1_000_000  # characters
DEEP = re.compile(r"(?<![\w\"'-])(?:[\w\"'-]++\s*+\.\s*+){20}")  # a dotted key of that many tables
FIGURES = (".png", ".pdf", ".svg")
DOCUMENTS = (".html", ".pdf")
ANIMATIONS = (".gif", ".mp4")
SEAL = "\n# carom sha256 {}\n"
SEAL_LENGTH = len(SEAL.format(64 * "0"))
NOT_AS_STORED = (
    "it is not as Carom stored it: damaged, changed since, or of another program; "
    "xarray.load_dataset(path, engine='h5netcdf') reads what is there"
)
KEPT = "it keeps numbers, texts and truth values, and such attributes"
AS_STORED: dict[str, Any] = {  # whatever attributes may say
    "engine": "h5netcdf",
    "decode_times": False,
    "mask_and_scale": False,
}
LONGEST_REASON = 160  # characters


class Storable(Protocol):
    """What can be made a dataset: an impact, a load path."""

    def to_dataset(self) -> "xr.Dataset":
        """Return all of it as one dataset."""


def save(result: "xr.Dataset | Storable", path: str | Path) -> Path:
    """Store a dataset or a result as .nc, or export it as .csv, and return its path.

    `carom.read` reads a NetCDF file, which holds everything. A CSV file is one table for other
    programs, which is not read as a dataset again: one row a point, along the dimensions of the
    first variable that has most of them, of an impact with the phase at that time, and with units
    in the header; single numbers and attributes are only in .nc. An existing file is replaced whole
    or not at all, and of a link the file to which it points. The data are written into a pipe or a
    device, as CSV if its name has no ending.

    Parameters
    ----------
    result : xarray.Dataset or a result
        A dataset, or a result with a `to_dataset()`, such as an Impact, a Fit or a Ranking.
    path : str or Path
        Name of the file, which ends in .nc or .csv.

    Returns
    -------
    pathlib.Path
        The file that was written.

    Raises
    ------
    InputError
        If the name has another ending, the file cannot be written, there is no dataset to store, or
        NetCDF would not give it back as it is: dates, names that are not texts, attributes that are
        neither texts nor numbers.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> with TemporaryDirectory() as folder:
    ...     carom.save(carom.curve(1.44, [0.5, 2.0]), folder + "/curve.nc").name
    'curve.nc'
    """
    target, dataset = checked_output(path, TABLES), _dataset(result)
    ending = ending_of(target, TABLES)

    def write(where: Path) -> None:
        if ending == ".nc":
            write_netcdf(dataset, where)
        else:
            where.write_text(_table(dataset), encoding="utf-8", errors="replace", newline="\n")

    return replace_whole(target, write, ending)


def _dataset(result: "xr.Dataset | Storable") -> "xr.Dataset":
    import xarray as xr

    if isinstance(result, xr.Dataset):
        return result
    if isinstance(result, type) or not hasattr(result, "to_dataset"):
        raise refusal("result", result, "must be a dataset, an impact or a load path")
    if isinstance(result, xr.DataArray) and result.name in (None, *result.coords):
        raise refusal("result", result, "it needs its own name; write for example .rename('speed')")
    return result.to_dataset()


def _table(dataset: "xr.Dataset") -> str:
    """Return a dataset as CSV: what runs along its rows, or, if nothing does, its numbers."""
    import pandas as pd

    table = max((tuple(item.dims) for item in dataset.data_vars.values()), key=len, default=())
    if table == ("time",) and "phase" in dataset.dims:  # the phase at each time, as in a history
        which = np.searchsorted(dataset["phase_start"][1:], dataset["time"], side="right")
        dataset = dataset.isel(phase=("time", which))
    along = {dim: dataset.sizes[dim] for dim in table}
    coords = sorted(dataset.coords, key=lambda name: [*table, name].index(name))
    columns = {}
    for name in [*coords, *dataset.data_vars]:
        item: Any = dataset.variables[name].to_base_variable()
        if set(item.dims) <= along.keys() and bool(item.dims) == bool(table):
            unit = item.attrs.get("units", "1")
            head = f"{name}" if unit == "1" else f"{name} [{unit}]"
            columns[head] = item.set_dims(along).values.ravel()
    frame: Any = pd.DataFrame(columns)  # whose methods have no types
    return str(frame.to_csv(index=False, na_rep="nan", lineterminator="\n"))


def read_dataset(source: Path) -> "xr.Dataset":
    """Return the dataset of a file or store, or raise InputError if it is not one of Carom's."""
    ending = source.suffix.lower()
    if ending == STORE_ENDING and source.is_dir():
        sweep: xr.Dataset = extra("carom.io.stores", "a store").read_store(source)
        return sweep
    reason = {".csv": EXPORTED, ".nc": "there is no such file"}.get(ending, OTHER_ENDING)
    if ending == ".nc" and source.is_file():
        reason = NOT_AS_STORED
        try:
            content = source.read_bytes()
            if content[-SEAL_LENGTH:] == _seal(memoryview(content)[:-SEAL_LENGTH]):
                return _of_netcdf(content)
        except OSError as error:
            reason = f"cannot be read; {error.strerror or error}"
    raise refusal("file", str(source), reason)


def read_toml(what: str, path: str | Path, remedy: str = "") -> tuple[dict[str, Any], str]:
    """Return the content of a TOML file that a user names, and its text, or raise InputError."""
    file = checked_path(what, path)
    try:
        with accessing(what, path, "read"), opened(file, encoding="utf-8-sig") as content:
            text: str = content.read(LONGEST_TEXT + 1)
        long = f"it is longer than {LONGEST_TEXT} characters"
        refuse(len(text) > LONGEST_TEXT and refusal(what, str(path), long))
        if DEEP.search(text):  # which takes memory with the square of the depth
            raise RecursionError
        return tomllib.loads(text, parse_float=finite_or_text), text
    except InputError:
        raise
    except UnicodeDecodeError:
        reason = "is not text; give a TOML file"
    except ValueError as error:  # of tomllib; for integers of many digits Python's own
        reason = f"is not TOML; {error}"
    except RecursionError:
        reason = "cannot be used; its tables are nested too deeply"
    raise InputError(f"{what}: {str(path)!r} {reason}{remedy}")


def write_netcdf(dataset: "xr.Dataset", where: Path) -> None:
    """Write a dataset, or raise InputError if it would not come back as it is.

    HDF5 makes the file in memory, where it is read back: it crashes where a disk is full, or a file
    may not grow. Raises OSError if there is no room for the file.
    """
    import xarray as xr

    with warnings.catch_warnings():  # of what would change, which is refused here
        warnings.simplefilter("ignore")
        content = _netcdf(dataset)
        with xr.open_dataset(BytesIO(content), cache=False, **AS_STORED) as back:
            name = _changed(dataset, back)
    refuse(name and f"{name}: NetCDF would not give it back as it is; {KEPT}")
    with where.open("wb") as file:
        file.write(content)
        file.write(_seal(content))


def _of_netcdf(content: bytes) -> "xr.Dataset":
    """Return the dataset that `write_netcdf` has written."""
    import xarray as xr

    with warnings.catch_warnings():  # of xarray and h5netcdf, at what is odd
        warnings.simplefilter("ignore")
        dataset: xr.Dataset = xr.load_dataset(BytesIO(content), **AS_STORED)
    dataset.attrs = {
        name: value.item() if isinstance(value, np.generic) else value
        for name, value in dataset.attrs.items()
    }
    return dataset.drop_encoding()


def _seal(content: bytes | memoryview) -> bytes:
    return SEAL.format(sha256(content).hexdigest()).encode()


def _netcdf(dataset: "xr.Dataset") -> bytes:
    import h5netcdf  # type: ignore[import-untyped]
    from xarray.backends import H5NetCDFStore

    # what has no missing values declares none: CF forbids it of coordinates
    encoding = {name: {"_FillValue": None} for name in dataset.variables}
    plain, content = dataset.drop_encoding(), BytesIO()
    parts: list[Any] = [plain, *plain.variables.values()]
    for part in parts:
        part.attrs = {name: _plain_words(value) for name, value in part.attrs.items()}
    try:
        with h5netcdf.File(content, "w") as file:
            plain.dump_to_store(H5NetCDFStore(file), encoding=encoding)
    except Exception as error:  # h5netcdf and xarray raise what they like
        reason = shorten(f"{error}", LONGEST_REASON)
        raise InputError(f"dataset: NetCDF cannot hold it, as {KEPT}; {reason}") from None
    return content.getvalue()


def _plain_words(value: Any) -> Any:
    """Return texts of NumPy, which HDF5 does not know, as those of Python."""
    return value.tolist() if getattr(value, "dtype", np.dtype(float)).kind == "U" else value


def _changed(dataset: "xr.Dataset", back: "xr.Dataset") -> str:
    """Return the name of what is otherwise in the dataset that was read back, if anything is."""
    for name in {**dataset.variables, **back.variables}:
        here, there = dataset.variables.get(name), back.variables.get(name)
        if here is None or there is None or not _same(here, there.compute()):
            return f"{name}"
    same = set(dataset.coords) == set(back.coords) and _attributes(dataset) == _attributes(back)
    return "" if same else "dataset"


def _same(here: Any, there: Any) -> bool:
    types = _type(here) == _type(there) and _attributes(here) == _attributes(there)
    return bool(types and here.identical(there))


def _type(item: Any) -> Any:
    dtype = item.dtype
    if not isinstance(dtype, np.dtype) or hasattr(item.data, "to_root_units"):
        return type(item.data)
    return "words" if dtype.kind in "OTU" else (dtype.kind, dtype.itemsize)


def _attributes(item: Any) -> dict[str, str]:
    """Return attributes so that ["a"] is not "a", which xarray takes for the same."""
    return {name: repr(np.asarray(value).tolist()) for name, value in item.attrs.items()}
