"""What springs did through a marched impact: pressure, traction and slip over the contact.

What springs bear is linear in x^2 between them and zero at the edge, so that pressure and traction
are those of slices of constant slope. By how much the surface is behind the bodies follows likewise
from the springs' deflection; a point has slid by what that has grown since it was touched.
"""

from functools import cached_property
from itertools import pairwise

import numpy as np

from carom.dimensionless.fields import surface
from carom.dimensionless.fields.profile import TERMS, Profile
from carom.dimensionless.lossy import layout
from carom.dimensionless.lossy.springs.march import (
    LAGGING,
    LONGEST,
    PRESSED,
    PULLED,
    SPARE_SPRINGS,
    new_work,
)
from carom.dimensionless.lossy.springs.motion import Inertia, Solid
from carom.dimensionless.lossy.springs.rebounds import trace
from carom.dimensionless.lossy.springs.springs import X
from carom.dimensionless.numerics.arrays import Array

SPRINGS = 200
EVERY = 2  # steps to one of which the work of friction is a sum


class Frames:
    """The springs of an impact after each step."""

    def __init__(self, psi: float, chi: float, solid: Solid) -> None:
        given = psi, Inertia(chi), solid, SPRINGS, new_work()
        steps = trace(*given, new_work(LONGEST))
        kept = new_work(steps, SPRINGS + SPARE_SPRINGS)
        trace(*given, kept)
        self.places = kept.springs[X, : SPRINGS + SPARE_SPRINGS]
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
        """Return the radius of the contact."""
        return float(np.sqrt(self._mixed(self.edges**2, time)))

    def profile(self, time: float, scale: float = 1.0) -> Profile:
        """Return what springs bear, those in shear times a scale."""
        bears = self._mixed(self.springs, time)
        edge = self.edge(time)
        pressed = self._linear(bears[PRESSED], edge, 0.0)
        return self._linear(scale * bears[PULLED], edge, 0.0)._replace(n=pressed.g)

    def _linear(self, values: Array, edge: float, at_edge: float) -> Profile:
        """Return a profile that is linear in x^2 between springs, and ends with a value."""
        count = int(np.searchsorted(self.places[: self._laid], edge))
        if count == 0:
            return Profile(np.zeros(1), np.zeros((0, TERMS)), np.zeros((0, TERMS)))
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
        """How many springs there are."""
        return int(np.argmax(self.places))

    def _behind(self, i: int, radii: Array) -> Array:
        """Return the radial functions of how far the surface is behind after a step."""
        lags = self.springs[i, LAGGING]
        return displaced(self._linear(lags, float(self.edges[i]), float(self.moved[i])), radii)

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
        grown = self.springs[then, LAGGING] - self.springs[first, LAGGING]
        rates = grown / (self.times[then] - self.times[first])
        edge = min(float(self.edges[first]), float(self.edges[then]))
        return displaced(self._linear(rates, edge, float(self.psi[i])), radii)

    @cached_property
    def _sums(self) -> Array:
        """Radii; the work of friction per area there, and the integral of the pressure."""
        places = np.append(self.places[: self._laid], self.edges.max())
        found = np.column_stack((places, np.zeros((places.size, 3))))
        last = self.times.size - 1
        steps = np.append(np.arange(0, last, EVERY), last)
        before = np.zeros((places.size, 2))
        for first, then in pairwise(steps.tolist()):
            middle = 0.5 * (self.times[first] + self.times[then])
            profile, after = self.profile(middle), self._behind(then, places)
            inside = places < min(self.edges[first], self.edges[then])
            pull, push = np.empty(places.size), np.empty(places.size)
            surface.tractions(profile, places, pull)
            surface.tractions(profile._replace(g=profile.n), places, push)
            found[:, 1:3] += (inside * pull)[:, np.newaxis] * (after - before)
            found[:, 3] += push * (self.times[then] - self.times[first])
            before = after
        return found

    def work(self, radii: Array) -> Array:
        """Return the radial functions of the work of friction per area."""
        places, *works, _ = self._sums.T
        return np.column_stack([np.interp(radii, places, work, right=0.0) for work in works])

    def pressed(self, radii: Array) -> Array:
        """Return the integral of the pressure over the time."""
        return np.asarray(np.interp(radii, self._sums[:, 0], self._sums[:, 3], right=0.0))


def displaced(profile: Profile, radii: Array) -> Array:
    """Return the radial functions w_0, w_2 of what springs with this profile have slipped."""
    out = np.empty((radii.size, 5))
    surface.sample(profile, 0.0, 0.0, 0.0, np.ascontiguousarray(radii), out)
    return np.asarray(out[:, 3:] * np.array([1.0, -1.0]))
