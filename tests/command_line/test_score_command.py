"""`carom verify score`: verdict, exit code, and one clear line for every bad input."""

import json
import re
from functools import partial
from pathlib import Path

import numpy as np
import pytest
from tests.checks import CASE, refused

import carom
from carom.bodies.cases import case_of

CHI = 1.4412
PSI = np.array([0.1, 0.5, 1.0, 2.0, 4.0, 6.0])


@pytest.fixture(autouse=True)
def folder(run):
    Path("ball.toml").write_text(CASE.replace("30 deg", "35 deg"))


@pytest.fixture
def score(run):
    """Return exit code, output and errors of a score."""
    return partial(run, "verify", "score")


@pytest.fixture(scope="module")
def struck(pair):
    return carom.impact(pair, speed=2.0, angle="35 deg")


def table(columns, name="results.csv"):
    """Write columns as CSV and return the name of the file."""
    rows = zip(*columns.values(), strict=True)
    lines = [",".join(columns), *(",".join(map(str, row)) for row in rows)]
    Path(name).write_text("\n".join(lines) + "\n")
    return name


def psi_columns(added=0.0):
    return {"psi_1": PSI, "psi_2": carom.rebound(PSI, CHI) + added}


@pytest.mark.parametrize(("added", "code", "word"), [(0.009, 0, "PASS"), (0.011, 1, "FAIL")])
def test_exit_code_is_the_verdict(score, added, code, word):
    """0.01 of psi_2, the tolerance by default, lies between; another one turns it."""
    file = table(psi_columns(added))
    actual, out, err = score(file, "--chi", str(CHI))
    assert (actual, err) == (code, "")
    assert out.strip().splitlines()[-1].startswith(f"{word}: max |error in psi_2| = {added}")
    assert score(file, "--chi", str(CHI), "--tolerance", "0.02")[0] == 0
    assert score(file, "--chi", str(CHI), "--tolerance", "0.001")[0] == 1


def test_damped_results_are_compared_with_what_loses_as_much(score):
    damped = {"psi_1": PSI, "psi_2": carom.rebound(PSI, CHI, losses=carom.KelvinVoigt(0.8))}
    file = table(damped)
    assert score(file, "--chi", str(CHI))[0] == 1
    code, out, _ = score(file, "--chi", str(CHI), "--restitution", "0.8", "--json")
    record = json.loads(out)
    assert (code, record["passed"], record["restitution"]) == (0, True, 0.8)
    Path("damped.toml").write_text("restitution = 0.8\n" + CASE)
    code, out, _ = score(file, "--case", "damped.toml", "--json")
    assert json.loads(out)["restitution"] == 0.8


def test_table_tells_points_phases_and_audit(score):
    columns = psi_columns()
    columns["psi_2"][2] = 1.5
    _, out, _ = score(table(columns), "--chi", str(CHI))
    (line,) = (text for text in out.splitlines() if text.split()[:2] == ["4", "1"])
    assert float(line.split()[3]) == 1.5
    assert float(line.split()[5]) == pytest.approx(1.5 - carom.rebound(1.0, CHI), rel=1e-3)
    assert re.search(r"gross slip \+, stick, slip -, gross slip - +1 ", out)
    assert "energy is gained in line 4: 1.25 in psi^2" in out


def test_json_holds_the_same(score):
    columns = psi_columns(0.02)
    code, out, _ = score(table(columns), "--chi", str(CHI), "--json")
    record = json.loads(out)
    assert (code, record["passed"], record["failures"]) == (1, False, ["psi_2"])
    np.testing.assert_allclose(record["points"]["error"], 0.02, rtol=1e-10)
    assert record["points"]["line"] == [2, 3, 4, 5, 6, 7]
    assert record["max_error"] == pytest.approx(0.02)
    assert sum(group["points"] for group in record["phases"]) == PSI.size
    assert {finding["name"] for finding in record["audit"]} == {"energy gain", "friction impulse"}


