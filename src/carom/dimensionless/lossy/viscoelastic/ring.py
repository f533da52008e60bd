"""The ring of slip: its front, and the force of the contact inside and outside of it."""

from enum import IntEnum
from typing import NamedTuple

from carom.dimensionless.lossy.panels import normal, work as at
from carom.dimensionless.lossy.panels.collocation import evaluate
from carom.dimensionless.lossy.panels.normal import Motion
from carom.dimensionless.lossy.panels.work import Arrays, Panel, State
from carom.dimensionless.lossy.viscoelastic import memory
from carom.dimensionless.lossy.viscoelastic.passed import returned
from carom.dimensionless.numerics.kernels import kernel


class Mode(IntEnum):
    """What a contact does; the front of slip is where it begins."""

    STICKS = 0  # as a whole
    RETREATS = 1  # the front goes inwards,
    STANDS = 2
    RETURNS = 3  # or comes back outwards
    SLIPS = 4  # as a whole
    RETRACES = 5  # sticks, and goes back as it came


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
    return Ring(int(work.ring[at.MODE]), int(work.ring[at.RING_SIGN]), int(work.ring[at.DEPTH]))


@kernel
def set_ring(work: Arrays, mode: int, sign: int, depth: int) -> None:
    """Change the ring."""
    work.ring[at.MODE], work.ring[at.RING_SIGN], work.ring[at.DEPTH] = mode, sign, depth


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
    ring, stuck = ring_of(work), memory.rim(work.pieces, panel.pieces)
    if ring.mode == Mode.STICKS or ring.mode == Mode.RETRACES:
        return Front(now.radius, 0.0)
    if ring.mode == Mode.RETREATS:
        level = level_now(motion, ring.sign, now)
        radius, x = memory.passed_level(work, panel.pieces - 1, ring.sign, level)
        return Front(radius, x)
    if ring.mode == Mode.RETURNS:
        g, top = excess(ring.sign, now), ring.depth - 1
        radius, x = returned(work, top, ring.sign, motion.alpha, time, g)
        return Front(max(radius, stuck), x)
    return Front(stuck, 0.0)


@kernel
def add_up(work: Arrays, panel: Panel) -> None:
    """Write the force of the pieces that stay whole in a panel."""
    whole = panel.pieces - 1 if ring_of(work).mode == Mode.RETREATS else panel.pieces
    work.ring[at.WHOLE] = 0.0
    for i in range(whole):
        work.ring[at.WHOLE] += memory.piece_force(work.pieces, i)


@kernel
def force(work: Arrays, motion: Motion, panel: Panel, x: float, now: State, border: Front) -> float:
    """Return Q, the integral of f over the contact, at a place of a panel."""
    ring, a, b = ring_of(work), border.radius, now.radius
    if ring.mode == Mode.RETRACES:
        return float(work.ring[at.RATIO] * 2.0 / 3.0 * normal.normal_force(motion, b, now.speed))
    total = moved(motion, now) * a + work.ring[at.WHOLE]
    if ring.mode == Mode.RETREATS:
        total += memory.part_force(work, panel.pieces - 1, a, border.place)
    elif ring.mode == Mode.STICKS:
        total -= evaluate(work.series, panel.number, at.LAID, x)
    elif ring.mode == Mode.RETURNS:
        first = work.values[memory.row_of(ring.sign), 0], level_now(motion, ring.sign, now)
        moment = evaluate(work.series, panel.number, at.LAID, x)
        total += memory.left_force(ring.sign, work.values[at.LAID_RADIUS, 0], a, *first, moment)
    limit = normal.limit(motion, b, now.speed)
    return float(total + ring.sign * (limit * (b - a) - memory.cubes(a, b)))
