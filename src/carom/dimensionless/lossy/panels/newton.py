"""A panel of time: the state at its places, and psi on it by Newton's method."""

from typing import NamedTuple

from carom.dimensionless.lossy.panels.collocation import (
    CLOCKS,
    INTEGRALS,
    NODES,
    evaluate,
    integrate,
    place_of_clock,
)
from carom.dimensionless.lossy.panels.work import MOVED, PSI, RADIUS, SPEED, Arrays
from carom.dimensionless.numerics.kernels import kernel

MAX_ITERATIONS = 30
SETTLED = 1e-13


class Panel(NamedTuple):
    """A panel of time: its number, clock and length, and how many pieces of memory it finds."""

    number: int
    clock: int
    length: float
    pieces: int


class State(NamedTuple):
    """The state at an instant: radius of the edge, normal speed, U, psi."""

    radius: float
    speed: float
    moved: float
    psi: float


@kernel
def state_at_node(work: Arrays, j: int) -> State:
    """Return the state at a node."""
    values = work.values
    return State(values[RADIUS, j], values[SPEED, j], values[MOVED, j], values[PSI, j])


@kernel
def state_at(work: Arrays, panel: Panel, x: float) -> State:
    """Return the state at a place of a solved panel."""
    table, n = work.series, panel.number
    b, v = evaluate(table, n, RADIUS, x), evaluate(table, n, SPEED, x)
    return State(b, v, evaluate(table, n, MOVED, x), evaluate(table, n, PSI, x))


@kernel
def guess(work: Arrays, panel: Panel, before: Panel) -> bool:
    """Write psi as it was when the panel was tried last, if it was longer; tell whether so."""
    if before.length < panel.length:
        return False
    ratio = panel.length / before.length
    for j in range(1, NODES):
        part = min(CLOCKS[panel.clock, j] * ratio, 1.0)
        x = place_of_clock(before.clock, part)
        work.values[PSI, j] = evaluate(work.series, panel.number, PSI, x)
    return True


@kernel
def correct(work: Arrays, panel: Panel, psi0: float) -> float:
    """Do a step of Newton's method, from the rates of psi; return by how much psi has changed."""
    rates, psi, change = work.rates, work.values[PSI], 0.0
    integrate(panel.clock, psi0, panel.length, rates[1], rates[0])
    for j in range(NODES):
        rates[0, j] -= psi[j]
    back_substitute(work)
    for j in range(NODES):
        psi[j] += rates[0, j]
        change = max(change, abs(rates[0, j]))
    psi[0] = psi0
    return change


@kernel
def factorise(work: Arrays, panel: Panel, alpha: float) -> None:
    """Write I - h S diag(-(15/2) chi b X) (h S diag(2 b) + alpha) as L R, S being the integral.

    alpha is the retardation time in shear.
    """
    s, h, b, matrix = INTEGRALS[panel.clock], panel.length, work.values[RADIUS], work.matrix
    for i in range(NODES):
        for j in range(NODES):
            total = 0.0
            for k in range(NODES):
                total += s[i, k] * work.rates[2, k] * s[k, j]
            direct = h * s[i, j] * work.rates[2, j] * alpha
            matrix[i, j] = -h * h * total * 2.0 * b[j] - direct
        matrix[i, i] += 1.0
    for k in range(NODES):
        for i in range(k + 1, NODES):
            matrix[i, k] /= matrix[k, k]
            for j in range(k + 1, NODES):
                matrix[i, j] -= matrix[i, k] * matrix[k, j]


@kernel
def back_substitute(work: Arrays) -> None:
    """Solve L R x = y; y is the first row of the rates, and so is x."""
    matrix, y = work.matrix, work.rates[0]
    for i in range(NODES):
        for j in range(i):
            y[i] -= matrix[i, j] * y[j]
    for i in range(NODES - 1, -1, -1):
        for j in range(i + 1, NODES):
            y[i] -= matrix[i, j] * y[j]
        y[i] /= matrix[i, i]
