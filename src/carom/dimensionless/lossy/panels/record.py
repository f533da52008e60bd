"""What an impact with losses leaves behind: a few numbers, and if wanted every panel."""

from typing import NamedTuple

import numpy as np

from carom.dimensionless.lossy.layout import (
    AT_B,
    AT_D,
    AT_LOST,
    AT_P,
    AT_PSI,
    AT_STORED,
    AT_TIME,
    AT_U,
    AT_V,
    DEEPEST,
    LOST,
    PENETRATION,
    PSI_OUT,
    RESTITUTION,
    ROWS,
    STRONGEST,
    TIME,
    WIDEST,
)
from carom.dimensionless.lossy.panels import normal
from carom.dimensionless.lossy.panels.collocation import NODES, PLACES, evaluate, integrate
from carom.dimensionless.lossy.panels.newton import Panel
from carom.dimensionless.lossy.panels.normal import Motion
from carom.dimensionless.lossy.panels.work import MAX_PANELS, MOVED, PSI, RADIUS, SPEED, Arrays
from carom.dimensionless.numerics.arrays import Array, CodePairs, Cube
from carom.dimensionless.numerics.kernels import kernel

SEARCH = 40


class Trace(NamedTuple):
    """Panels kept so far; empty arrays keep nothing."""

    rows: Cube  # (panels, ROWS, NODES)
    kinds: CodePairs  # (panels, 2): what the panel does, sign of slip


def new_record(wanted: bool) -> Trace:
    """Return an empty record."""
    room = MAX_PANELS if wanted else 0
    return Trace(np.zeros((room, ROWS, NODES)), np.zeros((room, 2), dtype=np.int8))


@kernel
def note_numbers(work: Arrays, motion: Motion, panel: Panel, numbers: Array) -> None:
    """Add a solved panel to what an impact comes to."""
    values, rates, last = work.values, work.rates, NODES - 1
    b, v = values[RADIUS], values[SPEED]
    for j in range(NODES):
        rates[0, j] = 2.0 * b[j]
        rates[1, j] = 2.0 * b[j] * v[j]
    integrate(panel.clock, numbers[TIME], panel.length, rates[0], rates[2])
    numbers[TIME] = rates[2, last]
    integrate(panel.clock, numbers[PENETRATION], panel.length, rates[1], rates[2])
    numbers[PENETRATION] = rates[2, last]
    numbers[DEEPEST] = max(numbers[DEEPEST], numbers[PENETRATION])
    numbers[WIDEST] = max(numbers[WIDEST], b[last])
    numbers[STRONGEST] = max(numbers[STRONGEST], strongest(work, motion, panel))
    numbers[PSI_OUT], numbers[RESTITUTION] = values[PSI, last], -v[last]


@kernel
def strongest(work: Arrays, motion: Motion, panel: Panel) -> float:
    """Return the largest normal force in a panel, by bisection between its nodes."""
    values, best, largest = work.values, 0, -np.inf
    for j in range(NODES):
        force = normal.normal_force(motion, values[RADIUS, j], values[SPEED, j])
        if force > largest:
            best, largest = j, force
    low, high = PLACES[max(best - 1, 0)], PLACES[min(best + 1, NODES - 1)]
    series, n = work.series, panel.number
    for _ in range(SEARCH):
        near, far = (2.0 * low + high) / 3.0, (low + 2.0 * high) / 3.0
        if force_at(motion, work.series, panel.number, near) < force_at(
            motion, work.series, panel.number, far
        ):
            low = near
        else:
            high = far
    return max(force_at(motion, series, n, 0.5 * (low + high)), largest)


@kernel
def force_at(motion: Motion, series: Array, n: int, x: float) -> float:
    """Return the normal force at a place of a panel."""
    return normal.normal_force(
        motion, evaluate(series, n, RADIUS, x), evaluate(series, n, SPEED, x)
    )


@kernel
def keep_normal(work: Arrays, motion: Motion, panel: Panel, numbers: Array, rows: Array) -> None:
    """Keep the normal motion of a panel, U and psi at its nodes, before the numbers are added."""
    values, rates, h = work.values, work.rates, panel.length
    b, v = values[RADIUS], values[SPEED]
    for j in range(NODES):
        rates[0, j], rates[1, j] = 2.0 * b[j], 2.0 * b[j] * v[j]
        rates[2, j] = normal.loss_rate(motion, b[j], v[j])
    integrate(panel.clock, numbers[TIME], h, rates[0], rows[AT_TIME])
    integrate(panel.clock, numbers[PENETRATION], h, rates[1], rows[AT_D])
    integrate(panel.clock, numbers[LOST], h, rates[2], rows[AT_LOST])
    for j in range(NODES):
        rows[AT_B, j], rows[AT_V, j] = b[j], v[j]
        rows[AT_U, j], rows[AT_PSI, j] = values[MOVED, j], values[PSI, j]
        rows[AT_P, j] = normal.normal_force(motion, b[j], v[j])
        rows[AT_STORED, j] = normal.stored(b[j], rows[AT_D, j])
    numbers[LOST] = rows[AT_LOST, NODES - 1]
