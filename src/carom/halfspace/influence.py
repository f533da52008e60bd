"""Influence coefficients: what a square element under constant traction does to the surface.

A half-space of unit element size. Point forces are Boussinesq's (normal) and Cerruti's
(tangential); over a rectangle their integrals have closed forms (Love 1929, Phil. Trans. R. Soc. A
228:377; Johnson 1985, sections 3.2 and 3.6), a sum over the corners with signs.
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Field = NDArray[np.float64]
Mask = NDArray[np.bool_]
Antiderivative = Callable[[Field, Field], Field]


class Influence(NamedTuple):
    """Integrals over the unit element around the origin, seen from (x, y), r^2 = x^2 + y^2."""

    xx: Field  # of x^2/r^3
    yy: Field  # of y^2/r^3
    xy: Field  # of x y/r^3
    x: Field  # of x/r^2
    y: Field  # of y/r^2


def influence(x: Field, y: Field) -> Influence:
    """Return the influence of the unit element at points none of which lies on a line of corners.

    The sum of `xx` and `yy` is the integral of 1/r, the normal influence of a normal load.

    Examples
    --------
    >>> import numpy as np
    >>> from carom.halfspace.influence import influence
    >>> at_centre = influence(np.array(0.0), np.array(0.0))
    >>> round(float(at_centre.xx + at_centre.yy), 6)  # 4 asinh 1
    3.525494
    """
    return Influence(
        _over_corners(_xx, x, y),
        _over_corners(lambda x, y: _xx(y, x), x, y),
        _over_corners(lambda x, y: -np.hypot(x, y), x, y),
        _over_corners(_x, x, y),
        _over_corners(lambda x, y: _x(y, x), x, y),
    )


def _over_corners(antiderivative: Antiderivative, x: Field, y: Field) -> Field:
    right, left, above, below = x + 0.5, x - 0.5, y + 0.5, y - 0.5
    return (
        antiderivative(right, above)
        - antiderivative(left, above)
        - antiderivative(right, below)
        + antiderivative(left, below)
    )


def _xx(x: Field, y: Field) -> Field:
    """Return the function whose mixed derivative is x^2/r^3: y ln(x + r), less y ln|y|."""
    return y * np.arcsinh(x / np.abs(y))


def _x(x: Field, y: Field) -> Field:
    """Return the function whose mixed derivative is x/r^2."""
    return y * np.log(np.hypot(x, y)) + x * np.arctan(y / x)
