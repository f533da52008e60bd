"""Clear refusals: one line with the argument, its value, what is allowed, what to do."""

from collections.abc import Iterable
from difflib import get_close_matches
from reprlib import Repr
from typing import Any, TypeVar

from carom.quantities.symbols import meant, remark

Kind = TypeVar("Kind")

LONGEST = 120  # characters of a value that a refusal shows

_short = Repr()
_short.maxstring = _short.maxother = _short.maxlong = LONGEST


class InputError(ValueError):
    """An input cannot be used; the message names it, its value, and what is allowed."""

    __module__ = "carom"  # the name by which users know it

    def __init__(self, message: str) -> None:
        super().__init__(" ".join(message.splitlines()))  # one line, whatever users have named


def refusal(name: str, value: Any, allowed: str) -> InputError:
    """Return the error that refuses a value."""
    return InputError(f"{clipped(name)}: {_shown(value)} cannot be used; {allowed}")


def clipped(text: str) -> str:
    """Return a text of users for a refusal: in one line, its end left out if it is long."""
    line = " ".join(text.split())
    return line if len(line) <= LONGEST else f"{line[:LONGEST]}..."


def nearest(word: str, known: Iterable[str]) -> str:
    """Return a hint at the known words that are nearest to one."""
    found = get_close_matches(word, list(known), n=3, cutoff=0.5)
    return f"did you mean {' or '.join(repr(name) for name in found)}?" if found else ""


def hint(word: object, known: Iterable[str]) -> str:
    """Return a hint at the known word that one stands for, at the nearest, or at all of them."""
    known = tuple(known)
    if name := meant(str(word), known):
        return f"write {remark(str(word), name)}"
    return nearest(str(word), known) or f"known names are {', '.join(known)}"


def one_of(name: str, value: Any, known: Iterable[str]) -> str:
    """Return a text that is one of those known, or raise InputError with the nearest of them."""
    words = tuple(known)
    if isinstance(value, str) and value in words:
        return value
    near = nearest(value, words) if isinstance(value, str) else ""
    choice = " or ".join(filter(None, (", ".join(words[:-1]), words[-1])))
    which = "one of " if len(words) > 2 else ""
    raise refusal(name, value, f"must be {which}{choice}{near and f'; {near}'}")


def checked_type(
    name: str, value: Any, kind: type[Kind] | tuple[type[Kind], ...], allowed: str
) -> Kind:
    """Return a value that is of a kind, or raise InputError."""
    if isinstance(value, kind):
        return value
    raise refusal(name, value, allowed)


def flag(name: str, value: Any) -> bool:
    """Return True or False as it is given, or raise InputError."""
    if isinstance(value, bool) or type(value).__name__ in ("bool", "bool_"):  # NumPy's, too
        return bool(value)
    raise refusal(name, value, "must be True or False")


def _shown(value: Any) -> str:
    try:
        shape = getattr(value, "shape", ())
        if shape and isinstance(shape, tuple):
            return f"an array of shape {shape}"
        return clipped(_short.repr(value) if isinstance(value, Iterable | int) else repr(value))
    except Exception:  # of an integer with too many digits, of a class of users
        return f"this {type(value).__name__}"
