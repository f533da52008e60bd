"""What is no body, and what no body can do: one clear line for each."""

import numpy as np
import pytest
from tests.checks import FLOOR, refused

import carom

FLAT = {"mass": 0.01, "inertia": 1e-6, "contact": (0.01, -0.02), "curvature_radius": 0.005}
TENSOR = np.diag([2e-6, 3e-6, 4e-6])
SOLID = {"mass": 0.01, "inertia": TENSOR, "contact": (0.01, 0.0, -0.02), "curvatures": (200, 300)}
SKEW = TENSOR + 1e-6 * np.array([[0, 1, 0], [0, 0, 0], [0, 0, 0]])


def body(given=FLAT, **changed):
    return carom.Body(**({"material": "steel"} | given | changed))


@pytest.mark.parametrize(
    ("given", "changed", "words"),
    [
        (FLAT, {"mass": 0.0}, "^mass: 0.*positive"),
        (FLAT, {"mass": -1.0}, "^mass: -1.*positive"),
        (FLAT, {"mass": np.nan}, "^mass: nan"),
        (FLAT, {"mass": None}, "^mass: missing; a body that moves has mass, inertia and contact"),
        (FLAT, {"inertia": None}, "^inertia: missing"),
        (FLAT, {"contact": None}, "^contact: missing"),
        (FLAT, {"inertia": -1e-6}, "^inertia: -1.*positive"),
        (FLAT, {"inertia": 0.0}, "^inertia: 0.*positive"),
        (FLAT, {"inertia": [1e-6, 2e-6, 2e-6]}, "^inertia: .*3 x 3"),
        (FLAT, {"contact": (0.0, 0.0, -0.02)}, "^contact: .*3 x 3"),
        (FLAT, {"contact": -0.02}, "^contact: .*x and z"),
        (FLAT, {"contact": (0.01,)}, "^contact: .*x and z"),
        (FLAT, {"contact": (0.01, np.inf)}, "^contact: .*finite"),
        (FLAT, {"contact": ("a", "b")}, "^contact: "),
        (FLAT, {"curvature_radius": 0.0}, "^curvature_radius: 0.*positive"),
        (FLAT, {"curvature_radius": None}, "^curvature_radius: .*give it, or curvatures"),
        (FLAT, {"curvatures": (1.0, 2.0)}, "^curvature_radius: .*not both"),
        (SOLID, {"curvatures": (1.0, 2.0, 3.0)}, "^curvatures: .*two numbers"),
        (SOLID, {"curvatures": [[1.0, 2.0], [3.0, 4.0]]}, "^curvatures: .*symmetric 2 x 2"),
        (SOLID, {"curvatures": (np.nan, 2.0)}, "^curvatures: "),
        (FLAT, {"curvature_radius": None, "curvatures": [[200, 9], [9, 300]]}, "plane of symmetry"),
        (SOLID, {"inertia": SKEW}, "^inertia: .*symmetric"),
        (SOLID, {"inertia": np.diag([1e-6, 1e-6, -1e-7])}, "^inertia: .*moments must be positive"),
        (SOLID, {"inertia": np.diag([1e-6, 1e-6, 0.0])}, "^inertia: .*moments must be positive"),
        (SOLID, {"inertia": np.diag([1e-6, 1e-6, 3e-6])}, "^inertia: .*at most the sum"),
        (SOLID, {"inertia": np.full((3, 3), np.nan)}, "^inertia: "),
        (SOLID, {"inertia": np.zeros((3, 3))}, "^inertia: "),
        (SOLID, {"contact": (0.01, -0.02)}, "^contact: .*3 x 3"),
        (FLAT, {"material": "cheese"}, "^material: "),
        (FLAT, {"weight": 1.0}, "^weight: "),
    ],
)
def test_what_is_no_body(given, changed, words):
    refused(words, body, given, **changed)


def test_all_faults_at_once():
    refused("mass.*inertia.*contact", body, mass=-1.0, inertia=-1.0, contact=3.0)


HOLLOW = carom.Body(curvatures=(-100.0, -300.0), material="steel")


@pytest.mark.parametrize(
    ("first", "second", "words"),
    [
        (body(SOLID), HOLLOW, "^curvatures: .*both must be positive"),
        (body(SOLID, curvatures=(200, -1)), FLOOR, "^curvatures: .*both must be positive"),
        (body(SOLID, curvatures=(200, 0)), FLOOR, "^curvatures: .*both must be positive"),
        (body(SOLID), body(FLAT, contact=(0, 0.02)), "^inertia: .*both bodies in a plane"),
        (HOLLOW, FLOOR, "^first body: .*moves"),
        (FLOOR, body(), "^first body: .*comes second"),
    ],
)
def test_what_is_no_pair(first, second, words):
    refused(words, carom.Pair, first, second, 0.3)


@pytest.mark.parametrize(
    ("given", "changed", "words"),
    [
        (FLAT, {"normal_speed": -1.0}, "^normal_speed: -1.*part at"),
        (FLAT, {"normal_speed": 0.0}, "^normal_speed: 0.*part at"),
        (FLAT, {"spin": 200.0}, "^normal_speed: 1.*part at 1 m/s"),
        (FLAT, {"spin": (1.0, 2.0, 3.0)}, "^spin: .*one number"),
        (FLAT, {"tangential_speed": (1.0, 2.0)}, "^tangential_speed: .*one number"),
        (FLAT, {"spin2": 1.0}, "^spin2: .*does not move"),
        (SOLID, {"spin": 1.0}, "^spin: .*three numbers, along x, y and z"),
        (SOLID, {"spin": (1.0, 2.0)}, "^spin: .*three numbers"),
        (SOLID, {"tangential_speed": 1.0}, "^tangential_speed: .*two numbers, along x, y"),
        (SOLID, {"spin2": (0.0, 0.0, 1.0)}, "^spin2: .*does not move"),
        (SOLID, {"spin": (0.0, np.inf, 0.0)}, "^spin: .*finite"),
        (SOLID, {"spin": "fast"}, "^spin: "),
        (FLAT, {"normal_spin": 3.0}, "^normal_spin: .*spheres only"),
        (FLAT, {"method": "halfspace"}, "^method: .*spheres only"),
        (FLAT, {"normal_speed": None}, "speed"),
        (FLAT, {"speed": 1.0, "angle": 0.1}, "speed"),
        (SOLID, {"losses": carom.Metal()}, "^losses: .*ellipse"),
        (SOLID, {"losses": carom.ElasticPlastic(0.1)}, "^losses: .*ellipse"),
    ],
)
def test_what_is_no_impact(given, changed, words):
    motion = {"normal_speed": 1.0} | changed
    refused(words, carom.impact, carom.Pair(body(given), FLOOR, 0.3), **motion)


def test_what_takes_spheres_only():
    still = {name: np.zeros((1, 3)) for name in ("velocity1", "spin1", "velocity2", "spin2")}
    motion = still | {"normal": np.array([[0.0, 0.0, 1.0]])}
    refused("only carom.impact takes", carom.collide, carom.Pair(body(), FLOOR, 0.3), **motion)
