"""The marching method converges to the exact solution: rebounds, and sequences of phases."""

from functools import cache

import numpy as np
import pytest
from numpy.typing import NDArray

from carom.dimensionless.rebounds import rebound
from carom.dimensionless.solution import solve
from carom.dimensionless.twins.marching import (
    Phase,
    extrapolated,
    march,
    march_on,
    march_phases,
    resolution,
    resolved,
)
from carom.dimensionless.twins.marching_motion import elastic

Array = NDArray[np.float64]

SPRINGS = (125, 250, 500, 1000)
CASES = [(0.5, 1.44), (1.5, 1.44), (3.5, 1.44), (0.5, 1.75), (0.9, 0.8), (5.5, 3.3), (0.2, 4.8)]


def random_impacts(seed: int, count: int) -> tuple[Array, Array]:
    rng = np.random.default_rng(seed)
    return rng.uniform(-6.0, 6.0, count), rng.uniform(0.1, 5.0, count)


def errors(psi: float, chi: float) -> Array:
    exact = rebound(psi, chi)
    return np.array([abs(march(psi, chi, n, 4 * n) - exact) for n in SPRINGS])


def order(found: Array) -> float:
    """Return the slope of log(1/error) against log(springs)."""
    return -float(np.polyfit(np.log(SPRINGS), np.log(found), 1)[0])


@pytest.mark.parametrize(("psi", "chi"), CASES)
def test_error_of_each_impact_is_of_second_order(psi: float, chi: float) -> None:
    assert order(errors(psi, chi)) == pytest.approx(2.0, abs=0.12)


def test_error_of_solid_spheres_is_of_second_order_and_small() -> None:
    rng = np.random.default_rng(1976)
    chi = rng.uniform(1.1, 1.8, 100)
    psi = rng.uniform(0.0, 4.0 * chi - 1.1)  # up to the border of gross slip throughout
    found = np.array([errors(*impact) for impact in zip(psi, chi, strict=True)])
    orders = [order(row) for row in found]
    assert np.median(orders) == pytest.approx(2.0, abs=0.02)
    assert np.quantile(orders, 0.1) > 1.9
    assert np.quantile(orders, 0.9) < 2.1
    scaled = found * np.square(SPRINGS)
    assert np.median(scaled) < 0.4
    assert np.max(scaled) < 1.0


@pytest.mark.slow
def test_extrapolation_agrees_with_the_exact_rebound() -> None:
    psi, chi = random_impacts(38, 300)
    found = [extrapolated(*impact) for impact in zip(psi, chi, strict=True)]
    difference = np.abs(found - rebound(psi, chi))
    assert np.max(difference) < 1e-6
    assert np.median(difference) < 1e-8


def test_gross_slip_throughout_is_exact() -> None:
    rng = np.random.default_rng(4)
    for chi in rng.uniform(0.1, 5.0, 20):
        psi = max(1.0, 4.0 * chi - 1.0) + rng.uniform(0.01, 3.0)
        assert march(psi, chi, 100, 400) == pytest.approx(psi - 4.0 * chi, abs=1e-11)
        assert [phase[:2] for phase in march_phases(psi, chi)] == [("gross slip", 1)]


@pytest.mark.parametrize(
    ("psi", "chi"), [(0.3, 0.5), (0.7, 0.5), (-0.99, 0.5), (1.0, 0.5), (0.1, 4.0), (0.39, 4.0)]
)
def test_load_that_retraces_its_path_reverses_the_velocity(psi: float, chi: float) -> None:
    assert extrapolated(psi, chi) == pytest.approx(-psi, abs=1e-10)
    if abs(psi) < 1.0:
        assert [phase[:2] for phase in march_phases(psi, chi)] == [("stick", 0)]


def test_opposite_approach_rebounds_oppositely() -> None:
    for psi, chi in zip(*random_impacts(101, 30), strict=True):
        assert march(-psi, chi, 125, 500) == -march(psi, chi, 125, 500)
    assert march(0.0, 1.44) == 0.0


FINE = 1000  # springs, for the sequences of phases
SPACING = 0.5 * np.pi / FINE  # of the springs, as an angle


