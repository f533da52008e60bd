"""A sweep in a Zarr store: made whole, written block by block by one process, continued.

Each file is written whole or not at all, the status of a block after everything else of it. So a
block is finished exactly when no point of it has the status `NOT_RUN`, whatever happened to the
process that wrote it; unless a file of it has been damaged since, which its checksum tells.
"""

import errno
import json
import os
import shutil
import uuid
import warnings
from collections.abc import Iterable, Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from itertools import islice
from pathlib import Path
from textwrap import shorten
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from carom.dimensionless.numerics.threads import available_cores
from carom.io.extras import extra
from carom.io.files import STORE
from carom.io.paths import checked_path
from carom.io.stores import LEVEL, STATUS, chunks_of, freeze, read_store, seal
from carom.io.version import __version__
from carom.quantities.refusals import refusal
from carom.sweeps.blocks import Box, Values, boxes
from carom.sweeps.points import PointStatus
from carom.sweeps.problem import SweepProblem
from carom.sweeps.records import SweepStopped, blank_dataset, identity

if TYPE_CHECKING:
    import xarray as xr

LOCK = f"{STATUS}/.lock"  # a place that zarr does not list
FULL = (errno.ENOSPC, errno.EDQUOT)
SHOWN = 3  # differences in a refusal


def codecs() -> dict[str, Any]:
    """Return the codecs of such arrays, for `zarr.Group.create_array`."""
    zarr_codecs = extra("zarr.codecs", "a store")
    return {
        "serializer": zarr_codecs.BytesCodec(endian="little"),
        "compressors": zarr_codecs.ZstdCodec(level=LEVEL, checksum=True),
    }


def key_of(name: str, corner: Sequence[int]) -> str:
    """Return the place in a store of the chunk with this index of an array."""
    return "/".join((name, "c", *map(str, corner)))


