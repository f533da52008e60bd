"""Power series as lists of coefficients: products, shifts and roots that cannot be missed."""

from __future__ import annotations

from itertools import pairwise

from mpmath import mp, mpf

Series = list[mpf]


def term(x: Series, y: Series, k: int) -> mpf:
    """Coefficient k of the product of two series."""
    return mp.fdot(x[: k + 1], y[k::-1])


def product(x: Series, y: Series, order: int) -> Series:
    """Product of two series, to the given order."""
    x, y = (z[: order + 1] + [mpf(0)] * (order + 1 - len(z)) for z in (x, y))
    return [term(x, y, k) for k in range(order + 1)]


def shifted(series: Series, by: mpf) -> Series:
    """The same polynomial in powers of the distance from the point `by`."""
    out = list(series)
    for i in range(len(out) - 1):
        for j in range(len(out) - 2, i - 1, -1):
            out[j] += by * out[j + 1]
    return out


def next_root_term(root: Series, square: Series) -> mpf:
    """The next coefficient of the square root of a series that starts with 1."""
    k = len(root)
    return (square[k] - mp.fdot(root[1:k], root[k - 1 : 0 : -1])) / 2 if k else mpf(1)


def bernstein(series: Series) -> Series:
    """Bernstein coefficients on [0, 1]: their sign changes bound the number of roots."""
    n = len(series) - 1
    out = [c / mp.binomial(n, j) for j, c in enumerate(series)]
    for i in range(1, n + 1):
        for j in range(n, i - 1, -1):
            out[j] += out[j - 1]
    return out


def halves(control: Series) -> tuple[Series, Series]:
    """Bernstein coefficients on the two halves of the interval."""
    left, right, row = [control[0]], [control[-1]], control
    while len(row) > 1:
        row = [(p + q) / 2 for p, q in pairwise(row)]
        left.append(row[0])
        right.append(row[-1])
    return left, right[::-1]


def polished(series: Series, low: mpf, high: mpf) -> mpf:
    """The one root of a polynomial, positive at `low` and negative at `high`, by Newton's method
    in a bracket.
    """
    falling, x = series[::-1], (low + high) / 2
    for _ in range(400):
        value, slope = mp.polyval(falling, x, derivative=True)
        low, high = (x, high) if value > 0 else (low, x)
        guess = x - value / slope if slope else low
        guess = guess if low < guess < high else (low + high) / 2
        if abs(guess - x) <= 4 * mp.eps * abs(x):
            return guess
        x = guess
    return x


def first_root(series: Series, length: mpf, fresh: bool) -> mpf | None:
    """The first root in (0, length] of a polynomial that is positive at 0+; a root at 0 itself is
    left out if fresh.
    """
    scaled = [c * length**j for j, c in enumerate(series)]
    noise = max(mpf(1), *map(abs, scaled)) * mpf(10) ** (
        12 - mp.dps
    )  # all quantities are of order one
    while fresh and abs(scaled[0]) < noise:
        scaled.pop(0)
    if scaled[0] <= 0:
        raise ArithmeticError("an event lies before the start of its phase")
    parts = [(mpf(0), mpf(1), bernstein(scaled))]
    while parts:
        low, high, control = parts.pop()
        changes = sum((p > 0) != (q > 0) for p, q in pairwise(control))
        if changes == 1:
            return length * polished(scaled, low, high)
        if changes:
            if high - low < mpf(2) ** -80:
                raise ArithmeticError("a double root: an event that grazes")
            left, right = halves(control)
            parts += [((low + high) / 2, high, right), (low, (low + high) / 2, left)]
    return None
