"""Impacts with units: exact limits, invariance, and the scales of Hertz."""

import math

import numpy as np
import pytest

import carom
from carom import Cup, HalfSpace, InputError, Material, Pair, Sphere
from carom.dimensionless.neglected import not_studied, rebound_error

STEEL = Material(young="210 GPa", poisson=0.3, density=7850)
GLASS = Material(young="70 GPa", poisson=0.23, density=2500)
BALL = Sphere(radius="5 mm", material=STEEL)
PLATE = Pair(BALL, HalfSpace(material=STEEL), friction=0.2)


def close(value, rel=1e-14):
    return pytest.approx(value, rel=rel)


def test_chi_of_a_solid_sphere():
    """chi = (1 - nu)/(2 - nu) (1 + R^2/K^2), Barber's (16): 1.4412 for nu = 0.3."""
    for nu in (0.0, 0.3, 0.5):
        stuff = Material(young=1e9, poisson=nu, density=1000)
        pair = Pair(Sphere(radius=1.0, material=stuff), HalfSpace(material=stuff), 0.1)
        assert pair.chi == close((1 - nu) / (2 - nu) * 3.5)
        assert pair.kappa == close(2 * (1 - nu) / (2 - nu))
        assert pair.dundurs_beta == 0.0


def test_hollow_and_given_inertia():
    shell = Sphere(radius=1.0, material=STEEL, inner_radius=1.0 - 1e-6)
    assert shell.gyration_ratio == pytest.approx(2 / 3, rel=2e-6)
    assert Sphere(radius=2.0, material=STEEL, gyration_radius=1.0).gyration_ratio == 0.25
    assert Sphere(radius=2.0, material=STEEL, inner_radius=1.0).mass == close(
        28 / 3 * math.pi * 7850
    )


def test_hertz_scales():
    """F_max = (4/3) E* sqrt(R*) d^(3/2), energy (2/5) F d = (1/2) m V^2, duration 2.9433 d/V."""
    hit = carom.impact(PLATE, normal_speed=1.7)
    energy = 0.4 * hit.max_force * hit.max_penetration
    assert energy == close(0.5 * BALL.mass * 1.7**2)
    assert hit.max_radius == close(math.sqrt(BALL.radius * hit.max_penetration))
    assert hit.duration == close(2.9432751843247047 * hit.max_penetration / 1.7)
    assert hit.max_pressure == close(1.5 * hit.max_force / (math.pi * hit.max_radius**2))


def test_no_friction():
    pair = Pair(BALL, HalfSpace(material=STEEL), friction=0)
    hit = carom.impact(pair, normal_speed=1.0, tangential_speed=0.7, spin=11.0)
    assert hit.tangential_speed_out == 0.7
    assert hit.spin_out == 11.0
    assert hit.dissipated_energy == 0.0
    assert hit.psi_in == hit.psi_out == math.inf
    assert [(p.kind, p.sign) for p in hit.phases] == [("gross slip", 1)]
    history = hit.history(5)
    assert np.all(history.tangential_force == 0.0)
    assert np.all(history.contact_velocity == 0.7 + 0.005 * 11.0)


def test_no_tangential_speed():
    hit = carom.impact(PLATE, speed="3 m/s")
    assert hit.tangential_speed_out == 0.0
    assert hit.rebound_angle == 0.0
    assert hit.spin_out == 0.0
    assert hit.rebound_speed == 3.0
    assert math.isnan(hit.tangential_restitution)


def test_spin_that_cancels_the_tangential_speed():
    hit = carom.impact(PLATE, normal_speed=1.0, tangential_speed=0.5, spin=-100.0)
    assert hit.contact_velocity == 0.0
    assert (hit.tangential_speed_out, hit.spin_out) == (0.5, -100.0)


def test_pure_spin_equals_translation_of_the_contact_point():
    slides = carom.impact(PLATE, normal_speed=1.0, tangential_speed=0.5)
    spins = carom.impact(PLATE, normal_speed=1.0, spin=100.0)
    assert spins.psi_out == slides.psi_out
    assert spins.tangential_speed_out == close(slides.tangential_speed_out - 0.5, rel=1e-12)


