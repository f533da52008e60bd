"""The elements against CONTACT, Kalker's boundary element program, on CONTACT's own elements.

Tables: `data/contact_cattaneo_tractions.csv` and `data/contact_cattaneo_summary.csv`: two equal
bodies pressed together and pushed by prescribed forces. The discretisation is the same, constant
tractions on squares and displacements at their centres, so that nothing is left but the digits
that CONTACT prints (3 or 4).
"""

from typing import NamedTuple

import numpy as np
import pytest
from scipy.optimize import brentq
from tests.literature.test_cattaneo_contact import table

from carom.halfspace.compliance import Compliance, Materials
from carom.halfspace.quasistatic import ContactStep, Patch

RADII = {"cattaneo": 50.0, "catt_to_cart_case1": 168.75}  # R* in mm
SIZES = {"cattaneo": 19, "catt_to_cart_case1": 33}  # of the grid, an element in the middle
OFF = {"cattaneo": 3.5e-5, "catt_to_cart_case1": 0.0}  # mm, the middle of the grid


def last_digit(text):
    """Return half of the last digit of a printed number."""
    mantissa, _, exponent = text.upper().partition("E")
    return 0.5 * 10.0 ** (int(exponent or 0) - len(mantissa.partition(".")[2]))


class Pushed(NamedTuple):
    """A case of CONTACT's solved by the elements; units in mm, N, N/mm2."""

    row: dict
    patch: Patch
    step: ContactStep
    depth: float
    friction: float
    force: float
    stress: float


def solved(case):
    """Return the case with its forces reached, the depth first, then the displacement."""
    row = next(row for row in table("contact_cattaneo_summary.csv") if row["case"] == case)
    load, part, friction, nu, shear, radius, spacing = (
        float(row[name]) for name in ("N", "T_over_muN", "mu", "nu", "G", "a_mm", "grid_dx_mm")
    )
    materials = Materials(2.0 * (1.0 - nu) / (2.0 - nu), 0.0, friction)
    modulus, depth = shear / (1.0 - nu), radius**2 / RADII[case]  # E* of equal bodies, d of a
    force = modulus * depth * radius
    patch = Patch(Compliance(SIZES[case], spacing / radius, materials))
    line = patch.grid.line - OFF[case] / radius
    patch.grid.apart = 0.5 * (line[:, None] ** 2 + line**2)

    def pressed(depth):
        return patch.advance(patch.untouched(), depth, np.zeros(3)).state

    def missing_load(depth):
        return patch.grid.element * pressed(depth).pressure.sum() - load / force

    start = pressed(brentq(missing_load, 0.9, 1.1, xtol=1e-10))

    def pushed(shift):
        return patch.advance(start, start.depth, np.array([shift, 0.0, 0.0]))

    def missing_push(shift):
        return patch.grid.element * pushed(shift).state.traction[0].sum() - part * load / force

    step = pushed(brentq(missing_push, 0.01, 2.0, xtol=1e-10))
    return Pushed(row, patch, step, depth, friction, force, force / radius**2)


@pytest.fixture(scope="module", params=RADII)
def case(request):
    return solved(request.param)


@pytest.fixture(scope="module")
def elements():
    """Every element of CONTACT's, with ours in its place."""
    pushed = solved("cattaneo")
    rows = table("contact_cattaneo_tractions.csv")
    places = [[round(7.5 * float(row[axis])) + 9 for axis in ("x_mm", "y_mm")] for row in rows]
    return pushed, rows, tuple(np.array(places).T)


def slips(step):
    size = np.hypot(*step.state.traction)
    return step.touching & (size >= step.state.pressure * (1.0 - 1e-9))


def assert_printed(actual, rows, name):
    for value, row in zip(actual, rows, strict=True):
        text = row[name]
        assert abs(value - float(text)) <= 1.02 * last_digit(text), (name, row, value)


def test_pressure(elements):
    """At each of the 177 elements, to the last of 3 printed digits."""
    pushed, rows, places = elements
    pressure = pushed.step.state.pressure
    assert np.count_nonzero(pressure) == len(rows) == 177
    assert_printed(pressure[places] * pushed.stress, rows, "pn")


def test_traction(elements):
    """Size to the last of 3 digits, direction to 0.06 degrees (1 decimal); up to 8 off the push."""
    pushed, rows, places = elements
    x, y = (part[places] for part in pushed.step.state.traction)
    assert_printed(np.hypot(x, y) * pushed.stress * pushed.friction, rows, "pt_abs")
    printed = np.array([float(row["pt_arg_deg"]) for row in rows])
    against = (printed - 180.0 + 180.0) % 360.0 - 180.0  # on the other body
    off = (np.degrees(np.arctan2(y, x)) - against + 180.0) % 360.0 - 180.0
    assert np.abs(off).max() <= 0.06
    assert np.abs(printed).min() == pytest.approx(172.0)


def test_slip(elements):
    """None at the same elements as CONTACT's; elsewhere its size to the last of 3 digits."""
    pushed, rows, places = elements
    actual = np.hypot(*pushed.step.moved)[places] * pushed.friction * pushed.depth
    printed = np.array([float(row["slip_abs_mm"]) for row in rows])
    assert np.array_equal(slips(pushed.step)[places], printed > 0.0)
    held = printed == 0.0
    assert np.abs(actual[held]).max() <= 1e-5 * printed.max()
    kept = [row for row, sticks in zip(rows, held, strict=True) if not sticks]
    for value, row in zip(actual[~held], kept, strict=True):
        allowed = 1.02 * last_digit(row["slip_abs_mm"])
        assert abs(value - float(row["slip_abs_mm"])) <= allowed, (row, value)


def test_places(case):
    """Approach, displacement and largest pressure, to the last of 4 printed digits."""
    state = case.step.state
    for actual, name in (
        (state.depth * case.depth, "approach_mm"),
        (state.displacement[0] * case.friction * case.depth, "shift_mm"),
        (state.pressure.max() * case.stress, "pmax"),
    ):
        text = case.row[name]
        assert abs(actual - float(text)) <= 1.02 * last_digit(text), name


def test_numbers_of_elements(case):
    """That touch, stick and slip: 177, 45, 132 and 621, 305, 316. All the same."""
    slipping, touching = slips(case.step), case.step.state.pressure > 0.0
    values = touching.sum(), (touching & ~slipping).sum(), slipping.sum()
    assert values == tuple(int(case.row[name]) for name in ("n_contact", "n_adh", "n_slip"))


def test_energies(case):
    """Stored, and lost by the one step of tangential motion, in J to the last of 4 digits."""
    state, element, friction = case.step.state, case.patch.grid.element, case.friction
    compliance = case.patch.compliance
    normal = np.sum(state.pressure * compliance.normal(state.pressure))
    tangential = friction**2 * np.sum(state.traction * compliance.tangential(state.traction))
    joule = 1e-3 * element * case.force * case.depth
    stored, text = 0.5 * joule * (normal + tangential), case.row["elastic_energy_J"]
    assert abs(stored - float(text)) <= 1.02 * last_digit(text)
    lost = joule * friction**2 * np.sum(state.traction * case.step.moved)
    text = case.row["friction_work_J"]
    assert abs(lost + float(text)) <= 1.02 * last_digit(text)
