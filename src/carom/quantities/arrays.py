"""Reading arrays that users give: numbers, points, the lines of a grid."""

import re
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom.quantities.glossary import GLOSSARY
from carom.quantities.texts import Unreadable, split
from carom.quantities.units import InputError, in_si, number, refusal

Array = NDArray[np.float64]

ASCII = re.compile(r"[0-9.+\-eE \t]*")  # of which NumPy reads the numbers of the grammar alone


class Places(NamedTuple):
    """Places of a dataset: its dimensions and coordinates, and an array of shape (..., columns)."""

    dims: tuple[str, ...]
    coords: dict[str, Any]
    at: Array


def numbers(name: str, given: Any, allowed: str, unit: str | None = None) -> Array:
    """Return real numbers in SI units as an array, or raise InputError.

    Texts, pint's quantities and xarray's arrays may have units of their own; `unit` is that of the
    glossary, unless it is told, and that of bare numbers.
    """
    unit = unit or (GLOSSARY[name].unit if name in GLOSSARY else "1")
    try:
        values = np.asarray(_bare(name, given, unit))
    except (ValueError, TypeError, RecursionError) as error:
        if isinstance(error, InputError):
            raise
        raise refusal(name, given, allowed) from None
    if values.dtype.kind not in "iuf" or isinstance(given, np.ma.MaskedArray):
        raise refusal(name, given, allowed)
    return values.astype(np.float64)


def _bare(name: str, given: Any, unit: str) -> Any:
    """Return one value or nested lists of them in SI units."""
    if type(given) in (float, int):
        return given
    if isinstance(given, str):
        return number(name, given, unit)
    if isinstance(given, np.ndarray) and given.dtype.kind in "OU":
        given = given.tolist()
        return _bare(name, given, unit)
    if isinstance(given, list | tuple):
        return [_bare(name, each, unit) for each in given]
    if isinstance(given, bool | np.bool_):
        raise TypeError("a truth value is no number")
    return in_si(name, given, unit)


def plain_numbers(texts: Sequence[str]) -> Array | None:
    """Return texts that are all numbers without a unit as an array, quickly; else None.

    Examples
    --------
    >>> from carom.quantities.arrays import plain_numbers
    >>> plain_numbers(["1.5", " -2e3"]), plain_numbers(["1.5", "1_000"])
    (array([ 1.5e+00, -2.0e+03]), None)
    """
    if not texts or ASCII.fullmatch("".join(texts)) is None:
        return None
    try:
        values = np.array(texts, dtype=np.float64)
        for place in np.flatnonzero((values == 0.0) | np.isinf(values)):
            split(texts[int(place)])  # what rounds to zero or infinity is no number
    except (ValueError, Unreadable):
        return None
    return values


def scattered(name: str, given: ArrayLike, columns: int) -> Array:
    """Return points as an array of shape (n, columns), or raise InputError."""
    allowed = f"must be finite numbers in m, of shape (n, {columns})"
    if isinstance(given, str):
        raise refusal(name, given, allowed)
    points = numbers(name, given, allowed, "m")
    if points.ndim != 2 or points.shape[1] != columns or points.shape[0] == 0:
        raise refusal(name, points, allowed)
    if not np.all(np.isfinite(points)):
        row = int(np.argwhere(~np.isfinite(points))[0, 0])
        raise refusal(name, points[row].tolist(), f"row {row} is not finite; {allowed}")
    return points


def line(name: str, given: ArrayLike) -> Array:
    """Return positions along an axis as an array of shape (n,), or raise InputError."""
    allowed = "must be a list of finite numbers in m"
    values = np.atleast_1d(numbers(name, given, allowed))
    if values.ndim != 1 or values.size == 0 or not np.all(np.isfinite(values)):
        raise refusal(name, given, allowed)
    return values


def finite_line(name: str, given: ArrayLike) -> Array:
    """Return a list of finite numbers as an array of shape (n,), or raise InputError."""
    allowed = "must be a list of finite numbers"
    values = np.atleast_1d(numbers(name, given, allowed))
    if values.size == 0 or values.ndim > 1 or not np.all(np.isfinite(values)):
        raise refusal(name, given, allowed)
    return values


def positive_line(name: str, given: ArrayLike) -> Array:
    """Return one positive number or more as an array of shape (n,), or raise InputError."""
    allowed = "must be one positive finite number or more"
    values = np.atleast_1d(numbers(name, given, allowed))
    bad = ~((values > 0.0) & (values < np.inf))
    if values.size == 0 or values.ndim > 1 or bad.any():
        raise refusal(name, values[bad][0].item() if bad.any() else given, allowed)
    return values


def places(
    space: str,
    grid: Mapping[str, ArrayLike | None],
    default: Mapping[str, Array],
    points: ArrayLike | None,
) -> Places:
    """Return points, or a grid along two of the axes of space, the others zero there.

    Raises InputError if both are given, or one cannot be used.
    """
    if points is not None:
        if any(given is not None for given in grid.values()):
            wanted = " and ".join(grid)
            raise refusal("points", f"points with {wanted}", f"give a grid by {wanted}, or points")
        at = scattered("points", points, len(space))
        return Places(("point",), {name: ("point", at[:, i]) for i, name in enumerate(space)}, at)
    lines = {
        name: default[name] if given is None else line(name, given) for name, given in grid.items()
    }
    columns = dict(zip(lines, np.meshgrid(*lines.values()), strict=True))
    zero = np.zeros_like(next(iter(columns.values())))
    at = np.stack([columns.get(name, zero) for name in space], axis=-1)
    coords = {name: lines.get(name, 0.0) for name in space}
    return Places(tuple(reversed(lines)), coords, at)
