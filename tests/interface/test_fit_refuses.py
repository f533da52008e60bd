"""Bad input to `fit`: one clear line that names what is wrong, where, and what to do."""

import json

import numpy as np
import pytest
import xarray as xr
from tests.checks import refused

import carom
from carom.bodies.cases import case_of
from carom.lab.fitting import fit

ANGLES = [10.0, 20.0, 30.0, 40.0, 50.0]
BALL = carom.Sphere(radius="2.5 mm", material="steel")
PAIR = carom.Pair(BALL, carom.HalfSpace(material="steel"), friction=0.12)
GOOD = {"angle [deg]": ANGLES, "contact_beta": [0.1, 0.25, 0.0, -0.3, -0.5]}
SPEEDS, NORMAL = {"speed": [2.0] * 5}, {"angle [deg]": [0.0] * 5}
ONE_WRONG = [1.0, 1.0, -1.0, 1.0, 1.0]
NAN = float("nan")
RESTING = {"restitution": 1.0}


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"contact_beta": None, "contact_bta": [0.1] * 5}, "'contact_beta'"),
        ({"contact_beta": None, "e_t": [0.6] * 5}, "'tangential_restitution'"),
        ({"contact_beta": None}, "no measured response"),
        ({"angle [deg]": None}, "angle: column missing"),
        ({"angle [deg]": None, "angle": ANGLES}, r"every row.*'angle \[deg\]'"),
        ({"angle [deg]": [10.0, NAN, 30.0, 40.0, 95.0]}, "row 2"),
        ({"angle [deg]": [10.0, 20.0, 30.0, 40.0, 95.0]}, "in row 5 cannot be used"),
        ({"speed [kg]": [2.0] * 5}, "not a value in m/s"),
        ({"spin_out": [-10.0] * 5}, "speed: column missing; spin_out needs"),
        ({**SPEEDS, "spin_out": [10.0] * 5}, "change the signs"),
        ({"tangential_speed": [1.0] * 5}, "tangential_speed and angle give the same twice"),
        ({"normal_restitution": [98.0] * 5}, "0.98 for 98 percent"),
        ({**SPEEDS, "normal_speed_out": [30.0] * 5}, "normal_speed_out: 30 in every row"),
        ({**SPEEDS, "normal_speed_out": ONE_WRONG}, "normal_speed_out: -1 in row 3"),
        ({"normal_restitution": [0.9, -0.9, 0.9, 0.9, 0.9]}, "normal_restitution: -0.9 in row 2"),
        ({"contact_beta_error": [0.1, 0.0, 0.1, 0.1, 0.1]}, "0 in row 2.*positive"),
        ({"angle [deg]": [0.0, *ANGLES[1:]]}, "contact_beta: 0.1 in row 1.*before is zero"),
        ({**NORMAL, "contact_beta": None, "impulse_ratio": [0.0] * 5}, "every impact is a normal"),
        ({**SPEEDS, "speed": [2.0, -1.0, 2.0, 2.0, 2.0]}, "speed: -1 in row 2"),
    ],
)
def test_bad_columns(changes, words):
    data = {name: values for name, values in (GOOD | changes).items() if values is not None}
    refused(words, fit, data, pair=PAIR)


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"pair": None}, "pair: missing.*# case:"),
        ({"pair": 5}, "pair: 5 cannot be used"),
        ({"vary": ["frction"]}, "did you mean 'friction'"),
        ({"vary": []}, "nothing is left to fit"),
        ({"vary": ["friction", "spin_offset"]}, "spin_offset: it needs speeds"),
        ({"fixed": {"mu": 0.1}}, "'mu' is no parameter"),
        ({"fixed": {"restitution": 1.2}}, "between 0.3 and 1"),
        ({"fixed": {"friction": -1.0}}, "between 0.001 and 10"),
        ({"fixed": {"restitution": "2 m"}}, "it has a unit"),
        ({"fixed": 5}, "values by name"),
        ({"vary": ["friction"], "fixed": {"friction": 0.1}}, "both varied and fixed"),
        ({"vary": 5}, "vary: 5 cannot be used; must be names of friction, kappa"),
        ({"vary": [np.arange(2)]}, "vary: an array of shape"),
        ({"confidence": 95}, "between 0.5 and 1"),
        ({"confidence": "0.9_5"}, "confidence: '0.9_5' cannot be used"),
        ({"confidence": b"0.95"}, "confidence: b'0.95' cannot be used"),
        ({"confidence": "\u0660.\u0669"}, "confidence: .* cannot be used"),
        ({"confidence": xr.DataArray(0.5, attrs={"units": "mm"})}, "confidence: 'mm' cannot be"),
        ({"confidence": 10**400}, "confidence: .*floating point cannot hold it"),
        ({"robust": "no"}, "robust: 'no' cannot be used; must be True or False"),
        ({"robust": None}, "robust: None cannot be used"),
        ({"robust": np.array([])}, "robust: an array of shape .* cannot be used"),
    ],
)
def test_bad_options(options, words):
    refused(words, fit, GOOD, **{"pair": PAIR, **options})


