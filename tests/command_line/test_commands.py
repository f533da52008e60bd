"""The commands, as a user would type them."""

import json
import re
import subprocess
import sys
from pathlib import Path

import pandas as pd
import pytest
import xarray as xr
from PIL import Image

import carom
from carom.cli.commands import app

BALL = ["impact", "--radius", "5 mm", "--material", "steel", "--friction", "0.2"]
SPEED = ["--speed", "2", "--angle", "30 deg"]
CASE = """\
friction = 0.2
speed = "2 m/s"
angle = "30 deg"

[first]
radius = "5 mm"
material = {young = "210 GPa", poisson = 0.3, density = 7850}

[second]
kind = "sphere"
radius = "1 cm"
"""


def test_impact_as_json_equals_the_library(run, hit):
    code, out, err = run(*BALL, *SPEED, "--json")
    record = json.loads(out)
    assert (code, err) == (0, "")
    assert record["result"] == hit.scalars()
    assert [phase["kind"] for phase in record["phases"]] == [p.kind for p in hit.phases]
    entries = [(phase["slip_angle_max"], phase["slip_angle_mean"]) for phase in record["phases"]]
    assert entries == list(hit.slip_angles)


def test_case_file_and_flags_that_override_it(run):
    Path("case.toml").write_text(CASE)
    code, out, _ = run("impact", "case.toml", "--json")
    assert code == 0
    assert json.loads(out)["inputs"]["second"]["radius"] == 0.01
    assert json.loads(out)["inputs"]["second"]["material"]["young"] == 210e9
    _, out, _ = run("impact", "case.toml", "--friction", "0.5", "--normal-speed", "3", "--json")
    inputs = json.loads(out)["inputs"]
    assert (inputs["friction"], inputs["normal_speed"], inputs["tangential_speed"]) == (0.5, 3.0, 0)


def test_output_files(run):
    for name in ("hit.nc", "hit.csv"):
        code, _, err = run(*BALL, *SPEED, "--output", name)
        assert (code, err) == (0, f"Carom has stored {name}.\n")
    with xr.open_dataset("hit.nc", engine="h5netcdf") as stored:
        assert stored.tangential_force.units == "N"
        assert json.loads(stored.attrs["inputs"])["friction"] == 0.2
    table = pd.read_csv("hit.csv")
    assert table["time [s]"][0] == 0.0
    assert len(table) == 400
    assert {path.name for path in Path().iterdir()} == {"hit.nc", "hit.csv"}


def test_animation(run, refusal, monkeypatch):
    monkeypatch.setattr("carom.cli.impact.ANIMATION_FRAMES", 3)
    code, _, err = run(*BALL, *SPEED, "--animate", "hit.gif")
    assert code == 0
    assert "Carom has stored hit.gif." in err
    with Image.open("hit.gif") as film:
        assert film.n_frames == 3
    monkeypatch.setenv("PATH", "")
    err = refusal(*BALL, *SPEED, "--animate", "hit.mp4", "--plot", "hit.png")
    assert "ffmpeg is not found; install it, or use .gif" in err
    assert [path.name for path in Path().iterdir()] == ["hit.gif"]


def test_curve(run):
    code, out, _ = run("curve", "--chi", "1.44", "--chi", "0.3")
    assert code == 0
    assert "gross slip throughout" in out
    code, out, _ = run("curve", "--chi", "1.44", "--to", "6", "--points", "7", "--json")
    (record,) = json.loads(out)
    assert record["psi_out"] == [carom.rebound(psi, 1.44) for psi in record["psi_in"]]
    assert list(record["borders"].values()) == pytest.approx([1.0, 2.88, 4.76])
    code, _, _ = run("curve", "--chi", "1.44", "--output", "curve.csv", "--plot", "curve.svg")
    assert code == 0
    assert Path("curve.svg").stat().st_size > 1000


