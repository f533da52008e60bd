"""Kernels: functions of numbers and arrays, plain Python that is run as machine code.

`kernel` marks them all. Those that Python calls are entry points: they come compiled with the
package, in one shared library, and their annotations tell how they are called. Without a library,
and for kernels that are none of these, numba compiles on first use if it is installed; otherwise
they run as they are written.
"""

import os
import sys
from collections.abc import Callable
from functools import cache, cached_property, update_wrapper
from importlib.metadata import version
from importlib.util import find_spec
from multiprocessing import parent_process
from typing import Any, Generic, ParamSpec, TypeVar, cast

import numpy as np

from carom.dimensionless.numerics import shared_library
from carom.dimensionless.numerics.signatures import Signature, signature_of
from carom.quantities.refusals import InputError, one_of

VARIABLE = "CAROM_KERNELS"  # of the environment: library, numba or python
WAYS = ("library", "numba", "python")
INSTALL = 'pip install "carom[jit]"'
Parameters = ParamSpec("Parameters")
Result = TypeVar("Result")


def way() -> str:
    """Return how kernels are to be run, or raise InputError."""
    chosen = one_of(VARIABLE, os.environ.get(VARIABLE, "library"), WAYS)
    if chosen == "numba" and not has_numba():
        raise InputError(f"{VARIABLE}: numba is not installed; {INSTALL}")
    return chosen


@cache
def has_numba() -> bool:
    """Tell whether kernels can be compiled here."""
    return find_spec("numba") is not None


def compiled_by() -> str:
    """Return what has compiled the kernels that are run, which decides the last bit of a result."""
    chosen = way()
    if chosen == "library" and not shared_library.reason():
        return shared_library.opened().compiled_by
    compiles = chosen != "python" and has_numba()
    return f"numba {version('numba')}" if compiles else "nothing (plain Python)"


@cache
def warn_of_python() -> None:
    """Say once, in the process that the user has started, why the solver is slow."""
    if parent_process() is None:
        why, what = shared_library.reason(), "Carom runs its solver as plain Python"
        print(f"{what}, a thousand times slower ({why}). To be fast: {INSTALL}", file=sys.stderr)


class Kernel(Generic[Parameters, Result]):
    """A function of numbers and arrays, and its compiled forms, each made when it is asked for."""

    def __init__(
        self, function: Callable[Parameters, Result], floats: tuple[str, ...] = ()
    ) -> None:
        self.py_func = function
        self.floats = floats
        update_wrapper(self, function)

    def __call__(self, *args: Parameters.args, **kwargs: Parameters.kwargs) -> Result:
        return self.compiled(*args, **kwargs)

    @cached_property
    def compiled(self) -> Callable[Parameters, Result]:
        """The machine code of the library, or numba's; the function itself if there is neither."""
        if way() == "library" and self.floats:
            compiled = shared_library.function(self.signatures(), self.floats)
            if compiled is not None:
                return cast(Callable[Parameters, Result], compiled)
        if has_numba():
            return cast(Callable[Parameters, Result], self.dispatcher)
        if shared_library.reason():
            warn_of_python()
        return as_written(self.py_func) if self.floats else self.py_func

    @cached_property
    def dispatcher(self) -> Any:
        from carom.dimensionless.numerics.jit import dispatcher

        return dispatcher(self.py_func)

    @property
    def _numba_type_(self) -> Any:  # by which numba knows what a global name in a kernel is
        return self.dispatcher._numba_type_

    def signatures(self) -> dict[str, Signature]:
        """Return the signatures of an entry point, by the name of its C function."""
        name = f"{self.__module__}.{self.py_func.__name__}".replace(".", "_")
        several = len(self.floats) > 1
        return {
            f"{name}_{floats}" if several else name: signature_of(self.py_func, floats)
            for floats in self.floats
        }


ENTRIES: list[Kernel[..., Any]] = []


def kernel(function: Callable[Parameters, Result]) -> Callable[Parameters, Result]:
    """Mark a function of numbers and arrays as one that is compiled."""
    return function if way() == "python" else Kernel(function)


def entry_point(
    *floats: str,
) -> Callable[[Callable[Parameters, Result]], Callable[Parameters, Result]]:
    """Mark a kernel that Python calls, as annotated, for each of the types of floats."""

    def mark(function: Callable[Parameters, Result]) -> Callable[Parameters, Result]:
        if way() == "python":
            return as_written(function)
        ENTRIES.append(Kernel(function, floats or ("float64",)))
        return ENTRIES[-1]

    return mark


def as_written(function: Callable[Parameters, Result]) -> Callable[Parameters, Result]:
    """Return a kernel that is run as Python, and like machine code warns of no infinity."""
    return np.errstate(all="ignore")(function)


def plain(kernel: Callable[Parameters, Result]) -> Callable[Parameters, Result]:
    """Return the Python function of a kernel, for tables that are made when a module is loaded."""
    return kernel.py_func if isinstance(kernel, Kernel) else kernel
