"""The memory of a contact: what is left of stick and slip, as a stack of annuli.

From the centre outwards the memory consists of annuli that were laid in stick while the contact
grew, and annuli that slip of one sign has brought to its limit (A or B constant there, so "flat").
Slip enters at the edge and takes annuli off the top; nothing else ever changes the memory.
"""

import numpy as np
from numpy.typing import NDArray

from carom.dimensionless.elastic import motion as at
from carom.dimensionless.elastic.motion import Series
from carom.dimensionless.numerics.kernels import kernel

Stack = NDArray[np.float64]

# Columns: sign of the slip that made the annulus flat (0: laid in stick), its outer radius, the
# loading state there (for a laid one), the number of steps recorded when it was made.
SLIP_SIGN, OUTER, OUTER_V, OUTER_PSI, OUTER_Q, MADE = range(6)
STACK_COLUMNS = 6


@kernel
def push_laid(stack: Stack, depth: int, s: Series, made: int) -> int:
    """Add the annulus laid in the stick phase that has just ended at the state s."""
    stack[depth, SLIP_SIGN], stack[depth, OUTER] = 0.0, s[0, at.B]
    stack[depth, OUTER_V], stack[depth, OUTER_PSI] = s[0, at.V], s[0, at.PSI]
    stack[depth, OUTER_Q] = s[0, at.Q]
    stack[depth, MADE] = made
    return depth + 1


@kernel
def push_flat(stack: Stack, depth: int, s: Series, sign: int, made: int) -> int:
    """Add the annulus that slip of this sign leaves between its front and the edge."""
    stack[depth, SLIP_SIGN], stack[depth, OUTER] = sign, s[0, at.B]
    stack[depth, MADE] = made
    return depth + 1


@kernel
def trim(stack: Stack, depth: int, s: Series) -> None:
    """Cut the annulus in which the front stands down to the front."""
    top = stack[depth - 1]
    top[OUTER], top[OUTER_V] = s[0, at.A], s[0, at.V_A]
    top[OUTER_PSI], top[OUTER_Q] = s[0, at.PSI_A], s[0, at.Q_A]


@kernel
def cross_flat(stack: Stack, depth: int, sign: int) -> int:
    """Drop the annuli that are flat for slip of this sign: a front crosses them at once."""
    for top in range(depth, 0, -1):
        if stack[top - 1, SLIP_SIGN] != sign:
            return top
    return 0


@kernel
def place_front(stack: Stack, depth: int, s: Series) -> int:
    """Put the front on the rim of the topmost annulus; return the mode of its retreat."""
    top = depth - 1
    s[0, at.A] = stack[top, OUTER]
    if stack[top, SLIP_SIGN] == 0.0:
        s[0, at.V_A], s[0, at.PSI_A] = stack[top, OUTER_V], stack[top, OUTER_PSI]
        s[0, at.Q_A] = stack[top, OUTER_Q]
        return at.LAID
    return at.FLAT


@kernel
def inner_radius(stack: Stack, depth: int) -> float:
    """Return the inner radius of the topmost annulus."""
    if depth < 2:
        return 0.0
    return float(stack[depth - 2, OUTER])
