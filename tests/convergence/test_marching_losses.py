"""The marching method with normal losses: second order, limits, energy, how slip spreads."""

from functools import cache

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.integrate import solve_ivp
from scipy.interpolate import CubicSpline
from scipy.special import beta

from carom.dimensionless.twins.marching import (
    extrapolated,
    march,
    march_history,
    march_on,
    march_slips,
)
from carom.dimensionless.twins.marching_motion import elastic, kelvin_voigt

Array = NDArray[np.float64]

SPRINGS = (125, 250, 500, 1000)
LOSSES = (0.02, 0.1, 0.2, 0.45)  # restitutions 0.96, 0.84, 0.71, 0.51


def order(found: Array, springs: tuple[int, ...] = SPRINGS) -> float:
    """Return the slope of log(1/error) against log(springs)."""
    return -float(np.polyfit(np.log(springs), np.log(found), 1)[0])


def restitution(alpha: float) -> float:
    """Return -v after the impact: dD/dt = v where contact ends at b = 0."""
    return -float(kelvin_voigt(alpha, 400)[-1, 5])


def impacts(seed: int, count: int) -> list[tuple[float, float, float]]:
    """Return psi, chi, alpha."""
    rng = np.random.default_rng(seed)
    columns = rng.uniform(0.0, 8.0, count), rng.uniform(0.5, 3.0, count)
    return list(zip(*columns, rng.uniform(0.02, 0.46, count), strict=True))


def test_first_loss_of_restitution() -> None:
    """1 - e = (3/2) B(3/5, 3/2) alpha for small alpha."""
    slope = [(1.0 - restitution(alpha)) / alpha for alpha in (1e-4, 2e-4)]
    assert 2.0 * slope[0] - slope[1] == pytest.approx(1.5 * beta(0.6, 1.5), abs=2e-7)


def test_error_of_impacts_is_of_second_order_and_small() -> None:
    cases = impacts(1976, 40)
    exact = np.array([extrapolated(*case[:2], 2000, 8000, case[2]) for case in cases])
    found = np.array([[march(*c[:2], n, 4 * n, c[2]) for n in SPRINGS] for c in cases])
    errors = np.abs(found - exact[:, np.newaxis])
    orders = [order(row) for row in errors]
    assert np.median(orders) == pytest.approx(2.0, abs=0.05)
    assert np.quantile(orders, 0.15) > 1.8
    assert np.quantile(orders, 0.85) < 2.2
    scaled = errors * np.square(SPRINGS)
    assert np.median(scaled) < 1.0
    assert np.max(scaled) < 10.0


def test_extrapolations_from_different_springs_agree() -> None:
    first = [extrapolated(psi, chi, 2000, 8000, alpha) for psi, chi, alpha in impacts(7, 40)]
    second = [extrapolated(psi, chi, 1700, 6800, alpha) for psi, chi, alpha in impacts(7, 40)]
    difference = np.abs(np.subtract(first, second))
    assert np.max(difference) < 3e-7
    assert np.median(difference) < 1e-8


@pytest.mark.parametrize(("psi", "chi"), [(0.5, 1.44), (1.5, 1.44), (3.5, 1.44), (5.5, 3.0)])
def test_vanishing_losses_give_the_elastic_impact(psi: float, chi: float) -> None:
    """What is left is in proportion to alpha."""
    exact = extrapolated(psi, chi, 2000, 8000)
    far, near = (extrapolated(psi, chi, 2000, 8000, a) - exact for a in (1e-3, 5e-4))
    assert far / near == pytest.approx(2.0, abs=0.03)
    assert extrapolated(psi, chi, 2000, 8000, 1e-9) == pytest.approx(exact, abs=1e-7)


