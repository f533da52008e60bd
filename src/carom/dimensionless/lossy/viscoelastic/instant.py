"""The contact of a viscoelastic impact at an instant, read off when it has been run up to there."""

from collections.abc import Callable, Iterator
from functools import lru_cache, partial
from typing import NamedTuple

import numpy as np

from carom.dimensionless.fields.profile import Profile, Read, piecewise, stacked
from carom.dimensionless.lossy.layout import NUMBERS
from carom.dimensionless.lossy.viscoelastic import contact, work as at
from carom.dimensionless.lossy.viscoelastic.contact import FLAT, Mode, row_of
from carom.dimensionless.lossy.viscoelastic.impacts import TOLERANCE, Solid, run
from carom.dimensionless.lossy.viscoelastic.record import new_record
from carom.dimensionless.lossy.viscoelastic.work import NODES, new_work, place
from carom.dimensionless.numerics.arrays import Array

OF_SLOPE = np.polynomial.chebyshev.chebder(np.eye(NODES))  # of a series on a panel
REPLAYS_KEPT = 64  # that are kept
SERIES_TOLERANCE, NARROWEST_PANEL = 1e-10, 1e-6  # of a series on a panel


class Stretch(NamedTuple):
    """Part of a contact between two radii, and what is read there: c in stick, h in slip."""

    inner: float
    outer: float
    sign: int
    read: Read


class Replay:
    """An impact, psi_1 > 0, run again up to a panel, which is left as it was solved."""

    def __init__(self, psi: float, chi: float, alpha: float, number: int) -> None:
        work, numbers, record = new_work(), np.zeros(NUMBERS), new_record(False)
        self.alpha, self.number = alpha, number
        _, self.pieces = run(psi, Solid(chi, alpha, TOLERANCE), number, work, numbers, record)
        self.work = work._replace(
            series=work.series[: number + 1].copy(),
            pieces=work.pieces[: self.pieces].copy(),
            passed=work.passed[: int(work.ring[at.DEPTH])].copy(),
        )


replay = lru_cache(REPLAYS_KEPT)(Replay)


