"""What an impact with losses leaves behind: a few numbers, and if wanted every panel."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.dimensionless._jit import kernel
from carom.dimensionless.lossy import normal
from carom.dimensionless.lossy.collocation import (
    NODES,
    PLACES,
    begin_smoothly,
    evaluate,
    integrate,
)
from carom.dimensionless.lossy.memory import RADIUS
from carom.dimensionless.lossy.normal import Loss, Motion
from carom.dimensionless.lossy.panels import Panel, cut_memory, state_at_node
from carom.dimensionless.lossy.work import MAX_PANELS, PSI, SPEED, Work

Array = NDArray[np.float64]

# What an impact comes to; time, penetration and work are those so far.
PSI_OUT, RESTITUTION, TIME, PENETRATION, WORK, LOST, DEEPEST, STRONGEST, WIDEST = range(9)
NUMBERS = 9

# What is kept of a panel, at its nodes.
AT_TIME, AT_D, AT_V, AT_PSI, AT_U, AT_Q, AT_P, AT_B, AT_STUCK, AT_WORK = range(10)
AT_STORED, AT_LOST = 10, 11
ROWS = 12
STICK, SLIP, GROSS_SLIP = range(3)  # what a panel does
SEARCH = 40


class Record(NamedTuple):
    """Panels kept so far; empty arrays keep nothing."""

    rows: Array  # (panels, ROWS, NODES)
    kinds: NDArray[np.int8]  # (panels, 2): what the panel does, sign of slip


def new_record(wanted: bool) -> Record:
    """Return an empty record."""
    room = MAX_PANELS if wanted else 0
    return Record(np.zeros((room, ROWS, NODES)), np.zeros((room, 2), dtype=np.int8))


@kernel
def note_panel(work: Work, motion: Motion, panel: Panel, numbers: Array, record: Record) -> None:
    """Add a solved panel to the numbers, and to the record if that is wanted."""
    if record.rows.shape[0] > 0:
        keep(work, motion, panel, numbers, record)
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
def strongest(work: Work, motion: Motion, panel: Panel) -> float:
    """Return the largest normal force in a panel, by bisection between its nodes."""
    values, best = work.values, 0
    force = np.empty(NODES)
    for j in range(NODES):
        force[j] = normal.normal_force(motion, values[RADIUS, j], values[SPEED, j])
        best = j if force[j] > force[best] else best
    if best == 0 or best == NODES - 1:
        return float(force[best])
    low, high = PLACES[best - 1], PLACES[best + 1]
    series, n = work.series, panel.number
    for _ in range(SEARCH):
        near, far = (2.0 * low + high) / 3.0, (low + 2.0 * high) / 3.0
        if force_at(motion, work.series, panel.number, near) < force_at(
            motion, work.series, panel.number, far
        ):
            low = near
        else:
            high = far
    return max(force_at(motion, series, n, 0.5 * (low + high)), float(force[best]))


@kernel
def force_at(motion: Motion, series: Array, n: int, x: float) -> float:
    """Return the normal force at a place of a panel."""
    return normal.normal_force(
        motion, evaluate(series, n, RADIUS, x), evaluate(series, n, SPEED, x)
    )


@kernel
def keep(work: Work, motion: Motion, panel: Panel, numbers: Array, record: Record) -> None:
    """Keep a panel: what there is at its nodes, and what it does."""
    rows, rates, h = record.rows[panel.number], work.rates, panel.length
    b, v = work.values[RADIUS], work.values[SPEED]
    for j in range(NODES):
        rates[0, j], rates[1, j] = 2.0 * b[j], 2.0 * b[j] * v[j]
    integrate(panel.clock, numbers[TIME], h, rates[0], rows[AT_TIME])
    integrate(panel.clock, numbers[PENETRATION], h, rates[1], rows[AT_D])
    for j in range(NODES):
        rates[0, j] = keep_node(work, motion, panel, j, rows, record.kinds[panel.number])
        rates[1, j] = normal.loss_rate(motion, b[j], v[j])
    begin_smoothly(rates[0])  # what slips from the first node on does not slip at it yet
    begin_smoothly(rows[AT_STUCK])
    integrate(panel.clock, numbers[WORK], h, rates[0], rows[AT_WORK])
    integrate(panel.clock, numbers[LOST], h, rates[1], rows[AT_LOST])
    if motion.loss == Loss.PLASTIC.value:
        rows[AT_LOST] = 1.0 - v * v - rows[AT_STORED]
    numbers[WORK], numbers[LOST] = rows[AT_WORK, NODES - 1], rows[AT_LOST, NODES - 1]


@kernel
def keep_node(
    work: Work, motion: Motion, panel: Panel, j: int, rows: Array, kind: NDArray[np.int8]
) -> float:
    """Keep what there is at a node; return the rate of frictional work by the clock."""
    b, v, u, psi = state_at_node(work, j)
    cut = cut_memory(work, motion, panel, PLACES[j], state_at_node(work, j))
    rows[AT_V, j], rows[AT_PSI, j], rows[AT_U, j], rows[AT_Q, j] = v, psi, u, cut.force
    rows[AT_B, j], rows[AT_STUCK, j] = b, cut.stuck
    rows[AT_P, j] = normal.normal_force(motion, b, v)
    rows[AT_STORED, j] = normal.stored(motion, b, rows[AT_D, j])
    if j == NODES // 2:
        forth, back = int(cut.plus > 0.0), int(cut.minus > 0.0)
        kind[0] = STICK if forth + back == 0 else (SLIP if cut.stuck > 0.0 else GROSS_SLIP)
        kind[1] = forth - back
    pace = normal.limit_rate(motion, b, v)
    slip = max(psi - pace, 0.0) * cut.plus + max(-psi - pace, 0.0) * cut.minus
    return float(2.0 * b * slip)