def test_equal_spheres_with_equal_and_opposite_motion():
    """Equal spins in the same sense add; opposite spins leave no sliding and change nothing."""
    pair = Pair(BALL, BALL, friction=0.3)
    alike = carom.impact(pair, normal_speed=2.0, spin=50.0, spin2=50.0)
    assert alike.spin_out == alike.spin2_out
    opposite = carom.impact(pair, normal_speed=2.0, spin=50.0, spin2=-50.0)
    assert (opposite.spin_out, opposite.spin2_out) == (50.0, -50.0)
    assert opposite.tangential_speed_out == 0.0


def test_bodies_may_be_swapped():
    other = Sphere(radius="8 mm", material=GLASS)
    motion = {"normal_speed": 1.3, "tangential_speed": 0.6}
    one = carom.impact(Pair(BALL, other, 0.2), **motion, spin=30.0, spin2=-12.0)
    two = carom.impact(Pair(other, BALL, 0.2), **motion, spin=-12.0, spin2=30.0)
    assert one.psi_out == pytest.approx(two.psi_out, abs=1e-13)
    assert one.spin_out == pytest.approx(two.spin2_out, rel=1e-12)
    assert one.tangential_speed_out == close(two.tangential_speed_out, rel=1e-12)
    assert one.pair.dundurs_beta == close(-two.pair.dundurs_beta)


def test_mirror():
    one = carom.impact(PLATE, speed=2.0, angle="35 deg", spin=40.0)
    two = carom.impact(PLATE, speed=2.0, angle="-35 deg", spin=-40.0)
    assert one.spin_out == -two.spin_out
    assert one.rebound_angle == -two.rebound_angle
    assert [p.sign for p in one.phases] == [-p.sign for p in two.phases]


def test_units_do_not_matter():
    ball = Sphere(
        radius="0.5 cm", material=Material(young=210e9, poisson="0.3", density="7.85 g/cm^3")
    )
    pair = Pair(ball, HalfSpace(material=STEEL), friction="0.2")
    one = carom.impact(pair, speed="7.2 km/h", angle=math.radians(30), spin="60 rpm")
    two = carom.impact(PLATE, speed=2.0, angle="30 deg", spin="1 rps")
    assert one.psi_out == close(two.psi_out, rel=1e-12)
    assert one.spin_out == close(two.spin_out, rel=1e-12)


def test_cup_and_rigid_counterbody():
    cup = Pair(BALL, Cup(radius="10 mm", material=STEEL), friction=0.2)
    assert cup.effective_radius == close(0.01)
    rigid = Pair(BALL, HalfSpace(material="rigid"), friction=0.2)
    assert rigid.effective_modulus == close(210e9 / (1 - 0.3**2))
    assert rigid.chi == close(PLATE.chi)
    assert rigid.dundurs_beta == close(0.5 * (1 - 2 * 0.3) / (1 - 0.3))


def test_validity_speaks_up():
    unjudged = carom.impact(PLATE, speed=0.1).validity
    assert unjudged.holds is None
    assert unjudged.verdict == "not judged"
    assert "no yield strength of the first body and the second body: Material(" in str(unjudged)
    assert unjudged.findings[1].holds is None
    soft = Sphere(radius="20 mm", material="rubber")
    unlike = carom.impact(Pair(soft, HalfSpace(material=STEEL), 0.5), speed=20.0).validity
    verdicts = {finding.name: finding.holds for finding in unlike.findings}
    assert verdicts["a_max/R*"] is False
    assert unlike.holds is False
    mixed = Pair(Sphere(radius="5 mm", material=GLASS), HalfSpace(material=STEEL), 0.2)
    head_on = carom.impact(mixed, speed=1.0).validity.findings[-1]
    assert (head_on.name, head_on.holds) == ("error of psi_2", True)
    oblique = carom.impact(mixed, speed=1.0, angle="20 deg").validity
    assert (oblique.findings[-1].name, oblique.findings[-1].holds) == ("error of psi_2", None)
    assert "unlike (Dundurs beta 0.196)" in str(oblique)
    assert "method='halfspace'" in str(oblique)
    hard = carom.impact(Pair(Sphere(radius="5 mm", material="steel"), BALL, 0.2), speed=5.0)
    assert "yields" in str(hard.validity)


