"""A word to the user while kernels are compiled, which happens once after installation."""

import threading
from collections.abc import Iterator
from contextlib import contextmanager

import typer

PATIENCE = 3.0  # seconds; what is compiled already takes one or two


@contextmanager
def announced() -> Iterator[None]:
    """Say that kernels are being compiled if what follows takes longer than it should."""
    message = "compiling, once after installation; this takes up to a minute ..."
    timer = threading.Timer(PATIENCE, lambda: typer.echo(message, err=True))
    timer.daemon = True
    timer.start()
    try:
        yield
    finally:
        timer.cancel()
