"""Fourier integrals of functions of time that end and have kinks, and corners of their spectra.

The transform of F is int F(t) exp(-2 pi i f t) dt, by Gauss's rule on panels. Forces of a contact
go like powers of the square root of time at its ends, t^(3/2) at the first touch of elastic bodies,
and have kinks where phases change. Between two such instants t = a + (b - a) sin^2(theta/2) makes
them smooth in theta; where a kink is not known, panels are halved until both halves agree with the
whole.
"""

from collections.abc import Callable
from math import nan, pi, sqrt
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.dimensionless.numerics.arrays import Array

Complex = NDArray[np.complex128]
Amplitude = Callable[[Array], Array]

ABSCISSAS, WEIGHTS = np.polynomial.legendre.leggauss(32)
CYCLES_PER_PANEL = 4.0  # of the highest frequency on a panel, about
HALVES_AGREE = 1e-12  # of the integral of |F|: what halves of a panel may differ from the whole
MOST_PANELS = 150  # besides four for each that phases and the highest frequency need
PRODUCTS_HELD = 1_000_000  # of times and frequencies
FREQUENCY_STEP = 1.0 / 32.0  # over the duration: what lasts so long has no finer features
SEARCH_WIDTH = 3.0  # over the duration: where the search ends, if it need not go further
FINER = np.linspace(0.0, 1.0, 33)
REFINEMENTS = 8  # each takes a place 16 or 32 times as finely as the one before


class Pulse(NamedTuple):
    """Functions of time, a row each, at the places of a rule of integration with its weights."""

    times: Array
    weights: Array
    values: Array

    def transform(self, frequencies: Array) -> Complex:
        """Return the Fourier integral of every row at frequencies, shape (rows, frequencies)."""
        weighted: Any = (self.weights * self.values).T
        parts = [
            np.exp(-2j * np.pi * np.outer(part, self.times)) @ weighted
            for part in np.array_split(
                frequencies, 1 + frequencies.size * self.times.size // PRODUCTS_HELD
            )
        ]
        return np.concatenate(parts).T

    def variation(self) -> Array:
        """Return by how much each row rises and falls in all."""
        rows = self.values[:, np.argsort(self.times)]
        ends = np.zeros((len(rows), 1))
        return np.asarray(np.abs(np.diff(rows, axis=1, prepend=ends, append=ends)).sum(axis=1))


class _Panels(NamedTuple):
    """Panels in theta, from `low` to `high`, of spans of time from `start` on."""

    start: Array
    length: Array
    low: Array
    high: Array

    def rule(self) -> tuple[Array, Array]:
        """Return times and weights, a row a panel."""
        half = 0.5 * (self.high - self.low)[:, None]
        theta = 0.5 * (self.high + self.low)[:, None] + half * ABSCISSAS
        length = self.length[:, None]
        times = self.start[:, None] + length * np.sin(0.5 * theta) ** 2
        return times, WEIGHTS * half * 0.5 * length * np.sin(theta)

    def halves(self) -> "_Panels":
        """Return twice as many panels, the halves of each side by side."""
        middle = 0.5 * (self.low + self.high)
        low, high = np.stack([self.low, middle], 1), np.stack([middle, self.high], 1)
        return _Panels(
            np.repeat(self.start, 2), np.repeat(self.length, 2), low.ravel(), high.ravel()
        )

    def chosen(self, which: NDArray[np.bool_]) -> "_Panels":
        return _Panels(*(column[which] for column in self))


def sampled(function: Callable[[Array], Array], instants: Array, highest: float) -> Pulse:
    """Return functions of time ready for Fourier integrals up to a highest frequency.

    `function` takes times of shape (n,) and gives its rows, (rows, n); `instants` are the rising
    times of the first touch, of known kinks, and of the last touch.
    """
    panels = _first(instants, highest)
    most = MOST_PANELS + 4 * len(panels.low)
    values, weights = _on(function, panels)[1:]
    integrals, size = (values * weights).sum(-1), np.abs(values * weights).sum((1, 2))
    kept: list[tuple[Array, Array, Array]] = []
    while True:
        halves = panels.halves()
        times, values, weights = _on(function, halves)
        finer = (values * weights).sum(-1)
        off = np.abs(finer.reshape(len(finer), -1, 2).sum(-1) - integrals)
        again = np.repeat(np.any(off > HALVES_AGREE * size[:, None], axis=0), 2)
        if sum(len(part[0]) for part in kept) + 2 * len(times) > most:
            again = np.zeros(again.shape, bool)
        kept.append((times[~again], values[:, ~again], weights[~again]))
        if not again.any():
            break
        panels, integrals = halves.chosen(again), finer[:, again]
    columns = zip(*kept, strict=True)
    times, values, weights = (np.concatenate(part, axis=-2) for part in columns)
    return Pulse(times.ravel(), weights.ravel(), values.reshape(len(values), -1))


