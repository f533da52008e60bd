"""What an event changes for good: the memory of a viscoelastic contact, and its ring of slip."""

import numpy as np

from carom.dimensionless.lossy.panels.collocation import NODES
from carom.dimensionless.lossy.panels.newton import Panel, State, state_at_node
from carom.dimensionless.lossy.panels.normal import Motion, Stage
from carom.dimensionless.lossy.panels.pieces import (
    A0,
    A1,
    MAX_PIECES,
    PANEL,
    R0,
    R1,
    S0,
    S1,
    SIGN,
    W0,
    W1,
    X0,
    X1,
)
from carom.dimensionless.lossy.panels.work import (
    FRONT,
    LAID,
    LAID_A,
    LAID_RADIUS,
    LAID_SQUARE,
    TIME,
    Arrays,
)
from carom.dimensionless.lossy.viscoelastic import passed
from carom.dimensionless.lossy.viscoelastic.events import ARRIVES, BEGINS, CLOSES, STOPS, TURNS
from carom.dimensionless.lossy.viscoelastic.memory import FLAT, lay_flat, level_at, rim, trim
from carom.dimensionless.lossy.viscoelastic.passed import AT_ONCE, left, push, push_at_once
from carom.dimensionless.lossy.viscoelastic.ring import (
    RETREATS,
    RETURNS,
    SLIPS,
    STANDS,
    STICKS,
    excess,
    front,
    level_now,
    ring_of,
    set_ring,
)
from carom.dimensionless.numerics.kernels import kernel

SAME = 1e-10  # levels nearer than this are one


@kernel
def commit(work: Arrays, motion: Motion, panel: Panel, event: int) -> int:
    """Change the memory at the end of a panel, and what comes next; return the pieces left."""
    ring, count, last = ring_of(work), panel.pieces, NODES - 1
    now, time = state_at_node(work, last), work.values[TIME, last]
    at = front(work, motion, panel, now, time)
    if ring.mode == STICKS:
        count = lay(work, panel, 0)
    elif ring.mode == RETREATS:
        trim(work, count - 1, at.radius, at.place)
        depth = push(work, ring.depth, panel.number, np.sqrt(work.values[FRONT, 0]), at.radius)
        set_ring(work, ring.mode, ring.sign, depth)
        if event == ARRIVES:
            count -= 1
    elif ring.mode == RETURNS:
        count = lay(work, panel, ring.sign)
        count = give_back_rest(work, motion, count, at.place, event, now)
    return follow_event(work, motion, count, event, now, time)


@kernel
def lay(work: Arrays, panel: Panel, sign: int) -> int:
    """Write the piece that the panel has laid behind the others; return how many there are."""
    pieces, values, i, last = work.pieces, work.values, panel.pieces, NODES - 1
    pieces[i, SIGN], pieces[i, PANEL], pieces[i, X0], pieces[i, X1] = sign, panel.number, -1.0, 1.0
    pieces[i, R0], pieces[i, R1] = values[LAID_RADIUS, 0], values[LAID_RADIUS, last]
    pieces[i, A0], pieces[i, A1] = values[LAID_A, 0], values[LAID_A, last]
    pieces[i, W0], pieces[i, W1] = 0.0, values[LAID, last]
    pieces[i, S0], pieces[i, S1] = 0.0, values[LAID_SQUARE, last]
    return i + 1


@kernel
def give_back_rest(
    work: Arrays, motion: Motion, count: int, x: float, event: int, now: State
) -> int:
    """Shorten what slip passed by what sticks again; return how many pieces there are."""
    ring, stuck = ring_of(work), rim(work.pieces, count)
    row = work.passed[ring.depth - 1]
    row[passed.X_INNER], row[passed.R_INNER] = x, stuck
    if event == ARRIVES and row[passed.R_OUTER] > stuck:  # its front is too fast to be followed
        level = level_now(motion, ring.sign, now)
        lay_flat(work.pieces, count, ring.sign, stuck, row[passed.R_OUTER], level)
        return count + 1
    return count


