"""Reading stored datasets and case files."""

from pathlib import Path
from typing import TYPE_CHECKING, Any

from carom.bodies.cases import read_case
from carom.io.files import read_dataset
from carom.io.paths import checked_path

if TYPE_CHECKING:
    import xarray as xr


def read(path: str | Path) -> "xr.Dataset | dict[str, Any]":
    """Return a dataset that Carom stored as .nc or .zarr, or the case of a .toml file.

    Parameters
    ----------
    path : str or Path
        A NetCDF file (.nc) that `save` or the option `--output` of a command has written, the store
        of a sweep (.zarr), whose values are read only when they are used, or a case file (.toml).

    Returns
    -------
    xarray.Dataset or dict
        Variables and coordinates exactly as they were stored, with units and meanings as
        attributes. For a case file, its content as `sweep` accepts it.

    Raises
    ------
    InputError
        If the file is missing, damaged, changed or not stored by Carom, or a case has an unknown
        key.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> import carom
    >>> with TemporaryDirectory() as folder:
    ...     stored = carom.save(carom.curve(1.44, [0.5, 2.0]), folder + "/curve.nc")
    ...     carom.read(stored).psi_out.values.round(4)
    array([[ 0.0471, -0.839 ]])
    """
    source = checked_path("file", path)
    if source.suffix.lower() == ".toml":
        return read_case(source, losses=True)
    return read_dataset(source)
