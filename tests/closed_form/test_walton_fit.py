"""Walton's parameters fitted to the exact rebound, against a search over a grid of them."""

import numpy as np
import pytest

import carom

PSI = np.linspace(0.0, 1.0, 1001)


def pair_with(poisson, friction=0.3):
    stuff = carom.Material(young="1 GPa", poisson=poisson, density=1000)
    ball = carom.Sphere(radius="10 mm", material=stuff)
    return carom.Pair(ball, carom.HalfSpace(material=stuff), friction=friction)


def walton(psi, chi, one_plus_beta, ratio):
    """psi_2 of Walton's law with friction `ratio` times that of the pair."""
    return psi - np.minimum(one_plus_beta * psi, 4.0 * chi * ratio)


@pytest.mark.parametrize("poisson", [0.0, 0.3, 0.5])
@pytest.mark.parametrize("span", [None, 2.5])
def test_no_other_parameters_on_a_grid_come_closer(poisson, span):
    pair = pair_with(poisson)
    fit = carom.laws.fit_walton(pair, span)
    psi = PSI * fit.span
    exact = carom.rebound(psi, pair.chi)

    def rms(one_plus_beta, ratio):
        return np.sqrt(np.mean((walton(psi, pair.chi, one_plus_beta, ratio) - exact) ** 2))

    best = min(
        rms(beta, ratio)
        for beta in np.linspace(0.0, 2.0, 41)
        for ratio in np.linspace(0.4, 1.2, 41)
    )
    assert fit.rms_error <= best * 1.001
    one_plus_beta = 1.0 + fit.law.tangential_restitution
    ratio = fit.law.friction / pair.friction
    assert fit.rms_error == pytest.approx(rms(one_plus_beta, ratio), rel=0.01)
    error = np.abs(walton(psi, pair.chi, one_plus_beta, ratio) - exact)
    assert fit.max_error == pytest.approx(error.max(), rel=0.01)


def test_fitted_law_collides_as_its_error_says():
    """In three dimensions the contact point leaves within the largest error of the fit."""
    pair = pair_with(0.3)
    fit = carom.laws.fit_walton(pair)
    slope = PSI * fit.span * pair.friction / pair.kappa
    velocity = np.stack([slope, np.zeros_like(slope), np.ones_like(slope)], axis=1)
    leave = [
        carom.collide(pair, velocity1=velocity, normal=[0.0, 0.0, 1.0], law=law)
        for law in (None, fit.law)
    ]
    contact = [after.velocity1[:, 0] + 0.01 * after.spin1[:, 1] for after in leave]
    error = np.abs(contact[1] - contact[0]) * pair.kappa / pair.friction
    assert error.max() == pytest.approx(fit.max_error, rel=0.02)


def test_friction_stays_where_the_span_does_not_reach_sliding():
    fit = carom.laws.fit_walton(pair_with(0.3), 1.0)
    assert fit.law.friction == pytest.approx(0.3)
    assert fit.rms_error < 0.05


@pytest.mark.parametrize(("friction", "span"), [(0.0, None), (0.3, 0.0), (0.3, np.nan)])
def test_what_cannot_be_fitted_is_refused(friction, span):
    with pytest.raises(carom.InputError):
        carom.laws.fit_walton(pair_with(0.3, friction), span)
