"""Reading arrays that users give: numbers, points, the lines of a grid."""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom.quantities import refusal, without_units

Array = NDArray[np.float64]


def numbers(name: str, given: ArrayLike, allowed: str) -> Array:
    """Return real numbers as an array, texts with units in SI units, or raise InputError."""
    plain = without_units(name, given)
    try:
        values = np.asarray(plain)
    except ValueError:
        raise refusal(name, given, allowed) from None
    if values.dtype.kind not in "iuf" or isinstance(plain, np.ma.MaskedArray):
        raise refusal(name, given, allowed)
    return values.astype(np.float64)


def scattered(name: str, given: ArrayLike, columns: int) -> Array:
    """Return points as an array of shape (n, columns), or raise InputError."""
    allowed = f"must be finite numbers in m, of shape (n, {columns})"
    if isinstance(given, str):
        raise refusal(name, given, allowed)
    points = numbers(name, given, allowed)
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
