"""What the record of an impact of yielding spheres keeps of its tangential motion."""

from carom.dimensionless.lossy.panels.collocation import NODES, PLACES, begin_smoothly
from carom.dimensionless.lossy.panels.newton import Panel, state_at_node
from carom.dimensionless.lossy.panels.normal import Motion
from carom.dimensionless.lossy.panels.record import (
    AT_Q,
    AT_SQUARE,
    AT_STUCK,
    GROSS_SLIP,
    SLIP,
    STICK,
    Trace,
    keep_normal,
)
from carom.dimensionless.lossy.panels.work import Arrays
from carom.dimensionless.lossy.yielding.panels import cut_memory
from carom.dimensionless.numerics.arrays import Array
from carom.dimensionless.numerics.kernels import kernel


@kernel
def keep(work: Arrays, motion: Motion, panel: Panel, numbers: Array, record: Trace) -> None:
    """Keep a panel: what there is at its nodes, and what it does, told at the middle one."""
    rows, kind = record.rows[panel.number], record.kinds[panel.number]
    keep_normal(work, motion, panel, numbers, rows)
    for j in range(NODES):
        cut = cut_memory(work, motion, panel, PLACES[j], state_at_node(work, j))
        rows[AT_Q, j], rows[AT_SQUARE, j], rows[AT_STUCK, j] = cut.force, cut.stored, cut.stuck
        if j == NODES // 2:
            forth, back = int(cut.plus), int(cut.minus)
            kind[0] = STICK if forth + back == 0 else (SLIP if cut.stuck > 0.0 else GROSS_SLIP)
            kind[1] = forth - back
    begin_smoothly(rows[AT_STUCK])  # what slips from the first node on does not slip at it yet
