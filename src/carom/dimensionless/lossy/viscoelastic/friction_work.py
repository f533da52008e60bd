"""The work of friction per area of a viscoelastic contact, over a whole impact.

At each instant it is the pressure, sqrt(b^2 - r^2) and what its density at the edge adds, times
the slip rate: that of a punch outside the front, and what springs lag behind besides, which is
tabulated on each panel of time. The integral over a panel goes from where the front or the edge
passes r to where the edge leaves it, in y = sin^2(phi), which removes the roots at both ends.
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from carom.dimensionless.elastic.phases import Kind
from carom.dimensionless.fields.surface import displaced
from carom.dimensionless.lossy import layout
from carom.dimensionless.lossy.viscoelastic.instant import Instant, Replay
from carom.dimensionless.lossy.viscoelastic.record import Trace
from carom.dimensionless.lossy.viscoelastic.work import TO_SERIES, place
from carom.dimensionless.numerics.arrays import Array
from carom.dimensionless.numerics.chebyshev import nodes, transform

IN_TIME, IN_RING = 12, 12  # terms of the tabulated slip rate: over a panel of time, across the ring
EDGE_ROUNDING = 1e-13  # b^2 - r^2 next to the edge, where rounding would decide
ALIKE_RADII = 1e-9  # radii nearer to each other are one
chebyshev = np.polynomial.chebyshev


def _graded() -> tuple[Array, Array]:
    """Return places y in (0, 1) and weights, on panels that shrink towards both ends."""
    x, weights = np.polynomial.legendre.leggauss(8)
    ends = np.append(0.0, 0.25 * np.pi * 0.25 ** np.arange(3.0, -1.0, -1.0))
    half, middle = 0.5 * np.diff(ends)[:, np.newaxis], 0.5 * (ends[1:] + ends[:-1])[:, np.newaxis]
    phi = (middle + half * x).ravel()
    y = np.sin(phi) ** 2
    weight = (half * weights).ravel() * np.sin(2.0 * phi)
    return np.concatenate((y, 1.0 - y[::-1])), np.concatenate((weight, weight[::-1]))


PLACES, WEIGHTS = _graded()


class Panel(NamedTuple):
    """What is known on a panel of time, as Chebyshev series: radii of edge and front, and more."""

    series: Array  # of all rows of the record
    kind: int
    sign: int
    loss: float

    def at(self, row: int, x: Array) -> Array:
        return np.asarray(chebyshev.chebval(x, self.series[row]))

    def window(self, radii: Array, *, all_of_it: bool) -> tuple[Array, Array]:
        """Return from where to where radii are in the slip ring, or anywhere in the contact."""
        low, high = -np.ones(radii.size), np.ones(radii.size)
        followed = [(layout.AT_B, 1.0)]
        if self.kind == Kind.SLIP and not all_of_it:
            followed.append((layout.AT_STUCK, -1.0))
        for row, side in followed:
            first, last = self.at(row, np.array([-1.0, 1.0]))
            if abs(last - first) <= ALIKE_RADII:
                high[side * (last - radii) <= 0.0] = -1.0
                continue
            table = self.series[np.newaxis]
            places = np.array([place(table, 0, row, r, -1.0, 1.0) for r in radii.tolist()])
            enters = side * (last - first) > 0.0
            if enters:
                low = np.maximum(low, places)
            else:
                high = np.minimum(high, places)
        return low, np.maximum(low, high)

    def pressure(self, x: Array, radii: Array) -> Array:
        edge, speed = self.at(layout.AT_B, x), self.at(layout.AT_V, x)
        root = np.sqrt(np.maximum((edge - radii) * (edge + radii), EDGE_ROUNDING))
        return np.asarray(root + 0.5 * self.loss * np.maximum(speed, 0.0) / root)

    def slip_rate(self, replay: Replay) -> Callable[[Array, Array], tuple[Array, Array]]:
        """Return what tells the radial functions of the slip rate at places and radii."""
        instants = [Instant(replay, float(x)) for x in nodes(IN_TIME)]
        rates = [instant.rates() for instant in instants]
        rate = transform(IN_TIME) @ np.array([each for each, _ in rates])
        across = 0.5 * (1.0 + nodes(IN_RING))
        rest = np.array(
            [
                displaced(change, at.stuck + (at.radius - at.stuck) * _ring(across))
                for at, (_, change) in zip(instants, rates, strict=True)
            ]
        )
        table = np.einsum("im,mkc,jk->ijc", transform(IN_TIME), rest, transform(IN_RING))

        def read(x: Array, radii: Array) -> tuple[Array, Array]:
            front = self.at(layout.AT_STUCK, x) if self.kind == Kind.SLIP else np.zeros(x.shape)
            root = np.sqrt(np.maximum((radii - front) * (radii + front), 0.0))
            part = (radii - front) / (self.at(layout.AT_B, x) - front)
            phi = np.arcsin(np.sqrt(np.clip(part, 0.0, 1.0)))
            in_time = chebyshev.chebvander(x, IN_TIME - 1)
            in_ring = chebyshev.chebvander(4.0 / np.pi * phi - 1.0, IN_RING - 1)
            besides = np.einsum("...i,...j,ijc->c...", in_time, in_ring, table, optimize=True)
            speed = 2.0 / np.pi * chebyshev.chebval(x, rate)
            mean = speed * np.arctan2(root + (front == 0.0), front) + besides[0]
            turned = speed * front * root / np.maximum(radii, ALIKE_RADII) ** 2 + besides[1]
            return mean, turned

        return read


def _ring(across: Array) -> Array:
    """Return places in the ring, 0 at the front and 1 at the edge, of those by angle."""
    return np.asarray(np.sin(0.5 * np.pi * across) ** 2)


def work(record: Trace, replay: Callable[[int], Replay], loss: float, radii: Array) -> Array:
    """Return the radial functions of the work of friction per area, shape (n, 2)."""
    total = np.zeros((radii.size, 2))
    for number, panel in enumerate(_panels(record, loss)):
        if panel.kind == Kind.STICK:
            continue
        low, high = panel.window(radii, all_of_it=False)
        inside = high > low
        if not inside.any():
            continue
        x, dt = _times(panel, low[inside], high[inside])
        r = radii[inside, np.newaxis]
        power = panel.sign * dt * panel.pressure(x, r)
        for column, rate in enumerate(panel.slip_rate(replay(number))(x, r)):
            total[inside, column] += (power * rate).sum(axis=1)
    return total


def pressed(record: Trace, loss: float, radii: Array) -> Array:
    """Return the integral of the pressure over the time of the impact."""
    total = np.zeros(radii.size)
    for panel in _panels(record, loss):
        low, high = panel.window(radii, all_of_it=True)
        x, dt = _times(panel, low, high)
        total += (dt * panel.pressure(x, radii[:, np.newaxis])).sum(axis=1)
    return total


def borders(record: Trace) -> Array:
    """Return radii between which the work is smooth: of edge and front where panels end."""
    ends = record.rows[:, [layout.AT_B, layout.AT_STUCK]][:, :, [0, -1]]
    radii = np.unique(np.clip(ends, 0.0, None))
    radii = np.append(0.0, radii[radii > ALIKE_RADII])
    return np.asarray(radii[np.append(np.diff(radii) > ALIKE_RADII, True)])


def _panels(record: Trace, loss: float) -> list[Panel]:
    series = np.ascontiguousarray(record.rows @ TO_SERIES.T)
    kinds = record.kinds.tolist()
    return [Panel(each, kind, sign, loss) for each, (kind, sign) in zip(series, kinds, strict=True)]


def _times(panel: Panel, low: Array, high: Array) -> tuple[Array, Array]:
    """Return the places at which integrals over time are summed, and their weights as times."""
    x = low[:, np.newaxis] + (high - low)[:, np.newaxis] * PLACES
    pace = chebyshev.chebval(x, chebyshev.chebder(panel.series[layout.AT_TIME]))
    return x, (high - low)[:, np.newaxis] * WEIGHTS * pace
