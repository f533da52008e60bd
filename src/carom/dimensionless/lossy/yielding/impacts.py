"""An impact of yielding spheres, panel after panel from the first touch to the last."""

from carom.dimensionless.elastic.phases import Status
from carom.dimensionless.lossy.panels.collocation import EVEN, NODES, clock, tail
from carom.dimensionless.lossy.panels.newton import Panel
from carom.dimensionless.lossy.panels.normal import Motion, Stage
from carom.dimensionless.lossy.panels.plans import (
    FIRST,
    GROWTH,
    LONGEST,
    NEAR,
    NEAR_FLAT,
    NORMAL_WEIGHT,
    ORDER,
    SAFETY,
    SHORTEST,
    TRIALS,
    Plan,
    revised,
    why_not,
    with_length,
)
from carom.dimensionless.lossy.panels.record import Trace, note_numbers
from carom.dimensionless.lossy.panels.stages import cut_to_stage, next_stage
from carom.dimensionless.lossy.panels.work import MAX_PANELS, MOVED, PSI, SPEED, VALUES, Arrays
from carom.dimensionless.lossy.yielding.events import first_change
from carom.dimensionless.lossy.yielding.panels import commit, solve_panel
from carom.dimensionless.lossy.yielding.record import keep
from carom.dimensionless.numerics.arrays import Array
from carom.dimensionless.numerics.kernels import kernel


@kernel
def run(
    psi: float,
    chi: float,
    loss: int,
    parameter: float,
    tolerance: float,
    work: Arrays,
    numbers: Array,
    record: Trace,
) -> tuple[int, int]:
    """Run a whole impact, psi_1 of either sign; return its status and the number of panels."""
    refused = why_not(psi, chi)
    if refused != Status.SOLVED.value:
        return refused, 0
    numbers[:] = 0.0
    work.values[:, 0] = 0.0
    work.values[SPEED, 0], work.values[PSI, 0] = 1.0, psi
    motion = Motion(loss, Stage.LOADING.value, parameter, 1.0, chi)
    pieces, natural, from_change = 0, FIRST, False
    for number in range(MAX_PANELS):
        plan = Plan(natural, EVEN, natural, from_change, 0, False, False, 0.0)
        plan, error = solved_panel(work, motion, number, pieces, plan, tolerance * (1.0 + abs(psi)))
        if error < 0.0:
            return Status.UNRESOLVED.value, number
        panel = Panel(number, plan.clock, plan.length, pieces)
        if record.rows.shape[0] > 0:
            keep(work, motion, panel, numbers, record)
        note_numbers(work, motion, panel, numbers)
        pieces = commit(work, motion, panel)
        for row in range(VALUES):
            work.values[row, 0] = work.values[row, NODES - 1]
        if plan.to_stage_end and motion.stage == Stage.UNLOADING.value:
            return Status.SOLVED.value, number + 1
        from_change, natural = plan.change != 0 or plan.to_stage_end, plan.natural
        if plan.to_stage_end:
            motion = next_stage(work, motion)
        elif plan.change == 0:
            growth = SAFETY * (tolerance / (error + 1e-18)) ** (1.0 / ORDER)
            natural = min(LONGEST, plan.length * min(GROWTH, growth))
    return Status.UNRESOLVED.value, MAX_PANELS


@kernel
def solved_panel(
    work: Arrays, motion: Motion, number: int, pieces: int, plan: Plan, tolerance: float
) -> tuple[Plan, float]:
    """Solve the next panel, cut where the structure changes; return how, and its error.

    The error is negative if it cannot be solved.
    """
    series, before = work.series[number], Panel(number, EVEN, 0.0, pieces)
    for _ in range(TRIALS):
        h, ends = cut_to_stage(work, motion, plan.clock, plan.length)
        plan = with_length(plan, h, plan.natural, plan.change, ends)
        panel = Panel(number, plan.clock, plan.length, pieces)
        if not solve_panel(work, motion, panel, before):
            half = 0.5 * plan.length
            plan = with_length(plan, half, half, 0, False)
            before = Panel(number, EVEN, 0.0, pieces)
            continue
        before = panel
        change = first_change(work, motion, panel)
        near = NEAR if plan.clock == EVEN else NEAR_FLAT
        part = clock(plan.clock, change) if change < 1.0 else 1.0
        if part < 1.0 - near and plan.length > SHORTEST:
            plan = with_length(plan, plan.length * part, plan.natural, 1, False)
            continue
        error = max(tail(series[PSI]), tail(series[MOVED]))
        error = max(error, NORMAL_WEIGHT * tail(series[SPEED]) * (1.0 + abs(series[PSI, 0])))
        if error <= tolerance or plan.length <= SHORTEST:
            return plan, error
        plan = revised(plan, error, tolerance)
    return plan, -1.0
