"""Reading the Zarr store of a sweep, in which a damaged chunk is reported and never read.

What is written once, when the store is made, has its SHA-256 in a list. Chunks end with a seal: the
SHA-256 of a text that tells the store, of their place in it and of their bytes, in a frame that
readers of zstd skip. So a chunk of another place, or of another store, is damage. Stores without a
list, or with chunks that have no seals but zstd's own checksum, are older, and are read as they
are.
"""

import warnings
from functools import cache
from hashlib import sha256
from math import prod
from pathlib import Path
from textwrap import shorten
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from carom.io.extras import extra
from carom.io.labels import is_ours
from carom.quantities.refusals import refusal

if TYPE_CHECKING:
    import xarray as xr

STATUS = "status"  # of the points of a sweep
FROZEN = f"{STATUS}/.sha256sums"  # a place that zarr does not list; `sha256sum -c` reads it
SEALED = f"{STATUS}/.sealed"  # what a store is called in the seals of its chunks
FRAME = b"\x50\x2a\x4d\x18\x20\x00\x00\x00"  # begins a frame of 32 bytes that zstd skips
LEVEL = 1  # of compression: floating-point numbers gain nothing from more
METADATA = "zarr.json"
MISSING = "missing"


def read_store(path: Path) -> "xr.Dataset":
    """Return the sweep in a store of Carom's, its values read when they are used.

    Raises InputError if it is not one, or is damaged; so does the dataset that is returned, when
    values are used that are damaged.
    """
    import xarray as xr

    if (path / METADATA).is_file():
        _check_frozen(path)
    store = _checked(path, Chunks({}, b""))

    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            dataset: xr.Dataset = xr.open_zarr(
                store, chunks=None, consolidated=True, decode_times=False
            )
    except Exception:  # zarr and xarray raise what they like at a damaged store
        raise refusal("store", str(path), "it is damaged, or not a Zarr store") from None
    told = dataset.attrs
    if not (is_ours(told.get("source")) and "inputs" in told and STATUS in dataset):
        raise refusal("store", str(path), "it was not stored by Carom")
    for variable in dataset.variables.values():  # what JSON has made a list
        if "flag_values" in variable.attrs:
            flags = np.asarray(variable.attrs["flag_values"], variable.dtype)
            variable.attrs["flag_values"] = flags
    store.chunks = chunks_of(dataset, path)
    return dataset


class Chunks(NamedTuple):
    """How large the chunks of a store are, by the names of its arrays, and what it is sealed by."""

    sizes: dict[str, int]
    store: bytes  # empty for an older one, without seals

    def decoded(self, key: str, content: bytes) -> bytes | None:
        """Return the values of a chunk, or None if it is damaged or not of this place."""
        end = len(content) - len(seal(self.store, "", b""))
        if content[end:] != seal(self.store, key, content[:end]):
            return None
        try:
            values = bytes(extra("numcodecs.zstd", "a store").Zstd(LEVEL).decode(content))
        except (RuntimeError, ValueError):
            return None
        return values if len(values) == self.sizes[key.partition("/c/")[0]] else None


def chunks_of(dataset: "xr.Dataset", path: Path) -> Chunks:
    """Return how the chunks of the dataset of a store are."""
    sizes = {str(name): _chunk_size(item) for name, item in dataset.data_vars.items()}
    try:
        return Chunks(sizes, (path / SEALED).read_bytes())
    except FileNotFoundError:
        return Chunks(sizes, b"")


def seal(store: bytes, key: str, content: bytes) -> bytes:
    """Return what ends a chunk, which zstd skips; nothing in a store without seals."""
    digest = sha256(store + key.encode() + b"\0" + content).digest()
    return FRAME + digest if store else b""


def _chunk_size(variable: "xr.DataArray") -> int:
    return int(prod(variable.encoding["chunks"]) * variable.dtype.itemsize)


def freeze(path: Path) -> None:
    """List the checksums of all files of a store that has just been made."""
    (path / SEALED).write_text(_digest(path / METADATA), encoding="utf-8")
    names = sorted(str(file.relative_to(path)) for file in path.rglob("*") if file.is_file())
    lines = (f"{_digest(path / name)}  {name}\n" for name in names)
    (path / FROZEN).write_text("".join(lines), encoding="utf-8", newline="\n")


def _digest(file: Path) -> str:
    try:
        return sha256(file.read_bytes()).hexdigest()
    except (OSError, ValueError):  # a damaged list may name what can be no file
        return MISSING


def _check_frozen(path: Path) -> None:
    """Raise InputError if what was written once is not as it was written."""
    try:
        text = (path / FROZEN).read_text(encoding="utf-8", errors="replace")
    except FileNotFoundError:
        return
    except OSError as error:
        raise refusal("store", str(path), f"cannot be read; {error.strerror}") from None
    known = {name: digest for digest, _, name in (x.partition("  ") for x in text.splitlines())}
    if METADATA not in known:
        raise refusal("store", str(path), f"it is damaged: {FROZEN} has changed; start again")
    for name, digest in known.items():
        found = _digest(path / name)
        if found != digest:
            what = "is missing" if found == MISSING else "has changed"
            allowed = f"it is damaged: {shorten(name, 60)} {what}; start again"
            raise refusal("store", str(path), allowed)


def _checked(path: Path, chunks: Chunks) -> Any:
    """Return a store of zarr that reads no chunk that is missing or damaged."""
    store = _checked_store()(path, read_only=True)
    store.chunks = chunks
    return store


@cache
def _checked_store() -> Any:
    local: Any = extra("zarr.storage", "a store").LocalStore

    class CheckedStore(local):  # type: ignore[misc]
        """Files of a store, for reading; `chunks` says how its chunks are."""

        async def get(self, key: str, *args: Any, **options: Any) -> Any:
            return self._sound(key, await super().get(key, *args, **options))

        def get_sync(self, key: str, *args: Any, **options: Any) -> Any:
            return self._sound(key, super().get_sync(key, *args, **options))

        def _sound(self, key: str, found: Any) -> Any:
            name, _, corner = key.partition("/c/")
            if name not in self.chunks.sizes or not corner:
                return found
            if found is None:  # of a block that is not finished, unless its status is there
                damaged = name != STATUS and (self.root / STATUS / "c" / corner).is_file()
            else:
                damaged = self.chunks.decoded(key, found.to_bytes()) is None
            if damaged:
                allowed = f"{key} is damaged; --resume (resume=True) computes it again"
                raise refusal("store", str(self.root), allowed)
            return found

        def __reduce__(self) -> tuple[Any, ...]:
            return _checked, (self.root, self.chunks)

    return CheckedStore
