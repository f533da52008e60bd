"""A viscoelastic impact, panel after panel from the first touch to the last."""

from carom.dimensionless.elastic.phases import Status
from carom.dimensionless.lossy.law import why_not
from carom.dimensionless.lossy.panels.collocation import EVEN, NODES, clock, tail
from carom.dimensionless.lossy.panels.newton import Panel, state_at_node
from carom.dimensionless.lossy.panels.normal import Motion, Stage
from carom.dimensionless.lossy.panels.pieces import MAX_PIECES
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
    with_length,
)
from carom.dimensionless.lossy.panels.record import Trace, note_numbers
from carom.dimensionless.lossy.panels.stages import cut_to_stage, next_stage
from carom.dimensionless.lossy.panels.work import (
    LAID,
    LAID_RADIUS,
    MAX_PANELS,
    MOVED,
    PSI,
    SPEED,
    TIME,
    VALUES,
    Arrays,
)
from carom.dimensionless.lossy.viscoelastic.changes import begin, commit
from carom.dimensionless.lossy.viscoelastic.events import NOTHING, first_event
from carom.dimensionless.lossy.viscoelastic.memory import row_of
from carom.dimensionless.lossy.viscoelastic.panels import solve_panel
from carom.dimensionless.lossy.viscoelastic.record import keep, note_shear
from carom.dimensionless.lossy.viscoelastic.ring import (
    RATIO,
    RETRACES,
    RETURNS,
    SLIPS,
    STICKS,
    ring_of,
    set_ring,
)
from carom.dimensionless.numerics.arrays import Array, Vector
from carom.dimensionless.numerics.kernels import entry_point, kernel

NEVER = -1  # instead of a panel
AFTER_EVENT = 0.02  # length at least tried after an event
HALF, STOPPED = 1e-4, 4e-9  # about chi = 1/2; the speed at which a stick phase has lasted to v = 0


@kernel
def run(
    psi: float,
    chi: float,
    alpha: float,
    tolerance: float,
    until: int,
    work: Arrays,
    numbers: Array,
    record: Trace,
) -> tuple[int, int]:
    """Run an impact, psi_1 >= 0; return its status and the number of panels.

    It ends with the contact; or in the panel `until`, which is left as it was solved, and returns
    how many pieces of memory that finds.
    """
    refused = why_not(psi, chi)
    if refused != Status.SOLVED.value:
        return refused, 0
    numbers[:] = 0.0
    work.values[:, 0], work.ring[:] = 0.0, 0.0
    work.values[SPEED, 0], work.values[PSI, 0] = 1.0, psi
    slips = psi > 1.0 or (psi == 1.0 and chi <= 0.5)
    set_ring(work, SLIPS if slips else STICKS, 1 if slips else 0, 0)
    motion = Motion(Stage.LOADING.value, alpha, chi)
    pieces, natural, from_change = 0, FIRST, False
    for number in range(MAX_PANELS):
        plan = Plan(natural, EVEN, natural, from_change, NOTHING, False, False, 0.0)
        plan, error = solved_panel(work, motion, number, pieces, plan, tolerance * (1.0 + psi))
        if error < 0.0 or pieces > MAX_PIECES // 2:
            return Status.UNRESOLVED.value, number
        panel = Panel(number, plan.clock, plan.length, pieces)
        if number == until:
            return Status.SOLVED.value, pieces
        if record.rows.shape[0] > 0:
            keep(work, motion, panel, numbers, record)
        else:
            note_shear(work, motion, panel, numbers)
        note_numbers(work, motion, panel, numbers)
        if goes_back(work, motion, plan):
            set_ring(work, RETRACES, 0, 0)
            work.ring[RATIO], pieces = psi, 0
        else:
            pieces = commit(work, motion, panel, plan.change)
        for row in range(VALUES):
            work.values[row, 0] = work.values[row, NODES - 1]
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
    stops = motion.stage == Stage.LOADING.value and work.values[SPEED, NODES - 1] < STOPPED
    return bool(stops and abs(motion.chi - 0.5) < HALF and ring_of(work).mode == STICKS)


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
        mode, error = ring_of(work).mode, error_of(work, panel)
        is_smooth = mode == STICKS or mode == SLIPS  # beyond an event, too
        if is_smooth and error > tolerance and plan.length > SHORTEST:
            plan = revised(with_length(plan, h, h, NOTHING, False), error, tolerance)
            continue
        event = first_event(work, motion, panel)
        near = NEAR if plan.clock == EVEN else NEAR_FLAT
        part = clock(plan.clock, event.place) if event.place < 1.0 else 1.0
        if part < 1.0 - near and plan.length > SHORTEST:
            plan = with_length(plan, plan.length * part, plan.natural, event.what, False)
            continue
        if event.what != NOTHING:
            plan = with_length(plan, plan.length, plan.natural, event.what, plan.to_stage_end)
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
def run_until(
    psi: float,
    chi: float,
    alpha: float,
    tolerance: float,
    until: int,
    work: Arrays,
    numbers: Vector,
    record: Trace,
) -> int:
    """Run an impact up to a panel, left as it was solved; return the pieces that it finds."""
    return run(psi, chi, alpha, tolerance, until, work, numbers, record)[1]
