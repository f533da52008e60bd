"""Arithmetic with twice the digits of a double, for sums that cancel.

A number is the unevaluated sum hi + lo of two doubles: about 32 digits. The error-free sum and
product are those of Knuth (1969, The Art of Computer Programming, vol. 2, section 4.2.2) and
Dekker (1971, Numerische Mathematik 18:224-242).
"""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

Real = float | NDArray[np.float64]

Polynomial = tuple[int, int, int]

NEGLIGIBLE = 1e-33
SPLITTER = 134217729.0  # 2^27 + 1 cuts a double into two halves whose products are exact


class DoubleDouble:
    """A real number, or an array of them, as the sum hi + lo of two doubles.

    x = hi + lo with |lo| <= 2^-53 |hi|; + - * / err by a few 2^-104 of the exact result.

    Parameters
    ----------
    hi, lo : float or ndarray
        The two parts, of one shape (or a float); dimensionless. Nothing is checked: an infinity
        or a NaN gives NaN.

    Examples
    --------
    >>> from carom.dimensionless.twins.doubledouble import DoubleDouble
    >>> third = DoubleDouble(1.0) / 3.0
    >>> (3.0 * third - 1.0).hi
    0.0
    """

    __slots__ = ("hi", "lo")
    __array_ufunc__ = None  # lets array * DoubleDouble come here instead of to numpy

    def __init__(self, hi: Real, lo: Real = 0.0) -> None:
        """Take the two parts as they are."""
        self.hi = hi
        self.lo = lo

    def __neg__(self) -> "DoubleDouble":
        """Return -x."""
        return DoubleDouble(-self.hi, -self.lo)

    def __add__(self, other: "DoubleDouble | Real") -> "DoubleDouble":
        """Return x + y."""
        y = _wide(other)
        total = two_sum(self.hi, y.hi)
        rest = two_sum(self.lo, y.lo)
        first = _renormalised(total.hi, total.lo + rest.hi)
        return _renormalised(first.hi, first.lo + rest.lo)

    def __sub__(self, other: "DoubleDouble | Real") -> "DoubleDouble":
        """Return x - y."""
        return self + (-_wide(other))

    def __mul__(self, other: "DoubleDouble | Real") -> "DoubleDouble":
        """Return x y."""
        y = _wide(other)
        product = two_product(self.hi, y.hi)
        return _renormalised(product.hi, product.lo + (self.hi * y.lo + self.lo * y.hi))

    def __truediv__(self, other: "DoubleDouble | Real") -> "DoubleDouble":
        """Return x / y."""
        y = _wide(other)
        first = self.hi / y.hi
        rest = self - first * y
        second = rest.hi / y.hi
        return _renormalised(first, second)

    def __radd__(self, other: Real) -> "DoubleDouble":
        """Return y + x."""
        return self + other

    def __rsub__(self, other: Real) -> "DoubleDouble":
        """Return y - x."""
        return -self + other

    def __rmul__(self, other: Real) -> "DoubleDouble":
        """Return y x."""
        return self * other


def _wide(x: DoubleDouble | Real) -> DoubleDouble:
    return x if isinstance(x, DoubleDouble) else DoubleDouble(x)


def _renormalised(larger: Real, smaller: Real) -> DoubleDouble:
    total = larger + smaller
    return DoubleDouble(total, smaller - (total - larger))


def two_sum(a: Real, b: Real) -> DoubleDouble:
    """Return a + b without any error (Knuth).

    Examples
    --------
    >>> from carom.dimensionless.twins.doubledouble import two_sum
    >>> x = two_sum(1.0, 1e-20)
    >>> x.hi, x.lo
    (1.0, 1e-20)
    """
    total = a + b
    taken = total - a
    return DoubleDouble(total, (a - (total - taken)) + (b - taken))


