"""Where a pair begins to yield: the weaker body, and the speed at which its strength is reached."""

from functools import reduce
from math import pi
from typing import Any

import numpy as np

from carom.bodies.pairs import Pair
from carom.dimensionless.lossy.springs.metal import YIELD_PRESSURE
from carom.quantities.arrays import sqrt
from carom.quantities.refusals import refuse

NO_STRENGTH = "{}: missing; give it, or a yield_strength of a material"


def yield_velocity(pair: Pair, strength: Any = None) -> float:
    """Return the normal velocity in m/s at which the largest pressure is 1.6 yield strengths.

    p_0 = (2 E*/pi) sqrt(d_max/R*) = 1.6 Y, V_y^2 = (16/15) E* sqrt(R*) d_max^(5/2)/m_n.

    Johnson (1985), (11.21); Thornton (1997).
    """
    if strength is None:
        strength = lowest_strength(pair, "yield_velocity")
    ratio = pi * YIELD_PRESSURE * strength / (2.0 * pair.effective_modulus)
    length = pair.effective_radius * ratio**2
    stiffness = 16.0 / 15.0 * pair.effective_modulus * sqrt(pair.effective_radius)
    return sqrt(stiffness * length**2.5 / pair.normal_mass)


def lowest_strength(pair: Pair, wanted: str) -> Any:
    """Return the lower yield strength in Pa; `wanted` is what may be given in its place."""
    bodies = (pair.first.material, pair.second.material)
    strengths = [body.yield_strength for body in bodies if body.yield_strength is not None]
    refuse(not strengths and NO_STRENGTH.format(wanted))
    return reduce(np.fmin, strengths)


def yielding_modulus(pair: Pair) -> Any:
    """Return E/(1 - nu^2) in Pa of the body of lower strength, or else the lower one."""
    bodies = (pair.first.material, pair.second.material)
    one, other = (body.young / (1.0 - body.poisson**2) for body in bodies)
    known = [np.nan if body.yield_strength is None else body.yield_strength for body in bodies]
    weak, strong = np.nan_to_num(known[0], nan=np.inf), np.nan_to_num(known[1], nan=np.inf)
    lower = np.where(strong < weak, other, np.fmin(one, other))
    return np.where(weak < strong, one, lower)[()]
