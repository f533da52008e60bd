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

_remedies: ContextVar[Remedies] = ContextVar("remedies", default=PYTHON)


@contextmanager
def offering(remedies: Remedies) -> Iterator[None]:
    """Let messages inside of this context name these remedies instead of Python's arguments.

    Examples
    --------
    >>> from carom.io.remedies import SHELL, offered, offering
    >>> offered().decimal.format(sign=",")
    "give decimal=','"
    >>> with offering(SHELL):
    ...     offered().decimal.format(sign=",")
    'add --decimal ,'
    """
    token = _remedies.set(remedies)
    try:
        yield
    finally:
        _remedies.reset(token)


def offered() -> Remedies:
    """Return the remedies that messages name."""
    return _remedies.get()
