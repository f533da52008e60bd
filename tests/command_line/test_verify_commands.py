"""`carom verify laws`, `tune` and `lammps`: what they print, store, and refuse in one line."""

import json
import re
from functools import partial
from pathlib import Path

import numpy as np
import pytest
from tests import checks
from tests.literature.test_law_ranking import MEASURED

import carom
from carom.verify import Lammps, rank, recipes, tune
from carom.verify.entries import CATALOGUE, EXACT

CASE = checks.CASE.replace("30 deg", "35 deg")
ONE = ("--law", "mindlin")
FALSE = ("--program", "/bin/false")
engine = pytest.mark.engine
installed = pytest.mark.skipif(Lammps().executable() is None, reason="no LAMMPS is installed")


@pytest.fixture
def verify(run):
    """Return a call of `carom verify` in an empty folder: exit code, output, errors."""
    return partial(run, "verify")


@pytest.fixture
def few_laws(monkeypatch):
    """Let `tune` have three laws instead of all, as that takes long; return that `tune`."""
    laws = (carom.dem.LinearSpring(), carom.dem.HardSphere(0.4), carom.dem.LiggghtsHertz())
    few = partial(tune, laws)
    monkeypatch.setattr(carom.verify, "tune", few)
    return few


def folder():
    return {path.name for path in Path().iterdir()}


def test_laws_as_json(verify):
    """All laws, by rising error, with the six errors that were measured independently; nothing
    else on standard output."""
    code, out, err = verify("laws", "--json")
    record = json.loads(out)
    actual = {law["law"]: law["max_error"] for law in record["laws"]}
    assert (code, err) == (0, "")
    assert actual.keys() == {entry.label for entry in CATALOGUE}
    assert {label: actual[label] for label in MEASURED} == pytest.approx(MEASURED, abs=1e-3)
    assert list(actual.values()) == sorted(actual.values())


def test_laws_of_a_shell(verify):
    """chi, kappa and psi_1 as given; the table holds what the library finds."""
    options = ("--chi", "1.0294", "--kappa", "0.8235", "--psi", "0.5", "--psi", "2")
    code, out, _ = verify("laws", *options)
    expected = rank(chi=1.0294, kappa=0.8235, psi_1=(0.5, 2.0))
    assert (code, out) == (0, f"{expected}\n")
    assert out.splitlines()[0].endswith(", at 2 incidences, psi_1 from 0.5 to 2")
    record = json.loads(verify("laws", *options, "--json")[1])
    assert record == expected.to_dict()
    assert record["laws"] != rank(chi=1.0294, psi_1=(0.5, 2.0)).to_dict()["laws"]


@pytest.mark.slow
def test_one_law_with_all_that_can_be_stored(verify):
    files = ("--output", "laws.nc", "--plot", "laws.svg", "--map", "map.png")
    code, out, err = verify("laws", *ONE, *files, "--json")
    assert code == 0
    assert [law["law"] for law in json.loads(out)["laws"]] == ["mindlin"]
    assert folder() == {"laws.nc", "laws.svg", "map.png"}
    names = ("laws.nc", "laws.svg", "map.png")
    assert sorted(err.splitlines()) == [f"Carom has stored {name}." for name in names]
    assert Path("map.png").read_bytes().startswith(b"\x89PNG")
    assert "</svg>" in Path("laws.svg").read_text()
    assert carom.read("laws.nc").max_error.item() == pytest.approx(0.5763, abs=1e-3)


def test_map_as_a_table(verify):
    """The error of one law over psi_1 and chi is that of the library, to the last bit."""
    code, _, _ = verify("laws", "--law", "rigid Coulomb", "--map", "map.nc", "--output", "laws.csv")
    assert code == 0
    assert carom.read("map.nc").identical(carom.verify.error_map(carom.dem.HardSphere()))
    assert Path("laws.csv").read_text().splitlines()[1].startswith("rigid Coulomb,")


