"""What bodies bear, where it is known in closed form: head-on, sliding, shallow and deep flaws."""

from math import atan, sqrt

import pytest
from scipy.optimize import minimize_scalar

import carom
from carom.dimensionless.strength.cracking import intensity
from carom.dimensionless.strength.peaks import Contacts, peaks

SLIDING = carom.solve(9.0, 1.44)  # in gross slip from the first touch to the last
EDGE_CRACK = 1.12152  # K/(sigma sqrt(pi c)) of a shallow crack in uniform tension (Koiter 1965)


def on_axis(depth, poisson):
    """sigma_z - sigma_r below a pressure of Hertz's, over p_0 (Johnson 1985, (3.45))."""
    return (1.0 + poisson) * (1.0 - depth * atan(1.0 / depth)) - 1.5 / (1.0 + depth**2)


@pytest.mark.parametrize("poisson", [0.1, 0.2, 0.3, 0.4])
def test_head_on_the_stress_is_that_on_the_axis(poisson):
    """Without friction von Mises and Tresca agree, at the depth where (3.45) is largest."""
    minimum = minimize_scalar(lambda z: on_axis(z, poisson), bounds=(0.2, 1.0), method="bounded")
    mises, shear, _ = peaks(Contacts(carom.solve(0.0, 1.44), 0.0), poisson)
    assert mises.value == pytest.approx(-minimum.fun, rel=1e-5)
    assert shear.value == pytest.approx(-0.5 * minimum.fun, rel=1e-5)
    assert mises.z == pytest.approx(minimum.x, abs=3e-3)
    assert mises.x == mises.y == 0.0
    assert mises.time == pytest.approx(0.5 * carom.solve(0.0, 1.44).duration)


@pytest.mark.parametrize("friction", [0.0, 0.3])
def test_a_sphere_yields_head_on_at_1_6_of_its_strength(friction):
    """p_0 = 1.60 Y at nu = 0.3 (Johnson 1985, section 6.1); friction does not matter head-on."""
    stuff = carom.Material(young="200 GPa", poisson=0.3, density=7800, yield_strength="1 GPa")
    ball = carom.Sphere(radius="5 mm", material=stuff)
    pair = carom.Pair(ball, carom.HalfSpace(material=stuff), friction=friction)
    speed = float(carom.bearable_speeds(pair, angle=0.0).yield_speed_second[0, 0])
    hit = carom.impact(pair, speed=speed, angle=0.0)
    assert hit.max_pressure == pytest.approx(1.60e9, rel=0.01)
    assert hit.max_pressure == pytest.approx(1.6128e9, rel=1e-4)  # to more digits than 1.60
    ratio = next(each for each in hit.validity.findings if each.name == "von Mises stress/Y")
    assert ratio.value == pytest.approx(1.0, rel=1e-9)


@pytest.mark.parametrize("friction", [0.1, 0.5])
def test_shallow_flaws_feel_the_tension_at_the_edge(friction):
    """K = 1.1215 sigma sqrt(pi c) where the stress hardly falls: c of 1e-10 of the contact."""
    contacts, flaw = Contacts(SLIDING, friction), 1e-10
    tension = peaks(contacts, 0.23)[2].value
    actual = intensity(contacts, 0.23, flaw)
    assert actual.value == pytest.approx(EDGE_CRACK * tension * sqrt(flaw), rel=2e-3)
    assert actual.x == pytest.approx(-1.0, abs=0.01)


def test_deep_flaws_obey_auerbachs_law():
    """Balls of 1 mm to 1 m crack a plate full of deep flaws at forces that go with the radius."""
    forces = []
    for radius in (1e-3, 1e-2, 1.0):
        glass = carom.material("float glass", flaw_size=0.3 * radius)
        ball = carom.Sphere(radius=radius, material="bearing steel")
        pair = carom.Pair(ball, carom.HalfSpace(material=glass), friction=0.1)
        speed = float(carom.bearable_speeds(pair, angle="20 deg").crack_speed_second[0, 0])
        forces.append(carom.impact(pair, speed=speed, angle="20 deg").max_force / radius)
    assert forces == pytest.approx([forces[0]] * 3, rel=1e-6)


def test_shallow_flaws_make_the_force_go_with_the_square_of_the_radius():
    """A tension that must reach K_c/(1.1215 sqrt(pi c)) is a pressure: the force goes with R^2."""
    forces = []
    for radius in (1.0, 2.0):
        glass = carom.material("float glass", flaw_size=1e-9)
        ball = carom.Sphere(radius=radius, material="bearing steel")
        pair = carom.Pair(ball, carom.HalfSpace(material=glass), friction=0.4)
        speed = float(carom.bearable_speeds(pair, angle="60 deg").crack_speed_second[0, 0])
        forces.append(carom.impact(pair, speed=speed, angle="60 deg").max_force)
    assert forces[1] / forces[0] == pytest.approx(4.0, rel=5e-3)
