"""Balls on plates in limits that have closed forms: small give, sizes, speeds, sliding."""

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.special import beta

import carom
from carom.dimensionless.lossy.law import Loss, LossNumbers
from carom.dimensionless.rebounds import regime_borders
from carom.dimensionless.solution import Solution, solve_with

SLOPE = 1.5 * beta(0.6, 1.5)
STEEL = carom.material("bearing-steel")


def on_plate(radius, thickness, speed, angle=0.0, ball=STEEL, wall=STEEL):
    plate = carom.HalfSpace(material=wall, thickness=thickness)
    pair = carom.Pair(carom.Sphere(radius=radius, material=ball), plate, friction=0.15)
    return carom.impact(pair, speed=speed, angle=angle)


def restitution(give):
    solved = solve_with(0.0, 1.44, LossNumbers(Loss.PLATE, give))
    assert isinstance(solved, Solution)
    return solved.restitution


def test_a_plate_that_hardly_gives_way_loses_in_proportion():
    """1 - e = (3/2) B(3/5, 3/2) lambda, (11.21)."""
    assert pytest.approx(1.8917058535, abs=1e-10) == SLOPE
    one, two = ((1.0 - restitution(give)) / give for give in (1e-3, 2e-3))
    assert one == pytest.approx(SLOPE, rel=2e-3)
    assert 2.0 * one - two == pytest.approx(SLOPE, rel=5e-6)


def test_an_exponential_of_the_slope_is_near_at_all_thicknesses():
    """Zener's parameter is (5/4)^(2/5) lambda: e = exp(-1.7302 of it), to 0.016 in e."""
    assert pytest.approx(1.7302, abs=5e-5) == SLOPE / 1.25**0.4
    give = np.linspace(0.02, 2.0, 34)
    wrong = np.exp(-SLOPE * give) - [restitution(g) for g in give]
    assert 0.015 < np.abs(wrong).max() < 0.0165


@pytest.mark.parametrize("speed", [0.05, 0.5])
def test_only_the_thickness_in_radii_matters(speed):
    hits = [on_plate(r, 1.3 * r, speed, 0.5) for r in (1e-4, 2e-3, 0.1)]
    for name in ("normal_restitution", "psi_out"):
        values = [getattr(hit, name) for hit in hits]
        assert_allclose(values, values[0], rtol=1e-12)


def test_loss_falls_with_the_square_of_the_thickness_and_grows_slowly_with_speed():
    thick, twice, fast = (
        -np.log(on_plate(5e-3, h, v).normal_restitution)
        for h, v in ((0.04, 0.1), (0.08, 0.1), (0.04, 3.2))
    )
    assert thick / twice == pytest.approx(4.0, rel=2e-3)
    assert fast / thick == pytest.approx(2.0, rel=2e-3)


def test_a_light_ball_loses_in_proportion_to_its_mass():
    light = carom.Material(young=STEEL.young, poisson=STEEL.poisson, density=0.01 * STEEL.density)
    heavy, other = (on_plate(5e-3, 0.02, 0.1, ball=stuff) for stuff in (STEEL, light))
    lost = np.log(heavy.normal_restitution) / np.log(other.normal_restitution)
    assert lost == pytest.approx(100.0**0.6, rel=2e-3)  # m/d_max


@pytest.mark.parametrize("thickness", ["3 mm", "6 mm"])
def test_a_ball_that_slides_throughout_takes_all_of_the_friction(thickness):
    hit = on_plate(5e-3, thickness, 0.5, "60 deg")
    chi, e = hit.pair.chi, hit.normal_restitution
    assert hit.psi_in > regime_borders(chi, e)[-1]
    assert hit.psi_out == pytest.approx(hit.psi_in - 2.0 * chi * (1.0 + e), rel=1e-12)
    slowed = (1.0 - hit.tangential_restitution) * np.tan(np.radians(60.0))
    assert slowed == pytest.approx(0.15 * (1.0 + e), rel=1e-12)
