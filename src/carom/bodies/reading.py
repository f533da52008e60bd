"""What Carom has stored, and case files, read again."""

from pathlib import Path
from typing import TYPE_CHECKING, Any

from carom.bodies.cases import read_case
from carom.io.files import read_dataset
from carom.io.paths import checked_path

if TYPE_CHECKING:
    import xarray as xr


def read(path: str | Path) -> "xr.Dataset | dict[str, Any]":
    """Return the dataset that Carom stored as .nc, .csv or .zarr, or the case of a .toml file.

    Parameters
    ----------
    path : str or Path
        A file that `save` or the option --output of a command has written; the store of a sweep,
        .zarr, whose values are read when they are used; or a case file, .toml.

    Returns
    -------
    xarray.Dataset or dict
        Variables and coordinates as they were stored, to the last bit, with their units and
        meanings as attributes; of a case file what it says, which `sweep` takes.

    Raises
    ------
    InputError
        If the file is missing, damaged, or not one of Carom's, or a key of a case is not known.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> import carom
    >>> with TemporaryDirectory() as folder:
    ...     stored = carom.save(carom.curve(1.44, [0.5, 2.0]), folder + "/curve.csv")
    ...     carom.read(stored).psi_out.values.round(4)
    array([[ 0.0471, -0.839 ]])
    """
    source = checked_path("file", path)
    if source.suffix.lower() == ".toml":
        return read_case(source, losses=True)
    return read_dataset(source)
