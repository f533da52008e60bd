"""The solids that are marched: hertz, thornton, metal and relaxing, a viscous one among these.

A new one is a file beside them, its place in SOLIDS, and a line in `press`, in `stored` and, if it
changes where the bodies turn, in `turn`.
"""

import numpy as np

from carom.dimensionless.lossy.law import Loss
from carom.dimensionless.lossy.springs import hertz, metal, motion as at, relaxing, thornton
from carom.dimensionless.lossy.springs.motion import Solid
from carom.dimensionless.numerics.arrays import Array
from carom.dimensionless.numerics.kernels import kernel

SOLIDS = {Loss.PLATE: hertz, Loss.PLASTIC: thornton, Loss.METAL: metal}
SOLIDS |= {Loss.RELAXING: relaxing, Loss.VISCOUS: relaxing}

UNKNOWN = -1  # in place of how many springs touch: a solid that is not marched


@kernel
def press(solid: Solid, now: Array, new: Array, turned: Array, springs: Array, laid: int) -> int:
    """Fill in what the contact and its springs bear after a step; return how many touch."""
    if solid.loss == Loss.PLASTIC.value:
        return int(thornton.press(solid.parameter, now, new, turned, springs, laid))
    if solid.loss in (Loss.RELAXING.value, Loss.VISCOUS.value):
        return int(relaxing.press(solid.extra, solid.parameter, now, new, springs, laid))
    if solid.loss == Loss.METAL.value:
        y, strain = solid.parameter, solid.strain
        return int(metal.press(y, strain, now, new, turned, springs, laid))
    if solid.loss == Loss.PLATE.value:
        return int(hertz.press(solid.parameter, now, new, springs, laid))
    return UNKNOWN


@kernel
def turn(
    solid: Solid, now: Array, springs: Array, touching: int, state: Array, ratio: float
) -> None:
    """Change what changes where the bodies turn."""
    if solid.loss == Loss.PLASTIC.value:
        thornton.turn(now, springs, touching, state, ratio)
    elif solid.loss == Loss.METAL.value:
        metal.turn(now, springs, touching)
    elif solid.loss == Loss.PLATE.value:
        hertz.turn(solid.parameter, now)


@kernel
def stored(solid: Solid, now: Array, springs: Array, touching: int) -> float:
    """Return the energy in compression, of m_n V_1^2/2."""
    if solid.loss in (Loss.RELAXING.value, Loss.VISCOUS.value):
        return float(relaxing.stored(solid.extra, now[at.EDGE], springs, touching))
    if solid.loss == Loss.METAL.value:
        return float(metal.stored(now[at.EDGE], springs, touching))
    if solid.loss == Loss.PLATE.value:
        return float(hertz.stored(now[at.DEPTH]))
    if solid.loss == Loss.PLASTIC.value:
        return float(thornton.stored(now[at.EDGE], now[at.LOAD]))
    return np.nan
