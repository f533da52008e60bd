"""A viscoelastic impact, panel after panel from the first touch to the last."""

from typing import NamedTuple

import numpy as np

from carom.dimensionless.elastic.phases import Status
from carom.dimensionless.lossy import layout
from carom.dimensionless.lossy.law import LARGEST_PSI, keep_energy, why_not
from carom.dimensionless.lossy.viscoelastic import work as at
from carom.dimensionless.lossy.viscoelastic.contact import Mode, ring_of, row_of, set_ring
from carom.dimensionless.lossy.viscoelastic.events import NOTHING, begin, commit, first_event
from carom.dimensionless.lossy.viscoelastic.normal import Motion, Stage, cut_to_stage, next_stage
from carom.dimensionless.lossy.viscoelastic.panels import solve_panel
from carom.dimensionless.lossy.viscoelastic.record import Trace, note_numbers, note_shear
from carom.dimensionless.lossy.viscoelastic.work import EVEN, NODES, Arrays, Panel
from carom.dimensionless.numerics.arrays import Codes, Matrix, Vector
from carom.dimensionless.numerics.kernels import entry_point, kernel

FIRST_LENGTH, LONGEST, SHORTEST = 0.3, 0.8, 1e-8  # of panels
TOLERANCE = 1e-9  # of a panel; keeps psi_2 to 1e-8 max(1, |psi_1|)
MOST_TRIALS = 60  # of a panel
END_PART, END_PART_FLAT = 1e-9, 1e-5  # part of a panel: a change so near its end is its end
ERROR_ORDER = 9.0  # of the error of a panel in its length, about
NORMAL_WEIGHT = 30.0  # of the error of the normal motion, which is cheap to keep small
SAFETY, STEEPEST, GROWTH = 0.8, 0.2, 4.0
NO_PANEL = -1
SMALLEST_PSI = 1e-3  # psi_1 that is solved
LENGTH_AFTER_EVENT = 0.02  # length at least tried after an event
NEAR_HALF = 1e-4  # of chi, about 1/2
STOPPED = 4e-9  # the speed at which a stick phase has lasted to v = 0


class Solid(NamedTuple):
    """The numbers of an impact but psi_1, and the error that a panel may have."""

    chi: float
    alpha: float
    tolerance: float


class Plan(NamedTuple):
    """How to solve a panel: its length, clock and ends, and the `change` that ends it, if any."""

    length: float
    clock: int
    natural: float  # length that accuracy alone would allow
    from_change: bool
    change: int
    to_stage_end: bool
    flat_is_worse: bool
    error: float  # with an even clock


@entry_point()
def run(
    psi_1: float, solid: Solid, until: int, work: Arrays, numbers: Vector, record: Trace
) -> tuple[int, int]:
    """Run an impact, psi_1 >= 0; return its status and the number of panels.

    It ends with the contact; or in the panel `until`, which is left as it was solved, and returns
    how many pieces of memory that finds.
    """
    chi, tolerance = solid.chi, solid.tolerance
    refused = why_not(psi_1, chi)
    if refused != Status.SOLVED.value:
        return refused, 0
    numbers[:] = 0.0
    work.values[:, 0], work.ring[:] = 0.0, 0.0
    work.values[at.SPEED, 0], work.values[at.PSI, 0] = 1.0, psi_1
    slips = psi_1 > 1.0 or (psi_1 == 1.0 and chi <= 0.5)
    set_ring(work, Mode.SLIPS.value if slips else Mode.STICKS.value, 1 if slips else 0, 0)
    motion = Motion(Stage.LOADING.value, solid.alpha, chi)
    pieces, natural, from_change = 0, FIRST_LENGTH, False
    for number in range(at.MAX_PANELS):
        plan = Plan(natural, EVEN, natural, from_change, NOTHING, False, False, 0.0)
        plan, error = solved_panel(work, motion, number, pieces, plan, tolerance * (1.0 + psi_1))
        if error < 0.0 or pieces > at.MAX_PIECES // 2:
            return Status.UNRESOLVED.value, number
        panel = Panel(number, plan.clock, plan.length, pieces)
        if number == until:
            return Status.SOLVED.value, pieces
        note_shear(work, motion, panel, numbers, record)
        note_numbers(work, motion, panel, numbers)
        if goes_back(work, motion, plan):
            set_ring(work, Mode.RETRACES.value, 0, 0)
            work.ring[at.RATIO], pieces = psi_1, 0
        else:
            pieces = commit(work, motion, panel, plan.change)
        for row in range(at.VALUES):
            work.values[row, 0] = work.values[row, NODES - 1]
        if plan.to_stage_end and motion.stage == Stage.UNLOADING.value:
            return Status.SOLVED.value, number + 1
        from_change = plan.change != NOTHING or plan.to_stage_end
        natural = max(plan.natural, LENGTH_AFTER_EVENT)
        if plan.to_stage_end:
            motion = next_stage(work, motion)
            pieces = unload(work, motion, pieces)
        elif plan.change == NOTHING:
            growth = SAFETY * (tolerance * (1.0 + psi_1) / (error + 1e-18)) ** (1.0 / ERROR_ORDER)
            natural = min(LONGEST, plan.length * min(GROWTH, growth))
    return Status.UNRESOLVED.value, at.MAX_PANELS


