"""Standard linear solids against rings of traction, under a normal motion of their own.

Rings obey Coulomb's law at every point, and share with the solver neither springs in shear nor the
normal motion, marched here on even springs and times. Over 8 impacts psi_2 differed by at most
1.4e-4, restitutions by 5e-6.
"""

import numpy as np
import pytest
from tests.oracles import rings
from tests.oracles.relaxing import by_rings

from carom.dimensionless.lossy.law import Loss, LossNumbers
from carom.dimensionless.lossy.springs.march import marched
from carom.dimensionless.lossy.springs.motion import Inertia, Solid
from carom.dimensionless.rebounds import lossy_rebounds


@pytest.mark.parametrize(
    ("psi", "chi", "g", "theta"),
    [(1.046, 1.097, 2.75, 0.14), (1.384, 1.522, 3.53, 1.46), (0.429, 0.709, 0.38, 2.12)],
)
def test_rings_of_traction(psi: float, chi: float, g: float, theta: float) -> None:
    values = [by_rings(psi, chi, g, theta, count) for count in (20, 40, 80)]
    solved = lossy_rebounds(np.array([psi]), np.array([chi]), LossNumbers(Loss.RELAXING, theta, g))
    wanted = rings.richardson(*(psi_out for psi_out, _ in values))
    assert solved.psi_out[0] == pytest.approx(wanted, abs=4e-4)
    assert solved.restitution[0] == pytest.approx(values[-1][1], abs=2e-5)
    assert abs(values[-1][0] - wanted) < 0.7 * abs(values[0][0] - wanted)


def test_error_is_of_second_order_and_what_is_promised() -> None:
    """chi in [0.3, 3], E_0/E from 1.2 to 11, theta from 0.01 to 10: 6e-6 with half the springs."""
    rng = np.random.default_rng(1966)
    psi, chi = rng.uniform(0, 6, 8), rng.uniform(0.3, 3, 8)
    theta, g = 10.0 ** rng.uniform(-2, 1, 8), 10.0 ** rng.uniform(-0.7, 1, 8)
    values = np.empty((8, 4))
    for i, source in enumerate(zip(theta, g, strict=True)):
        for j, count in enumerate((100, 200, 400, 800)):
            solid = Solid(int(Loss.RELAXING), *source)
            values[i, j] = marched(psi[i], Inertia(chi[i]), solid, count)[0]
    fine = (4.0 * values[:, 3] - values[:, 2]) / 3.0
    errors = np.abs(values[:, :3] - fine[:, None])
    assert np.median(np.log2(errors[:, 0] / errors[:, 2]) / 2.0) == pytest.approx(2.0, abs=0.15)
    coarser = (4.0 * values[:, 2] - values[:, 1]) / 3.0
    assert np.max(np.abs(coarser - fine) / np.maximum(1.0, psi)) < 6e-6
