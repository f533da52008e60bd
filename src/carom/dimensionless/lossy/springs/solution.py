"""One marched impact, and what its springs did: pressure, traction and slip over the contact.

What springs bear is linear in x^2 between them and zero at the edge, so that pressure and traction
are those of slices of constant slope. By how much the surface is behind the bodies follows likewise
from the springs' deflection; a point has slid by what that has grown since it was touched.
"""

from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import cached_property
from itertools import groupby, pairwise
from typing import TYPE_CHECKING

import numpy as np

from carom.dimensionless.elastic.phases import Kind, Status
from carom.dimensionless.fields import surface
from carom.dimensionless.fields.profile import TERMS, Profile, stacked
from carom.dimensionless.lossy import layout
from carom.dimensionless.lossy.law import LARGEST_PSI, LossNumbers
from carom.dimensionless.lossy.solution import LossySolution, outcome, phases_of
from carom.dimensionless.lossy.springs import march
from carom.dimensionless.lossy.springs.motion import Inertia, Solid, made_of
from carom.dimensionless.lossy.springs.springs import X
from carom.dimensionless.numerics.arrays import Array
from carom.dimensionless.states import ContactState, Phase

if TYPE_CHECKING:
    from scipy.interpolate import PchipInterpolator

SPRINGS = 200
STEPS_SUMMED = 2  # steps to one of which the work of friction is a sum
SHORTEST_PHASE = 10.0  # in steps