def test_a_long_name_is_told_in_a_short_line():
    assert len(refused("is no parameter", fit, GOOD, pair=PAIR, vary="x" * 5000)) < 300


def test_a_confidence_in_percent_is_the_ratio():
    """As the commands read it."""
    one, other = (fit(GOOD, pair=PAIR, confidence=level) for level in (0.9, "90 %"))
    assert one.to_dict() == other.to_dict()


def test_too_few_values_are_counted():
    few = {name: values[:3] for name, values in GOOD.items()}
    refused("3 measured values cannot determine 3 parameters", fit, few, pair=PAIR)
    enough = {**few, "contact_beta_error": [0.05] * 3}
    assert fit(enough, pair=PAIR, fixed=RESTING).friction.determined


def test_lines_of_a_file_are_named(tmp_path):
    path = tmp_path / "rebounds.csv"
    path.write_text("# mine\nangle [deg],contact_beta\n10,0.1\n20,few\n30,0.0\n")
    refused("contact_beta: not a number in cell B4", fit, path, pair=PAIR)


@pytest.fixture
def with_bodies(tmp_path):
    """A file whose comment has the bodies, but no friction."""
    case = {name: value for name, value in case_of(PAIR).items() if name != "friction"}
    rows = "\n".join(f"{a},{b}" for a, b in zip(*GOOD.values(), strict=True))
    path = tmp_path / "rebounds.csv"
    path.write_text(f"# case: {json.dumps(case)}\nangle [deg],contact_beta\n{rows}\n")
    return path


def test_bodies_may_stand_in_the_file(with_bodies):
    """The case of a comment is the pair; its friction may be left out."""
    one = fit(with_bodies, fixed=RESTING).friction.value
    assert one == pytest.approx(fit(GOOD, pair=PAIR, fixed=RESTING).friction.value, rel=1e-6)


BODY = '"first": {"radius": 0.005, "material": "steel"}'


@pytest.mark.parametrize(
    ("case", "words"),
    [
        ('{"friktion": 0.2, %s}', "friktion: unknown key; did you mean 'friction'"),
        ('{"secnd": {"kind": "sphere"}, %s}', "secnd: unknown key; did you mean 'second'"),
        ('{"second": {"knid": "sphere"}, %s}', "knid: unknown key; did you mean 'kind'"),
        ('{"friction": 0.2, "friction": 0.9, %s}', "friction: it is given twice"),
        ('{%s, "second": {"kind": "cup", "kind": "sphere"}}', "kind: it is given twice"),
        ('{"first": 5}', "first: 5 cannot be used; must be a table"),
        ('{"first": [1]}', "first: .* must be a table"),
        ('{"second": "sphere", %s}', "second: 'sphere' cannot be used; must be a table"),
        ("[1]", "no JSON of the bodies"),
    ],
)
def test_bodies_in_the_file_are_read_as_strictly_as_a_case_file(case, words, tmp_path):
    """In fits as in scores; in a comment, and in the attribute of a dataset."""
    text = case.replace("%s", BODY)
    path = tmp_path / "rebounds.csv"
    path.write_text(f"# case: {text}\nangle [deg],contact_beta\n10,0.1\n20,0.2\n")
    dataset = xr.Dataset({name: ("row", values) for name, values in GOOD.items()})
    for source in (path, dataset.assign_attrs(case=text)):
        refused(words, fit, source)


def test_what_was_not_used_is_told():
    result = fit({**GOOD, "humidity": [40.0] * 5}, pair=PAIR, fixed=RESTING)
    assert "columns that were not used: humidity" in result.notes


def test_advice_on_what_was_not_fitted_is_refused():
    result = fit(GOOD, pair=PAIR, fixed=RESTING)
    refused("'restitution' was not fitted", result.advice, 2, "restitution")
    refused("at least 1", result.advice, 0)


def test_normal_impacts_tell_restitution_if_nothing_else_is_asked():
    data = {"angle": np.zeros(4), "normal_restitution": [0.9, 0.91, 0.89, 0.9]}
    result = fit(data, pair=PAIR, vary="restitution")
    assert result.restitution.value == pytest.approx(0.9, abs=1e-6)


BOUNCING = GOOD | {"normal_restitution": [0.8, 0.79, 0.81, 0.8, 0.8]}
FALLING = {"angle [deg]": [0.0] * 5, "normal_restitution": [0.8, 0.79, 0.81, 0.8, 0.8]}
BARE = carom.Pair(BALL, carom.HalfSpace(material="steel"), friction=0.0)


