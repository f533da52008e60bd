"""What slip has passed: springs that slid from when its front went by, as a stack.

Where the front was at t0 the rate of slip is g - h, h = g(t0) exp(-(t - t0)/alpha), with the excess
g = sigma psi - v. Springs stick again when g has fallen to their h, the last one passed first, so
that the front returns over the stack. What slips since it was touched has h = 0 and is not in it.
"""

import numpy as np

from carom.dimensionless.lossy.panels import work as at
from carom.dimensionless.lossy.panels.collocation import evaluate
from carom.dimensionless.lossy.panels.work import Arrays
from carom.dimensionless.numerics.kernels import kernel

# Columns: the panel, the places in it and radii of the outer and the inner end; of what was passed
# in an instant, which has no panel, the time and excess then.
PANEL, X_OUTER, X_INNER, R_OUTER, R_INNER, INSTANT, EXCESS = range(7)
AT_ONCE = -1.0
HALVINGS = 36  # errors of the front count in second order


@kernel
def push(work: Arrays, depth: int, panel: int, r_outer: float, r_inner: float) -> int:
    """Add what the front passes in a whole panel; return how many there are."""
    row = work.passed[depth]
    row[PANEL], row[X_OUTER], row[X_INNER] = panel, -1.0, 1.0
    row[R_OUTER], row[R_INNER] = r_outer, r_inner
    return depth + 1


@kernel
def push_at_once(
    work: Arrays, depth: int, r_outer: float, r_inner: float, instant: float, excess: float
) -> int:
    """Add what the front passes in an instant; return how many there are."""
    row = work.passed[depth]
    row[PANEL], row[R_OUTER], row[R_INNER] = AT_ONCE, r_outer, r_inner
    row[INSTANT], row[EXCESS] = instant, excess
    return depth + 1


@kernel
def left_at(work: Arrays, n: int, sign: int, alpha: float, x: float, time: float) -> float:
    """Return h, at a time, of the spring that was passed at this place of a panel."""
    excess = sign * evaluate(work.series, n, at.PSI, x) - evaluate(work.series, n, at.SPEED, x)
    return float(excess * np.exp((evaluate(work.series, n, at.TIME, x) - time) / alpha))


@kernel
def left(work: Arrays, top: int, outer: bool, sign: int, alpha: float, time: float) -> float:
    """Return h, at a time, at an end of an entry of the stack."""
    row = work.passed[top]
    if row[PANEL] == AT_ONCE:
        return float(row[EXCESS] * np.exp((row[INSTANT] - time) / alpha))
    return left_at(work, int(row[PANEL]), sign, alpha, row[X_OUTER if outer else X_INNER], time)


@kernel
def returned(
    work: Arrays, top: int, sign: int, alpha: float, time: float, excess: float
) -> tuple[float, float]:
    """Return where in an entry h is the excess, as radius and place."""
    n, low, high = (
        int(work.passed[top, PANEL]),
        work.passed[top, X_OUTER],
        work.passed[top, X_INNER],
    )
    if left_at(work, n, sign, alpha, high, time) <= excess:
        low = high
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        if left_at(work, n, sign, alpha, middle, time) < excess:
            low = middle
        else:
            high = middle
    return np.sqrt(max(evaluate(work.series, n, at.FRONT, high), 0.0)), high
