"""`fit` of few or equal rows: what can be told is told, what cannot is named, nothing breaks."""

import json
from itertools import product

import numpy as np
import pytest
from tests.checks import refused

import carom
from carom.lab.fitting import fit

MU = 0.12
RESTING = {"restitution": 1.0}
BALL = carom.Sphere(radius="2.5 mm", material="steel")
PAIR = carom.Pair(BALL, carom.HalfSpace(material="steel"), friction=MU)
START = carom.Pair(BALL, carom.HalfSpace(material="steel"), friction=0.3)


def impacts(angles, *names, **columns):
    """Return what `impact` gives at these angles in degrees, exactly."""
    hits = [carom.impact(PAIR, speed=2.0, angle=f"{angle} deg") for angle in angles]
    data = {name: [getattr(hit, name) for hit in hits] for name in names}
    return {"angle [deg]": list(angles), "speed": [2.0] * len(hits), **data, **columns}


def whole(result):
    """Ask a fit for everything that it offers."""
    assert str(result)
    json.dumps(result.to_dict(), allow_nan=False)
    json.dumps(result.advice(3).to_dict(), allow_nan=False)
    assert np.isfinite(result.to_dataset().curve_high).all()
    assert result.plot().axes
    return result


@pytest.mark.slow
@pytest.mark.parametrize(
    ("vary", "fixed"),
    [
        ("chi", {"friction": MU, "restitution": 0.98}),
        ("friction", {"kappa": PAIR.kappa, "restitution": 1.0}),
        ("restitution", {"kappa": PAIR.kappa, "friction": MU}),
        ("spin_offset", {"kappa": PAIR.kappa, "friction": MU, "restitution": 1.0}),
    ],
)
def test_all_parameters_but_one_may_be_fixed(vary, fixed):
    """Laws of rigid spheres then have nothing free, and are compared all the same."""
    data = impacts((5, 15, 25, 35, 60), "spin_out", "tangential_speed_out", "normal_speed_out")
    actual = whole(fit(data, pair=START, vary=vary, fixed=fixed))
    truth = {"chi": PAIR.chi, "friction": MU, "restitution": 1.0, "spin_offset": 0.0}
    tolerance = {"rel": 0.02, "abs": 0.5 if vary == "spin_offset" else 1e-3}
    assert actual[vary].value == pytest.approx(truth[vary], **tolerance)
    assert np.isfinite([law.criterion for law in actual.comparison]).all()


@pytest.mark.first_case
@pytest.mark.parametrize(
    ("name", "angle"),
    [
        *product(("spin_out", "rebound_speed"), (3.0, 25.0)),
        *product(("rebound_angle", "contact_beta"), (12.0, 60.0)),
    ],
)
def test_five_equal_rows_at_one_angle(name, angle):
    """One number cannot tell both; the truth is told, or one of two exact answers with a word."""
    hit = carom.impact(PAIR, speed=2.0, angle=f"{angle} deg")
    value = -hit.contact_restitution if name == "contact_beta" else getattr(hit, name)
    data = {"angle [deg]": [angle] * 5, "speed": [2.0] * 5, name: [value] * 5}
    actual = fit(data, pair=START, fixed=RESTING)
    assert whole(actual) if angle in (12.0, 25.0) else str(actual)
    words = "one incidence determines friction or kappa"
    assert any(note.startswith(words) for note in actual.notes)
    held = fit(data, pair=START, fixed={"restitution": 1.0, "kappa": PAIR.kappa})
    near = held.friction.value == pytest.approx(MU, rel=0.01)
    assert near or held.friction.open or any("nearly as well" in note for note in held.notes)
    assert not any("one incidence" in note for note in held.notes)


@pytest.mark.parametrize(("apart", "one"), [(0.0995, True), (0.1005, False)])
def test_incidences_within_a_tenth_of_a_degree_are_one(apart, one):
    data = impacts((25.0, 25.0, 25.0, 25.0 + apart), "spin_out")
    notes = fit(data, pair=START, fixed=RESTING).notes
    assert any(note.startswith("one incidence") for note in notes) == one


def test_one_row_with_errors_tells_one_parameter():
    data = impacts([60], "spin_out", spin_out_error=[1.0])
    result = whole(fit(data, pair=START, vary="friction"))
    assert result.friction.low < MU < result.friction.high
    assert "1 value of spin_out in 1 row;" in str(result)


@pytest.mark.parametrize("friction", [0.02, 0.05, 0.1])
def test_what_is_held_is_held_where_the_fit_found_it(friction):
    """All rows stick from the first touch, whatever friction is, errors from the scatter: the chi
    found has the psi_2/psi_1 of the bodies, which are told if it is the other one that has it. With
    friction held where the pair starts from, it would have to be another.
    """
    angles = (1.0, 1.5, 2.0, 2.5, 3.0, 3.5)
    sticking = carom.Pair(BALL, carom.HalfSpace(material="steel"), friction=3.0)
    hits = [carom.impact(sticking, speed=2.0, angle=f"{angle} deg") for angle in angles]
    noise = np.random.default_rng(2).normal(0.0, 0.003, len(angles))
    values = np.array([hit.contact_restitution for hit in hits]) + noise
    pair = carom.Pair(BALL, carom.HalfSpace(material="steel"), friction=friction)
    data = {"angle [deg]": angles, "contact_restitution": values}
    result = fit(data, pair=pair, fixed=RESTING)
    assert result.regimes["stick from the first touch"] == 6
    ratio = carom.rebound(1e-3, result.chi.value) / 1e-3
    assert ratio == pytest.approx(carom.rebound(1e-3, PAIR.chi) / 1e-3, abs=0.01)
    other = [note for note in result.notes if "fit nearly as well" in note]
    answer = [result.kappa.value, *(float(note.split("kappa ")[1]) for note in other)]
    assert min(abs(value / PAIR.kappa - 1.0) for value in answer) < 0.02


