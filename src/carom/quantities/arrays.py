"""Arrays that users give, read: numbers, points, the lines of a grid; and formulas of arrays.

With `sqrt` and the like a formula is written once, for one impact and for a block of many, and is
annotated as that of one: a number in gives a plain float, not a NumPy one. What has no value is NaN
or infinite, as in IEEE arithmetic, and nothing is raised.
"""

import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from math import prod
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom.quantities.glossary import GLOSSARY
from carom.quantities.refusals import InputError, refusal, refuse
from carom.quantities.texts import CANNOT_HOLD, UNCHANGED, Factor, Unreadable, split
from carom.quantities.units import REAL_KINDS, as_float, factor_of, is_real, number, without_unit

Array = NDArray[np.float64]

REALS = "give real numbers, one or an array of them"
INT64_END = 2**63
MOST_POINTS = 10**8  # of a batch
MOST_PLACES = 1_000_000  # of fields, which take half a minute
AXES = {"x", "y", "z"}
IN_METRES = "must be a list of finite numbers in m"
POSITIVES = "must be one or more positive finite numbers"
ASCII_NUMBERS = re.compile(r"[0-9.+\-eE \t]*")  # NumPy reads those of the grammar alone


class Places(NamedTuple):
    """Places of a dataset: its dimensions and coordinates, and an array of shape (..., columns)."""

    dims: tuple[str, ...]
    coords: dict[str, Any]
    at: Array


class _Reading(NamedTuple):
    """What numbers are read for: their name and unit, what is allowed, whether a mask may be."""

    name: str
    unit: str
    allowed: str
    texts: bool
    gaps: bool


def numbers(
    name: str, values: Any, allowed: str, unit: str | None = None, *, gaps: bool = False
) -> Array:
    """Return real numbers in SI units as an array, or raise InputError.

    Texts, pint's quantities and xarray's arrays may have units of their own; `unit` is that of the
    glossary by default, and that of bare numbers. With `gaps` what is masked is NaN.
    """
    unit = unit or (GLOSSARY[name].unit if name in GLOSSARY else "1")
    return _read(values, _Reading(name, unit, allowed, texts=True, gaps=gaps))


def pure_numbers(name: str, values: Any, allowed: str = REALS) -> Array:
    """Return real numbers without a unit as an array, NaN where they are masked, or raise."""
    return _read(values, _Reading(name, "1", allowed, texts=False, gaps=True))


def _read(values: Any, reading: _Reading) -> Array:
    try:
        plain = np.asarray(_bare(values, reading))
    except InputError:
        raise
    except Exception:  # of ragged lists, and whatever arrays of other libraries raise
        plain = np.asarray(None)
    if plain.dtype.kind not in REAL_KINDS and plain.size:
        raise refusal(reading.name, values, reading.allowed)
    return floats(reading.name, plain)


def floats(name: str, values: NDArray[Any]) -> Array:
    """Return a contiguous copy of real numbers in double precision, or raise if one overflows."""
    with np.errstate(all="ignore"):
        doubles = values.astype(np.float64, order="C")
    return _held(name, values, doubles) if values.dtype.itemsize > doubles.itemsize else doubles


def _held(name: str, values: NDArray[Any], converted: Array) -> Array:
    """Return what has become of numbers, or raise InputError if one overflows."""
    lost = np.any(np.isinf(converted) & np.isfinite(values))
    refuse(lost and refusal(name, values, CANNOT_HOLD))
    return converted


def refuse_where(name: str, values: Array, bad: NDArray[np.bool_], allowed: str) -> None:
    """Raise InputError with the first of the numbers that are bad, if any is."""
    if np.any(bad):
        raise refusal(name, float(np.broadcast_to(values, bad.shape)[bad][0]), allowed)


def in_unit(name: str, values: Array, own: Factor) -> Array:
    """Return numbers in another unit, or raise InputError if one overflows."""
    if own == UNCHANGED:
        return values
    with np.errstate(over="ignore"):
        return _held(name, values, values * own.times / own.over)


