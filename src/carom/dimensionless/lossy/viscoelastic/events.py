"""What ends a panel of a viscoelastic impact, and what that changes for good in its contact."""

from typing import NamedTuple

import numpy as np

from carom.dimensionless.lossy.panels import collocation, normal, work as at
from carom.dimensionless.lossy.panels.collocation import NODES, PLACES, evaluate
from carom.dimensionless.lossy.panels.normal import Motion, Stage
from carom.dimensionless.lossy.panels.work import Arrays, Panel, State, state_at, state_at_node
from carom.dimensionless.lossy.viscoelastic import passed
from carom.dimensionless.lossy.viscoelastic.memory import FLAT, lay_flat, level_at, rim, trim
from carom.dimensionless.lossy.viscoelastic.passed import AT_ONCE, left, push, push_at_once
from carom.dimensionless.lossy.viscoelastic.ring import (
    Mode,
    excess,
    force,
    front,
    level_now,
    ring_of,
    set_ring,
)
from carom.dimensionless.numerics.kernels import kernel

# Slip begins at the edge; it stops all over; the front turns; it comes to the end of a piece, or of
# what slip passed; the ring closes.
NOTHING, BEGINS, STOPS, TURNS, ARRIVES, CLOSES = range(6)

ROUNDING = 1e-12
EARLY = 5e-4  # part of a panel in which zones that begin with it are too thin to be told
TURNED = 1e-10
STILL = 1e-10  # alpha times the rate of slip below which all that slips sticks at once
PARTING = 2e-3  # radius below which what still happens changes psi by less than chi b^5
BISECTIONS = 40
SAME = 1e-10  # levels nearer than this are one


class Event(NamedTuple):
    """What happens in a panel, and where; 2 if nothing does."""

    place: float
    what: int


@kernel
def inwards(motion: Motion, sign: int, now: State, q: float) -> float:
    """Return g + alpha g': the level of slip falls, and its front goes inwards, while positive."""
    loading = 1.25 * normal.normal_force(motion, now.radius, now.speed)
    return excess(sign, now) + motion.alpha * (loading - 3.75 * motion.chi * sign * q)


@kernel
def happened(work: Arrays, motion: Motion, panel: Panel, x: float, now: State, time: float) -> int:
    """Return what has happened at a place of a solved panel."""
    ring, alpha, small = ring_of(work), motion.alpha, ROUNDING * (1.0 + abs(now.psi))
    if ring.mode == Mode.RETRACES:
        return NOTHING
    if ring.mode == Mode.STICKS:
        return BEGINS if abs(now.psi) - now.speed > small else NOTHING
    g = excess(ring.sign, now)
    if g < (STILL / alpha if ring.mode == Mode.RETURNS else -small):
        return STOPS
    if ring.mode == Mode.STANDS or ring.mode == Mode.SLIPS:
        if ring.depth > 0 and left(work, ring.depth - 1, False, ring.sign, alpha, time) > g:
            return TURNS if g > STILL / alpha else STOPS
        if ring.mode == Mode.SLIPS:
            return NOTHING
    border, last = front(work, motion, panel, now, time), panel.pieces - 1
    level = level_now(motion, ring.sign, now)
    if ring.mode == Mode.STANDS:
        if level < level_at(work.pieces, last, ring.sign, True) - small:
            return ARRIVES
    else:
        way = inwards(motion, ring.sign, now, force(work, motion, panel, x, now, border))
        if (way if ring.mode == Mode.RETURNS else -way) > TURNED:
            return TURNS
        top = ring.depth - 1
        if ring.mode == Mode.RETURNS and left(work, top, True, ring.sign, alpha, time) > g:
            return ARRIVES
        if ring.mode == Mode.RETREATS and level < level_at(work.pieces, last, ring.sign, False):
            return ARRIVES
    return CLOSES if border.radius > now.radius + ROUNDING else NOTHING


@kernel
def happened_at(work: Arrays, motion: Motion, panel: Panel, x: float) -> int:
    """Return what has happened at a place of a solved panel."""
    time = evaluate(work.series, panel.number, at.TIME, x)
    return happened(work, motion, panel, x, state_at(work, panel, x), time)


@kernel
def first_event(work: Arrays, motion: Motion, panel: Panel) -> Event:
    """Return what first happens in a solved panel."""
    if motion.stage == Stage.UNLOADING.value and work.values[at.RADIUS, 0] < PARTING:
        return Event(2.0, NOTHING)
    flat = panel.clock == collocation.FLAT_START or panel.clock == collocation.FLAT_ENDS
    early = 2.0 * (np.sqrt(EARLY) if flat else EARLY) - 1.0
    low = -1.0
    for j in range(NODES):
        high = early if j == 0 else PLACES[j]
        if high < early:
            continue
        found = happened_at(work, motion, panel, high)
        if found != NOTHING:
            return event_between(work, motion, panel, low, Event(high, found))
        low = high
    return Event(2.0, NOTHING)