def test_error_of_the_rebound():
    """0.011 chi nu^2 for like materials; with coupling by hand; none in normal impacts."""
    assert rebound_error(0.7 / 0.85, 0.0, 0.2, 1.44, 1.0) == close(0.011 * 1.44 * 0.3**2)
    coupled = 0.7 * (0.28 * 0.5**2 / 1.5 + 0.6 * 0.1**2)
    tie = 0.34 * math.exp(0.02) * 0.5 / 1.5
    assert rebound_error(1.0, -0.1, 0.2, 0.49, -1.0) == close(coupled + tie)
    assert rebound_error(1.0, 0.1, 0.2, 0.49, 0.75) == close(coupled + 0.5 * tie)
    assert rebound_error(1.0, 0.1, 0.2, 0.49, 0.25) == close(0.5 * coupled)
    assert rebound_error(1.0, 0.1, 0.2, 0.49, 2.0) == close(coupled / 4.0)
    assert rebound_error(0.8, 0.1, 0.2, 1.44, 0.0) == 0.0
    assert rebound_error(1.0, 0.5, 1e-200, 1.44, 1e-3) == 2e-3
    frictionless = carom.impact(Pair(BALL, HalfSpace(material="glass"), 0.0), speed=1, angle=0.5)
    assert frictionless.validity.findings[-1].value == 0.0


def test_outside_the_study_no_error_is_told():
    """Each parameter at its limit and beyond; the line says which, and what to do."""
    inside = {"kappa": 0.8, "beta": 0.1, "friction": 0.2, "chi": 1.44}
    limits = {
        "kappa": (2.0 / 3.0, 1.2),
        "beta": (-0.5, 0.5),
        "friction": (0.02, 1.0),
        "chi": (0.3, 8.0),
    }
    assert not_studied(**inside) == ""
    for name, ends in limits.items():
        for end, beyond in zip(ends, (-1.0, 1.0), strict=True):
            assert not_studied(**(inside | {name: end})) == "", name
            said = not_studied(**(inside | {name: end + 1e-3 * beyond}))
            assert name in said.replace("Dundurs' ", ""), name
            assert "outside" in said
    said = not_studied(0.8, 0.3, 0.02, 1.44)
    assert said == "Dundurs' beta over friction of 15 is outside 0 to 10"
    assert not_studied(0.8, 0.0, 5.0, 1.44) == "", "like materials with any friction"
    loaded = Sphere(radius="10 mm", material="steel", gyration_radius="1 mm")
    bodies = Pair(loaded, HalfSpace(material="steel"), 0.2)
    finding = carom.impact(bodies, speed=0.1, angle=0.3).validity.findings[-1]
    assert math.isnan(finding.value)
    assert finding.holds is None
    assert finding.label == "error of psi_2"
    assert finding.verdict.startswith("not studied: chi of ")