def _bare(values: Any, reading: _Reading) -> Any:
    """Return numbers in SI units, None for anything else, or raise InputError for another unit."""
    if type(values) is float or (type(values) is int and abs(values) < INT64_END):
        return values
    if isinstance(values, list | tuple):
        return [_bare(each, reading) for each in values]
    if isinstance(values, bytes | bytearray | memoryview):
        return None
    plain, unit = without_unit(reading.name, values, reading.unit)
    if unit is not None:  # what has a unit holds plain numbers
        own = factor_of(reading.name, unit, reading.unit)
        return in_unit(reading.name, _read(plain, reading._replace(unit="1", texts=False)), own)
    if isinstance(plain, str):
        return number(reading.name, plain, reading.unit) if reading.texts else None
    if is_real(plain):
        return as_float(reading.name, plain)
    if isinstance(plain, np.ma.MaskedArray):
        if not reading.gaps:
            allowed = "masked arrays are not supported; give plain arrays"
            raise refusal(reading.name, values, f"{allowed}; {reading.allowed}")
        real = plain.dtype.kind in REAL_KINDS
        return np.ma.filled(plain.astype(np.float64), np.nan) if real else None
    array = np.asarray(plain)
    if array.dtype.kind in "OU" and (array.ndim or array is plain):
        return _bare(array.tolist(), reading)
    return array if array.dtype.kind in REAL_KINDS or not array.size else None


def together(arrays: Mapping[str, Array], most: int = MOST_POINTS) -> tuple[int, ...]:
    """Return the shape to which arrays broadcast, or raise InputError; also if it is too large."""
    names, shapes = ", ".join(arrays), [values.shape for values in arrays.values()]
    try:
        shape = np.broadcast_shapes(*shapes)
    except (ValueError, RuntimeError):  # RuntimeError: of more than 32 dimensions
        words = " and ".join(map(str, shapes))
        raise InputError(
            f"{names}: the shapes {words} do not fit each other; give numbers, or arrays that "
            "broadcast"
        ) from None
    if prod(shape) > most:
        allowed = f"{prod(shape):,} points are too many at once; the limit is {most:,}"
        raise InputError(f"{names}: {allowed}, so give them in parts")
    return shape


def along_the_same(**arrays: Any) -> None:
    """Raise InputError for arrays of xarray's or pandas' whose dimensions or labels differ."""
    named = {name: getattr(value, "dims", ()) for name, value in arrays.items()}
    along = {name: tuple(map(str, dims)) for name, dims in named.items() if dims}
    longest = max(along.values(), key=len, default=())
    if any(dims != longest[-len(dims) :] for dims in along.values()):
        words = " and ".join(dict.fromkeys(", ".join(dims) for dims in along.values()))
        allowed = f"their dimensions are {words}; give arrays along the same ones"
        raise InputError(f"{', '.join(along)}: {allowed}")
    seen: dict[Any, tuple[str, Any]] = {}
    for name, value in arrays.items():
        for dim, labels in _labels(value):
            other, first = seen.setdefault((dim, len(labels)), (name, labels))
            if not first.equals(labels):
                ends = f"{first[0]} to {first[-1]} and {labels[0]} to {labels[-1]}"
                words = f"their labels along {dim} differ, {ends}"
                raise InputError(f"{other}, {name}: {words}; align them, or give plain arrays")
            if 1 < len(labels) <= len(AXES) and {*labels} <= AXES and [*labels] != sorted(labels):
                raise refusal(name, ", ".join(labels), f"put {dim} into the order x, y, z")


def _labels(value: Any) -> Iterable[tuple[Any, Any]]:
    """Return what names the elements along the dimensions of an array: indices of pandas'."""
    if isinstance(named := getattr(value, "indexes", None), Mapping):
        return named.items()
    axes = {name: getattr(value, name, None) for name in ("index", "columns")}
    return [(name, axis) for name, axis in axes.items() if hasattr(axis, "equals")]


