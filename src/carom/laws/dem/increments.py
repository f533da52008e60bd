"""How the force of an incremental law depends on what it remembers of turning points.

A force t that has turned back remembers where: Mindlin & Deresiewicz's (1953) law, as Thornton &
Yin (1991) made it incremental, keeps the turning points of unloading and reloading; Walton &
Braun's (1986) the last one.
"""

import numpy as np

from carom.dimensionless._jit import kernel
from carom.laws.dem.coefficients import Shear

FIRST, BACK, AGAIN = 0, 1, 2  # first loading, unloading, reloading


@kernel
def softening(shear: int, branch: int, t: float, f: float, upper: float, lower: float) -> float:
    """Return theta, the part of the full stiffness that is left, from 1 to 0.

    Turning points: `upper` where unloading began, `lower` where reloading began.
    """
    if shear == Shear.MINDLIN_DERESIEWICZ.value:
        if branch == FIRST:
            part = t / f
        elif branch == BACK:
            part = (upper - t) / (2.0 * f)
        else:
            part = (t - lower) / (2.0 * f)
    elif branch == BACK:
        part = (upper - t) / (f + upper)
    elif branch == FIRST:
        part = t / f
    else:
        part = (t - lower) / (f - lower)
    return float(np.cbrt(min(1.0, max(0.0, 1.0 - part))))


@kernel
def force_change(
    shear: int, branch: int, theta: float, elastic: float, limit_change: float
) -> float:
    """Return dt for the change `elastic` of a sticking contact while the limit mu F_n changes.

    Thornton & Yin (1991): dT = theta k dU +- (1 - theta) mu dN; theta = 1 while k |dU| < mu dN.
    """
    if shear == Shear.WALTON_BRAUN.value:
        return theta * elastic
    if limit_change > 0.0 and abs(elastic) < limit_change:
        return elastic
    turned = -1.0 if branch == BACK else 1.0
    return theta * elastic + turned * (1.0 - theta) * limit_change