def write_chunk(
    array: Path,
    corner: Sequence[int],
    chunk: Sequence[int],
    values: NDArray[Any],
    store: bytes = b"",
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
    store : bytes
        What tells the store from others, for the seal.
    """
    zstd = extra("numcodecs.zstd", "a store").Zstd(LEVEL, checksum=True)
    whole = np.zeros(chunk, values.dtype.newbyteorder("<"))
    whole[tuple(slice(length) for length in values.shape)] = values
    key, content = key_of(array.name, corner), zstd.encode(whole)
    target = array.parent / key
    target.parent.mkdir(parents=True, exist_ok=True)
    partial = target.with_name(f"{target.name}.partial")
    try:
        partial.write_bytes(content + seal(store, key, content))
        os.replace(partial, target)
    except BaseException:
        partial.unlink(missing_ok=True)
        raise


class StoreRecord:
    """A sweep in a Zarr store, for the process that holds its lock."""

    def __init__(self, path: Path, names: Iterable[str]) -> None:
        self.path = path
        self._names = list(names)
        there = read_store(path)
        self._chunks = chunks_of(there, path)
        self._shape = there[STATUS].encoding["chunks"]
        blocks = list(boxes(there[STATUS].shape, self._shape))
        with ThreadPoolExecutor(available_cores()) as pool:
            finished = list(pool.map(self._is_finished, blocks))
        self.todo = [box for box, whole in zip(blocks, finished, strict=True) if not whole]
        self._number, self._finished = len(blocks), sum(finished)

    def _is_finished(self, box: Box) -> bool:
        """Tell whether a block is there as a whole, and none of its files is damaged."""
        status = self._read(STATUS, box)
        if status is None or PointStatus.NOT_RUN in np.frombuffer(status, np.int8):
            return False
        return all(self._read(name, box) is not None for name in self._names)

    def _read(self, name: str, box: Box) -> bytes | None:
        key = key_of(name, self._corner(box))
        try:
            return self._chunks.decoded(key, (self.path / key).read_bytes())
        except OSError:
            return None

    def _corner(self, box: Box) -> list[int]:
        return [part.start // size for part, size in zip(box, self._shape, strict=True)]

    def write(self, box: Box, values: Values) -> None:
        """Write a block, its status last; raises SweepStopped if that fails."""
        corner, store = self._corner(box), self._chunks.store
        try:
            for name in sorted(values, key=STATUS.__eq__):
                write_chunk(self.path / name, corner, self._shape, values[name], store)
        except OSError as error:
            advice = "; free some space" if error.errno in FULL else ""
            raise SweepStopped(f"{self.path}: {error.strerror}{advice}") from None
        self._finished += 1

    def safe(self) -> str:
        """Return what has been finished, and how to go on."""
        number = f"{self._finished} of {self._number} blocks"
        return f"{number} are safe in {self.path}; --resume (resume=True) continues there"

    def dataset(self) -> "xr.Dataset":
        """Return the sweep, its values read when they are used."""
        return read_store(self.path)[self._names]


@contextmanager
def opened(folder: str | Path, problem: SweepProblem, resume: bool) -> Iterator[StoreRecord]:
    """Make a store, or check the one that is there, and hold it against other processes.

    Raises InputError if it is there and `resume` is not set, if another process holds it, or if it
    is not of this sweep.
    """
    path = _checked(folder)
    if not path.exists():
        _create(path, problem)
    elif not resume:
        read_store(path)
        raise refusal("store", str(path), "it exists already; --resume (resume=True) continues it")
    else:
        _check(path, problem)
    with _locked(path):
        yield StoreRecord(path, problem.variables())


def _checked(folder: str | Path) -> Path:
    kind = f"folder that ends in {STORE}"
    path = checked_path("store", folder, kind)
    if path.suffix.lower() != STORE:
        raise refusal("store", str(folder), f"must be the name of a {kind}")
    if not os.path.isdir(os.path.dirname(os.path.realpath(path))):
        raise refusal("store", str(path), "the folder that holds it must exist; make it first")
    return path


@contextmanager
def _locked(path: Path) -> Iterator[None]:
    filelock = extra("filelock", "a store")
    lock = filelock.FileLock(path / LOCK, blocking=False)
    try:
        lock.acquire()
    except filelock.Timeout:
        raise refusal("store", str(path), "another process is writing it; wait for it") from None
    except OSError as error:
        raise refusal("store", str(path), f"cannot be written; {error.strerror}") from None
    try:
        yield
    finally:
        lock.release()


def _create(path: Path, problem: SweepProblem) -> None:
    """Make a store without points, whole or not at all."""
    target = os.path.realpath(path)
    new = Path(os.path.dirname(target), f".carom-{uuid.uuid4().hex}")
    try:
        with warnings.catch_warnings():  # of what the format 3 does not yet have on paper
            warnings.simplefilter("ignore")
            _fill(new, problem)
        freeze(new)
        os.rename(new, target)
    except OSError as error:
        reason = f"cannot be made; {error.strerror}"
        if error.errno in (errno.EEXIST, errno.ENOTEMPTY):
            reason = "another process has just made it"
        raise refusal("store", str(path), reason) from None
    finally:
        shutil.rmtree(new, ignore_errors=True)


def _fill(path: Path, problem: SweepProblem) -> None:
    zarr = extra("zarr", "a store")
    blank_dataset(problem).to_zarr(path, zarr_format=3, consolidated=False)
    group = zarr.open_group(path, mode="r+")
    shape, dims = problem.design.shape, problem.design.dims
    layout = {"shape": shape, "chunks": problem.chunks(), "dimension_names": dims, **codecs()}
    for name, info in problem.variables().items():
        told = {"fill_value": _blank(name, info.dtype), "attributes": _jsonable(info.attributes)}
        group.create_array(name, dtype=info.dtype, **layout, **told)
    zarr.consolidate_metadata(path)


def _blank(name: str, dtype: Any) -> Any:
    """Return what stands for a point that has not been run."""
    if name == STATUS:
        return PointStatus.NOT_RUN.value
    return np.nan if np.dtype(dtype).kind == "f" else None


def _jsonable(attributes: Mapping[str, Any]) -> dict[str, Any]:
    return {
        name: value.tolist() if isinstance(value, np.ndarray | np.generic) else value
        for name, value in attributes.items()
    }


def _check(path: Path, problem: SweepProblem) -> None:
    """Raise InputError unless this is a store of this sweep."""
    dataset = read_store(path)
    version = str(dataset.attrs["source"]).removeprefix("carom ")
    if version != __version__:
        raise refusal(
            "store", str(path), f"carom {version} has written it, and this is carom {__version__}"
        )
    found = islice(_differences(json.loads(dataset.attrs["inputs"]), identity(problem), ""), SHOWN)
    if words := "; ".join(found):
        raise refusal("store", str(path), f"it holds another sweep: {words}")


def _differences(there: Any, here: Any, name: str) -> Iterator[str]:
    """Yield in words in what two descriptions differ."""
    if isinstance(there, dict) and isinstance(here, dict):
        for key in {**there, **here}:
            yield from _differences(there.get(key), here.get(key), f"{name}.{key}".strip("."))
    elif there != here:
        shown = (
            "not given" if value is None else shorten(str(value), 40) for value in (there, here)
        )
        yield "{} is {} there and {} here".format(name, *shown)
