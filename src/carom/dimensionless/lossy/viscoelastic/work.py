"""Panels of time: functions as Chebyshev series on them, and the arrays that an impact needs.

On a panel of length h the clock is tau = h theta(x), -1 <= x <= 1. Fronts that start or end where
the memory is at an extreme, or at the centre, go like the square root of time; a clock that is flat
there makes them smooth in x.
"""

from typing import NamedTuple

import numpy as np

from carom.dimensionless.numerics.arrays import Cube, Matrix, Vector
from carom.dimensionless.numerics.chebyshev import extrema, from_extrema
from carom.dimensionless.numerics.kernels import entry_point, kernel, plain

DEGREE = 11
NODES = DEGREE + 1
PLACES = extrema(DEGREE)  # x of the nodes, both ends included
TO_SERIES = from_extrema(DEGREE)

EVEN, FLAT_START, FLAT_END, FLAT_ENDS = range(4)  # clocks
MAX_STEPS = 80

MAX_PANELS, MAX_PIECES = 600, 400
# Series of a panel: b, U, integrals of U db and U^2 db, A and B as they are laid, v, psi; then the
# radius at which memory is laid, time, the front of slip squared.
RADIUS, MOVED, LAID, LAID_SQUARE, LAID_A, LAID_B, SPEED, PSI, LAID_RADIUS, TIME, FRONT = range(11)
VALUES = 11
# Columns of a piece of memory: sign of the slip that made it flat (0: laid), its panel, where in it
# the piece begins and ends, and there: radius, A, and the integrals of U db and U^2 db up to it.
SIGN, PANEL, X0, X1, R0, R1, A0, A1, W0, W1, S0, S1 = range(12)
PIECE_COLUMNS, PASSED_COLUMNS = 12, 7
# Numbers of the ring: what it does, the sign of slip, how much of what slip passed still slips, the
# force for T = 0 of pieces that stay whole in the panel, and psi/v where that is constant.
MODE, RING_SIGN, DEPTH, WHOLE, RATIO = range(5)
RING_NUMBERS = 5


@kernel
def clock(kind: int, x: float) -> float:
    """Return theta = tau/h at a place of a panel."""
    y = 0.5 * (1.0 + x)
    if kind == EVEN:
        return y
    if kind == FLAT_START:
        return y * y
    if kind == FLAT_END:
        return y * (2.0 - y)
    return y * y * (3.0 - 2.0 * y)


@kernel
def place_of_clock(kind: int, part: float) -> float:
    """Return the place at which the clock shows this part of a panel."""
    if kind == FLAT_START:
        part = np.sqrt(part)
    elif kind == FLAT_END:
        part = 1.0 - np.sqrt(1.0 - part)
    elif kind == FLAT_ENDS:
        part = 0.5 - np.sin(np.arcsin(1.0 - 2.0 * part) / 3.0)
    return 2.0 * part - 1.0


CLOCKS = np.array([[plain(clock)(kind, x) for x in PLACES] for kind in range(4)])  # at the nodes


def _integrals(kind: int) -> np.ndarray:
    """Return the matrix that makes integrals over theta up to the nodes of values."""
    chebyshev = np.polynomial.chebyshev
    pace = chebyshev.chebder(TO_SERIES @ CLOCKS[kind])
    rises = (chebyshev.chebint(chebyshev.chebmul(one, pace), lbnd=-1.0) for one in TO_SERIES.T)
    return np.array([chebyshev.chebval(PLACES, rise) for rise in rises])


INTEGRALS = np.ascontiguousarray(np.swapaxes([_integrals(kind) for kind in range(4)], 1, 2))


@kernel
def expand(values: np.ndarray, series: np.ndarray) -> None:
    """Write the Chebyshev series of values at the nodes."""
    for k in range(NODES):
        total = 0.0
        for j in range(NODES):
            total += TO_SERIES[k, j] * values[j]
        series[k] = total


