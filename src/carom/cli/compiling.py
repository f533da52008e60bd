"""A word to the user while kernels are compiled, which happens once after installation."""

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import typer

MESSAGE = "compiling what this command needs, once; this takes up to a minute or two ..."


@contextmanager
def announced() -> Iterator[None]:
    """Say so on stderr if what follows has to compile a kernel."""
    from numba.core import event

    class Announcer(event.Listener):
        said = False

        def on_start(self, _: Any) -> None:
            if not self.said:
                typer.echo(MESSAGE, err=True)
            self.said = True

        def on_end(self, _: Any) -> None:
            pass

    with event.install_listener("numba:compile", Announcer()):
        yield