def ring_width(psi: float, chi: float, start: float, end: float) -> float:
    """Return how wide the slipping ring of an exact phase grows, as an angle."""
    state = solve(psi, chi).at(np.linspace(start, end, 101)[1:-1])
    edge = np.arcsin(np.minimum(state.contact_radius, 1.0))
    return float(np.max(edge - np.arcsin(np.minimum(state.stick_radius, 1.0))))


def exact_phases(psi: float, chi: float, leeway: float) -> list[Phase]:
    """Return the exact phases that last, and slip that spreads, `leeway` times the resolution."""
    found = [phase[:4] for phase in solve(psi, chi).phases]
    seen = [p for p in found if p[1] == 0 or ring_width(psi, chi, *p[2:]) >= leeway * SPACING]
    return resolved(seen, leeway * resolution(FINE))


def same_sequence(first: list[Phase], second: list[Phase]) -> bool:
    return [phase[:2] for phase in first] == [phase[:2] for phase in second]


@cache
def told_impacts() -> list[tuple[float, float, list[Phase]]]:
    """Return those of 60 impacts whose exact phases are all clearly told or clearly not."""
    psi, chi = random_impacts(1882, 60)
    psi[::2] /= 4.0  # stick from the start, and more reversals
    result = []
    for impact in zip(psi, chi, strict=True):
        narrow, wide = exact_phases(*impact, 0.5), exact_phases(*impact, 2.0)
        if same_sequence(narrow, wide):
            result.append((*impact, wide))
    return result


def test_sequence_of_phases_is_the_exact_one() -> None:
    assert len(told_impacts()) >= 50
    late = []
    for psi, chi, exact in told_impacts():
        found = march_phases(psi, chi, FINE, 4 * FINE)
        assert same_sequence(found, exact), (psi, chi)
        late += [abs(a[2] - b[2]) for a, b in zip(found[1:], exact[1:], strict=True)]
    assert np.median(late) < 0.1 * resolution(FINE)
    assert np.quantile(late, 0.9) < 0.5 * resolution(FINE)


def test_wrong_sequences_of_phases_are_told_from_the_exact_one() -> None:
    """Were any phase missing, of wrong sign, or of wrong kind, the comparison would fail."""
    kinds = {"stick": "slip", "slip": "gross slip", "gross slip": "stick"}
    for psi, chi, exact in told_impacts():
        found = march_phases(psi, chi, FINE, 4 * FINE)
        assert same_sequence(march_phases(-psi, chi, FINE, 4 * FINE), exact) == (
            {phase[1] for phase in exact} == {0}
        )
        for i, (kind, sign, start, end) in enumerate(exact):
            without = exact[:i] + exact[i + 1 :]
            other = [*exact[:i], (kinds[kind], sign, start, end), *exact[i + 1 :]]
            for wrong in (without, other):
                assert not same_sequence(found, resolved(wrong, resolution(FINE)))


def test_phases_fill_the_contact() -> None:
    for psi, chi, exact in told_impacts():
        found = march_phases(psi, chi)
        assert found[0][2] == 0.0
        assert found[-1][3] == pytest.approx(solve(psi, chi).duration, abs=1e-12)
        assert [p[3] for p in found[:-1]] == [p[2] for p in found[1:]]
        assert all(end > start for _, _, start, end in [*found, *exact])


@pytest.mark.parametrize(
    ("arguments", "named"),
    [
        ((np.nan, 1.0), "psi"),
        ((1.0, 0.0), "chi"),
        ((1.0, np.inf), "chi"),
        ((1.0, 1.0, 0, 4), "springs"),
        ((1.0, 1.0, 10, 30), "steps"),
    ],
)
def test_wrong_arguments_are_named(arguments: tuple[float, float], named: str) -> None:
    for function in (march, march_phases, extrapolated):
        with pytest.raises(ValueError, match=named):
            function(*arguments)


def test_odd_springs_cannot_be_halved() -> None:
    with pytest.raises(ValueError, match="odd"):
        extrapolated(1.0, 1.0, 5, 20)


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