def plain_numbers(texts: Sequence[str]) -> Array | None:
    """Return texts that are all numbers without a unit as an array, quickly; else None."""
    if not texts or ASCII_NUMBERS.fullmatch("".join(texts)) is None:
        return None
    try:
        values = np.array(texts, dtype=np.float64)
        for place in np.flatnonzero((values == 0.0) | np.isinf(values)):
            split(texts[int(place)])  # what rounds to zero or infinity is no number
    except (ValueError, Unreadable):
        return None
    return values


def scattered(name: str, values: ArrayLike, columns: int) -> Array:
    """Return points as an array of shape (n, columns), or raise InputError."""
    allowed = f"must be finite numbers in m, of shape (n, {columns})"
    points = None if isinstance(values, str) else numbers(name, values, allowed, "m")
    if points is None or points.ndim != 2 or points.shape[1] != columns or points.shape[0] == 0:
        raise refusal(name, values if points is None else points, allowed)
    for row in np.flatnonzero(~np.isfinite(points).all(axis=1)):
        raise refusal(name, points[row].tolist(), f"row {row} is not finite; {allowed}")
    return points


def finite_line(
    name: str,
    values: ArrayLike,
    allowed: str = "must be a list of finite numbers",
    *,
    above: float = -np.inf,
) -> Array:
    """Return one finite number or more as an array of shape (n,), or raise InputError."""
    line = np.atleast_1d(numbers(name, values, allowed))
    bad = ~(np.isfinite(line) & (line > above))
    if line.size == 0 or line.ndim > 1 or bad.any():
        raise refusal(name, line[bad][0].item() if bad.any() else values, allowed)
    return line


def places(
    space: str,
    grid: Mapping[str, ArrayLike | None],
    default: Mapping[str, Array],
    points: ArrayLike | None,
) -> Places:
    """Return points, or a grid along two of the axes, others zero; InputError for both."""
    if points is not None:
        both, wanted = any(values is not None for values in grid.values()), " and ".join(grid)
        allowed = f"give a grid by {wanted}, or points"
        refuse(both and refusal("points", f"points with {wanted}", allowed))
        at = scattered("points", points, len(space))
        return Places(("point",), {name: ("point", at[:, i]) for i, name in enumerate(space)}, at)
    lines = {
        name: default[name] if values is None else finite_line(name, values, IN_METRES)
        for name, values in grid.items()
    }
    if prod(values.size for values in lines.values()) > MOST_PLACES:
        sizes = " by ".join(f"{values.size}" for values in lines.values())
        raise refusal(" and ".join(grid), f"{sizes} points", f"at most {MOST_PLACES:,} are allowed")
    columns = dict(zip(lines, np.meshgrid(*lines.values()), strict=True))
    zero = np.zeros_like(next(iter(columns.values())))
    at = np.stack([columns.get(name, zero) for name in space], axis=-1)
    coords = {name: lines.get(name, 0.0) for name in space}
    return Places(tuple(reversed(lines)), coords, at)


def _elementwise(function: Callable[..., Any]) -> Callable[..., Any]:
    def of_numbers_or_arrays(*arguments: Any) -> Any:
        with np.errstate(all="ignore"):
            result = function(*arguments)
        return result if np.ndim(result) else result.item()

    return of_numbers_or_arrays


isfinite: Callable[[float], bool] = _elementwise(np.isfinite)
sqrt: Callable[[float], float] = _elementwise(np.sqrt)
cos: Callable[[float], float] = _elementwise(np.cos)
sin: Callable[[float], float] = _elementwise(np.sin)
copysign: Callable[[float, float], float] = _elementwise(np.copysign)
hypot: Callable[[float, float], float] = _elementwise(np.hypot)
arctan2: Callable[[float, float], float] = _elementwise(np.arctan2)
quotient: Callable[[float, float], float] = _elementwise(np.divide)
minimum: Callable[[float, float], float] = _elementwise(np.minimum)
where: Callable[[bool, float, float], float] = _elementwise(np.where)
