"""Influence coefficients of a square element against integrals of point forces to 30 digits.

Point forces of Boussinesq and Cerruti (Johnson 1985, sections 3.2 and 3.6): x^2/r^3, y^2/r^3,
x y/r^3, x/r^2, y/r^2 at (x, y) from the force, over the element |x|, |y| <= 1/2.
"""

import numpy as np
import pytest
from mpmath import mp
from tests.oracles.influence import KERNELS, integral_around, integral_over

from carom.halfspace.compliance import influence

INSIDE = [(0.0, 0.0), (0.2, -0.3), (-0.45, 0.1)]
NEAR = [(1.0, 0.0), (0.0, -1.0), (1.0, 1.0), (-2.0, 1.0), (0.7, 0.1)]
FAR = [(9.0, 0.0), (-7.0, 24.0), (60.0, -60.0), (0.0, 127.0)]


def closed_form(point):
    """Return the coefficients by name, as floats."""
    values = influence(*map(np.array, point))._asdict()
    return {name: float(value) for name, value in values.items()}


@pytest.mark.first_case
@pytest.mark.parametrize("point", INSIDE)
@pytest.mark.parametrize("name", KERNELS)
def test_inside(name, point):
    with mp.workdps(30):
        exact = float(integral_around(KERNELS[name], point))
    assert closed_form(point)[name] == pytest.approx(exact, rel=1e-14, abs=5e-15)


@pytest.mark.parametrize("point", NEAR)
@pytest.mark.parametrize("name", KERNELS)
def test_near(name, point):
    exact = integral_over(name, point)
    assert closed_form(point)[name] == pytest.approx(exact, rel=2e-14, abs=5e-15)


@pytest.mark.parametrize("point", FAR)
@pytest.mark.parametrize("name", KERNELS)
def test_far(name, point):
    """To the rounding of a sum over corners of terms some times the distance."""
    rounding = 20.0 * np.finfo(float).eps * float(np.hypot(*point))
    assert abs(closed_form(point)[name] - integral_over(name, point)) <= rounding


@pytest.mark.parametrize(("name", "order"), {"xx": 3, "yy": 3, "xy": 3, "x": 5, "y": 5}.items())
def test_far_away_it_is_a_point_force(name, order):
    """What a square without dipole adds is of order r^-3; x/r^2 is harmonic: of order r^-5."""
    far = np.array([8.0, 16.0, 32.0])
    x, y = 0.8 * far, 0.6 * far
    force = [float(KERNELS[name](*point)) for point in zip(x, y, strict=True)]
    excess = np.abs(getattr(influence(x, y), name) - force)
    assert np.all(excess <= 0.2 * far**-order)
    rates = np.log2(excess[:-1] / excess[1:])
    assert np.all(np.abs(rates - order) <= 0.15), rates


def test_symmetries():
    """xx, yy even, xy odd in either, x and y odd in their own; exchange of axes."""
    x, y = np.random.default_rng(7).integers(-9, 10, (2, 50)) + 0.25
    straight, across, back = influence(x, y), influence(-x, y), influence(y, x)
    for name, sign in {"xx": 1, "yy": 1, "xy": -1, "x": -1, "y": 1}.items():
        mirrored, kept = getattr(across, name), getattr(straight, name)
        assert np.all(np.abs(mirrored - sign * kept) <= 1e-13), name
    for name, other in {"xx": "yy", "xy": "xy", "x": "y"}.items():
        assert np.all(np.abs(getattr(straight, name) - getattr(back, other)) <= 1e-13), name
