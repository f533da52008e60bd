"""The largest stresses below a contact through a whole impact, each with its place and instant."""

from abc import ABC, abstractmethod
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from carom.dimensionless.fields import peaks as instant
from carom.dimensionless.fields.peaks import COSINE, DEPTH, GOLDEN, MEASURES, RADIUS, VALUE
from carom.dimensionless.fields.profile import Profile
from carom.dimensionless.fields.subsurface import Load, load_of
from carom.dimensionless.lossy.solution import LossySolution
from carom.dimensionless.numerics.arrays import Array
from carom.dimensionless.solution import Solution

TIMES = 0.5 - 0.5 * np.cos(np.linspace(0.0, np.pi, 9))  # of the scan, within a phase
# Of the contact, in depths of the search.
FIRST_RADII = np.array([0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0])
NEARLY_LARGEST = 0.95  # of the values of the scan: instants that are searched, too
INSTANT_TOLERANCE = 1e-2  # of the time between two scans, to which the instant is found
MEMORY_TOLERANCE = 1e-6
FIRST_STEP, NEXT_STEP = 0.1, 0.03  # of a climb, in contact radii, and of those beside it
LAST_STEP, FINEST_STEP = 2e-3, 1e-4  # of a climb: peaks are round; of the last one


class Peak(NamedTuple):
    """The largest value of a measure in units of p_L, its place and its instant."""

    value: float
    x: float
    y: float
    z: float
    time: float


class Contacts:
    """The contacts of an impact, each solved for once; `depth` is where the search begins.

    Instants of the scan are nine in each phase; in gross slip of elastic bodies the stress keeps
    its shape, so that the largest contact is enough, unless the search begins at a depth.
    """

    def __init__(
        self, solution: Solution | LossySolution, friction: float, depth: float = 0.0
    ) -> None:
        self.solution, self.friction, self.depth = solution, friction, depth
        self.times = self._instants()
        self.peaks: dict[tuple[float, int], Peak] = {}  # by nu and measure
        self.tensions: dict[tuple[float, float], Array] = {}  # beside the contact, by nu and time
        self._kept: dict[float, tuple[Profile, float]] = {}

    def at(self, time: float) -> tuple[Profile, float]:
        """Return the memory of the contact at a time and the density of pressure at its edge."""
        if time not in self._kept:
            if isinstance(self.solution, Solution):
                self._kept[time] = self.solution.memory(time).profile(MEMORY_TOLERANCE), 0.0
            else:
                state = self.solution.contact_at(time)
                self._kept[time] = state.profile, state.rim
        return self._kept[time]

    def size(self, time: float) -> float:
        return float(self.at(time)[0].edges[-1])

    def shallow(self, time: float) -> float:
        """Return the depth from which on is searched, in radii of the contact."""
        return self.depth / self.size(time)

    def load(self, time: float, poisson: float) -> Load:
        """Return what acts on a body at a time."""
        profile, rim = self.at(time)
        return load_of(profile, poisson, rim)

    def _instants(self) -> Array:
        solution, of_elastic = self.solution, isinstance(self.solution, Solution)
        widest = float(solution.touched([solution.max_radius])[0])
        if self.depth == 0.0 and of_elastic and self.friction == 0.0:
            return np.array([widest])
        instants = []
        if self.depth > 0.0:  # where stresses do not keep their shape; a viscous touch is a blow
            radii = np.minimum(self.depth * FIRST_RADII, solution.max_radius)
            instants.append(solution.touched(radii))
        for phase in solution.phases:
            if self.depth == 0.0 and of_elastic and phase.kind == "gross slip":
                instants.append(np.array([min(max(widest, phase.start), phase.end)]))
            else:
                instants.append(phase.start + (phase.end - phase.start) * TIMES)
        return np.unique(np.concatenate(instants))


