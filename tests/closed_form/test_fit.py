"""`fit` where the answer is known in closed form: lines of sliding impacts, means, roots."""

import numpy as np
import pytest
from scipy.optimize import minimize_scalar
from scipy.stats import norm, t

import carom
from carom.lab.fitting import fit
from carom.lab.fitting.problem import DEGREES, RobustLoss, scatter

MU, E = 0.15, 1.0
BALL = carom.Sphere(radius="5 mm", material="steel")
PAIR = carom.Pair(BALL, carom.HalfSpace(material="steel"), friction=0.3)


def sliding(seed=0, sigma=0.01, rows=20, **columns):
    """Return impacts that slide throughout: v_t' = v_t - mu (1 + e) V_n, with Gaussian errors."""
    noise = np.random.default_rng(seed).normal(0.0, sigma, rows)
    normal = np.linspace(0.5, 3.0, rows)
    fast = 5.0 * normal
    out = fast - MU * (1.0 + E) * normal + noise
    before = {"normal_speed": normal, "tangential_speed": fast}
    return {**before, "tangential_speed_out": out, **columns}


def line(data, sigma):
    """Return the slope of v_t - v_t' against V_n through the origin, and its standard deviation."""
    x, y = data["normal_speed"], data["tangential_speed"] - data["tangential_speed_out"]
    weights = np.broadcast_to(1.0 / np.asarray(sigma) ** 2, x.shape)
    whole = (weights * x * x).sum()
    return (weights * x * y).sum() / whole, whole**-0.5


def test_friction_of_sliding_impacts_is_the_slope_of_a_line():
    """Known errors: mu = slope/(1 + e), interval 1.96 standard deviations to either side."""
    data = sliding(tangential_speed_out_error=np.full(20, 0.01))
    result = fit(data, pair=PAIR, fixed={"restitution": E}, vary="friction", robust=False)
    slope, deviation = line(data, 0.01)
    assert result.friction.value == pytest.approx(slope / (1.0 + E), rel=1e-6)
    reach = norm.ppf(0.975) * deviation / (1.0 + E)
    assert result.friction.value - result.friction.low == pytest.approx(reach, rel=5e-3)
    assert result.friction.high - result.friction.value == pytest.approx(reach, rel=5e-3)


def test_errors_from_the_scatter_give_student_t():
    """Unknown errors: s^2 = sum r^2/(n - 1), and the quantile of t with n - 1 degrees."""
    data = sliding(seed=1)
    result = fit(data, pair=PAIR, fixed={"restitution": E}, vary="friction", robust=False)
    slope, per_sigma = line(data, 1.0)
    lost = data["tangential_speed"] - data["tangential_speed_out"]
    residual = lost - slope * data["normal_speed"]
    scatter = np.sqrt((residual**2).sum() / 19)
    reach = t.ppf(0.975, 19) * scatter * per_sigma / (1.0 + E)
    assert result.friction.high - result.friction.low == pytest.approx(2.0 * reach, rel=1e-2)


def test_errors_before_count_as_effective_variance():
    """sigma^2 = sigma_y^2 + (mu (1 + e) sigma_Vn)^2 row by row, in weights and interval."""
    rough = np.linspace(0.01, 0.3, 20)
    data = sliding(2, 0.05, tangential_speed_out_error=np.full(20, 0.05), normal_speed_error=rough)
    result = fit(data, pair=PAIR, fixed={"restitution": E}, vary="friction", robust=False)
    slope = MU * (1.0 + E)
    for _ in range(50):
        slope, deviation = line(data, np.hypot(0.05, slope * rough))
    assert result.friction.value == pytest.approx(slope / (1.0 + E), rel=1e-4)
    width = 2.0 * norm.ppf(0.975) * deviation / (1.0 + E)
    assert result.friction.high - result.friction.low == pytest.approx(width, rel=1e-2)
    plain, _ = line(data, 0.05)
    assert abs(plain - slope) > 1e-3 * slope  # the weights make a difference


def test_outliers_count_less():
    """The robust estimate of a constant is the likeliest centre of Student's t, as scipy has it."""
    values = np.append(np.random.default_rng(3).normal(MU, 0.01, 15), [0.4, 0.5])
    data = {
        "angle [deg]": np.full(17, 75.0),
        "impulse_ratio": values,
        "impulse_ratio_error": np.full(17, 0.01),
    }
    result = fit(data, pair=PAIR, fixed={"restitution": 1.0}, vary="friction")

    def against(mu, degrees):
        return -t.logpdf(values, degrees, mu, 0.01).sum()

    centres = [minimize_scalar(against, (0.14, 0.15, 0.16), args=(degrees,)) for degrees in DEGREES]
    likeliest = min(centres, key=lambda each: each.fun)
    assert result.friction.value == pytest.approx(likeliest.x, rel=1e-5)
    plain = fit(data, pair=PAIR, fixed={"restitution": 1.0}, vary="friction", robust=False)
    assert plain.friction.value == pytest.approx(values.mean(), rel=1e-5)


