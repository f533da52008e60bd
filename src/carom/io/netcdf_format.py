"""Datasets as NetCDF-4 with a checksum at the end of the file, which other programs pass over.

The checksum is that of all bytes before it, and nothing is read that does not agree with it. HDF5
drops it where another program changes the file.
"""

import warnings
from hashlib import sha256
from io import BytesIO
from pathlib import Path
from textwrap import shorten
from typing import TYPE_CHECKING, Any

import numpy as np

from carom.quantities.refusals import InputError, refuse

if TYPE_CHECKING:
    import xarray as xr

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


def read_netcdf(path: Path) -> "xr.Dataset":
    """Return the dataset that `write_netcdf` has written.

    Raises InputError, without the name of the file, if it is another, or has changed since.
    """
    import xarray as xr

    content = path.read_bytes()
    if content[-SEAL_LENGTH:] != _seal(memoryview(content)[:-SEAL_LENGTH]):
        raise InputError(NOT_AS_STORED)
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
