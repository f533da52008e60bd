"""What ends a panel of a viscoelastic impact, and what that changes for good in its contact."""

from typing import NamedTuple

import numpy as np

from carom.dimensionless.lossy.viscoelastic import contact, normal, work as at
from carom.dimensionless.lossy.viscoelastic.contact import Fading, Mode
from carom.dimensionless.lossy.viscoelastic.normal import Motion, Stage
from carom.dimensionless.lossy.viscoelastic.work import NODES, PLACES, Arrays, Panel, State
from carom.dimensionless.numerics.kernels import kernel

# Slip begins at the edge; it stops all over; the front turns; it comes to the end of a piece, or of
# what slip passed; the ring closes.
NOTHING, BEGINS, STOPS, TURNS, ARRIVES, CLOSES = range(6)

LEVEL_ROUNDING = 1e-12
EARLY_PART = 5e-4  # part of a panel in which zones that begin with it are too thin to be told
TURNING_RATE = 1e-10
STILL_RATE = 1e-10  # alpha times the rate of slip below which all that slips sticks at once
STILL_SPEED = 1e-4  # of slip, below which it moves springs by no more than the square
PARTING_RADIUS = 2e-3  # radius below which what still happens changes psi by less than chi b^5
BISECTIONS = 40
SAME_LEVEL = 1e-10  # levels nearer than this are one


class Event(NamedTuple):
    """What happens in a panel, and where; 2 if nothing does."""

    place: float
    what: int


@kernel
def inwards(motion: Motion, sign: int, now: State, q: float) -> float:
    """Return g + alpha g': the level of slip falls, and its front goes inwards, while positive."""
    loading = 1.25 * normal.normal_force(motion, now.radius, now.speed)
    return contact.excess(sign, now) + motion.alpha * (loading - 3.75 * motion.chi * sign * q)


@kernel
def comes_to_rest(work: Arrays, motion: Motion, panel: Panel, x: float, now: State) -> bool:
    """Tell whether the edge of what sticks slips on, so slowly that it counts as still, and slower.

    What STOPS leaves does so; slip that begins grows.
    """
    sign = 1 if now.psi > 0.0 else -1
    g = contact.excess(sign, now)
    if g > min(STILL_RATE / motion.alpha, STILL_SPEED):
        return False
    border = contact.front(work, motion, panel, now)
    force = contact.force(work, motion, panel, x, now, border)
    return inwards(motion, sign, now, force) < g


@kernel
def happened(work: Arrays, motion: Motion, panel: Panel, x: float) -> int:
    """Return what has happened at a place of a solved panel."""
    now = at.state_at(work, panel, x)
    ring, alpha, small = contact.ring_of(work), motion.alpha, LEVEL_ROUNDING * (1.0 + abs(now.psi))
    fading = Fading(ring.sign, alpha, now.time)
    if ring.mode == Mode.RETRACES:
        return NOTHING
    if ring.mode == Mode.STICKS:
        begins = abs(now.psi) - now.speed > small
        return BEGINS if begins and not comes_to_rest(work, motion, panel, x, now) else NOTHING
    g = contact.excess(ring.sign, now)
    if g < (STILL_RATE / alpha if ring.mode == Mode.RETURNS else -small):
        return STOPS
    if ring.mode == Mode.STANDS or ring.mode == Mode.SLIPS:
        if ring.depth > 0 and contact.left(work, ring.depth - 1, False, fading) > g:
            return TURNS if g > STILL_RATE / alpha else STOPS
        if ring.mode == Mode.SLIPS:
            return NOTHING
    border, last = contact.front(work, motion, panel, now), panel.pieces - 1
    level = contact.level_now(motion, ring.sign, now)
    if ring.mode == Mode.STANDS:
        if level < contact.level_at(work.pieces, last, ring.sign, True) - small:
            return ARRIVES
    else:
        way = inwards(motion, ring.sign, now, contact.force(work, motion, panel, x, now, border))
        if (way if ring.mode == Mode.RETURNS else -way) > TURNING_RATE:
            return TURNS
        top = ring.depth - 1
        if ring.mode == Mode.RETURNS and contact.left(work, top, True, fading) > g:
            return ARRIVES
        if ring.mode == Mode.RETREATS and level < contact.level_at(
            work.pieces, last, ring.sign, False
        ):
            return ARRIVES
    return CLOSES if border.radius > now.radius + LEVEL_ROUNDING else NOTHING


