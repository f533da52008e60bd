"""The oblique impact of Kelvin-Voigt solids by rings of traction, Coulomb's law in each of them.

No springs: the contact is cut into rings of uniform traction t, and the tangential displacement of
the surface follows from influence coefficients, those of the normal problem as Poisson's ratio is
zero (Johnson 1985, Contact Mechanics, section 3.4):

    alpha w' + w = K t,  |t| <= p,  w' = psi in rings that stick,
    psi' = -(15/4) chi Q,  Q = half the integral of t over the contact.

Pressure p is (2/pi) sqrt(b^2 - r^2) + (alpha v/pi)/sqrt(b^2 - r^2), the second term while loading
only, averaged over each ring. Units of `marching`, tractions such that Q is that of the springs.
"""

from itertools import pairwise

import numpy as np
from numpy.typing import NDArray
from scipy.special import ellipe, ellipk

from carom.dimensionless.numerics.arrays import Array
from carom.dimensionless.twins.marching_motion import kelvin_voigt

Signs = NDArray[np.int64]

STEPS = 4  # in time, to a ring
ROUNDS = 60
AT_REST = 1e-14
OUTSIDE = 9  # instead of a sign of slip


def extrapolated(psi: float, chi: float, alpha: float, rings: int = 200) -> float:
    """Return psi_2 by Richardson extrapolation over three numbers of rings, halved twice.

    psi_2 = (8 r(rings) - 6 r(rings/2) + r(rings/4))/3, of first order each

    >>> from carom.dimensionless.twins.rings import extrapolated
    >>> round(extrapolated(1.5, 1.44, 0.0576035799), 3)  # e = 0.9
    -0.367
    """
    return richardson(*(march_rings(psi, chi, alpha, rings // part) for part in (4, 2, 1)))


def richardson(coarse: float, middle: float, fine: float) -> float:
    """Return the limit of what is of first order, from three numbers of rings, each doubled."""
    return (8.0 * fine - 6.0 * middle + coarse) / 3.0


def march_rings(psi: float, chi: float, alpha: float, rings: int) -> float:
    """Return psi_2, to first order in the width of the rings and the steps in time.

    >>> from carom.dimensionless.twins.rings import march_rings
    >>> round(march_rings(9.0, 1.44, 0.0576035799, 200), 3)  # slides throughout
    3.528
    """
    motion = kelvin_voigt(float(alpha), STEPS * rings)
    edges = np.linspace(0.0, motion[:, 3].max(), rings + 1)
    middles, areas = 0.5 * (edges[1:] + edges[:-1]), np.pi * np.diff(edges**2)
    influence = np.diff(displacement(middles[:, None], edges[None, :]), axis=1)
    w, slips, force = np.zeros(rings), np.zeros(rings, dtype=np.int64), 0.0
    for before, after in pairwise(motion):
        dt, kick = after[1] - before[1], 0.5 * (after[0] - before[0]) * 3.75 * chi
        psi -= kick * before[2] * force
        decay = np.exp(-dt / alpha)
        pressure = np.diff(load_within(edges, after[3], after[4])) / areas
        wanted = psi * dt + w * (1.0 - decay)
        matrix = (1.0 - decay) * influence
        traction, slips = tractions(matrix, wanted, pressure, slips)
        w = w * decay + matrix @ traction
        force = 0.5 * float(traction @ areas)
        psi -= kick * after[2] * force
    return float(psi)


def displacement(r: Array, a: Array) -> Array:
    """Return the displacement at radii r under unit traction on discs of radii a."""
    with np.errstate(divide="ignore", invalid="ignore"):
        inside = a * ellipe((r / a) ** 2)
        square = (a / r) ** 2
        outside = r * (ellipe(square) - (1.0 - square) * ellipk(square))
    return np.asarray(4.0 / np.pi * np.where(a > r, inside, outside))


def load_within(r: Array, b: float, limit: float) -> Array:
    """Return the integral of the pressure inside radii r; limit is D, b^2 + alpha v in loading."""
    rest = np.sqrt(np.maximum(b * b - np.minimum(r, b) ** 2, 0.0))
    return np.asarray(4.0 / 3.0 * (b**3 - rest**3) + 2.0 * (limit - b * b) * (b - rest))


def tractions(matrix: Array, wanted: Array, pressure: Array, slips: Signs) -> tuple[Array, Signs]:
    """Return tractions within the pressure, matrix t = wanted where rings stick, and what slips.

    The rings that stick are found by trial, from those of the step before.
    """
    signs = np.where(pressure > 0.0, slips, OUTSIDE)
    for _ in range(ROUNDS):
        sticks = signs == 0
        found = np.where(sticks | (signs == OUTSIDE), 0.0, signs * pressure)
        if sticks.any():
            rest = wanted[sticks] - (matrix @ found)[sticks]
            found[sticks] = np.linalg.solve(matrix[np.ix_(sticks, sticks)], rest)
        slip = wanted - matrix @ found
        beyond = sticks & (np.abs(found) > pressure)
        stops = (np.abs(signs) == 1) & (signs * slip < -AT_REST)
        others = np.where(beyond, np.sign(found), np.where(stops, 0, signs)).astype(np.int64)
        if np.array_equal(others, signs):
            return found, np.where(signs == OUTSIDE, 0, signs)
        signs = others
    raise ArithmeticError("the rings that stick are not found")