def test_velocities_and_forces_with_a_case(score, struck):
    """The bodies from the case file; the motion of it only for a history."""
    hits = [carom.impact(struck.pair, speed=1.0, angle=angle) for angle in (0.1, 0.6, 1.2)]
    names = ("normal_speed", "tangential_speed", "spin", "tangential_speed_out", "spin_out")
    file = table({name: [getattr(one, name) for one in hits] for name in names})
    code, out, _ = score(file, "--case", "ball.toml")
    assert code == 0
    assert "note: normal_speed_out is not given" in out
    history = struck.history(50)
    names = ("time", "normal_force", "tangential_force")
    file = table({name: history[name].values for name in names})
    code, out, _ = score(file, "--case", "ball.toml", "--json")
    assert code == 0
    assert json.loads(out)["kind"] == "history"
    assert json.loads(out)["points"]["psi_in"] == [pytest.approx(struck.psi_in, rel=1e-12)]


def test_figure_and_data_are_stored(score, tmp_path):
    options = ("--chi", str(CHI), "--plot", "score.png", "--output", "score.nc")
    code, _, err = score(table(psi_columns(0.02)), *options)
    assert code == 1
    assert sorted(err.splitlines()) == [f"Carom has stored score.{end}." for end in ("nc", "png")]
    assert (tmp_path / "score.png").read_bytes().startswith(b"\x89PNG")
    np.testing.assert_allclose(carom.read("score.nc").error, 0.02, rtol=1e-10)


SPEEDS = "normal_speed,tangential_speed,tangential_speed_out,spin_out\n"
FORCES = "time,normal_force,tangential_force\n"
BAD = {
    "": "it is empty",
    "psi_1,psi2\n0.1,0.2\n": "psi2: unknown column; did you mean 'psi_2'?",
    "omega,angel\n1,2\n": "no column of omega, angel is known; did you mean 'angle'?",
    "psi_1,psi_2\n1,1\n2,2\n3,3\n": "chi: missing; give a column chi, or --chi",
    "psi_1,psi_2,chi\n1,1,1\n2,2,-1\n3,3,1\n": "chi: -1 in cell C3",
    "psi_1,psi_2,chi\n1,1,1\n2,2,1\n": "too few points: 2",
    "psi_1,psi_2,chi\n1,1,1\n\n# a\n2,nan,1\n3,,1\n": "psi_2: NaN in cell B5; write '-'",
    "psi_1,psi_2,chi\n1,1,1\n2,one,1\n3,3,1\n": "psi_2: not a number in cell B3; 'one'",
    "psi_1 [mm],psi_2,chi\n1,1,1\n": "psi_1: 'mm' cannot be used; it has a unit",
    SPEEDS + "1,0,0,0\n" * 3: "case: missing; give the bodies, --case",
}
BAD_WITH_CASE = {
    "normal_speed,tangential_speed,tangential_speed_out,spinout\n": "did you mean 'spin_out'",
    SPEEDS + "1,1,1,0\n1,0,0,0\n0,1,1,0\n": "normal_speed: 0 in cell A4",
    SPEEDS.replace("\n", ",spin2_out\n") + "1,0,0,0,1\n" * 3: "only a second sphere can spin",
    FORCES + "0,0,0\n2e-6,10,1\n1e-6,20,2\n3e-6,0,0\n": "time: 1e-06 in cell A4 .* it must rise",
    FORCES + "0,0,0\n1e-5,900,0\n2e-5,800,0\n3e-5,0,0\n": "does not start at the first touch",
}


def score_refused(refusal, message, *arguments):
    line = refusal("verify", "score", *arguments)
    assert re.search(message.replace("[", r"\[").replace("(", r"\("), line), line


@pytest.mark.parametrize("text", BAD)
def test_bad_results_are_refused_in_one_line(refusal, text):
    Path("bad.csv").write_text(text)
    score_refused(refusal, BAD[text], "bad.csv")


