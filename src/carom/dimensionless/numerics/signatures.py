"""How Python's arguments become those of a C function: read from the annotations of a kernel.

All are packed into one block of eight bytes each: a float as a double, an int or a bool as an
int64_t, an array as its address and its shape, a named tuple as its fields one after the other.
What a kernel returns is written to the end of the block.
"""

import ctypes
import struct
from collections.abc import Callable, Iterator, Mapping
from types import NoneType
from typing import Annotated, Any, NamedTuple, get_args, get_origin, get_type_hints

import numpy as np

from carom.dimensionless.numerics.arrays import ArrayType

CODES: dict[Any, str] = {float: "d", int: "q", bool: "q"}  # of the struct module
BYTE = ctypes.c_char


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
        for kind in self.parameters.values():
            yield from _leaves(kind)

    def arrays(self) -> Iterator[ArrayType]:
        return (kind for kind in self.leaves() if isinstance(kind, ArrayType))


def signature_of(function: Callable[..., Any], floats: str = "float64") -> Signature:
    """Return the signature of a kernel; arrays of any floating type are of the one named."""
    hints = get_type_hints(function, include_extras=True)
    result = hints.pop("return")
    several = get_origin(result) is tuple
    results = get_args(result) if several else () if result is NoneType else (result,)
    floating = np.dtype(floats)
    parameters = {name: _plain(hint, floating) for name, hint in hints.items()}
    return Signature(parameters, results, not several)


def _plain(hint: Any, floating: Any) -> Any:
    """Return a type as it is used here: of a number, an array, or a group of them."""
    if get_origin(hint) is Annotated:
        _, kind = get_args(hint)
        return ArrayType(floating if kind.dtype is np.floating else np.dtype(kind.dtype), kind.ndim)
    if get_origin(hint) is tuple:
        return Group(tuple, tuple(_plain(each, floating) for each in get_args(hint)))
    if hasattr(hint, "_fields"):
        fields = get_type_hints(hint, include_extras=True)
        return Group(hint, tuple(_plain(fields[name], floating) for name in hint._fields))
    if hint in CODES:
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


def caller(pointer: Any, signature: Signature) -> Callable[..., Any]:
    """Return a function of Python's that calls a C function, its text written for the signature.

    A loop over the arguments would take longer than an impact. Arrays of another type, or not
    contiguous, raise TypeError, another number of dimensions ValueError: C could not tell.
    """
    pointer.argtypes, pointer.restype = (ctypes.c_char_p,), ctypes.c_int
    arguments = [f"x{i}" for i in range(len(signature.parameters))]
    writer = _Writer()
    for name, kind in zip(arguments, signature.parameters.values(), strict=True):
        writer.read(name, kind)
    layout = struct.Struct("".join((*writer.codes, *(CODES[kind] for kind in signature.results))))
    names = {**writer.names, "pack": layout.pack, "pointer": pointer, "address": _address}
    names |= {"BYTE": BYTE.from_buffer, "addressof": ctypes.addressof, "unpack": layout.unpack}
    packed = ", ".join((*writer.values, *"0" * len(signature.results)))
    lines = [*writer.lines, f"packed = pack({packed})", "if pointer(packed):"]
    lines.append(f"    raise RuntimeError('{pointer.__name__} has failed')")
    if signature.results:
        results = f"unpack(packed)[{-len(signature.results)}:]"
        lines.append(f"return {results}{'[0]' if signature.single else ''}")
    body = "\n    ".join(lines)
    exec(f"def call({', '.join(arguments)}):\n    {body}", names)
    return names["call"]  # type: ignore[no-any-return]


class _Writer:
    """The text that makes arguments numbers: its lines, the values to pack, and their codes."""

    def __init__(self) -> None:
        self.lines: list[str] = []
        self.values: list[str] = []
        self.codes: list[str] = []
        self.names: dict[str, Any] = {}

    def read(self, name: str, kind: Any) -> None:
        if isinstance(kind, Group):
            parts = [f"{name}_{i}" for i in range(len(kind.kinds))]
            self.lines.append(f"{', '.join(parts)}, = {name}")
            for part, each in zip(parts, kind.kinds, strict=True):
                self.read(part, each)
        elif isinstance(kind, ArrayType):
            shape = [f"{name}_n{i}" for i in range(kind.ndim)]
            dtype = f"dtype_{kind.dtype.name}"
            self.names[dtype] = kind.dtype
            self.lines.append(f"{', '.join(shape)}, = {name}.shape")
            quick = f"{name}.dtype is {dtype} and {name}.flags.carray and {' and '.join(shape)}"
            self.values += [f"(addressof(BYTE({name})) if {quick} else address({name}, {dtype}))"]
            self.values += shape
            self.codes += "q" * (1 + kind.ndim)
        else:
            self.values.append(name)
            self.codes.append(CODES[kind])


def _address(array: Any, dtype: Any) -> int:
    """Return where an array lies; slower, for those that are empty or cannot be written."""
    if array.dtype != dtype or not array.flags.c_contiguous:
        order = "contiguous" if array.flags.c_contiguous else "strided"
        raise TypeError(f"a kernel takes contiguous arrays of {dtype}, not {order} {array.dtype}")
    return int(array.ctypes.data)
