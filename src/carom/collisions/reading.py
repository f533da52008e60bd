"""Reading the vectors of collisions, and the shape that they have in common."""

from collections.abc import Sequence
from typing import Any

import array_api_compat
import numpy as np
from numpy.typing import ArrayLike, NDArray

from carom.quantities import InputError, refusal

NAMES = ("velocity1", "spin1", "velocity2", "spin2", "normal")
ALLOWED = "must be an array of real numbers of shape (..., 3)"


def is_foreign(values: Any) -> bool:
    """Return whether this is an array of another library than NumPy."""
    return array_api_compat.is_array_api_obj(values) and not isinstance(
        values, np.ndarray | np.generic
    )


def vectors(name: str, values: ArrayLike | None) -> NDArray[np.floating] | None:
    """Return what is given as vectors of floating-point numbers, or raise InputError."""
    if values is None:
        return None
    if isinstance(values, np.ma.MaskedArray):
        raise refusal(name, values, "a mask is not heeded; give plain arrays, NaN where none is")
    try:
        array = np.asarray(values)
    except ValueError:
        raise refusal(name, values, ALLOWED) from None
    if array.dtype.kind not in "fiu" or array.shape[-1:] != (3,):
        raise refusal(name, values, ALLOWED)
    return array if array.dtype == np.float32 else np.asarray(array, dtype=np.float64)


def common_shape(arrays: Sequence[Any]) -> tuple[int, ...]:
    """Return the shape to which the arrays broadcast, None left out, or raise InputError."""
    shapes = {
        name: tuple(each.shape)
        for name, each in zip(NAMES, arrays, strict=True)
        if each is not None
    }
    for name in ("velocity1", "normal"):
        if name not in shapes:
            raise InputError(f"{name}: missing; give an array of shape (..., 3)")
    try:
        return np.broadcast_shapes(*shapes.values())
    except ValueError:
        words = ", ".join(f"{name} {shape}" for name, shape in shapes.items())
        raise InputError(f"shapes: {words} do not broadcast; give (N, 3) or (3,) each") from None
