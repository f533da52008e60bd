"""Datasets as NetCDF-4, with a checksum of the file behind its end, which other programs pass over.

A program that changes such a file drops what is behind the end, so that a checksum that is there
is one of the file as it was stored.
"""

import re
import struct
from hashlib import sha256
from io import BytesIO
from mmap import ACCESS_READ, mmap
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from carom.io.labels import is_ours
from carom.quantities.refusals import InputError

if TYPE_CHECKING:
    import xarray as xr

SIGNATURE = b"\x89HDF\r\n\x1a\n"
END = {0: 40, 1: 44, 2: 28, 3: 28}  # where HDF5 says how long a file is, by the version of its head
SHORTEST = 52  # bytes of such a head
SEAL = "\n# carom sha256 {}\n"
SEALED = re.compile(SEAL.format("([0-9a-f]{64})").encode())
AS_STORED = {"decode_times": False, "mask_and_scale": False}  # whatever attributes may say
DAMAGED = "it is damaged, or not NetCDF-4"


def write_netcdf(dataset: "xr.Dataset", where: Path) -> None:
    """Write a dataset; raises OSError if there is no room for it.

    HDF5 makes the file in memory: it crashes where a disk is full, or a file may not grow.
    """
    import h5netcdf  # type: ignore[import-untyped]
    from xarray.backends import H5NetCDFStore

    # what has no missing values declares none: CF forbids it of coordinates
    plain = {name: {"_FillValue": None} for name in dataset.variables}
    content = BytesIO()
    with h5netcdf.File(content, "w") as file:
        dataset.drop_encoding().dump_to_store(H5NetCDFStore(file), encoding=plain)
    with where.open("wb") as file, content.getbuffer() as whole:
        file.write(whole)
        file.write(SEAL.format(sha256(whole).hexdigest()).encode())


def read_netcdf(path: Path) -> "xr.Dataset":
    """Return the dataset that `write_netcdf` has written.

    Raises InputError, without the name of the file, if it is another or damaged.
    """
    import h5py
    import xarray as xr

    sealed = _is_sealed(path)
    try:
        with h5py.File(path) as file:  # in silence, where h5netcdf would complain when deleted
            source = file.attrs.get("source")
        if not (sealed or is_ours(source)):
            raise InputError("it was not stored by Carom")
        dataset = xr.load_dataset(path, engine="h5netcdf", **AS_STORED)
    except (PermissionError, InputError):
        raise
    except Exception:  # h5py and xarray raise what they like at a damaged file
        raise InputError(DAMAGED) from None
    dataset.attrs = {
        name: value.item() if isinstance(value, np.generic) else value
        for name, value in dataset.attrs.items()
    }
    return dataset.drop_encoding()


def _is_sealed(path: Path) -> bool:
    """Tell whether there is a checksum; InputError for what is no HDF5 file, or not as it says."""
    if path.stat().st_size < SHORTEST:
        raise InputError(DAMAGED)
    with path.open("rb") as file, mmap(file.fileno(), 0, access=ACCESS_READ) as content:
        if content[: len(SIGNATURE)] != SIGNATURE or content[8] not in END:
            raise InputError(DAMAGED)
        (end,) = struct.unpack_from("<Q", content, END[content[8]])
        if end >= len(content):  # stored without a checksum, or cut
            return False
        seal = SEALED.fullmatch(content[end:])
        with memoryview(content) as view, view[:end] as stored:
            if seal is None or sha256(stored).hexdigest().encode() != seal[1]:
                raise InputError("it is damaged; it has changed since it was stored")
    return True
