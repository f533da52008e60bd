"""Which phase follows which: the whole impact as a machine of stick, slip and gross slip.

`integration` advances the motion from event to event; this module alone decides what comes next,
from one table. The machine runs for psi_1 >= 0; negative psi_1 is its mirror image.
"""

import warnings
from enum import IntEnum
from functools import cache

import numpy as np

from carom.dimensionless.elastic import (
    integration,
    memory,
    motion as at,
    plates,
    record as recorded,
)
from carom.dimensionless.elastic.integration import Run, Work
from carom.dimensionless.elastic.motion import ORDER
from carom.dimensionless.elastic.record import Record
from carom.dimensionless.numerics.kernels import entry_point, kernel
from carom.quantities.statuses import Cause, WordedStatus

# Modes of a recorded step that need no integration.
GROSS, RETRACED = 3, 4


class Kind(IntEnum):
    """What the contact does."""

    STICK = 0
    SLIP = 1
    GROSS_SLIP = 2
    APART = 3


SAME, OPPOSITE, NONE, GIVEN = 1, -1, 0, 2  # sign of the next phase, seen from this one

# (kind, cause, unloading) -> next kind and its sign. What is not listed ends the run.
TRANSITIONS = {
    (Kind.STICK, Cause.EDGE_AT_LIMIT, False): (Kind.SLIP, GIVEN),
    (Kind.SLIP, Cause.SLIP_STOPS, False): (Kind.STICK, NONE),
    (Kind.SLIP, Cause.SLIP_STOPS, True): (Kind.SLIP, OPPOSITE),
    (Kind.SLIP, Cause.RING_CLOSES, True): (Kind.SLIP, OPPOSITE),
    (Kind.SLIP, Cause.FRONT_AT_CENTRE, False): (Kind.GROSS_SLIP, SAME),
    (Kind.SLIP, Cause.FRONT_AT_CENTRE, True): (Kind.GROSS_SLIP, SAME),
    (Kind.GROSS_SLIP, Cause.SLIP_STOPS, False): (Kind.STICK, NONE),
    (Kind.GROSS_SLIP, Cause.SLIP_STOPS, True): (Kind.SLIP, OPPOSITE),
}


def _table() -> np.ndarray:
    table = np.full((len(Kind), len(Cause), 2, 2), int(Kind.APART), dtype=np.int64)
    for (kind, cause, unloading), (following, sign) in TRANSITIONS.items():
        table[kind, cause, int(unloading)] = following, sign
    return table


NEXT = _table()


class Status(WordedStatus):
    """The status of a solved impact; its `message` is a short explanation.

    Examples
    --------
    >>> carom.status.Status(0).message
    'solved'
    """

    SOLVED = 0, "solved"
    PSI_NOT_FINITE = 1, "psi_1 must be a finite number"
    CHI_NOT_POSITIVE = 2, "chi must be positive and finite"
    TOO_MANY_PHASES = 3, f"not solved: more than {recorded.MAX_PHASES} phases (chi is too large)"
    UNRESOLVED = 4, "not solved: a phase did not end within the allowed number of steps"
    PLATE_GIVES_WAY = 5, "not solved: so thin a plate gives way like a foil (lambda above 2)"


# A stick phase that lasts to within this speed of the turning point, times psi_1, goes back as it
# came: the second where F is a polynomial, so that only rounding keeps it from the turning point.
RETRACE, RETRACE_EXACTLY = 4e-12, 1e-7
# Speeds nearer to 0 or -1 than this are the border between two regimes.
SPEED_ROUNDING = 1e-13
# Below this psi_1 the series are not resolved any better.
SMALLEST_PSI = 1e-6
# Beyond it impacts that do not slip throughout have too many phases, and take long to show it.
LARGEST_CHI = 1e5
LARGEST_GIVE = 2.0  # lambda, beyond which weight and deflection decide: e is 0.013 there
# An impact of which psi_2 is known to 30 digits, and its digits that any machine gives.
KNOWN_PSI, KNOWN_CHI, KNOWN_PSI_OUT = 0.5, 1.44, 0.0471310837787526
KNOWN_DIGITS = 1e-12
# A contact radius below which nothing of the impact is left: psi changes by less than 1e-28.
TINY_RADIUS = 1e-6


