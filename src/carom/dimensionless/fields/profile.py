"""The memory of a contact over its radius as piecewise polynomials: what every field is made of."""

from typing import NamedTuple

import numpy as np

from carom.dimensionless.numerics.arrays import Array, Matrix, Vector
from carom.dimensionless.numerics.chebyshev import nodes, transform
from carom.dimensionless.numerics.kernels import kernel

TERMS = 17  # of a Chebyshev series on a panel
NOTHING = np.zeros((0, TERMS))
MOST_PANELS = 32  # of a marched contact, as stresses see it: to some 1e-3 of the largest


class Profile(NamedTuple):
    """q and g = -dq/ds of a contact at an instant, on panels between radii x = sqrt(s).

    `edges` has shape (n + 1,) and runs from 0 to the contact radius; rows of `q` and `g`, shape
    (n, TERMS), are Chebyshev coefficients on a panel mapped to [-1, 1]. `rim` is q at the edge,
    where it ends with a jump. `n` is -dN/ds of what presses, one where there is none: Hertz's.
    """

    edges: Vector
    q: Matrix
    g: Matrix
    rim: float = 0.0
    n: Matrix = NOTHING


@kernel
def is_constant(coefficients: Array) -> bool:
    """Tell whether a series has no term but the first, as where slip or a straight step laid it."""
    return not np.any(coefficients[1:])


def borne(profile: Profile, places: Array) -> Array:
    """Return what springs bear in compression at radii within the contact, over the edge's."""
    squares = profile.edges**2
    if len(profile.n) == 0:
        return np.asarray(squares[-1] - places**2)
    falls = np.cumsum(profile.n[:, 0] * np.diff(squares))
    return np.asarray(np.interp(places**2, squares, falls[-1] - np.append(0.0, falls)))


def thinned(profile: Profile) -> Profile:
    """Return the profile of a marched contact on fewer panels, for what lies below the surface."""
    panels = len(profile.n)
    if panels <= MOST_PANELS:
        return profile
    knots = np.append(np.arange(0, panels, -(-panels // MOST_PANELS)), panels)
    squares, (g, n) = profile.edges**2, np.zeros((2, knots.size - 1, TERMS))
    for slopes, whole in ((g, profile.g), (n, profile.n)):
        sums = np.append(0.0, np.cumsum(whole[:, 0] * np.diff(squares)))
        slopes[:, 0] = np.diff(sums[knots]) / np.diff(squares[knots])
    return Profile(profile.edges[knots], np.zeros(g.shape), g, profile.rim, n)


def radii(low: float, high: float) -> Array:
    """Return the radii of a panel at which `coefficients` wants its values."""
    return 0.5 * (low + high) + 0.5 * (high - low) * nodes(TERMS)


def coefficients(values: Array) -> Array:
    """Return the Chebyshev coefficients of a panel from the values at `radii`."""
    return np.asarray(transform(TERMS) @ values, dtype=np.float64)


def flat(low: float, high: float, g: float, q_high: float) -> tuple[Array, Array]:
    """Return the rows of q and g of a panel on which g is constant."""
    row = np.zeros(TERMS)
    row[0] = g
    return coefficients(q_high + g * (high**2 - radii(low, high) ** 2)), row


def stacked(edges: list[float], rows: list[tuple[Array, Array]], rim: float = 0.0) -> Profile:
    """Return the profile made of panels, given their outer edges in order, and of q at the edge."""
    if not rows:
        return Profile(np.zeros(1), np.zeros((0, TERMS)), np.zeros((0, TERMS)), 0.0)
    q, g = zip(*rows, strict=True)
    return Profile(np.array([0.0, *edges]), np.array(q), np.array(g), float(rim))
