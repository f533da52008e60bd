"""Collisions on NumPy arrays: compiled, in threads over blocks, at the speed of memory."""

from __future__ import annotations

from typing import Annotated, NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.bodies.pairs import Pair
from carom.bodies.shapes import HalfSpace
from carom.dimensionless.elastic import motion as at
from carom.dimensionless.elastic.integration import Work
from carom.dimensionless.elastic.phases import LARGEST_GIVE, Status, new_work, run_phases
from carom.dimensionless.elastic.record import Record, new_record
from carom.dimensionless.numerics.arrays import ArrayType, Codes, Vector
from carom.dimensionless.numerics.hertz import DURATION
from carom.dimensionless.numerics.kernels import entry_point, kernel
from carom.dimensionless.numerics.threads import in_blocks
from carom.dimensionless.rebounds import LINEAR_PSI, NEARLY_ELASTIC, STEP_TOLERANCE
from carom.many.collisions.records import LARGEST_SKEW, CollisionStatus, Inertia
from carom.many.laws.rules import LARGEST, Rule, one_plus_beta
from carom.quantities.arrays import Array

# x, y, z of one pair after the other
Flat = Annotated[NDArray[np.floating], ArrayType(np.floating, 1)]
Panels = Annotated[NDArray[np.int32], ArrayType(np.int32, 1)]

SMALLEST_SQUARE = 2.0**-960  # of |V_t|^2: less has lost digits, so that V_t is enlarged
ENLARGED = 2.0**500
CACHE_PAIRS = 256  # pairs whose numbers stay in the nearest cache
BLOCK = 65536  # pairs that a thread takes at once
PLATE_BLOCK = 16 * CACHE_PAIRS  # on a plate, where each is solved


class PlateRule(NamedTuple):
    """What a collision with a plate needs: lambda = give V_n^(1/5), psi = scale V_t/V_n.

    Above `fastest` it gives way like a foil, or is thinner than the penetration of a thick wall.
    Above `silent` the contact is over before an echo is back, as on a thick wall.
    """

    chi: float
    scale: float
    give: float
    fastest: float
    silent: float


def plate_rule(pair: Pair) -> PlateRule:
    """Return what collisions of a pair with a plate need, in SI units."""
    assert isinstance(pair.second, HalfSpace)
    assert pair.thickness is not None
    give, unit = pair.plate_give(1.0), pair.scales(1.0)
    with np.errstate(over="ignore", divide="ignore", invalid="ignore"):
        by_give = np.float64(LARGEST_GIVE / np.float64(give)) ** 5
        by_depth = np.float64(pair.thickness / unit.length) ** 1.25
        silent = np.float64(DURATION * unit.time / pair.second.echo_time) ** 5  # t_c goes as V^-1/5
    scale = pair.kappa / pair.friction if pair.friction > 0.0 else 0.0
    return PlateRule(pair.chi, scale, give, float(min(by_give, by_depth)), float(silent))


@kernel
def rebounds(
    plate: PlateRule,
    work: Work,
    record: Record,
    slope: Vector,
    closing: Vector,
    fraction: Vector,
    status: NDArray[np.int8],
) -> None:
    """Write 1 + beta at each slope psi_1, and (1 + e) V_n in the place of V_n.

    From psi_1 = 4 chi + 1 on the contact slides throughout, and psi_1 - psi_2 stays the same. Where
    psi_1 is 0, without friction or sliding, such an impact gives e.
    """
    sliding = 4.0 * plate.chi + 1.0
    for i in range(status.size):
        if status[i] != CollisionStatus.COLLIDED.value:
            continue
        if closing[i] > plate.fastest:
            status[i] = CollisionStatus.PLATE_TOO_THIN.value
            continue
        moves = slope[i] > 0.0
        psi_1 = max(slope[i], LINEAR_PSI) if moves else sliding
        psi = min(psi_1, sliding)
        give = min(plate.give * closing[i] ** 0.2, LARGEST_GIVE)
        if give < NEARLY_ELASTIC or closing[i] > plate.silent:
            give = 0.0
        record.counts[:] = 0
        ended = run_phases(psi, plate.chi, give, STEP_TOLERANCE, work, record)
        if ended != Status.SOLVED.value:
            status[i] = CollisionStatus.NOT_SOLVED.value
            continue
        lost = (psi - work.series[0, at.PSI]) / psi_1
        fraction[i] = min(2.0, max(0.0, lost)) if moves else 0.0
        closing[i] *= 1.0 - work.series[0, at.V]