class Frames:
    """The springs of an impact after each step."""

    def __init__(self, psi: float, across: float, inertia: Inertia, solid: Solid) -> None:
        impact, most = (psi, across, inertia, solid, SPRINGS), SPRINGS + march.SPARE_SPRINGS
        trial = march.new_work()
        steps = march.trace(*impact, trial, march.new_work(march.LONGEST))
        kept = march.new_work(steps, most)
        march.trace(*impact, trial, kept)
        self.places = kept.springs[X, :most]
        self.times, self.edges = kept.rows[:, layout.AT_TIME], kept.rows[:, layout.AT_B]
        self.moved, self.psi = kept.rows[:, layout.AT_U], kept.rows[:, layout.AT_PSI]
        self.springs = kept.frames

    def _before(self, time: float) -> tuple[int, float]:
        """Return the step before a time, and which part of the next is made."""
        i = int(np.clip(np.searchsorted(self.times, time) - 1, 0, self.times.size - 2))
        part = (time - self.times[i]) / (self.times[i + 1] - self.times[i])
        return i, float(np.clip(part, 0.0, 1.0))

    def _mixed(self, values: Array, time: float) -> Array:
        i, part = self._before(time)
        return np.asarray((1.0 - part) * values[i] + part * values[i + 1])

    def edge(self, time: float) -> float:
        return float(np.sqrt(self._mixed(self.edges**2, time)))

    def profile(self, time: float, scale: float = 1.0) -> Profile:
        """Return what springs bear, those in shear times a scale."""
        bears = self._mixed(self.springs, time)
        edge = self.edge(time)
        pressed = self._linear(bears[march.PRESSED], edge, 0.0)
        return self._linear(scale * bears[march.PULLED], edge, 0.0)._replace(n=pressed.g)

    def _linear(self, values: Array, edge: float, at_edge: float) -> Profile:
        """Return a profile that is linear in x^2 between springs, and ends with a value."""
        count = int(np.searchsorted(self.places[: self._laid], edge))
        if count == 0:
            return stacked([], [])
        x, v = np.append(self.places[:count], edge), np.append(values[:count], at_edge)
        slope = -np.diff(v) / np.diff(x**2)
        middle, half = 0.5 * (x[1:] + x[:-1]), 0.5 * np.diff(x)
        q, g = np.zeros((2, count, TERMS))
        g[:, 0] = slope
        q[:, 0] = v[1:] + slope * (x[1:] ** 2 - middle**2 - 0.5 * half**2)
        q[:, 1], q[:, 2] = -2.0 * slope * middle * half, -0.5 * slope * half**2
        return Profile(x, q, g)

    @cached_property
    def _laid(self) -> int:
        return int(np.argmax(self.places))

    def _behind(self, i: int, radii: Array) -> Array:
        """Return the radial functions of how far the surface is behind after a step."""
        lags = self.springs[i, march.LAGGING]
        return surface.displaced(
            self._linear(lags, float(self.edges[i]), float(self.moved[i])), radii
        )

    @cached_property
    def _at_touch(self) -> Array:
        """How far the surface was behind as springs were touched, and at the widest edge."""
        places = np.append(self.places[: self._laid], self.edges.max())
        steps = np.searchsorted(self.edges[: int(np.argmax(self.edges)) + 1], places)
        behind = [self._behind(int(i), np.array([r])) for i, r in zip(steps, places, strict=True)]
        return np.column_stack((places, np.concatenate(behind)))

    def slid(self, time: float, radii: Array) -> Array:
        """Return the radial functions of how far points have slid since they were touched."""
        i, part = self._before(time)
        places, *touched = self._at_touch.T
        since = np.column_stack([np.interp(radii, places, column) for column in touched])
        slip = [self._behind(k, radii) - since for k in (i, i + 1)]
        inside = radii <= self.edge(time)
        return np.asarray(((1.0 - part) * slip[0] + part * slip[1]) * inside[:, np.newaxis])

    def slipping(self, time: float, radii: Array) -> Array:
        """Return the radial functions of the rate of slip."""
        i, part = self._before(time)
        rate = (1.0 - part) * self._slipping(i, radii) + part * self._slipping(i + 1, radii)
        return np.asarray(rate * (radii <= self.edge(time))[:, np.newaxis])

    def _slipping(self, i: int, radii: Array) -> Array:
        """Return the same after a step, by the steps beside it."""
        first, then = max(i - 1, 0), min(i + 1, self.times.size - 1)
        grown = self.springs[then, march.LAGGING] - self.springs[first, march.LAGGING]
        rates = grown / (self.times[then] - self.times[first])
        edge = min(float(self.edges[first]), float(self.edges[then]))
        return surface.displaced(self._linear(rates, edge, float(self.psi[i])), radii)

    @cached_property
    def _sums(self) -> Array:
        """Radii; the work of friction per area there, and the integral of the pressure."""
        places = np.append(self.places[: self._laid], self.edges.max())
        sums = np.column_stack((places, np.zeros((places.size, 3))))
        last = self.times.size - 1
        steps = np.append(np.arange(0, last, STEPS_SUMMED), last)
        before = np.zeros((places.size, 2))
        for first, then in pairwise(steps.tolist()):
            middle = 0.5 * (self.times[first] + self.times[then])
            profile, after = self.profile(middle), self._behind(then, places)
            inside = places < min(self.edges[first], self.edges[then])
            pull, push = np.empty(places.size), np.empty(places.size)
            surface.tractions(profile, places, pull)
            surface.tractions(profile._replace(g=profile.n), places, push)
            sums[:, 1:3] += (inside * pull)[:, np.newaxis] * (after - before)
            sums[:, 3] += push * (self.times[then] - self.times[first])
            before = after
        return sums

    def work(self, radii: Array) -> Array:
        """Return the radial functions of the work of friction per area."""
        places, *works, _ = self._sums.T
        return np.column_stack([np.interp(radii, places, work, right=0.0) for work in works])

    def pressed(self, radii: Array) -> Array:
        """Return the integral of the pressure over the time."""
        return np.asarray(np.interp(radii, self._sums[:, 0], self._sums[:, 3], right=0.0))


