"""`fit` against other algorithms: scipy on residuals of `rebound`, and profiles by brute force."""

import numpy as np
import pytest
from scipy.optimize import brentq, least_squares

import carom
from carom.dimensionless.rebound_tables import psi_at, psi_out, stored
from carom.dimensionless.rebounds import regime_borders
from carom.lab.fitting import fit

MU, SIGMA = 0.12, 0.02
BALL = carom.Sphere(radius="2.5 mm", material="steel")
FLOOR = carom.HalfSpace(material="steel")
PAIR = carom.Pair(BALL, FLOOR, friction=MU)
START = carom.Pair(BALL, FLOOR, friction=0.4)
ANGLES = np.radians([4.0, 9.0, 14.0, 19.0, 24.0, 29.0, 34.0, 45.0, 60.0])


@pytest.fixture(scope="module")
def data():
    """Impacts through all regimes, by `impact`, with Gaussian errors that are known."""
    hits = [carom.impact(PAIR, speed=2.0, angle=angle) for angle in ANGLES]
    noise = np.random.default_rng(4).normal(0.0, SIGMA, ANGLES.size)
    beta = -np.array([hit.contact_restitution for hit in hits]) + noise
    return {"angle": ANGLES, "contact_beta": beta, "contact_beta_error": np.full(9, SIGMA)}


@pytest.fixture(scope="module")
def result(data):
    return fit(data, pair=START, fixed={"restitution": 1.0}, robust=False)


def residuals(data, mu, kappa):
    """Return residuals in standard deviations, psi_2 from the phase solver point by point."""
    psi = kappa * np.tan(data["angle"]) / mu
    chi = 0.5 * kappa * PAIR.normal_mass / PAIR.tangential_mass
    return (data["contact_beta"] + carom.rebound(psi, chi) / psi) / SIGMA


def loss_with(data, name, value, guess):
    """Return the least sum of squares with one parameter held, the other by scipy."""

    def of(free):
        mu, kappa = (value, free[0]) if name == "friction" else (free[0], value)
        return residuals(data, mu, kappa)

    return 2.0 * least_squares(of, [guess], x_scale=0.1, xtol=1e-12, ftol=1e-12).cost


def test_best_fit_is_that_of_scipy(data, result):
    """Trust-region least squares in plain parameters finds the same minimum."""
    best = least_squares(
        lambda x: residuals(data, *x), [0.15, 0.9], x_scale=0.1, xtol=1e-12, ftol=1e-12
    )
    assert result.friction.value == pytest.approx(best.x[0], rel=2e-4)
    assert result.kappa.value == pytest.approx(best.x[1], rel=2e-4)
    assert result._best.sum == pytest.approx(2.0 * best.cost, abs=2e-3)


@pytest.mark.parametrize("name", ["friction", "kappa"])
def test_interval_ends_where_chi_squared_has_risen_by_its_quantile(data, result, name):
    """chi^2 of the profile, minimised anew by scipy, is 3.8415 above the least at both ends."""
    estimate = result[name]
    guess = result.kappa.value if name == "friction" else result.friction.value
    least = loss_with(data, name, estimate.value, guess)

    def excess(value):
        return loss_with(data, name, value, guess) - least - 3.841459

    low = brentq(excess, 0.75 * estimate.value, estimate.value, xtol=1e-6)
    high = brentq(excess, estimate.value, 1.35 * estimate.value, xtol=1e-6)
    width = high - low
    assert estimate.low == pytest.approx(low, abs=5e-3 * width)
    assert estimate.high == pytest.approx(high, abs=5e-3 * width)


