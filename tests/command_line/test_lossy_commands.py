"""`carom impact` and `carom sweep` with losses, as a user would type them."""

import json
import re
from functools import partial
from pathlib import Path

import numpy as np
import pytest
from tests import checks
from typer.main import get_command

import carom
from carom import plots
from carom.bodies.cases import LOSSES, MOTION, RATIO, losses_of
from carom.cli.commands import app

BALL = ["impact", "--radius", "5 mm", "--material", "steel", "--friction", "0.2"]
SPEED = ["--speed", "2", "--angle", "30 deg"]
LAWS = {
    "--restitution 0.9": carom.KelvinVoigt(restitution=0.9),
    "--loss-time 2us": carom.KelvinVoigt(loss_time="2 us"),
    "--yield-velocity 100mm/s": carom.ElasticPlastic(yield_velocity=0.1),
    "--yield-velocity material": carom.ElasticPlastic(),
    "--flow-stress material": carom.Metal(),
    "--flow-stress 300MPa": carom.Metal(flow_stress=3e8),
    "--relaxation-time 20us --modulus-ratio 1.5": carom.StandardLinearSolid(1.5, "20 us"),
}
CASE = checks.CASE.replace("[first]", 'loss_time = "2 us"\n[first]')
SWEEP = """
[sweep.axes]
restitution = [0.6, 0.8, 1.0, 1.2]
friction = [0.1, 0.3]
"""


@pytest.fixture(autouse=True)
def case(run):
    Path("case.toml").write_text(CASE)


@pytest.mark.parametrize("flags", LAWS)
def test_an_impact_with_losses_is_that_of_the_library(run, pair, flags):
    """All numbers and phases as JSON, which knows no slip angles with losses."""
    code, out, _ = run(*BALL, *SPEED, *flags.split(" "), "--json")
    hit = carom.impact(pair, speed=2.0, angle="30 deg", losses=LAWS[flags])
    record = json.loads(out)
    assert code == 0
    assert record["result"] == hit.scalars()
    assert record["result"]["normal_restitution"] < 0.95
    assert record["inputs"]["losses"] == LAWS[flags]._describe()
    assert [phase["end"] for phase in record["phases"]] == [phase.end for phase in hit.phases]
    angles = {(phase["slip_angle_max"], phase["slip_angle_mean"]) for phase in record["phases"]}
    assert angles == {(None, None)}


def test_the_table_tells_what_was_lost_where_something_was(run):
    meanings = (
        "normal velocity, after to before  ",
        "energy lost in the normal motion  ",
        "energy lost to viscosity in shear  ",
    )
    _, lossy, _ = run(*BALL, *SPEED, "--restitution", "0.9")
    _, elastic, _ = run(*BALL, *SPEED)
    assert [meaning in lossy for meaning in meanings] == [True, True, True]
    assert [meaning in elastic for meaning in meanings] == [False, False, False]
    _, yielding, _ = run(*BALL, *SPEED, "--yield-velocity", "0.1 m/s")
    assert [meaning in yielding for meaning in meanings] == [True, True, False]
    assert "gross slip +" in elastic
    assert "18.6" in elastic
    rows = [line.strip().rsplit("  ", 1) for line in lossy.splitlines() if "  " in line.strip()]
    values = {key.strip(): value for key, value in rows}
    assert float(values[meanings[0].strip()]) == pytest.approx(0.9, abs=1e-5)
    stuck = next(line for line in lossy.splitlines() if line.startswith("  stick"))
    assert stuck.split()[3:5] == ["-", "-"]


def test_a_flag_takes_the_place_of_what_the_case_file_has(run):
    """Of another kind, too; the file alone gives its own law."""
    for flags, law in (
        ([], {"loss_time": 2e-6}),
        (["--loss-time", "1 us"], {"loss_time": 1e-6}),
        (["--restitution", "0.8"], {"restitution": 0.8}),
        (["--yield-velocity", "material"], {"yield_velocity": None}),
    ):
        code, out, _ = run("impact", "case.toml", *flags, "--json")
        assert code == 0
        assert json.loads(out)["inputs"]["losses"] == law


@pytest.mark.slow
def test_files_of_an_impact_with_losses_are_what_it_is_and_can_be_drawn(run, pair):
    code, _, err = run("impact", "case.toml", "--output", "hit.nc", "--plot", "hit.svg")
    assert (code, err.count("stored")) == (0, 2)
    assert "normal losses" in Path("hit.svg").read_text()
    law = carom.KelvinVoigt(loss_time=2e-6)
    wanted = carom.impact(pair, speed=2, angle="30 deg", losses=law).to_dataset()
    assert carom.read("hit.nc").identical(wanted)
    assert len(plots.plot_impact(carom.read("hit.nc")).axes[3].collections) == 8


