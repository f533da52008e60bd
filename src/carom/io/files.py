"""Storing results as NetCDF, exporting them as CSV, reading them; files are replaced whole."""

import re
import tomllib
import warnings
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np

from carom.io.extras import extra
from carom.io.netcdf_format import read_netcdf, write_netcdf
from carom.io.paths import accessing, checked_output, checked_path, ending_of, opened, replace_whole
from carom.quantities.refusals import InputError, refusal, refuse
from carom.quantities.units import finite_or_text

if TYPE_CHECKING:
    import xarray as xr

TABLES = (".nc", ".csv")
STORE_ENDING = ".zarr"  # of a sweep
EXPORTED = (
    "CSV is an export; store a dataset as .nc to read it again, "
    "one of Carom 0.2 there by carom.save(carom.read('x.csv'), 'x.nc')"
)
LONGEST_TEXT = 1_000_000  # characters
DEEP = re.compile(r"(?<![\w\"'-])(?:[\w\"'-]++\s*+\.\s*+){20}")  # a dotted key of that many tables
FIGURES = (".png", ".pdf", ".svg")
DOCUMENTS = (".html", ".pdf")
ANIMATIONS = (".gif", ".mp4")


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
    reason = f"must end in .nc, or be the store of a sweep, {STORE_ENDING}"
    if ending == ".csv":
        reason = EXPORTED
    elif ending == ".nc" and not source.is_file():
        reason = "there is no such file"
    elif ending == ".nc":
        try:
            with warnings.catch_warnings():  # of xarray and h5netcdf, at what is odd
                warnings.simplefilter("ignore")
                return read_netcdf(source)
        except OSError as error:
            reason = f"cannot be read; {error.strerror or error}"
        except InputError as error:
            reason = str(error)
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