@pytest.mark.first_case
@pytest.mark.parametrize(("chi", "e"), [(1.44, 0.6), (3.2, 0.99), (3.8, 0.95), (0.45, 0.9)])
def test_fits_with_losses_are_those_of_scipy_on_the_solver(chi, e):
    """Also where single psi_2 of the table are off by 2e-3: few are, and in both directions."""
    law, half = carom.KelvinVoigt(restitution=e), 0.5 * PAIR.normal_mass / PAIR.tangential_mass
    kappa, sigma = chi / half, 0.004
    psi = np.linspace(0.1, 1.15 * max(2.0 * chi * (1.0 + e) - e, 1.0), 14)
    slope = psi * MU / kappa
    noise = np.random.default_rng(2).normal(0.0, sigma, psi.size)
    beta = -carom.rebound(psi, chi, losses=law) / psi + noise

    def off(x):
        incoming = x[1] * slope / x[0]
        return (beta + carom.rebound(incoming, half * x[1], losses=law) / incoming) / sigma

    best = least_squares(off, [MU, kappa], x_scale=0.1, xtol=1e-12, ftol=1e-12, diff_step=1e-6)
    data = {"angle": np.arctan(slope), "contact_beta": beta}
    data["contact_beta_error"] = np.full(psi.size, sigma)
    actual = fit(
        data, pair=START, vary=("friction", "kappa"), fixed={"restitution": e}, robust=False
    )
    assert actual.friction.value == pytest.approx(best.x[0], rel=5e-5)
    assert actual.kappa.value == pytest.approx(best.x[1], rel=5e-5)
    for estimate in (actual.friction, actual.kappa):
        assert 1e-3 < (estimate.high - estimate.low) / estimate.value < 0.1


def test_interval_of_chi_is_that_of_kappa(result):
    ratio = 0.5 * PAIR.normal_mass / PAIR.tangential_mass
    assert result.chi.low == pytest.approx(ratio * result.kappa.low)
    assert result.chi.high == pytest.approx(ratio * result.kappa.high)


def test_a_start_far_away_ends_in_the_same_minimum(data, result):
    """psi_2 is not monotone; the scan keeps the fit out of side minima."""
    for friction in (0.01, 2.0):
        pair = carom.Pair(BALL, FLOOR, friction=friction)
        other = fit(data, pair=pair, fixed={"restitution": 1.0}, robust=False)
        assert other.friction.value == pytest.approx(result.friction.value, rel=1e-6)


@pytest.mark.first_case
@pytest.mark.parametrize(
    ("chis", "error"),
    [((0.248, 1.75), 1e-5), ((1.75, 2.2), 5e-5), ((2.2, 3.0), 5e-4), ((3.0, 4.09), 2e-3)],
)
def test_the_table_is_the_solver(chis, error):
    """psi_2 at random chi, e and psi_1, also close to kinks, to what the manual says; odd."""
    rng = np.random.default_rng(5)
    chi, e = rng.uniform(*chis, 60), rng.choice([1.0, 0.985, 0.93, 0.6, 0.35], 60)
    place = rng.uniform(0.0, 3.2, (60, 20))
    place[:, 15:] = [1.0, 1.0 + 1e-6, 2.0, 3.0 - 1e-9, 1e-7]
    psi = psi_at(place, *np.broadcast_arrays(chi[:, np.newaxis], e[:, np.newaxis], place)[:2])
    actual = psi_out(stored(), psi, chi, e)
    for one in np.unique(e):
        some, law = e == one, carom.KelvinVoigt(restitution=one)
        exact = carom.rebound(psi[some], chi[some, np.newaxis], losses=law)
        assert np.abs(actual[some] - exact).max() < error
    np.testing.assert_array_equal(psi_out(stored(), -psi, chi, e), -actual)
    assert np.all(np.abs(actual) <= np.abs(psi))


@pytest.mark.parametrize("chi", [0.3, 1.4412])
def test_curves_hardly_change_across_a_kink(chi):
    """psi_2 is continuous at the borders of the regimes."""
    borders = np.unique(regime_borders(chi))
    psi = np.sort(np.concatenate([borders - 1e-9, borders + 1e-9]))[np.newaxis]
    actual = psi_out(stored(), psi, np.array([chi]), np.array([1.0]))[0]
    assert np.abs(actual[1::2] - actual[::2]).max() < 1e-6
