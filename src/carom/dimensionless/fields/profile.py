"""The memory of a contact at one instant, over its radius: what every field is made of."""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, field
from functools import partial
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from carom.dimensionless.numerics.arrays import Array, Matrix, Vector
from carom.dimensionless.numerics.chebyshev import nodes, transform
from carom.dimensionless.numerics.kernels import kernel

TERMS = 17  # of a Chebyshev series on a panel
NO_PANELS = np.zeros((0, TERMS))
MOST_PANELS = 32  # of a marched contact, as stresses see it: to some 1e-3 of the largest
ROUNDING_OF_S = 4e-16  # relative, at the edge
RESOLVED = 1e-14  # of g on a panel, times the root of its width: what tractions feel
NARROWEST_PANEL = 1e-7

Read = Callable[[Array], tuple[Array, Array]]  # q and g at radii
Stretch = tuple[Read, float, float, float]  # what reads it, from and to which radius, its error


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
    n: Matrix = NO_PANELS


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
        return Profile(np.zeros(1), NO_PANELS, NO_PANELS)
    q, g = zip(*rows, strict=True)
    return Profile(np.array([0.0, *edges]), np.array(q), np.array(g), float(rim))


def piecewise(stretches: Iterable[Stretch], narrowest: float, rim: float) -> Profile:
    """Return the profile of stretches from the centre outwards, and of q at the edge."""
    panels = [panel for each in stretches for panel in _panels_of(*each, narrowest)]
    return stacked([edge for edge, _ in panels], [rows for _, rows in panels], rim)


def _panels_of(
    read: Read, low: float, high: float, error: float, narrowest: float
) -> Iterator[tuple[float, tuple[Array, Array]]]:
    """Yield the outer edges and rows of as many panels as a stretch needs."""
    q, g = read(radii(low, high))
    series = coefficients(g)
    tail = np.max(np.abs(series[-3:])) * np.sqrt(high - low)
    if tail <= error or high - low <= narrowest:
        yield high, (coefficients(q), series)
        return
    middle = 0.5 * (low + high)
    yield from _panels_of(read, low, middle, error, narrowest)
    yield from _panels_of(read, middle, high, error, narrowest)


class Annulus(NamedTuple):
    """Part of a contact, `inner` to `outer`: laid in stick, sign 0, or at its limit by slip."""

    inner: float
    outer: float
    sign: int
    limit: float


@dataclass(frozen=True, eq=False)
class Memory:
    """The memory of a contact at one instant, its annuli, from which every traction follows.

    g = -dq/ds, |g| <= 1, is the paper's function in (6); q(s) is the density of the transformed
    traction, |q| <= d - s; s = r^2/(R* d_max). `rim` is q at the edge: zero but for bodies that
    are viscous, while loading.
    """

    time: float
    penetration: float
    displacement: float
    annuli: tuple[Annulus, ...]
    _inside: Callable[[Annulus, Array], tuple[Array, Array]] = field(repr=False)  # q, g
    rim: float = 0.0

    def g(self, s: ArrayLike) -> Array:
        """Return g at the given s >= 0, zero outside the contact."""
        return self._read(s)[1]

    def q(self, s: ArrayLike) -> Array:
        """Return q at the given s >= 0, zero outside the contact."""
        return self._read(s)[0]

    def profile(self, error: float = RESOLVED) -> Profile:
        """Return g and q as piecewise polynomials over the radius, by default to rounding."""
        stretches = [
            (partial(self._inside, each), each.inner, each.outer, np.inf if each.sign else error)
            for each in self.annuli
        ]
        return piecewise(stretches, NARROWEST_PANEL, self.rim)

    def _read(self, s: ArrayLike) -> tuple[Array, Array]:
        places = np.asarray(s, dtype=np.float64)
        q, g = np.zeros(places.shape), np.zeros(places.shape)
        for annulus in reversed(self.annuli):  # a border belongs to the inner one
            here = (places >= annulus.inner**2) & (
                places <= annulus.outer**2 * (1.0 + ROUNDING_OF_S)
            )
            q[here], g[here] = self._inside(annulus, np.sqrt(places[here]))
        return q, g
