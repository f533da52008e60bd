"""Impacts of metals that yield against an ODE, rings of traction, and springs marched plainly.

Rings obey Coulomb's law at every point of the true contact, under the same pressure. Springs do
not, quite: over 140 impacts up to V_1 = 300 V_y psi_2 differs by at most 0.067, near psi_1 = 1,
mostly by less than 0.005.
"""

import numpy as np
import pytest
from numpy.typing import NDArray
from tests.oracles import rings
from tests.oracles.metal import by_fine_springs, by_rings, impact, load_within, loading

from carom.dimensionless.elastic.phases import Status
from carom.dimensionless.lossy.law import Loss, LossNumbers
from carom.dimensionless.lossy.layout import PSI_OUT
from carom.dimensionless.lossy.springs.march import marched
from carom.dimensionless.lossy.springs.motion import Inertia, Solid
from carom.dimensionless.rebounds import LossyRebounds, lossy_rebounds

Array = NDArray[np.float64]


def solved(psi: float, chi: float, ratio: float, strain: float) -> LossyRebounds:
    """Return an impact, which must be solved."""
    losses = LossNumbers(Loss.METAL, ratio**-0.4, strain)
    rebounds = lossy_rebounds(np.array([psi]), np.array([chi]), losses)
    assert rebounds.status[0] == Status.SOLVED
    return rebounds


@pytest.mark.first_case
@pytest.mark.parametrize(
    ("ratio", "strain"), [(2.3, 0.002), (3.0, 0.002), (10.0, 0.004), (50.0, 0.008), (1000.0, 0.002)]
)
def test_normal_motion_is_that_of_an_ode(ratio: float, strain: float) -> None:
    """Restitution by energy and by motion, work of the load, time, and the largest values."""
    wanted, actual = impact(ratio**-0.4, strain, 200), solved(1.0, 1.44, ratio, strain)
    assert wanted.work == pytest.approx(1.0, abs=1e-8)
    assert wanted.speed == pytest.approx(wanted.restitution, abs=1e-8)
    assert actual.restitution[0] == pytest.approx(wanted.restitution, abs=3e-6)
    assert actual.duration[0] == pytest.approx(wanted.time[-1], abs=5e-6)
    assert actual.max_radius[0] == pytest.approx(wanted.edge.max(), abs=5e-6)
    assert actual.max_pressure[0] == pytest.approx(wanted.levels[-1], abs=5e-6)


def test_rings_bear_the_load() -> None:
    """4/3 of the load while loading, none at the end; at first inside a radius as Hertz's."""
    found, y, strain = impact(0.4, 0.004, 60), 0.4, 0.004
    for i in (1, 20, 40, found.turn):
        depth = np.interp(found.edge[i] ** 2, *_squares(y, strain))
        load = loading(y, strain, np.array(depth))[0]
        assert load_within(np.array([2.0]), found, i)[0] == pytest.approx(4 / 3 * load, rel=1e-5)
    assert load_within(np.array([2.0]), found, found.time.size - 1)[0] == pytest.approx(
        0, abs=1e-12
    )
    half = load_within(0.5 * found.edge[[1]], found, 1)[0]
    whole = load_within(np.array([2.0]), found, 1)[0]
    assert half / whole == pytest.approx(1.0 - 0.75**1.5, rel=1e-9)


def _squares(y: float, strain: float) -> tuple[Array, Array]:
    """Return squared edges and the depths at which they are reached."""
    depths = np.linspace(0.0, 2.0, 400001)
    return loading(y, strain, depths)[1], depths


@pytest.mark.slow
@pytest.mark.parametrize(
    ("psi", "chi", "ratio", "strain", "close"),
    [
        (4.0, 1.2, 12.0, 0.003, 5e-3),
        (0.3, 0.8, 40.0, 0.005, 0.02),
        (0.932, 3.223, 106.3, 0.00138, 0.07),  # the worst of 140
    ],
)
def test_rings_of_traction(
    psi: float, chi: float, ratio: float, strain: float, close: float
) -> None:
    counts = (20, 40, 80)
    wanted = rings.richardson(*(by_rings(psi, chi, ratio**-0.4, strain, n) for n in counts))
    actual = solved(psi, chi, ratio, strain).psi_out[0]
    assert actual == pytest.approx(wanted, abs=close)
    if close == 0.07:
        assert abs(actual - wanted) > 0.04


@pytest.mark.slow
@pytest.mark.parametrize(
    ("psi", "chi", "ratio", "close"),
    [
        pytest.param(0.9, 1.44, 10.0, 1e-5, marks=pytest.mark.slow),
        (2.0, 1.44, 10.0, 1e-5),
        (1.0, 1.44, 100.0, 5e-5),
    ],
)
def test_springs_marched_plainly(psi: float, chi: float, ratio: float, close: float) -> None:
    """Springs and times of their own, extrapolated."""
    wanted = by_fine_springs(psi, chi, ratio**-0.4, 0.004, 500)
    assert solved(psi, chi, ratio, 0.004).psi_out[0] == pytest.approx(wanted, abs=close)


@pytest.mark.slow
def test_error_is_of_second_order_and_what_is_promised() -> None:
    """chi in [0.3, 8], V_1 up to 100 V_y, up to gross slip: 3e-5 max(1, psi_1)."""
    rng = np.random.default_rng(7)
    chi, ratio = rng.uniform(0.3, 8.0, 40), 2.3 * (100.0 / 2.3) ** rng.random(40)
    psi, strain = rng.random(40) * (4.0 * chi + 0.5), rng.uniform(0.001, 0.008, 40)
    values, actual = np.empty((40, 4)), np.empty(40)
    for i, point in enumerate(zip(psi, chi, ratio, strain, strict=True)):
        actual[i] = solved(*point).psi_out[0]
        solid = Solid(int(Loss.METAL), ratio[i] ** -0.4, 0.0, strain[i])
        for j, count in enumerate((100, 200, 400, 800)):
            values[i, j] = marched(psi[i], Inertia(chi[i]), solid, count)[PSI_OUT]
    fine = (4.0 * values[:, 3] - values[:, 2]) / 3.0
    errors = np.abs(values[:, :3] - fine[:, None])
    assert np.median(np.log2(errors[:, 0] / errors[:, 2]) / 2.0) == pytest.approx(2.0, abs=0.1)
    assert np.max(np.abs(actual - fine) / np.maximum(1.0, psi)) < 3e-5