@cache
def normal_motion(alpha: float) -> tuple[Array, Array, Array]:
    """Return b and t while loading; t, b and D of all the contact, and dt, by Runge & Kutta."""

    def rates(clock: float, y: Array, drag: float, recession: float) -> list[float]:
        b, v, _ = y
        return [v - recession * b**3, -2.5 * b**2 * (b**2 + drag * v), 2.0 * b]

    state, parts, laid = np.array([0.0, 1.0, 0.0]), [], np.empty(0)
    for row, drag, recession in ((1, 1.5 * alpha, 0.0), (0, 0.0, 1.25 * alpha)):
        stop = lambda clock, y, *_, row=row: y[row] if clock > 0.1 else 1.0  # noqa: E731
        stop.terminal = True
        run = solve_ivp(
            rates, (0.0, 9.0), state, "DOP853", args=(drag, recession), events=stop,
            rtol=1e-12, atol=1e-14, dense_output=True,
        )  # fmt: skip
        end = run.t[-1]
        clock = (np.arange(1500) + 0.5) * (end / 1500)
        y = run.sol(clock)
        parts.append([y[2], y[0], y[0] ** 2 + drag * y[1] / 1.5, 2.0 * y[0] * end / 1500])
        state = run.y[:, -1]
        if drag:
            laid = run.sol(np.linspace(0.0, end, 5001))[[0, 2]]
    times, edges, limits, spans = np.concatenate(parts, axis=1)
    return laid, np.array([times, edges, limits]), spans


@pytest.mark.parametrize("alpha", LOSSES)
@pytest.mark.parametrize("psi", [1.2, 2.5, 8.0])
def test_heavy_bodies_feel_the_friction_of_steady_sliding(psi: float, alpha: float) -> None:
    """For chi -> 0, U = psi_1 t, and with |D'| < 1 < psi_1 a spring met at t_s has
    q = min(psi_1 (t - t_s), D - s): a sum over places and times gives the impulse."""
    laid, motion, spans = normal_motion(alpha)
    met = CubicSpline(laid[0], laid[1])
    places = (np.arange(1500) + 0.5) / 1500
    impulse = 0.0
    for (t, b, limit), span in zip(motion.T, spans, strict=True):
        x = b * places
        q = np.minimum(psi * (t - met(x)), limit - x**2)
        impulse += float(np.mean(q)) * b * span
    chi = 1e-7
    found = (psi - extrapolated(psi, chi, 2000, 8000, alpha)) / chi
    assert found == pytest.approx(3.75 * impulse, rel=2e-6)
    assert 3.75 * impulse < 2.0 * (1.0 + restitution(alpha)) - 1e-6


@pytest.mark.parametrize("alpha", LOSSES[2:])
def test_fast_sliding_falls_short_of_gross_slip(alpha: float) -> None:
    """New springs stick at first: psi_2 - psi_1 + 2 chi (1 + e) is (15/8) chi alpha^2/psi_1 times
    the integral of v^2 db over the loading, to the first order in 1/psi_1."""
    laid = kelvin_voigt(alpha, 4000)[:2001]
    speed = np.gradient(laid[:, 3], laid[:, 0])
    expected = 1.875 * alpha**2 * np.trapezoid(speed**2, laid[:, 3])
    excess = [
        psi * (extrapolated(psi, 0.5, 2000, 8000, alpha) - psi + 1.0 + restitution(alpha))
        for psi in (25.0, 100.0)
    ]
    assert (4.0 * excess[1] - excess[0]) / 3.0 == pytest.approx(0.5 * expected, rel=5e-3)


