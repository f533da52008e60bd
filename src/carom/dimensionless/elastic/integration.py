"""A stretch of an impact: one mode of motion from its start to the event that ends it."""

from typing import NamedTuple

import numpy as np

from carom.dimensionless.elastic import motion as at
from carom.dimensionless.elastic.motion import ORDER, Series
from carom.dimensionless.elastic.record import Record, is_full, note_node
from carom.dimensionless.numerics.arrays import Matrix, Vector
from carom.dimensionless.numerics.kernels import kernel

NOTHING = -1
# In stick events 0 and 1 are the edge reaching Coulomb's limit of either sign; in a slip ring:
SLIP_STOPS = 0  # its slip rate falls to zero
FRONT_AT_BORDER = 1  # the front has reached the inner radius of the annulus it retreats through
RING_CLOSES = 2  # the edge recedes onto the front
UNRESOLVED = 3  # no event within the bound on steps

MAX_STEPS = 500
TERM_PERIOD = 5  # at the first touch only every fifth coefficient of a series is not zero
LIMIT_SLACK = 2e-15  # an edge may exceed its limit so far before it slips: rounding, for g = 1
GAP_NOISE = 1e-14  # a gap that closes by less than this inside a step is left open
CUBIC_PIECES = 4  # of a step, in each of which an event function is searched as a cubic
MAX_ROOT_STEPS = 60
SHALLOW_GAP = 1e-3  # the lowest point of a gap is sought exactly where the cubic comes down to this


class Work(NamedTuple):
    """Arrays that an impact needs, made once and used for many."""

    series: Matrix
    gap: Vector
    stack: Matrix


class Run(NamedTuple):
    """An impact that is solved: its arrays, what is kept of it, its numbers, its tolerance."""

    work: Work
    record: Record
    chi: float
    give: float
    tolerance: float


@kernel
def evaluate(coefficients: Series, h: float) -> float:
    """Return a series at h."""
    total = coefficients[ORDER]
    for k in range(ORDER - 1, -1, -1):
        total = total * h + coefficients[k]
    return float(total)


@kernel
def value_and_slope(coefficients: Series, h: float) -> tuple[float, float]:
    """Return a series and its derivative at h."""
    total = coefficients[ORDER]
    slope = 0.0
    for k in range(ORDER - 1, -1, -1):
        slope = slope * h + total
        total = total * h + coefficients[k]
    return float(total), float(slope)


@kernel
def move(s: Series, h: float) -> None:
    """Put the state at h into row 0."""
    for c in range(at.STATE_SIZE):
        total = s[ORDER, c]
        for k in range(ORDER - 1, -1, -1):
            total = total * h + s[k, c]
        s[0, c] = total


@kernel
def choose_clock(s: Series, mode: int, sign: int, starts: bool) -> int:
    """Return the clock that runs faster at the state in row 0."""
    if mode == at.STICK or starts:
        return at.START if starts else at.CONTACT
    n = s[0, at.B] * (sign * s[0, at.PSI] - s[0, at.V])
    d = 2.0 * s[0, at.A] if mode == at.FLAT else s[0, at.A] * (s[0, at.V_A] - sign * s[0, at.PSI_A])
    return at.FRONT if n > d else at.CONTACT


@kernel
def reach(s: Series, mode: int, tolerance: float) -> float:
    """Return the step up to which the series are good to the tolerance."""
    used = at.A if mode == at.STICK else at.STATE_SIZE
    h = 1.0
    for k in range(ORDER - TERM_PERIOD + 1, ORDER + 1):
        largest = 0.0
        for i in range(used):
            largest = max(largest, abs(s[k, i]))
        if largest * h**k > tolerance:
            h = (tolerance / largest) ** (1.0 / k)
    return h


@kernel
def write_gap(s: Series, mode: int, sign: int, inner: float, event: int, gap: Series) -> None:
    """Write the series of how far the state is from an event; negative beyond it."""
    for k in range(ORDER + 1):
        if mode == at.STICK:
            gap[k] = s[k, at.V] - (1 - 2 * event) * s[k, at.PSI]
        elif event == SLIP_STOPS:
            gap[k] = sign * s[k, at.PSI] - s[k, at.V]
        elif event == FRONT_AT_BORDER:
            gap[k] = s[k, at.A]
        else:
            gap[k] = s[k, at.B] - s[k, at.A]
    if mode == at.STICK:
        gap[0] += LIMIT_SLACK
    elif event == FRONT_AT_BORDER:
        gap[0] -= inner