def two_product(a: Real, b: Real) -> DoubleDouble:
    """Return a b without any error, for |a|, |b| < 1e300 and no underflow (Dekker).

    Examples
    --------
    >>> from carom.dimensionless.twins.doubledouble import two_product
    >>> x = two_product(1.0 + 2.0**-30, 1.0 - 2.0**-30)
    >>> x.hi, x.lo == -(2.0**-60)
    (1.0, True)
    """
    a_top = SPLITTER * a
    a_top = a_top - (a_top - a)
    b_top = SPLITTER * b
    b_top = b_top - (b_top - b)
    a_low, b_low = a - a_top, b - b_top
    product = a * b
    error = ((a_top * b_top - product) + a_top * b_low + a_low * b_top) + a_low * b_low
    return DoubleDouble(product, error)


def square_root(x: DoubleDouble) -> DoubleDouble:
    """Return the square root of x >= 0: one Newton step from that of a double.

    Examples
    --------
    >>> from carom.dimensionless.twins.doubledouble import DoubleDouble, square_root
    >>> root = square_root(DoubleDouble(2.0))
    >>> abs((root * root - 2.0).hi) < 1e-31
    True
    """
    guess = x.hi**0.5
    return guess + DoubleDouble((x - two_product(guess, guess)).hi / (2.0 * guess + (guess == 0.0)))


def fifth_root(x: DoubleDouble) -> DoubleDouble:
    """Return the fifth root of x >= 0: one Newton step from that of a double.

    Examples
    --------
    >>> from carom.dimensionless.twins.doubledouble import DoubleDouble, fifth_root
    >>> root = fifth_root(DoubleDouble(2.0))
    >>> abs((root * root * root * root * root - 2.0).hi) < 1e-30
    True
    """
    guess = x.hi**0.2
    fourth = two_product(guess, guess) * two_product(guess, guess)
    return guess + DoubleDouble((x - fourth * guess).hi / (5.0 * fourth.hi + (guess == 0.0)))


def coefficients(
    top: Polynomial, bottom: Polynomial, shift: DoubleDouble, older: Polynomial | None = None
) -> list[DoubleDouble]:
    """Return the coefficients c[n] of a power series, c[0] = 1, from a recurrence.

    bottom(n) c[n+1] = (top(n) - shift) c[n] - (older(n) - shift) c[n-1].

    Polynomials are quadratic in n, highest power first; the series ends where its terms at z = 1/2
    are below `NEGLIGIBLE` for good. Without `older` it is the hypergeometric series whose upper
    parameters have the sum s and the product p and whose lower one is c, for top = n^2 + s n + q,
    shift = q - p, bottom = (n + 1)(n + c).

    Examples
    --------
    >>> from carom.dimensionless.twins.doubledouble import DoubleDouble, coefficients
    >>> exact = [c.hi for c in coefficients((1, 0, 0), (1, 2, 1), DoubleDouble(1.0))]
    >>> exact[:3]
    [1.0, -1.0, 0.0]
    """
    before, now = DoubleDouble(0.0), DoubleDouble(1.0)
    series = [now]
    n = 0
    while _size(now) + _size(before) > NEGLIGIBLE * 2.0**n:
        following = (_value(top, n) - shift) * now
        if older is not None:
            following = following - (_value(older, n) - shift) * before
        before, now = now, following / _value(bottom, n)
        series.append(now)
        n += 1
    return series


def _value(polynomial: Polynomial, n: int) -> float:
    second, first, constant = polynomial
    return float((second * n + first) * n + constant)


def _size(x: DoubleDouble) -> float:
    return float(np.abs(x.hi))


def power_series(coefficients: Sequence[DoubleDouble], z: DoubleDouble) -> DoubleDouble:
    """Return the sum of coefficients[n] z^n (Horner's rule).

    Examples
    --------
    >>> from carom.dimensionless.twins.doubledouble import DoubleDouble, power_series
    >>> power_series([DoubleDouble(1.0), DoubleDouble(-2.0)], DoubleDouble(0.25)).hi
    0.5
    """
    total: DoubleDouble = 0.0 * z
    for coefficient in reversed(coefficients):
        total = total * z + coefficient
    return total
