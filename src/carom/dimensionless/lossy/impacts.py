"""An impact with normal losses, panel after panel from the first touch to the last."""

from typing import NamedTuple

import numpy as np

from carom.dimensionless.elastic.phases import Status
from carom.dimensionless.lossy.collocation import (
    EVEN,
    FLAT_END,
    FLAT_ENDS,
    FLAT_START,
    NODES,
    clock,
    tail,
)
from carom.dimensionless.lossy.events import first_change
from carom.dimensionless.lossy.memory import MOVED
from carom.dimensionless.lossy.normal import Motion, Stage
from carom.dimensionless.lossy.panels import Panel, commit, solve_panel
from carom.dimensionless.lossy.record import Trace, note_panel
from carom.dimensionless.lossy.stages import cut_to_stage, next_stage
from carom.dimensionless.lossy.work import MAX_PANELS, PSI, SPEED, VALUES, Arrays
from carom.dimensionless.numerics.arrays import Array
from carom.dimensionless.numerics.kernels import kernel

FIRST, LONGEST, SHORTEST = 0.3, 0.8, 1e-8  # lengths of panels
TRIALS = 60  # of a panel
NEAR, NEAR_FLAT = 1e-9, 1e-5  # part of a panel: a change so near its end is its end
LARGEST_CHI = 1000.0  # beyond, few impacts are solved, and sliding begins above `rebounds.FAR`
ORDER = 9.0  # of the error of a panel in its length, about
NORMAL_WEIGHT = 30.0  # of the error of the normal motion, which is cheap to keep small
SAFETY, STEEPEST, GROWTH = 0.8, 0.2, 4.0


class Plan(NamedTuple):
    """How a panel is to be solved: its length, its clock, and what lies at either end of it.

    `change` is what happens at its end, 0 if nothing does.
    """

    length: float
    clock: int
    natural: float  # length that accuracy alone would allow
    from_change: bool
    change: int
    to_stage_end: bool
    flat_is_worse: bool
    error: float  # with an even clock


@kernel
def with_length(plan: Plan, h: float, natural: float, change: int, to_end: bool) -> Plan:
    """Return a plan with another length and end."""
    return Plan(
        h, plan.clock, natural, plan.from_change, change, to_end, plan.flat_is_worse, plan.error
    )


@kernel
def with_clock(plan: Plan, kind: int, flat_is_worse: bool, error: float) -> Plan:
    """Return a plan with another clock."""
    return Plan(
        plan.length,
        kind,
        plan.natural,
        plan.from_change,
        plan.change,
        plan.to_stage_end,
        flat_is_worse,
        error,
    )


@kernel
def revised(plan: Plan, error: float, tolerance: float) -> Plan:
    """Return how to try again after too large an error: with a flat clock once, or shorter."""
    rooted = plan.from_change or plan.change != 0
    if plan.clock == EVEN and rooted and not plan.flat_is_worse:
        kind = (FLAT_START if plan.from_change else 0) + (FLAT_END if plan.change != 0 else 0)
        return with_clock(plan, kind, False, error)
    if plan.clock != EVEN and error > plan.error:
        error = plan.error
        plan = with_clock(plan, EVEN, True, error)
    elif plan.clock == FLAT_END or plan.clock == FLAT_ENDS:
        plan = with_clock(plan, plan.clock - FLAT_END, plan.flat_is_worse, error)
    h = plan.length * max(STEEPEST, SAFETY * (tolerance / error) ** (1.0 / ORDER))
    return with_length(plan, h, h, 0, False)


@kernel
def why_not(psi: float, chi: float) -> int:
    """Return the status of an impact that cannot be run, SOLVED if it can."""
    if not np.isfinite(psi):
        return Status.PSI_NOT_FINITE.value
    if not (0.0 < chi < np.inf):
        return Status.CHI_NOT_POSITIVE.value
    return Status.TOO_MANY_PHASES.value if chi > LARGEST_CHI else Status.SOLVED.value


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
        note_panel(work, motion, panel, numbers, record)
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
