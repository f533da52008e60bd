"""How far the loss may rise for a confidence."""

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def rise_of(confidence: float, freedom: Array) -> Array:
    """Return the square of Student's t, a quantile of F(1, freedom); of chi squared if infinite."""
    from scipy.special import ndtri, stdtrit

    level = 0.5 + 0.5 * confidence
    bounded = np.where(np.isfinite(freedom), freedom, 1.0)
    return np.asarray(np.where(np.isfinite(freedom), stdtrit(bounded, level), ndtri(level)) ** 2)
