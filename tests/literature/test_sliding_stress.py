"""Published stresses below spheres in contact, at rest and sliding; p_0 = 1 and b = 1."""

import numpy as np
import pytest
from tests.oracles.point_forces import hamilton

from carom.dimensionless.fields.peaks import SHEAR, TENSION, VON_MISES, largest
from carom.dimensionless.fields.profile import flat, stacked
from carom.dimensionless.fields.subsurface import stresses

SLIDING = stacked([1.0], [flat(0.0, 1.0, 1.0, 0.0)])
RATIOS = pytest.mark.parametrize("poisson", [0.0, 0.25, 0.3, 0.45])


def worst(friction, poisson=0.3):
    return largest(VON_MISES, SLIDING, friction=friction, poisson=poisson)


def tension(friction, poisson):
    return largest(TENSION, SLIDING, friction=friction, poisson=poisson, deepest=0.0)


def test_largest_shear_below_a_sphere_at_rest():
    """Johnson (1985), section 3.4: nu = 0.3, largest shear 0.31 p_0 at a depth of 0.48 b."""
    actual = largest(SHEAR, SLIDING, friction=0.0, poisson=0.3)
    assert actual.value == pytest.approx(0.31, abs=5e-4)
    assert actual.z == pytest.approx(0.48, abs=5e-3)
    assert (actual.x, actual.y) == pytest.approx((0.0, 0.0), abs=1e-5)


def test_first_yield_at_rest():
    """Johnson (1985), section 6.1: von Mises 0.62 p_0 at 0.48 b, first yield p_0 = 1.60 Y."""
    actual = worst(0.0)
    assert actual.value == pytest.approx(0.62, abs=5e-4)
    assert actual.z == pytest.approx(0.48, abs=5e-3)
    assert 1.0 / actual.value == pytest.approx(1.60, abs=0.015)


@RATIOS
def test_tension_at_the_rim_at_rest(poisson):
    """Johnson (1985), section 3.4: (1 - 2 nu) p_0/3 at the edge, radially, the largest tension."""
    actual = tension(0.0, poisson)
    assert actual.value == pytest.approx((1.0 - 2.0 * poisson) / 3.0, abs=1e-8)
    assert np.hypot(actual.x, actual.y) == pytest.approx(1.0, abs=1e-9)


@RATIOS
@pytest.mark.parametrize("friction", [0.05, 0.25, 0.5, 1.0])
def test_tension_behind_a_sliding_contact(friction, poisson):
    """Hamilton and Goodman (1966): p_0 [(1 - 2 nu)/3 + pi mu (4 + nu)/8], at the trailing edge."""
    actual = tension(friction, poisson)
    expected = (1.0 - 2.0 * poisson) / 3.0 + np.pi * friction * (4.0 + poisson) / 8.0
    assert actual.value == pytest.approx(expected, abs=1e-12)
    assert actual[1:] == (-1.0, 0.0, 0.0)


@RATIOS
def test_explicit_equations(poisson):
    """Hamilton (1983), Proc. Inst. Mech. Eng. C 197:53: pressure alone, from the surface down."""
    generator = np.random.default_rng(5)
    r, angle = generator.uniform(0.3, 2.0, 400), generator.uniform(0.0, 2.0 * np.pi, 400)
    depth = 10.0 ** generator.uniform(-8.0, 1.0, 400)
    at = np.stack([r * np.cos(angle), r * np.sin(angle), depth], axis=-1)
    actual = stresses(at, SLIDING, friction=0.0, poisson=poisson)
    assert actual == pytest.approx(hamilton(at, poisson), abs=1e-10)


@pytest.mark.parametrize("friction", [0.1, 0.2, 0.25])
def test_little_friction_yields_below(friction):
    """Johnson (1985), section 7.1: up to a friction of about 0.3 the worst point is below the
    surface, nearer to it the larger the friction.
    """
    actual, less = worst(friction), worst(friction - 0.1)
    assert 0.3 < actual.z < less.z
    assert actual.value > less.value


@pytest.mark.parametrize("friction", [0.35, 0.4, 0.5])
def test_much_friction_yields_at_the_surface(friction):
    """Johnson (1985), section 7.1: beyond about 0.3 it is at the surface, here at the trailing
    edge, where sigma_xx and sigma_yy are those of Hamilton (1983).
    """
    actual = worst(friction)
    xx = 0.4 / 3.0 + np.pi * friction * 4.3 / 8.0
    yy = -0.4 / 3.0 + 3.0 * np.pi * friction * 0.3 / 8.0
    assert actual[1:] == (-1.0, 0.0, 0.0)
    assert actual.value == pytest.approx(np.sqrt(xx * xx - xx * yy + yy * yy), abs=1e-12)
