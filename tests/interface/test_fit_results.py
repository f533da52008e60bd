"""Results of `fit`: samples of the posterior, datasets, figures, words."""

import json
import re
import sys

import numpy as np
import pytest
from tests.checks import refused

import carom
from carom.lab.fitting import fit
from carom.lab.fitting.comparison import Comparison, LawFit
from carom.plots.fits import plot_corner, plot_fit
from carom.plots.regimes import REGIMES
from carom.quantities.glossary import GLOSSARY

MU = 0.12
BALL = carom.Sphere(radius="2.5 mm", material="steel")
PAIR = carom.Pair(BALL, carom.HalfSpace(material="steel"), friction=MU)
DEGREES = np.array([4.0, 9.0, 14.0, 19.0, 24.0, 29.0, 34.0, 45.0, 60.0])


@pytest.fixture(scope="module")
def data():
    random = np.random.default_rng(8)
    hits = [carom.impact(PAIR, speed=2.0, angle=f"{angle} deg") for angle in DEGREES]
    beta = -np.array([hit.contact_restitution for hit in hits]) + random.normal(0.0, 0.02, 9)
    spin = np.array([hit.spin_out for hit in hits]) + random.normal(0.0, 5.0, 9)
    before = {"angle [deg]": DEGREES, "speed": np.full(9, 2.0)}
    error = np.full(9, 0.02)
    return {**before, "contact_beta": beta, "contact_beta_error": error, "spin_out": spin}


@pytest.fixture(scope="module")
def result(data):
    return fit(data, pair=PAIR, fixed={"restitution": 1.0})


def test_posterior_agrees_with_the_profile(data):
    """Squares and many values: quantiles of the samples are the ends of the profile interval."""
    entries = {**data, "spin_out_error": np.full(9, 5.0)}
    squares = fit(entries, pair=PAIR, fixed={"restitution": 1.0}, robust=False)
    samples = squares.posterior(steps=700, seed=3)
    for name in ("friction", "kappa", "chi"):
        low, high = np.quantile(samples[name].values, [0.025, 0.975])
        width = squares[name].high - squares[name].low
        assert low == pytest.approx(squares[name].low, abs=0.1 * width)
        assert high == pytest.approx(squares[name].high, abs=0.1 * width)
    assert samples.attrs["converged"] == 1


@pytest.mark.slow
def test_posterior_of_a_robust_fit_agrees_with_the_profile():
    """One parameter, many values, three of them wild: its likelihood has the scale of the loss."""
    random = np.random.default_rng(12)
    ratios = np.append(random.normal(0.15, 0.01, 60), [0.3, 0.35, 0.02])
    data = {"angle [deg]": np.full(63, 75.0), "impulse_ratio": ratios}
    for errors in ({}, {"impulse_ratio_error": np.full(63, 0.01)}):
        actual = fit(data | errors, pair=PAIR, fixed={"restitution": 1.0}, vary="friction")
        samples = actual.posterior(steps=1000, seed=4).friction.values
        low, high = np.quantile(samples, [0.025, 0.975])
        width = actual.friction.high - actual.friction.low
        assert low == pytest.approx(actual.friction.low, abs=0.04 * width)
        assert high == pytest.approx(actual.friction.high, abs=0.04 * width)


def test_posterior_depends_on_its_seed_alone(result):
    one, same, other = (result.posterior(steps=100, seed=seed) for seed in (5, 5, 6))
    np.testing.assert_array_equal(one.friction.values, same.friction.values)
    assert not np.array_equal(one.friction.values, other.friction.values)
    refused("at least 100", result.posterior, steps=20)


def test_a_stored_fit_is_drawn_without_fitting(result, tmp_path):
    stored = carom.read(carom.save(result, tmp_path / "fit.nc"))
    assert stored.value.sel(parameter="friction").item() == result.friction.value
    np.testing.assert_array_equal(stored.measured, result.to_dataset().measured)
    figure = plot_fit(stored)
    assert len(figure.axes) == 4  # curves and residuals of two responses
    names = [str(name) for name in stored["response"].values]
    labels = [f"{name.replace('_', ' ')} {GLOSSARY[name].symbol}" for name in names]
    assert {axis.get_ylabel().split("\u00a0")[0] for axis in figure.axes} == {*labels, "residual"}
    names = [text.get_text() for text in figure.legends[0].get_texts()]
    assert names == ["exact", "rigid Coulomb", "Walton", *REGIMES]  # as in all figures