class Instant:
    """The contact of an impact at a place of the panel up to which it was run again.

    Springs that stick bear f = T + c(s) at the deflection u = U + c(s), those that slip with sign
    sigma bear sigma (D - s) at sigma (d - s - alpha h).
    """

    def __init__(self, panel: "Replay", x: float) -> None:
        self.alpha, self.number, self.work, self.x = panel.alpha, panel.number, panel.work, x
        number = panel.number
        self.radius, self.speed, self.moved, self.psi, self.time, front = (
            float(self._at(number, row, x))
            for row in (at.RADIUS, at.SPEED, at.MOVED, at.PSI, at.TIME, at.FRONT)
        )
        ring = self.work.ring
        self.mode, self.sign = int(ring[at.MODE]), int(ring[at.RING_SIGN])
        self.radius, self.front = max(self.radius, 0.0), float(np.sqrt(max(front, 0.0)))
        loading = self.speed > 0.0
        self.shift = self.alpha * self.speed if loading else 0.0  # D - b^2
        self.depth = self.radius**2 - (0.0 if loading else self.alpha * self.speed)
        self.stuck = self.radius if self.sign == 0 else min(self.front, self.radius)
        self.stretches = (*self._sticking(panel.pieces), *self._slipping())

    def forces(self) -> Profile:
        """Return f and -df/ds: what tractions come from."""
        limit = self.radius**2 + self.shift
        tension = self.moved + self.alpha * self.psi

        def read(part: Stretch, r: Array) -> tuple[Array, Array]:
            if part.sign:
                return part.sign * (limit - r * r), np.full(r.shape, float(part.sign))
            c, slope = part.read(r)
            return tension + c, -slope

        return self._profile(read, self.edge_force)

    @property
    def edge_force(self) -> float:
        """What the spring at the edge bears: none while unloading."""
        if self.mode == Mode.STICKS:
            return self.alpha * self.psi
        if self.mode == Mode.RETRACES:
            return float(self.work.ring[at.RATIO]) * self.shift
        return self.sign * self.shift

    def lags(self) -> Profile:
        """Return U - u and its slope: how far springs lag behind, from which slip follows."""

        def read(part: Stretch, r: Array) -> tuple[Array, Array]:
            value, slope = part.read(r)
            if not part.sign:
                return -value, slope
            u = part.sign * (self.depth - r * r - self.alpha * value)
            return self.moved - u, -part.sign * (1.0 + self.alpha * slope)

        return self._profile(read, 0.0)

    def rates(self) -> tuple[float, Profile]:
        """Return the slip rate of springs just outside the front, and its change outwards."""
        slipping = [part for part in self.stretches if part.sign]
        if not slipping:
            return 0.0, stacked([], [])
        excess = self.sign * self.psi - self.speed
        first = float(slipping[0].read(np.array([slipping[0].inner]))[0][0])

        def read(part: Stretch, r: Array) -> tuple[Array, Array]:
            if not part.sign:
                return np.zeros(r.shape), np.zeros(r.shape)
            h, slope = part.read(r)
            return self.sign * (first - h), self.sign * slope

        return self.sign * (excess - first), self._profile(read, 0.0)

    def _profile(
        self, read: Callable[[Stretch, Array], tuple[Array, Array]], rim: float
    ) -> Profile:
        """Return a profile of values and minus their slopes."""
        stretches = [
            (partial(read, it), it.inner, it.outer, SERIES_TOLERANCE) for it in self.stretches
        ]
        return piecewise(stretches, NARROWEST_PANEL, rim)

    def _at(self, panel: int, row: int, x: Array | float) -> Array:
        return np.asarray(_terms(x) @ self.work.series[panel, row])

    def _slope(self, panel: int, row: int, x: Array) -> Array:
        return np.asarray(_terms(x)[..., :-1] @ (OF_SLOPE @ self.work.series[panel, row]))

    def _place(self, panel: int, row: int, levels: Array, x0: float, x1: float) -> Array:
        """Return where a monotone row passes levels between two places."""
        series = self.work.series
        return np.array([place(series, panel, row, level, x0, x1) for level in levels.tolist()])

    def _sticking(self, count: int) -> Iterator[Stretch]:
        """Yield the pieces that stick, from the centre outwards."""
        if self.mode == Mode.RETRACES:
            yield Stretch(0.0, self.radius, 0, self._retraced)
            return
        for row in self.work.pieces[:count].copy():
            inner, outer = float(row[at.R0]), min(float(row[at.R1]), self.stuck)
            if outer > inner:
                yield Stretch(inner, outer, 0, self._piece(row))
        if self.mode in (Mode.STICKS, Mode.RETURNS):
            inner = float(self.work.values[at.LAID_RADIUS, 0])
            row = np.zeros(self.work.pieces.shape[1])
            row[[at.SIGN, at.PANEL, at.X0, at.X1]] = self.sign, self.number, -1.0, self.x
            if self.stuck > inner:
                yield Stretch(inner, self.stuck, 0, self._piece(row))

    def _piece(self, row: Array) -> Read:
        """Return what reads c on a piece, and its slope in s."""
        sign, n = int(row[at.SIGN]), int(row[at.PANEL])

        def laid(r: Array) -> tuple[Array, Array]:
            x = self._place(n, at.LAID_RADIUS, r, row[at.X0], row[at.X1])
            v = np.maximum(self._at(n, at.SPEED, x), 1e-300)
            return -self._at(n, at.MOVED, x), -np.clip(self._at(n, at.PSI, x) / v, -1.0, 1.0)

        def left(r: Array) -> tuple[Array, Array]:
            x = self._place(n, at.LAID_RADIUS, r, row[at.X0], row[at.X1])
            level, rate = self._at(n, row_of(sign), x), self._slope(n, row_of(sign), x)
            rise = rate / np.maximum(2.0 * r * self._slope(n, at.LAID_RADIUS, x), 1e-300)
            return sign * (level - r * r), sign * (np.clip(rise, 0.0, 2.0) - 1.0)

        def flat(r: Array) -> tuple[Array, Array]:
            level = row[at.A0] if sign > 0 else 2.0 * row[at.R0] ** 2 - row[at.A0]
            return sign * (level - r * r), np.full(r.shape, -float(sign))

        if row[at.PANEL] == FLAT:
            return flat
        return left if sign else laid

    def _retraced(self, r: Array) -> tuple[Array, Array]:
        ratio = float(self.work.ring[at.RATIO])
        return ratio * (self.depth - r * r) - self.moved, np.full(r.shape, -ratio)

    def _slipping(self) -> Iterator[Stretch]:
        """Yield the parts of the ring, from the front outwards."""
        if self.sign == 0:
            return
        inner = self.stuck
        depth = int(self.work.ring[at.DEPTH])
        entries = [(row, float(row[contact.X_INNER])) for row in self.work.passed[:depth].copy()]
        if self.mode == Mode.RETREATS:
            row = np.zeros(self.work.passed.shape[1])
            row[[contact.PASSED_PANEL, contact.X_OUTER]] = self.number, -1.0
            row[contact.R_OUTER] = np.sqrt(self.work.values[at.FRONT, 0])
            entries.append((row, self.x))
        for row, x_inner in reversed(entries):
            outer = min(float(row[contact.R_OUTER]), self.radius)
            if outer > inner:
                yield Stretch(inner, outer, self.sign, self._left(row, x_inner))
                inner = outer
        if self.radius > inner:
            yield Stretch(inner, self.radius, self.sign, _nothing)

    def _left(self, row: Array, x_inner: float) -> Read:
        """Return what reads h on an entry of the stack, and its slope in s."""
        n, alpha = int(row[contact.PASSED_PANEL]), self.alpha

        def read(r: Array) -> tuple[Array, Array]:
            if row[contact.PASSED_PANEL] == contact.AT_ONCE:
                h = row[contact.EXCESS] * np.exp((row[contact.INSTANT] - self.time) / alpha)
                return np.full(r.shape, h), np.zeros(r.shape)
            x = self._place(n, at.FRONT, r * r, row[contact.X_OUTER], x_inner)
            decay = np.exp((self._at(n, at.TIME, x) - self.time) / alpha)
            excess = self.sign * self._at(n, at.PSI, x) - self._at(n, at.SPEED, x)
            change = self.sign * self._slope(n, at.PSI, x) - self._slope(n, at.SPEED, x)
            change += excess * self._slope(n, at.TIME, x) / alpha
            return excess * decay, change * decay / self._slope(n, at.FRONT, x)

        return read


def _terms(x: Array | float) -> Array:
    """Return the Chebyshev polynomials at places of a panel, shape (..., NODES)."""
    return np.asarray(np.cos(np.multiply.outer(np.arccos(x), np.arange(NODES))))


def _nothing(r: Array) -> tuple[Array, Array]:
    return np.zeros(r.shape), np.zeros(r.shape)