@pytest.mark.parametrize("text", BAD_WITH_CASE)
def test_bad_velocities_and_forces_are_refused(refusal, text):
    Path("bad.csv").write_text(text if text.count("\n") > 1 else text + "1,0,0,0\n" * 3)
    score_refused(refusal, BAD_WITH_CASE[text], "bad.csv", "--case", "ball.toml")


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda f: {n: v[12:] for n, v in f.items()}, "start at the first touch; in line 2"),
        (lambda f: {n: v[:40] for n, v in f.items()}, "go on to the last touch; in line 41"),
        (lambda f: {n: v[::4] for n, v in f.items()}, "rows have a normal force; a history needs"),
        (lambda f: f | {"time": 1e6 * f["time"]}, r"if it is in us, head the column 'time \[us\]'"),
        (lambda f: f | {"time": np.arange(60)}, "is time counted in steps?"),
        (lambda f: f | {"normal_force": 1e-3 * f["normal_force"]}, r"'normal_force \[kN\]'"),
        (lambda f: f | {"normal_force": -f["normal_force"]}, "change its sign"),
        (
            lambda f: f | {"normal_force": f["normal_force"] * (np.arange(60) != 30)},
            "normal_force: 0 in cell B32 .* the history of one impact",
        ),
    ],
)
def test_records_that_are_no_whole_contact_are_refused(score, refusal, struck, change, message):
    """What to do is said; a unit in the head of the column is accepted."""
    history = struck.history(60)
    names = ("time", "normal_force", "tangential_force")
    columns = change({name: history[name].values for name in names})
    err = refusal("verify", "score", table(columns), "--case", "ball.toml")
    assert re.search(message, err), err
    unit = re.search(r"'(\w+) (\[\w+\])'", err)
    if unit:
        headed = {f"{n} {unit[2]}" if n == unit[1] else n: v for n, v in columns.items()}
        assert score(table(headed), "--case", "ball.toml")[0] == 0


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (("none.csv",), "results: 'none.csv' cannot be read; No such file or directory"),
        (("good.csv", "--chi", "0"), "chi: '0' cannot be used; must be positive"),
        (("good.csv", "--chi", "1.4", "--tolerance", "-1"), "tolerance: '-1' cannot be used"),
        (("good.csv", "--chi", "1.4", "--plot", "score.txt"), "must end in .png"),
        (("good.csv", "--chi", "1.4", "--case", "ball.toml"), "chi: given twice"),
        (("good.csv", "--case", "none.toml"), "case file: 'none.toml' cannot be read"),
        (("good.csv", "--ki", "1.4"), "--ki"),
        (("good.csv", "--chi", "1.4", "--restitution", "0"), "restitution: '0' cannot be used"),
        (("good.csv", "--chi", "1.4", "--output", "good.csv"), "this file is also that of results"),
    ],
)
def test_bad_options_are_refused(refusal, options, message):
    table(psi_columns(), "good.csv")
    assert message in refusal("verify", "score", *options)


def test_bodies_in_a_comment(score, refusal, pair):
    """Results that bring their bodies along need no case; another one is refused."""
    rows = {"normal_speed": [1.0] * 3, "tangential_speed": [0.1, 0.2, 0.3], "spin": [0.0] * 3}
    hits = [carom.impact(pair, normal_speed=1.0, tangential_speed=t) for t in (0.1, 0.2, 0.3)]
    for name in ("tangential_speed_out", "spin_out"):
        rows[name] = [getattr(one, name) for one in hits]
    text = Path(table(rows)).read_text()
    Path("results.csv").write_text(f"# case: {json.dumps(case_of(pair))}\n{text}")
    assert score("results.csv")[0] == 0
    other = case_of(pair) | {"friction": 0.9 * pair.friction}
    words = "bodies differ from those in the results"
    refused(words, carom.verify.score, "results.csv", case=other)
    Path("results.csv").write_text(f"# case: nothing\n{text}")
    score_refused(refusal, "there is no JSON", "results.csv")