@pytest.mark.parametrize("degrees", [3.0, 30.0, np.inf])
def test_the_loss_is_that_of_student_or_of_squares(degrees):
    """-2 log density, as scipy has it; influence and slope are half its first two derivatives."""
    loss, r, h = RobustLoss(degrees), np.linspace(-30.0, 30.0, 601), 1e-4
    density = t(degrees).logpdf if np.isfinite(degrees) else norm.logpdf
    assert loss.root(r) ** 2 + loss.size == pytest.approx(-2.0 * density(r), rel=1e-12)
    assert np.array_equal(np.sign(loss.root(r)), np.sign(r))
    first = (loss.root(r + h) ** 2 - loss.root(r - h) ** 2) / (4.0 * h)
    assert loss.influence(r) == pytest.approx(first, abs=1e-7)
    second = (loss.influence(r + h) - loss.influence(r - h)) / (2.0 * h)
    assert loss.slope(r) == pytest.approx(second, abs=1e-7)


@pytest.mark.parametrize(
    ("used", "free"), [(0.0, 1.0), (5.0, 0.75), (19.0, 0.05), (20.0, 0.05), (30.0, 0.05)]
)
def test_scatter_of_squares_is_chi_squared_by_degrees_of_freedom(used, free):
    """sqrt(sum r^2/(n - k)); of no fewer degrees than n/20 however many parameters there are."""
    residuals = np.random.default_rng(4).normal(0.0, 3.0, (20, 1))
    there = np.ones((20, 1), bool)
    actual = scatter(residuals, there, np.array([used]), RobustLoss(np.inf))
    assert actual == pytest.approx([np.sqrt((residuals**2).mean() / free)], rel=1e-6)


def test_scatter_without_outliers_is_that_of_robust_and_squares_alike():
    """Both tell the standard deviation of Gaussian errors."""
    residuals = np.random.default_rng(5).normal(0.0, 3.0, (200_000, 1))
    there, used = np.ones(residuals.shape, bool), np.zeros(1)
    for degrees in (3.0, 30.0, np.inf):
        actual = scatter(residuals, there, used, RobustLoss(degrees))
        assert actual == pytest.approx([3.0], rel=0.01)


def test_restitution_is_the_weighted_mean_of_what_was_measured():
    errors = np.array([0.01, 0.02, 0.005, 0.03])
    values = np.array([0.82, 0.79, 0.805, 0.75])
    data = {"angle [deg]": np.full(4, 70.0), "normal_restitution": values}
    data["normal_restitution_error"] = errors
    result = fit(data, pair=PAIR, vary="restitution", robust=False)
    mean = (values / errors**2).sum() / (1.0 / errors**2).sum()
    assert result.restitution.value == pytest.approx(mean, abs=1e-7)
    reach = norm.ppf(0.975) * (1.0 / errors**2).sum() ** -0.5
    assert result.restitution.high - mean == pytest.approx(reach, rel=5e-3)


def test_criterion_of_known_errors_is_that_of_akaike():
    """AICc = -2 log L + 2 k n/(n - k - 1), here with k = 1 and n = 20."""
    data = sliding(tangential_speed_out_error=np.full(20, 0.01))
    result = fit(data, pair=PAIR, fixed={"restitution": E}, vary="friction", robust=False)
    slope, _ = line(data, 0.01)
    lost = data["tangential_speed"] - data["tangential_speed_out"]
    residual = lost - slope * data["normal_speed"]
    expected = -2.0 * norm.logpdf(residual, 0.0, 0.01).sum() + 2.0 * 20.0 / 18.0
    for law in ("exact", "rigid Coulomb"):
        assert result.comparison[law].criterion == pytest.approx(expected, rel=1e-8)


def test_halving_an_interval_of_a_mean_takes_three_times_as_many():
    """n values of an impulse ratio give sigma/sqrt(n): 3 n more halve it, wherever it slides."""
    data = {"angle [deg]": np.full(7, 70.0), "impulse_ratio": np.full(7, MU)}
    data["impulse_ratio_error"] = np.full(7, 0.01)
    result = fit(data, pair=PAIR, fixed={"restitution": 1.0}, vary="friction", robust=False)
    advice = result.advice(21)
    assert advice.best.needed == 21
    assert advice.shorter == pytest.approx(0.5, abs=2e-3)
    assert {place.regime for place in advice.places} == {"gross slip throughout"}