@kernel
def first_event(work: Arrays, motion: Motion, panel: Panel) -> Event:
    """Return what first happens in a solved panel."""
    if motion.stage == Stage.UNLOADING.value and work.values[at.RADIUS, 0] < PARTING_RADIUS:
        return Event(2.0, NOTHING)
    flat = panel.clock == at.FLAT_START or panel.clock == at.FLAT_ENDS
    early = 2.0 * (np.sqrt(EARLY_PART) if flat else EARLY_PART) - 1.0
    low = -1.0
    for j in range(NODES):
        high = early if j == 0 else PLACES[j]
        if high < early:
            continue
        what = happened(work, motion, panel, high)
        if what != NOTHING:
            return event_between(work, motion, panel, low, Event(high, what))
        low = high
    return Event(2.0, NOTHING)


@kernel
def event_between(work: Arrays, motion: Motion, panel: Panel, low: float, event: Event) -> Event:
    """Return the first event after a place where nothing has happened, by bisection."""
    for _ in range(BISECTIONS):
        middle = 0.5 * (low + event.place)
        what = happened(work, motion, panel, middle)
        if what == NOTHING:
            low = middle
        else:
            event = Event(middle, what)
    return event


@kernel
def commit(work: Arrays, motion: Motion, panel: Panel, event: int) -> int:
    """Change the memory at the end of a panel, and what comes next; return the pieces left."""
    ring, count, last = contact.ring_of(work), panel.pieces, NODES - 1
    now = at.state_at_node(work, last)
    border = contact.front(work, motion, panel, now)
    if ring.mode == Mode.STICKS:
        count = lay(work, panel, 0)
    elif ring.mode == Mode.RETREATS:
        contact.trim(work, count - 1, border.radius, border.place)
        outer = np.sqrt(work.values[at.FRONT, 0])
        contact.push(work, panel.number, outer, border.radius)
        if event == ARRIVES:
            count -= 1
    elif ring.mode == Mode.RETURNS:
        count = lay(work, panel, ring.sign)
        count = give_back_rest(work, motion, count, border.place, event, now)
    return follow_event(work, motion, count, event, now)


@kernel
def lay(work: Arrays, panel: Panel, sign: int) -> int:
    """Write the piece that the panel has laid behind the others; return how many there are."""
    pieces, values, i, last = work.pieces, work.values, panel.pieces, NODES - 1
    pieces[i, at.SIGN], pieces[i, at.PANEL] = sign, panel.number
    pieces[i, at.X0], pieces[i, at.X1] = -1.0, 1.0
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
    ring, stuck = contact.ring_of(work), contact.rim(work.pieces, count)
    row = work.passed[ring.depth - 1]
    row[contact.X_INNER], row[contact.R_INNER] = x, stuck
    if event == ARRIVES and row[contact.R_OUTER] > stuck:  # its front is too fast to be followed
        level = contact.level_now(motion, ring.sign, now)
        contact.lay_flat(work.pieces, count, ring.sign, stuck, row[contact.R_OUTER], level)
        return count + 1
    return count


