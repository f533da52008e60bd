"""A viscoelastic impact, panel after panel from the first touch to the last."""

import numpy as np
from numpy.typing import NDArray

from carom.dimensionless.elastic.phases import Status
from carom.dimensionless.lossy.collocation import EVEN, NODES, clock, tail
from carom.dimensionless.lossy.impacts import (
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
from carom.dimensionless.lossy.memory import LAID, MAX_PIECES, MOVED
from carom.dimensionless.lossy.normal import Loss, Motion, Stage
from carom.dimensionless.lossy.panels import Panel, state_at_node
from carom.dimensionless.lossy.rebounds import TOLERANCE
from carom.dimensionless.lossy.stages import cut_to_stage, next_stage, restitution
from carom.dimensionless.lossy.work import (
    LAID_RADIUS,
    MAX_PANELS,
    PSI,
    SPEED,
    TIME,
    VALUES,
    Arrays,
    new_work,
)
from carom.dimensionless.numerics.arrays import Array, Codes, Vector
from carom.dimensionless.numerics.kernels import entry_point, kernel
from carom.dimensionless.viscoelastic.changes import begin, commit
from carom.dimensionless.viscoelastic.events import BEGINS, NOTHING, first_event
from carom.dimensionless.viscoelastic.memory import row_of
from carom.dimensionless.viscoelastic.panels import solve_panel
from carom.dimensionless.viscoelastic.ring import RETURNS, SLIPS, STICKS, ring_of, set_ring

AFTER_EVENT = 0.02  # length at least tried after an event
HALF, STOPPED = 1e-4, 4e-9  # about chi = 1/2; the speed at which a stick phase has lasted to v = 0


def viscoelastic_rebounds(
    psi: Array, chi: Array, alpha: Array, tolerance: float = TOLERANCE
) -> tuple[Array, NDArray[np.int8]]:
    """Return psi_2 of impacts, NaN where the status is not SOLVED, and the status of each.

    >>> import numpy as np
    >>> from carom.dimensionless.viscoelastic.impacts import viscoelastic_rebounds
    >>> psi, chi, alpha = np.array([1.5, 9.0]), np.array([1.44, 1.44]), np.full(2, 0.0576035799)
    >>> viscoelastic_rebounds(psi, chi, alpha)[0].round(6)  # e = 0.9
    array([-0.366922,  3.528   ])
    """
    psi_out, status = np.empty(psi.size), np.empty(psi.size, dtype=np.int8)
    fill(psi, chi, alpha, tolerance, new_work(), psi_out, status)
    return psi_out, status


@kernel
def run(psi: float, chi: float, alpha: float, tolerance: float, work: Arrays) -> tuple[int, int]:
    """Run a whole impact, psi_1 >= 0; return its status and the number of panels.

    At the end psi_2 is in the first column of the values.
    """
    refused = why_not(psi, chi)
    if refused != Status.SOLVED.value:
        return refused, 0
    work.values[:, 0] = 0.0
    work.values[SPEED, 0], work.values[PSI, 0] = 1.0, psi
    slips = psi > 1.0 or (psi == 1.0 and chi <= 0.5)
    set_ring(work, SLIPS if slips else STICKS, 1 if slips else 0, 0)
    motion = Motion(Loss.VISCOUS.value, Stage.LOADING.value, alpha, 1.0, chi)
    pieces, natural, from_change = 0, FIRST, False
    for number in range(MAX_PANELS):
        plan = Plan(natural, EVEN, natural, from_change, NOTHING, False, False, 0.0)
        plan, error = solved_panel(work, motion, number, pieces, plan, tolerance * (1.0 + psi))
        if error < 0.0 or pieces > MAX_PIECES // 2:
            return Status.UNRESOLVED.value, number
        pieces = commit(work, motion, Panel(number, plan.clock, plan.length, pieces), plan.change)
        for row in range(VALUES):
            work.values[row, 0] = work.values[row, NODES - 1]
        if goes_back(work, motion, plan):
            psi_out = -psi * restitution(motion.loss, alpha, work)
            work.values[PSI, 0] = psi_out
            return Status.SOLVED.value, number + 1
        if plan.to_stage_end and motion.stage == Stage.UNLOADING.value:
            return Status.SOLVED.value, number + 1
        from_change = plan.change != NOTHING or plan.to_stage_end
        natural = max(plan.natural, AFTER_EVENT)
        if plan.to_stage_end:
            motion = next_stage(work, motion)
            pieces = unload(work, motion, pieces)
        elif plan.change == NOTHING:
            growth = SAFETY * (tolerance * (1.0 + psi) / (error + 1e-18)) ** (1.0 / ORDER)
            natural = min(LONGEST, plan.length * min(GROWTH, growth))
    return Status.UNRESOLVED.value, MAX_PANELS


@kernel
def goes_back(work: Arrays, motion: Motion, plan: Plan) -> bool:
    """Tell whether the impact goes back as it came: for chi = 1/2 psi stays in proportion to v."""
    all_stuck = plan.change == BEGINS or (plan.to_stage_end and ring_of(work).mode == STICKS)
    return bool(all_stuck and abs(motion.chi - 0.5) < HALF and work.values[SPEED, 0] < STOPPED)


@kernel
def unload(work: Arrays, motion: Motion, pieces: int) -> int:
    """Let the edge slip from the turning point on, if all sticks; return the pieces there are."""
    if ring_of(work).mode != STICKS:
        return pieces
    now = state_at_node(work, 0)
    return begin(work, motion, pieces, 1 if now.psi > 0.0 else -1, now, work.values[TIME, 0])


@kernel
def solved_panel(
    work: Arrays, motion: Motion, number: int, pieces: int, plan: Plan, tolerance: float
) -> tuple[Plan, float]:
    """Solve the next panel, cut at the first event; return how, and its error.

    The error is negative if it cannot be solved.
    """
    before = Panel(number, EVEN, 0.0, pieces)
    for _ in range(TRIALS):
        h, ends = cut_to_stage(work, motion, plan.clock, plan.length)
        plan = with_length(plan, h, plan.natural, plan.change, ends)
        panel = Panel(number, plan.clock, plan.length, pieces)
        if not solve_panel(work, motion, panel, before):
            half = 0.5 * plan.length
            plan = with_length(plan, half, half, NOTHING, False)
            before = Panel(number, EVEN, 0.0, pieces)
            continue
        before = panel
        event = first_event(work, motion, panel)
        near = NEAR if plan.clock == EVEN else NEAR_FLAT
        part = clock(plan.clock, event.place) if event.place < 1.0 else 1.0
        if part < 1.0 - near and plan.length > SHORTEST:
            plan = with_length(plan, plan.length * part, plan.natural, event.what, False)
            continue
        error = error_of(work, panel)
        if error <= tolerance or plan.length <= SHORTEST:
            return plan, error
        plan = revised(plan, error, tolerance)
    return plan, -1.0


@kernel
def error_of(work: Arrays, panel: Panel) -> float:
    """Return the error of a solved panel, as the last coefficients of its series tell it."""
    series, ring = work.series[panel.number], ring_of(work)
    error = max(tail(series[PSI]), tail(series[MOVED]))
    error = max(error, NORMAL_WEIGHT * tail(series[SPEED]) * (1.0 + abs(series[PSI, 0])))
    if ring.mode == RETURNS:
        levels = work.values[row_of(ring.sign)]
        error = max(error, tail(series[LAID]), tail(series[row_of(ring.sign)]))
        error = max(error, tail(series[LAID_RADIUS]) * abs(levels[NODES - 1] - levels[0]))
    return float(error)


@entry_point()
def fill(
    psi: Vector,
    chi: Vector,
    alpha: Vector,
    tolerance: float,
    work: Arrays,
    psi_out: Vector,
    status: Codes,
) -> None:
    """Write psi_2 of every impact, NaN unless it is solved, and its status."""
    for i in range(psi.size):
        status[i], _ = run(abs(psi[i]), chi[i], alpha[i], tolerance, work)
        solved = status[i] == Status.SOLVED.value
        psi_out[i] = np.copysign(1.0, psi[i]) * work.values[PSI, 0] if solved else np.nan
