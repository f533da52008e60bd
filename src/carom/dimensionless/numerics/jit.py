"""Kernels compiled by numba on first use, and the message to users who wait for them."""

import sys
from collections.abc import Callable
from pathlib import Path
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
        return numba.njit(**OPTIONS)(function)


def message() -> str:
    """Return the message for users who wait, with the reason."""
    why = f" ({shared_library.reason()})" if shared_library.reason() else ""
    return f"Carom is compiling its solver. This happens once and takes up to a minute{why}."


class Teller(event.Listener):  # type: ignore[misc]
    """Says so once, on a terminal or in a notebook, when kernels of this package take long."""

    def __init__(self) -> None:
        self.begun: list[float] = []
        self.spent = 0.0
        self.said = False

    def on_start(self, happened: Any) -> None:
        """Speak up when compiling has taken longer than one would wait."""
        self.begun.append(monotonic())
        own = happened.data["dispatcher"].py_func.__module__.startswith("carom.")
        waited = self.spent + self.begun[-1] - self.begun[0]
        if own and not self.said and waited > PATIENCE and is_watched():
            print(message(), file=sys.stderr, flush=True)
            self.said = True

    def on_end(self, happened: Any) -> None:
        """Add the time of a kernel with all that it called."""
        begun = self.begun.pop()
        if not self.begun:
            self.spent += monotonic() - begun


def is_watched() -> bool:
    """Return whether somebody waits: in a notebook, on a terminal, or for a command."""
    told = "ipykernel" in sys.modules or Path(sys.argv[0]).stem == "carom"
    return told or bool(sys.stderr and sys.stderr.isatty())


event.register("numba:compile", Teller())
