"""Normal impact against mpmath at 50 digits: relative error <= 3e-15 everywhere."""

import mpmath as mp
import numpy as np
import pytest

from carom.dimensionless.numerics import hertz

BOUND = 3e-15
TINY = [1e-100, 1e-30, 1e-10, 1e-3]
PLACES = [*TINY, 0.05, 0.3, 0.6, 0.757, 0.7579, 0.9, 0.99]
DEFICITS = [1e-16, 1e-12, 1e-6, 1e-3, 0.1, 0.3, 0.4999999, 0.5000001]  # 1 - x


@pytest.fixture(autouse=True)
def fifty_digits():
    with mp.workdps(50):
        yield


def elapsed(d):
    """Time since touch: (2/5) B(d^(5/2); 2/5, 1/2)."""
    d = mp.mpf(d)
    return d * mp.hyp2f1(mp.mpf(2) / 5, mp.mpf(1) / 2, mp.mpf(7) / 5, d ** mp.mpf("2.5"))


def until_turning(v):
    """Time to the turning point: (2/5) B(v^2; 1/2, 2/5)."""
    v = mp.mpf(v)
    return mp.mpf(4) / 5 * v * mp.hyp2f1(mp.mpf(1) / 2, mp.mpf(3) / 5, mp.mpf(3) / 2, v * v)


def inverse(function, value, near):
    near = mp.mpf(near)
    bracket = (near * (1 - mp.mpf("1e-12")), near * (1 + mp.mpf("1e-12")))
    return mp.findroot(lambda z: function(z) / mp.mpf(value) - 1, bracket, solver="anderson")


def relative(value, truth):
    return abs(mp.mpf(float(value)) / truth - 1)


def test_duration():
    truth = mp.mpf(4) / 5 * mp.beta(mp.mpf(2) / 5, mp.mpf(1) / 2)
    assert relative(hertz.DURATION, truth) <= 1.2e-16


@pytest.mark.parametrize("d", [d for d in PLACES if d**2.5 <= 0.5])
def test_time_from_touch(d):
    assert relative(hertz.elapsed(d), elapsed(d)) <= BOUND
    v = float(mp.sqrt(1 - mp.mpf(d) ** mp.mpf("2.5")))
    assert relative(hertz.time(d, v), elapsed(d)) <= BOUND


@pytest.mark.parametrize("deficit", DEFICITS)
def test_time_from_the_turning_point(deficit):
    v = float(mp.sqrt(deficit))
    assert relative(hertz.until_turning(v), until_turning(v)) <= BOUND


@pytest.mark.parametrize("d", PLACES)
def test_penetration_speed_force_radius_from_touch(d):
    """The inverse: what there is at a time since touch, or as long before separation."""
    t = float(elapsed(d))
    truth = inverse(elapsed, t, d)
    penetration, speed = hertz.penetration_and_speed(t)
    assert relative(penetration, truth) <= BOUND
    assert relative(penetration**1.5, truth ** mp.mpf("1.5")) <= BOUND
    assert relative(np.sqrt(penetration), mp.sqrt(truth)) <= BOUND
    assert relative(penetration**2.5, truth ** mp.mpf("2.5")) <= BOUND
    if d <= 0.9:  # beyond, the time since touch no longer tells the speed to 15 digits
        assert relative(speed, mp.sqrt(1 - truth ** mp.mpf("2.5"))) <= BOUND


@pytest.mark.parametrize("deficit", DEFICITS)
def test_speed_and_penetration_from_the_turning_point(deficit):
    t = float(until_turning(mp.sqrt(deficit)))
    truth = inverse(until_turning, t, mp.sqrt(deficit))
    speed = hertz.speed_before_turning(t)
    assert relative(speed, truth) <= BOUND
    assert relative(hertz.speed_before_turning(-t), -truth) <= BOUND
    penetration = (1.0 - speed * speed) ** 0.4
    assert relative(penetration, (1 - truth**2) ** mp.mpf("0.4")) <= BOUND


def test_random_times_through_the_whole_contact():
    rng = np.random.default_rng(7)
    for t in rng.uniform(0.0, hertz.DURATION, 60):
        d, v = hertz.penetration_and_speed(t)
        truth = inverse(elapsed, min(t, hertz.DURATION - t), d)
        assert relative(d, truth) <= BOUND
        assert np.sign(v) == (1 if t < hertz.HALF else -1)


def test_ends_of_the_contact():
    assert hertz.penetration_and_speed(0.0) == (0.0, 1.0)
    assert hertz.penetration_and_speed(hertz.DURATION) == (0.0, -1.0)
    assert hertz.penetration_and_speed(hertz.HALF) == (1.0, 0.0)
