"""Impacts of Kelvin-Voigt solids against two methods that share nothing with them, nor with each
other: springs, and rings of traction with Coulomb's law in each of them.

Over 60 impacts with chi from 0.1 to 5 and e from 0.3 to 0.95 psi_2 differed from the springs' by at
most 2e-7, half of what that changed by from 500 to 1000 springs, in the median by 1e-9.
"""

import numpy as np
import pytest
from tests.oracles import rings
from tests.oracles.march import extrapolated, march

import carom
from carom.dimensionless.elastic.phases import Status
from carom.dimensionless.lossy.law import Loss, LossNumbers
from carom.dimensionless.lossy.viscoelastic.normal import viscous_loss
from carom.dimensionless.rebounds import lossy_rebounds


def psi_out(psi, chi, alpha):
    """Return psi_2 of impacts, all of which must be solved."""
    psi, chi, alpha = map(np.atleast_1d, (psi, chi, alpha))
    rebounds = lossy_rebounds(psi, chi, LossNumbers(Loss.VISCOUS, alpha))
    assert np.all(rebounds.status == Status.SOLVED)
    return rebounds.psi_out


@pytest.mark.slow
def test_impacts_with_all_losses():
    """chi in [0.1, 5], e in [0.2, 1), psi up to where all slides; some fronts come back."""
    rng = np.random.default_rng(2026)
    chi, e = 0.1 * 50.0 ** rng.uniform(0.0, 1.0, 25), rng.uniform(0.2, 1.0, 25)
    psi = rng.uniform(0.01, 2.0, 25) * chi * (1.0 + e)
    alpha = np.array([viscous_loss(each) for each in e])
    for values, actual in zip(
        zip(psi, chi, alpha, strict=True), psi_out(psi, chi, alpha), strict=True
    ):
        assert actual == pytest.approx(extrapolated(*values), abs=1e-6), values


@pytest.mark.slow
@pytest.mark.parametrize(
    ("psi", "chi", "e"), [(6.93, 4.14, 0.95), (2.0, 1.44, 0.8), (5.0, 0.9, 0.55)]
)
def test_impacts_of_the_law(psi, chi, e):
    """KelvinVoigt(restitution=e) is the impact of the alpha of e; in one fronts come back."""
    actual = carom.rebound(psi, chi, losses=carom.KelvinVoigt(restitution=e))
    assert actual == pytest.approx(extrapolated(psi, chi, viscous_loss(e), springs=600), abs=1e-6)


NEARLY_ELASTIC = [(1.6, 4.9), (1.575, 4.9), (1.625, 5.0), (3.9, 7.2)]
SMALL = [1e-6, 2.6e-6, 5.3e-6, 1.06e-5, 2.6e-5, 5e-5]  # alpha: 1 - e is 1.9 of it


@pytest.mark.parametrize(("psi", "chi"), NEARLY_ELASTIC)
def test_what_small_losses_change_is_in_proportion_to_them(psi, chi):
    """Slip that stops while it is slower than can be told is over: it does not begin anew."""
    psis, chis = np.full(len(SMALL), psi), np.full(len(SMALL), chi)
    changes = psi_out(psis, chis, SMALL) - carom.rebound(psi, chi)
    ratio = changes / SMALL
    straight = ratio[0] + (ratio[-1] - ratio[0]) * (np.array(SMALL) - SMALL[0]) / (5e-5 - 1e-6)
    assert np.abs((ratio - straight) * SMALL).max() < 1e-9
    assert np.abs(changes).max() > 1e-4


@pytest.mark.slow
@pytest.mark.parametrize(("psi", "chi"), NEARLY_ELASTIC[:3])
def test_nearly_elastic_impacts(psi, chi):
    """Losses change them by 8e-5."""
    assert psi_out(psi, chi, 5.3e-6)[0] == pytest.approx(extrapolated(psi, chi, 5.3e-6), abs=4e-6)


@pytest.mark.slow
@pytest.mark.parametrize("e", [0.9999, 0.99998, 0.99999, 0.999998, 0.999999, 1.0 - 1e-9])
def test_nearly_elastic_impacts_are_solved(e):
    chi = np.linspace(0.3, 8.0, 40)
    psi = np.linspace(0.0, 1.0, 200)[:, np.newaxis] * (4.0 * chi + 2.0)
    law = carom.KelvinVoigt(restitution=e)
    _, status = carom.rebound(psi, chi, losses=law, return_status=True)
    assert not np.any(status)


@pytest.mark.slow
def test_march_is_of_second_order():
    """Where in a step a front stops is irregular: in the mean of impacts."""
    rng = np.random.default_rng(1911)
    values = rng.uniform((0.3, 0.6, 0.05), (3.0, 2.5, 0.4), (12, 3))
    exact = psi_out(*values.T)
    errors = [
        np.mean([abs(march(*one, n) - actual) for one, actual in zip(values, exact, strict=True)])
        for n in (125, 250, 500)
    ]
    assert errors[-1] < 1e-5
    assert 3.0 < errors[0] / errors[1] < 5.0
    assert 3.0 < errors[1] / errors[2] < 5.0


@pytest.mark.slow
@pytest.mark.parametrize(
    "e", [0.7, *(pytest.param(e, marks=pytest.mark.slow) for e in (0.9, 0.5, 0.3))]
)
def test_coulombs_law_in_every_ring(e):
    """Five impacts each agree to 1e-4; with twice the rings their errors are half as large."""
    alpha, errors = viscous_loss(e), []
    for psi, chi in ((0.5, 1.44), (1.5, 1.44), (3.0, 1.44), (1.2, 0.8), (2.5, 2.2)):
        exact = psi_out(psi, chi, alpha)[0]
        values = [rings.march_viscous(psi, chi, alpha, n) for n in (50, 100, 200)]
        assert rings.richardson(*values) == pytest.approx(exact, abs=1e-4), (psi, chi)
        errors.append(np.array(values) - exact)
    coarse, middle, fine = np.abs(errors).mean(axis=0)
    assert fine < 4e-3
    assert coarse / middle == pytest.approx(2.0, abs=0.15)
    assert middle / fine == pytest.approx(2.0, abs=0.15)