@kernel
def event_between(work: Arrays, motion: Motion, panel: Panel, low: float, event: Event) -> Event:
    """Return the first event after a place where nothing has happened, by bisection."""
    for _ in range(BISECTIONS):
        middle = 0.5 * (low + event.place)
        found = happened_at(work, motion, panel, middle)
        if found == NOTHING:
            low = middle
        else:
            event = Event(middle, found)
    return event


@kernel
def commit(work: Arrays, motion: Motion, panel: Panel, event: int) -> int:
    """Change the memory at the end of a panel, and what comes next; return the pieces left."""
    ring, count, last = ring_of(work), panel.pieces, NODES - 1
    now, time = state_at_node(work, last), work.values[at.TIME, last]
    border = front(work, motion, panel, now, time)
    if ring.mode == Mode.STICKS:
        count = lay(work, panel, 0)
    elif ring.mode == Mode.RETREATS:
        trim(work, count - 1, border.radius, border.place)
        outer = np.sqrt(work.values[at.FRONT, 0])
        depth = push(work, ring.depth, panel.number, outer, border.radius)
        set_ring(work, ring.mode, ring.sign, depth)
        if event == ARRIVES:
            count -= 1
    elif ring.mode == Mode.RETURNS:
        count = lay(work, panel, ring.sign)
        count = give_back_rest(work, motion, count, border.place, event, now)
    return follow_event(work, motion, count, event, now, time)


@kernel
def lay(work: Arrays, panel: Panel, sign: int) -> int:
    """Write the piece that the panel has laid behind the others; return how many there are."""
    pieces, values, i, last = work.pieces, work.values, panel.pieces, NODES - 1
    pieces[i, at.SIGN], pieces[i, at.PANEL], pieces[i, at.X0], pieces[i, at.X1] = (
        sign,
        panel.number,
        -1.0,
        1.0,
    )
    pieces[i, at.R0], pieces[i, at.R1] = values[at.LAID_RADIUS, 0], values[at.LAID_RADIUS, last]
    pieces[i, at.A0], pieces[i, at.A1] = values[at.LAID_A, 0], values[at.LAID_A, last]
    pieces[i, at.W0], pieces[i, at.W1] = 0.0, values[at.LAID, last]
    pieces[i, at.S0], pieces[i, at.S1] = 0.0, values[at.LAID_SQUARE, last]
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
        set_ring(work, Mode.RETREATS.value, -ring.sign, depth)
        return retreat(work, motion, count, now, time)
    if event == STOPS:
        level = level_now(motion, ring.sign, now)
        lay_flat(work.pieces, count, ring.sign, rim(work.pieces, count), now.radius, level)
        if motion.stage == Stage.UNLOADING.value:
            return begin(work, motion, count + 1, -ring.sign, now, time)
        set_ring(work, Mode.STICKS.value, 0, 0)
        return count + 1
    if event == TURNS and ring.mode == Mode.RETURNS:
        set_ring(work, Mode.RETREATS.value, ring.sign, ring.depth)
        return count
    if event == ARRIVES and ring.mode == Mode.RETURNS:
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
    set_ring(work, Mode.RETREATS.value, sign, 0)
    return retreat(work, motion, count, now, time)


@kernel
def retreat(work: Arrays, motion: Motion, count: int, now: State, time: float) -> int:
    """Let the front pass what is flat for it, and decide how it goes on; return the pieces left."""
    pieces, ring = work.pieces, ring_of(work)
    level = level_now(motion, ring.sign, now)
    for _ in range(at.MAX_PIECES):
        i = count - 1
        if count == 0:
            depth = ring_of(work).depth
            rest = work.passed[depth - 1, passed.R_INNER] if depth > 0 else 0.0
            if rest > 0.0:  # the centre is reached to rounding of levels, that is of r^2
                depth = push_at_once(work, depth, rest, 0.0, time, excess(ring.sign, now))
            set_ring(work, Mode.SLIPS.value, ring.sign, depth)
            return 0
        if pieces[i, at.R1] <= pieces[i, at.R0]:
            count = i
            continue
        if level > level_at(pieces, i, ring.sign, True) + SAME:
            set_ring(work, Mode.STANDS.value, ring.sign, ring_of(work).depth)
            return count
        if pieces[i, at.SIGN] != ring.sign or pieces[i, at.PANEL] != FLAT:
            set_ring(work, Mode.RETREATS.value, ring.sign, ring_of(work).depth)
            return count
        depth, g = ring_of(work).depth, excess(ring.sign, now)
        depth = push_at_once(work, depth, pieces[i, at.R1], pieces[i, at.R0], time, g)
        set_ring(work, Mode.RETREATS.value, ring.sign, depth)
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
            set_ring(work, Mode.STANDS.value if count > 0 else Mode.SLIPS.value, ring.sign, top + 1)
            return count
        if row[passed.PANEL] != AT_ONCE:
            set_ring(work, Mode.RETURNS.value, ring.sign, top + 1)
            return count
        outer = min(row[passed.R_OUTER], now.radius)
        lay_flat(work.pieces, count, ring.sign, row[passed.R_INNER], outer, level)
        count += 1
    set_ring(work, Mode.STANDS.value if count > 0 else Mode.SLIPS.value, ring.sign, 0)
    return count