@pytest.mark.first_case
@pytest.mark.parametrize(
    "vary", ["friction", "kappa", ("friction", "kappa"), ["chi"], ["friction", "chi"]]
)
@pytest.mark.parametrize("by_speeds", [False, True])
def test_a_restitution_that_was_measured_is_not_held_at_one(vary, by_speeds):
    """It was 0.8 throughout, and friction came out 10 % too small without a word."""
    data = dict(BOUNCING)
    if by_speeds:
        data |= {"normal_speed": [2.0] * 5, "normal_speed_out": [1.6] * 5}
        del data["normal_restitution"]
    measured = "normal_speed_out" if by_speeds else "normal_restitution"
    line = refused(f"^restitution: {measured} is in the data", fit, data, pair=PAIR, vary=vary)
    assert "fixed={'restitution': 0.98}" in line
    inputs = {"vary": vary, "fixed": {"restitution": 0.8}} if vary != "friction" else {}
    assert fit(data, pair=PAIR, **inputs).restitution.value == pytest.approx(0.8, abs=0.01)


def lossy(*names, restitution=0.93, least=10.0):
    """Impacts with losses, without noise: friction 0.14."""
    floor, losses = carom.HalfSpace(material="steel"), carom.KelvinVoigt(restitution=restitution)
    pair = carom.Pair(BALL, floor, friction=0.14)
    angles = np.radians(np.linspace(least, 74.0, 9))
    hits = [carom.impact(pair, speed=2.0, angle=angle, losses=losses) for angle in angles]
    values = {name: np.array([getattr(hit, name) for hit in hits]) for name in names}
    noise = np.random.default_rng(5).normal(0.0, 0.005, (len(names), len(angles)))
    return {"angle": angles} | {n: v + e for (n, v), e in zip(values.items(), noise, strict=True)}


def test_a_restitution_that_other_columns_contradict_is_not_held_at_one():
    """Two components of the rebound hold the normal one, 0.93, though no column is called so."""
    data = lossy("tangential_restitution", "rebound_angle")
    refused(
        "^restitution: it would be held at 1, but the data say about 0.9",
        fit,
        data,
        pair=PAIR,
        vary="friction",
    )
    fixed = fit(data, pair=PAIR, vary="friction", fixed={"restitution": 0.93})
    assert fixed.friction.low < 0.14 < fixed.friction.high
    assert not any("taken as 1" in note for note in fixed.notes)


def test_a_restitution_of_one_that_the_data_cannot_contradict_is_told():
    """Where all rows slip throughout only mu (1 + e) follows; friction is 3.5 % too small."""
    result = fit(lossy("tangential_restitution", least=45.0), pair=PAIR, vary="friction")
    assert result.friction.value == pytest.approx(0.14 * 1.93 / 2.0, rel=0.02)
    assert result.notes[0].startswith("restitution: taken as 1, since it is neither varied")
    elastic = lossy("tangential_restitution", "rebound_angle", restitution=1.0)
    assert fit(elastic, pair=PAIR, vary="friction").friction.value == pytest.approx(0.14, rel=0.02)


@pytest.mark.parametrize("case", [None, "file"])
def test_a_friction_that_nobody_has_given_is_not_held(case, with_bodies):
    """It was a guess of 0.3, which the fit called "not varied"."""
    data, pair = (GOOD, BARE) if case is None else (with_bodies, None)
    for vary, fixed in (("kappa", RESTING), ("restitution", {})):
        inputs = {"pair": pair, "vary": vary}
        refused(r"^friction: the bodies have none, but it is", fit, data, fixed=fixed, **inputs)
        held = fit(data, fixed=fixed | {"friction": 0.12}, **inputs)
        assert held.friction.value == 0.12
    assert fit(FALLING, pair=BARE).restitution.value == pytest.approx(0.8, abs=0.01)
    assert fit(BOUNCING, pair=PAIR, vary="restitution").friction.value == 0.12


@pytest.mark.parametrize("name", ["psi_in", "psi_out"])
def test_what_is_in_units_of_friction_needs_it(name):
    """A friction of 0.3 to four digits came out of data that do not tell any."""
    psi = np.array([0.5, 1.0, 1.5, 2.5, 4.0])
    out = carom.rebound(psi, PAIR.chi)
    columns = {"psi_in": {"psi_in": psi, "contact_beta": -out / psi}}
    columns["psi_out"] = {"angle [deg]": ANGLES, "psi_out": out}
    refused(f"friction: missing; {name} is in units", fit, columns[name], pair=BARE)
    fit(columns["psi_in"], pair=PAIR, fixed=RESTING)
