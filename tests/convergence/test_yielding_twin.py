"""Impacts of yielding spheres against rings of traction, and against springs marched plainly.

Rings obey Coulomb's law at every point of the true contact, under Hertz's pressure cut at that of
yield and, while unloading, Hertz's of the radius R_p (Thornton 1997). Springs do not, quite: over
200 impacts up to V_1 = 10 V_y psi_2 differs by at most 0.047, near psi_1 = 1, mostly by less than
0.005.
"""

import numpy as np
import pytest
from numpy.typing import NDArray
from tests.oracles import rings
from tests.oracles.yielding import borne, by_fine_springs, by_rings, load_within, thornton

from carom.dimensionless.elastic.phases import Status
from carom.dimensionless.lossy.law import Loss, LossNumbers
from carom.dimensionless.lossy.layout import PSI_OUT
from carom.dimensionless.lossy.springs.march import marched
from carom.dimensionless.lossy.springs.motion import Inertia, Solid
from carom.dimensionless.rebounds import lossy_rebounds

Array = NDArray[np.float64]


def psi_out(psi: Array, chi: Array, y: Array) -> Array:
    """Return psi_2 of impacts, all of which must be solved."""
    rebounds = lossy_rebounds(psi, chi, LossNumbers(Loss.PLASTIC, y))
    assert np.all(rebounds.status == Status.SOLVED)
    return rebounds.psi_out


@pytest.mark.parametrize("y", [0.1, 0.4, 0.95])
def test_closed_motion_obeys_the_equations(y: float) -> None:
    """The impulse of the load is 1 + e, and d'' = -(5/4) P; time and e are the solver's."""
    time, depth, _, load = thornton(y, 2000)
    rebounds = lossy_rebounds(np.ones(1), np.ones(1), LossNumbers(Loss.PLASTIC, y))
    speed = 1.0 - np.append(0.0, np.cumsum(0.625 * (load[1:] + load[:-1]) * np.diff(time)))
    assert -speed[-1] == pytest.approx(rebounds.restitution[0], abs=1e-5)
    travelled = np.cumsum(0.5 * (speed[1:] + speed[:-1]) * np.diff(time))
    assert travelled == pytest.approx(depth[1:], abs=2e-5)
    assert time[-1] == pytest.approx(rebounds.duration[0], rel=1e-9)


def test_rings_bear_the_load() -> None:
    time, depth, edge, load = thornton(0.5, 50)
    turn = int(np.argmax(load))
    for i in range(time.size):
        peak = (load[turn], edge[turn]) if i > turn else ()
        whole = load_within(np.array([2.0]), 0.5, depth[i], edge[i], peak)
        assert whole[0] == pytest.approx(4.0 / 3.0 * load[i], abs=1e-12)


@pytest.mark.parametrize(
    ("psi", "chi", "ratio", "close"),
    [
        *((1.0, 1.44, 1.05, 5e-4), (4.177, 1.085, 1.5, 2e-3), (3.493, 0.688, 4.9, 2e-3)),
        (0.514, 0.974, 8.21, 0.015),
        (0.970, 1.415, 8.18, 0.05),  # the worst of 200
    ],
)
def test_rings_of_traction(psi: float, chi: float, ratio: float, close: float) -> None:
    y = ratio**-0.4
    wanted = rings.richardson(*(by_rings(psi, chi, y, count) for count in (20, 40, 80)))
    actual = psi_out(np.array([psi]), np.array([chi]), np.array([y]))[0]
    assert actual == pytest.approx(wanted, abs=close)
    if close == 0.05:
        assert abs(actual - wanted) > 0.03


def test_springs_bear_the_transform_of_the_pressure() -> None:
    for y, w in ((0.3, 0.05), (0.3, 0.4), (0.9, 1.5)):
        line = np.sqrt(w) * np.cos((np.arange(20000) + 0.5) * np.pi / 20000)  # sqrt(r^2 - x^2)
        weights = np.sqrt(w - line**2) * np.pi / 20000
        whole = 2.0 / np.pi * np.sum(np.minimum(np.sqrt(w - line**2), y) * weights)
        assert borne(np.array([w]), y)[0] == pytest.approx(whole, rel=1e-7)


@pytest.mark.first_case
@pytest.mark.parametrize(
    ("psi", "chi", "ratio", "count", "close"),
    [
        pytest.param(0.9, 1.4411764, 10.0, 2000, 3e-6, marks=pytest.mark.slow),  # to 0.3230771
        (1.53, 2.65, 2.1, 1000, 1e-5),
        (1.39, 7.06, 48.1, 1000, 3e-5),
    ],
)
def test_springs_marched_plainly(
    psi: float, chi: float, ratio: float, count: int, close: float
) -> None:
    """Springs and times of their own, extrapolated."""
    y = ratio**-0.4
    actual = psi_out(np.array([psi]), np.array([chi]), np.array([y]))[0]
    wanted = by_fine_springs(psi, chi, y, count)
    assert actual == pytest.approx(wanted, abs=close * max(1.0, psi))


def test_error_is_of_second_order_and_what_is_promised() -> None:
    """chi in [0.3, 8], V_1 up to 100 V_y, up to gross slip: 3e-5 max(1, psi_1)."""
    rng = np.random.default_rng(7)
    chi, y = rng.uniform(0.3, 8, 40), 100.0 ** (-0.4 * rng.random(40))
    psi = rng.random(40) * (4.0 * chi + 0.5)
    values = np.empty((40, 4))
    for i, (p, c, parameter) in enumerate(zip(psi, chi, y, strict=True)):
        for j, count in enumerate((100, 200, 400, 800)):
            solid = Solid(int(Loss.PLASTIC), parameter)
            values[i, j] = marched(p, Inertia(c), solid, count)[PSI_OUT]
    fine = (4.0 * values[:, 3] - values[:, 2]) / 3.0
    errors = np.abs(values[:, :3] - fine[:, None])
    assert np.median(np.log2(errors[:, 0] / errors[:, 2]) / 2.0) == pytest.approx(2.0, abs=0.1)
    assert np.max(np.abs(psi_out(psi, chi, y) - fine) / np.maximum(1.0, psi)) < 3e-5
