"""Reading positions that users give: points, and the lines of a grid."""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom.quantities import refusal, without_units

Array = NDArray[np.float64]


def scattered(name: str, given: ArrayLike, columns: int) -> Array:
    """Return points as an array of shape (n, columns), or raise InputError."""
    allowed = f"must be finite numbers in m, of shape (n, {columns})"
    try:
        points = np.asarray(given, dtype=np.float64)
    except (TypeError, ValueError):
        raise refusal(name, given, allowed) from None
    if points.ndim != 2 or points.shape[1] != columns or points.shape[0] == 0:
        raise refusal(name, f"an array of shape {points.shape}", allowed)
    if not np.all(np.isfinite(points)):
        row = int(np.argwhere(~np.isfinite(points))[0, 0])
        raise refusal(name, points[row].tolist(), f"row {row} is not finite; {allowed}")
    return points


def line(name: str, given: ArrayLike) -> Array:
    """Return positions along an axis as an array of shape (n,), or raise InputError."""
    given = without_units(name, given)
    try:
        values = np.atleast_1d(np.asarray(given, dtype=np.float64))
    except (TypeError, ValueError):
        raise refusal(name, given, "must be a list of finite numbers in m") from None
    if values.ndim != 1 or values.size == 0 or not np.all(np.isfinite(values)):
        raise refusal(name, given, "must be a list of finite numbers in m")
    return values
