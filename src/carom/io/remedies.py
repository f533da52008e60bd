"""What a message tells people to do about a table that is not clear, as they can where they are."""

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from contextvars import ContextVar
from typing import NamedTuple


class Remedies(NamedTuple):
    """How people say what columns hold, which sheet, which decimal sign, and what a fit knows."""

    columns: Callable[[Mapping[str, str]], str]  # of names of quantities by heads
    sheet: str
    decimal: str
    fix: str  # with the name of a parameter and an example
    vary: str


PYTHON = Remedies(
    "give columns={!r}".format,
    "say which, by {path}:{sheet} or sheet={sheet!r}",
    "give decimal={sign!r}",
    "fixed={{{name!r}: {value!r}}}",
    "vary={name!r}",
)
SHELL = Remedies(
    lambda names: " ".join(["add", *(f'--column "{head}={names[head]}"' for head in names)]),
    "say which, by {path}:{sheet} or --sheet",
    'add --decimal "{sign}"',
    "--fix {name}={value}",
    "--vary {name}",
)

REMEDIES: ContextVar[Remedies] = ContextVar("remedies", default=PYTHON)


@contextmanager
def offering(remedies: Remedies) -> Iterator[None]:
    """Let messages inside of this context name these remedies instead of Python's arguments."""
    token = REMEDIES.set(remedies)
    try:
        yield
    finally:
        REMEDIES.reset(token)