def test_dataset_holds_data_curves_and_residuals(result, data):
    stored = result.to_dataset()
    beta = stored.sel(response="contact_beta")
    np.testing.assert_allclose(beta.measured - beta.expected, beta.residual)
    np.testing.assert_allclose(np.degrees(stored.incidence), DEGREES)
    curve = beta.curve_expected.sel(law="exact")
    at_data = np.interp(stored.incidence, stored.curve_incidence, curve)
    np.testing.assert_allclose(at_data, beta.expected, atol=2e-3)
    assert np.all(beta.curve_low < curve)
    assert np.all(curve < beta.curve_high)
    border = np.arctan(result.friction.value / result.kappa.value)
    assert stored.border.values[0] == pytest.approx(border)


def test_rival_curves_are_their_laws(result):
    """Rigid Coulomb: beta = 0 in stick, else mu (1 + e)(m_n/m_t) V_n/V_x - 1."""
    stored = result.to_dataset().sel(response="contact_beta")
    mu = result.comparison["rigid Coulomb"].values["friction"]
    slides = 2.0 * mu * 3.5 / np.tan(stored.curve_incidence.values)
    expected = np.minimum(slides, 1.0) - 1.0
    np.testing.assert_allclose(stored.curve_expected.sel(law="rigid Coulomb"), expected, atol=1e-12)


def test_json_is_json(result):
    record = json.loads(json.dumps(result.to_dict(), allow_nan=False))
    assert record["parameters"]["friction"]["determined"]
    assert record["comparison"]["Walton"]["aicc"] > record["comparison"]["exact"]["aicc"]
    advice = json.loads(json.dumps(result.advice(2).to_dict(), allow_nan=False))
    assert len(advice["places"]) == 2


def test_text_names_value_and_ends(result):
    text = str(result)
    shown = re.search(r"friction +(\S+) \((\S+) to (\S+)\)", text)
    numbers = (result.friction.value, result.friction.low, result.friction.high)
    assert [float(each) for each in shown.groups()] == pytest.approx(numbers, abs=1e-4)
    assert "spin_out: the scatter gives a standard deviation" in text
    assert "the data rule out Walton" in text


def test_pair_of_the_fit_can_be_used_on(result):
    hit = carom.impact(result.pair, speed=2.0, angle="60 deg")
    impulse = 2.0 * result.pair.normal_mass * hit.normal_speed
    assert hit.tangential_impulse == pytest.approx(result.friction.value * impulse)


def test_figures_are_stored(result, tmp_path):
    result.plot(tmp_path / "fit.png")
    assert (tmp_path / "fit.png").stat().st_size > 10_000
    assert len(plot_corner(result.posterior(steps=200, seed=1)).axes) == 4
    refused(r"carom\.fit", plot_fit, carom.curve(1.44, [0.5, 1.0]))


def test_without_lmfit_one_line_says_what_to_install(data, monkeypatch):
    monkeypatch.setitem(sys.modules, "lmfit", None)
    refused(r"lmfit.*pip install 'carom\[fit\]'", fit, data, pair=PAIR)


@pytest.mark.parametrize(
    ("gap", "words"),
    [
        (10.1, "the data rule out Walton"),
        (9.9, "Walton is less likely than the exact law"),
        (2.1, "Walton is less likely than the exact law"),
        (1.9, "the data cannot tell Walton from the exact law"),
        (-1.9, "the data cannot tell Walton from the exact law"),
        (-2.1, "Walton describes the data better than the exact law"),
        (np.nan, "there are too few values to compare with Walton"),
    ],
)
def test_a_verdict_changes_at_2_and_at_10(gap, words):
    """Akaike's criterion: a lead of 2 is a hint, one of 10 is clear (Burnham & Anderson 2002)."""
    laws = (("exact", 5.0), ("Walton", 5.0 + gap))
    standings = tuple(LawFit(law, value, value, 0.5, None) for law, value in laws)
    assert Comparison(standings).verdict == words
