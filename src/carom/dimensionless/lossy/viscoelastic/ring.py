"""The ring of slip: its front, and the force of the contact inside and outside of it."""

from typing import NamedTuple

from carom.dimensionless.lossy.panels import normal
from carom.dimensionless.lossy.panels.collocation import evaluate
from carom.dimensionless.lossy.panels.newton import Panel, State
from carom.dimensionless.lossy.panels.normal import Motion
from carom.dimensionless.lossy.panels.pieces import cubes
from carom.dimensionless.lossy.panels.work import LAID, LAID_RADIUS, Arrays
from carom.dimensionless.lossy.viscoelastic.memory import (
    left_force,
    part_force,
    passed_level,
    piece_force,
    rim,
    row_of,
)
from carom.dimensionless.lossy.viscoelastic.passed import returned
from carom.dimensionless.numerics.kernels import kernel

# What a contact does: it sticks as a whole; the front of slip goes inwards, stands, or comes back
# outwards; it slips as a whole; it sticks and goes back as it came.
STICKS, RETREATS, STANDS, RETURNS, SLIPS, RETRACES = range(6)
# Numbers of the ring: what it does, the sign of slip, how much of what slip passed still slips, the
# force for T = 0 of pieces that stay whole in the panel, and psi/v where that is constant.
MODE, RING_SIGN, DEPTH, WHOLE, RATIO = range(5)


class Ring(NamedTuple):
    """What the contact does, the sign of slip, and how much of what slip passed still slips."""

    mode: int
    sign: int
    depth: int


class Front(NamedTuple):
    """Where slip begins: the radius, and the place there of the panel that it runs through."""

    radius: float
    place: float


@kernel
def ring_of(work: Arrays) -> Ring:
    """Return the ring of the moment."""
    return Ring(int(work.ring[MODE]), int(work.ring[RING_SIGN]), int(work.ring[DEPTH]))


@kernel
def set_ring(work: Arrays, mode: int, sign: int, depth: int) -> None:
    """Change the ring."""
    work.ring[MODE], work.ring[RING_SIGN], work.ring[DEPTH] = mode, sign, depth


@kernel
def moved(motion: Motion, now: State) -> float:
    """Return T = U + alpha psi."""
    return now.moved + motion.alpha * now.psi


@kernel
def level_now(motion: Motion, sign: int, now: State) -> float:
    """Return the level at which springs slip: D - T for slip +, D + T for slip -."""
    return normal.limit(motion, now.radius, now.speed) - sign * moved(motion, now)


@kernel
def excess(sign: int, now: State) -> float:
    """Return g = sigma psi - v, the rate of slip of what was never stuck."""
    return sign * now.psi - now.speed


@kernel
def front(work: Arrays, motion: Motion, panel: Panel, now: State, time: float) -> Front:
    """Return where slip begins."""
    ring, stuck = ring_of(work), rim(work.pieces, panel.pieces)
    if ring.mode == STICKS or ring.mode == RETRACES:
        return Front(now.radius, 0.0)
    if ring.mode == RETREATS:
        level = level_now(motion, ring.sign, now)
        radius, x = passed_level(work, panel.pieces - 1, ring.sign, level)
        return Front(radius, x)
    if ring.mode == RETURNS:
        g, top = excess(ring.sign, now), ring.depth - 1
        radius, x = returned(work, top, ring.sign, motion.alpha, time, g)
        return Front(max(radius, stuck), x)
    return Front(stuck, 0.0)


@kernel
def add_up(work: Arrays, panel: Panel) -> None:
    """Write the force of the pieces that stay whole in a panel."""
    whole = panel.pieces - 1 if ring_of(work).mode == RETREATS else panel.pieces
    work.ring[WHOLE] = 0.0
    for i in range(whole):
        work.ring[WHOLE] += piece_force(work.pieces, i)


@kernel
def force(work: Arrays, motion: Motion, panel: Panel, x: float, now: State, at: Front) -> float:
    """Return Q, the integral of f over the contact, at a place of a panel."""
    ring, a, b = ring_of(work), at.radius, now.radius
    if ring.mode == RETRACES:
        return float(work.ring[RATIO] * 2.0 / 3.0 * normal.normal_force(motion, b, now.speed))
    total = moved(motion, now) * a + work.ring[WHOLE]
    if ring.mode == RETREATS:
        total += part_force(work, panel.pieces - 1, a, at.place)
    elif ring.mode == STICKS:
        total -= evaluate(work.series, panel.number, LAID, x)
    elif ring.mode == RETURNS:
        first = work.values[row_of(ring.sign), 0], level_now(motion, ring.sign, now)
        moment = evaluate(work.series, panel.number, LAID, x)
        total += left_force(ring.sign, work.values[LAID_RADIUS, 0], a, *first, moment)
    limit = normal.limit(motion, b, now.speed)
    return float(total + ring.sign * (limit * (b - a) - cubes(a, b)))