@pytest.mark.slow
def test_tune_without_bodies(verify, few_laws):
    code, out, err = verify("tune", "--chi", "1.4412", "--from", "0.5", "--to", "4", "--json")
    expected = few_laws(chi=1.4412, psi_1=np.linspace(0.5, 4.0, 61)).to_dict()
    record = json.loads(out)
    assert (code, err) == (0, "")
    assert {name: record[name] for name in expected} == expected
    assert (record["inputs"], record["normal_speed"], record["duration"]) == ({}, None, None)


def test_tune_by_another_measure_and_kappa(verify, few_laws):
    options = ("--chi", "1.4412", "--kappa", "1.0", "--measure", "rms", "--json")
    record = json.loads(verify("tune", *options)[1])
    expected = few_laws(chi=1.4412, kappa=1.0, measure="rms").to_dict()
    assert {name: record[name] for name in expected} == expected


@pytest.mark.usefixtures("few_laws")
def test_tune_a_case_between_angles(verify, pair):
    """psi_1 = kappa tan(angle)/mu; inputs and time step for the normal speed of the case."""
    Path("ball.toml").write_text(CASE)
    options = ("--from", "5 deg", "--to", "60 deg", "--restitution", "0.8")
    code, out, _ = verify("tune", "ball.toml", *options, "--json")
    record = json.loads(out)
    kappa = 2 * (1 - 0.3) / (2 - 0.3)
    ends = kappa * np.tan(np.deg2rad([5.0, 60.0])) / 0.2
    assert code == 0
    assert (record["kappa"], record["chi"]) == pytest.approx((kappa, 7 / 4 * kappa), rel=1e-12)
    assert record["psi_in"] == pytest.approx(ends, rel=1e-12)
    speed = 2.0 * np.cos(np.deg2rad(35.0))
    hit = carom.impact(pair, normal_speed=speed)
    assert record["normal_speed"] == pytest.approx(speed, rel=1e-12)
    assert record["duration"] == pytest.approx(hit.history(3).time.values[-1], rel=1e-6)
    spring = next(law for law in record["laws"] if law["law"] == "linear spring")
    best = carom.dem.LinearSpring(spring["value"])
    sideways = carom.dem.LammpsMindlin("mindlin_rescale/force", tangential_damping=1.0)
    assert record["inputs"] == recipes(pair, speed, 0.8, spring=best, mindlin=sideways)
    assert " 1 0.2 damping coeff_restitution" in record["inputs"]["LAMMPS Hertz"]
    table = verify("tune", "ball.toml", *options)[1]
    micro = 1e6 * record["duration"]
    assert f"normal speed of {speed:.4g} m/s the contact lasts {micro:.4g} µs; " in table
    lines = [line for text in record["inputs"].values() for line in text.splitlines()]
    assert all(line in table for line in lines)


BALL = """friction = 0.2
speed = "1 m/s"
angle = "10 deg"
[first]
radius = "5 mm"
material = "steel"
"""


def test_laws_say_how_ones_own_ball_leaves(verify):
    """With `mindlin` at 9.5 degrees instead of 7.3, with 18 % of the spin, as the README says."""
    Path("ball.toml").write_text(BALL)
    code, out, _ = verify("laws", "--case", "ball.toml", "--law", "mindlin", "--json")
    own = json.loads(out)["own_impact"]
    steel = {"material": "steel"}
    ball = carom.Sphere(radius="5 mm", **steel)
    hit = carom.impact(
        carom.Pair(ball, carom.HalfSpace(**steel), friction=0.2), speed=1.0, angle="10 deg"
    )
    exact, (mindlin,) = own["exact"], own["laws"]
    assert code == 0
    assert exact == pytest.approx(
        {name: getattr(hit, name) for name in ("psi_out", "rebound_angle", "spin_out")}
    )
    assert np.degrees([hit.rebound_angle, mindlin["rebound_angle"]]).round(1).tolist() == [7.3, 9.5]
    assert mindlin["spin_out"] / hit.spin_out == pytest.approx(0.18, abs=0.005)
    table = verify("laws", "--case", "ball.toml", "--law", "mindlin")[1].splitlines()
    assert table[0].startswith("The theory fails for this impact")  # mild steel yields
    assert own["verdict"] == hit.validity.verdict == "fails"
    assert len(own["validity"]) == len(hit.validity.findings)
    assert table[3].split()[:2] == ["exact", "7.25"]
    assert table[4].split()[:2] == ["mindlin", "9.51"]


