"""The arrays in which an impact with losses is solved."""

from typing import NamedTuple

import numpy as np

from carom.dimensionless.lossy.panels.collocation import NODES
from carom.dimensionless.lossy.panels.pieces import COLUMNS, MAX_PIECES
from carom.dimensionless.numerics.arrays import Cube, Matrix, Vector

MAX_PANELS = 600
PASSED_COLUMNS, RING_NUMBERS = 7, 5
# Series of a panel: b, U, integrals of U db and U^2 db, A and B as they are laid, v, psi; then the
# radius at which memory is laid, time, the front of slip squared.
RADIUS, MOVED, LAID, LAID_SQUARE, LAID_A, LAID_B, SPEED, PSI, LAID_RADIUS, TIME, FRONT = range(11)
VALUES = 11


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
        pieces=np.zeros((MAX_PIECES, COLUMNS)),
        passed=np.zeros((MAX_PANELS, PASSED_COLUMNS)),
        ring=np.zeros(RING_NUMBERS),
    )
