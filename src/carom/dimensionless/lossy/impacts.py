"""An impact with normal losses, panel after panel from the first touch to the last."""

import numpy as np

from carom.dimensionless._jit import kernel
from carom.dimensionless.lossy import normal
from carom.dimensionless.lossy.collocation import (
    EVEN,
    FLAT_END,
    FLAT_ENDS,
    FLAT_START,
    NODES,
    clock,
    tail,
)
from carom.dimensionless.lossy.events import beyond_stage, first_change, stage_end
from carom.dimensionless.lossy.memory import MOVED, RADIUS
from carom.dimensionless.lossy.normal import Loss, Motion, Stage
from carom.dimensionless.lossy.panels import (
    MAX_PANELS,
    PSI,
    SPEED,
    Panel,
    Work,
    commit,
    solve_normal,
    solve_panel,
)

FIRST, LONGEST, SHORTEST = 0.3, 0.8, 1e-8
TRIALS = 40
NEAR, NEAR_FLAT = 1e-9, 1e-5  # part of a panel: a change so near its end is its end
ORDER = 9.0


@kernel
def shortened_to_stage(work: Work, motion: Motion, kind: int, h: float) -> tuple[float, bool]:
    """Return the length of a panel, cut at the end of its stage, and whether it was; solve it."""
    solve_normal(work, motion, EVEN, h)
    if beyond_stage(motion, work.values[RADIUS, NODES - 1], work.values[SPEED, NODES - 1]) < 0.0:
        if kind != EVEN:
            solve_normal(work, motion, kind, h)
        return h, False
    h *= stage_end(work, motion)
    for _ in range(8):
        solve_normal(work, motion, kind, h)
        b, v = work.values[RADIUS, NODES - 1], work.values[SPEED, NODES - 1]
        if motion.stage == Stage.UNLOADING.value:
            step = -b / normal.edge_rate(motion, b, v)
        elif motion.loss == Loss.PLASTIC.value and motion.stage == Stage.LOADING.value:
            step = (motion.parameter - b) / v
        else:
            step = -v / normal.speed_rate(motion, b, v)
        if abs(step) <= 1e-15:
            break
        h += step
    return h, True


@kernel
def run(
    psi: float, chi: float, loss: int, parameter: float, tolerance: float, work: Work, log: np.ndarray
) -> int:
    """Run a whole impact; its last state is left at the last node. Return the number of panels."""
    values = work.values
    values[:, 0] = 0.0
    values[SPEED, 0], values[PSI, 0] = 1.0, psi
    motion = Motion(loss, Stage.LOADING.value, parameter, 1.0, chi)
    pieces, natural, after_change = 0, FIRST, False
    for number in range(MAX_PANELS):
        h, kind, to_change = natural, EVEN, False
        flat_failed, even_error = False, 0.0
        for _ in range(TRIALS):
            h, ends = shortened_to_stage(work, motion, kind, h)
            panel = Panel(number, kind, h, pieces)
            settled = solve_panel(work, motion, panel)
            log[4] += 1
            if not settled:
                h, natural, to_change = 0.5 * h, 0.5 * h, False
                continue
            change = first_change(work, motion, panel)
            near = NEAR if kind == EVEN else NEAR_FLAT
            if change < 1.0 and clock(kind, change) < 1.0 - near and h > SHORTEST:
                h, to_change = h * clock(kind, change), True
                continue
            series = work.series[number]
            error = max(tail(series[PSI]), tail(series[MOVED])) / (1.0 + abs(psi))
            if error <= tolerance or h <= SHORTEST:
                break
            if kind == EVEN and (after_change or to_change) and not flat_failed:
                kind = (FLAT_START if after_change else 0) + (FLAT_END if to_change else 0)
                even_error = error
                continue
            if kind != EVEN and error > even_error:
                flat_failed, kind, error = True, EVEN, even_error
            h *= max(0.2, 0.8 * (tolerance / error) ** (1.0 / ORDER))
            natural, to_change = h, False
            if kind == FLAT_END or kind == FLAT_ENDS:
                kind -= FLAT_END
        else:
            return -1
        pieces = commit(work, motion, panel)
        values[:, 0] = values[:, NODES - 1]
        after_change = to_change
        if not (to_change or ends):
            natural = min(LONGEST, h * min(4.0, 0.8 * (tolerance / (error + 1e-18)) ** (1.0 / ORDER)))
        if ends:
            after_change = True
            if motion.stage == Stage.UNLOADING.value:
                log[0], log[1], log[2], log[3] = values[PSI, 0], values[SPEED, 0], values[MOVED, 0], pieces
                return number + 1
            motion, after_change = next_stage(work, motion), True
    return -1


@kernel
def next_stage(work: Work, motion: Motion) -> Motion:
    """Return what rules the motion after a stage, whose end the state is put to exactly."""
    loss, stage, parameter, _, chi = motion
    if loss == Loss.PLASTIC.value and stage == Stage.LOADING.value:
        if work.values[SPEED, 0] > 1e-12:
            work.values[RADIUS, 0] = parameter
            return Motion(loss, Stage.YIELDING.value, parameter, 1.0, chi)
    work.values[SPEED, 0] = 0.0
    growth = normal.released_growth(motion, work.values[RADIUS, 0])
    return Motion(loss, Stage.UNLOADING.value, parameter, growth, chi)
