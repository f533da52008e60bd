"""Pieces of the memory of a contact, and the series of a panel that they are read from."""

import numpy as np
from numpy.typing import NDArray

from carom.dimensionless.numerics.kernels import kernel

Pieces = NDArray[np.float64]

# Columns of a piece: sign of the slip that made it flat (0: laid), its panel, where in the panel it
# begins and ends, and there: radius, A, and the integrals of U db and U^2 db since its start.
SIGN, PANEL, X0, X1, R0, R1, A0, A1, W0, W1, S0, S1 = range(12)
COLUMNS = 12
MAX_PIECES = 400


@kernel
def cubes(inner: float, outer: float) -> float:
    """Return the integral of s dx between two radii."""
    return (outer - inner) * (outer * outer + outer * inner + inner * inner) / 3.0
