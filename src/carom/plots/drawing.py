"""What every function that draws shares: results or datasets as input, refusals, size and style."""

from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager, nullcontext
from functools import wraps
from inspect import cleandoc, signature
from typing import Any, ParamSpec, TypeAlias, TypeVar

import numpy as np

from carom.plots import style
from carom.plots.legends import make_room_around
from carom.plots.look import Look, into, quiet
from carom.quantities.refusals import InputError, hint, refuse

P = ParamSpec("P")
T = TypeVar("T")

Drawable: TypeAlias = Any  # a dataset, or the result that makes it
Take: TypeAlias = Callable[[Any, Any], Any]  # makes a dataset of a result, at an instant

LOOK = tuple(Look.__annotations__)
SEVERAL_TEXT = (
    "xarray.Dataset, result, or list or dictionary of them",
    "\n    The keys of a dictionary name the impacts in the legend.",
)
LOOK_TEXT = """**look : width, font_size, style, ax
    Width in mm, size of labels in points, style of matplotlib; see `carom.plots.style.style`. What
    has one panel is drawn into `ax`, Axes of your own, if you give them."""
AT_TEXT = """at : float or str, optional
    Of a result: the time in s of an impact, by default that of the largest normal force, or the
    step of a load path, by default the last."""
FIGURE_TEXT = """matplotlib.figure.Figure
    The figure, as wide as one column of a paper, 86 mm, or two, 178 mm."""
IMPACT_TEXT = """>>> ball = carom.Sphere(radius="5 mm", material="steel")
>>> pair = carom.Pair(ball, carom.HalfSpace(material="steel"), friction=0.2)
>>> hit = carom.impact(pair, speed=2.0, angle="30 deg")
"""
REFUSED_TEXT = """InputError
    If the dataset is another one."""


def draws(
    what: str,
    *needed: str,
    along: str | tuple[str, ...] = (),
    take: str | Take = "to_dataset",
    several: bool = False,
) -> Callable[[Callable[P, T]], Callable[P, T]]:
    """Let a function of a dataset take a result, too, in any size and style; refuse all else.

    `what` says what it draws and what makes it; all of `needed` must be in it, the first of them
    along these dimensions. A result gives its dataset by a method, `take`, or by a function of it
    and `at`. With `several`, a list or dictionary of them becomes a dictionary of datasets.
    """
    dims = (along,) if isinstance(along, str) else along

    def decorate(draw: Callable[P, T]) -> Callable[P, T]:
        name, parameters = getattr(draw, "__name__", ""), signature(draw)
        first = next(iter(parameters.parameters))

        def read(result: Any, at: Any) -> Any:
            return checked_dataset(_dataset(result, take, at), f"{name} draws {what}", needed, dims)

        kind, more = SEVERAL_TEXT if several else ("xarray.Dataset or result", "")
        described = f"{first} : {kind}\n    {what[0].upper()}{what[1:]}.{more}"

        @wraps(documented(draw, described))
        def checked(*args: P.args, **kwargs: P.kwargs) -> T:
            arguments: dict[str, Any] = parameters.bind(*args, **kwargs).arguments
            with looking(arguments.pop("look", {}), name, parameters.parameters):
                try:
                    if several and isinstance(arguments[first], list | tuple | dict):
                        pairs = _named(arguments[first], name)
                        arguments[first] = {key: read(one, None) for key, one in pairs}
                    else:
                        arguments[first] = read(arguments[first], arguments.get("at"))
                    return draw(**arguments)  # type: ignore[call-arg]
                except InputError:
                    raise
                except (ValueError, LookupError, ArithmeticError) as error:  # of what is in it
                    reason = " ".join(str(error).split())
                    raise InputError(f"{name}: this dataset cannot be drawn; {reason}") from error

        return checked

    return decorate


