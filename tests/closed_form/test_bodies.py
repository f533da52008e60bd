"""Bodies struck off their centre, where the answer is known: spheres, sliding, stick."""

from math import cos, radians, sin

import numpy as np
import pytest
from tests.checks import FLOOR
from tests.oracles import full_stick
from tests.oracles.rigid_bodies import cross_matrix

import carom

STEEL = carom.material("steel")
RADIUS, MASS = 0.005, 0.004
CLOSE = 2e-6  # of psi, of which the march promises 1e-6 times max(1, psi_1)
NUMBERS = ("normal_restitution", "duration", "max_force", "max_penetration")


def body(place, curvatures=(200.0, 200.0), inertia=4e-8, mass=MASS):
    return carom.Body(
        mass=mass, inertia=inertia, contact=place, curvatures=curvatures, material=STEEL
    )


def struck(place, friction, sliding, *, spin=0.0, inertia=4e-8):
    """Return the impact of a body in a plane on a floor at 1 m/s."""
    pair = carom.Pair(body(place, inertia=inertia), FLOOR, friction)
    return carom.impact(pair, normal_speed=1.0, tangential_speed=sliding, spin=spin)


def inverse_mass(hit):
    """Return b_nn, b_tt, b_nt, with the normal into the wall."""
    first = hit.pair.first
    (x, z), heavy, moment = first.contact, first.mass, first.inertia
    return 1.0 / heavy + x * x / moment, 1.0 / heavy + z * z / moment, x * z / moment


def numbers_of(hit):
    """Return chi, eps and zeta."""
    (normal, along, mixed), (mu, kappa) = inverse_mass(hit), (hit.pair.friction, hit.pair.kappa)
    return 0.5 * kappa * along / normal, mu * mixed / normal, kappa * mixed / (mu * normal)


def sphere(share):
    """Return a sphere of the mass and radius of the bodies here, K^2 = share R^2."""
    density = MASS / (4.0 / 3.0 * np.pi * RADIUS**3)
    stuff = carom.Material(young=STEEL.young, poisson=STEEL.poisson, density=density)
    gyration = RADIUS * share**0.5
    return carom.Sphere(radius=RADIUS, material=stuff, gyration_radius=gyration)


@pytest.mark.first_case
@pytest.mark.parametrize("share", [0.4, 0.1, 0.65])
@pytest.mark.parametrize("sliding", [-2.0, -0.3, 0.0, 0.05, 0.4, 1.1, 3.0])
def test_a_sphere_in_space_is_a_sphere(share, sliding):
    """And so is one that is struck a little off its centre, out of round, with other moments."""
    exact = carom.impact(
        carom.Pair(sphere(share), FLOOR, 0.2),
        normal_speed=1.0,
        tangential_speed=sliding,
        spin=-20.0,
    )
    moment, bit = share * MASS * RADIUS**2, 1e-7
    assert exact.pair.normal_mass == pytest.approx(MASS, rel=1e-12)
    for off in (0.0, bit):
        tensor = moment * np.diag([1.0 + off, 1.0 - off, 1.0])
        place = (off * RADIUS, -off * RADIUS, -RADIUS)
        first = body(place, 200.0 * np.array([1.0, 1.0 + off]), tensor)
        hit = carom.impact(
            carom.Pair(first, FLOOR, 0.2),
            normal_speed=1.0,
            tangential_speed=(sliding, 0.0),
            spin=(0.0, 20.0, 0.0),
        )
        scale = max(1.0, abs(exact.psi_in))
        assert hit.psi_out == pytest.approx([exact.psi_out, 0.0], abs=CLOSE * scale)
        assert hit.spin_out == pytest.approx([0.0, -exact.spin_out, 0.0], abs=CLOSE * 500.0)
        assert hit.normal_speed_out == pytest.approx(1.0, abs=CLOSE)
        for name in NUMBERS:
            assert getattr(hit, name) == pytest.approx(getattr(exact, name), rel=CLOSE), name
        lost, unit = exact.dissipated_energy, 0.5 * MASS
        assert hit.dissipated_energy == pytest.approx(lost, abs=CLOSE * scale * unit)


@pytest.mark.parametrize("off", [0.0, 1e-7, -1e-7])
@pytest.mark.parametrize("sliding", [-2.0, -0.3, 0.0, 0.05, 0.4, 1.1, 3.0])
def test_a_sphere_in_a_plane_is_a_sphere(off, sliding):
    """Through the centre it is solved exactly, a little beside it it is marched."""
    motion = {"normal_speed": 1.0, "tangential_speed": sliding, "spin": -20.0}
    exact = carom.impact(carom.Pair(sphere(0.4), FLOOR, 0.2), **motion)
    place, moment = (off * RADIUS, -RADIUS), 0.4 * MASS * RADIUS**2
    hit = struck(place, 0.2, sliding, spin=-20.0, inertia=moment)
    near = 1e-12 if off == 0.0 else CLOSE * max(1.0, abs(exact.psi_in))
    assert hit.psi_out == pytest.approx(exact.psi_out, abs=near)
    assert hit.spin_out == pytest.approx(exact.spin_out, abs=500.0 * near)
    assert hit.dissipated_energy == pytest.approx(exact.dissipated_energy, abs=near * 0.002)


PLACES = [(0.003, -0.004), (-0.003, -0.004), (0.002, -0.009), (-0.006, -0.003)]


