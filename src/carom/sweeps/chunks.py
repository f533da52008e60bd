"""A chunk of a Zarr array as a file, written whole or not at all.

The format is that of the Zarr specification, version 3: the values of the full chunk in C order,
little-endian, then Zstandard. zarr reads it; its own writer, made for stores that answer slowly,
takes ten times as long, which is as much as a hundred impacts.
"""

import os
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from carom.extras import extra

LEVEL = 1  # of compression: floating-point numbers gain nothing from more


def codecs() -> dict[str, Any]:
    """Return the codecs of such arrays, for `zarr.Group.create_array`."""
    zarr_codecs = extra("zarr.codecs", "a store")
    return {
        "serializer": zarr_codecs.BytesCodec(endian="little"),
        "compressors": zarr_codecs.ZstdCodec(level=LEVEL, checksum=True),
    }


def chunk_file(array: Path, corner: Sequence[int]) -> Path:
    """Return the file of the chunk with this index in the folder of an array."""
    return array.joinpath("c", *map(str, corner))


def write_chunk(
    array: Path, corner: Sequence[int], chunk: Sequence[int], values: NDArray[Any]
) -> None:
    """Write the values of a chunk, which may be cut by the end of the array.

    Parameters
    ----------
    array : Path
        Folder of the array.
    corner, chunk : sequence of int
        Index of the chunk, and the shape that chunks have.
    values : ndarray
        What the chunk has inside the array.
    """
    zstd = extra("numcodecs.zstd", "a store").Zstd(LEVEL, checksum=True)
    whole = np.zeros(chunk, values.dtype.newbyteorder("<"))
    whole[tuple(slice(length) for length in values.shape)] = values
    target = chunk_file(array, corner)
    target.parent.mkdir(parents=True, exist_ok=True)
    partial = target.with_name(f"{target.name}.partial")
    try:
        partial.write_bytes(zstd.encode(whole))
        os.replace(partial, target)
    except OSError:
        partial.unlink(missing_ok=True)
        raise
