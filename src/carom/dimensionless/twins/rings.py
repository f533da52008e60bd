"""The oblique impact by rings of traction, with Coulomb's law in each of them; no springs.

The contact is cut into rings of uniform traction t, and the tangential displacement w of the
surface follows from influence coefficients, those of the normal problem as Poisson's ratio is zero
(Johnson 1985, Contact Mechanics, section 3.4):

    w' = psi in rings that stick,  |t| <= p,  psi' = -(15/4) chi Q,  Q = half the integral of t,

    K t = w + alpha w' (Kelvin & Voigt), or w + g m, m' = w' - m/theta (g = 0: elastic).

The pressure is given by its integral inside radii, averaged over each ring. Units of `marching`,
tractions such that Q is that of the springs.
"""

from collections.abc import Callable
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray
from scipy.special import ellipe, ellipk

from carom.dimensionless.numerics.arrays import Array
from carom.dimensionless.twins.marching_motion import kelvin_voigt

Signs = NDArray[np.int64]
Solid = Callable[[Array, Array, float], tuple[float, Array, Array]]

STEPS = 4  # in time, to a ring
ROUNDS = 60
AT_REST = 1e-14
OUTSIDE = 9  # instead of a sign of slip


def kelvin_voigt_solid(alpha: float) -> Solid:
    """Return how w answers a traction over a step: w = c K t + rest, and what m is made of."""

    def answer(w: Array, m: Array, dt: float) -> tuple[float, Array, Array]:
        left = np.exp(-dt / alpha)
        return 1.0 - left, w * left, m

    return answer


def standard_linear_solid(extra: float, relaxation: float) -> Solid:
    """Return the same for w + g m = K t; m is fed by w at its mean rate. g = 0 is elastic."""

    def answer(w: Array, m: Array, dt: float) -> tuple[float, Array, Array]:
        left = np.exp(-dt / relaxation)
        kept = (1.0 - left) * relaxation / dt
        share = 1.0 / (1.0 + extra * kept)
        return share, share * extra * (kept * w - left * m), np.array([left, kept])

    return answer


def extrapolated(psi: float, chi: float, alpha: float, rings: int = 200) -> float:
    """Return psi_2 by Richardson extrapolation over three numbers of rings, halved twice.

    psi_2 = (8 r(rings) - 6 r(rings/2) + r(rings/4))/3, of first order each

    >>> from carom.dimensionless.twins.rings import extrapolated
    >>> round(extrapolated(1.5, 1.44, 0.0576035799), 3)  # e = 0.9
    -0.367
    """
    return richardson(*(march_viscous(psi, chi, alpha, rings // part) for part in (4, 2, 1)))


def richardson(coarse: float, middle: float, fine: float) -> float:
    """Return the limit of what is of first order, from three numbers of rings, each doubled."""
    return (8.0 * fine - 6.0 * middle + coarse) / 3.0


def march_viscous(psi: float, chi: float, alpha: float, rings: int) -> float:
    """Return psi_2 of Kelvin-Voigt solids, to first order.

    p = (2/pi) sqrt(b^2 - r^2) + (alpha v/pi)/sqrt(b^2 - r^2), the second term while loading only.

    >>> from carom.dimensionless.twins.rings import march_viscous
    >>> round(march_viscous(9.0, 1.44, 0.0576035799, 200), 3)  # slides throughout
    3.528
    """
    motion = kelvin_voigt(float(alpha), STEPS * rings)
    radii = np.linspace(0.0, motion[:, 3].max(), rings + 1)
    loads = np.array([load_within(radii, row[3], row[4]) for row in motion[1:]])
    return march_rings(psi, chi, motion[:, 1], radii, loads, kelvin_voigt_solid(alpha))


def march_rings(
    psi: float, chi: float, times: Array, radii: Array, loads: Array, solid: Solid
) -> float:
    """Return psi_2, to first order in the width of the rings and the steps in time.

    `loads` are integrals of the pressure inside the radii, at all times but the first.
    """
    middles, areas = 0.5 * (radii[1:] + radii[:-1]), np.pi * np.diff(radii**2)
    influence = np.diff(displacement(middles[:, None], radii[None, :]), axis=1)
    w, m = np.zeros(middles.size), np.zeros(middles.size)
    slips, force = np.zeros(middles.size, dtype=np.int64), 0.0
    for (before, after), load in zip(pairwise(times), loads, strict=True):
        dt = float(after - before)
        psi -= 0.5 * dt * 3.75 * chi * force
        share, rest, fed = solid(w, m, dt)
        matrix, wanted = share * influence, w + psi * dt - rest
        traction, slips = tractions(matrix, wanted, np.diff(load) / areas, slips)
        moved = matrix @ traction + rest
        m = fed[0] * m + fed[1] * (moved - w) if fed.size == 2 else m
        w, force = moved, 0.5 * float(traction @ areas)
        psi -= 0.5 * dt * 3.75 * chi * force
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
