"""The arrays in which an impact with losses is solved."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from carom.dimensionless.lossy import memory
from carom.dimensionless.lossy.collocation import NODES
from carom.dimensionless.lossy.memory import MAX_PIECES, PARTS, Pieces

MAX_PANELS = 600
SPEED, PSI, VALUES = 6, 7, 8  # rows beyond those of the memory: v, psi


class Arrays(NamedTuple):
    """Arrays that an impact needs, made once and used for many."""

    series: Pieces  # (panels, VALUES, NODES)
    values: Pieces  # (VALUES, NODES), at the nodes of the panel of the moment
    rates: Pieces  # (3, NODES)
    matrix: Pieces  # (NODES, NODES)
    pieces: Pieces
    spare: Pieces
    parts: Pieces
    zones: NDArray[np.int64]  # (NODES,)


def new_work() -> Arrays:
    """Return the arrays that an impact needs."""
    return Arrays(
        series=np.zeros((MAX_PANELS, VALUES, NODES)),
        values=np.zeros((VALUES, NODES)),
        rates=np.zeros((3, NODES)),
        matrix=np.zeros((NODES, NODES)),
        pieces=np.zeros((MAX_PIECES, memory.COLUMNS)),
        spare=np.zeros((MAX_PIECES, memory.COLUMNS)),
        parts=np.zeros((PARTS, memory.COLUMNS)),
        zones=np.zeros(NODES, dtype=np.int64),
    )