@kernel
def follow_event(
    work: Arrays, motion: Motion, count: int, event: int, now: State, time: float
) -> int:
    """Decide what comes next; return how many pieces there are then."""
    ring = ring_of(work)
    if event == BEGINS:
        return begin(work, motion, count, 1 if now.psi > 0.0 else -1, now, time)
    if event == CLOSES:  # to rounding: what was left of the ring slips the other way at once
        stuck, g = rim(work.pieces, count), excess(-ring.sign, now)
        depth = push_at_once(work, 0, max(now.radius, stuck), stuck, time, g)
        set_ring(work, RETREATS, -ring.sign, depth)
        return retreat(work, motion, count, now, time)
    if event == STOPS:
        level = level_now(motion, ring.sign, now)
        lay_flat(work.pieces, count, ring.sign, rim(work.pieces, count), now.radius, level)
        if motion.stage == Stage.UNLOADING.value:
            return begin(work, motion, count + 1, -ring.sign, now, time)
        set_ring(work, STICKS, 0, 0)
        return count + 1
    if event == TURNS and ring.mode == RETURNS:
        set_ring(work, RETREATS, ring.sign, ring.depth)
        return count
    if event == ARRIVES and ring.mode == RETURNS:
        set_ring(work, ring.mode, ring.sign, ring.depth - 1)
        return give_back(work, motion, count, now, time)
    if event == TURNS:
        return give_back(work, motion, count, now, time)
    if event == ARRIVES:
        return retreat(work, motion, count, now, time)
    return count


@kernel
def begin(work: Arrays, motion: Motion, count: int, sign: int, now: State, time: float) -> int:
    """Begin a ring of slip at the edge; return how many pieces there are."""
    set_ring(work, RETREATS, sign, 0)
    return retreat(work, motion, count, now, time)


@kernel
def retreat(work: Arrays, motion: Motion, count: int, now: State, time: float) -> int:
    """Let the front pass what is flat for it, and decide how it goes on; return the pieces left."""
    pieces, ring = work.pieces, ring_of(work)
    level = level_now(motion, ring.sign, now)
    for _ in range(MAX_PIECES):
        i = count - 1
        if count == 0:
            depth = ring_of(work).depth
            rest = work.passed[depth - 1, passed.R_INNER] if depth > 0 else 0.0
            if rest > 0.0:  # the centre is reached to rounding of levels, that is of r^2
                depth = push_at_once(work, depth, rest, 0.0, time, excess(ring.sign, now))
            set_ring(work, SLIPS, ring.sign, depth)
            return 0
        if pieces[i, R1] <= pieces[i, R0]:
            count = i
            continue
        if level > level_at(pieces, i, ring.sign, True) + SAME:
            set_ring(work, STANDS, ring.sign, ring_of(work).depth)
            return count
        if pieces[i, SIGN] != ring.sign or pieces[i, PANEL] != FLAT:
            set_ring(work, RETREATS, ring.sign, ring_of(work).depth)
            return count
        depth, g = ring_of(work).depth, excess(ring.sign, now)
        depth = push_at_once(work, depth, pieces[i, R1], pieces[i, R0], time, g)
        set_ring(work, RETREATS, ring.sign, depth)
        count = i
    return count


@kernel
def give_back(work: Arrays, motion: Motion, count: int, now: State, time: float) -> int:
    """Let what was passed at once stick again, and decide how the front goes on."""
    ring, g = ring_of(work), excess(ring_of(work).sign, now)
    level = level_now(motion, ring.sign, now)
    for top in range(ring.depth - 1, -1, -1):
        row = work.passed[top]
        if left(work, top, False, ring.sign, motion.alpha, time) < g * (1.0 - 1e-8) - 1e-14:
            set_ring(work, STANDS if count > 0 else SLIPS, ring.sign, top + 1)
            return count
        if row[passed.PANEL] != AT_ONCE:
            set_ring(work, RETURNS, ring.sign, top + 1)
            return count
        outer = min(row[passed.R_OUTER], now.radius)
        lay_flat(work.pieces, count, ring.sign, row[passed.R_INNER], outer, level)
        count += 1
    set_ring(work, STANDS if count > 0 else SLIPS, ring.sign, 0)
    return count