@pytest.mark.parametrize("losses", ["", "restitution = 0.8\n"])
def test_laws_of_a_case_are_those_of_its_numbers(verify, losses):
    """Damped for its restitution; two balls with spins leave as momentum and psi_2 have it."""
    second = '[second]\nkind = "sphere"\nradius = "3 mm"\nmaterial = "steel"\n'
    Path("ball.toml").write_text(f"{losses}spin = 100\nspin2 = -30\n{BALL}{second}")
    record = json.loads(verify("laws", "--case", "ball.toml", *ONE, "--json")[1])
    e = 0.8 if losses else 1.0
    one, two = (carom.Sphere(radius=radius, material="steel") for radius in ("5 mm", "3 mm"))
    pair = carom.Pair(one, two, friction=0.2)
    wanted = {} if e == 1.0 else {"restitution": e}
    bare = rank([carom.dem.LammpsMindlin("mindlin")], chi=pair.chi, kappa=pair.kappa, **wanted)
    assert record["laws"][0]["max_error"] == bare.standings[0].max_error
    losing = None if e == 1.0 else carom.KelvinVoigt(restitution=e)
    hit = carom.impact(pair, speed=1.0, angle="10 deg", spin=100, spin2=-30, losses=losing)
    own = record["own_impact"]
    assert own["exact"]["spin_out"] == pytest.approx(hit.spin_out, rel=1e-12)
    (law,) = own["laws"]
    share = (law["psi_out"] - hit.psi_in) / (hit.psi_out - hit.psi_in)  # of the impulse
    spin = hit.spin + share * (hit.spin_out - hit.spin)
    assert law["spin_out"] == pytest.approx(spin, rel=1e-9)


@pytest.mark.first_case
@pytest.mark.usefixtures("few_laws")
@pytest.mark.parametrize("e", [1.0, 0.5])
def test_tune_names_the_exact_law(verify, e):
    """Those who cannot change their law should know that some codes can; in LIGGGHTS e is 1."""
    Path("ball.toml").write_text(CASE)
    out = verify("tune", "ball.toml", "--restitution", e)[1]
    answer = json.loads(verify("tune", "ball.toml", "--restitution", e, "--json")[1])["exact_law"]
    assert "pair_style carom in LAMMPS" in out
    assert answer["LAMMPS"] == "pair_style carom"
    assert ("tangential carom in LIGGGHTS" in out) == ("LIGGGHTS" in answer) == (e == 1.0)


@pytest.mark.usefixtures("few_laws")
def test_tune_a_case_without_motion(verify):
    """Where the case has no speed the inputs are for 1 m/s, and that is said."""
    Path("ball.toml").write_text(CASE.replace("speed", "#").replace("angle", "#"))
    code, out, _ = verify("tune", "ball.toml")
    assert code == 0
    assert "At a normal speed of 1 m/s the contact lasts " in out
    assert out.count("linear spring") == 1


@pytest.mark.slow
@engine
@installed
def test_lammps_as_json(verify):
    """Every law of LAMMPS, by rising error; each is the law of Carom at the same steps, and the six
    errors are those that were measured independently."""
    code, out, err = verify("lammps", "--json")
    record = json.loads(out)
    laws = {law["law"]: law for law in record["laws"]}
    actual = {label: laws[label]["max_error"] for label in MEASURED}
    assert (code, err, record["engine"]) == (0, "", "LAMMPS")
    assert actual == pytest.approx(MEASURED, abs=1e-3)
    assert max(law["law_error"] for label, law in laws.items() if label != EXACT) < 1e-6
    assert laws.get(EXACT, {"law_error": 0.0})["law_error"] < 1e-5  # where the plugin is built
    order = [law["max_error"] for law in record["laws"]]
    assert order == sorted(order)
    assert re.match(r"\d+ \w+ \d{4}", record["version"])


