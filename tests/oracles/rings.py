"""The oblique impact by rings of traction, with Coulomb's law in each of them; no springs.

The contact is cut into rings of uniform traction t, and the tangential displacement w of the
surface follows from influence coefficients, those of the normal problem as Poisson's ratio is zero
(Johnson 1985, Contact Mechanics, section 3.4):

    w' = psi in rings that stick,  |t| <= p,  psi' = -(15/4) chi Q,  Q = half the integral of t,

    K t = w + alpha w' (Kelvin & Voigt), or w + g m, m' = w' - m/theta (g = 0: elastic).

The pressure is given by its integral inside radii, averaged over each ring. Lengths in
d_max, radii in sqrt(R d_max), time in d_max/V_1, tractions such that Q is (2/3) F_x/(mu P_max).
"""

from collections.abc import Callable
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp
from scipy.special import ellipe, ellipk

Array = NDArray[np.float64]
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


def richardson(coarse: float, middle: float, fine: float) -> float:
    """Return the limit of what is of first order, from three numbers of rings, each doubled."""
    return (8.0 * fine - 6.0 * middle + coarse) / 3.0


def loaded(_: float, state: Array) -> float:
    """Return what falls to zero at the end of loading."""
    return float(state[1])


def apart(_: float, state: Array) -> float:
    """Return what falls to zero as the bodies part."""
    return float(state[0])


for each in (loaded, apart):
    each.terminal, each.direction = True, -1.0


def viscous_motion(alpha: float, steps: int) -> tuple[Array, Array, Array]:
    """Return time, edge b and limit D at even steps of a clock, as many either side of v = 0.

    d(clock) = dt/(2 b). While loading b^2 = d, b' = v, v' = -(5/2) b^2 (b^2 + (3/2) alpha v) and
    D = b^2 + alpha v; then b^2 = D = d + alpha v, b' = v - (5/4) alpha b^3, v' = -(5/2) b^4.
    """
    state, parts = np.array([0.0, 1.0, 0.0]), []
    for drag, recession, ends in ((1.5 * alpha, 0.0, loaded), (0.0, 1.25 * alpha, apart)):

        def rates(_: float, s: Array, drag: float = drag, recession: float = recession) -> Array:
            b, v, _ = s
            return np.array([v - recession * b**3, -2.5 * b * b * (b * b + drag * v), 2.0 * b])

        accuracy = {"method": "DOP853", "rtol": 1e-13, "atol": 1e-15, "dense_output": True}
        run = solve_ivp(rates, (0.0, 50.0), state, events=ends, **accuracy)
        parts.append(run.sol(np.linspace(0.0, run.t[-1], steps // 2 + 1)[bool(parts) :]))
        state = run.y[:, -1]
    b, v, time = np.hstack(parts)
    b = np.maximum(b, 0.0)
    return time, b, b * b + alpha * np.maximum(v, 0.0)


def march_viscous(psi: float, chi: float, alpha: float, rings: int) -> float:
    """Return psi_2 of Kelvin-Voigt solids, to first order.

    p = (2/pi) sqrt(b^2 - r^2) + (alpha v/pi)/sqrt(b^2 - r^2), the second term while loading only.
    """
    time, edges, limits = viscous_motion(alpha, STEPS * rings)
    radii = np.linspace(0.0, edges.max(), rings + 1)
    loads = [load_within(radii, b, limit) for b, limit in zip(edges[1:], limits[1:], strict=True)]
    return march_rings(psi, chi, time, radii, np.array(loads), kelvin_voigt_solid(alpha))


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
        actual = np.where(sticks | (signs == OUTSIDE), 0.0, signs * pressure)
        if sticks.any():
            rest = wanted[sticks] - (matrix @ actual)[sticks]
            actual[sticks] = np.linalg.solve(matrix[np.ix_(sticks, sticks)], rest)
        slip = wanted - matrix @ actual
        beyond = sticks & (np.abs(actual) > pressure)
        stops = (np.abs(signs) == 1) & (signs * slip < -AT_REST)
        others = np.where(beyond, np.sign(actual), np.where(stops, 0, signs)).astype(np.int64)
        if np.array_equal(others, signs):
            return actual, np.where(signs == OUTSIDE, 0, signs)
        signs = others
    raise ArithmeticError("the rings that stick are not found")
