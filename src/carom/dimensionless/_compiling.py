"""A word to who waits while kernels are compiled, which happens once after installation."""

import sys
from time import monotonic
from typing import Any

from numba.core import event

MESSAGE = "carom: compiling what this needs, once; it takes about a minute ..."
PATIENCE = 2.0  # seconds before it is said


class Teller(event.Listener):
    """Says so once, on a terminal or in a notebook, when kernels of this package take long."""

    def __init__(self) -> None:
        self.since: float | None = None
        self.said = False

    def on_start(self, happened: Any) -> None:
        """Note the first kernel, and speak up at one that is later than one would wait."""
        if self.said or not happened.data["dispatcher"].py_func.__module__.startswith("carom."):
            return
        now = monotonic()
        self.since = now if self.since is None else self.since
        if now - self.since > PATIENCE and is_watched():
            print(MESSAGE, file=sys.stderr, flush=True)
            self.said = True

    def on_end(self, happened: Any) -> None:
        """Do nothing."""


def is_watched() -> bool:
    """Return whether somebody sees what is written to stderr."""
    return "ipykernel" in sys.modules or bool(sys.stderr and sys.stderr.isatty())


event.register("numba:compile", Teller())
