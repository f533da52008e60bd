"""What ends a panel of a viscoelastic impact, and where."""

from typing import NamedTuple

import numpy as np

from carom.dimensionless.lossy.panels import normal
from carom.dimensionless.lossy.panels.collocation import (
    FLAT_ENDS,
    FLAT_START,
    NODES,
    PLACES,
    evaluate,
)
from carom.dimensionless.lossy.panels.newton import Panel, State, state_at
from carom.dimensionless.lossy.panels.normal import Motion, Stage
from carom.dimensionless.lossy.panels.plans import EARLY
from carom.dimensionless.lossy.panels.work import RADIUS, TIME, Arrays
from carom.dimensionless.lossy.viscoelastic.memory import level_at
from carom.dimensionless.lossy.viscoelastic.passed import left
from carom.dimensionless.lossy.viscoelastic.ring import (
    RETRACES,
    RETREATS,
    RETURNS,
    SLIPS,
    STANDS,
    STICKS,
    excess,
    force,
    front,
    level_now,
    ring_of,
)
from carom.dimensionless.numerics.kernels import kernel

# Slip begins at the edge; it stops all over; the front turns; it comes to the end of a piece, or of
# what slip passed; the ring closes.
NOTHING, BEGINS, STOPS, TURNS, ARRIVES, CLOSES = range(6)

ROUNDING = 1e-12
TURNED = 1e-10
STILL = 1e-10  # alpha times the rate of slip below which all that slips sticks at once
PARTING = 2e-3  # radius below which what still happens changes psi by less than chi b^5
BISECTIONS = 40


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
    if ring.mode == RETRACES:
        return NOTHING
    if ring.mode == STICKS:
        return BEGINS if abs(now.psi) - now.speed > small else NOTHING
    g = excess(ring.sign, now)
    if g < (STILL / alpha if ring.mode == RETURNS else -small):
        return STOPS
    if ring.mode == STANDS or ring.mode == SLIPS:
        if ring.depth > 0 and left(work, ring.depth - 1, False, ring.sign, alpha, time) > g:
            return TURNS if g > STILL / alpha else STOPS
        if ring.mode == SLIPS:
            return NOTHING
    at, last = front(work, motion, panel, now, time), panel.pieces - 1
    level = level_now(motion, ring.sign, now)
    if ring.mode == STANDS:
        if level < level_at(work.pieces, last, ring.sign, True) - small:
            return ARRIVES
    else:
        way = inwards(motion, ring.sign, now, force(work, motion, panel, x, now, at))
        if (way if ring.mode == RETURNS else -way) > TURNED:
            return TURNS
        if ring.mode == RETURNS and left(work, ring.depth - 1, True, ring.sign, alpha, time) > g:
            return ARRIVES
        if ring.mode == RETREATS and level < level_at(work.pieces, last, ring.sign, False):
            return ARRIVES
    return CLOSES if at.radius > now.radius + ROUNDING else NOTHING


@kernel
def happened_at(work: Arrays, motion: Motion, panel: Panel, x: float) -> int:
    """Return what has happened at a place of a solved panel."""
    time = evaluate(work.series, panel.number, TIME, x)
    return happened(work, motion, panel, x, state_at(work, panel, x), time)


@kernel
def first_event(work: Arrays, motion: Motion, panel: Panel) -> Event:
    """Return what first happens in a solved panel."""
    if motion.stage == Stage.UNLOADING.value and work.values[RADIUS, 0] < PARTING:
        return Event(2.0, NOTHING)
    flat = panel.clock == FLAT_START or panel.clock == FLAT_ENDS
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