def test_materials(run):
    code, out, _ = run("materials")
    assert code == 0
    assert "soda-lime-glass" in out
    code, out, _ = run("materials", "steel", "--json")
    assert json.loads(out)["steel"]["young"] == 210e9
    assert "EN 1993" in run("materials", "steel")[1]
    listed = run("materials", "--pairs")[1].splitlines()
    assert listed[1].split()[-5:] == ["0.092", "(0.006)", "0.44", "(0.07)", "[1]"]
    pairs = json.loads(run("materials", "--pairs", "--json")[1])
    assert pairs[0]["friction"] == 0.092
    assert pairs[-1]["density"] is None


BAD = [
    (["impact"], "friction: missing"),
    (["impact", "--friction", "0.1"], "radius: missing for the first body; give --radius"),
    ([*BALL[:-2], "--friction", "-1", "--speed", "1"], "friction: '-1'"),
    ([*BALL, "--speed", "0"], "speed: '0' cannot be used; must be positive"),
    ([*BALL, "--normal-speed", "-2"], "normal_speed: '-2' .*must approach"),
    ([*BALL, "--speed", "2", "--angle", "90 deg"], "angle: '90 deg' .*must approach"),
    ([*BALL, "--speed", "2", "--angle", "45"], "angle: '45' .*write '45 deg'"),
    (["impact", "--radius", "5 kg", *BALL[3:], *SPEED], "radius: '5 kg' .*value in m;.*'5 mm'"),
    ([*BALL, "--speed", "1,5 m/s"], "speed: '1,5 m/s' .*point, not a comma"),
    ([*BALL, *SPEED, "--second-material", "stel"], "material: 'stel' .*did you mean 'steel'"),
    ([*BALL, *SPEED, "--against", "cone"], "kind: 'cone' .*half-space, sphere, cup, body"),
    ([*BALL, *SPEED, "--output", "x.xls"], "output file: 'x.xls' .*.nc or .csv"),
    ([*BALL, *SPEED, "--plot", "no/such/x.png"], "output file: .*folder must exist"),
    ([*BALL, *SPEED, "--output", "/proc/x.csv"], "output file: .*cannot be written"),
    ([*BALL, *SPEED, "--colour", "red"], "No such option: --colour"),
    ([*BALL, *SPEED, "--materal", "x"], "No such option: --materal; did you mean '--material' or"),
    (["impact", "missing.toml"], "case file: 'missing.toml' cannot be read"),
    (["curve", "--chi", "-1"], "chi: '-1' cannot be used"),
    (["curve", "--chi", "1", "--from", "2", "--to", "1"], "to: 1.0 cannot be used"),
    (["curve", "--chi", "1", "--from", "nan"], "from: 'nan' cannot be used"),
    (["curve", "--chi", "1", "--to", "abc"], "to: 'abc' cannot be used"),
    (["curve", "--chi", "1", "--points", "0"], "points: '0' cannot be used; must be a whole"),
    (["materials", "stone"], "material: 'stone'"),
    (["materials", "steel", "--pairs"], "--pairs: 'steel' cannot be used; it lists all pairs"),
    (["frobnicate"], "No such command"),
]


@pytest.mark.parametrize(("arguments", "message"), BAD)
def test_bad_input_gets_one_clear_line(refusal, arguments, message):
    assert re.search(message, refusal(*arguments))


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("friction = 0.2\nsped = 3\n", "sped: unknown key in .*, line 2; did you mean 'speed'"),
        ("[first]\nradius = 1\n\n[second]\nshape = 'cup'\n", "shape: unknown key in .*, line 5"),
        ("[first]\nradius=1\n[second]\nradius=1\n[output]\nradius=3\n", "radius: .*line 6"),
        (CASE + "[output]\nplot = 3\n", "plot: 3 cannot be used; must be the name of a file"),
        (CASE.replace("sphere", "half-space") + "inner_radius = 1\n", "inner_radius: 1 .*has none"),
        (CASE.replace("1 cm", "1,250 mm"), "radius: '1,250 mm' .*point, not a comma"),
        ("friction = = 3\n", "is not TOML; .*line 1"),
        ("first = 3\n", "first: 3 cannot be used; must be a table"),
        ("friction = 0.1\nspeed=1\n[first]\nradius=1\nmaterial={yung=1}\n", "yung: .*line 5"),
    ],
)
def test_bad_case_files(refusal, text, message):
    Path("case.toml").write_text(text)
    assert re.search(message, refusal("impact", "case.toml"))


