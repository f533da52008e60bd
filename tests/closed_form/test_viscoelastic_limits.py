"""What is known of impacts of Kelvin-Voigt solids: what slides throughout, and small losses."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

import carom
from carom.dimensionless.lossy.law import Loss, LossNumbers
from carom.dimensionless.lossy.viscoelastic.normal import viscous_loss
from carom.dimensionless.rebounds import lossy_rebounds, regime_borders


def psi_out(psi, chi, e):
    psi, chi, e = np.broadcast_arrays(*map(np.atleast_1d, (psi, chi, e)))
    alpha = np.array([viscous_loss(each) for each in e])
    losses = LossNumbers(Loss.VISCOUS, alpha)
    return lossy_rebounds(psi.astype(float), chi.astype(float), losses).psi_out


@pytest.mark.parametrize("e", [0.1, 0.3, 0.6, 0.9, 0.99])
def test_sliding_throughout(e):
    """psi_2 = psi_1 - 2 chi (1 + e) for psi_1 >= 2 chi (1 + e) - e, or 1 if chi <= 1/2, only."""
    for chi in (0.2, 0.5, 0.8, 1.44, 3.0):
        border = 2.0 * chi * (1.0 + e) - e if chi > 0.5 else 1.0
        slides = border + np.array([1e-6, 0.3, 4.0])
        assert_allclose(psi_out(slides, chi, e), slides - 2.0 * chi * (1.0 + e), atol=1e-9)
        stops = border - 0.05
        assert psi_out(stops, chi, e)[0] > stops - 2.0 * chi * (1.0 + e) + 1e-6


@pytest.mark.parametrize("e", [0.05, 0.3, 0.9, 0.999])
def test_chi_of_one_half(e):
    """psi stays in proportion to v: all sticks, and psi_2 = -e psi_1; close to it, nearly so."""
    psi = np.array([1e-3, 0.2, 0.95, 1.0])
    assert_allclose(psi_out(psi, 0.5, e), -e * psi, atol=1e-9)
    for beside in 10.0 ** -np.arange(5.0, 15.0):
        for chi in (0.5 - beside, 0.5 + beside):
            assert_allclose(psi_out(psi, chi, e), -e * psi, atol=4.0 * beside + 1e-8)


@pytest.mark.parametrize(("chi", "e"), [(1.44, 0.9), (0.8, 0.3), (3.0, 0.6)])
def test_borders_of_regimes(chi, e):
    """Slip in gross from the touch ends at the largest compression for psi_1 = 2 chi at any e."""
    law = carom.KelvinVoigt(restitution=e)
    assert_allclose(regime_borders(chi, e), [1.0, 2.0 * chi, max(2.0 * chi * (1.0 + e) - e, 1.0)])
    for change in (-1e-3, 1e-3):
        solution = carom.solve(2.0 * chi + change, chi, losses=law)
        speed = solution.at(solution.phases[0].end).speed[0]
        assert speed == pytest.approx(-change / (2.0 * chi - 1.0), rel=0.01)
    assert carom.solve(0.999, chi, losses=law).phases[0].kind == "stick"


def test_borders_beyond_the_largest_number_are_infinite():
    assert regime_borders(1.7e308, 0.9).tolist() == [1.0, np.inf, np.inf]
