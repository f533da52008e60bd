"""Fourier integrals of functions of time that end and have kinks: Gauss's rule on panels.

The transform of F is int F(t) exp(-2 pi i f t) dt. Forces of a contact go like powers of the square
root of time at its ends, t^(3/2) at the first touch of elastic bodies, and have kinks where phases
change. Between two such instants t = a + (b - a) sin^2(theta/2) makes them smooth in theta; where a
kink is not known, panels are halved until both halves agree with the whole.
"""

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.dimensionless.numerics.arrays import Array

Complex = NDArray[np.complex128]

ABSCISSAS, WEIGHTS = np.polynomial.legendre.leggauss(32)
CYCLES = 4.0  # of the highest frequency on a panel, about
AGREED = 1e-12  # of the integral of |F|: what halves of a panel may differ from the whole
PANELS = 150  # at most, besides four for each that phases and the highest frequency need
AT_ONCE = 1_000_000  # products of times and frequencies that are held


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
                frequencies, 1 + frequencies.size * self.times.size // AT_ONCE
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
        """Return some of the panels."""
        return _Panels(*(column[which] for column in self))


def sampled(function: Callable[[Array], Array], instants: Array, highest: float) -> Pulse:
    """Return functions of time ready for Fourier integrals up to a highest frequency.

    `function` takes times of shape (n,) and gives its rows, (rows, n); `instants` are the rising
    times of the first touch, of known kinks, and of the last touch.
    """
    panels = _first(instants, highest)
    most = PANELS + 4 * len(panels.low)
    values, weights = _on(function, panels)[1:]
    integrals, size = (values * weights).sum(-1), np.abs(values * weights).sum((1, 2))
    kept: list[tuple[Array, Array, Array]] = []
    while True:
        halves = panels.halves()
        times, values, weights = _on(function, halves)
        finer = (values * weights).sum(-1)
        off = np.abs(finer.reshape(len(finer), -1, 2).sum(-1) - integrals)
        again = np.repeat(np.any(off > AGREED * size[:, None], axis=0), 2)
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
    counts = 1 + np.ceil(highest * length / CYCLES).astype(int)
    angles = [np.linspace(0.0, np.pi, count + 1) for count in counts]
    low = np.concatenate([each[:-1] for each in angles])
    high = np.concatenate([each[1:] for each in angles])
    return _Panels(np.repeat(start, counts), np.repeat(length, counts), low, high)


def _on(function: Callable[[Array], Array], panels: _Panels) -> tuple[Array, Array, Array]:
    """Return times, values and weights on panels: (panels, nodes), the values (rows, ...)."""
    times, weights = panels.rule()
    values = function(times.ravel())
    return times, values.reshape(len(values), *times.shape), weights
