"""Impacts by boundary elements with units: what a user gets is one impact, whole and consistent."""

import json

import numpy as np
import pytest
from tests.checks import refused

import carom

TINY = carom.BoundaryElements(elements=8, steps=20)
COARSE = carom.BoundaryElements(elements=16, steps=75)
CORK = carom.Material(young="30 MPa", poisson=0.0, density=200.0)  # nu = 0: the theory is exact
STEEL = carom.material("steel")


def against_wall(material=CORK, wall=CORK, friction=0.3):
    ball = carom.Sphere(radius="10 mm", material=material)
    return carom.Pair(ball, carom.HalfSpace(material=wall), friction=friction)


@pytest.fixture(scope="module")
def both():
    """One impact by both methods, with all phases, spin, and slip to the left first."""
    motion = {"normal_speed": 1.0, "tangential_speed": -0.9, "spin": 40.0}
    pair = against_wall()
    return (carom.impact(pair, **motion, method=COARSE), carom.impact(pair, **motion))


def test_the_rebound_is_the_theorys_within_its_error(both):
    full, exact = both
    assert full.psi_in == exact.psi_in < 0.0
    assert 0.0 < full.psi_out_error < 0.03
    assert abs(full.psi_out - exact.psi_out) < full.psi_out_error
    assert full.spin_out == pytest.approx(exact.spin_out, rel=0.01)
    assert full.duration == pytest.approx(exact.duration, rel=1e-3)


def test_the_history_is_the_theorys_in_every_column(both):
    """nu = 0: forces, energies and velocities; radii to an element, they are counted."""
    full, exact = (hit.history(120) for hit in both)
    for name, values in exact.data_vars.items():
        if name == "stick_radius" or name.startswith("phase_"):
            continue
        largest = max(float(np.abs(values).max()), 1e-12)
        allowed = 0.12 if name == "contact_radius" else 0.02
        off = np.abs(full[name].values - values.values).max()
        assert off <= allowed * largest, name


def test_the_stick_radius_is_the_theorys(both):
    """To half an element, but within two steps of where gross slip gives way to stick."""
    full, exact = (hit.history(120) for hit in both)
    actual, theory = full.stick_radius.values, exact.stick_radius.values
    half = exact.contact_radius.values.max() / COARSE.elements
    begins = exact.time.values[np.argmax(theory > 0.0)]
    away = np.abs(exact.time.values - begins) > 2.0 * both[0].duration / COARSE.steps
    assert np.abs(actual - theory)[away].max() <= half
    assert np.median(np.abs(actual - theory)[theory > 0.0]) <= 0.3 * half


def test_phases_are_the_theorys(both):
    full, exact = both
    shape = [(phase.kind, phase.sign) for phase in exact.phases]
    assert [(phase.kind, phase.sign) for phase in full.phases] == shape
    for ours, theirs in zip(full.phases, exact.phases, strict=True):
        assert ours.end == pytest.approx(theirs.end, abs=0.05 * exact.duration)
    assert full.phases[-1].end == full.duration


def test_energies_of_the_history_add_up(both):
    full, history = both[0], both[0].history(4000)
    kept = ("normal_kinetic_energy", "tangential_kinetic_energy", "spin_kinetic_energy")
    stored = ("normal_elastic_energy", "tangential_elastic_energy", "frictional_work")
    total = sum(history[name].values for name in kept + stored)
    assert np.abs(total / total[0] - 1.0).max() < 1e-3  # 16 elements, linear between steps
    masses = full.pair.normal_mass, full.pair.tangential_mass
    moving = sum(m * v**2 / 2.0 for m, v in zip(masses, (1.0, full.contact_velocity), strict=True))
    steps = full.solution.ledger.time * full.scales.time
    worst = np.abs(np.interp(steps, history.time, total) - total[0]).max() / moving
    assert full.energy_error == pytest.approx(worst, rel=0.05)
    assert full.energy_error < 1e-3


def test_fields_bear_the_forces_and_obey_coulombs_law(both):
    full, _ = both
    for share in (0.1, 0.45, 0.7):
        patch = full.fields(share * full.duration)
        element = float(patch.x[1] - patch.x[0]) * float(patch.y[1] - patch.y[0])
        pressure, pull = patch.pressure.values, np.hypot(patch.traction_x, patch.traction_y).values
        assert pressure.sum() * element == pytest.approx(float(patch.normal_force), rel=1e-12)
        assert float(patch.traction_x.sum()) * element == pytest.approx(
            float(patch.tangential_force), rel=1e-9, abs=1e-9 * float(patch.normal_force)
        )
        assert np.all(pull <= 0.3 * pressure * (1.0 + 1e-9))
        slips = (patch.zone.values == 2) & (pull > 0.0)  # less a rim that has just touched
        assert np.allclose(pull[slips], 0.3 * pressure[slips], rtol=1e-9)
        power = patch.traction_x * patch.slip_velocity_x + patch.traction_y * patch.slip_velocity_y
        speed = np.hypot(patch.slip_velocity_x, patch.slip_velocity_y).values
        assert np.all(power.values[slips] >= 0.0)
        assert np.all(speed[~slips] == 0.0)
        assert abs(float(patch.time) - share * full.duration) < 0.02 * full.duration


