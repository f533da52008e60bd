"""What a viscoelastic impact leaves behind: a few numbers, and if wanted every panel."""

from typing import NamedTuple

import numpy as np

from carom.dimensionless.lossy import layout
from carom.dimensionless.lossy.panels import normal, work as at
from carom.dimensionless.lossy.panels.collocation import NODES, PLACES, evaluate, integrate
from carom.dimensionless.lossy.panels.normal import Motion
from carom.dimensionless.lossy.panels.work import Arrays, Panel, state_at_node
from carom.dimensionless.lossy.viscoelastic.ledger import loss_rate, ring_moments, square_of_u
from carom.dimensionless.lossy.viscoelastic.ring import Mode, force, front, ring_of
from carom.dimensionless.numerics.arrays import Array, CodePairs, Cube
from carom.dimensionless.numerics.kernels import kernel

SEARCH = 40


class Trace(NamedTuple):
    """Panels kept so far; empty arrays keep nothing."""

    rows: Cube  # (panels, ROWS, NODES)
    kinds: CodePairs  # (panels, 2): what the panel does, sign of slip


def new_record(wanted: bool) -> Trace:
    """Return an empty record."""
    room = at.MAX_PANELS if wanted else 0
    return Trace(np.zeros((room, layout.ROWS, NODES)), np.zeros((room, 2), dtype=np.int8))


@kernel
def note_numbers(work: Arrays, motion: Motion, panel: Panel, numbers: Array) -> None:
    """Add a solved panel to what an impact comes to."""
    values, rates, last = work.values, work.rates, NODES - 1
    b, v = values[at.RADIUS], values[at.SPEED]
    for j in range(NODES):
        rates[0, j] = 2.0 * b[j]
        rates[1, j] = 2.0 * b[j] * v[j]
    integrate(panel.clock, numbers[layout.TIME], panel.length, rates[0], rates[2])
    numbers[layout.TIME] = rates[2, last]
    integrate(panel.clock, numbers[layout.PENETRATION], panel.length, rates[1], rates[2])
    numbers[layout.PENETRATION] = rates[2, last]
    numbers[layout.DEEPEST] = max(numbers[layout.DEEPEST], numbers[layout.PENETRATION])
    numbers[layout.WIDEST] = max(numbers[layout.WIDEST], b[last])
    numbers[layout.STRONGEST] = max(numbers[layout.STRONGEST], strongest(work, motion, panel))
    numbers[layout.PSI_OUT], numbers[layout.RESTITUTION] = values[at.PSI, last], -v[last]


@kernel
def strongest(work: Arrays, motion: Motion, panel: Panel) -> float:
    """Return the largest normal force in a panel, by bisection between its nodes."""
    values, best, largest = work.values, 0, -np.inf
    for j in range(NODES):
        force = normal.normal_force(motion, values[at.RADIUS, j], values[at.SPEED, j])
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
        motion, evaluate(series, n, at.RADIUS, x), evaluate(series, n, at.SPEED, x)
    )


@kernel
def keep_normal(work: Arrays, motion: Motion, panel: Panel, numbers: Array, rows: Array) -> None:
    """Keep the normal motion of a panel, U and psi at its nodes, before the numbers are added."""
    values, rates, h = work.values, work.rates, panel.length
    b, v = values[at.RADIUS], values[at.SPEED]
    for j in range(NODES):
        rates[0, j], rates[1, j] = 2.0 * b[j], 2.0 * b[j] * v[j]
        rates[2, j] = normal.loss_rate(motion, b[j], v[j])
    integrate(panel.clock, numbers[layout.TIME], h, rates[0], rows[layout.AT_TIME])
    integrate(panel.clock, numbers[layout.PENETRATION], h, rates[1], rows[layout.AT_D])
    integrate(panel.clock, numbers[layout.LOST], h, rates[2], rows[layout.AT_LOST])
    for j in range(NODES):
        rows[layout.AT_B, j], rows[layout.AT_V, j] = b[j], v[j]
        rows[layout.AT_U, j], rows[layout.AT_PSI, j] = values[at.MOVED, j], values[at.PSI, j]
        rows[layout.AT_P, j] = normal.normal_force(motion, b[j], v[j])
        rows[layout.AT_STORED, j] = normal.stored(b[j], rows[layout.AT_D, j])
    numbers[layout.LOST] = rows[layout.AT_LOST, NODES - 1]


@kernel
def keep(work: Arrays, motion: Motion, panel: Panel, numbers: Array, record: Trace) -> None:
    """Keep a panel: what there is at its nodes, and what it does."""
    rows, kind, ring = record.rows[panel.number], record.kinds[panel.number], ring_of(work)
    keep_normal(work, motion, panel, numbers, rows)
    for j in range(NODES):
        x, now, time = PLACES[j], state_at_node(work, j), work.values[at.TIME, j]
        border = front(work, motion, panel, now, time)
        h = ring_moments(work, motion, panel, x, now, border, time)
        q, d = force(work, motion, panel, x, now, border), rows[layout.AT_D, j]
        rows[layout.AT_Q, j], rows[layout.AT_STUCK, j] = q, border.radius
        rows[layout.AT_SQUARE, j] = square_of_u(work, motion, panel, x, now, border, d, q, h)
    all_stuck = ring.mode == Mode.STICKS or ring.mode == Mode.RETRACES
    kind[0] = (
        layout.STICK
        if all_stuck
        else (layout.GROSS_SLIP if ring.mode == Mode.SLIPS else layout.SLIP)
    )
    kind[1] = ring.sign
    note_shear(work, motion, panel, numbers)
    for j in range(NODES):
        rows[layout.AT_SHEAR_LOST, j] = work.rates[2, j]


@kernel
def note_shear(work: Arrays, motion: Motion, panel: Panel, numbers: Array) -> None:
    """Write what is lost in shear up to each node of a panel into the rates; add it all."""
    rates, ring = work.rates, ring_of(work)
    for j in range(NODES):
        x, now, time = PLACES[j], state_at_node(work, j), work.values[at.TIME, j]
        border = front(work, motion, panel, now, time)
        h = ring_moments(work, motion, panel, x, now, border, time)
        rates[0, j] = loss_rate(motion, now, ring, border, h)
    integrate(panel.clock, numbers[layout.SHEAR_LOST], panel.length, rates[0], rates[2])
    numbers[layout.SHEAR_LOST] = rates[2, NODES - 1]