@kernel
def is_polynomial(chi: float) -> bool:
    """Tell whether F(alpha, beta; 3/5; x) is a polynomial: chi = ((11 + 20 n)^2 - 1)/240."""
    square = 240.0 * chi + 1.0
    n = np.round((np.sqrt(square) - 11.0) / 20.0)
    return bool(n >= 0.0 and abs(square - (11.0 + 20.0 * n) ** 2) <= 4e-16 * square)


@kernel
def stick(run: Run, depth: int, psi_1: float) -> tuple[int, int, int]:
    """Run a stick phase; return its cause of ending, the depth of the memory, the sign of slip."""
    work, record = run.work, run.record
    s = work.series
    recorded.note_stretch(record, work.stack, depth)
    s[0, at.A] = s[0, at.B]
    event = integration.run_stretch(run, at.STICK, 0, 0.0, False)
    if event == integration.UNRESOLVED:
        return Cause.UNRESOLVED.value, depth, 0
    slowest = psi_1 * (RETRACE_EXACTLY if is_polynomial(run.chi) else RETRACE)
    if run.give == 0.0 and depth == 0 and s[0, at.V] <= slowest + 1e-15:
        recorded.note_node(record, RETRACED, at.CONTACT, 0, 0.0, s)
        s[0, at.B], s[0, at.V], s[0, at.PSI], s[0, at.Q] = 0.0, -1.0, -psi_1, 0.0
        return Cause.SEPARATION.value, depth, 0
    # stick ends before the turning point; only rounding passes it
    s[0, at.V] = max(s[0, at.V], 1e-300)
    depth = memory.push_laid(work.stack, depth, s, record.counts[0])
    return Cause.EDGE_AT_LIMIT.value, depth, 1 if s[0, at.PSI] > 0.0 else -1


@kernel
def slip(run: Run, depth: int, sign: int, after_stick: bool) -> tuple[int, int]:
    """Run a slip ring through the annuli of the memory; return why it ends and the depth left."""
    work, record = run.work, run.record
    s = work.series
    depth = memory.cross_flat(work.stack, depth, sign)
    for _ in range(recorded.MAX_ANNULI):
        if depth == 0:
            return Cause.FRONT_AT_CENTRE.value, 0
        mode = memory.place_front(work.stack, depth, s)
        recorded.note_stretch(record, work.stack, depth)
        inner = memory.inner_radius(work.stack, depth)
        starts = after_stick and mode == at.LAID
        event = integration.run_stretch(run, mode, sign, inner, starts)
        after_stick = False
        if event == integration.FRONT_AT_BORDER:
            depth = memory.cross_flat(work.stack, depth - 1, sign)
            continue
        memory.trim(work.stack, depth, s)
        if event == integration.UNRESOLVED:
            break
        if s[0, at.B] < TINY_RADIUS:
            return Cause.SEPARATION.value, depth
        if event == integration.RING_CLOSES:
            return Cause.RING_CLOSES.value, depth
        return Cause.SLIP_STOPS.value, memory.push_flat(
            work.stack, depth, s, sign, record.counts[0]
        )
    return Cause.UNRESOLVED.value, depth


@kernel
def gross_slip(run: Run, sign: int) -> tuple[int, int]:
    """Follow gross slip, psi - 2 chi sigma v constant (33); return why it ends, and the depth."""
    work, record, chi = run.work, run.record, run.chi
    s = work.series
    s[0, at.A] = 0.0
    recorded.note_stretch(record, work.stack, 0)
    if run.give > 0.0:
        event = plates.slide(run, sign)
        if event == integration.SLIP_STOPS:
            depth = memory.push_flat(work.stack, 0, s, sign, record.counts[0])
            return Cause.SLIP_STOPS.value, depth
        apart = event == integration.RING_CLOSES
        return Cause.SEPARATION.value if apart else Cause.UNRESOLVED.value, 0
    recorded.note_node(record, GROSS, at.CONTACT, sign, 0.0, s)
    excess = sign * s[0, at.PSI] - s[0, at.V]
    fall = 2.0 * chi - 1.0  # of the excess, per fall in speed
    if not excess < fall * (1.0 + s[0, at.V]) - SPEED_ROUNDING:
        s[0, at.PSI] -= 2.0 * chi * sign * (1.0 + s[0, at.V])
        s[0, at.B], s[0, at.V], s[0, at.Q] = 0.0, -1.0, 0.0
        return Cause.SEPARATION.value, 0
    fallen = (1.0 - s[0, at.V]) + excess / fall
    s[0, at.V] = 1.0 - fallen if abs(1.0 - fallen) > SPEED_ROUNDING else 0.0
    s[0, at.B] = (fallen * (2.0 - fallen)) ** 0.2
    s[0, at.PSI] = sign * s[0, at.V]
    s[0, at.Q] = sign * (2.0 / 3.0) * s[0, at.B] ** 3
    return Cause.SLIP_STOPS.value, memory.push_flat(work.stack, 0, s, sign, record.counts[0])


