"""The shared library of compiled kernels: found beside the package, checked, opened.

A library is used if it is whole, was made from these sources, and is for a processor that this one
can stand for. Otherwise numba does the same, more slowly at first, or plain Python, a thousand
times slower, and `reason` says why.
"""

import ctypes
import json
import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import cache
from hashlib import sha256
from operator import itemgetter
from pathlib import Path
from time import time
from typing import Any, NamedTuple

from carom.dimensionless.numerics.signatures import Signature, caller
from carom.folder import PACKAGE
from carom.quantities.refusals import refusal

FOLDER = PACKAGE / "lib"
CONTENTS = "kernels.json"  # beside the libraries: what they are, from what; or why there are none
LEVELS = "CAROM_LEVELS"  # of x86-64, in the environment: to be built; the highest to be used
LOADED = time()  # sources that are newer are not those that this process runs
BROWSER, BROWSER_CONTENTS = "carom.wasm", "browser.json"  # kernels for the explorer page


class Opened(NamedTuple):
    """An open library, what compiled it, and the signatures of its functions as texts."""

    path: Path
    handle: ctypes.CDLL
    compiled_by: str
    signatures: dict[str, str]


class Unusable(RuntimeError):
    """There is no library that can be used; the message says why."""


def get_include() -> str:
    """Return the folder of carom.h, the header of the functions for C, for a compiler's -I.

    Examples
    --------
    >>> from pathlib import Path
    >>> Path(carom.get_include(), "carom.h").is_file()
    True
    """
    return str(PACKAGE / "include")


def get_library() -> str:
    """Return the path of the shared library of the functions in carom.h, for this processor.

    Raises
    ------
    RuntimeError
        If there is no library that can be used; the message says why and what to do.

    Examples
    --------
    >>> import carom, ctypes
    >>> def level():
    ...     return ctypes.CDLL(carom.get_library()).carom_processor_level()
    """
    return str(opened().path)


def function(
    signatures: Mapping[str, Signature], floats: Sequence[str]
) -> Callable[..., Any] | None:
    """Return what calls a kernel in the library from Python; None if it is not there.

    There is a signature for each of the types of floating-point arrays.
    """
    try:
        library = opened()
    except Unusable:
        return None
    calls = []
    for name, signature in signatures.items():
        if library.signatures.get(name) != str(signature):
            return None
        calls.append(caller(getattr(library.handle, name), signature))
    return calls[0] if len(calls) == 1 else _by_type(dict(zip(floats, calls, strict=True)))


def _by_type(calls: dict[str, Callable[..., Any]]) -> Callable[..., Any]:
    """Return a function that looks at the first array."""

    def call(first: Any, *more: Any) -> Any:
        array = first[0] if isinstance(first, tuple) else first
        return calls[array.dtype.name](first, *more)

    return call


def reason() -> str:
    """Return why there is no library, in a few words; empty if there is one."""
    try:
        opened()
    except Unusable as error:
        return str(error)
    return ""


@cache
def opened() -> Opened:
    """Return the best of the libraries, opened, or raise Unusable."""
    highest = _highest_level()
    try:
        contents = json.loads((FOLDER / CONTENTS).read_text(encoding="utf-8"))
        if "failure" in contents:
            raise Unusable(f"the compiled library could not be built: {contents['failure']}")
        if digest(PACKAGE / name for name in contents["files"]) != contents["sources"]:
            raise Unusable("the compiled library was built from other sources; install carom again")
        return _best(contents, highest)
    except FileNotFoundError:
        allowed = "install carom again, with a C compiler"
        raise Unusable(f"there is no compiled library; {allowed}") from None
    except (OSError, ValueError, KeyError, TypeError):
        raise Unusable("the compiled library is damaged; install carom again") from None


def _best(contents: Any, highest: int) -> Opened:
    """Return the library of the highest level that is admitted and that this processor can run."""
    admitted = [each for each in contents["libraries"] if each["level"] <= highest]
    for each in sorted(admitted, key=itemgetter("level"), reverse=True):
        path = FOLDER / each["file"]
        if sha256(path.read_bytes()).hexdigest() != each["sha256"]:
            raise ValueError
        try:
            handle = ctypes.CDLL(str(path))
        except OSError as error:
            raise Unusable(f"the compiled library cannot be opened: {error}") from None
        if handle.carom_processor_level() >= each["level"]:
            return Opened(path, handle, contents["compiled_by"], contents["signatures"])
    raise Unusable("there is no compiled library for this processor")


def _highest_level() -> int:
    """Return the highest level that the environment admits, or raise InputError."""
    text = os.environ.get(LEVELS, "")
    levels = text.split() or ["4"]
    if not set(levels) <= set("01234"):
        raise refusal(LEVELS, text, "must be levels of x86-64 from 1 to 4, separated by blanks")
    return int(max(levels))


def digest(files: Iterable[Path]) -> str:
    """Return a checksum of files: their names and what they hold."""
    checksum = sha256()
    for path in files:
        checksum.update(path.name.encode() + b"\0" + path.read_bytes())
    return checksum.hexdigest()