@pytest.mark.parametrize(
    ("flags", "words"),
    [
        (["--restitution", "1.1"], ("restitution: 1.1", "from 0.001 to 1")),
        (["--restitution", "0"], ("restitution: 0",)),
        (["--restitution", "190 %"], ("restitution: 1.9", "from 0.001 to 1")),
        (["--restitution", "0.9", "--loss-time", "1 us"], ("give it or restitution, not both",)),
        (["--loss-time", "2 mm"], ("loss_time: '2 mm'", "not a value in s")),
        (["--loss-time", "1 s"], ("loss_time", "not solved")),
        (["--yield-velocity", "steel"], ("yield_velocity: 'steel'", "'material'", "0.1 m/s")),
        (["--yield-velocity", "0 m/s"], ("yield_velocity: 0.0", "positive")),
        (["--flow-stress", "steel"], ("flow_stress: 'steel'", "'material'", "1 GPa")),
        (["--flow-stress", "2 m/s"], ("flow_stress: '2 m/s'", "not a value in Pa")),
    ],
)
def test_refuses_losses_in_one_line_and_leaves_nothing(refusal, flags, words):
    line = refusal(*BALL, *SPEED, *flags)
    assert [word for word in words if word not in line] == [], line
    assert [path.name for path in Path().iterdir()] == ["case.toml"]


def test_without_a_yield_strength_there_is_no_yield_velocity(refusal):
    ball = [word.replace("steel", "glass") for word in BALL]
    line = refusal(*ball, *SPEED, "--yield-velocity", "material")
    assert "yield_velocity: missing; give it, or a yield_strength" in line


def test_commands_about_elastic_impacts_refuse_a_case_with_losses(refusal):
    """They say where it stands, rather than to leave it aside."""
    line = refusal("verify", "lammps", "--case", "case.toml")
    assert "loss_time: not used in case.toml, line 4; this is for elastic impacts" in line


VALUES = {"friction": "0.3", "speed": "1 m/s", "angle": "20 deg", "normal_speed": "0.9 m/s"}
VALUES |= {"tangential_speed": "0.3 m/s", "spin": "100 rpm", "spin2": "50 rpm"}
VALUES |= {"restitution": "0.8", "loss_time": "3 us", "yield_velocity": "0.2 m/s"}
VALUES |= {"relaxation_time": "20 us", "modulus_ratio": "1.5", "flow_stress": "400 MPa"}
WITH = {  # what a key goes with; by default friction, speed, angle
    "normal_speed": ("friction", "tangential_speed"),
    "tangential_speed": ("friction", "normal_speed"),
    "relaxation_time": ("friction", "speed", "angle", "modulus_ratio"),
    "modulus_ratio": ("friction", "speed", "angle", "relaxation_time"),
}
FIRST = '[first]\nradius = "5 mm"\nmaterial = "steel"\n[second]\nkind = "sphere"\n'


def keys_with_flags(command=None, path=()):
    """The keys of a case file for which a command that reads one has a flag, as (command, key)."""
    command = command or get_command(app)
    for name, below in getattr(command, "commands", {}).items():
        yield from keys_with_flags(below, (*path, name))
    names = {option.name for option in command.params}
    if "case" in names:
        yield from ((path, key) for key in VALUES if key in names)


def test_every_key_of_a_case_is_tried():
    assert set(VALUES) == {"friction", *MOTION, *LOSSES, RATIO}


@pytest.mark.first_case
@pytest.mark.parametrize(
    ("path", "key"),
    [pytest.param(*one, id=" ".join((*one[0], one[1]))) for one in keys_with_flags()],
)
def test_a_key_of_the_case_does_what_the_flag_does(run, monkeypatch, path, key):
    """Of every command that has both: whoever has one file for all commands is not sent away."""
    few = partial(carom.verify.tune, [carom.dem.LinearSpring(), carom.dem.HardSphere(0.4)])
    monkeypatch.setattr(carom.verify, "tune", few)
    Path("data.csv").write_text("psi_in,psi_out\n1,-0.2\n2,-0.8\n3,-1.3\n")
    options = {"score": ("data.csv", "--case"), "laws": ("--law", "mindlin", "--case")}
    words = (*options.get(path[-1], ()), "case.toml")
    others = [name for name in WITH.get(key, ("friction", "speed", "angle")) if name != key]
    lines = [f'{name} = "{VALUES[name]}"\n' for name in others]
    Path("case.toml").write_text("".join(lines) + FIRST)
    plain = run(*path, *words, "--json")
    flagged = run(*path, *words, f"--{key.replace('_', '-')}", VALUES[key], "--json")
    Path("case.toml").write_text("".join(lines) + f'{key} = "{VALUES[key]}"\n' + FIRST)
    assert run(*path, *words, "--json") == flagged != plain
    assert flagged[0] in (0, 1)
    assert flagged[1]


