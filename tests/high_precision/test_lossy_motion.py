"""Normal motion of the solver for impacts with losses against power series at 40 digits.

The table is that of `tests.oracles.kelvin_voigt`.
"""

from pathlib import Path

import numpy as np
import pytest
from scipy.special import beta

from carom.dimensionless.lossy.law import Loss, LossNumbers
from carom.dimensionless.lossy.viscoelastic.normal import restitution, viscous_loss
from carom.dimensionless.lossy.viscoelastic.work import new_work
from carom.dimensionless.rebounds import lossy_rebounds

WORK = new_work()

# alpha, restitution, duration, largest b^2, its time
TABLE = np.loadtxt(Path(__file__).parent / "kelvin_voigt.csv", delimiter=",")


def test_restitution_of_the_normal_motion_alone() -> None:
    values = [restitution(alpha, WORK) for alpha in TABLE[:, 0]]
    assert values == pytest.approx(TABLE[:, 1], abs=1e-13)


@pytest.mark.parametrize("psi", [0.0, 1e-6, 1e-3, 0.5, 2.0, 4.0, 7.9])
def test_normal_motion_of_oblique_impacts(psi: float) -> None:
    """The tangential motion leaves the normal one alone, however it cuts it into panels."""
    rows = np.ones(len(TABLE))
    rebounds = lossy_rebounds(psi * rows, 1.44 * rows, LossNumbers(Loss.VISCOUS, TABLE[:, 0]))
    assert rebounds.restitution == pytest.approx(TABLE[:, 1], abs=1e-10)
    assert rebounds.max_radius**2 == pytest.approx(TABLE[:, 3], abs=1e-10)
    assert rebounds.duration == pytest.approx(TABLE[:, 2], abs=3e-7)


def test_loss_and_restitution_are_inverse() -> None:
    """To 1e-10 over e in [0.001, 1], and alpha -> restitution -> alpha to 1e-9 of it."""
    wanted = np.concatenate([np.logspace(-3.0, 0.0, 60), 1.0 - np.logspace(-11, -1, 40)])
    values = [restitution(viscous_loss(e), WORK) for e in wanted]
    assert np.max(np.abs(values - wanted)) < 1e-12
    for alpha, e in TABLE[3:, :2]:
        assert viscous_loss(e) == pytest.approx(alpha, rel=1e-12)


def test_restitution_is_monotone() -> None:
    """e falls with alpha, from 1 at 0 to 0.0004 at 100."""
    values = [restitution(a, WORK) for a in (0.0, *np.logspace(-9, 2, 200))]
    assert values[0] == pytest.approx(1.0, abs=1e-15)
    assert np.all(np.diff(values) < 0.0)


def test_first_loss() -> None:
    """1 - e = (3/2) B(3/5, 3/2) alpha = 1.89171 alpha for small alpha."""
    slope = 1.5 * beta(0.6, 1.5)
    assert slope == pytest.approx(1.89171, abs=5e-6)
    for alpha in (1e-6, 1e-7):
        lost = 1.0 - restitution(alpha, WORK)
        assert lost / alpha == pytest.approx(slope, abs=2.0 * slope**2 * alpha + 1e-8)
    for gap in (1e-7, 1e-13):
        e = 1.0 - gap
        assert viscous_loss(e) == pytest.approx((1.0 - e) / slope, rel=1e-5 if gap > 1e-8 else 3e-3)
    assert viscous_loss(1.0) == 0.0
