"""The memory of a contact at one instant, ready to be asked."""

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from carom.dimensionless.elastic import dense_output as dense
from carom.dimensionless.elastic.memory import MADE, OUTER, SLIP_SIGN
from carom.dimensionless.elastic.motion import STICK, B
from carom.dimensionless.elastic.phases import RETRACED
from carom.dimensionless.elastic.record import MODE, SIGN, STRETCH, Record
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


@dataclass(frozen=True, eq=False)
class Memory:
    """The memory of a contact at one instant, from which every traction follows.

    g = -dq/ds, |g| <= 1, is the paper's function in (6); q(s) is the density of the transformed
    traction, |q| <= d - s; s = r^2/(R* d_max).
    """

    time: float
    penetration: float
    displacement: float
    annuli: tuple[Annulus, ...]
    _record: Record = field(repr=False)
    _moved: Array = field(repr=False)
    _scale: float = field(repr=False)

    def g(self, s: ArrayLike) -> Array:
        """Return g at the given s >= 0, zero outside the contact."""
        return self._read(s)[0]

    def q(self, s: ArrayLike) -> Array:
        """Return q at the given s >= 0, zero outside the contact."""
        return self._read(s)[1]

    def profile(self) -> Profile:
        """Return g and q as piecewise polynomials over the radius, to rounding."""
        edges: list[float] = []
        rows: list[tuple[Array, Array]] = []
        for annulus in self.annuli:
            for outer, row in self._panels(annulus, annulus.inner, annulus.outer):
                edges.append(outer)
                rows.append(row)
        return stacked(edges, rows)

    def _panels(
        self, annulus: Annulus, low: float, high: float
    ) -> Iterator[tuple[float, tuple[Array, Array]]]:
        """Yield the outer edges and rows of as many panels as an annulus needs."""
        g, q = self._inside(annulus, radii(low, high))
        series = coefficients(g)
        tail = np.max(np.abs(series[-3:])) * np.sqrt(high - low)
        if annulus.sign or tail <= RESOLVED or high - low <= NARROW:
            yield high, (coefficients(q), series)
            return
        middle = 0.5 * (low + high)
        yield from self._panels(annulus, low, middle)
        yield from self._panels(annulus, middle, high)

    def _read(self, s: ArrayLike) -> tuple[Array, Array]:
        places = np.asarray(s, dtype=np.float64)
        g, q = np.zeros(places.shape), np.zeros(places.shape)
        for annulus in reversed(self.annuli):  # a border belongs to the inner one
            here = (places >= annulus.inner**2) & (places <= annulus.outer**2 * (1.0 + RIM))
            g[here], q[here] = self._inside(annulus, np.sqrt(places[here]))
        return g, q

    def _inside(self, annulus: Annulus, x: Array) -> tuple[Array, Array]:
        """Return g and q at radii of an annulus."""
        if annulus.sign:
            sign = annulus.sign * abs(self._scale)
            return np.full(x.shape, sign), self.displacement + sign * (annulus.limit - x * x)
        record, laid = self._record, np.empty((x.size, 2))
        dense.loading_states(record.nodes, record.series, self._moved, x, laid)
        return self._scale * laid[:, 0], self.displacement - self._scale * laid[:, 1]


def memory_at(
    record: Record, times: Array, moved: Array, now: dict[str, float], scale: float
) -> Memory:
    """Return the memory at the instant that `now` describes; `scale` is as in `Solution`."""
    d, edge, front = now["penetration"], now["contact_radius"], now["stick_radius"]
    step = int(np.searchsorted(times, now["time"], side="right")) - 1
    node, mirror = record.nodes[step], -1 if scale < 0.0 else 1
    stretch = int(node[STRETCH])
    annuli, inner = [], 0.0
    for row in record.stacks[stretch, : record.depths[stretch]]:
        outer, sign = min(float(row[OUTER]), front), mirror * int(row[SLIP_SIGN])
        if outer > inner:
            annuli.append(Annulus(inner, outer, sign, _limit(record, moved, row)))
            inner = outer
    if edge > inner:
        sign = int(node[SIGN])
        limit = d - sign * now["displacement"] / scale
        sticks = node[MODE] in (STICK, RETRACED)
        annuli.append(Annulus(inner, edge, *((0, np.nan) if sticks else (mirror * sign, limit))))
    return Memory(now["time"], d, now["displacement"], tuple(annuli), record, moved, scale)


def _limit(record: Record, moved: Array, row: Array) -> float:
    """Return l = d - sigma U when slip made the annulus."""
    made = int(row[MADE])
    if row[SLIP_SIGN] == 0.0 or made >= len(record.series):
        return np.nan
    return float(record.series[made, 0, B] ** 2 - row[SLIP_SIGN] * moved[made, 0])
