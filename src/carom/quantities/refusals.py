"""Clear refusals: one line with the argument, its value, what is allowed, what to do.

Of a file, a command line or the inputs of a call all faults are said in one message.
"""

from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from difflib import get_close_matches
from functools import wraps
from inspect import Parameter, signature
from reprlib import Repr
from typing import Any, Concatenate, ParamSpec, Self, TypeVar, cast

from carom.quantities.glossary import meant, remark

Kind = TypeVar("Kind")
Parameters = ParamSpec("Parameters")
Result = TypeVar("Result")

LONGEST_SHOWN = 120  # characters of a value that a refusal shows
MOST_LISTED = 12  # faults in one message

_short = Repr()
_short.maxstring = _short.maxother = _short.maxlong = LONGEST_SHOWN


class InputError(ValueError):
    """An input cannot be used; the message names it, its value, and what is allowed.

    Of several faults it lists each once, as `faults` does.
    """

    __module__ = "carom"  # the name by which users know it

    def __init__(self, *faults: str) -> None:
        self.faults = tuple(dict.fromkeys(faults))
        message = self.faults[0] if len(self.faults) == 1 else _listed(self.faults)
        super().__init__(" ".join(message.splitlines()))  # one line, whatever users have named


def _listed(faults: Sequence[str]) -> str:
    listed = "; ".join(f"({i}) {text}" for i, text in enumerate(faults[:MOST_LISTED], 1))
    more = f"; and {len(faults) - MOST_LISTED} more" if len(faults) > MOST_LISTED else ""
    return f"{len(faults)} faults: {listed}{more}"


def refusal(name: str, value: Any, allowed: str) -> InputError:
    """Return the error that refuses a value."""
    return InputError(f"{heading(name)}: {_shown(value)} cannot be used; {allowed}")


def refuse(*faults: object) -> None:
    """Raise InputError with all texts and errors among these; what is false is no fault."""
    if messages := list(map(str, filter(None, faults))):
        raise InputError(*messages)


def heading(text: str) -> str:
    """Return a name that users gave as the head of a refusal, which ends with its only colon."""
    return clipped(text.replace(":", " "))


def clipped(text: str) -> str:
    """Return a text of users for a refusal: in one line, its end left out if it is long."""
    line = " ".join(text.split())
    return line if len(line) <= LONGEST_SHOWN else f"{line[:LONGEST_SHOWN]}..."


def nearest(word: str, words: Iterable[str]) -> str:
    """Return a hint at those of these words that are nearest to one."""
    near = get_close_matches(word, list(words), n=3, cutoff=0.5)
    return f"did you mean {' or '.join(repr(name) for name in near)}?" if near else ""


def hint(word: object, names: Iterable[str]) -> str:
    """Return a hint at the name that a word stands for, at the nearest, or at all of them."""
    names = tuple(names)
    if name := meant(str(word), names):
        return f"write {remark(str(word), name)}"
    return nearest(str(word), names) or f"known names are {', '.join(names)}"


def one_of(name: str, value: Any, choices: Iterable[str]) -> str:
    """Return a text that is one of these, or raise InputError with the nearest of them."""
    words = tuple(choices)
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
    truth = isinstance(value, bool) or type(value).__name__ in ("bool", "bool_")  # NumPy's, too
    refuse(not truth and refusal(name, value, "must be True or False"))
    return bool(value)


def _shown(value: Any) -> str:
    try:
        shape = getattr(value, "shape", ())
        if shape and isinstance(shape, tuple):
            return f"an array of shape {shape}"
        return clipped(_short.repr(value) if isinstance(value, Iterable | int) else repr(value))
    except Exception:  # of an integer with too many digits, of a class of users
        return f"this {type(value).__name__}"


class Faults:
    """What is wrong with inputs: collected inside its context, and told in one message after it."""

    def __init__(self, *messages: str) -> None:
        self._messages = list(messages)
        self._collecting = False

    def __enter__(self) -> Self:
        self._collecting = True
        return self

    def __exit__(self, kind: object, error: BaseException | None, trace: object) -> None:
        self._collecting = False
        if isinstance(error, InputError):
            self._messages += error.faults
        if self._messages and (error is None or isinstance(error, Exception)):
            raise InputError(*self._messages) from None

    def add(self, *messages: str) -> None:
        """Collect faults; outside of the context raise InputError."""
        if not self._collecting:
            refuse(*messages)
        self._messages += messages

    @contextmanager
    def catching(self, name: str = "") -> Iterator[None]:
        """Add an InputError that is raised inside, as of one column or one file, and go on."""
        try:
            yield
        except InputError as error:
            self.add(*(f"{heading(name)}: {fault}" if name else fault for fault in error.faults))

    def trying(
        self,
        function: Callable[Parameters, Result],
        *given: Parameters.args,
        **named: Parameters.kwargs,
    ) -> Result:
        """Return what a function returns; what it refuses is collected, and told before use."""
        with self.catching():
            return function(*given, **named)
        return cast(Result, None)

    def if_given(
        self,
        reader: Callable[Concatenate[str, Any, Parameters], Result],
        name: str,
        value: Any,
        *more: Parameters.args,
        **named: Parameters.kwargs,
    ) -> Result | None:
        """Return what a reader makes of a named value, or None without one, as in `trying`."""
        return None if value is None else self.trying(reader, name, value, *more, **named)

    def settle(self) -> None:
        """Raise InputError if there are faults so far, before costly work."""
        refuse(*self._messages)


def known_keywords(function: Callable[Parameters, Result]) -> Callable[Parameters, Result]:
    """Return a function that refuses keywords it does not know, and values without their name."""
    parameters = signature(function).parameters.values()
    keywords = [each.name for each in parameters if each.kind is not Parameter.POSITIONAL_ONLY]
    named = [each.name for each in parameters if each.kind is Parameter.KEYWORD_ONLY]
    most = sum(each.kind is Parameter.POSITIONAL_OR_KEYWORD for each in parameters)
    title = function.__qualname__.removesuffix(".__init__").removesuffix(".__call__")
    title = title.rpartition(".")[2]

    @wraps(function)
    def called(*args: Parameters.args, **kwargs: Parameters.kwargs) -> Result:
        for name in kwargs:
            if name not in keywords:
                words = hint(name, [word for word in keywords if word != "self"])
                raise InputError(f"{name}: no keyword of {title}; {words}")

        if most < len(args) <= most + len(named):
            nameless = zip(named, args[most:], strict=False)
            cure = ", ".join(f"{name}={value!r}" for name, value in nameless)
            raise InputError(f"{title}: takes these by name; write {cure}")
        return function(*args, **kwargs)

    return called
