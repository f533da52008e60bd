"""Standard linear solids against rings of traction, under a normal motion of their own.

Rings obey Coulomb's law at every point, and share with the solver neither springs in shear nor the
normal motion, marched here on even springs and times. Over 8 impacts psi_2 differed by at most
1.4e-4, restitutions by 5e-6.
"""

import numpy as np
import pytest
from numpy.typing import NDArray
from tests.oracles import rings

from carom.dimensionless.lossy.law import Loss, LossNumbers
from carom.dimensionless.lossy.rebounds import lossy_rebounds
from carom.dimensionless.lossy.springs.motion import Inertia, Solid
from carom.dimensionless.lossy.springs.rebounds import marched

Array = NDArray[np.float64]

WIDEST, SPRINGS = 1.1, 2000


def normal_motion(g: float, theta: float, dt: float) -> tuple[Array, Array, Array, float]:
    """Return times, the edges of even springs, what they bear then, and e."""
    width = WIDEST / SPRINGS
    squares = ((np.arange(SPRINGS) + 0.5) * width) ** 2
    k, apart = np.zeros(SPRINGS), np.zeros(SPRINGS, dtype=bool)
    left, d, v, load, time = np.exp(-dt / theta), 0.0, 1.0, 0.0, [0.0]
    borne = [np.zeros(SPRINGS)]
    while v > 0.0 or load > 0.0:
        v -= 0.625 * load * dt
        grown = np.maximum(d + v * dt - squares, 0.0) - np.maximum(d - squares, 0.0)
        d += v * dt
        k = k * left + grown * (1.0 - left) * theta / dt
        force = np.where(apart, 0.0, np.maximum(d - squares, 0.0) + g * k)
        if v < 0.0:
            apart |= force <= 0.0
        borne.append(np.maximum(force, 0.0))
        load = 1.5 * width * float(borne[-1].sum())
        v -= 0.625 * load * dt
        time.append(time[-1] + dt)
    return np.array(time), (np.arange(SPRINGS) + 1.0) * width, np.array(borne), -v


def by_rings(psi: float, chi: float, g: float, theta: float, count: int) -> tuple[float, float]:
    """Return psi_2 and e; a pressure is made of flat punches, of which each ends where a spring."""
    time, edges, borne, e = normal_motion(g, theta, 0.64 / count)
    widest = edges[np.flatnonzero(borne.max(axis=0)).max()]
    radii = np.linspace(0.0, widest, count + 1)
    root = np.sqrt(np.maximum(edges[:, None] ** 2 - radii[None, :] ** 2, 0.0))
    punches = -np.diff(borne[1:], axis=1, append=0.0)
    loads = 2.0 * punches @ (edges[:, None] - root)
    solid = rings.standard_linear_solid(g, theta)
    return rings.march_rings(psi, chi, time, radii, loads, solid), e


@pytest.mark.parametrize(
    ("psi", "chi", "g", "theta"),
    [(1.046, 1.097, 2.75, 0.14), (1.384, 1.522, 3.53, 1.46), (0.429, 0.709, 0.38, 2.12)],
)
def test_rings_of_traction(psi: float, chi: float, g: float, theta: float) -> None:
    found = [by_rings(psi, chi, g, theta, count) for count in (20, 40, 80)]
    solved = lossy_rebounds(np.array([psi]), np.array([chi]), LossNumbers(Loss.RELAXING, theta, g))
    wanted = rings.richardson(*(psi_out for psi_out, _ in found))
    assert solved.psi_out[0] == pytest.approx(wanted, abs=4e-4)
    assert solved.restitution[0] == pytest.approx(found[-1][1], abs=2e-5)
    assert abs(found[-1][0] - wanted) < 0.7 * abs(found[0][0] - wanted)


def test_error_is_of_second_order_and_what_is_promised() -> None:
    """chi in [0.3, 3], E_0/E from 1.2 to 11, theta from 0.01 to 10: 6e-6 with half the springs."""
    rng = np.random.default_rng(1966)
    psi, chi = rng.uniform(0, 6, 8), rng.uniform(0.3, 3, 8)
    theta, g = 10.0 ** rng.uniform(-2, 1, 8), 10.0 ** rng.uniform(-0.7, 1, 8)
    found = np.empty((8, 4))
    for i, given in enumerate(zip(theta, g, strict=True)):
        for j, count in enumerate((100, 200, 400, 800)):
            solid = Solid(int(Loss.RELAXING), *given)
            found[i, j] = marched(psi[i], Inertia(chi[i]), solid, count)[0]
    fine = (4.0 * found[:, 3] - found[:, 2]) / 3.0
    errors = np.abs(found[:, :3] - fine[:, None])
    assert np.median(np.log2(errors[:, 0] / errors[:, 2]) / 2.0) == pytest.approx(2.0, abs=0.15)
    coarser = (4.0 * found[:, 2] - found[:, 1]) / 3.0
    assert np.max(np.abs(coarser - fine) / np.maximum(1.0, psi)) < 6e-6