@dataclass(frozen=True, eq=False)
class MarchedSolution(LossySolution):
    """An impact marched over springs; see LossySolution.

    States are good to 3e-5, energies and fields to 1e-3 and better. psi_out, extrapolated in the
    number of springs, is closer: `psi_error` estimates its error, by the numbers of two grids.
    """

    psi_error: float
    _rows: Array = field(repr=False)

    def _sampled(self, wanted: Array) -> Array:
        return np.asarray(self._between(np.minimum(wanted, self._rows[-1, layout.AT_TIME])).T)

    @cached_property
    def _between(self) -> "PchipInterpolator":
        from scipy.interpolate import PchipInterpolator  # a third of a second, for these alone

        return PchipInterpolator(self._rows[:, layout.AT_TIME], self._rows[:, : layout.ROWS])

    @cached_property
    def _frames(self) -> Frames:
        """What springs did, of which fields are made."""
        return Frames(self._first, 0.0, Inertia(self.chi), solid_of(self._losses))

    def _contact_at(self, time: float) -> ContactState:
        frames, scale = self._frames, self._scale

        def slid(radii: Array) -> Array:
            slip = frames.slid(time, radii)
            if self._excess:
                inside = radii <= frames.edge(time)
                slip[:, 0] += inside * self._excess * (time - self._touched(radii * inside))
            return scale * slip

        def slipping(radii: Array) -> Array:
            rate = frames.slipping(time, radii)
            rate[:, 0] += self._excess * (radii <= frames.edge(time))
            return scale * rate

        return ContactState(frames.edge(time), 0.0, frames.profile(time, scale), slid, slipping)

    def _touched(self, radii: Array) -> Array:
        widest = int(np.argmax(self._rows[:, layout.AT_B]))
        edges, times = self._rows[: widest + 1, [layout.AT_B, layout.AT_TIME]].T
        return np.asarray(np.interp(radii, edges, times))

    def _recorded_work(self, radii: Array) -> Array:
        return self._frames.work(radii)

    def _pressed(self, radii: Array) -> Array:
        return self._frames.pressed(radii)

    def _slip_borders(self) -> Array:
        return np.array([0.0, self.max_radius])


def solid_of(losses: LossNumbers) -> Solid:
    """Return what the contact is of."""
    return made_of(int(losses.loss), float(losses.parameter), float(losses.extra))


def solve_by_marching(psi: float, chi: float, losses: LossNumbers) -> MarchedSolution:
    """Solve one oblique impact for which there is no engine but the march."""
    trial, kept, numbers = march.new_work(), march.new_work(march.LONGEST), np.zeros(march.NUMBERS)
    law, first = (Inertia(chi), solid_of(losses)), min(abs(psi), LARGEST_PSI)
    status, error = march.run(psi, 0.0, *law, trial, numbers)
    solved = status == Status.SOLVED
    steps = march.trace(first, 0.0, *law, march.MOST_SPRINGS, trial, kept) if solved else -1
    rows = kept.rows[: steps + 1].copy()
    return MarchedSolution(
        **outcome(psi, chi, losses, status, numbers),
        phases=phases_by_rows(rows, -1 if psi < 0.0 else 1),
        psi_error=error,
        _rows=rows,
        _first=first or 1.0,
    )


def phases_by_rows(rows: Array, mirror: int = 1) -> tuple[Phase, ...]:
    """Return the phases; the edge, where both limits meet, is a ring that is left out."""
    if not len(rows):
        return ()
    return phases_of(
        _stretches(rows), mirror, SHORTEST_PHASE * rows[-1, layout.AT_TIME] / len(rows)
    )


def _stretches(rows: Array) -> Iterator[tuple[float, int, int]]:
    """Give end, kind and sign of runs of equal steps; stick while unloading is a ring too thin."""
    kinds = [_kind(row) for row in rows[1:-1]]
    for i in range(len(kinds) - 2, -1, -1):
        if kinds[i][0] == Kind.STICK and rows[i + 1, layout.AT_V] < 0.0:
            kinds[i] = kinds[i + 1]
    steps = zip([*rows[1:-2, layout.AT_TIME], rows[-1, layout.AT_TIME]], kinds, strict=True)
    for (kind, slip), run_of in groupby(steps, lambda step: step[1]):
        yield float(list(run_of)[-1][0]), kind, slip


def _kind(row: Array) -> tuple[int, int]:
    forth, back = bool(row[march.FORTH]), bool(row[march.BACK])
    kind = Kind.GROSS_SLIP if row[layout.AT_STUCK] == 0.0 else Kind.SLIP
    return int(kind if forth or back else Kind.STICK), forth - back
