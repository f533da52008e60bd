"""What says two things at once is refused or told: never is one of them taken without a word."""

import json
from types import SimpleNamespace

import numpy as np
import pandas as pd
import pint
import pytest
import xarray as xr
from tests.checks import refused

import carom

Q = pint.Quantity
SPIN = [-230.0, -660.0, -680.0, -640.0]
ROWS = {"angle [deg]": [10.0, 30.0, 50.0, 70.0], "spin_out [rpm]": SPIN, "speed": [1.0] * 4}
CASE = {"first": {"radius": 0.05, "material": "steel"}, "second": {"material": "steel"}}


@pytest.mark.parametrize("unit", ["mm", "kg"])
def test_a_text_of_pint_has_no_second_unit(unit):
    """Newer versions of pint make it a number themselves, so such a quantity is made here."""
    text = SimpleNamespace(magnitude="5", units=pint.Unit(unit), to_root_units=None)
    match = f"radius: '5' cannot be used; it is a text, and has the unit .*{unit[0]}.*, too"
    refused(match, carom.Sphere, radius=text, material="steel")


def test_arrays_along_different_dimensions(pair):
    one, other = (xr.DataArray([0.5, 1.0], dims=name) for name in "ab")
    match = "their dimensions are a and b; give arrays along the same ones"
    refused(f"psi_1, chi: {match}", carom.rebound, one, other)
    refused(match, carom.dem.LinearSpring().rebound, one, other)
    values = {"speed": one, "angle": other}
    refused(match, carom.convert_observables, pair, known=values, wanted="psi_in")
    forces = {"normal_force": one, "tangential_force": other}
    refused(match, carom.load_path, pair, **forces)
    assert carom.rebound(one, one).shape == (2,)


def test_an_index_with_a_name_is_a_column(pair):
    frame = pd.DataFrame(ROWS)
    whole = carom.fit(frame.assign(**{"spin [rpm]": 100.0 + frame.index}), pair=pair)
    index = pd.Index(100.0 + frame.index, name="spin [rpm]")
    by_index = carom.fit(frame.set_index(index), pair=pair)
    assert by_index.friction.value == whole.friction.value
    twice = frame.set_index(pd.Index(SPIN, name="speed"))
    refused("its index has the name of a column", carom.fit, twice, pair=pair)


def test_columns_by_number_and_without_a_name(pair):
    frame = pd.DataFrame(np.transpose(list(ROWS.values())))
    named = carom.fit(frame, pair=pair, columns=dict(enumerate(ROWS)))
    assert named.friction.value == carom.fit(ROWS, pair=pair).friction.value
    words = "columns: .* must map heads of columns to names"
    refused(words, carom.fit, ROWS, columns={"speed": ""})


def test_one_parameter_by_two_names(pair):
    fixed = {"restitution": 1.0, "kappa": 0.8, "chi": 0.6}
    refused("kappa and chi: each follows from the other", carom.fit, ROWS, pair=pair, fixed=fixed)


def test_bodies_of_the_data_and_others(tmp_path, pair):
    table = tmp_path / "rows.csv"
    lines = [",".join(map(str, row)) for row in zip(*ROWS.values(), strict=True)]
    body = "\n".join([",".join(ROWS), *lines])
    table.write_text(f"# case: {json.dumps(CASE)}\n{body}\n")
    refused("pair: its bodies differ from those in the data", carom.fit, table, pair=pair)
    table.write_text(f"# case: {json.dumps({'frist': {}, **CASE})}\n{body}\n")
    refused("frist: unknown key", carom.fit, table, pair=pair)


def test_results_with_columns_that_the_scorer_does_not_use(pair):
    hits = [carom.impact(pair, speed=1.0, angle=a, spin=50.0) for a in (0.1, 0.5, 1.0, 1.3)]
    results = {"speed": [1.0] * 4, "angle": [0.1, 0.5, 1.0, 1.3], "spin": [50.0] * 4}
    for name in ("tangential_speed_out", "spin_out"):
        results[name] = [getattr(hit, name) for hit in hits]
    assert carom.verify.score(results, case=pair).passed
    score = carom.verify.score({**results, "run": [1, 2, 3, 4], "friction": [0.2] * 4}, case=pair)
    assert score.notes[-1] == "columns that were not used: run, friction"
    results["Spin"] = results.pop("spin")
    refused("Spin: unknown column; did you mean 'spin'", carom.verify.score, results, case=pair)


def test_a_chi_and_the_bodies_of_the_results(tmp_path, pair):
    psi = [0.5, 1.0, 2.0]
    chi = pair.chi
    rows = "\n".join(f"{a},{b}" for a, b in zip(psi, carom.rebound(psi, chi), strict=True))
    table = tmp_path / "points.csv"
    table.write_text(f"# case: {json.dumps({**CASE, 'friction': 0.2})}\npsi_1,psi_2\n{rows}\n")
    assert carom.verify.score(table, chi=round(chi, 2)).passed
    words = f"chi: 5 .*the bodies in the results have chi = {chi:.4g}"
    refused(words, carom.verify.score, table, chi=5)


def test_a_score_is_against_one_restitution(pair):
    hit = carom.impact(pair, speed=1.0, angle=0.5, losses=carom.ElasticPlastic(0.1))
    words = "losses: .* a restitution that is the same"
    refused(words, carom.verify.score, hit.history(200), case=hit)


def test_an_error_of_a_spreadsheet_is_no_comment(tmp_path, pair):
    table = tmp_path / "rows.csv"
    table.write_text("angle [deg],speed,spin_out [rpm]\n#N/A,1,-230\n30,1,-660\n50,1,-680\n")
    refused("angle: no value in cell A2", carom.fit, table, pair=pair)
    table.write_text(table.read_text().replace("#N/A", "#DIV/0!"))
    refused("angle: not a number in cell A2; '#DIV/0!' cannot", carom.fit, table, pair=pair)


def test_names_with_blanks_are_one_name():
    table = carom.Table({"first.material": ["steel ", "steel", " glass"], "speed": [1.0, 2.0, 3.0]})
    codes = table.inputs((slice(0, 3),))["first.material"]
    assert codes[0] == codes[1] != codes[2]
