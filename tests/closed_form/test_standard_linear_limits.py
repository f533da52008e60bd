"""The standard linear solid where it is another one: elastic at once, relaxed, Kelvin & Voigt's."""

import numpy as np
import pytest

import carom
from carom.dimensionless.lossy.law import Loss, LossNumbers
from carom.dimensionless.rebounds import lossy_rebounds


def impacts():
    rng = np.random.default_rng(1948)
    return rng.uniform(0.1, 6.0, 12), rng.uniform(0.4, 3.0, 12)


def test_little_extra_modulus_is_the_elastic_impact():
    """The loss is linear in g, to the elastic solver's psi_2 within what is promised."""
    psi, chi = impacts()
    values = [lossy_rebounds(psi, chi, LossNumbers(Loss.RELAXING, 0.7, g)) for g in (2e-6, 1e-6)]
    limit = 2.0 * values[1].psi_out - values[0].psi_out
    assert limit == pytest.approx(carom.rebound(psi, chi), abs=2e-6)
    assert values[1].restitution == pytest.approx(np.ones(12), abs=2e-6)


@pytest.mark.parametrize("g", [0.5, 3.0])
def test_no_time_to_relax_is_the_elastic_impact_of_the_modulus_at_once(g):
    """psi_2 does not depend on the modulus; times are shorter by (1 + g)^(2/5)."""
    psi, chi = impacts()
    rebounds = lossy_rebounds(psi, chi, LossNumbers(Loss.RELAXING, 1e7, g))
    assert rebounds.psi_out == pytest.approx(carom.rebound(psi, chi), abs=3e-6)
    assert rebounds.duration == pytest.approx(2.9432751843 * (1.0 + g) ** -0.4, rel=1e-5)
    assert rebounds.max_force == pytest.approx((1.0 + g) ** 0.4, rel=1e-5)


def test_fast_relaxation_is_kelvin_voigt():
    """theta -> 0 at constant alpha = g theta: what differs is linear in theta."""
    psi, chi = impacts()
    viscous = lossy_rebounds(psi, chi, LossNumbers(Loss.VISCOUS, 0.1))
    far, near = (
        lossy_rebounds(psi, chi, LossNumbers(Loss.RELAXING, theta, 0.1 / theta))
        for theta in (0.002, 0.001)
    )
    assert np.max(np.abs(near.psi_out - viscous.psi_out)) < 3e-3
    assert 2.0 * near.psi_out - far.psi_out == pytest.approx(viscous.psi_out, abs=2e-4)
    assert 2.0 * near.restitution - far.restitution == pytest.approx(viscous.restitution, abs=2e-6)
    assert 2.0 * near.shear_lost - far.shear_lost == pytest.approx(
        viscous.shear_lost, abs=3e-3 * np.max(viscous.shear_lost)
    )