def test_python_runs_the_commands_too():
    done = subprocess.run([sys.executable, "-m", "carom", "--version"], capture_output=True)
    assert done.stdout.decode().strip() == carom.__version__


@pytest.mark.slow
def test_start_up_loads_nothing_that_is_not_needed():
    """Of what takes long: nothing until something is computed, and little for an impact."""
    steps = ["import carom", "from carom.cli import main; main(['--help'])"]
    steps += [f"main({[*BALL, *SPEED]!r})"]
    slow = ["numpy", "numba", "scipy", "xarray", "pint", "matplotlib", "pandas", "rich", "pydantic"]
    told = f"; import sys; print('loaded', *[name for name in {slow!r} if name in sys.modules])\n"
    command = [sys.executable, "-c", "".join(step + told for step in steps)]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    lines = [line.split()[1:] for line in done.stdout.splitlines() if line.startswith("loaded")]
    assert lines[:2] == [[], []]
    assert not {"xarray", "pint", "matplotlib", "pandas", "rich", "pydantic"} & set(lines[2])


def commands(of=app, path=""):
    """Yield all commands, and those of groups, as they are typed."""
    for command in of.registered_commands:
        yield f"{path}{command.name}"
    for group in of.registered_groups:
        name = f"{path}{group.name or group.typer_instance.info.name}"
        yield name
        yield from commands(group.typer_instance, f"{name} ")


def test_all_commands_are_found():
    text = "impact curve fit track sweep explore materials verify"
    of_verify = "laws lammps liggghts yade pack score tune"
    names = {command.split()[-1] for command in commands()}
    assert names == {*text.split(), *of_verify.split(), "build", "examples"}


@pytest.mark.parametrize("command", list(commands()))
def test_help_shows_an_example(run, command):
    code, out, _ = run(*command.split(), "--help")
    assert code == 0
    assert f"Example: carom {command}" in out


@pytest.mark.parametrize("chi", ["1e6", "1e20", "1e300"])
@pytest.mark.parametrize("form", [[], ["--json"]])
def test_a_curve_that_is_hardly_solved_is_a_failure(chi, form, run):
    """All impacts but that which slides throughout; what there is is printed all the same."""
    with pytest.warns(RuntimeWarning, match="400 of 401 impacts give NaN"):
        code, out, err = run("curve", "--chi", chi, *form)
    assert (code, bool(out)) == (1, True)
    assert err == "carom: 1 of 401 points are solved, the others are NaN; give other values\n"


def test_a_sweep_of_which_nothing_is_solved_is_a_failure(run):
    Path("case.toml").write_text(
        "friction = 0.2\nspeed = 2\n[first]\nradius = '5 mm'\nmaterial = 'steel'\n"
        "gyration_radius = '1e-6 mm'\n[sweep.axes]\nangle = [0.1, 0.2, 0.3]\n"
    )
    code, out, err = run("sweep", "case.toml")
    assert code == 1
    assert "not solved as" in out
    assert err.splitlines()[-1].startswith("carom: 0 of 3 points are solved")


def test_inputs_for_lammps_are_written_whole_into_a_new_folder(run):
    code, out, _ = run("lammps", "examples", "inputs", "--json")
    names = sorted(path.name for path in Path("inputs").iterdir())
    assert (code, json.loads(out)) == (0, {"folder": "inputs", "files": names})
    subjects = ("drum", "heap", "hopper", "impact", "settling", "shear")
    assert names == [f"in.{subject}" for subject in subjects]
    assert all("pair_style" in Path("inputs", name).read_text() for name in names)
    code, _, err = run("lammps", "examples", "inputs")
    assert code == 2
    assert err == "carom: folder: 'inputs' cannot be used; it is not empty; give a new folder\n"
    assert "lmp -in new/in.impact" in run("lammps", "examples", "new")[1]
