"""What a message tells people to do about a table that is not clear, as they can where they are."""

from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from typing import NamedTuple


class Remedies(NamedTuple):
    """How people say what a column holds, which sheet is read, and which sign is decimal."""

    column: str  # to be formatted with its head and the name of a quantity
    sheet: str
    decimal: str


PYTHON = Remedies(
    "give columns={{{head!r}: {name!r}}}",
    "say which, by {path}:{sheet} or sheet={sheet!r}",
    "give decimal={sign!r}",
)
SHELL = Remedies(
    'add --column "{head}={name}"',
    "say which, by {path}:{sheet} or --sheet",
    "add --decimal {sign}",
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
