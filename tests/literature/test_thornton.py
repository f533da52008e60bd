"""Restitution of the elastic, perfectly plastic sphere (Thornton 1997, J. Appl. Mech. 64:383)."""

import numpy as np
import pytest
from numpy.typing import NDArray

import carom
from carom.dimensionless.lossy.law import Loss, LossNumbers
from carom.dimensionless.rebounds import lossy_rebounds

Array = NDArray[np.float64]


def closed_form(ratio: Array) -> Array:
    """Return e of V_y/V_1 < 1, Thornton's (28)."""
    shape = ratio / (ratio + 2.0 * np.sqrt(1.2 - 0.2 * ratio**2))
    return np.sqrt(1.2 * np.sqrt(3.0)) * np.sqrt(1.0 - ratio**2 / 6.0) * shape**0.25


def restitution(ratio: Array) -> Array:
    """Return e of an impact."""
    one = np.ones(ratio.size)
    return lossy_rebounds(one, one, LossNumbers(Loss.PLASTIC, ratio**0.4)).restitution


def test_closed_form_is_one_at_yield() -> None:
    assert closed_form(np.ones(1))[0] == pytest.approx(1.0, abs=1e-15)


def test_restitution_is_the_closed_form() -> None:
    """From 3e4 times the yield velocity down to it."""
    ratio = np.concatenate([10.0 ** np.linspace(-4.5, -0.01, 60), 1.0 - np.logspace(-2, -4, 20)])
    assert np.max(np.abs(restitution(ratio) - closed_form(ratio))) < 1e-10


def test_restitution_just_above_yield() -> None:
    """Yielding so short that it is a root of the time left is not lost, and e is not above 1."""
    ratio = 1.0 - np.logspace(-4, -13, 60)
    values = restitution(ratio)
    assert np.max(np.abs(values - closed_form(ratio))) < 3e-10
    assert np.max(values) <= 1.0 + 3e-10


@pytest.mark.parametrize("psi", [0.0, 0.4, 9.0])
def test_restitution_does_not_depend_on_the_tangential_motion(psi: float) -> None:
    ratio = 10.0 ** np.linspace(-3.5, -0.001, 20)
    losses = LossNumbers(Loss.PLASTIC, ratio**0.4)
    impacts = lossy_rebounds(np.full(20, psi), np.full(20, 1.44), losses)
    assert np.max(np.abs(impacts.restitution - closed_form(ratio))) < 1e-10


def test_restitution_falls_with_the_fourth_root_of_the_speed() -> None:
    """e -> (6 sqrt(3)/5)^(1/2) (V_y/V_1 / (2 sqrt(6/5)))^(1/4) = 1.185 (V_y/V_1)^(1/4)."""
    ratio = np.array([1e-4, 3e-5])
    values = restitution(ratio)
    slope = np.log(values[1] / values[0]) / np.log(ratio[1] / ratio[0])
    assert slope == pytest.approx(0.25, abs=1e-5)
    assert values[1] / ratio[1] ** 0.25 == pytest.approx(1.185, abs=5e-4)


def test_work_of_the_load_until_the_turning_point() -> None:
    """The load rises by (3/2) y per depth from y^3 on, until the work (2/5) v^2 is spent:
    P_max^2 = (6/5) y - y^6/5."""
    y = np.array([0.05, 0.3, 0.6, 0.9, 0.99])
    impacts = lossy_rebounds(np.full(5, 2.0), np.full(5, 1.2), LossNumbers(Loss.PLASTIC, y))
    peak = np.sqrt(1.2 * y - 0.2 * y**6)
    assert impacts.max_force == pytest.approx(peak, abs=1e-8)
    deepest = y**2 + (peak - y**3) / (1.5 * y)
    assert impacts.max_radius == pytest.approx(np.sqrt(deepest), abs=1e-8)
    assert impacts.max_penetration == pytest.approx(deepest, rel=1e-8)


def test_below_yield_bodies_are_elastic() -> None:
    """V_1 <= V_y: the same as without the law, to the accuracy of the solver."""
    psi, chi = np.linspace(0.1, 7.0, 40), np.linspace(0.4, 2.5, 40)
    for y in (1.0, 1.3, 40.0):
        impacts = lossy_rebounds(psi, chi, LossNumbers(Loss.PLASTIC, np.full(40, y)))
        assert impacts.psi_out == pytest.approx(carom.rebound(psi, chi), abs=1e-8)
        assert impacts.restitution == pytest.approx(np.ones(40), abs=1e-9)


def test_impacts_with_units(pair: carom.Pair) -> None:
    """The yield velocity is where e leaves 1, and e depends on V_y/V_1 alone."""
    law = carom.ElasticPlastic(yield_velocity="0.1 m/s")
    for speed in (0.05, 0.2, 1.0, 8.0):
        hit = carom.impact(pair, normal_speed=speed, tangential_speed=0.3 * speed, losses=law)
        wanted = 1.0 if speed < 0.1 else closed_form(np.array([0.1 / speed]))[0]
        assert hit.normal_restitution == pytest.approx(wanted, abs=1e-9)


def test_largest_pressure_is_on_the_true_radius(pair: carom.Pair) -> None:
    """(3/2) P/(pi a^2) at the turning point, a^2 = R* d, below Hertz's of that load."""
    law = carom.ElasticPlastic(yield_velocity="0.1 m/s")
    hit = carom.impact(pair, normal_speed=1.0, tangential_speed=0.3, losses=law)
    square = pair.effective_radius * hit.max_penetration
    assert hit.max_pressure == pytest.approx(1.5 * hit.max_force / (np.pi * square), rel=1e-9)
    assert hit.max_pressure < 0.8 * pair.scales(1.0).pressure
    at_yield = pair.scales(0.1).pressure
    assert at_yield < hit.max_pressure < 1.6 * at_yield