@entry_point()
def run_phases(
    psi_1: float, chi: float, give: float, tolerance: float, work: Work, record: Record
) -> int:
    """Run an impact, psi_1 >= 0, to its last state in row 0 of the series; return its status."""
    if not np.isfinite(psi_1):
        return Status.PSI_NOT_FINITE.value
    if not (0.0 < chi < np.inf):
        return Status.CHI_NOT_POSITIVE.value
    if not 0.0 <= give <= LARGEST_GIVE:
        return Status.PLATE_GIVES_WAY.value
    s = work.series
    s[0] = 0.0
    s[0, at.V] = 1.0
    s[0, at.PSI] = psi_1
    # psi and Q are of the order of psi_1; errors grow with the number of oscillations
    tolerance *= min(1.0, max(psi_1, SMALLEST_PSI)) / max(1.0, chi)
    run, depth = Run(work, record, chi, give, tolerance), 0
    slides = psi_1 > 1.0 or (psi_1 == 1.0 and (chi < 0.5 or give > 0.0))
    kind = Kind.GROSS_SLIP.value if slides else Kind.STICK.value
    sign = 1 if slides else 0
    cause = Cause.FIRST_TOUCH.value
    for _ in range(recorded.MAX_PHASES if chi <= LARGEST_CHI else 1):
        recorded.note_change(record, kind, sign, cause, s)
        slipping = 0
        if kind == Kind.STICK:
            cause, depth, slipping = stick(run, depth, psi_1)
        elif kind == Kind.SLIP:
            cause, depth = slip(run, depth, sign, cause == Cause.EDGE_AT_LIMIT.value)
        else:
            cause, depth = gross_slip(run, sign)
        following = NEXT[kind, cause, 1 if s[0, at.V] <= 0.0 else 0]
        if following[0] == Kind.APART:
            recorded.note_change(record, Kind.APART.value, 0, cause, s)
            solved = cause == Cause.SEPARATION
            return Status.SOLVED.value if solved else Status.UNRESOLVED.value
        kind = following[0]
        sign = slipping if following[1] == GIVEN else sign * following[1]
    return Status.TOO_MANY_PHASES.value


def new_work() -> Work:
    """Return the arrays that an impact needs."""
    return Work(
        series=np.zeros((ORDER + 1, at.SERIES_COLUMNS)),
        gap=np.zeros(ORDER + 1),
        stack=np.zeros((recorded.MAX_ANNULI, memory.STACK_COLUMNS)),
    )


@cache
def check_kernels() -> None:
    """Warn if the impact that is known comes out otherwise; once, before others are solved."""
    work = new_work()
    run_phases(KNOWN_PSI, KNOWN_CHI, 0.0, KNOWN_DIGITS, work, recorded.new_record(False))
    found = float(work.series[0, at.PSI])
    if not abs(found - KNOWN_PSI_OUT) <= KNOWN_DIGITS:
        given = f"psi_2 = {found:.12g} for psi_1 = {KNOWN_PSI}, chi = {KNOWN_CHI}"
        why = "its machine code is damaged, or its equations were edited; install carom again"
        words = f"the solver is wrong: it gives {given}, where {KNOWN_PSI_OUT:.12g} is right; {why}"
        warnings.warn(words, RuntimeWarning, stacklevel=2)
