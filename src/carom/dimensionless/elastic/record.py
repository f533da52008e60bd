"""What an impact leaves behind for its dense solution: steps, memories, changes of phase."""

from typing import Any, NamedTuple

import numpy as np

from carom.dimensionless.elastic.memory import STACK_COLUMNS, Stack
from carom.dimensionless.elastic.motion import ORDER, SLOWER, B, Series, V
from carom.dimensionless.numerics.arrays import Counts, Cube, Matrix, Vector
from carom.dimensionless.numerics.kernels import kernel

MAX_NODES = 8000
MAX_STRETCHES = 1000
MAX_PHASES = 200
MAX_ANNULI = 400

# Columns of a node and of a change.
MODE, CLOCK, SIGN, STEP, STRETCH = range(5)
KIND, KIND_SIGN, CAUSE, AT_B, AT_V, AT_NODE = range(6)
KEPT = SLOWER + 1


class Record(NamedTuple):
    """Rows filled so far: `counts` of nodes, stretches, changes. Empty arrays keep nothing."""

    nodes: Matrix
    series: Cube
    stacks: Cube
    depths: Counts
    changes: Matrix
    counts: Counts


class Steps(NamedTuple):
    """Recorded steps for a chi and a lambda: when each begins, displacement, work of friction."""

    nodes: Matrix
    series: Cube
    chi: float
    give: float
    times: Vector
    moved: Matrix


def new_record(wanted: bool) -> Record:
    """Return an empty record, with room for changes of phase only if not more is wanted."""
    room = 1 if wanted else 0
    return Record(
        nodes=np.empty((room * MAX_NODES, 5)),
        series=np.empty((room * MAX_NODES, ORDER + 1, KEPT)),
        stacks=np.empty((room * MAX_STRETCHES, MAX_ANNULI, STACK_COLUMNS)),
        depths=np.empty(room * MAX_STRETCHES, dtype=np.int64),
        changes=np.empty((MAX_PHASES + 1, 6)),
        counts=np.zeros(3, dtype=np.int64),
    )


@kernel
def is_wanted(record: Record) -> bool:
    """Tell whether the record has room at all."""
    return bool(record.nodes.shape[0] > 0)


@kernel
def is_full(record: Record) -> bool:
    """Tell whether a wanted record has no room for another step or stretch."""
    if not is_wanted(record):
        return False
    steps, stretches = record.nodes.shape[0], record.depths.shape[0]
    return bool(record.counts[0] >= steps - 2 or record.counts[1] >= stretches - 2)


@kernel
def note_stretch(record: Record, stack: Stack, depth: int) -> None:
    """Keep the memory as it is below the front when a stretch starts."""
    row = record.counts[1]
    if is_wanted(record):
        for i in range(depth):
            for column in range(STACK_COLUMNS):
                record.stacks[row, i, column] = stack[i, column]
        record.depths[row] = depth
    record.counts[1] = row + 1


@kernel
def note_node(record: Record, mode: int, clock: int, sign: int, h: float, series: Series) -> None:
    """Keep the series of a step and how far it was taken."""
    if is_wanted(record):
        row = record.counts[0]
        node = record.nodes[row]
        node[MODE], node[CLOCK], node[SIGN], node[STEP] = mode, clock, sign, h
        node[STRETCH] = record.counts[1] - 1
        for k in range(ORDER + 1):
            for column in range(KEPT):
                record.series[row, k, column] = series[k, column]
        record.counts[0] = row + 1


@kernel
def note_change(record: Record, kind: int, sign: int, cause: int, series: Series) -> None:
    """Keep the start of a phase and what brought it about."""
    row = record.counts[2]
    change = record.changes[row]
    change[KIND], change[KIND_SIGN], change[CAUSE] = kind, sign, cause
    change[AT_B], change[AT_V], change[AT_NODE] = series[0, B], series[0, V], record.counts[0]
    record.counts[2] = row + 1


def trimmed(record: Record) -> Record:
    """Return the filled part of a record."""
    nodes, stretches, changes = record.counts.tolist()
    lengths = nodes, nodes, stretches, stretches, changes, record.counts.size
    parts: list[Any] = [part[:n].copy() for part, n in zip(record, lengths, strict=True)]
    return Record(*parts)