@kernel
def lowest_point(width: float, g0: float, slope0: float, g1: float, slope1: float) -> float:
    """Return where the cubic through both ends of an interval is lowest in it (0: at an end)."""
    if not (slope0 < 0.0 < slope1):
        return 0.0
    mean = (g1 - g0) / width
    a = 3.0 * (slope0 + slope1 - 2.0 * mean)
    b = 2.0 * (3.0 * mean - 2.0 * slope0 - slope1)
    return float(width * (-2.0 * slope0) / (b + np.sqrt(max(b * b - 4.0 * a * slope0, 0.0))))


@kernel
def bottom(gap: Series, low: float, high: float) -> float:
    """Return where the gap is smallest between a falling and a rising end, by bisection."""
    for _ in range(MAX_ROOT_STEPS):
        middle = 0.5 * (low + high)
        if value_and_slope(gap, middle)[1] < 0.0:
            low = middle
        else:
            high = middle
    return 0.5 * (low + high)


@kernel
def root_between(gap: Series, low: float, high: float) -> float:
    """Return where the gap, positive at `low` and negative at `high`, closes."""
    x = high
    for _ in range(MAX_ROOT_STEPS):
        value, steepness = value_and_slope(gap, x)
        if value < 0.0:
            high = x
        else:
            low = x
        following = x - value / steepness if steepness < 0.0 else low
        if not (low < following < high):
            following = 0.5 * (low + high)
        if abs(following - x) <= 1e-16 * x or following == x:
            return following
        x = following
    return x


@kernel
def variation(gap: Series, h: float) -> float:
    """Return a bound of how much the gap can change within h."""
    total = 0.0
    for k in range(ORDER, 0, -1):
        total = (total + abs(gap[k])) * h
    return float(total)


@kernel
def first_closing(gap: Series, h: float) -> float:
    """Return where in (0, h] the gap first closes, or h + 1 if it does not."""
    if gap[0] > variation(gap, h):
        return h + 1.0
    width = h / CUBIC_PIECES
    g0, slope0 = gap[0], gap[1]
    for piece in range(CUBIC_PIECES):
        low = piece * width
        high = h if piece == CUBIC_PIECES - 1 else low + width
        g1, slope1 = value_and_slope(gap, high)
        if g1 < 0.0:
            return root_between(gap, low, high)
        dip = low + lowest_point(width, g0, slope0, g1, slope1)
        if dip > low and evaluate(gap, dip) < SHALLOW_GAP:
            dip = bottom(gap, low, high)
            if evaluate(gap, dip) < -GAP_NOISE:
                return root_between(gap, low, dip)
        g0, slope0 = g1, slope1
    return h + 1.0


@kernel
def first_event(work: Work, mode: int, sign: int, inner: float, h: float) -> tuple[int, float]:
    """Return the first event within the step h, and the step that leads to it."""
    first = NOTHING
    for event in range(2 if mode == at.STICK else 3):
        write_gap(work.series, mode, sign, inner, event, work.gap)
        closing = first_closing(work.gap, h)
        if closing <= h:
            first, h = event, closing
    return first, h


@kernel
def run_stretch(run: Run, mode: int, sign: int, inner: float, starts: bool) -> int:
    """Advance the state in row 0 of the series to the next event and return that event."""
    work, record = run.work, run.record
    s = work.series
    for _ in range(MAX_STEPS):
        if is_full(record):
            break
        clock = choose_clock(s, mode, sign, starts)
        at.expand(s, mode, clock, sign, run.chi, run.give)
        event, h = first_event(work, mode, sign, inner, reach(s, mode, run.tolerance))
        note_node(record, mode, clock, sign, h, s)
        move(s, h)
        if event != NOTHING:
            return event
        starts = False
    return UNRESOLVED