@pytest.mark.parametrize("friction", [0.2, 1e6])
def test_where_little_slips_the_problem_is_linear(friction):
    """psi_1 of 1e-4 and 1e-10, then far less by friction: the same psi_2/psi_1."""
    pair = against_wall(STEEL, STEEL, friction)
    ratios = [
        carom.impact(
            pair, normal_speed=1.0, tangential_speed=speed, method=TINY
        ).contact_restitution
        for speed in (2e-5, 2e-11)
    ]
    assert ratios[0] == pytest.approx(ratios[1], abs=2e-3)
    assert abs(ratios[0]) < 0.6


def test_fields_are_those_of_the_theory_in_gross_slip():
    """Slip everywhere is along x by Barber's (30): traction mu p, no part across but the grid's."""
    hit = carom.impact(against_wall(STEEL, STEEL), speed=1.0, angle="80 deg", method=COARSE)
    patch = hit.fields(0.5 * hit.duration)
    inside = patch.zone.values == 2
    assert np.allclose(patch.traction_x.values[inside], 0.3 * patch.pressure.values[inside])
    assert np.abs(patch.traction_y).max() < 0.02 * np.abs(patch.traction_x).max()
    assert not np.any(hit.fields(0.1 * hit.duration).zone == 1)
    assert float(hit.history(50).stick_radius.max()) == 0.0


def test_a_result_is_one_dataset_that_says_how_it_was_made(both, tmp_path):
    full, _ = both
    carom.save(full.to_dataset(), tmp_path / "hit.nc")
    stored = carom.read(tmp_path / "hit.nc")
    inputs = json.loads(stored.attrs["inputs"])
    assert (inputs["method"], inputs["elements"], inputs["steps"]) == ("halfspace", 16, 75)
    assert float(stored.psi_out_error) == full.psi_out_error
    assert stored.slip_angle.attrs["units"] == "rad"


def test_unlike_materials_couple_and_the_result_does_not_warn_of_it():
    pair = against_wall(STEEL, CORK, friction=0.5)
    full = carom.impact(pair, speed=1.0, angle="40 deg", method=TINY)
    exact = carom.impact(pair, speed=1.0, angle="40 deg")
    assert 0.002 < abs(full.psi_out - exact.psi_out) < 0.2
    assert 0.9 < full.normal_restitution < 0.9999
    names = [{f.name for f in hit.validity.findings} for hit in (full, exact)]
    assert names[0] - names[1] == {"error of energy", "error of psi_2 by waves"}
    assert names[1] - names[0] == set()
    assert "Dundurs beta" in str(exact.validity)
    assert "Dundurs beta" not in str(full.validity)
    history = full.history(50)
    assert full.dissipated_energy == pytest.approx(float(history.frictional_work[-1]), rel=0.02)
    tangential = full.pair.tangential_mass * full.scales.tangential_speed**2
    alone = 0.5 * tangential * (full.psi_in**2 - full.psi_out**2)
    assert full.dissipated_energy > 1.01 * alone
    assert full.lost_energy == 0.0


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"method": "fem"}, r"^method: 'fem' cannot be used; must be 'exact', 'halfspace' or"),
        (
            {"losses": carom.KelvinVoigt(restitution=0.9)},
            r"^losses: .*elastic bodies only; leave losses",
        ),
        (
            {"pair": against_wall(friction=0.0)},
            r"^friction: 0.0 .* without friction the theory is exact; leave method out",
        ),
        ({"pair": against_wall(friction=1e-90)}, r"^psi_1: .* leave method out"),
    ],
)
def test_what_cannot_be_solved_is_refused(change, said):
    arguments = {"pair": against_wall(), "method": "halfspace", **change}
    refused(said, carom.impact, speed=1.0, angle="20 deg", **arguments)


def test_normal_and_tangential_contact_that_do_not_agree_are_told(monkeypatch):
    """With too few exchanges, as with too strong a coupling: no result, and a reason."""
    monkeypatch.setattr("carom.halfspace.quasistatic.MOST_EXCHANGES", 2)
    with pytest.raises(RuntimeError, match=r"friction times Dundurs' beta is 0\.1"):
        carom.impact(against_wall(STEEL, CORK, 0.2), speed=1.0, angle=0.3, method=TINY)


@pytest.mark.parametrize("grid", [{"elements": 7}, {"elements": 16.0}, {"steps": 19}])
def test_grids_that_are_too_coarse_are_refused(grid):
    refused(r"must be a whole number of at least", carom.BoundaryElements, **grid)


def test_a_time_outside_the_contact_is_refused(both):
    refused(r"^at: '1 s' cannot be used; must lie within", both[0].fields, "1 s")
