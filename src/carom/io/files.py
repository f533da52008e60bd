"""Storing results as NetCDF or CSV and reading them; files are replaced whole or not at all."""

import warnings
from pathlib import Path
from typing import TYPE_CHECKING, Protocol

from carom.io.csv_format import as_csv, from_csv
from carom.io.netcdf_format import read_netcdf, write_netcdf
from carom.io.paths import checked_output, checked_path, ending_of, opened, replace_whole
from carom.io.storable import storable
from carom.io.stores import read_store
from carom.quantities.refusals import InputError, refusal

if TYPE_CHECKING:
    import xarray as xr

TABLES = (".nc", ".csv")
STORE = ".zarr"  # of a sweep
LONGEST_TEXT = 1_000_000  # characters
FIGURES = (".png", ".pdf", ".svg")
ANIMATIONS = (".gif", ".mp4")


class Storable(Protocol):
    """What can be made a dataset: an impact, a load path."""

    def to_dataset(self) -> "xr.Dataset":
        """Return all of it as one dataset."""


def save(result: "xr.Dataset | Storable", path: str | Path) -> Path:
    """Store a dataset or a result as .nc or .csv and return its path; `carom.read` reads it.

    An existing file is replaced whole or not at all, and of a link the file to which it points. The
    data are written into a pipe or a device, as CSV if its name has no ending. A CSV file is one
    table with everything else in comments, which `pandas.read_csv(path, comment="#")` reads, too.

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
        it holds something that could not be read exactly, such as dates, names that are not texts,
        or attributes that are neither texts nor numbers.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> import carom
    >>> with TemporaryDirectory() as folder:
    ...     carom.save(carom.curve(1.44, [0.5, 2.0]), folder + "/curve.csv").name
    'curve.csv'
    """
    target, dataset = checked_output(path, TABLES), storable(_dataset(result))
    ending = ending_of(target, TABLES)

    def write(where: Path) -> None:
        if ending == ".nc":
            write_netcdf(dataset, where)
        else:
            where.write_text(as_csv(dataset), encoding="utf-8", newline="\n")

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


def read_dataset(source: Path) -> "xr.Dataset":
    """Return the dataset of a file or store, or raise InputError if it is not one of Carom's."""
    if source.suffix.lower() == STORE and source.is_dir():
        return read_store(source)
    if source.suffix.lower() not in TABLES:
        allowed = f"must end in {' or '.join(TABLES)}, or be the store of a sweep, {STORE}"
        raise refusal("file", str(source), allowed)
    if not source.is_file():
        raise refusal("file", str(source), "there is no such file")
    try:
        with warnings.catch_warnings():  # of xarray and h5netcdf, at what is odd or damaged
            warnings.simplefilter("ignore")
            if source.suffix.lower() == ".nc":
                return read_netcdf(source)
            return from_csv(source.read_bytes().decode("utf-8-sig"))
    except OSError as error:
        reason = f"cannot be read; {error.strerror or error}"
    except UnicodeDecodeError:
        reason = "it is not text"
    except InputError as error:
        reason = str(error)
    raise refusal("file", str(source), reason)


def read_text(what: str, path: str | Path) -> str:
    """Return the text of a file that a user names, with line ends of Unix.

    Raises InputError if it cannot be read or is too long, and UnicodeDecodeError if it is not in
    UTF-8.
    """
    try:
        with opened(checked_path(what, path), encoding="utf-8-sig") as file:
            text: str = file.read(LONGEST_TEXT + 1)
    except OSError as error:
        reason = error.strerror or error
        raise InputError(f"{what}: {str(path)!r} cannot be read; {reason}") from None
    if len(text) > LONGEST_TEXT:
        raise refusal(what, str(path), f"it is longer than {LONGEST_TEXT} characters")
    return text
