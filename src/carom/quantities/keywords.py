"""Keywords that a function does not know, refused with the name that is meant."""

from collections.abc import Callable
from functools import wraps
from inspect import Parameter, signature
from typing import ParamSpec, TypeVar

from carom.quantities.refusals import InputError, hint

Given = ParamSpec("Given")
Found = TypeVar("Found")


def known_keywords(function: Callable[Given, Found]) -> Callable[Given, Found]:
    """Return a function that refuses keywords it does not know with the name that is meant.

    Examples
    --------
    >>> from carom.quantities.keywords import known_keywords
    >>> @known_keywords
    ... def slide(*, friction):
    ...     return friction
    >>> slide(mu=0.2)
    Traceback (most recent call last):
    carom.InputError: mu: no keyword of slide; write friction
    """
    parameters = signature(function).parameters.values()
    known = [each.name for each in parameters if each.kind is not Parameter.POSITIONAL_ONLY]
    title = function.__qualname__.removesuffix(".__init__").rpartition(".")[2]

    @wraps(function)
    def called(*args: Given.args, **kwargs: Given.kwargs) -> Found:
        for name in kwargs:
            if name not in known:
                words = hint(name, [word for word in known if word != "self"])
                raise InputError(f"{name}: no keyword of {title}; {words}")
        return function(*args, **kwargs)

    return called
