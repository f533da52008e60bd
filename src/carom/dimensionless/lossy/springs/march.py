"""An impact marched over springs, step by step: kick, stretch, kick.

    U' = psi,  psi' = -(15/4) chi Q,  Q = integral of f dx over 0 <= x <= b,

f that of springs in shear (see stretch), whose Coulomb limit is what they bear in compression
(see thornton, relaxing). Of second order in the number of springs.
"""

import numpy as np

from carom.dimensionless.lossy import layout
from carom.dimensionless.lossy.law import Loss, LossNumbers
from carom.dimensionless.lossy.springs import record, relaxing, thornton
from carom.dimensionless.lossy.springs.stretch import step_of, stretched
from carom.dimensionless.lossy.springs.work import (
    DEPTH,
    EDGE,
    FORCE,
    LIMIT,
    LOAD,
    LONGEST,
    LOSING,
    LOST,
    MOVED,
    NEXT,
    PER_SPRING,
    PSI,
    RATE,
    RELAXING,
    SPEED,
    TIME,
    WEIGHT,
    Arrays,
    U,
    X,
    lay_springs,
    rim,
)
from carom.dimensionless.numerics.arrays import Array
from carom.dimensionless.numerics.kernels import kernel

NEVER = 1e300  # relaxation time of an elastic solid


@kernel
def march(
    psi: float, chi: float, law: LossNumbers, count: int, work: Arrays, rows: Array, numbers: Array
) -> int:
    """March an impact over so many springs; return the number of steps, 0 if it does not end."""
    per_spring, motion, springs, state = steps_of(law.loss), work.motion, work.springs, work.state
    loading = per_spring * count
    h = lay_motion(law, loading, motion)
    lay_springs(motion, per_spring, count, springs)
    state[:] = 0.0
    state[PSI], touching = psi, 0
    if rows.shape[0] > 0:
        record.keep_touch(psi, rows[0])
    for i in range(LONGEST * loading):
        met = touching
        if i == loading and law.loss == Loss.PLASTIC.value:
            state[FORCE] = thornton.turn(motion[i], springs, count)
        touching = press(law, i, loading, h, motion, springs, count, touching)
        let_go(springs, touching, met, chi, law.extra, state)
        kick_and_stretch(law, chi, motion[i], motion[i + 1], springs, touching, state)
        if rows.shape[0] > 0:
            keep(law, i, loading, motion, springs, touching, state, rows)
        if touching == 0:
            note(motion, loading, i + 1, state, numbers)
            return i + 1
    return 0


@kernel
def steps_of(loss: int) -> int:
    """Return the steps of the loading to a spring: more where the normal motion is marched, too."""
    return 1 if loss == Loss.PLASTIC.value else PER_SPRING


@kernel
def lay_motion(law: LossNumbers, loading: int, motion: Array) -> float:
    """Fill in the loading, of a yielding sphere the whole motion; return a step of the clock."""
    if law.loss == Loss.PLASTIC.value:
        thornton.lay_motion(law.parameter, loading, motion)
        return 0.0
    return relaxing.lay_loading(law.extra, law.parameter, loading, motion)


@kernel
def press(
    law: LossNumbers,
    i: int,
    loading: int,
    h: float,
    motion: Array,
    springs: Array,
    last: int,
    touching: int,
) -> int:
    """Fill in what springs bear before and after a step; return how many do after it."""
    before, after = motion[i], motion[i + 1]
    still = i * last // loading + 1 if i < loading else touching
    if law.loss != Loss.PLASTIC.value:
        if i >= loading:
            still = relaxing.unload(law.extra, law.parameter, h, before, after, springs, last)
            if still == 0:
                relaxing.end(before, after, springs)
            return still
        relaxing.press(law.extra, law.parameter, before, after, springs, still)
        return still
    shrunk = 0.0
    if i >= loading:
        shrunk = motion[loading, LOAD] / motion[loading, EDGE] ** 3
    thornton.press(law.parameter, before, after, shrunk, springs, still)
    return int(np.searchsorted(springs[X, :still], after[EDGE]))


@kernel
def let_go(springs: Array, touching: int, met: int, chi: float, extra: float, state: Array) -> None:
    """Count as lost what springs hold whose contact ends; both branches bear nothing together."""
    for j in range(touching, met):
        u, m = springs[U, j], springs[RELAXING, j]
        if extra > 0.0:
            state[LOST] += 1.875 * chi * springs[WEIGHT, j] * (u * u + extra * m * m)


@kernel
def kick_and_stretch(
    law: LossNumbers,
    chi: float,
    before: Array,
    after: Array,
    springs: Array,
    touching: int,
    state: Array,
) -> None:
    """Move the tangential state on by a step."""
    g, dt = law.extra, after[TIME] - before[TIME]
    theta = law.parameter if g > 0.0 else NEVER
    rate = -3.75 * chi * state[FORCE]
    half = state[PSI] + 0.5 * dt * rate
    step = step_of(g, theta, dt, state[PSI], half, rate)
    force, losing = 0.0, 0.0
    for j in range(touching):
        limits = springs[LIMIT, j], springs[NEXT, j], springs[RATE, j]
        u, m = stretched(springs[U, j], springs[RELAXING, j], *limits, step)
        springs[U, j], springs[RELAXING, j] = u, m
        weight = springs[WEIGHT, j]
        if j == touching - 1:
            weight += rim(springs, j, after[EDGE])
        force += weight * (u + g * m)
        losing += weight * m * m
    losing *= g / theta
    state[PSI], state[MOVED] = half - 0.5 * dt * 3.75 * chi * force, state[MOVED] + half * dt
    state[LOST] += 1.875 * chi * dt * (state[LOSING] + losing)
    state[FORCE], state[LOSING] = force, losing


@kernel
def keep(
    law: LossNumbers,
    i: int,
    loading: int,
    motion: Array,
    springs: Array,
    touching: int,
    state: Array,
    rows: Array,
) -> None:
    """Keep a row after a step, before the first the row of the touch."""
    now, row, turned = motion[i + 1], rows[i + 1], motion[loading]
    if law.loss != Loss.PLASTIC.value:
        stored = relaxing.stored(law.extra, now[EDGE], springs, touching)
    elif i < loading:
        stored = thornton.stored(now[DEPTH], now[LOAD])
    else:
        stored = thornton.stored(turned[DEPTH], turned[LOAD]) - now[SPEED] ** 2
    record.keep_normal(now, stored, row)
    record.keep_tangential(state, row)
    record.keep_springs(springs, touching, now[EDGE], law.extra, row)


@kernel
def note(motion: Array, loading: int, steps: int, state: Array, numbers: Array) -> None:
    """Note what the impact came to."""
    end, turned = motion[steps], motion[loading]
    numbers[layout.PSI_OUT], numbers[layout.RESTITUTION] = state[PSI], -end[SPEED]
    numbers[layout.TIME], numbers[layout.PENETRATION] = end[TIME], end[DEPTH]
    numbers[layout.LOST], numbers[layout.SHEAR_LOST] = 1.0 - end[SPEED] ** 2, state[LOST]
    numbers[layout.DEEPEST], numbers[layout.WIDEST] = turned[DEPTH], turned[EDGE]
    numbers[layout.STRONGEST] = 0.0
    for i in range(steps):
        numbers[layout.STRONGEST] = max(numbers[layout.STRONGEST], motion[i, LOAD])
