"""Influence coefficients of a square element against integrals of point forces to 30 digits.

Point forces of Boussinesq and Cerruti (Johnson 1985, sections 3.2 and 3.6): x^2/r^3, y^2/r^3,
x y/r^3, x/r^2, y/r^2 at (x, y) from the force, over the element |x|, |y| <= 1/2.
"""

import mpmath
import numpy as np
import pytest
from mpmath import mp

from carom.halfspace.compliance import influence

KERNELS = {
    "xx": lambda x, y: x**2 / mpmath.hypot(x, y) ** 3,
    "yy": lambda x, y: y**2 / mpmath.hypot(x, y) ** 3,
    "xy": lambda x, y: x * y / mpmath.hypot(x, y) ** 3,
    "x": lambda x, y: x / mpmath.hypot(x, y) ** 2,
    "y": lambda x, y: y / mpmath.hypot(x, y) ** 2,
}
INSIDE = [(0.0, 0.0), (0.2, -0.3), (-0.45, 0.1)]
NEAR = [(1.0, 0.0), (0.0, -1.0), (1.0, 1.0), (-2.0, 1.0), (0.7, 0.1)]
FAR = [(9.0, 0.0), (-7.0, 24.0), (60.0, -60.0), (0.0, 127.0)]


def closed_form(point):
    """Return the coefficients by name, as floats."""
    values = influence(*map(np.array, point))._asdict()
    return {name: float(value) for name, value in values.items()}


def integral_around(kernel, point):
    """Return the integral in polar coordinates around a point of the element.

    The kernels are even or odd of degree -1, so that r kernel is a function of direction alone.
    """
    x, y = map(mp.mpf, point)
    walls = [(mp.mpf("0.5") - x, 0), (mp.mpf("0.5") - y, 1), (mp.mpf("0.5") + x, 2)]
    walls.append((mp.mpf("0.5") + y, 3))
    total = mp.mpf(0)
    for distance, quarter in walls:
        before, after = walls[quarter - 1][0], walls[(quarter + 1) % 4][0]
        middle = quarter * mp.pi / 2
        ends = [
            middle - mpmath.atan2(before, distance),
            middle,
            middle + mpmath.atan2(after, distance),
        ]

        def to_the_wall(angle, distance=distance, middle=middle):
            # the force lies in direction (cos, sin), seen from it the point in the opposite one
            return (
                kernel(-mpmath.cos(angle), -mpmath.sin(angle))
                * distance
                / mpmath.cos(angle - middle)
            )

        total += mpmath.quad(to_the_wall, ends)
    return total


def integral_over(name, point):
    """Return the integral over an element that the point is outside of, by Gauss's rule."""
    nodes, weights = np.polynomial.legendre.leggauss(40)
    places = np.concatenate([0.25 * nodes - 0.25, 0.25 * nodes + 0.25])
    weights = 0.25 * np.concatenate([weights, weights])
    x, y = point[0] - places[:, None], point[1] - places
    r = np.hypot(x, y)
    kernels = {"xx": x**2 / r**3, "yy": y**2 / r**3, "xy": x * y / r**3}
    kernels |= {"x": x / r**2, "y": y / r**2}
    return float(weights @ kernels[name] @ weights)


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
