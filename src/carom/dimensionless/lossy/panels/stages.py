"""The normal motion alone: on a panel, to the end of a stage, and as a whole."""

import numpy as np

from carom.dimensionless.lossy.panels import normal
from carom.dimensionless.lossy.panels.collocation import CLOCKS, EVEN, NODES, PLACES, integrate
from carom.dimensionless.lossy.panels.normal import Motion, Stage
from carom.dimensionless.lossy.panels.work import MAX_PANELS, RADIUS, SPEED, Arrays, new_work
from carom.dimensionless.numerics.kernels import entry_point, kernel

MAX_ITERATIONS = 40
SETTLED = 1e-15
CORRECTIONS = 8
AT_END = 1e-13  # a panel that ends so near to the end of its stage ends with it
FARTHEST = 2.0  # times the way to the end of a stage, to first order
SLOPE = 1.89171  # of 1 - e in alpha where it is small, (3/2) B(3/5, 3/2)
NEARLY_ELASTIC, LARGEST = 1.0 - 1e-12, 100.0
LENGTH = 0.1  # of a panel on which the normal motion is good to rounding


@kernel
def solve_normal(work: Arrays, motion: Motion, kind: int, h: float) -> None:
    """Solve for b and v at the nodes, from their values at the first."""
    b, v, rates = work.values[RADIUS], work.values[SPEED], work.rates
    b0, v0 = b[0], v[0]
    pace = normal.edge_rate(motion, b0, v0)
    for j in range(NODES):
        b[j], v[j] = b0 + h * CLOCKS[kind, j] * pace, v0
    for _ in range(MAX_ITERATIONS):
        last_b, last_v = b[NODES - 1], v[NODES - 1]
        for j in range(NODES):
            rates[0, j] = normal.speed_rate(motion, b[j], v[j])
        integrate(kind, v0, h, rates[0], v)
        for j in range(NODES):
            rates[0, j] = normal.edge_rate(motion, b[j], v[j])
        integrate(kind, b0, h, rates[0], b)
        if abs(b[NODES - 1] - last_b) + abs(v[NODES - 1] - last_v) <= SETTLED:
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
    b, v = work.values[RADIUS], work.values[SPEED]
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
        return -b / normal.edge_rate(motion, b, v)
    return -v / normal.speed_rate(motion, b, v)


@kernel
def cut_to_stage(work: Arrays, motion: Motion, kind: int, h: float) -> tuple[float, bool]:
    """Solve for the normal motion on a panel, cut at the end of its stage.

    Return its length, and whether it was cut.
    """
    b, v, last = work.values[RADIUS], work.values[SPEED], NODES - 1
    ahead = until_stage_end(motion, b[0], v[0])
    if ahead > 0.0:  # far beyond the end of a stage its equations mean nothing
        h = min(h, FARTHEST * ahead)
    solve_normal(work, motion, EVEN, h)
    if beyond_stage(motion, b[last], v[last]) < -AT_END:
        if kind != EVEN:
            solve_normal(work, motion, kind, h)
        return h, False
    h *= stage_end(work, motion)
    for _ in range(CORRECTIONS):
        solve_normal(work, motion, kind, h)
        step = until_stage_end(motion, b[last], v[last])
        if abs(step) <= SETTLED:
            break
        h += step
    return h, True


@kernel
def next_stage(work: Arrays, motion: Motion) -> Motion:
    """Return what rules the motion after the loading, whose end the state is put to exactly."""
    work.values[SPEED, 0] = 0.0
    return Motion(Stage.UNLOADING.value, motion.alpha, motion.chi)


@entry_point()
def restitution(alpha: float, work: Arrays) -> float:
    """Return the normal speed after to before, normal motion alone; NaN if without end."""
    values = work.values
    values[RADIUS, 0], values[SPEED, 0] = 0.0, 1.0
    motion = Motion(Stage.LOADING.value, alpha, 1.0)
    for _ in range(MAX_PANELS):
        _, ends = cut_to_stage(work, motion, EVEN, LENGTH)
        for row in (RADIUS, SPEED):
            values[row, 0] = values[row, NODES - 1]
        if ends and motion.stage == Stage.UNLOADING.value:
            return float(-values[SPEED, 0])
        if ends:
            motion = next_stage(work, motion)
    return np.nan


def viscous_loss(wanted: float) -> float:
    """Return alpha, loss time in d_max/V_1, that gives a restitution 0 < e <= 1, to 1e-12 or so.

    >>> from carom.dimensionless.lossy.panels.stages import viscous_loss
    >>> round(viscous_loss(0.9), 10)
    0.0576035799
    """
    from scipy.optimize import brentq

    work = new_work()

    def excess(log_alpha: float) -> float:
        return float(restitution(np.exp(log_alpha), work)) - wanted

    first = (1.0 - wanted) / SLOPE  # e is convex: alpha is larger than this
    if wanted > NEARLY_ELASTIC:
        return first
    low, high = np.log(0.5 * first), np.log(min(4.0 / wanted * first, LARGEST))
    return float(np.exp(brentq(excess, low, high, xtol=1e-14, rtol=1e-14)))
