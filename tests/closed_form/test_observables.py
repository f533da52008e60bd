"""Conversions between published quantities, against rigid bodies followed one by one."""

import math

import numpy as np
import pytest
from tests.oracles.rigid_bodies import followed

import carom
from carom import HalfSpace, Material, Pair, Sphere
from carom.bodies.kinematics import Rebound
from carom.bodies.observables import BEFORE, IMPULSE, NAMES, OBSERVABLES, convert_observables

STEEL = Material(young="210 GPa", poisson=0.3, density=7850)
RUBBER = Material(young="10 MPa", poisson=0.49, density=1100)
PAIRS = {
    "sphere on wall": Pair(Sphere(radius=0.004, material=STEEL), HalfSpace(material=STEEL), 0.2),
    "hollow sphere on wall": Pair(
        Sphere(radius=0.03, inner_radius=0.027, material=RUBBER), HalfSpace(material=STEEL), 0.6
    ),
    "two unequal spheres": Pair(
        Sphere(radius=0.01, material=STEEL), Sphere(radius=0.004, material=RUBBER), 0.35
    ),
}
OF_SECOND = {"spin2", "spin2_out"}


def impacts(name, n=7):
    """Return seeded impacts of a pair by quantity, arrays of shape (n,)."""
    pair, rng = PAIRS[name], np.random.default_rng(20)
    rows = []
    for _ in range(n):
        normal, tangential = rng.uniform(0.5, 4.0), rng.uniform(-5.0, 5.0)
        spins = rng.uniform(-200.0, 200.0, 2) * [1, isinstance(pair.second, Sphere)]
        impulse = rng.uniform(-0.3, 0.3) * pair.normal_mass * 2 * normal
        motion = (normal, tangential, *spins)
        rows.append(followed(pair, motion, impulse, rng.uniform(0.4, 1.0)))
    return pair, {key: np.array([row[key] for row in rows]) for key in rows[0]}


def names_of(pair, names):
    return [n for n in names if isinstance(pair.second, Sphere) or n not in OF_SECOND]


@pytest.mark.parametrize("name", PAIRS)
def test_every_quantity_is_that_of_bodies_followed_one_by_one(name):
    pair, truth = impacts(name)
    assert set(truth) == set(NAMES)
    before = [truth[name] for name in ("normal_speed", "tangential_speed", "spin", "spin2")]
    push = pair.normal_mass * (1 + truth["normal_restitution"]) * truth["normal_speed"]
    impulse = truth["impulse_ratio"] * push
    rebound = Rebound(pair, *before, truth["normal_restitution"], impulse)
    for key, values in truth.items():
        np.testing.assert_allclose(getattr(rebound, key), values, rtol=1e-11, atol=1e-13)


@pytest.mark.parametrize("name", PAIRS)
def test_every_quantity_from_every_other(name):
    """Any tangential observable with the normal restitution gives all others."""
    pair, truth = impacts(name)
    start = {key: truth[key] for key in names_of(pair, ("normal_speed", "spin", "spin2"))}
    start |= {key: truth[key] for key in ("tangential_speed", "normal_restitution")}
    for way in names_of(pair, IMPULSE):
        for wanted in names_of(pair, NAMES):
            value = convert_observables(pair, known=start | {way: truth[way]}, wanted=wanted)
            scale = np.abs(truth[wanted]).max()
            np.testing.assert_allclose(
                value, truth[wanted], rtol=1e-9, atol=1e-11 * scale, err_msg=f"{way} to {wanted}"
            )


@pytest.mark.parametrize("name", PAIRS)
@pytest.mark.parametrize(
    "way",
    [
        ("speed", "angle"),
        ("normal_speed", "angle"),
        ("normal_speed", "contact_angle"),
        ("normal_speed", "psi_in"),
    ],
)
def test_every_way_of_giving_the_motion_before(name, way):
    pair, truth = impacts(name)
    basis = {key: truth[key] for key in (*way, *names_of(pair, ("spin", "spin2")), "spin_out")}
    for wanted in names_of(pair, BEFORE):
        value = convert_observables(pair, known=basis, wanted=wanted)
        np.testing.assert_allclose(value, truth[wanted], rtol=1e-10, atol=1e-12)
    basis["normal_speed_out"] = truth["normal_speed_out"]
    value = convert_observables(pair, known=basis, wanted="contact_rebound_angle")
    np.testing.assert_allclose(value, truth["contact_rebound_angle"], rtol=1e-9)


