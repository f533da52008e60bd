"""Normal motion of a viscoelastic impact, in units of the elastic one, d_max, V_1, P_max.

Springs bear D - s, D = d + alpha v, without tension. The clock d(tau) = dt/(2 b), with b^2 = s at
the edge of the contact, makes all of it analytic. While loading the edge is where the surfaces
meet, b^2 = d; b' = v, v' = -(5/2) b^2 (b^2 + (3/2) alpha v). While unloading it is where the
springs let go, b^2 = D; b' = v - (5/4) alpha b^3, v' = -(5/2) b^4.
"""

from enum import IntEnum
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from carom.dimensionless.lossy.viscoelastic import work as at
from carom.dimensionless.lossy.viscoelastic.work import EVEN, NODES, PLACES, Arrays, integrate
from carom.dimensionless.numerics.kernels import entry_point, kernel

MOST_ITERATIONS = 40
MOTION_SETTLED = 1e-15
CORRECTIONS = 8
AT_END = 1e-13  # a panel that ends so near to the end of its stage ends with it
FARTHEST_TRY = 2.0  # times the way to the end of a stage, to first order
LOSS_SLOPE = 1.89171  # of 1 - e in alpha where it is small, (3/2) B(3/5, 3/2)
NEARLY_ELASTIC, LARGEST_ALPHA = 1.0 - 1e-12, 100.0
PANEL_LENGTH = 0.1  # on which the normal motion is good to rounding


class Stage(IntEnum):
    """Part of the normal motion that one set of equations rules."""

    LOADING = 0
    UNLOADING = 1


class Motion(NamedTuple):
    """What rules the motion at a time: its stage, and the numbers of the impact."""

    stage: int
    alpha: float
    chi: float


@kernel
def is_shifted(motion: Motion) -> bool:
    """Tell whether the limit is ahead of the edge: while loading."""
    return motion.stage == Stage.LOADING.value


@kernel
def edge_rate(motion: Motion, b: float, v: float) -> float:
    """Return b', which is the speed of the edge, d(b^2)/dt."""
    return v if is_shifted(motion) else v - 1.25 * motion.alpha * b * b * b


@kernel
def speed_rate(motion: Motion, b: float, v: float) -> float:
    """Return v' = -(5/2) b P/P_max."""
    return -2.5 * b * normal_force(motion, b, v)


@kernel
def normal_force(motion: Motion, b: float, v: float) -> float:
    """Return P/P_max, the integral of (3/2) (D - s) over the contact."""
    if is_shifted(motion):
        return b * (b * b + 1.5 * motion.alpha * v)
    return b * b * b


@kernel
def limit(motion: Motion, b: float, v: float) -> float:
    """Return D: springs at s bear D - s."""
    return b * b + motion.alpha * v if is_shifted(motion) else b * b


@kernel
def limit_rate(motion: Motion, b: float, v: float) -> float:
    """Return dD/dt."""
    if is_shifted(motion):
        return v - 1.25 * motion.alpha * b * (b * b + 1.5 * motion.alpha * v)
    return edge_rate(motion, b, v)


@kernel
def stored(b: float, d: float) -> float:
    """Return the elastic energy that is left in the normal springs, in units of m_n V_1^2/2."""
    return b * (1.875 * d * d - b * b * (1.25 * d - 0.375 * b * b))


@kernel
def loss_rate(motion: Motion, b: float, v: float) -> float:
    """Return the rate of viscous loss by the clock, in dashpots and in springs that let go."""
    rate = 7.5 * motion.alpha * v * v * b * b
    if motion.stage == Stage.UNLOADING.value:
        let_go = motion.alpha * v
        rate -= 1.875 * let_go * let_go * edge_rate(motion, b, v)
    return rate


@kernel
def solve_normal(work: Arrays, motion: Motion, kind: int, h: float) -> None:
    """Solve for b and v at the nodes, from their values at the first."""
    b, v, rates = work.values[at.RADIUS], work.values[at.SPEED], work.rates
    b0, v0 = b[0], v[0]
    pace = edge_rate(motion, b0, v0)
    for j in range(NODES):
        b[j], v[j] = b0 + h * at.CLOCKS[kind, j] * pace, v0
    for _ in range(MOST_ITERATIONS):
        last_b, last_v = b[NODES - 1], v[NODES - 1]
        for j in range(NODES):
            rates[0, j] = speed_rate(motion, b[j], v[j])
        integrate(kind, v0, h, rates[0], v)
        for j in range(NODES):
            rates[0, j] = edge_rate(motion, b[j], v[j])
        integrate(kind, b0, h, rates[0], b)
        if abs(b[NODES - 1] - last_b) + abs(v[NODES - 1] - last_v) <= MOTION_SETTLED:
            break


