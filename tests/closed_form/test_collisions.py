"""Collisions in three dimensions against Newton's and Euler's equations, solved pair by pair."""

from itertools import product

import numpy as np
import pytest
from tests.oracles.rigid_bodies import NAMES, collided, inertia, walton

import carom

STEEL = carom.Material(young=210e9, poisson=0.3, density=7850.0)
GLASS = carom.Material(young=70e9, poisson=0.22, density=2500.0)
RUBBER = carom.Material(young=5e6, poisson=0.49, density=1100.0)
BALL = carom.Sphere(radius=5e-3, material=STEEL)
SHELL = carom.Sphere(radius=8e-3, material=GLASS, inner_radius=7e-3)
LOADED = carom.Sphere(radius=3e-3, material=RUBBER, gyration_radius=0.5e-3)
PAIRS = {
    "unequal": carom.Pair(BALL, SHELL, friction=0.2),
    "equal": carom.Pair(SHELL, SHELL, friction=0.05),
    "soft on hard": carom.Pair(LOADED, BALL, friction=0.7),
    "half-space": carom.Pair(SHELL, carom.HalfSpace(material=STEEL), friction=0.3),
    "cup": carom.Pair(BALL, carom.Cup(radius=20e-3, material=GLASS), friction=0.1),
}


def random_collisions(pair, count, seed):
    """Return approaching pairs, from grazing to head-on, from sticking to spinning fast."""
    rng = np.random.default_rng(seed)
    normal = rng.normal(size=(count, 3))
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    velocity1, velocity2 = rng.normal(size=(2, count, 3))
    slow = 10.0 ** rng.uniform(-3.0, 0.5, (count, 1))
    closing = np.sum((velocity1 - velocity2) * normal, axis=1, keepdims=True)
    velocity1 += (np.abs(closing) * slow - closing) * normal
    spin1, spin2 = rng.normal(size=(2, count, 3)) * 10.0 ** rng.uniform(-1, 4, (2, count, 1))
    moving = {"velocity1": velocity1, "spin1": spin1, "velocity2": velocity2, "normal": normal}
    return moving | ({"spin2": spin2} if isinstance(pair.second, carom.Sphere) else {})


def exact_rebound(pair):
    """Return V_t' of the exact theory; E*, G* of Hertz and Mindlin, chi of the compliances."""
    one, two = pair.first.material, pair.second.material
    normal = sum((1.0 - m.poisson**2) / m.young for m in (one, two))
    shear = sum((2.0 - m.poisson) * (1.0 + m.poisson) / (2.0 * m.young) for m in (one, two))
    kappa = normal / shear

    def tangential(sliding, closing, ratio):
        scale = kappa / (pair.friction * closing)
        psi = scale * np.linalg.norm(sliding)
        return sliding * (carom.rebound(psi, 0.5 * kappa * ratio) / psi)

    return tangential


def largest_error(pair, law, tangential, restitution, inputs, count):
    """Return the largest difference over the speeds that enter each collision."""
    after = carom.collide(pair, law=law, **inputs)
    assert np.all(after.status == carom.status.CollisionStatus.COLLIDED)
    radii = (1.0, inertia(pair.first)[0], 1.0, inertia(pair.second)[0])
    worst = 0.0
    for i in range(count):
        row = {name: values[i] for name, values in inputs.items()}
        wanted = collided(pair, tangential, row.pop("normal"), restitution, **row)
        speed = sum(r * np.linalg.norm(row.get(n, 0.0)) for r, n in zip(radii, NAMES, strict=True))
        for name, radius, value in zip(NAMES, radii, wanted, strict=True):
            change = np.max(np.abs(getattr(after, name)[i] - value))
            worst = max(worst, (radius or 1.0) * change / speed)
    return worst