def test_losses_are_not_in_the_study():
    lossy = carom.KelvinVoigt(restitution=0.9)
    finding = carom.impact(PLATE, speed=0.1, angle=0.3, losses=lossy).validity.findings[-1]
    assert (finding.holds, math.isnan(finding.value)) == (None, True)
    assert "not studied with losses" in finding.verdict


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: Sphere(radius=-1, material=STEEL), "radius: -1 cannot be used; must be positive"),
        (lambda: Sphere(radius="5 kg", material=STEEL), "radius: '5 kg' .* not a value in m;"),
        (lambda: Sphere(radius=math.inf, material=STEEL), "radius: inf .* finite"),
        (lambda: Sphere(radius=math.nan, material=STEEL), "radius: nan"),
        (lambda: Sphere(radius=None, material=STEEL), "radius: None"),
        (lambda: Sphere(radius=True, material=STEEL), "radius: True"),
        (lambda: Sphere(radius=1, material="stel"), "material: 'stel' .* did you mean 'steel'"),
        (lambda: Sphere(radius=1, material=STEEL, inner_radius=1), "inner_radius: 1 .* below"),
        (lambda: Material(young=1e9, poisson=0.51), "poisson: 0.51 .* at most 0.5"),
        (lambda: Material(young=1e9, poisson=-1), "poisson: -1 .* above -1"),
        (lambda: Material(young="1 parsnip", poisson=0.3), "young: .* unit 'parsnip' is not known"),
        (lambda: Pair(BALL, BALL, -0.1), "friction: -0.1"),
        (lambda: Pair(BALL, BALL, "0.1 m"), "friction: '0.1 m' .* it has a unit"),
        (lambda: Pair(BALL, Cup(radius=1e-3, material=STEEL), 0.1), "cup .* cannot take a sphere"),
        (lambda: carom.impact(PLATE, speed=1, angle=30), r"angle: 30 .* write '30 deg'"),
        (lambda: carom.impact(PLATE, speed=1, angle="90 deg"), "angle: .* must approach"),
        (lambda: carom.impact(PLATE, speed=-1), "speed: -1"),
        (lambda: carom.impact(PLATE, normal_speed=0), "normal_speed: 0 .* must approach"),
        (lambda: carom.impact(PLATE), "speed: missing"),
        (lambda: carom.impact(PLATE, speed=1, normal_speed=1), "speed: give speed and angle, or"),
        (lambda: carom.impact(PLATE, speed=1, spin2=5), "spin2: 5 .* only a second sphere"),
        (lambda: carom.impact(PLATE, speed=1, spin="10 Hz"), "spin: '10 Hz' .* not in Hz"),
        (lambda: carom.impact(PLATE, speed=1, angle="95°"), "angle: .* below 90 deg"),
        (lambda: carom.impact(PLATE, speed=1e300), "speed: 1e.300 m/s .* check the units"),
        (lambda: carom.impact(PLATE, speed=1e-200), "speed: .* check the units"),
        (lambda: carom.impact(BALL, speed=1), "pair: .* must be a Pair"),
        (lambda: Pair(BALL, BALL, "30 deg"), "friction: '30 deg' .* it has a unit"),
    ],
)
def test_bad_input_is_refused_in_one_line(make, message):
    with pytest.raises(InputError, match=message) as caught:
        make()
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("losses", "close"),
    [
        (None, 1e-12),
        (carom.KelvinVoigt(restitution=0.7), 1e-12),
        (carom.ElasticPlastic(yield_velocity="0.5 m/s"), 1e-4),
    ],
)
def test_impulse_of_sliding_with_next_to_no_friction(losses, close):
    """J_t = mu J_n, and the spin that it gives, however little mu V_n is beside V_x."""
    ball = carom.Sphere(radius="5 mm", material="steel")
    for friction in (1e-2, 1e-6, 1e-12, 1e-17, 1e-30, 1e-90):
        pair = carom.Pair(ball, carom.HalfSpace(material="steel"), friction=friction)
        for angle in ("60 deg", "-60 deg"):
            hit = carom.impact(pair, speed=2.0, angle=angle, losses=losses)
            push = pair.normal_mass * (1.0 + hit.normal_restitution) * hit.normal_speed
            pull = friction * push * np.sign(hit.tangential_speed)
            assert hit.tangential_impulse == pytest.approx(pull, rel=close, abs=0.0)
            spin = -pull * ball.radius / (0.4 * ball.mass * ball.radius**2)
            assert hit.spin_out == pytest.approx(spin, rel=close, abs=0.0)
            mean = 0.5 * (hit.contact_velocity + hit.contact_velocity_out)
            lost = hit.dissipated_energy + hit.shear_lost_energy
            assert lost == pytest.approx(pull * mean, rel=close, abs=0.0)