@kernel
def goes_back(work: Arrays, motion: Motion, plan: Plan) -> bool:
    """Tell whether the impact goes back as it came: for chi = 1/2 psi stays in proportion to v."""
    stops = motion.stage == Stage.LOADING.value and work.values[at.SPEED, NODES - 1] < STOPPED
    return bool(stops and abs(motion.chi - 0.5) < NEAR_HALF and ring_of(work).mode == Mode.STICKS)


@kernel
def unload(work: Arrays, motion: Motion, pieces: int) -> int:
    """Let the edge slip from the turning point on, if all sticks; return the pieces there are."""
    if ring_of(work).mode != Mode.STICKS:
        return pieces
    now = at.state_at_node(work, 0)
    return begin(work, motion, pieces, 1 if now.psi > 0.0 else -1, now)


@kernel
def solved_panel(
    work: Arrays, motion: Motion, number: int, pieces: int, plan: Plan, tolerance: float
) -> tuple[Plan, float]:
    """Solve the next panel, cut at the first event; return how, and the error or a negative one."""
    before = Panel(number, EVEN, 0.0, pieces)
    for _ in range(MOST_TRIALS):
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
        near = END_PART if plan.clock == EVEN else END_PART_FLAT
        part = at.clock(plan.clock, event.place) if event.place < 1.0 else 1.0
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
        start = at.FLAT_START if plan.from_change else EVEN
        end = at.FLAT_END if plan.change != NOTHING else EVEN
        kept = plan.natural, plan.from_change, plan.change, plan.to_stage_end
        return Plan(plan.length, start + end, *kept, False, error)
    if kind != EVEN and error > last:
        kind, worse, error = EVEN, True, last
    elif kind == at.FLAT_END or kind == at.FLAT_ENDS:
        kind, last = kind - at.FLAT_END, error
    h = plan.length * max(STEEPEST, SAFETY * (tolerance / error) ** (1.0 / ERROR_ORDER))
    return Plan(h, kind, h, plan.from_change, NOTHING, False, worse, last)


@kernel
def error_of(work: Arrays, panel: Panel) -> float:
    """Return the error of a solved panel, as the last coefficients of its series tell it."""
    series, ring = work.series[panel.number], ring_of(work)
    error = max(at.tail(series[at.PSI]), at.tail(series[at.MOVED]))
    error = max(error, NORMAL_WEIGHT * at.tail(series[at.SPEED]) * (1.0 + abs(series[at.PSI, 0])))
    if ring.mode == Mode.RETURNS:
        levels = work.values[row_of(ring.sign)]
        error = max(error, at.tail(series[at.LAID]), at.tail(series[row_of(ring.sign)]))
        error = max(error, at.tail(series[at.LAID_RADIUS]) * abs(levels[NODES - 1] - levels[0]))
    return float(error)


@entry_point()
def outgoing(
    psi_1: float, solid: Solid, work: Arrays, record: Trace, numbers: Vector
) -> tuple[int, int]:
    """Run a viscoelastic impact of any psi_1; return its status and the number of panels.

    Below SMALLEST_PSI psi_2/psi_1 is linear in psi_1, and friction's share of the loss the same;
    beyond LARGEST_PSI psi_1 - psi_2 is the same.
    """
    speed, bent, other = abs(psi_1), False, 0.0
    how = solid, NO_PANEL, work, numbers, record
    if speed < SMALLEST_PSI:
        twice, _ = run(2.0 * SMALLEST_PSI, *how)
        bent, other = twice == Status.SOLVED.value, 0.5 * numbers[layout.PSI_OUT] / SMALLEST_PSI
    near = min(max(speed, SMALLEST_PSI), LARGEST_PSI) if np.isfinite(psi_1) else psi_1
    status, panels = run(near, *how)
    keep_energy(near, numbers)
    if speed < SMALLEST_PSI:
        ratio = numbers[layout.PSI_OUT] / SMALLEST_PSI
        more = (ratio - other) * (1.0 - speed / SMALLEST_PSI) if bent else 0.0
        lost, solved_lost = 1.0 - (ratio + more) ** 2, 1.0 - ratio**2
        numbers[layout.PSI_OUT] = speed * (ratio + more)
        share = lost / solved_lost if solved_lost > 0.0 else 1.0
        numbers[layout.SHEAR_LOST] *= share * (speed / SMALLEST_PSI) ** 2
    elif speed > LARGEST_PSI:
        numbers[layout.PSI_OUT] += speed - LARGEST_PSI
    numbers[layout.PSI_OUT] *= np.copysign(1.0, psi_1)
    if status != Status.SOLVED.value:
        numbers[:] = np.nan
    return status, panels


@entry_point()
def fill(
    psi_1: Vector,
    chi: Vector,
    alpha: Vector,
    tolerance: float,
    work: Arrays,
    record: Trace,
    numbers: Matrix,
    status: Codes,
) -> None:
    """Write what every viscoelastic impact comes to, and its status."""
    for i in range(psi_1.size):
        solid = Solid(chi[i], alpha[i], tolerance)
        status[i], _ = outgoing(psi_1[i], solid, work, record, numbers[i])