@kernel
def follow_event(work: Arrays, motion: Motion, count: int, event: int, now: State) -> int:
    """Decide what comes next; return how many pieces there are then."""
    ring, stuck = contact.ring_of(work), contact.rim(work.pieces, count)
    if event == BEGINS:
        return begin(work, motion, count, 1 if now.psi > 0.0 else -1, now)
    if event == CLOSES:  # to rounding: what was left of the ring slips the other way at once
        contact.set_ring(work, Mode.RETREATS.value, -ring.sign, 0)
        g = contact.excess(-ring.sign, now)
        contact.push_at_once(work, max(now.radius, stuck), stuck, now.time, g)
        return retreat(work, motion, count, now)
    if event == STOPS:
        level = contact.level_now(motion, ring.sign, now)
        contact.lay_flat(work.pieces, count, ring.sign, stuck, now.radius, level)
        if motion.stage == Stage.UNLOADING.value:
            return begin(work, motion, count + 1, -ring.sign, now)
        contact.set_ring(work, Mode.STICKS.value, 0, 0)
        return count + 1
    if ring.mode == Mode.RETURNS and event == TURNS:
        work.ring[at.MODE] = Mode.RETREATS.value
        return count
    if ring.mode == Mode.RETURNS and event == ARRIVES:
        work.ring[at.DEPTH] -= 1
        return give_back(work, motion, count, now)
    if event == TURNS:
        return give_back(work, motion, count, now)
    return retreat(work, motion, count, now) if event == ARRIVES else count


@kernel
def begin(work: Arrays, motion: Motion, count: int, sign: int, now: State) -> int:
    """Begin a ring of slip at the edge; return how many pieces there are."""
    contact.set_ring(work, Mode.RETREATS.value, sign, 0)
    return retreat(work, motion, count, now)


@kernel
def retreat(work: Arrays, motion: Motion, count: int, now: State) -> int:
    """Let the front pass what is flat for it, and decide how it goes on; return the pieces left."""
    pieces, sign = work.pieces, contact.ring_of(work).sign
    level, g = contact.level_now(motion, sign, now), contact.excess(sign, now)
    for _ in range(at.MAX_PIECES):
        i = count - 1
        if count == 0:
            depth = contact.ring_of(work).depth
            rest = work.passed[depth - 1, contact.R_INNER] if depth > 0 else 0.0
            if rest > 0.0:  # the centre is reached to rounding of levels, that is of r^2
                contact.push_at_once(work, rest, 0.0, now.time, g)
            work.ring[at.MODE] = Mode.SLIPS.value
            return 0
        if pieces[i, at.R1] <= pieces[i, at.R0]:
            count = i
            continue
        if level > contact.level_at(pieces, i, sign, True) + SAME_LEVEL:
            work.ring[at.MODE] = Mode.STANDS.value
            return count
        work.ring[at.MODE] = Mode.RETREATS.value
        if pieces[i, at.SIGN] != sign or pieces[i, at.PANEL] != contact.FLAT:
            return count
        contact.push_at_once(work, pieces[i, at.R1], pieces[i, at.R0], now.time, g)
        count = i
    return count


@kernel
def give_back(work: Arrays, motion: Motion, count: int, now: State) -> int:
    """Let what was passed at once stick again, and decide how the front goes on."""
    ring = contact.ring_of(work)
    level, g = contact.level_now(motion, ring.sign, now), contact.excess(ring.sign, now)
    fading = Fading(ring.sign, motion.alpha, now.time)
    mode, depth = Mode.STANDS.value, ring.depth
    for top in range(ring.depth - 1, -1, -1):
        row = work.passed[top]
        if contact.left(work, top, False, fading) < g * (1.0 - 1e-8) - 1e-14:
            break
        if row[contact.PASSED_PANEL] != contact.AT_ONCE:
            mode = Mode.RETURNS.value
            break
        outer = min(row[contact.R_OUTER], now.radius)
        contact.lay_flat(work.pieces, count, ring.sign, row[contact.R_INNER], outer, level)
        count, depth = count + 1, top
    if count == 0 and mode == Mode.STANDS.value:
        mode = Mode.SLIPS.value
    contact.set_ring(work, mode, ring.sign, depth)
    return count
