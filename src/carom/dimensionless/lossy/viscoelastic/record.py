"""What the record of a viscoelastic impact keeps of its tangential motion, and what shear loses."""

from carom.dimensionless.lossy.layout import (
    AT_D,
    AT_Q,
    AT_SHEAR_LOST,
    AT_SQUARE,
    AT_STUCK,
    GROSS_SLIP,
    SHEAR_LOST,
    SLIP,
    STICK,
)
from carom.dimensionless.lossy.panels.collocation import NODES, PLACES, integrate
from carom.dimensionless.lossy.panels.newton import Panel, state_at_node
from carom.dimensionless.lossy.panels.normal import Motion
from carom.dimensionless.lossy.panels.record import Trace, keep_normal
from carom.dimensionless.lossy.panels.work import TIME, Arrays
from carom.dimensionless.lossy.viscoelastic.ledger import loss_rate, ring_moments, square_of_u
from carom.dimensionless.lossy.viscoelastic.ring import (
    RETRACES,
    SLIPS,
    STICKS,
    force,
    front,
    ring_of,
)
from carom.dimensionless.numerics.arrays import Array
from carom.dimensionless.numerics.kernels import kernel


@kernel
def keep(work: Arrays, motion: Motion, panel: Panel, numbers: Array, record: Trace) -> None:
    """Keep a panel: what there is at its nodes, and what it does."""
    rows, kind, ring = record.rows[panel.number], record.kinds[panel.number], ring_of(work)
    keep_normal(work, motion, panel, numbers, rows)
    for j in range(NODES):
        x, now, time = PLACES[j], state_at_node(work, j), work.values[TIME, j]
        at = front(work, motion, panel, now, time)
        h = ring_moments(work, motion, panel, x, now, at, time)
        q, d = force(work, motion, panel, x, now, at), rows[AT_D, j]
        rows[AT_Q, j], rows[AT_STUCK, j] = q, at.radius
        rows[AT_SQUARE, j] = square_of_u(work, motion, panel, x, now, at, d, q, h)
    all_stuck = ring.mode == STICKS or ring.mode == RETRACES
    kind[0] = STICK if all_stuck else (GROSS_SLIP if ring.mode == SLIPS else SLIP)
    kind[1] = ring.sign
    note_shear(work, motion, panel, numbers)
    for j in range(NODES):
        rows[AT_SHEAR_LOST, j] = work.rates[2, j]


@kernel
def note_shear(work: Arrays, motion: Motion, panel: Panel, numbers: Array) -> None:
    """Write what is lost in shear up to each node of a panel into the rates; add it all."""
    rates, ring = work.rates, ring_of(work)
    for j in range(NODES):
        x, now, time = PLACES[j], state_at_node(work, j), work.values[TIME, j]
        at = front(work, motion, panel, now, time)
        h = ring_moments(work, motion, panel, x, now, at, time)
        rates[0, j] = loss_rate(motion, now, ring, at, h)
    integrate(panel.clock, numbers[SHEAR_LOST], panel.length, rates[0], rates[2])
    numbers[SHEAR_LOST] = rates[2, NODES - 1]