def test_a_fit_says_how_a_known_restitution_is_given(refusal):
    """The case of `carom impact` is not that of a fit, which finds the restitution."""
    Path("data.csv").write_text("angle,speed,spin_out\n0.2,1,1\n0.4,1,2\n0.6,1,3\n")
    line = refusal("fit", "data.csv", "--case", "case.toml")
    assert "loss_time" in line
    assert "--fix restitution=0.98" in line


def test_scores_refuse_a_case_whose_losses_depend_on_the_speed(refusal):
    Path("data.csv").write_text("psi_in,psi_out\n1,-0.2\n2,-0.8\n3,-1.3\n")
    line = refusal("verify", "score", "data.csv", "--case", "case.toml")
    assert "losses: KelvinVoigt(restitution=None, loss_time=2e-06) cannot be used" in line
    assert "a restitution that is the same at all speeds" in line


def test_a_case_has_one_loss_or_none():
    assert losses_of({}) is losses_of({"restitution": None}) is None
    assert losses_of({"loss_time": "2 us"}) == carom.KelvinVoigt(loss_time=2e-6)
    assert losses_of({"yield_velocity": " material"}) == carom.ElasticPlastic()
    with pytest.raises(carom.InputError, match="loss_time: give it or restitution, not both"):
        losses_of({"loss_time": 0.0, "restitution": 1.0})
    with pytest.raises(carom.InputError, match=r"restitution: \[0.9\] cannot be used"):
        losses_of({"restitution": [0.9]})


def test_a_sweep_over_restitutions(run, pair):
    """Each point against the library, one that is out of range counted with its reason."""
    Path("case.toml").write_text(CASE.replace('loss_time = "2 us"', "") + SWEEP)
    code, out, _ = run("sweep", "case.toml", "--json", "--output", "sweep.nc")
    record, data = json.loads(out), carom.read("sweep.nc")
    assert code == 0
    assert record["status"] == {"solved": 6, "input out of range": 2}
    assert data.sizes == {"restitution": 4, "friction": 2}
    assert data.restitution.units == "1"
    for e in (0.6, 0.8, 1.0):
        law = carom.KelvinVoigt(restitution=e)
        for mu in (0.1, 0.3):
            bodies = carom.Pair(pair.first, pair.second, friction=mu)
            hit = carom.impact(bodies, speed=2.0, angle="30 deg", losses=law)
            point = data.sel(restitution=e, friction=mu)
            for name in ("normal_restitution", "psi_out", "lost_energy", "max_force"):
                assert float(point[name]) == pytest.approx(getattr(hit, name), rel=1e-10), name
    assert np.isnan(data.psi_out.sel(restitution=1.2)).all()
    span = record["ranges"]["normal_restitution"]
    assert (span["min"], span["max"]) == pytest.approx((0.6, 1.0), abs=1e-8)
    assert record["ranges"]["lost_energy"]["units"] == "J"


def test_a_sweep_of_two_losses_is_refused(refusal):
    Path("case.toml").write_text(CASE + SWEEP)
    assert re.search("give it or (restitution|loss_time), not both", refusal("sweep", "case.toml"))


SOLID = ["--relaxation-time", "20 us", "--modulus-ratio"]


@pytest.mark.parametrize(
    ("flags", "message"),
    [
        (SOLID[:2], "modulus_ratio: missing; give it together with relaxation_time"),
        (
            ["--modulus-ratio", "1.5"],
            "relaxation_time: missing; give it together with modulus_ratio",
        ),
        ([*SOLID, "0.5"], "modulus_ratio: '0.5' cannot be used; must be from 1 to 1000"),
        (
            [*SOLID, "2", "--restitution", "0.9"],
            "relaxation_time: give it or restitution, not both",
        ),
    ],
)
def test_half_a_standard_linear_solid_is_refused(refusal, flags, message):
    assert refusal(*BALL, *SPEED, *flags).startswith(f"carom: {message}")


def test_a_flag_replaces_the_standard_linear_solid_of_a_case(run, pair):
    text = CASE.replace('loss_time = "2 us"', 'relaxation_time = "20 us"\nmodulus_ratio = 1.5')
    Path("solid.toml").write_text(text)
    ended = [run("impact", "solid.toml", *more, "--json") for more in ([], ["--restitution", "1"])]
    laws = carom.StandardLinearSolid(1.5, "20 us"), None
    for (code, out, _), law in zip(ended, laws, strict=True):
        hit = carom.impact(pair, speed=2.0, angle="30 deg", losses=law)
        assert code == 0
        assert json.loads(out)["result"] == hit.scalars()