class Motions(NamedTuple):
    """Velocities and spins of both bodies, flat."""

    velocity1: Flat
    spin1: Flat
    velocity2: Flat
    spin2: Flat


class Scratch(NamedTuple):
    """What a chunk of collisions needs in between; the first four are flat vectors."""

    linear: Vector  # v_1 - v_2, then the impulse J on the second body
    angular: Vector  # R_1 omega_1 + R_2 omega_2, then n x J
    axis: Vector  # the normal, of length one to the last bit
    sliding: Vector  # V_t of the contact point
    closing: Vector  # V_n
    slope: Vector
    fraction: Vector  # 1 + beta
    panel: Panels


def new_scratch() -> Scratch:
    """Return room for one chunk."""
    vectors, numbers = np.empty((4, 3 * CACHE_PAIRS)), np.empty((3, CACHE_PAIRS))
    return Scratch._make((*vectors, *numbers, np.empty(CACHE_PAIRS, dtype=np.int32)))


@kernel
def approach(motions: Motions, inertia: Inertia, scratch: Scratch) -> None:
    """Write the relative velocity of the centres and what the spins add to it."""
    for k in range(motions.velocity1.size):
        scratch.linear[k] = motions.velocity1[k] - motions.velocity2[k]
        scratch.angular[k] = inertia.radius1 * motions.spin1[k] + inertia.radius2 * motions.spin2[k]


@kernel
def contact_velocity(
    normal: Flat, scale: float, scratch: Scratch, status: NDArray[np.int8]
) -> None:
    """Write V_t, V_n and scale |V_t|/V_n of the contact points, and what is wrong with a pair."""
    for i in range(status.size):
        x, y, z = 3 * i, 3 * i + 1, 3 * i + 2
        nx, ny, nz = float(normal[x]), float(normal[y]), float(normal[z])
        skew = nx * nx + ny * ny + nz * nz - 1.0
        unit = 1.0 - skew * (0.5 - 0.375 * skew)  # 1/|n|
        nx, ny, nz = unit * nx, unit * ny, unit * nz
        ux, uy, uz = scratch.linear[x], scratch.linear[y], scratch.linear[z]
        ax, ay, az = scratch.angular[x], scratch.angular[y], scratch.angular[z]
        closing = ux * nx + uy * ny + uz * nz
        tx = ux - closing * nx + ay * nz - az * ny
        ty = uy - closing * ny + az * nx - ax * nz
        tz = uz - closing * nz + ax * ny - ay * nx
        square = tx * tx + ty * ty + tz * tz
        scratch.axis[x], scratch.axis[y], scratch.axis[z] = nx, ny, nz
        scratch.sliding[x], scratch.sliding[y], scratch.sliding[z] = tx, ty, tz
        scratch.closing[i] = closing
        wx, wy, wz = ENLARGED * tx, ENLARGED * ty, ENLARGED * tz
        held = square >= SMALLEST_SQUARE
        root = np.sqrt(square if held else wx * wx + wy * wy + wz * wz)
        root = root if held else root / ENLARGED
        scratch.slope[i] = min(scale * root / closing, LARGEST)
        code = 0 if closing > 0.0 else CollisionStatus.SEPARATING.value
        code = code if abs(skew) <= LARGEST_SKEW else CollisionStatus.NORMAL_NOT_UNIT.value
        finite = abs(closing) + square + abs(skew) < np.inf
        status[i] = code if finite else CollisionStatus.NOT_FINITE.value


@kernel
def impulses(
    inertia: Inertia, restitution: float, scratch: Scratch, status: NDArray[np.int8]
) -> None:
    """Write the impulse J on the second body and n x J; zero where nothing collides."""
    for i in range(status.size):
        x, y, z = 3 * i, 3 * i + 1, 3 * i + 2
        nx, ny, nz = scratch.axis[x], scratch.axis[y], scratch.axis[z]
        tx, ty, tz = scratch.sliding[x], scratch.sliding[y], scratch.sliding[z]
        push = (1.0 + restitution) * inertia.normal_mass * scratch.closing[i]
        drag = inertia.tangential_mass * scratch.fraction[i]
        tx, ty, tz = drag * tx, drag * ty, drag * tz
        hit = status[i] == 0
        scratch.linear[x] = push * nx + tx if hit else 0.0
        scratch.linear[y] = push * ny + ty if hit else 0.0
        scratch.linear[z] = push * nz + tz if hit else 0.0
        scratch.angular[x] = ny * tz - nz * ty if hit else 0.0
        scratch.angular[y] = nz * tx - nx * tz if hit else 0.0
        scratch.angular[z] = nx * ty - ny * tx if hit else 0.0


