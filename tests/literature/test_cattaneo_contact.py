"""Cattaneo's problem against CONTACT, Kalker's boundary element program for the vector problem.

Tables: `data/contact_cattaneo_tractions.csv` (contact of radius a = 1 mm on elements of 0.1333 mm,
pushed to 0.875 of Coulomb's limit) and `data/contact_cattaneo_summary.csv`. Tolerances are
CONTACT's own discretisation error, from what is known in closed form on the same elements: Hertz's
pressure, whose square root at the edge costs it 3.53 % of p_0 in the last element and at most
0.92 % elsewhere; and Mindlin's shift, which it misses by 0.21 % (by 0.03 % with 14 elements to the
radius instead of 7.5).
"""

import csv
import math
from pathlib import Path

import numpy as np
import pytest

import carom
from carom import HalfSpace, Material, Pair, Sphere

DATA = Path(__file__).parent / "data"
MM = 1e-3
MPA = 1e6
POISSON, FRICTION, FORCE, PUSH = 0.42, 0.4, 9.1954, 0.875
EDGE = 0.036  # of p_0 or mu p_0, in elements next to a square root of the exact solution
SMOOTH = 0.0095  # in other elements
SLIP = 2.0 * 0.0022  # of the shift: twice what CONTACT's shift is off


def table(name):
    """Return the rows of a table."""
    lines = (DATA / name).read_text(encoding="utf-8").splitlines()
    return list(csv.DictReader(line for line in lines if not line.startswith("#")))


def pushed(shear, poisson, radius, friction, force, part):
    """Return the load path: pressed by a normal force in N, then pushed to a part of mu N."""
    stuff = Material(young=2.0 * shear * (1.0 + poisson) * MPA, poisson=poisson, density=1000)
    ball = Sphere(radius=radius * MM, material=stuff)
    pair = Pair(ball, HalfSpace(material=stuff), friction)
    push = [0.0, part * friction * force]
    return carom.load_path(pair, normal_force=[force, force], tangential_force=push)


@pytest.fixture(scope="module")
def contact():
    """CONTACT's elements, as arrays in mm, N/mm2 and degrees."""
    rows = table("contact_cattaneo_tractions.csv")
    return {name: np.array([row[name] for row in rows], dtype=float) for name in rows[0]}


@pytest.fixture(scope="module")
def path():
    return pushed(200.0, POISSON, 50.0, FRICTION, FORCE, PUSH)


@pytest.fixture(scope="module")
def fields(path, contact):
    """Carom's fields at CONTACT's elements."""
    return path.fields(-1, points=np.stack([contact["x_mm"], contact["y_mm"]], axis=-1) * MM)


def near(radii, *edges):
    """Return which elements are within the length of one of a square root."""
    return np.any([np.abs(radii - edge) < 0.1334 for edge in edges], axis=0)


def test_pressure(contact, fields):
    """Both are Hertz's to CONTACT's error, which is thus what other fields may be off, too."""
    r = np.hypot(contact["x_mm"], contact["y_mm"])
    peak = 1.5 * FORCE / math.pi
    exact = peak * np.sqrt(1.0 - r**2)
    assert np.all(np.abs(fields.pressure / MPA - exact) <= 1e-6 * peak)
    error = np.abs(contact["pn"] - fields.pressure / MPA) / peak
    assert np.all(error <= np.where(near(r, 1.0), EDGE, SMOOTH))


def test_traction(contact, fields):
    """A stick radius 5 % too large or small would make errors of 10 % of mu p_0."""
    r = np.hypot(contact["x_mm"], contact["y_mm"])
    limit = FRICTION * 1.5 * FORCE / math.pi
    error = np.abs(contact["pt_abs"] - np.abs(fields.traction_x) / MPA) / limit
    assert np.all(error <= np.where(near(r, 1.0, 0.5), EDGE, SMOOTH))


def test_zones(contact, fields):
    """Every element sticks or slips in both; CONTACT gives no slip distance where it sticks."""
    assert np.array_equal(fields.zone.values, np.where(contact["slip_abs_mm"] > 0.0, 2, 1))
    assert float(fields.stick_radius) == pytest.approx(0.5 * MM, rel=1e-6)


def test_slip_distance(contact, fields):
    """Within 0.44 % of the shift; a stick radius wrong by 5 % makes 2.3 %, nu/2 for nu 3.3 %."""
    slip = np.hypot(fields.slip_x, fields.slip_y)
    allowed = SLIP * float(fields.displacement) / MM
    assert np.all(np.abs(slip / MM - contact["slip_abs_mm"]) <= allowed)


def test_direction_of_slip(contact, fields):
    """With tractions along x, slip is up to arcsin(nu/(2 - nu)) = 15.4 deg off; where CONTACT lets
    tractions turn they turn the same way, in the outer ring, but less: by 8 deg at most.
    """
    x, y = contact["x_mm"], contact["y_mm"]
    turned = (contact["pt_arg_deg"] - 180.0 + 90.0) % 180.0 - 90.0
    ours = np.degrees(np.arctan2(fields.slip_y, fields.slip_x)).values
    slips = fields.zone.values == 2
    bound = math.degrees(math.asin(POISSON / (2.0 - POISSON)))
    assert np.all(np.abs(ours[slips]) <= bound)
    assert np.abs(turned).max() == 8.0
    outer = (np.hypot(x, y) > 0.7) & (np.abs(x * y) > 0.01)
    ratio = turned[outer] / ours[outer]
    assert outer.sum() == 80
    assert np.all((ratio > 0.2) & (ratio < 1.0))


CASES = {
    # G, nu, R, mu, N, part of mu N; where the radius of the sphere gives the contact radius
    "cattaneo": (200.0, 0.42, 50.0, 0.4, 9.1954, 0.875),
    "cattaneo_normal_only": (200.0, 0.42, 50.0, 0.4, 9.1954, 0.0),
    "catt_to_cart_case1": (1.0, 0.28, 168.75, 0.4013, 0.4705, 0.657),
}


@pytest.mark.parametrize("case", CASES)
def test_summary(case):
    """Within 0.25 % as the shift, radii of equal area within 0.1 element.

    The friction work is what little of the work of F_x is not stored: within 0.1 % of that work.
    """
    row = next(row for row in table("contact_cattaneo_summary.csv") if row["case"] == case)
    numbers = {name: float(value) for name, value in row.items() if name != "case"}
    path = pushed(*CASES[case])
    fields = path.fields(points=[(0.0, 0.0)])
    stored = path.tangential_elastic_energy[-1] + 0.4 * path.normal_force[-1] * path.penetration[-1]
    by_name = {
        "shift_mm": path.displacement[-1] / MM,
        "approach_mm": path.penetration[-1] / MM,
        "a_mm": path.contact_radius[-1] / MM,
        "pmax": float(fields.pressure[0]) / MPA,
        "elastic_energy_J": stored,
    }
    for name, value in by_name.items():
        assert value == pytest.approx(numbers[name], rel=2.5e-3, abs=1e-15), name
    lost, work = path.frictional_work[-1], path.tangential_force[-1] * path.displacement[-1]
    assert lost == pytest.approx(-numbers["friction_work_J"], rel=0.0, abs=1e-3 * work)
    if "normal" not in case:
        assert by_name["shift_mm"] == pytest.approx(numbers["mindlin_shift_mm"], rel=1e-5)
    size = numbers["grid_dx_mm"]
    for count, radius in (("n_contact", path.contact_radius), ("n_adh", path.stick_radius)):
        same_area = size * math.sqrt(numbers[count] / math.pi)
        assert abs(same_area - radius[-1] / MM) <= 0.1 * size