def border(hit, sign):
    """Return sigma psi_1 beyond which it slides throughout, and psi_1 - psi_2 there."""
    chi, eps, zeta = numbers_of(hit)
    ratio = (2.0 * chi + sign * zeta) / (1.0 + sign * eps)
    return max(1.0, 2.0 * ratio - 1.0), 2.0 * sign * ratio


@pytest.mark.parametrize("place", PLACES)
@pytest.mark.parametrize("sign", [1, -1])
def test_sliding_throughout(place, sign):
    """The impulse is 2 V_n/(b_nn + sigma mu b_nt) (1, sigma mu), from its border on."""
    mu = 0.25
    still = struck(place, mu, 0.0)
    assert 1.0 + sign * numbers_of(still)[1] > 0.0
    begins, lost = border(still, sign)
    for beyond in (1.001, 1.5, 40.0):
        hit = struck(place, mu, sign * beyond * begins * mu / still.pair.kappa)
        assert hit.psi_out == pytest.approx(hit.psi_in - lost, abs=CLOSE * hit.psi_in * sign)
        assert hit.normal_restitution == pytest.approx(1.0, abs=CLOSE)
        normal, _, mixed = inverse_mass(hit)
        impulse = 2.0 / (normal + sign * mu * mixed)
        assert hit.tangential_impulse == pytest.approx(sign * mu * impulse, rel=CLOSE)
        assert hit.normal_speed_out == pytest.approx(impulse / MASS - 1.0, abs=CLOSE)
        assert [phase.kind for phase in hit.phases] == ["gross slip"]
    within = struck(place, mu, sign * 0.8 * begins * mu / still.pair.kappa)
    assert len(within.phases) > 1
    assert abs(within.psi_in - lost - within.psi_out) > 1e-4


@pytest.mark.parametrize("place", PLACES)
def test_no_friction(place):
    """The impulse is along the normal, 2 V_n/b_nn, and friction that vanishes tends to that."""
    hit = struck(place, 0.0, 0.3, spin=20.0)
    normal, _, mixed = inverse_mass(hit)
    x, z = place
    approach, sliding = 1.0 - 20.0 * x, 0.3 - 20.0 * z
    assert hit.approach_speed == pytest.approx(approach, rel=1e-12)
    assert hit.contact_velocity == pytest.approx(sliding, rel=1e-12)
    impulse = 2.0 * approach / normal
    assert hit.normal_restitution == pytest.approx(1.0, rel=1e-12)
    assert hit.normal_speed_out == pytest.approx(impulse / MASS - 1.0, rel=1e-12)
    assert hit.contact_velocity_out == pytest.approx(sliding - mixed * impulse, rel=1e-12)
    assert hit.spin_out == pytest.approx(20.0 + impulse * x / 4e-8, rel=1e-12)
    assert hit.tangential_speed_out == 0.3
    assert hit.dissipated_energy == 0.0
    for mu in (1e-3, 1e-4):
        little = struck(place, mu, 0.3, spin=20.0)
        assert little.spin_out == pytest.approx(hit.spin_out, rel=5.0 * mu)
        assert little.spin_out != pytest.approx(hit.spin_out, rel=0.05 * mu)


def test_no_friction_in_space():
    """Of the impulse 2 V_n/b_nn along the normal; an ellipse of contact does not matter."""
    tensor, place = np.array([[3, 1, 0], [1, 4, -1], [0, -1, 5]]) * 1e-8, [0.002, -0.001, -0.006]
    pair = carom.Pair(body(place, [[200, 50], [50, 400]], tensor), FLOOR, 0.0)
    spin, sliding = [3.0, -7.0, 2.0], [0.2, -0.4]
    hit = carom.impact(pair, normal_speed=1.0, tangential_speed=sliding, spin=spin)
    b = np.eye(3) / MASS - cross_matrix(place) @ np.linalg.inv(tensor) @ cross_matrix(place)
    before = np.add([*sliding, -1.0], np.cross(spin, place))
    push = np.array([0.0, 0.0, -2.0 * before[2] / b[2, 2]])
    after = spin + np.linalg.inv(tensor) @ np.cross(place, push)
    assert hit.spin_out == pytest.approx(after, rel=1e-12)
    assert hit.contact_velocity_out == pytest.approx((before + b @ push)[:2], rel=1e-12)


@pytest.mark.first_case
@pytest.mark.parametrize(("angle", "sliding"), [(40, 0.0), (40, 0.5), (15, -1.0), (70, 0.2)])
def test_full_stick(angle, sliding):
    """Of a rod whose friction grows: e and V_t' are parabolas of 1/mu that end where it sticks."""
    x, z = 0.05 * sin(radians(angle)), -0.05 * cos(radians(angle))
    frictions = np.array([20.0, 40.0, 80.0])
    hits = [struck((x, z), mu, sliding, inertia=MASS * 0.01 / 12.0) for mu in frictions]
    normal, along, mixed = inverse_mass(hits[0])
    exact = full_stick.rebound(hits[0].pair.kappa, along / normal, mixed / normal, sliding)
    values = [(hit.normal_restitution, hit.contact_velocity_out) for hit in hits]
    ends = np.polyfit(1.0 / frictions, values, 2)[-1]
    assert ends == pytest.approx(exact, abs=2e-4)
    assert np.max(np.abs(np.array(values)[-1] - exact)) > 2e-4  # of 80, which is not enough