@engine
@installed
def test_from_nothing_to_a_verdict(verify):
    """Two commands: LAMMPS computes the impacts, the scorer finds bodies and error by itself; what
    carom finds for mindlin, 0.576, is what it says."""
    code, out, err = verify("lammps", *ONE, "--output", "results.csv")
    assert (code, err, folder()) == (0, "Carom has stored results.csv.\n", {"results.csv"})
    assert out.count("mindlin") == 1
    code, out, _ = verify("score", "results.csv")
    assert code == 1
    assert out.splitlines()[-1].startswith("FAIL: max |error in psi_2| = 0.5763")
    assert verify("score", "results.csv", "--tolerance", "0.6")[0] == 0


@engine
@installed
def test_lammps_with_other_bodies_and_steps(verify):
    Path("ball.toml").write_text(CASE.replace('"steel"', '"soda-lime-glass"'))
    code, out, _ = verify("lammps", *ONE, "--case", "ball.toml", "--steps", "500", "--json")
    record = json.loads(out)
    glass = carom.Sphere(radius="5 mm", material="soda-lime-glass")
    pair = carom.Pair(glass, carom.HalfSpace(material="soda-lime-glass"), friction=0.2)
    assert (code, record["steps"]) == (0, 500)
    assert record["chi"] == pytest.approx(pair.chi, rel=1e-12) != 1.4412
    law = carom.dem.LammpsMindlin()
    wrong = law.rebound(record["psi_in"], pair.chi) - carom.rebound(record["psi_in"], pair.chi)
    assert record["laws"][0]["max_error"] == pytest.approx(np.abs(wrong).max(), abs=1e-3)


@pytest.mark.skipif(not Path("/bin/false").exists(), reason="needs a program that fails")
def test_a_program_that_fails(verify):
    """Exit code 1, what happened in the place of the numbers, and no results."""
    options = ("lammps", *FALSE, *ONE, "--output", "results.csv")
    code, out, err = verify(*options, "--json")
    (law,) = json.loads(out)["laws"]
    assert (code, err, folder()) == (1, "", set())
    assert re.match(r"LAMMPS has crashed \(exit code 1\)", law["failure"])
    code, out, _ = verify(*options)
    assert code == 1
    assert law["failure"] in out


