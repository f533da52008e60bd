"""The impact of spheres that adhere: the contact of Johnson, Kendall & Roberts, without slip.

Units are those of Hertz's impact at the same speed. With the radius b_0 of the contact at d = 0

    d = b^2 - b_0^(3/2) b^(1/2),  P = b^3 - (3/2) (b_0 b)^(3/2),
    v^2 = 1 - b^5 + (5/2) b_0^(3/2) b^(7/2) - (15/16) b_0^3 b^2 - (9/16) b_0^5,
    U'' = -(15/4) chi (b U - J).

J is that of (7.2). The contact jumps in at d = 0 and out where d is least, at b = b_0/16^(1/3).
"""

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

STICKING = 3.0 / 16.0 * (3.0 + 2.0 ** (-5.0 / 3.0))  # energy that pull-off takes, over b_0^5
NEWTON = 30  # steps, of which 10 are needed
SAMPLES = 65  # at which the deflection at the edge is looked at
ACCURACY = {"method": "DOP853", "rtol": 1e-12, "atol": 1e-13}


class Adhering(NamedTuple):
    """What comes of impacts; of those that stick the duration, psi_out and the release are NaN.

    The `release` is the largest q^2/(b b_0^3) for psi_1 = 1 as the edge recedes; nothing is lost to
    viscosity, so that `shear_lost` is 0.
    """

    psi_out: Any
    restitution: Any
    duration: Any
    max_penetration: Any
    max_force: Any
    max_radius: Any
    max_pressure: Any
    release: Any
    shear_lost: float = 0.0


def solve_adhering(psi: Any, chi: float, stickiness: Any) -> Adhering:
    """Return impacts at psi_1 whose sticking speed is `stickiness` times their normal speed."""
    psi, ratio = np.broadcast_arrays(np.asarray(psi, float), np.asarray(stickiness, float))
    first = (ratio**2 / STICKING) ** 0.2
    most = _largest_radius(first)
    thin = (first / most) ** 1.5
    leaves = ratio < 1.0
    out, duration, release = (np.full(ratio.shape, np.nan) for _ in range(3))
    if np.any(leaves):
        back, time, deflection = _shear(chi, thin[leaves])
        out[leaves] = psi[leaves] * back
        duration[leaves] = time / np.sqrt(most[leaves])
        with np.errstate(divide="ignore"):
            release[leaves] = deflection / (most[leaves] ** 2 * first[leaves] ** 3)
    return Adhering(
        out,
        np.sqrt(np.where(leaves, 1.0 - ratio**2, 0.0)),
        duration,
        most**2 * (1.0 - thin),
        most**3 * (1.0 - 1.5 * thin),
        most,
        most * (1.0 - 0.5 * thin),
        release,
    )


def _largest_radius(first: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return b at v = 0, by Newton's method from above, where v^2 is concave."""
    b = 1.0 + 2.0 * first
    for _ in range(NEWTON):
        rest = b**5 - 2.5 * first**1.5 * b**3.5 + 0.9375 * first**3 * b**2 + 0.5625 * first**5 - 1.0
        b = b - rest / (5.0 * b**4 - 8.75 * first**1.5 * b**2.5 + 1.875 * first**3 * b)
    return b


def _shear(
    chi: float, thin: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
    """Return psi_2/psi_1, the duration and the largest q^2/z^2 while the edge recedes.

    Here b is z^2 times the largest b, and time is counted in d_max/V_1 over the root of that b.
    While the edge advances y = psi, and as it recedes y = q at the edge in mirrored time, obey
    y'' = -k z^2 y, k = (15/4) chi. The solutions that begin as (1, 0) and (0, 1) are m and n at the
    turning point: when d is 0 again, psi = 2 m^2 - 1 and U = 2 m n. From there Q = b U.
    """
    touch, snap = np.arccos(np.cbrt(thin)), np.arccos(np.cbrt(0.25 * thin))
    states, z = _follow(chi, thin, (touch, 0.0 * touch), (1.0, 0.0, 0.0, 1.0, 0.0))
    y, other, m, n = states[:, 0], states[:, 2], states[-1, 0], states[-1, 2]
    advanced = 2.0 * m * (n * y - m * other) / z
    again = (2.0 * m * n, 2.0 * m**2 - 1.0, 2.0 * states[-1, -1])
    states, z = _follow(chi, thin, (touch, snap), again)
    edge = np.concatenate([advanced, states[:, 0] / z])
    return states[-1, 1], states[-1, 2], np.max(edge**2, axis=0)


def _follow(
    chi: float, thin: NDArray[np.float64], phases: tuple[Any, Any], begin: tuple[Any, ...]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return pairs of y and y', and the time, between two phi, and z = cos(phi), at samples.

    dt = (4 z^3 - thin)/sqrt(K) dphi, as v^2 = K sin(phi)^2.
    """
    start = np.stack([np.broadcast_to(each, thin.shape) for each in begin]).astype(float)
    first, last = phases

    def rates(share: float, flat: NDArray[np.float64]) -> NDArray[np.float64]:
        state = flat.reshape(start.shape)
        z = np.cos(first + (last - first) * share)
        rate = np.ones_like(state)
        rate[:-1:2], rate[1::2] = state[1::2], -3.75 * chi * z**2 * state[:-1:2]
        pace = np.abs(last - first) * (4.0 * z**3 - thin) / np.sqrt(_left(z, thin))
        return np.ravel(pace * rate)

    from scipy.integrate import solve_ivp  # a quarter of a second, for this alone

    at = np.linspace(0.0, 1.0, SAMPLES)
    solved = solve_ivp(rates, (0.0, 1.0), start.ravel(), t_eval=at, **ACCURACY)
    states = np.moveaxis(solved.y.reshape(*start.shape, SAMPLES), -1, 0)
    return states, np.cos(first + (last - first) * at[:, None])


def _left(z: NDArray[np.float64], thin: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return K = v^2/sin(phi)^2, in units of the largest b."""
    tenth, seventh = np.polyval([1.0] * 5, z**2), np.polyval([1.0] * 7, z) / (1.0 + z)
    return tenth - 2.5 * thin * seventh + 0.9375 * thin**2 * (1.0 + z**2)
