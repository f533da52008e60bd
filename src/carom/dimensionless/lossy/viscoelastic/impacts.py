"""A viscoelastic impact, panel after panel from the first touch to the last."""

from typing import NamedTuple

from carom.dimensionless.elastic.phases import Status
from carom.dimensionless.lossy.law import why_not
from carom.dimensionless.lossy.panels import collocation, work as at
from carom.dimensionless.lossy.panels.collocation import EVEN, NODES, clock, tail
from carom.dimensionless.lossy.panels.normal import Motion, Stage
from carom.dimensionless.lossy.panels.stages import cut_to_stage, next_stage
from carom.dimensionless.lossy.panels.work import Arrays, Panel, state_at_node
from carom.dimensionless.lossy.viscoelastic.events import NOTHING, begin, commit, first_event
from carom.dimensionless.lossy.viscoelastic.memory import row_of
from carom.dimensionless.lossy.viscoelastic.panels import solve_panel
from carom.dimensionless.lossy.viscoelastic.record import Trace, keep, note_numbers, note_shear
from carom.dimensionless.lossy.viscoelastic.ring import Mode, ring_of, set_ring
from carom.dimensionless.numerics.arrays import Array, Vector
from carom.dimensionless.numerics.kernels import entry_point, kernel

FIRST, LONGEST, SHORTEST = 0.3, 0.8, 1e-8  # lengths of panels
TOLERANCE = 1e-9  # of a panel; keeps psi_2 to 1e-8 max(1, |psi_1|)
TRIALS = 60  # of a panel
NEAR, NEAR_FLAT = 1e-9, 1e-5  # part of a panel: a change so near its end is its end
ORDER = 9.0  # of the error of a panel in its length, about
NORMAL_WEIGHT = 30.0  # of the error of the normal motion, which is cheap to keep small
SAFETY, STEEPEST, GROWTH = 0.8, 0.2, 4.0
NEVER = -1  # instead of a panel
AFTER_EVENT = 0.02  # length at least tried after an event
HALF, STOPPED = 1e-4, 4e-9  # about chi = 1/2; the speed at which a stick phase has lasted to v = 0


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
    work.values[at.SPEED, 0], work.values[at.PSI, 0] = 1.0, psi
    slips = psi > 1.0 or (psi == 1.0 and chi <= 0.5)
    set_ring(work, Mode.SLIPS.value if slips else Mode.STICKS.value, 1 if slips else 0, 0)
    motion = Motion(Stage.LOADING.value, alpha, chi)
    pieces, natural, from_change = 0, FIRST, False
    for number in range(at.MAX_PANELS):
        plan = Plan(natural, EVEN, natural, from_change, NOTHING, False, False, 0.0)
        plan, error = solved_panel(work, motion, number, pieces, plan, tolerance * (1.0 + psi))
        if error < 0.0 or pieces > at.MAX_PIECES // 2:
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
            set_ring(work, Mode.RETRACES.value, 0, 0)
            work.ring[at.RATIO], pieces = psi, 0
        else:
            pieces = commit(work, motion, panel, plan.change)
        for row in range(at.VALUES):
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
    return Status.UNRESOLVED.value, at.MAX_PANELS


@kernel
def goes_back(work: Arrays, motion: Motion, plan: Plan) -> bool:
    """Tell whether the impact goes back as it came: for chi = 1/2 psi stays in proportion to v."""
    stops = motion.stage == Stage.LOADING.value and work.values[at.SPEED, NODES - 1] < STOPPED
    return bool(stops and abs(motion.chi - 0.5) < HALF and ring_of(work).mode == Mode.STICKS)


@kernel
def unload(work: Arrays, motion: Motion, pieces: int) -> int:
    """Let the edge slip from the turning point on, if all sticks; return the pieces there are."""
    if ring_of(work).mode != Mode.STICKS:
        return pieces
    now = state_at_node(work, 0)
    return begin(work, motion, pieces, 1 if now.psi > 0.0 else -1, now, work.values[at.TIME, 0])


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
        is_smooth = mode == Mode.STICKS or mode == Mode.SLIPS  # beyond an event, too
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
def with_length(plan: Plan, h: float, natural: float, change: int, to_end: bool) -> Plan:
    """Return a plan with another length and end."""
    return Plan(
        h, plan.clock, natural, plan.from_change, change, to_end, plan.flat_is_worse, plan.error
    )


@kernel
def revised(plan: Plan, error: float, tolerance: float) -> Plan:
    """Return how to try again after too large an error: with a flat clock once, or shorter."""
    kind, worse, last = plan.clock, plan.flat_is_worse, plan.error
    rooted = plan.from_change or plan.change != NOTHING
    if kind == EVEN and rooted and not worse:
        start = collocation.FLAT_START if plan.from_change else EVEN
        end = collocation.FLAT_END if plan.change != NOTHING else EVEN
        kept = plan.natural, plan.from_change, plan.change, plan.to_stage_end
        return Plan(plan.length, start + end, *kept, False, error)
    if kind != EVEN and error > last:
        kind, worse, error = EVEN, True, last
    elif kind == collocation.FLAT_END or kind == collocation.FLAT_ENDS:
        kind, last = kind - collocation.FLAT_END, error
    h = plan.length * max(STEEPEST, SAFETY * (tolerance / error) ** (1.0 / ORDER))
    return Plan(h, kind, h, plan.from_change, NOTHING, False, worse, last)


@kernel
def error_of(work: Arrays, panel: Panel) -> float:
    """Return the error of a solved panel, as the last coefficients of its series tell it."""
    series, ring = work.series[panel.number], ring_of(work)
    error = max(tail(series[at.PSI]), tail(series[at.MOVED]))
    error = max(error, NORMAL_WEIGHT * tail(series[at.SPEED]) * (1.0 + abs(series[at.PSI, 0])))
    if ring.mode == Mode.RETURNS:
        levels = work.values[row_of(ring.sign)]
        error = max(error, tail(series[at.LAID]), tail(series[row_of(ring.sign)]))
        error = max(error, tail(series[at.LAID_RADIUS]) * abs(levels[NODES - 1] - levels[0]))
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