BAD = {
    ("laws", "--chi", "-1"): "chi: '-1' .*must be positive",
    ("laws", "--chi", "1.4", "--kappa", "0"): "kappa: '0' .*must be positive",
    ("laws", "--psi", "inf"): "psi_in: 'inf' .*give a number",
    ("laws", "--law", "mindln"): "law: 'mindln' .*did you mean 'mindlin'",
    ("laws", "--law", "qqq"): "law: 'qqq' .*must be one of: linear spring, k_t/k_n = kappa; ",
    ("laws", "--chi", "1e4", *ONE): "chi: 10000.0 .*is not solved: more than 200 phases",
    ("laws", "--psi", "0"): "psi_1: .*must not all be zero",
    ("laws", *ONE, "--map", "x.nc", "--output", "x.nc"): "map: 'x.nc' .*this file is also that of",
    ("laws", *ONE, "--map", "x.nc", "--kappa", "1"): "map: it shows solid spheres",
    ("laws", "--output", "x.xls"): r"output file: 'x.xls' .*\.nc or \.csv",
    ("laws", "--plot", "x.txt"): r"output file: 'x.txt' .*\.png",
    ("laws", "--plot", "no/x.png"): "output file: .*folder must exist",
    ("laws", "--map", "x.png"): "map: it shows one law; give --law",
    ("laws", *ONE, "--map", "x.gif"): r"output file: 'x.gif' .*\.png",
    ("tune",): "case: missing; give a case file, or --chi",
    ("tune", "--kappa", "1"): "case: missing",
    ("tune", "ball.toml", "--chi", "1.4"): "chi: '1.4' .*follows from the case; leave it out",
    ("tune", "ball.toml", "--kappa", "1"): "kappa: '1' .*follows from the case; leave it out",
    ("tune", "none.toml"): "case file: 'none.toml' cannot be read; No such file",
    ("tune", "smooth.toml"): "friction: 0.0 .*must be positive",
    ("tune", "--chi", "-1"): "chi: '-1' .*must be positive",
    ("tune", "--chi", "1.4", "--restitution", "0.9"): "restitution: '0.9' .*needs a case file",
    ("tune", "--chi", "1.4", "--measure", "mean"): "measure: 'mean' .*must be max or rms",
    ("tune", "--chi", "1.4", "--from", "3", "--to", "2"): "to: '2' .*must be above --from, 3",
    ("tune", "--chi", "1.4", "--from", "-3"): "from: '-3' .*must not be negative",
    ("tune", "--chi", "1.4", "--from", "7"): "from: '7' .*psi_1 = 7 the contact slides throughout",
    ("tune", "--chi", "1.4", "--to", "60 deg"): "psi_in: '60 deg' .*it has a unit",
    ("tune", "ball.toml", "--to", "90 deg"): "angle: '90 deg' .*must be below 90 deg",
    ("tune", "ball.toml", "--to", "60"): "angle: '60' .*write '60 deg'",
    ("tune", "ball.toml", "--from", "60 deg", "--to", "5 deg"): "to: '5 deg' .*--from, 60 deg",
    ("tune", "ball.toml", "--from", "89 deg"): "from: '89 deg' .*slides throughout",
    ("tune", "ball.toml", "--restitution", "0"): "restitution: '0' .*must be from 1e-06 to 1",
    ("tune", "ball.toml", "--restitution", "1.1"): "restitution: '1.1' .*from 1e-06 to 1",
    ("lammps", "--law", "mindln"): "law: 'mindln' .*did you mean 'mindlin'",
    ("lammps", "--output", "r.csv"): "output: it stores the results of one law; give --law",
    ("lammps", *ONE, "--output", "r.txt"): r"output file: 'r.txt' .*must end in \.csv",
    ("lammps", *ONE, "--output", "no/r.csv"): "output file: .*folder must exist",
    ("lammps", "--case", "none.toml"): "case file: 'none.toml' cannot be read",
    ("lammps", "--time-limit", "0"): "time_limit: '0' .*must be positive",
    ("lammps", "--program", "/nowhere/lmp"): "LAMMPS: '/nowhere/lmp' is not an executable",
    ("liggghts", "--program", "/nowhere"): "LIGGGHTS: '/nowhere' is not an executable",
    ("yade", "--program", "/nowhere"): "YADE: '/nowhere' is not an executable",
    ("lammps", *FALSE, "--steps", "9"): "steps: '9' .*at least 10",
    ("lammps", *FALSE, "--case", "smooth.toml"): "friction: 0.0 .*positive",
    ("lammps", *FALSE, "--case", "cup.toml"): "second body: .*DEM codes have no cups",
    ("lammps", *FALSE, "--law", "rigid Coulomb"): "it has linear spring, .*; mindlin",
    ("lamps",): "No such command 'lamps'. Did you mean 'lammps'",
    ("laws", "--colour", "red"): "No such option: --colour",
}


@pytest.mark.parametrize("arguments", BAD, ids=" ".join)
def test_bad_input_gets_one_clear_line(refusal, arguments):
    cases = {
        "ball.toml": CASE,
        "smooth.toml": CASE.replace("0.2", "0"),
        "cup.toml": f'{CASE}[second]\nkind = "cup"\nradius = "10 mm"\n',
    }
    for name, text in cases.items():
        Path(name).write_text(text)
    line = refusal("verify", *arguments)
    assert re.search(BAD[arguments], line), line
    assert folder() == cases.keys()
