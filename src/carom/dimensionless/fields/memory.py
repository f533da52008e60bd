"""The memory of a contact at one instant, ready to be asked."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from carom.dimensionless.fields.profile import Profile, coefficients, radii, stacked
from carom.dimensionless.numerics.arrays import Array

RIM = 4e-16  # relative: what rounding may add to s at the edge
RESOLVED = 1e-14  # of g on a panel, times the root of its width: what tractions feel
NARROW = 1e-7


class Annulus(NamedTuple):
    """Part of a contact: laid in stick (sign 0), or brought to its limit by slip of one sign."""

    inner: float
    outer: float
    sign: int
    limit: float


Reader = Callable[[Annulus, Array], tuple[Array, Array]]  # g and q at radii of an annulus


@dataclass(frozen=True, eq=False)
class Memory:
    """The memory of a contact at one instant, from which every traction follows.

    g = -dq/ds, |g| <= 1, is the paper's function in (6); q(s) is the density of the transformed
    traction, |q| <= d - s; s = r^2/(R* d_max). `rim` is q at the edge: zero but for bodies that
    are viscous, while loading.
    """

    time: float
    penetration: float
    displacement: float
    annuli: tuple[Annulus, ...]
    _inside: Reader = field(repr=False)
    rim: float = 0.0

    def g(self, s: ArrayLike) -> Array:
        """Return g at the given s >= 0, zero outside the contact."""
        return self._read(s)[0]

    def q(self, s: ArrayLike) -> Array:
        """Return q at the given s >= 0, zero outside the contact."""
        return self._read(s)[1]

    def profile(self, error: float = RESOLVED) -> Profile:
        """Return g and q as piecewise polynomials over the radius, by default to rounding."""
        edges: list[float] = []
        rows: list[tuple[Array, Array]] = []
        for annulus in self.annuli:
            for outer, row in self._panels(annulus, annulus.inner, annulus.outer, error):
                edges.append(outer)
                rows.append(row)
        return stacked(edges, rows, self.rim)

    def _panels(
        self, annulus: Annulus, low: float, high: float, error: float
    ) -> Iterator[tuple[float, tuple[Array, Array]]]:
        """Yield the outer edges and rows of as many panels as an annulus needs."""
        g, q = self._inside(annulus, radii(low, high))
        series = coefficients(g)
        tail = np.max(np.abs(series[-3:])) * np.sqrt(high - low)
        if annulus.sign or tail <= error or high - low <= NARROW:
            yield high, (coefficients(q), series)
            return
        middle = 0.5 * (low + high)
        yield from self._panels(annulus, low, middle, error)
        yield from self._panels(annulus, middle, high, error)

    def _read(self, s: ArrayLike) -> tuple[Array, Array]:
        places = np.asarray(s, dtype=np.float64)
        g, q = np.zeros(places.shape), np.zeros(places.shape)
        for annulus in reversed(self.annuli):  # a border belongs to the inner one
            here = (places >= annulus.inner**2) & (places <= annulus.outer**2 * (1.0 + RIM))
            g[here], q[here] = self._inside(annulus, np.sqrt(places[here]))
        return g, q