@kernel
def beyond_stage(motion: Motion, b: float, v: float) -> float:
    """Return how far the normal motion is beyond the end of its stage; negative before it."""
    if motion.stage == Stage.UNLOADING.value:
        return -b
    return -v


@kernel
def stage_end(work: Arrays, motion: Motion) -> float:
    """Return the part of a panel with an even clock after which its stage ends, 1 if not in it."""
    last = NODES - 1
    b, v = work.values[at.RADIUS], work.values[at.SPEED]
    beyond = beyond_stage(motion, b[last], v[last])
    if beyond <= 0.0:
        return 1.0
    before = beyond_stage(motion, b[last - 1], v[last - 1])
    for j in range(last - 1, 0, -1):
        before = beyond_stage(motion, b[j], v[j])
        if before <= 0.0:
            near, far = 0.5 * (1.0 + PLACES[j]), 0.5 * (1.0 + PLACES[j + 1])
            return float(near + (far - near) * before / (before - beyond))
        beyond = before
    return float(0.5 * (1.0 + PLACES[1]))


@kernel
def until_stage_end(motion: Motion, b: float, v: float) -> float:
    """Return the clock time to the end of a stage, to first order."""
    if motion.stage == Stage.UNLOADING.value:
        return -b / edge_rate(motion, b, v)
    return -v / speed_rate(motion, b, v)


@kernel
def cut_to_stage(work: Arrays, motion: Motion, kind: int, h: float) -> tuple[float, bool]:
    """Solve the normal motion on a panel; return its length, and whether its stage cuts it."""
    b, v, last = work.values[at.RADIUS], work.values[at.SPEED], NODES - 1
    ahead = until_stage_end(motion, b[0], v[0])
    if ahead > 0.0:  # far beyond the end of a stage its equations mean nothing
        h = min(h, FARTHEST_TRY * ahead)
    solve_normal(work, motion, EVEN, h)
    if beyond_stage(motion, b[last], v[last]) < -AT_END:
        if kind != EVEN:
            solve_normal(work, motion, kind, h)
        return h, False
    h *= stage_end(work, motion)
    for _ in range(CORRECTIONS):
        solve_normal(work, motion, kind, h)
        step = until_stage_end(motion, b[last], v[last])
        if abs(step) <= MOTION_SETTLED:
            break
        h += step
    return h, True


@kernel
def next_stage(work: Arrays, motion: Motion) -> Motion:
    """Return what rules the motion after the loading, whose end the state is put to exactly."""
    work.values[at.SPEED, 0] = 0.0
    return Motion(Stage.UNLOADING.value, motion.alpha, motion.chi)


@entry_point()
def restitution(alpha: float, work: Arrays) -> float:
    """Return the normal speed after to before, normal motion alone; NaN if without end."""
    values = work.values
    values[at.RADIUS, 0], values[at.SPEED, 0] = 0.0, 1.0
    motion = Motion(Stage.LOADING.value, alpha, 1.0)
    for _ in range(at.MAX_PANELS):
        _, ends = cut_to_stage(work, motion, EVEN, PANEL_LENGTH)
        for row in (at.RADIUS, at.SPEED):
            values[row, 0] = values[row, NODES - 1]
        if ends and motion.stage == Stage.UNLOADING.value:
            return float(-values[at.SPEED, 0])
        if ends:
            motion = next_stage(work, motion)
    return np.nan


@lru_cache(4096)
def viscous_loss(wanted: float) -> float:
    """Return alpha, the loss time in d_max/V_1 that gives a restitution 0 < e <= 1, to 1e-12."""
    from scipy.optimize import brentq

    work = at.new_work()

    def excess(log_alpha: float) -> float:
        return float(restitution(np.exp(log_alpha), work)) - wanted

    first = (1.0 - wanted) / LOSS_SLOPE  # e is convex: alpha is larger than this
    if wanted > NEARLY_ELASTIC:
        return first
    low, high = np.log(0.5 * first), np.log(min(4.0 / wanted * first, LARGEST_ALPHA))
    return float(np.exp(brentq(excess, low, high, xtol=1e-14, rtol=1e-14)))
