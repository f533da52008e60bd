"""Least squares from many starting points at once, in bounds: Levenberg and Marquardt's method."""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.quantities.arrays import Array

Residuals = Callable[[Array], Array]  # coordinates (batch, parameters) -> (batch, residuals)

DIFFERENCE_STEP = 1e-5
ROUNDS, ENOUGH = 60, 1e-7  # steps at most; part of the sum that no longer counts
LEAST_DAMPING = 1e-12  # keeps equations solvable where coordinates act only together
FREER, TIGHTER = 0.2, 6.0  # of the damping after a step that helped, or did not


class BoxBounds(NamedTuple):
    """Least and largest coordinates, each of shape (parameters,)."""

    low: Array
    high: Array


class Minimum(NamedTuple):
    """Coordinates (batch, parameters) and the sums of squares there (batch,)."""

    at: Array
    sums: Array


def jacobian(residuals: Residuals, at: Array, base: Array, bounds: BoxBounds) -> Array:
    """Return derivatives of residuals, of shape (batch, residuals, parameters), one-sided."""
    batch, count = at.shape
    steps = np.where(at + DIFFERENCE_STEP <= bounds.high, DIFFERENCE_STEP, -DIFFERENCE_STEP)
    moved = np.repeat(at[:, np.newaxis, :], count, axis=1)
    moved[:, np.arange(count), np.arange(count)] += steps
    values = residuals(moved.reshape(batch * count, count)).reshape(batch, count, base.shape[1])
    return ((values - base[:, np.newaxis, :]) / steps[:, :, np.newaxis]).swapaxes(1, 2)


def descend(
    residuals: Residuals, start: Array, bounds: BoxBounds, free: NDArray[np.bool_] | None = None
) -> Minimum:
    """Return where sums of squares are least, from each starting point of a batch.

    `free`, of shape (batch, parameters), tells which coordinates may move.
    """
    at = np.clip(start, bounds.low, bounds.high)
    movable = np.ones(at.shape, dtype=bool) if free is None else free
    base = residuals(at)
    sums = np.einsum("bm,bm->b", base, base)
    damping = np.full(len(at), 1e-3)
    quiet = np.zeros(len(at), dtype=np.int64)
    slopes = jacobian(residuals, at, base, bounds)
    for _ in range(ROUNDS):
        trial = np.clip(at + _steps(slopes, base, damping, movable, at, bounds), *bounds)
        values = residuals(trial)
        squares = np.einsum("bm,bm->b", values, values)
        better = squares < sums
        quiet = np.where(sums - squares < ENOUGH * sums + 1e-9, quiet + 1, 0)
        at = np.where(better[:, np.newaxis], trial, at)
        base = np.where(better[:, np.newaxis], values, base)
        sums = np.where(better, squares, sums)
        freer = np.maximum(FREER * damping, LEAST_DAMPING)
        damping = np.where(better, freer, TIGHTER * np.maximum(damping, 1e-6))
        if np.all((quiet >= 2) | (damping > 1e8)):
            break
        slopes = jacobian(residuals, at, base, bounds)
    return Minimum(at, sums)


def _steps(
    slopes: Array,
    base: Array,
    damping: Array,
    movable: NDArray[np.bool_],
    at: Array,
    bounds: BoxBounds,
) -> Array:
    """Return the damped steps; what is held, or pressed against a bound, stays."""
    downhill = -np.einsum("bmp,bm->bp", slopes, base)
    pressed = ((at <= bounds.low) & (downhill < 0.0)) | ((at >= bounds.high) & (downhill > 0.0))
    moves = movable & ~pressed
    slopes = np.where(moves[:, np.newaxis, :], slopes, 0.0)
    matrix = np.einsum("bmp,bmq->bpq", slopes, slopes)
    diagonal = np.einsum("bpp->bp", matrix)
    count = at.shape[1]
    added = damping[:, np.newaxis] * (diagonal + 1e-3) + np.where(moves, 1e-9, 1.0)
    matrix[:, np.arange(count), np.arange(count)] += added
    right = np.where(moves, downhill, 0.0)
    return np.asarray(np.linalg.solve(matrix, right[:, :, np.newaxis])[:, :, 0])