def _first(instants: Array, highest: float) -> _Panels:
    """Return panels on each of which the highest frequency has a few cycles."""
    start, length = instants[:-1], np.diff(instants)
    counts = 1 + np.ceil(highest * length / CYCLES_PER_PANEL).astype(int)
    angles = [np.linspace(0.0, np.pi, count + 1) for count in counts]
    low = np.concatenate([each[:-1] for each in angles])
    high = np.concatenate([each[1:] for each in angles])
    return _Panels(np.repeat(start, counts), np.repeat(length, counts), low, high)


def _on(function: Callable[[Array], Array], panels: _Panels) -> tuple[Array, Array, Array]:
    """Return times, values and weights on panels: (panels, nodes), the values (rows, ...)."""
    times, weights = panels.rule()
    values = function(times.ravel())
    return times, values.reshape(len(values), *times.shape), weights


class Corners(NamedTuple):
    """Frequencies of an amplitude spectrum; NaN where there is none.

    `peak` is where it is largest. Beyond it the amplitude has first fallen by 3 dB, to 1/sqrt(2) of
    the largest, at `corner` and by 6 dB, to 1/2, at `half`; its first minimum lies at `notch`.
    """

    peak: float
    corner: float
    half: float
    notch: float


def widest(pulse: Pulse, duration: float, most: float) -> Array:
    """Return how far, at most `most`, to look for corners; the spectrum is below V/(2 pi f)."""
    reach, variation = np.full(len(pulse.values), SEARCH_WIDTH / duration), pulse.variation()
    while True:
        highest = reach.max()
        largest = np.abs(pulse.transform(_grid(highest, duration))).max(axis=1)
        bound = np.divide(variation, pi * largest, where=largest > 0.0, out=0.0 * largest)
        wanted = np.minimum(bound, most)
        if np.all(wanted <= highest):
            return np.asarray(np.maximum(reach, wanted))
        reach = np.maximum(reach, np.minimum(wanted, 2.0 * highest))


def _grid(highest: float, duration: float) -> Array:
    return np.arange(0.0, highest * duration + 3.0 * FREQUENCY_STEP, FREQUENCY_STEP) / duration


def corners(pulse: Pulse, row: int, duration: float, highest: float) -> Corners:
    """Return the corners of one row of a pulse, looked for up to a highest frequency."""
    alone = pulse._replace(values=pulse.values[row : row + 1])

    def amplitude(frequencies: Array) -> Array:
        return np.asarray(np.abs(alone.transform(frequencies)[0]))

    grid = _grid(highest, duration)
    sizes = amplitude(grid)
    first = int(sizes.argmax())
    if sizes[first] == 0.0:
        return Corners(nan, nan, nan, nan)
    peak = _lowest(lambda f: -amplitude(f), grid, first) if first else 0.0
    largest = float(amplitude(np.array([peak]))[0])
    corner, half = (
        _fallen(amplitude, share * largest, grid[first:], sizes[first:])
        for share in (sqrt(0.5), 0.5)
    )
    minima = np.flatnonzero((sizes[1:-1] < sizes[:-2]) & (sizes[1:-1] <= sizes[2:])) + 1
    after = minima[minima > first]
    notch = _lowest(amplitude, grid, int(after[0])) if after.size else nan
    return Corners(peak, corner, half, notch)


def _fallen(amplitude: Amplitude, level: float, grid: Array, sizes: Array) -> float:
    """Return where the amplitude falls below a level for the first time."""
    for _ in range(REFINEMENTS):
        below = np.flatnonzero(sizes < level)
        if not below.size:
            return nan
        after = max(int(below[0]), 1)
        grid = grid[after - 1] + (grid[after] - grid[after - 1]) * FINER
        sizes = amplitude(grid)
    return float(grid[np.argmax(sizes < level)])


def _lowest(function: Amplitude, grid: Array, place: int) -> float:
    """Return where a function is least between the neighbours of a place on a grid."""
    for _ in range(REFINEMENTS):
        low, high = grid[max(place - 1, 0)], grid[min(place + 1, grid.size - 1)]
        grid = low + (high - low) * FINER
        place = int(function(grid).argmin())
    return float(grid[place])
