"""Keywords that a function does not know, refused with the name that is meant."""

from collections.abc import Callable
from functools import wraps
from inspect import Parameter, signature
from typing import ParamSpec, TypeVar

from carom.old_names import renamed
from carom.quantities.refusals import InputError, hint

Parameters = ParamSpec("Parameters")
Result = TypeVar("Result")


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
        for name in list(kwargs):
            new = renamed(name, title, keywords)
            if new not in keywords:
                words = hint(name, [word for word in keywords if word != "self"])
                raise InputError(f"{name}: no keyword of {title}; {words}")
            if new != name and new in kwargs:
                raise InputError(
                    f"{name}: the old name of {new}, which is given as well; leave it out"
                )
            kwargs[new] = kwargs.pop(name)
        if most < len(args) <= most + len(named):
            nameless = zip(named, args[most:], strict=False)
            cure = ", ".join(f"{name}={value!r}" for name, value in nameless)
            raise InputError(f"{title}: takes these by name; write {cure}")
        return function(*args, **kwargs)

    return called