def test_errors_below_those_of_the_curves_count_as_these():
    """psi_2 is interpolated to about 1e-4: an error of 1e-12 cannot make an interval narrower."""
    data = impacts((5, 15, 25, 35, 60), "contact_restitution")
    widths = []
    for error in (1e-12, 1e-6):
        errors = {"contact_restitution_error": [error] * 5}
        result = whole(fit({**data, **errors}, pair=START, fixed=RESTING))
        assert any("the accuracy of the curves" in note for note in result.notes)
        widths.append(result.friction.high - result.friction.low)
    assert widths[0] == pytest.approx(widths[1], rel=1e-6)
    assert widths[0] > 1e-5 * MU


def test_a_column_without_a_value_is_told_and_left_out():
    data = impacts((5, 15, 25, 35, 60), "contact_restitution", spin_out=["-"] * 5)
    result = whole(fit(data, pair=START, fixed=RESTING))
    assert "columns that were not used: spin_out (no value in it)" in result.notes
    assert result.friction.value == pytest.approx(MU, rel=1e-3)
    none = {**impacts((5, 15)), "spin_out": ["-"] * 2}
    refused("data: there is no value in spin_out", fit, none, pair=START)


def test_a_parameter_at_the_end_of_its_range_is_named():
    """Normal restitution 0.1 of oblique impacts: curves begin at 0.3."""
    data = {"angle": np.linspace(0.2, 1.0, 5), "normal_restitution": [0.1, 0.11, 0.1, 0.09, 0.1]}
    actual = whole(fit(data, pair=START, vary="restitution"))
    assert "restitution: the best value is at an end of the range from 0.3 to 1" in actual.notes


def test_an_outlier_of_a_factor_is_no_reason_for_wider_errors():
    """One value a thousand times too large, errors given: a robust fit hardly sees it."""
    rows = (5, 10, 15, 20, 25, 30, 35, 45, 60)
    data = impacts(rows, "contact_restitution", contact_restitution_error=[0.01] * 9)
    clean = fit(data, pair=START, fixed=RESTING)
    data["contact_restitution"][4] *= 1000.0
    result = whole(fit(data, pair=START, fixed=RESTING))
    width = clean.friction.high - clean.friction.low
    assert abs(result.friction.value - clean.friction.value) < width
    assert any("outliers: row 5" in note for note in result.notes)


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"spin_out_error": [1.0, "-", 1.0]}, "spin_out_error: missing in row 2, where spin_out"),
        ({"speed_error": [2.0] * 3}, "speed_error: 2 in every row.*smaller than the speed itself"),
        ({"speed": [2.0, 1e300, 2.0]}, r"speed: 1e\+300 in row 2 cannot be used; check its unit"),
        ({"spin_out": [-1.0, -1e200, -1.0]}, "spin_out: -1e.200 in row 2.*check its unit"),
        ({"spin": [0.0, 0.0, 1e200]}, r"spin: 1e\+200 in row 3.*check its unit"),
        ({"spin_out_error": [1.0, 1.0, 1e200]}, "spin_out_error: 1e.200 in row 3.*check its unit"),
        ({"rebound_speed": [2.0, -1.0, 2.0]}, "rebound_speed: -1 in row 2.*must be positive"),
        ({"rebound_speed": [2.0, 2000.0, 2.0]}, "rebound_speed: 2000 in row 2.*energy before"),
    ],
)
def test_numbers_that_cannot_be_meant_are_refused(changes, words):
    data = impacts((20, 40, 60), "spin_out")
    refused(words, fit, {**data, **changes}, pair=START)


def test_bodies_beyond_the_curves_are_refused():
    """chi = (kappa/2)(1 + R^2/K^2) of a ball with its mass in the middle, above 4.1."""
    ball = carom.Sphere(radius="20 mm", material="steel", gyration_radius="5 mm")
    pair = carom.Pair(ball, carom.HalfSpace(material="steel"), friction=0.2)
    words = r"pair: a chi of 7 cannot be fitted.* 0\.25 to 4\.1"
    refused(words, fit, impacts((20, 40, 60), "spin_out"), pair=pair)


def test_a_plan_of_measurements_has_an_end():
    result = fit(impacts((5, 25, 60), "spin_out"), pair=START, fixed=RESTING)
    words = "n: 1000000 cannot be used; must be a whole number from 1 to 1000"
    refused(words, result.advice, 1_000_000)
    for values in ({"steps": 10**9}, {"seed": -1}, {"seed": 10**30}):
        refused(next(iter(values)), result.posterior, **{"steps": 100, **values})
