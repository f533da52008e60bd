"""A sweep in a Zarr store: made whole, written block by block by one process, continued.

Zarr writes each file whole or not at all, the status of a block after everything else of it. So a
block is finished exactly when no point of it has the status `NOT_RUN`, whatever happened to the
process that wrote it; unless a file of it has been damaged since, which its seal tells.

This needs zarr: import it by `extra`.
"""

import errno
import json
import os
import shutil
import uuid
import warnings
from collections.abc import Iterable, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from itertools import islice
from pathlib import Path
from textwrap import shorten
from typing import TYPE_CHECKING, Any

import filelock
import numpy as np
import zarr
from zarr.codecs import ZstdCodec
from zarr.core.buffer import Buffer
from zarr.storage import MemoryStore

from carom.dimensionless.numerics.threads import available_cores
from carom.io.files import STORE_ENDING
from carom.io.paths import FULL, checked_path, unwritten
from carom.io.stores import CHUNK, STATUS, SealedStore, freeze, read_store
from carom.io.version import __version__
from carom.many.sweeps.designs import Box, Values, boxes
from carom.many.sweeps.points import PointStatus
from carom.many.sweeps.problem import SweepProblem
from carom.many.sweeps.records import SweepStopped, blank_dataset, identity
from carom.quantities.refusals import refusal, refuse

if TYPE_CHECKING:
    import xarray as xr

LOCK = f"{STATUS}/.lock"  # a place that zarr does not list
COMPRESSOR = ZstdCodec(level=1)  # floating-point numbers gain nothing from more
BLANK = {"float64": np.nan, "int8": PointStatus.NOT_RUN.value}  # of points that have not been run
MOST_DIFFERENCES = 3  # in a refusal


class StoreRecord:
    """A sweep in a Zarr store, for the process that holds its lock."""

    def __init__(self, path: Path, names: Iterable[str]) -> None:
        self.path = path
        self._store = SealedStore(path, read_only=False)
        with zarr.config.set({"array.write_empty_chunks": True}):
            group = zarr.open_consolidated(self._store, mode="r+")
            self._arrays: dict[str, Any] = {name: group[name] for name in names}
        status = self._arrays[STATUS]
        self._chunks = status.chunks
        for partial in path.rglob("*.partial"):  # of a process that was killed
            partial.unlink()
        blocks = list(boxes(status.shape, self._chunks))
        with ThreadPoolExecutor(available_cores()) as pool:
            finished = list(pool.map(self._is_finished, blocks))
        self.todo = [box for box, whole in zip(blocks, finished, strict=True) if not whole]
        self._number, self._finished = len(blocks), sum(finished)

    def _is_finished(self, box: Box) -> bool:
        """Tell whether a block is there as a whole, and none of its files is damaged."""
        if not all(self._store.is_sound(key) for key in self._keys(box)):
            return False
        return PointStatus.NOT_RUN not in self._arrays[STATUS][box]

    def _keys(self, box: Box) -> list[str]:
        """Return the names of the files of a block."""
        corner = "/".join(str(p.start // n) for p, n in zip(box, self._chunks, strict=True))
        return [f"{name}{CHUNK}{corner}" for name in self._arrays]

    def write(self, box: Box, values: Values) -> None:
        """Write a block, its status last; raises SweepStopped if that fails."""
        try:
            for name in sorted(values, key=STATUS.__eq__):
                self._arrays[name][box] = values[name]
        except OSError as error:
            for key in self._keys(box):  # a block that lacks its status alone counts as damaged
                (self.path / key).unlink(missing_ok=True)
            advice = "; free some space" if error.errno in FULL else ""
            raise SweepStopped(f"{self.path}: {error.strerror}{advice}") from None
        self._finished += 1

    def safe(self) -> str:
        """Return what has been finished, and how to go on."""
        number = f"{self._finished} of {self._number} blocks"
        return f"{number} are safe in {self.path}; --resume (resume=True) continues there"

    def dataset(self) -> "xr.Dataset":
        """Return the sweep, its values read when they are used."""
        return read_store(self.path)[list(self._arrays)]


@contextmanager
def opened(folder: str | Path, problem: SweepProblem, resume: bool) -> Iterator[StoreRecord]:
    """Make a store, or check the one that is there, and hold it against other processes."""
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
    kind = f"folder that ends in {STORE_ENDING}"
    path = checked_path("store", folder, kind)
    named = path.suffix.lower() == STORE_ENDING
    there = os.path.isdir(os.path.dirname(os.path.realpath(path)))
    missing = "the folder that holds it must exist; make it first"
    refuse(
        not named and refusal("store", str(folder), f"must be the name of a {kind}"),
        not there and refusal("store", str(path), missing),
    )
    return path


@contextmanager
def _locked(path: Path) -> Iterator[None]:
    lock = filelock.FileLock(path / LOCK, blocking=False)
    try:
        lock.acquire()
    except OSError as error:  # Timeout is one
        busy = isinstance(error, filelock.Timeout) and "another process is writing it; wait for it"
        allowed = busy or f"cannot be written; {error.strerror}"
        words = f"store: {str(path)!r} {allowed}"
        raise unwritten(error, words) or refusal("store", str(path), allowed) from None
    try:
        yield
    finally:
        lock.release()


def _create(path: Path, problem: SweepProblem) -> None:
    """Make a store without points, whole or not at all."""
    target = os.path.realpath(path)
    new = Path(os.path.dirname(target), f".carom-{uuid.uuid4().hex}")
    try:
        for name, content in _blank_files(problem).items():
            (new / name).parent.mkdir(parents=True, exist_ok=True)
            (new / name).write_bytes(content.to_bytes())
        freeze(new)
        os.rename(new, target)
    except OSError as error:
        reason = f"cannot be made; {error.strerror}"
        if error.errno in (errno.EEXIST, errno.ENOTEMPTY):
            reason = "another process has just made it"
        words = f"store: {str(path)!r} {reason}"
        raise unwritten(error, words) or refusal("store", str(path), reason) from None
    finally:
        shutil.rmtree(new, ignore_errors=True)


def _blank_files(problem: SweepProblem) -> dict[str, Buffer]:
    """Return the files of an empty store; zarr's threads would write on as a signal removes it."""
    files: dict[str, Buffer] = {}
    store = MemoryStore(files)
    with warnings.catch_warnings():  # of what the format 3 does not yet have on paper
        warnings.simplefilter("ignore")
        blank_dataset(problem).to_zarr(store, zarr_format=3, consolidated=False)
        group = zarr.open_group(store, mode="r+")
        for name, info in problem.variables().items():
            group.create_array(
                name,
                dtype=info.dtype,
                shape=problem.design.shape,
                chunks=problem.chunks(),
                compressors=COMPRESSOR,
                dimension_names=problem.design.dims,
                fill_value=BLANK[info.dtype],
                attributes=json.loads(json.dumps(info.attributes, default=np.ndarray.tolist)),
            )
        zarr.consolidate_metadata(store)
    return files


def _check(path: Path, problem: SweepProblem) -> None:
    """Raise InputError unless this is a store of this sweep."""
    dataset = read_store(path)
    version = str(dataset.attrs["source"]).removeprefix("carom ")
    words = f"carom {version} has written it, and this is carom {__version__}"
    if version == __version__:
        other = _differences(json.loads(dataset.attrs["inputs"]), identity(problem), "")
        listed = "; ".join(islice(other, MOST_DIFFERENCES))
        words = listed and f"it holds another sweep: {listed}"
    refuse(words and refusal("store", str(path), words))


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
