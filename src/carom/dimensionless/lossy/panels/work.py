"""The arrays in which an impact with losses is solved, their rows and columns; panels, states."""

from typing import NamedTuple

import numpy as np

from carom.dimensionless.lossy.panels.collocation import NODES, evaluate
from carom.dimensionless.numerics.arrays import Cube, Matrix, Vector
from carom.dimensionless.numerics.kernels import kernel

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