@pytest.mark.parametrize("name", PAIRS)
def test_agrees_with_the_exact_impact(name):
    """What `impact` calls by the same name is the same."""
    pair = PAIRS[name]
    hit = carom.impact(pair, speed=2.0, angle="50 deg", spin=-30.0)
    basis = {"normal_speed": hit.normal_speed, "tangential_speed": hit.tangential_speed}
    basis |= {"spin": hit.spin, "normal_restitution": 1.0, "psi_out": hit.psi_out}
    for wanted in OBSERVABLES:
        if hasattr(hit, wanted) and wanted in names_of(pair, OBSERVABLES):
            value = convert_observables(pair, known=basis, wanted=wanted)
            assert value == pytest.approx(getattr(hit, wanted), rel=1e-11), wanted
            assert isinstance(value, float)


def test_ratios_and_angles_need_no_speed():
    """Solid sphere, no spin: 1 + beta = (7/2)(1 - e_t); rigid sliding: e_t = 1 - f (1+e)/tan."""
    pair = PAIRS["sphere on wall"]
    basis = {"angle": ["20 deg", "60 deg"], "tangential_restitution": [0.6, 0.9]}
    beta = convert_observables(pair, known=basis, wanted="contact_beta")
    np.testing.assert_allclose(beta, 3.5 * (1 - np.array([0.6, 0.9])) - 1, rtol=1e-12)
    basis["normal_restitution"] = 0.9
    ratio = convert_observables(pair, known=basis, wanted="impulse_ratio")
    expected = np.array([0.4, 0.1]) * np.tan(np.radians([20, 60])) / 1.9
    np.testing.assert_allclose(ratio, expected, rtol=1e-12)


@pytest.mark.parametrize("name", PAIRS)
def test_speed_and_angle_after_tell_everything(name):
    """Both parts of the motion after, so that not even the normal restitution is needed."""
    pair, truth = impacts(name)
    names = ("normal_speed", "tangential_speed", "spin", "spin2", "rebound_speed", "rebound_angle")
    basis = {key: truth[key] for key in names_of(pair, names)}
    for wanted in names_of(pair, set(NAMES) - {"rebound_angle"}):
        value = convert_observables(pair, known=basis, wanted=wanted)
        scale = np.abs(truth[wanted]).max()
        np.testing.assert_allclose(value, truth[wanted], rtol=1e-9, atol=1e-11 * scale)


@pytest.mark.parametrize("name", PAIRS)
@pytest.mark.parametrize("angle", [-0.9, -0.2, 0.01, 0.3, 1.2])
def test_speed_after_tells_the_rebound_of_an_impact(name, angle):
    """Without spin before the centre goes on: of both signs of v_t' friction allows one."""
    pair = PAIRS[name]
    hit = carom.impact(pair, speed=2.0, angle=angle)
    basis = {"speed": 2.0, "angle": angle, "normal_restitution": 1.0}
    basis["rebound_speed"] = hit.rebound_speed
    for wanted in ("tangential_speed_out", "spin_out", "psi_out", "rebound_angle"):
        value = convert_observables(pair, known=basis, wanted=wanted)
        assert value == pytest.approx(getattr(hit, wanted), rel=1e-8), wanted


def test_speed_after_of_a_centre_that_goes_back():
    """Solid sphere, v_t = 0 before and spin: friction gives it v_t' of the sign of the spin."""
    pair = PAIRS["sphere on wall"]
    for spin in (-300.0, 300.0):
        hit = carom.impact(pair, speed=1.0, angle=0.0, spin=spin)
        basis = {"speed": 1.0, "angle": 0.0, "spin": spin, "normal_restitution": 1.0}
        basis["rebound_speed"] = hit.rebound_speed
        value = convert_observables(pair, known=basis, wanted="tangential_speed_out")
        assert value == pytest.approx(hit.tangential_speed_out, rel=1e-9)
        assert value * spin < 0.0


def test_speed_after_with_scatter_takes_the_sign_that_is_nearer():
    """A speed that even without friction would be 1 % less: v_t' is that root, not its negative."""
    basis = {"speed": 2.0, "angle": 0.5, "normal_restitution": 1.0, "rebound_speed": 2.02}
    value = convert_observables(PAIRS["sphere on wall"], known=basis, wanted="tangential_speed_out")
    assert value == pytest.approx(math.sqrt(2.02**2 - (2.0 * math.cos(0.5)) ** 2), rel=1e-12)