class Search(ABC):
    """A search for the largest value of one measure through the contacts of an impact."""

    def __init__(self, contacts: Contacts) -> None:
        self.contacts = contacts

    @abstractmethod
    def scanned(self, time: float) -> Array:
        """Return the largest values at an instant and where they are: a row for each region."""

    @abstractmethod
    def climbed(self, time: float, start: Array, step: float, last: float = LAST_STEP) -> Array:
        """Return the largest value near a place, and where; steps end with `last` contact radii."""

    def peak(self) -> Peak:
        """Return the largest value through the impact."""
        times = self.contacts.times
        rows = np.array([self.scanned(time) for time in times.tolist()])
        highest = rows[..., VALUE].max()
        least = highest - (1.0 - NEARLY_LARGEST) * abs(highest)
        candidates = [
            self._between(times, i, region[i])
            for region in np.moveaxis(rows, 1, 0)
            for i in _maxima(region[:, VALUE], least)
        ]
        time, row = max(candidates, key=lambda one: one[1][VALUE])
        return self.in_units(time, self.climbed(time, row, LAST_STEP, FINEST_STEP))

    def in_units(self, time: float, row: Array) -> Peak:
        """Return a place at an instant in units of the impact."""
        size = self.contacts.size(time)
        r, z = size * row[RADIUS], size * row[DEPTH]
        sine = np.sqrt(max(1.0 - row[COSINE] ** 2, 0.0))
        return Peak(*map(float, (row[VALUE], r * row[COSINE], r * sine, z, time)))

    def _between(self, times: Array, i: int, start: Array) -> tuple[float, Array]:
        """Return the instant and the place of a peak, between the neighbours of an instant."""
        low, time, high = times[[max(i - 1, 0), i, min(i + 1, times.size - 1)]].tolist()
        first = best = self.climbed(time, start, FIRST_STEP)
        tolerance = INSTANT_TOLERANCE * (high - low)
        while high - low > tolerance:  # golden sections: scipy.optimize takes longer to load
            later = high - time > time - low
            instant = time + (1.0 - GOLDEN) * ((high if later else low) - time)
            row = self.climbed(instant, first, NEXT_STEP)
            if row[VALUE] > best[VALUE]:
                low, high = (time, high) if later else (low, time)
                time, best = instant, row
            else:
                low, high = (low, instant) if later else (instant, high)
        return time, best


def _maxima(values: Array, least: float) -> list[int]:
    """Return which values have no higher neighbour and are not below the least."""
    padded = np.concatenate(([-np.inf], values, [-np.inf]))
    tops = (values >= padded[:-2]) & (values > padded[2:])
    return np.flatnonzero(tops & (values >= least)).tolist()


class _StressSearch(Search):
    """A search for the largest value of one measure of stress in a body."""

    def __init__(self, contacts: Contacts, poisson: float, measure: int) -> None:
        super().__init__(contacts)
        self.poisson, self.measure = poisson, measure

    def scanned(self, time: float) -> Array:
        if self.contacts.size(time) == 0.0:
            return np.zeros((2, instant.PEAK_COLUMNS))
        shallow = self.contacts.shallow(time)
        regions = instant.regions(self.contacts.at(time)[0], shallow)
        return np.array([self._best(time, places) for places in regions])

    def climbed(self, time: float, start: Array, step: float, last: float = LAST_STEP) -> Array:
        size = self.contacts.size(time)
        if size == 0.0:
            return np.zeros(instant.PEAK_COLUMNS)
        shallow = self.contacts.shallow(time)
        place = np.array([[start[RADIUS], max(start[DEPTH], shallow)]])
        starts = [place]
        if place[0, 1] == shallow:  # at the surface jumps move with the front
            starts.append(instant.jumps(self.contacts.at(time)[0], shallow))
        load = self.contacts.load(time, self.poisson)
        problem = self.measure, self.contacts.friction, load, shallow, np.inf
        climbs = [self._best(time, places) for places in starts]
        for best in climbs:
            best[VALUE] /= size
            instant.climb(*problem, step, last, best)
            best[VALUE] *= size
        return max(climbs, key=lambda best: best[VALUE])

    def _best(self, time: float, places: Array) -> Array:
        best, load = np.zeros(instant.PEAK_COLUMNS), self.contacts.load(time, self.poisson)
        instant.scan(self.measure, places, self.contacts.friction, load, best)
        best[VALUE] *= self.contacts.size(time)
        return best


def peaks(
    contacts: Contacts, poisson: float, measures: Sequence[int] = MEASURES
) -> tuple[Peak, ...]:
    """Return the largest von Mises, shear and tensile stress in the second body through an impact.

    Places and instants are scanned, then refined. Dense scans find nothing that is larger by 1e-4
    (`tests/invariants/test_peaks.py`). Of viscous bodies the stress is infinite at the edge while
    they are loaded, and at the first touch: the depth of `contacts` keeps the search away.

    `poisson` is that of the body, `measures` some of VON_MISES, SHEAR, TENSION. For each the result
    has `value` in p_L, x, y, z in sqrt(R* L), time in d_max/V_1.
    """
    peaks = contacts.peaks
    for each in measures:
        if (poisson, each) not in peaks:
            peak = _StressSearch(contacts, poisson, each).peak()
            peaks[poisson, each] = peak._replace(value=max(peak.value, 0.0))
    return tuple(peaks[poisson, each] for each in measures)
