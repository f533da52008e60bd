"""Kernels compiled by numba on first use, and the message to users who wait for them."""

import shutil
import sys
import tempfile
from collections.abc import Callable
from functools import cache
from multiprocessing import parent_process
from pathlib import Path
from threading import Lock
from time import monotonic
from typing import Any

import numba
from numba.core import event

from carom.dimensionless.numerics import shared_library
from carom.dimensionless.numerics.shared_library import LOADED, digest
from carom.folder import PACKAGE

PATIENCE = 2.0  # seconds before it is said
OPTIONS: dict[str, Any] = {"nogil": True, "error_model": "numpy"}
IN_PACKAGE = PACKAGE / "__pycache__"
KEPT = "kernels-"  # begins the name of a folder, which a digest of the sources ends
ABOVE = {"cli", "lab", "page", "verify"}  # folders of which no kernel knows
LOCKED = "no folder can be written to; set NUMBA_CACHE_DIR to one that can"
EDITED = "its sources were edited while this process ran"

_choosing = Lock()


def dispatcher(function: Callable[..., Any]) -> Any:
    """Return a function that is compiled on first use, free of the GIL, cached on disk."""
    folder, waiting.unkept = kept_in()
    if folder is None:
        return numba.njit(**OPTIONS)(function)
    with _choosing:
        usual = numba.config.CACHE_DIR
        numba.config.CACHE_DIR = str(folder)
        try:
            return numba.njit(cache=True, **OPTIONS)(function)
        finally:
            numba.config.CACHE_DIR = usual


@cache
def kept_in() -> tuple[Path | None, str]:
    """Return the folder of what is compiled from these very sources; None, and why, without one.

    numba compares a kernel with its own file only: it does not see an edit of what the kernel calls
    or of a constant in another module. So each state of the sources has a folder of its own.
    """
    files = PACKAGE.rglob("*.py")
    sources = sorted(path for path in files if path.relative_to(PACKAGE).parts[0] not in ABOVE)
    if max(path.stat().st_mtime for path in sources) > LOADED:  # what was loaded may be older
        return None, EDITED
    name = f"{KEPT}{digest(sources)[:16]}"
    for parent in _parents():
        folder = parent / name
        try:
            if parent == IN_PACKAGE and not folder.exists():
                _remove_older()
            folder.mkdir(parents=True, exist_ok=True)
            tempfile.TemporaryFile(dir=folder).close()
        except OSError:  # it cannot be written to
            continue
        return folder, ""
    return None, LOCKED


def _parents() -> list[Path]:
    """Return where compiled kernels may be kept, the best first."""
    if told := numba.config.CACHE_DIR:
        return [Path(told)]
    try:
        return [IN_PACKAGE, Path.home() / ".cache/carom"]
    except RuntimeError:  # there is no home
        return [IN_PACKAGE]


def _remove_older() -> None:
    """Remove what was compiled from other states of these sources."""
    for folder in IN_PACKAGE.glob(f"{KEPT}*"):
        shutil.rmtree(folder, ignore_errors=True)


class Waiting(event.Listener):  # type: ignore[misc]
    """Says once why one has to wait, when kernels of this package take long to compile."""

    def __init__(self) -> None:
        self.begun: list[float] = []
        self.spent = 0.0
        self.said = parent_process() is not None  # by the process that started this one
        self.unkept = ""  # why what is compiled is not kept, if it is not

    def on_start(self, happened: Any) -> None:
        """Speak up when compiling has taken longer than one would wait."""
        self.begun.append(monotonic())
        own = happened.data["dispatcher"].py_func.__module__.startswith("carom.")
        waited = self.spent + self.begun[-1] - self.begun[0]
        if own and not self.said and waited > PATIENCE:
            print(self.message(), file=sys.stderr, flush=True)
            self.said = True

    def on_end(self, happened: Any) -> None:
        """Add the time of a kernel with all that it called."""
        begun = self.begun.pop()
        if not self.begun:
            self.spent += monotonic() - begun

    def message(self) -> str:
        """Return what happens, for how long, how often and why."""
        often = "at every start" if self.unkept else "once"
        why = [each for each in (shared_library.reason(), self.unkept) if each]
        cost = f"This happens {often} and takes up to a minute"
        reasons = f" ({'; '.join(why)})" if why else ""
        return f"Carom is compiling its solver. {cost}{reasons}."


waiting = Waiting()
event.register("numba:compile", waiting)