@kernel
def integrate(kind: int, start: float, h: float, rates: np.ndarray, values: np.ndarray) -> None:
    """Write start + integral of the rates over a panel of length h, up to each node."""
    for j in range(NODES):
        total = 0.0
        for k in range(NODES):
            total += INTEGRALS[kind, j, k] * rates[k]
        values[j] = start + h * total


@kernel
def evaluate(table: np.ndarray, panel: int, row: int, x: float) -> float:
    """Return the value at x of a row of series on a panel (Clenshaw 1955)."""
    last, one = 0.0, 0.0
    for k in range(DEGREE, 0, -1):
        last, one = one, table[panel, row, k] + 2.0 * x * one - last
    return float(table[panel, row, 0] + x * one - last)


@kernel
def slope(table: np.ndarray, panel: int, row: int, x: float) -> float:
    """Return the derivative by x of a row of series on a panel."""
    last, one = 0.0, 0.0
    for k in range(DEGREE, 1, -1):
        last, one = one, k * table[panel, row, k] + 2.0 * x * one - last
    return float(table[panel, row, 1] + 2.0 * x * one - last)


@kernel
def tail(series: np.ndarray) -> float:
    """Return how large the last coefficients of a series are."""
    return float(abs(series[DEGREE]) + abs(series[DEGREE - 1]))


@entry_point()
def place(table: Cube, panel: int, row: int, level: float, low: float, high: float) -> float:
    """Return where a monotone series between two places passes a level (Illinois method)."""
    f_low = evaluate(table, panel, row, low) - level
    f_high = evaluate(table, panel, row, high) - level
    if (f_low > 0.0) == (f_high > 0.0):
        return low if abs(f_low) < abs(f_high) else high
    x, side = high, 0
    for _ in range(MAX_STEPS):
        x = high - f_high * (high - low) / (f_high - f_low)
        f = evaluate(table, panel, row, x) - level
        if abs(f) <= 1e-16 or abs(high - low) <= 1e-15:
            break
        if (f > 0.0) == (f_high > 0.0):
            high, f_high = x, f
            if side == 1:
                f_low *= 0.5
            side = 1
        else:
            low, f_low = x, f
            if side == -1:
                f_high *= 0.5
            side = -1
    return float(x)


class Arrays(NamedTuple):
    """Arrays that an impact needs, made once and used for many."""

    series: Cube  # (panels, VALUES, NODES)
    values: Matrix  # (VALUES, NODES), at the nodes of the panel of the moment
    rates: Matrix  # (3, NODES)
    matrix: Matrix  # (NODES, NODES)
    pieces: Matrix
    passed: Matrix  # what slip has passed
    ring: Vector  # the ring of slip


def new_work() -> Arrays:
    """Return the arrays that an impact needs."""
    return Arrays(
        series=np.zeros((MAX_PANELS, VALUES, NODES)),
        values=np.zeros((VALUES, NODES)),
        rates=np.zeros((3, NODES)),
        matrix=np.zeros((NODES, NODES)),
        pieces=np.zeros((MAX_PIECES, PIECE_COLUMNS)),
        passed=np.zeros((MAX_PANELS, PASSED_COLUMNS)),
        ring=np.zeros(RING_NUMBERS),
    )


class Panel(NamedTuple):
    """A panel of time: its number, clock and length, and how many pieces of memory it finds."""

    number: int
    clock: int
    length: float
    pieces: int


class State(NamedTuple):
    """The state at an instant: radius of the edge, normal speed, U, psi, time."""

    radius: float
    speed: float
    moved: float
    psi: float
    time: float


@kernel
def state_at_node(work: Arrays, j: int) -> State:
    """Return the state at a node."""
    at = work.values[:, j]
    return State(at[RADIUS], at[SPEED], at[MOVED], at[PSI], at[TIME])


@kernel
def state_at(work: Arrays, panel: Panel, x: float) -> State:
    """Return the state at a place of a solved panel."""
    table, n = work.series, panel.number
    b, v = evaluate(table, n, RADIUS, x), evaluate(table, n, SPEED, x)
    u, psi = evaluate(table, n, MOVED, x), evaluate(table, n, PSI, x)
    return State(b, v, u, psi, evaluate(table, n, TIME, x))
