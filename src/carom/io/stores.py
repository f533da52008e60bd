"""The Zarr store of a sweep: what is read was written in this place of this store, or is refused.

What is written once, when the store is made, has its SHA-256 in a list. Chunks end with a seal: the
SHA-256 of a text that tells the store, of their place in it and of their bytes, in a frame that
readers of zstd skip. So a chunk of another place, or of another store, is damage.

This needs zarr: import it by `extra`.
"""

import json
import warnings
from hashlib import sha256
from pathlib import Path
from textwrap import shorten
from typing import Any

import numpy as np
import xarray as xr
from zarr.core.buffer import Buffer
from zarr.storage import LocalStore

from carom.quantities.refusals import refusal, refuse

STATUS = "status"  # of the points of a sweep
FROZEN = f"{STATUS}/.sha256sums"  # a place that zarr does not list; `sha256sum -c` reads it
METADATA = "zarr.json"
FRAME = b"\x50\x2a\x4d\x18\x20\x00\x00\x00"  # begins a frame of 32 bytes that zstd skips
SEAL_LENGTH = len(FRAME) + 32
CHUNK = "/c/"  # in the names of chunks
FORMAT = 3  # of Zarr
CODECS = {"bytes", "zstd"}  # of what Carom writes; among others are some that run what they read


def read_store(path: Path) -> xr.Dataset:
    """Return the sweep in a store of Carom's, its values read when they are used.

    Raises InputError if it is not one, or is damaged; so does the dataset that is returned, when
    values are used that are damaged.
    """
    with warnings.catch_warnings():  # of what the format 3 does not yet have on paper
        warnings.simplefilter("ignore")
        dataset: xr.Dataset = xr.open_zarr(
            SealedStore(path), chunks=None, consolidated=True, decode_times=False
        )
    for variable in dataset.variables.values():  # what JSON has made a list
        if "flag_values" in variable.attrs:
            flags = np.asarray(variable.attrs["flag_values"], variable.dtype)
            variable.attrs["flag_values"] = flags
    return dataset


class SealedStore(LocalStore):
    """Files of a store that zarr reads, and writes, with seals at the end of chunks."""

    def __init__(self, root: Path, *, read_only: bool = True) -> None:
        super().__init__(root, read_only=read_only)
        self._frozen = _checked_list(root)
        _check_codecs(root)
        arrays = {name.partition("/")[0] for name in self._frozen if name.endswith(f"/{METADATA}")}
        written_once = {name.partition(CHUNK)[0] for name in self._frozen if CHUNK in name}
        self._computed = arrays - written_once - {STATUS}

    def is_sound(self, key: str) -> bool:
        """Tell whether a chunk is there, and as it was written."""
        try:
            return self._has_seal(key, (self.root / key).read_bytes())
        except OSError:
            return False

    async def get(self, key: str, *args: Any, **options: Any) -> Buffer | None:
        return self._checked(key, await super().get(key, *args, **options))

    def get_sync(self, key: str, *args: Any, **options: Any) -> Buffer | None:
        return self._checked(key, super().get_sync(key, *args, **options))

    async def set(self, key: str, value: Buffer) -> None:
        await super().set(key, self._sealed(key, value))

    def set_sync(self, key: str, value: Buffer) -> None:
        super().set_sync(key, self._sealed(key, value))

    def _checked(self, key: str, content: Buffer | None) -> Buffer | None:
        """Return what was read, or raise InputError if it is a chunk that is not as it was."""
        name, _, corner = key.partition(CHUNK)
        if not corner or key in self._frozen:
            return content
        if content is None:  # of a block that is not finished: its status is written last
            others = self._computed if name == STATUS else {STATUS}
            sound = not all((self.root / each / "c" / corner).is_file() for each in others)
        else:
            sound = self._has_seal(key, content.to_bytes())
        if not sound:
            allowed = f"{key} is damaged; --resume (resume=True) computes it again"
            raise refusal("store", str(self.root), allowed)
        return content

    def _sealed(self, key: str, content: Buffer) -> Buffer:
        plain = content.to_bytes()
        return type(content).from_bytes(plain + self._seal(key, plain))

    def _has_seal(self, key: str, content: bytes) -> bool:
        return content[-SEAL_LENGTH:] == self._seal(key, content[:-SEAL_LENGTH])

    def _seal(self, key: str, content: bytes) -> bytes:
        place = f"{self._frozen[METADATA]}{key}\0".encode()
        return FRAME + sha256(place + content).digest()


def freeze(path: Path) -> None:
    """List the checksums of all files of a store that has just been made."""
    names = sorted(str(file.relative_to(path)) for file in path.rglob("*") if file.is_file())
    lines = (f"{_digest(path / name)}  {name}\n" for name in names)
    (path / FROZEN).write_text("".join(lines), encoding="utf-8", newline="\n")


def _digest(file: Path) -> str:
    try:
        return sha256(file.read_bytes()).hexdigest()
    except (OSError, ValueError):  # a damaged list may name what can be no file
        return "missing"


def _checked_list(path: Path) -> dict[str, str]:
    """Return the checksums of a store; raise InputError if what was written once has changed."""
    try:
        text = (path / FROZEN).read_text(encoding="utf-8", errors="replace")
    except OSError as error:
        allowed = f"it is not a store of Carom, or damaged; {FROZEN}: {error.strerror}"
        raise refusal("store", str(path), allowed) from None
    lines = (line.partition("  ") for line in text.splitlines())
    frozen = {name: digest for digest, _, name in lines}
    for name in (METADATA, *frozen):
        if _digest(path / name) != frozen.get(name):
            changed = f"{shorten(name, 60)} is not what {FROZEN} says"
            raise refusal("store", str(path), f"it is damaged: {changed}; start again")
    return frozen


def _check_codecs(path: Path) -> None:
    """Raise InputError if zarr would have to read what Carom never writes."""
    try:
        whole = json.loads((path / METADATA).read_bytes())
        nodes = [whole, *whole["consolidated_metadata"]["metadata"].values()]
        formats = {node["zarr_format"] for node in nodes}
        codecs = {codec["name"] for node in nodes for codec in node.get("codecs", [])}
        own = formats == {FORMAT} and codecs <= CODECS
    except (ValueError, LookupError, TypeError, AttributeError):
        own = False
    refuse(not own and refusal("store", str(path), "it is not a store of Carom"))
