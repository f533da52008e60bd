"""The ellipse of contact against mpmath at 60 digits: Johnson's K and E, integrals over angles.

Johnson 1985, (4.26) to (4.30), for a > b, e^2 = 1 - b^2/a^2 and p0 = E*: the gap A x^2 + B y^2 with
A = b/(e a)^2 (K - E), B = b/(e a)^2 ((a/b)^2 E - K), the depth b K, and P = (2/3) pi a b.
"""

import math

import mpmath as mp
import numpy as np
import pytest

from carom import Material, Pair, Sphere
from carom.dimensionless.ellipse import contact_ellipse, stiffness_ratios

BOUND = 1e-14
SLENDER = [1.0 - 1e-9, 0.99, 0.8, 0.6, 0.3, 0.125, 1e-2, 3.6e-4]  # b/a


@pytest.fixture(autouse=True)
def sixty_digits():
    with mp.workdps(60):
        yield


def johnson(slender):
    """Return A, B and the depth, at a = 1."""
    b = mp.mpf(slender)
    squared = 1 - b**2
    first, second = mp.ellipk(squared), mp.ellipe(squared)
    return b / squared * (first - second), b / squared * (second / b**2 - first), b * first


def over_angles(slender, nu):
    """Return the integral of (1 - nu + nu cos^2)/w over half a turn at a = 1, b along y."""
    b = mp.mpf(slender)

    def slowness(angle):  # with the half of a turn that is steep at its end
        return (1 - nu + nu * mp.cos(angle) ** 2) / mp.hypot(mp.cos(angle), mp.sin(angle) / b)

    corner = mp.atan(b)
    return 2 * mp.quad(slowness, [0, corner / 4, corner, 4 * corner, mp.pi / 2])


def relative(value, truth):
    return abs(mp.mpf(float(value)) / truth - 1)


@pytest.mark.parametrize("slender", [*SLENDER, 1e-8, 1e-20])
def test_shape_and_stiffness(slender):
    along_x, along_y, depth = johnson(slender)
    radius = (mp.pi * mp.mpf(slender) / 2) ** 2 / depth**3  # P = (4/3) sqrt(R_e) d^(3/2)
    axes = [1 / mp.sqrt(radius * depth), mp.mpf(slender) / mp.sqrt(radius * depth)]
    found = contact_ellipse(2.0 * float(along_x), 2.0 * float(along_y))
    turned = contact_ellipse(2.0 * float(along_y), 2.0 * float(along_x))
    for one, truths in ((found, axes), (turned, axes[::-1])):
        assert relative(one.radius, radius) <= BOUND
        assert relative(one.along, truths[0]) <= BOUND
        assert relative(one.across, truths[1]) <= BOUND


@pytest.mark.first_case
@pytest.mark.parametrize("slender", SLENDER)
def test_share_and_punch(slender):
    """Of cos^2 in 1/w; 2 sqrt(R_e d) is the stiffness of a flat punch, 2 pi a b over int 1/w."""
    along_x, along_y, depth = johnson(slender)
    all_of_it, squared = over_angles(slender, 0), over_angles(slender, 1)
    found = contact_ellipse(2.0 * float(along_x), 2.0 * float(along_y))
    turned = contact_ellipse(2.0 * float(along_y), 2.0 * float(along_x))
    assert relative(found.share, squared / all_of_it) <= BOUND
    assert relative(turned.share, 1 - squared / all_of_it) <= BOUND
    punch = 2 * mp.pi * mp.mpf(slender) / all_of_it
    assert relative(2.0 * math.sqrt(found.radius * float(depth)), punch) <= BOUND


@pytest.mark.first_case
@pytest.mark.parametrize("slender", [0.8, 0.3, 1e-2])
def test_stiffness_ratios(slender):
    """Of two bodies: their int ((1 - nu) + nu cos^2)/w over 2 G add up, as int (1 - nu)/w do."""
    bodies = (mp.mpf("0.3"), mp.mpf(2)), (mp.mpf("0.45"), mp.mpf("0.7"))
    along_x, along_y, _ = johnson(slender)
    share = contact_ellipse(2.0 * float(along_x), 2.0 * float(along_y)).share
    pressed = sum((1 - nu) * over_angles(slender, 0) / (2 * shear) for nu, shear in bodies)
    moved = sum(over_angles(slender, nu) / (2 * shear) for nu, shear in bodies)
    other = sum(
        (over_angles(slender, 0) - nu * over_angles(slender, 1)) / (2 * shear)
        for nu, shear in bodies
    )
    modulus = float(1 / sum((1 - nu) / (2 * shear) for nu, shear in bodies))
    found = stiffness_ratios(share, modulus, *((float(nu), float(shear)) for nu, shear in bodies))
    assert relative(found[0], pressed / moved) <= BOUND
    assert relative(found[1], pressed / other) <= BOUND


def test_circle():
    """To the bit: R* and kappa of a pair of spheres, rigid ones among them."""
    rng = np.random.default_rng(7)
    for _ in range(200):
        radii, young = 10.0 ** rng.uniform(-6.0, 1.0, 2), 10.0 ** rng.uniform(6.0, 12.0, 2)
        stuff = [Material(young=e, poisson=rng.uniform(-0.9, 0.5), density=1e3) for e in young]
        if rng.random() < 0.2:
            stuff[1] = Material(young=math.inf, poisson=0.3, density=1e3)
        ball = Sphere(radius=radii[0], material=stuff[0])
        other = Sphere(radius=radii[1], material=stuff[1])
        pair = Pair(ball, other, friction=0.3)
        curvature = ball.curvature + other.curvature
        circle = contact_ellipse(curvature, curvature)
        assert circle == (pair.effective_radius, 1.0, 1.0, 0.5)
        numbers = ((each.poisson, each.shear_modulus) for each in stuff)
        ratios = stiffness_ratios(circle.share, pair.effective_modulus, *numbers)
        assert ratios == (pair.kappa, pair.kappa)


def test_nearly_a_circle():
    """To first order b/a = (R_y/R_x)^(2/3) (Johnson, 4.33), c = 1/2 + (1 - b/a)/8."""
    for excess in (1e-12, 1e-9, 1e-6):
        ellipse = contact_ellipse(1.0, 1.0 + excess)
        assert ellipse.along / ellipse.across - 1.0 == pytest.approx(
            2.0 / 3.0 * excess, rel=1e-6, abs=1e-15
        )
        assert ellipse.share - 0.5 == pytest.approx(excess / 12.0, rel=1e-6, abs=2e-16)