def test_gross_slip_while_unloading() -> None:
    """psi - 2 chi v is constant while all springs slip and none are met, to second order."""
    psi, chi, alpha = 7.0, 1.0, 0.2
    found = []
    for n in SPRINGS:
        steps = 4 * n
        motion = kelvin_voigt(alpha, steps)[steps // 2 + 8 :]
        speed = motion[:, 5] + 1.25 * alpha * motion[:, 3] ** 3
        slips = march_slips(psi, chi, n, steps, alpha)[2][steps // 2 + 8 : -1]
        assert set(np.unique(slips)) == {1, 2}
        kept = march_history(psi, chi, n, steps, alpha)[steps // 2 + 8 :, 1] - 2.0 * chi * speed
        found.append(np.ptp(kept))
    assert found[-1] < 1e-6
    assert order(np.array(found)) == pytest.approx(2.0, abs=0.1)


@pytest.mark.parametrize(
    "impact", [(1.5, 1.44, 0.2), (5.0, 2.5, 0.45), (0.3, 2.0, 0.05), (8.0, 1.0, 0.3)]
)
def test_energy_is_kept_to_second_order(impact: tuple[float, float, float]) -> None:
    """psi^2/2 + (15/8) chi integral of q^2 + (15/4) chi W is constant; slip only loses."""
    psi, chi, alpha = impact
    found = []
    for n in SPRINGS:
        _, speed, _, _, stored, lost = march_history(psi, chi, n, 4 * n, alpha).T
        kept = 0.5 * speed**2 + 3.75 * chi * (0.5 * stored + lost)
        found.append(float(np.max(np.abs(kept - 0.5 * psi**2))))
        assert np.all(np.diff(lost) >= 0.0)
        assert stored[-1] == 0.0
    assert order(np.array(found)) == pytest.approx(2.0, abs=0.1)
    assert found[-1] < 2e-6 * (1.0 + psi**2)


def test_opposite_approach_rebounds_oppositely() -> None:
    for psi, chi, alpha in impacts(101, 30):
        assert march(-psi, chi, 125, 500, alpha) == -march(psi, chi, 125, 500, alpha)
    assert march(0.0, 1.44, alpha=0.2) == 0.0


def kinds(row: NDArray[np.int8]) -> list[int]:
    """Return slip from the centre to the edge, without repetition."""
    inside = row[row != 2]
    return [int(k) for i, k in enumerate(inside) if i == 0 or k != inside[i - 1]]


def test_slip_starts_at_the_centre_and_the_edge_sticks() -> None:
    """psi_1 t = t + alpha - ... : the first spring reaches its limit first."""
    times, _, slips = march_slips(3.0, 1.44, 500, 2000, 0.2)
    first = int(np.flatnonzero(np.any(slips == 1, axis=1))[0])
    assert kinds(slips[first]) == [1, 0]
    assert times[first] == pytest.approx(0.1, abs=0.02)
    assert all(kinds(row) == [1, 0] for row in slips[first:950])


def test_slip_spreads_from_between_by_two_fronts() -> None:
    _, _, slips = march_slips(0.3, 2.0, 500, 2000, 0.2)
    assert [0, -1, 0] in [kinds(row) for row in slips[:1000]]


def test_both_signs_slip_at_once() -> None:
    _, _, slips = march_slips(1.333, 1.741, 500, 2000, 1.401)
    assert [1, 0, -1] in [kinds(row) for row in slips]


def test_any_normal_motion_can_be_given() -> None:
    """Gross slip throughout under limits D = b^2: psi_2 = psi_1 - (5/2) chi integral of b^3 dt."""
    assert march_on(3.0, 1.44, elastic(2000)) == march(3.0, 1.44, 500, 2000)
    angle = np.linspace(0.0, np.pi, 2001)
    b, slow = np.sin(angle), 1.0 - 0.4 * np.cos(angle)
    b[-1] = 0.0
    time = 2.0 * (1.0 - np.cos(angle)) - 0.4 * b**2
    motion = np.array([angle, time, 2.0 * b * slow, b, b**2, np.cos(angle) / slow]).T.copy()
    chi = 1.2  # the integral of b^3 dt is that of 2 sin^4 (1 - 0.4 cos), 3 pi/4
    assert march_on(20.0, chi, motion) == pytest.approx(20.0 - 1.875 * np.pi * chi, abs=1e-10)


@pytest.mark.parametrize("alpha", [-0.1, np.nan, 101.0])
def test_wrong_losses_are_named(alpha: float) -> None:
    for function in (march, extrapolated, march_history, march_slips):
        with pytest.raises(ValueError, match="alpha"):
            function(1.0, 1.0, alpha=alpha)