@contextmanager
def looking(look: Any, name: str, parameters: Iterable[str]) -> Iterator[None]:
    """Let a function draw in the style that is wanted, or into a user's Axes."""
    words = [*(word for word in parameters if word != "look"), *LOOK]
    refuse(*(f"{w}: no keyword of {name}; {hint(w, words)}" for w in look if w not in LOOK))
    axes = look.get("ax")
    wanted = {word: value for word, value in look.items() if word != "ax" and value is not None}
    if axes is not None and "width" in wanted:
        raise InputError("width: the figure that ax belongs to has its own; leave one of both out")
    own = nullcontext() if axes is not None and not wanted else style.style(**wanted)
    with own, into(axes), quiet():
        yield
        if axes is not None:
            make_room_around(axes)


def documented(draw: Callable[P, T], drawn: str = "") -> Callable[P, T]:
    """Add to a docstring what all functions that draw take, return and refuse.

    `drawn` describes the first parameter, if the docstring does not; `hit` is an impact.
    """
    text, _, examples = cleandoc(draw.__doc__ or "").partition("\nExamples\n--------\n")
    text, _, raises = text.partition("\nRaises\n------\n")
    text, _, returns = text.partition("\nReturns\n-------\n")
    text, _, parameters = text.partition("\nParameters\n----------\n")
    begin = IMPACT_TEXT if "(hit" in examples else ""
    described = drawn if drawn.split(" :")[0] + " :" not in parameters else ""
    at = AT_TEXT if "at" in signature(draw).parameters else ""
    every = (described, parameters.strip(), at, LOOK_TEXT)
    sections = (
        text.rstrip(),
        "Parameters\n----------\n" + "\n".join(filter(None, every)),
        f"Returns\n-------\n{returns.strip() or FIGURE_TEXT}",
        f"Raises\n------\n{raises.strip() or REFUSED_TEXT}",
        f"Examples\n--------\n{begin}{examples}" if examples else "",
    )
    draw.__doc__ = "\n\n".join(sections).rstrip() + "\n"
    return draw


def _dataset(result: Any, take: str | Take, at: Any) -> Any:
    """Return a dataset, that of a result if it is one; else what was given."""
    if hasattr(result, "data_vars"):
        if at is not None:
            raise InputError("at: this dataset has its instant; leave it out, or give the result")
        return result
    if callable(take):
        return take(result, at)
    method = getattr(result, take, None)
    return method() if callable(method) else result


def _named(results: Any, name: str) -> Iterator[tuple[str, Any]]:
    """Yield results or datasets with their names: those of a dictionary, or numbers."""
    refuse(not results and f"{name}: there is nothing to draw; give one result or more")
    items = results.items() if isinstance(results, dict) else enumerate(results, 1)
    names = [str(key) for key, _ in items]
    if len(set(names)) < len(names):
        raise InputError(f"{name}: two results have the same name; give each its own")
    yield from zip(names, results.values() if isinstance(results, dict) else results, strict=True)


def checked_dataset(
    dataset: Any, drawn: str, needed: tuple[str, ...], along: tuple[str, ...] = ()
) -> Any:
    """Return a dataset in which all is that is needed, or refuse it in words that begin as told."""
    lacks = ""
    if not hasattr(dataset, "data_vars"):
        lacks = f"is no dataset but of type {type(dataset).__name__}"
    elif missing := [name for name in needed if name not in dataset.variables]:
        lacks = f"has no {missing[0]}"
    elif dataset[needed[0]].dims != along if along else not dataset[needed[0]].dims:
        lacks = f"has no {needed[0]} along {' and '.join(along) or 'a dimension'}"
    elif not dataset[needed[0]].size:
        lacks = f"has no values of {needed[0]}"
    refuse(lacks and f"{drawn}; what was given {lacks}")
    return dataset


def at_instant(*methods: str) -> Take:
    """Return what takes fields of a result by the first of the methods that it has.

    By default at the instant of the largest normal force, or after the last step.
    """

    def take(result: Any, at: Any) -> Any:
        make = next((getattr(result, each) for each in methods if hasattr(result, each)), None)
        if make is None:
            return result
        if at is None and hasattr(result, "history"):
            history = result.history()
            at = float(history["time"][int(np.argmax(history["normal_force"].values))])
        return make(-1 if at is None else at)

    return take