@kernel
def add(before: Flat, factor: float, change: Array, after: Flat, inplace: bool) -> None:
    """Write before + factor change; where nothing changes not even the sign of a zero does."""
    if not inplace:
        for k in range(after.size):
            after[k] = before[k]
    for k in range(after.size):  # one array only: a loop over two that may be one is not vectorised
        step = factor * change[k]
        after[k] = after[k] + step if step != 0.0 else after[k]


@kernel
def part(motions: Motions, low: int, high: int) -> Motions:
    """Return the motions of some of the pairs."""
    a, b = 3 * low, 3 * high
    return Motions(
        motions.velocity1[a:b], motions.spin1[a:b], motions.velocity2[a:b], motions.spin2[a:b]
    )


@kernel
def meet(
    before: Motions,
    normal: Flat,
    inertia: Inertia,
    scale: float,
    scratch: Scratch,
    status: NDArray[np.int8],
) -> None:
    """Write how bodies meet."""
    approach(before, inertia, scratch)
    contact_velocity(normal, scale, scratch, status)


@kernel
def leave(
    before: Motions,
    inertia: Inertia,
    restitution: float,
    scratch: Scratch,
    after: Motions,
    status: NDArray[np.int8],
    inplace: bool,
) -> None:
    """Write the motions that the impulses leave."""
    impulses(inertia, restitution, scratch, status)
    velocity1, spin1, velocity2, spin2 = inertia.factors
    add(before.velocity1, velocity1, scratch.linear, after.velocity1, inplace)
    add(before.spin1, spin1, scratch.angular, after.spin1, inplace)
    if velocity2 > 0.0:
        add(before.velocity2, velocity2, scratch.linear, after.velocity2, inplace)
        add(before.spin2, spin2, scratch.angular, after.spin2, inplace)


@entry_point("float32", "float64")
def collide_block(
    before: Motions,
    normal: Flat,
    inertia: Inertia,
    rule: Rule,
    scratch: Scratch,
    after: Motions,
    status: Codes,
    inplace: bool,
    start: int,
    stop: int,
) -> None:
    """Write the motions after a block of collisions, chunk by chunk; `after` may be `before`."""
    for low in range(start, stop, CACHE_PAIRS):
        high = min(low + CACHE_PAIRS, stop)
        old, new, code = part(before, low, high), part(after, low, high), status[low:high]
        meet(old, normal[3 * low : 3 * high], inertia, rule.scale, scratch, code)
        one_plus_beta(scratch.slope, high - low, rule, scratch.panel, scratch.fraction)
        leave(old, inertia, rule.restitution, scratch, new, code, inplace)


@entry_point("float32", "float64")
def collide_block_with_plate(
    before: Motions,
    normal: Flat,
    inertia: Inertia,
    plate: PlateRule,
    work: Work,
    record: Record,
    scratch: Scratch,
    after: Motions,
    status: Codes,
    inplace: bool,
    start: int,
    stop: int,
) -> None:
    """Write the same after collisions with a plate, each of which has an e of its own."""
    for low in range(start, stop, CACHE_PAIRS):
        high = min(low + CACHE_PAIRS, stop)
        old, new, code = part(before, low, high), part(after, low, high), status[low:high]
        meet(old, normal[3 * low : 3 * high], inertia, plate.scale, scratch, code)
        rebounds(plate, work, record, scratch.slope, scratch.closing, scratch.fraction, code)
        leave(old, inertia, 0.0, scratch, new, code, inplace)


def collide_all(
    before: Motions,
    normal: Flat,
    inertia: Inertia,
    rule: Rule | PlateRule,
    after: Motions,
    status: NDArray[np.int8],
    threads: int | None,
) -> None:
    """Write the motions after all collisions; the result does not depend on the threads."""

    def block(some: slice) -> None:
        start, stop, scratch = some.start, min(some.stop, status.size), new_scratch()
        result = scratch, after, status, inplace, start, stop
        if isinstance(rule, PlateRule):
            work, record = new_work(), new_record(False)
            collide_block_with_plate(before, normal, inertia, rule, work, record, *result)
        else:
            collide_block(before, normal, inertia, rule, *result)

    inplace = np.may_share_memory(before.velocity1, after.velocity1)
    sizes = (PLATE_BLOCK, CACHE_PAIRS) if isinstance(rule, PlateRule) else (BLOCK, BLOCK)
    in_blocks(block, status.size, *sizes, threads)
