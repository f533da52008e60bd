"""Kernels compiled by numba on first use, and the message to users who wait for them."""

import sys
from collections.abc import Callable
from multiprocessing import parent_process
from time import monotonic
from typing import Any

import numba
from numba.core import event

from carom.dimensionless.numerics import shared_library

PATIENCE = 2.0  # seconds before it is said
OPTIONS: dict[str, Any] = {"nogil": True, "error_model": "numpy"}


def dispatcher(function: Callable[..., Any]) -> Any:
    """Return a function that is compiled on first use, free of the GIL, cached on disk."""
    try:
        return numba.njit(cache=True, **OPTIONS)(function)
    except RuntimeError:  # no folder that can be written to
        waiting.kept = False
        return numba.njit(**OPTIONS)(function)


class Waiting(event.Listener):  # type: ignore[misc]
    """Says once why one has to wait, when kernels of this package take long to compile."""

    def __init__(self) -> None:
        self.begun: list[float] = []
        self.spent = 0.0
        self.said = parent_process() is not None  # by the process that started this one
        self.kept = True

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
        often = "once" if self.kept else "at every start"
        why = [shared_library.reason()] if shared_library.reason() else []
        if not self.kept:
            why.append("no folder can be written to; set NUMBA_CACHE_DIR to one that can")
        cost = f"This happens {often} and takes up to a minute"
        reasons = f" ({'; '.join(why)})" if why else ""
        return f"Carom is compiling its solver. {cost}{reasons}."


waiting = Waiting()
event.register("numba:compile", waiting)
