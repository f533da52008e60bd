"""Where an amplitude spectrum is largest, where it has fallen off, and its first minimum."""

from collections.abc import Callable
from math import nan, pi, sqrt
from typing import NamedTuple

import numpy as np

from carom.dimensionless.numerics.arrays import Array
from carom.dimensionless.numerics.fourier import Pulse

Amplitude = Callable[[Array], Array]

STEP = 1.0 / 32.0  # over the duration: what lasts so long has no finer features
WIDTH = 3.0  # over the duration: where the search ends, if it need not go further
FINER = np.linspace(0.0, 1.0, 33)
ROUNDS = 8  # each takes a place 16 or 32 times as finely as the one before


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
    """Return up to which frequency the corners of each row must be looked for, `most` at most.

    A function that rises and falls by V in all has a spectrum below V/(2 pi f).
    """
    reach, variation = np.full(len(pulse.values), WIDTH / duration), pulse.variation()
    while True:
        highest = reach.max()
        largest = np.abs(pulse.transform(_grid(highest, duration))).max(axis=1)
        bound = np.divide(variation, pi * largest, where=largest > 0.0, out=0.0 * largest)
        wanted = np.minimum(bound, most)
        if np.all(wanted <= highest):
            return np.asarray(np.maximum(reach, wanted))
        reach = np.maximum(reach, np.minimum(wanted, 2.0 * highest))


def _grid(highest: float, duration: float) -> Array:
    return np.arange(0.0, highest * duration + 3.0 * STEP, STEP) / duration


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
    for _ in range(ROUNDS):
        below = np.flatnonzero(sizes < level)
        if not below.size:
            return nan
        after = max(int(below[0]), 1)
        grid = grid[after - 1] + (grid[after] - grid[after - 1]) * FINER
        sizes = amplitude(grid)
    return float(grid[np.argmax(sizes < level)])


def _lowest(function: Amplitude, grid: Array, place: int) -> float:
    """Return where a function is least between the neighbours of a place on a grid."""
    for _ in range(ROUNDS):
        low, high = grid[max(place - 1, 0)], grid[min(place + 1, grid.size - 1)]
        grid = low + (high - low) * FINER
        place = int(function(grid).argmin())
    return float(grid[place])