@pytest.mark.parametrize("name", PAIRS)
def test_exact_law_is_newton_euler_with_the_rebound(name):
    """The law's 1e-9 in psi_2 is far below 1e-9 in speeds; 1e-9 of the speeds that enter."""
    pair = PAIRS[name]
    collisions = random_collisions(pair, 150, 1)
    assert largest_error(pair, None, exact_rebound(pair), 1.0, collisions, 150) <= 1e-9


@pytest.mark.first_case
@pytest.mark.parametrize("name", PAIRS)
@pytest.mark.parametrize("restitution", [1.0, 0.6, 0.0])
def test_rigid_laws_are_newton_euler_to_rounding(name, restitution):
    """Smooth, rough and Walton's, for every restitution, to 1e-13 of the speeds that enter."""
    pair = PAIRS[name]
    collisions = random_collisions(pair, 40, 2)
    laws = [(carom.laws.SmoothLaw(restitution=restitution), walton(0.0, 0.0, restitution))]
    laws += [(carom.laws.RoughLaw(restitution=restitution), walton(np.inf, 1.0, restitution))]
    for friction, beta in product((0.0, 0.1, 5.0), (-1.0, -0.3, 0.5, 1.0)):
        law = carom.laws.WaltonLaw(
            friction=friction, restitution=restitution, tangential_restitution=beta
        )
        laws.append((law, walton(friction, beta, restitution)))
    for law, tangential in laws:
        assert largest_error(pair, law, tangential, restitution, collisions, 40) <= 1e-13, law


@pytest.mark.parametrize("name", PAIRS)
@pytest.mark.parametrize("sideways", [-4.0, -0.5, 0.01, 0.7, 3.0])
def test_in_the_plane_is_the_impact(name, sideways):
    """x tangential, normal along z, spins about y: what `impact` returns, to 1e-9 of the speeds."""
    pair = PAIRS[name]
    two = isinstance(pair.second, carom.Sphere)
    spin, spin2 = 30.0, -20.0 if two else 0.0
    hit = carom.impact(pair, normal_speed=1.1, tangential_speed=sideways, spin=spin, spin2=spin2)
    after = carom.collide(
        pair,
        velocity1=[sideways, 0.0, 1.1],
        spin1=[0.0, spin, 0.0],
        normal=[0.0, 0.0, 1.0],
        **({"spin2": [0.0, spin2, 0.0]} if two else {}),
    )
    relative = after.velocity1 - after.velocity2
    speed = 1e-9 * 10.0
    assert relative == pytest.approx([hit.tangential_speed_out, 0.0, -1.1], abs=speed)
    assert after.spin1 == pytest.approx([0.0, hit.spin_out, 0.0], abs=speed / pair.first.radius)
    radius2 = pair.second.radius if two else 1.0
    assert after.spin2 == pytest.approx([0.0, hit.spin2_out, 0.0], abs=speed / radius2)


def test_without_friction_is_smooth():
    """Friction 0 leaves V_t and the spins alone: exact law and smooth law agree to the bit."""
    pair = carom.Pair(BALL, SHELL, friction=0.0)
    collisions = random_collisions(pair, 500, 6)
    exact = carom.collide(pair, **collisions)
    smooth = carom.collide(pair, law=carom.laws.SmoothLaw(), **collisions)
    for name in NAMES:
        assert np.array_equal(getattr(exact, name), getattr(smooth, name))
    assert np.array_equal(exact.spin1, collisions["spin1"])


def test_a_moving_half_space_keeps_its_velocity():
    """In the frame of the wall the collision is the same; the wall itself goes on."""
    pair = PAIRS["half-space"]
    collisions = random_collisions(pair, 300, 8)
    after = carom.collide(pair, **collisions)
    still = carom.collide(
        pair,
        velocity1=collisions["velocity1"] - collisions["velocity2"],
        spin1=collisions["spin1"],
        normal=collisions["normal"],
    )
    assert np.array_equal(after.velocity2, collisions["velocity2"])
    assert np.allclose(after.velocity1, still.velocity1 + after.velocity2, rtol=0, atol=1e-11)
