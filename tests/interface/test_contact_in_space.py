"""The exact contact law in space: spheres that meet with any velocities and spins."""

import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest

import carom

COMPILER = shutil.which("c++")
pytestmark = pytest.mark.skipif(COMPILER is None, reason="no C++ compiler on this machine")
SOURCES = Path(__file__).parents[1] / "cpp"
STRICT = ("-Wall", "-Wextra", "-pedantic", "-Werror")
STEEL = carom.Material(young=210e9, poisson=0.3, density=7850.0)
GLASS = carom.Material(young=70e9, poisson=0.25, density=2500.0)
PAIR = carom.Pair(
    carom.Sphere(radius=5e-3, material=STEEL),
    carom.Sphere(radius=8e-3, material=GLASS),
    friction=0.2,
)
NORMAL = np.array([1.0, 0.0, 0.0])  # from the second body to the first
MASSES = PAIR.first.mass, PAIR.second.mass
SLOW = 1e-3  # m/s: bodies are flattened by 1e-5 of their radii, which levers notice


def meetings(rng, count=20):
    """Velocities and spins of bodies that approach, in all directions, from sticking to sliding."""
    values = rng.normal(0.0, 0.3 * SLOW, (count, 12))
    values[:, [3, 4, 5]] /= 5e-3
    values[:, [9, 10, 11]] /= 8e-3
    values[:, 0], values[:, 6] = -SLOW, 0.0
    return values


def built(folder, name):
    include, target = f"-I{carom.get_include()}", folder / name
    source = str(SOURCES / f"{name}.cpp")
    command = [COMPILER, "-std=c++17", "-O2", *STRICT, include, source, "-o", str(target)]
    subprocess.run(command, check=True, capture_output=True, text=True)
    return target


@pytest.fixture(scope="module")
def program(tmp_path_factory):
    return built(tmp_path_factory.mktemp("space"), "in_space")


@pytest.mark.slow
def test_contacts_at_once_are_those_one_by_one(tmp_path):
    """21 contacts, one refused in every second step: memories and actions equal to the bit."""
    ran = subprocess.run([built(tmp_path, "together")], capture_output=True, text=True, check=True)
    assert all(1000 < int(touched) < 4200 for touched in ran.stdout.split()), ran.stdout


def after(program, meeting, mirrored=False):
    text = "\n".join(" ".join(map(repr, row)) + f" {int(mirrored)}" for row in meeting.tolist())
    ran = subprocess.run([program], input=text, capture_output=True, text=True, check=True)
    return np.array([[float(word) for word in line.split()] for line in ran.stdout.splitlines()])


@pytest.fixture(scope="module")
def meeting():
    return meetings(np.random.default_rng(7))


@pytest.fixture(scope="module")
def actual(program, meeting):
    return after(program, meeting)


def test_bodies_leave_as_the_collision_operator_says(meeting, actual):
    """`collide`, for which an impact is one instant: velocities and spins of both bodies."""
    v1, w1, v2, w2 = np.split(meeting, 4, axis=1)
    towards = np.tile(-NORMAL, (len(v1), 1))
    exact = carom.collide(PAIR, velocity1=v1, spin1=w1, velocity2=v2, spin2=w2, normal=towards)
    assert not np.any(exact.status)
    parts = np.split(actual, 4, axis=1)
    names = ("velocity1", "spin1", "velocity2", "spin2")
    for name, part, size in zip(names, parts, (1.0, 5e-3, 1.0, 8e-3), strict=True):
        off = size * np.abs(part - getattr(exact, name)).max()
        assert off < 2e-3 * SLOW, name


def test_momentum_and_angular_momentum_are_kept(meeting, actual):
    """That of the motion to rounding; that of the spins with the orbit to the travel meanwhile."""
    before, after_ = (np.split(each, 4, axis=1) for each in (meeting, actual))
    momentum = [MASSES[0] * v1 + MASSES[1] * v2 for v1, _, v2, _ in (before, after_)]
    np.testing.assert_allclose(momentum[1], momentum[0], atol=1e-12 * MASSES[1] * SLOW)
    inertias = [0.4 * m * r**2 for m, r in zip(MASSES, (5e-3, 8e-3), strict=True)]
    lever = 13e-3 * NORMAL
    angular = [
        inertias[0] * w1 + inertias[1] * w2 + np.cross(lever, MASSES[0] * v1)
        for v1, w1, _, w2 in (before, after_)
    ]
    assert np.abs(angular[1] - angular[0]).max() < 2e-4 * MASSES[0] * SLOW * 13e-3


def test_spin_about_the_normal_stays(meeting, actual):
    np.testing.assert_allclose(actual[:, [3, 9]], meeting[:, [3, 9]], atol=1e-4 * SLOW / 5e-3)


def test_either_body_may_keep_the_memory(program, meeting, actual):
    """`mirror`, in every second step: what neighbour lists do where particles change owners."""
    np.testing.assert_allclose(
        after(program, meeting, mirrored=True), actual, rtol=1e-9, atol=1e-15
    )