def test_what_is_not_known_stays_unknown():
    pair, basis = PAIRS["sphere on wall"], {"speed": 2.0, "angle": 0.5, "spin_out": [1.0, np.nan]}
    value = convert_observables(pair, known=basis, wanted="tangential_restitution")
    assert np.isnan(value).tolist() == [False, True]


START = {"speed": 2.0, "angle": 0.5}


@pytest.mark.parametrize(
    ("basis", "wanted", "message"),
    [
        (START, "spin_out", "the rebound is not determined; give one of tangential_speed_out"),
        ({"speed": 2.0, "spin_out": 1.0}, "psi_out", "tangential motion before is not determined"),
        (START | {"spin_out": 1, "psi_out": 1}, "contact_beta", "by spin_out and psi_out"),
        (START | {"tangential_speed": 1.0}, "psi_in", "determined by tangential_speed and angle"),
        (START | {"normal_speed": 1.0}, "psi_in", "speed: give it with angle alone"),
        (START | {"rebound_angle": 0.1}, "spin_out", "normal_restitution: missing; rebound_angle"),
        (START | {"spin_out": 0.1}, "impulse_ratio", "normal_restitution: missing; impulse_ratio"),
        ({"angle": 0.5, "spin_out": -1.0}, "contact_beta", "speed: missing; spin_out needs"),
        ({"angle": 0.5, "contact_beta": 0.1}, "spin_out", "speed: missing; spin_out needs"),
        (START | {"angle": 30}, "psi_in", "angle: 30.0 cannot be used; must be below pi/2"),
        (START | {"rebound_angle": 40}, "psi_in", "rebound_angle: 40.0 cannot be used"),
        (START | {"normal_restitution": 0}, "psi_in", "normal_restitution: 0.0 cannot be used"),
        (START | {"speed": [1, -1]}, "psi_in", "speed: -1.0 cannot be used; must be positive"),
        (START | {"spin_out": math.inf}, "psi_out", "spin_out: inf cannot be used; must be finite"),
        (START | {"spin2_out": 1.0}, "psi_out", "spin2_out: only a second sphere can spin"),
        (START | {"spinout": 1.0}, "psi_out", "spinout: unknown quantity; did you mean 'spin_out'"),
        (START, "restitution", "restitution: unknown quantity; write normal_restitution"),
        (START | {"rebound_speed": 1.9}, "spin_out", "normal_restitution: missing; rebound_speed"),
        (
            START | {"rebound_speed": 1.0, "normal_restitution": 1.0},
            "spin_out",
            "rebound_speed: 1.0 cannot be used; it is below the normal speed after",
        ),
        (
            START | {"rebound_speed": 1.8, "normal_restitution": 1.0, "spin": 1500.0},
            "spin_out",
            "the centre may go on or turn back; give rebound_angle, too",
        ),
        (
            START | {"rebound_speed": 1.8, "rebound_angle": 0.3, "spin_out": 1.0},
            "psi_out",
            "rebound_speed and rebound_angle determine the rebound; leave spin_out out",
        ),
        (
            {"angle": 0.5, "rebound_speed": 1.8, "rebound_angle": 0.3},
            "psi_out",
            "speed: missing; rebound_speed needs",
        ),
        (START | {"spin_out": [1.0, 2.0], "spin": [1, 2, 3]}, "psi_out", "do not fit each other"),
        ({"speed": 2.0, "angle": 0.0, "contact_beta": 0.3}, "spin_out", "contact_beta: it is und"),
        (
            {"speed": 2.0, "angle": [0.1, 0.0], "tangential_restitution": 0.3},
            "spin_out",
            "tangential_restitution: it is undefined where tangential_speed is zero",
        ),
        (
            START | {"normal_restitution": 0.9, "normal_speed_out": 1.0},
            "normal_speed_out",
            "mean the same; give one of them",
        ),
    ],
)
def test_what_is_open_or_said_twice_is_refused(basis, wanted, message):
    with pytest.raises(carom.InputError) as refused:
        convert_observables(PAIRS["sphere on wall"], known=basis, wanted=wanted)
    assert message in str(refused.value)


def test_psi_needs_friction():
    pair = Pair(Sphere(radius=0.004, material=STEEL), HalfSpace(material=STEEL), friction=0.0)
    with pytest.raises(carom.InputError, match="psi_in: it is infinite without friction"):
        convert_observables(pair, known=START, wanted="psi_in")
    assert convert_observables(pair, known=START, wanted="contact_angle") == pytest.approx(0.5)
