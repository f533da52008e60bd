"""What is kept of a marched impact: a row at the end of each step."""

from carom.dimensionless.lossy.layout import (
    AT_B,
    AT_D,
    AT_LOST,
    AT_P,
    AT_PSI,
    AT_Q,
    AT_SHEAR_LOST,
    AT_SQUARE,
    AT_STORED,
    AT_STUCK,
    AT_TIME,
    AT_U,
    AT_V,
    ROWS,
)
from carom.dimensionless.lossy.springs.work import (
    DEPTH,
    EDGE,
    FORCE,
    LOAD,
    LOST,
    MOVED,
    NEXT,
    PSI,
    RELAXING,
    SPEED,
    TIME,
    WEIGHT,
    U,
    X,
    rim,
)
from carom.dimensionless.numerics.arrays import Array
from carom.dimensionless.numerics.kernels import kernel

FORTH, BACK = ROWS, ROWS + 1  # whether springs slip, either way
COLUMNS = ROWS + 2
AT_LIMIT = 1e-9  # of the limit: a spring nearer to it slips


@kernel
def keep_touch(psi: float, row: Array) -> None:
    """Keep the first touch."""
    row[:] = 0.0
    row[AT_V], row[AT_PSI] = 1.0, psi


@kernel
def keep_normal(now: Array, stored: float, row: Array) -> None:
    """Keep the normal motion after a step."""
    row[AT_TIME], row[AT_D], row[AT_V], row[AT_B] = now[TIME], now[DEPTH], now[SPEED], now[EDGE]
    row[AT_P], row[AT_STORED] = now[LOAD], stored
    row[AT_LOST] = 1.0 - now[SPEED] ** 2 - stored


@kernel
def keep_tangential(state: Array, row: Array) -> None:
    """Keep the tangential motion after a step, and what was lost in shear by then."""
    row[AT_PSI], row[AT_U], row[AT_Q] = state[PSI], state[MOVED], state[FORCE]
    row[AT_SHEAR_LOST] = state[LOST]


@kernel
def keep_springs(springs: Array, count: int, edge: float, extra: float, row: Array) -> None:
    """Keep what the springs in shear store, how wide the zones are that stick, and who slips."""
    row[AT_SQUARE], row[AT_STUCK], row[FORTH], row[BACK] = 0.0, 0.0, 0.0, 0.0
    for j in range(count):
        u, m, most = springs[U, j], springs[RELAXING, j], springs[NEXT, j]
        weight = springs[WEIGHT, j] + (rim(springs, j, edge) if j == count - 1 else 0.0)
        row[AT_SQUARE] += weight * (u * u + extra * m * m)
        force = u + extra * m
        if most - abs(force) > AT_LIMIT * most:
            row[AT_STUCK] += min(springs[X, j + 1], edge) - springs[X, j]
        else:
            row[FORTH if force > 0.0 else BACK] = 1.0
