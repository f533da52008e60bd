"""How Python's arguments become those of a C function: read from the annotations of a kernel.

A float is a double, an int or a bool an int64_t, an array its address and its shape, a named tuple
its fields one after the other. What a kernel returns is written to addresses that come last.
"""

import ctypes
from collections.abc import Callable, Iterator, Mapping
from types import NoneType
from typing import Any, NamedTuple, get_args, get_origin, get_type_hints

import numpy as np

NUMBERS: dict[Any, tuple[Any, Callable[[Any], Any]]] = {
    float: (ctypes.c_double, float),
    int: (ctypes.c_int64, int),
    bool: (ctypes.c_int64, bool),
}
BYTE = ctypes.c_char
Flatten = Callable[[Any, list[Any]], None]


class ArrayType(NamedTuple):
    """The type of an array: that of its items, and the number of its dimensions."""

    dtype: Any
    ndim: int


class Group(NamedTuple):
    """The type of a named tuple, or of a plain one, and the types of its items."""

    make: Any
    kinds: tuple[Any, ...]


class Signature(NamedTuple):
    """What a kernel takes, by name, and what it gives, as a tuple of types."""

    parameters: Mapping[str, Any]
    results: tuple[type, ...]
    single: bool

    def __str__(self) -> str:
        """Return the types in the order of the C function: all that a caller must know."""
        return f"{' '.join(map(_label, self.leaves()))} -> {' '.join(map(_label, self.results))}"

    def leaves(self) -> Iterator[Any]:
        """Give the numbers and arrays in their order."""
        for kind in self.parameters.values():
            yield from _leaves(kind)

    def arrays(self) -> Iterator[ArrayType]:
        """Give the arrays in their order."""
        return (kind for kind in self.leaves() if isinstance(kind, ArrayType))


def signature_of(function: Callable[..., Any], floats: str = "float64") -> Signature:
    """Return the signature of a kernel; arrays of any floating type are of the one told."""
    hints = get_type_hints(function, include_extras=True)
    result = hints.pop("return")
    several = get_origin(result) is tuple
    results = get_args(result) if several else () if result is NoneType else (result,)
    floating = np.dtype(floats)
    parameters = {name: _plain(hint, floating) for name, hint in hints.items()}
    return Signature(parameters, results, not several)


def _plain(hint: Any, floating: Any) -> Any:
    """Return a type as it is used here: of a number, an array, or a group of them."""
    if hasattr(hint, "__metadata__"):
        kind = get_args(get_args(hint.__origin__)[1])[0]
        dtype = floating if kind is np.floating else np.dtype(kind)
        return ArrayType(dtype, hint.__metadata__[0])
    if get_origin(hint) is tuple:
        return Group(tuple, tuple(_plain(each, floating) for each in get_args(hint)))
    if hasattr(hint, "_fields"):
        fields = get_type_hints(hint, include_extras=True)
        return Group(hint, tuple(_plain(fields[name], floating) for name in hint._fields))
    if hint in NUMBERS:
        return hint
    raise TypeError(f"{hint!r} cannot be handed to a kernel of the library")


def _leaves(kind: Any) -> Iterator[Any]:
    if isinstance(kind, Group):
        for each in kind.kinds:
            yield from _leaves(each)
    else:
        yield kind


def _label(kind: Any) -> str:
    return f"{kind.dtype.str}[{kind.ndim}]" if isinstance(kind, ArrayType) else kind.__name__


def c_types(signature: Signature) -> list[Any]:
    """Return the types of the arguments of the C function, as ctypes has them."""
    found: list[Any] = []
    for kind in signature.leaves():
        if isinstance(kind, ArrayType):
            found += [ctypes.c_void_p, *[ctypes.c_int64] * kind.ndim]
        else:
            found.append(NUMBERS[kind][0])
    return found + [ctypes.POINTER(NUMBERS[kind][0]) for kind in signature.results]


def caller(pointer: Any, signature: Signature) -> Callable[..., Any]:
    """Return a function of Python's that calls a C function.

    It raises TypeError for arrays of another type, or that are not contiguous: the C function
    could not tell.
    """
    pointer.argtypes, pointer.restype = c_types(signature), ctypes.c_int
    flatteners = [_flattener(kind) for kind in signature.parameters.values()]
    kinds = [NUMBERS[kind] for kind in signature.results]

    def call(*given: Any) -> Any:
        flat: list[Any] = []
        for flatten, value in zip(flatteners, given, strict=True):
            flatten(value, flat)
        results = [kind() for kind, _ in kinds]
        if pointer(*flat, *map(ctypes.byref, results)):
            raise RuntimeError(f"{pointer.__name__} has failed")
        values = tuple(python(each.value) for each, (_, python) in zip(results, kinds, strict=True))
        if signature.single:
            return values[0] if values else None
        return values

    return call


def _flattener(kind: Any) -> Flatten:
    if isinstance(kind, ArrayType):
        return _array_flattener(kind)
    if not isinstance(kind, Group):
        python = NUMBERS[kind][1]
        return lambda value, flat: flat.append(python(value))
    inner = [_flattener(each) for each in kind.kinds]

    def flatten(value: Any, flat: list[Any]) -> None:
        for one, item in zip(inner, value, strict=True):
            one(item, flat)

    return flatten


def _array_flattener(kind: ArrayType) -> Flatten:
    dtype, ndim = kind

    def flatten(value: Any, flat: list[Any]) -> None:
        if value.dtype != dtype or value.ndim != ndim or not value.flags.c_contiguous:
            raise TypeError(
                f"a kernel takes contiguous arrays of {dtype} with {ndim} dimensions, not of "
                f"{value.dtype} with {value.ndim}"
            )
        try:  # several times faster than what comes next
            flat.append(ctypes.addressof(BYTE.from_buffer(value)))
        except (TypeError, ValueError):  # read-only, or empty
            flat.append(value.ctypes.data)
        flat.extend(value.shape)

    return flatten
