"""Published numbers: benchmark tests of DEM codes that are exact, and measured rebounds."""

import math

import pytest

import carom
from carom import HalfSpace, Material, Pair, Sphere

LIMESTONE = Material(young="20 GPa", poisson=0.25, density=2500)
MAGNESIUM = Material(young="40 GPa", poisson=0.35, density=1800)

# Kharaz, Gorham & Salman (2001), Powder Technol. 120:281: 5 mm alumina spheres on soda-lime glass
# at 3.9 m/s, digitised from the figures: incidence (deg), v_t'/v_t of the centre; spin (rad/s).
RESTITUTION = [
    (1.84, 0.79344),
    (3.703, 0.74533),
    (9.496, 0.67257),
    (20.012, 0.59691),
    (30.127, 0.68756),
    (39.382, 0.77148),
    (49.694, 0.84761),
    (60.02, 0.90142),
]
SPIN = [
    (6.143, 136.18),
    (10.991, 265.69),
    (21.251, 577.65),
    (31.157, 612.88),
    (39.143, 595.49),
    (50.348, 453.21),
    (60.328, 382.09),
]
KHARAZ = Pair(
    Sphere(radius="2.5 mm", material="alumina"),
    HalfSpace(material="soda-lime-glass"),
    friction=0.092,
)


def test_peak_force_of_two_equal_spheres():
    """Chung & Ooi (2011), Granular Matter 13:643, test 1: 7108 N at a relative 20 m/s."""
    ball = Sphere(radius="10 mm", material=LIMESTONE)
    hit = carom.impact(Pair(ball, ball, friction=0.35), normal_speed=20.0)
    assert hit.max_force == pytest.approx(7108.0, abs=0.5)


def test_peak_force_on_a_rigid_plane():
    """Chung & Ooi (2011), test 2: 7233 N."""
    ball = Sphere(radius="0.1 m", material=MAGNESIUM)
    hit = carom.impact(Pair(ball, HalfSpace(material="rigid"), friction=0.35), normal_speed=0.2)
    assert hit.max_force == pytest.approx(7233.0, abs=0.5)


@pytest.mark.parametrize("spin", [0.175, 2.0, 20.0])
def test_equal_spheres_with_opposite_spins(spin):
    """Chung & Ooi (2011), test 7: v_t' = 0 and omega' = omega, exactly."""
    ball = Sphere(radius="0.1 m", material=MAGNESIUM)
    hit = carom.impact(Pair(ball, ball, 0.4), normal_speed=0.4, spin=spin, spin2=-spin)
    assert hit.tangential_speed_out == 0.0
    assert (hit.spin_out, hit.spin2_out) == (spin, -spin)


@pytest.mark.parametrize("angle", [75.0, 80.0, 85.0])
def test_sliding_throughout(angle):
    """A solid sphere that slides throughout obeys y = x - 7 with x = V_t/(mu V_n)."""
    ball = Sphere(radius="0.1 m", material=MAGNESIUM)
    pair = Pair(ball, HalfSpace(material=MAGNESIUM), friction=0.3)
    hit = carom.impact(pair, speed=0.2, angle=math.radians(angle))
    unit = pair.friction * hit.normal_speed
    after = hit.contact_velocity_out / unit
    assert after == pytest.approx(hit.contact_velocity / unit - 7.0, rel=1e-12)


@pytest.mark.parametrize(("angle", "measured"), RESTITUTION)
def test_measured_tangential_restitution(angle, measured):
    """Within 0.03, the scatter of the data, with the constants that the literature uses."""
    hit = carom.impact(KHARAZ, speed=3.9, angle=math.radians(angle))
    assert hit.tangential_restitution == pytest.approx(measured, abs=0.03)


@pytest.mark.parametrize(("angle", "measured"), SPIN)
def test_measured_spin(angle, measured):
    """Within 40 rad/s, the scatter of the data; the largest spin is 610 rad/s."""
    hit = carom.impact(KHARAZ, speed=3.9, angle=math.radians(angle))
    assert -hit.spin_out == pytest.approx(measured, abs=40.0)
