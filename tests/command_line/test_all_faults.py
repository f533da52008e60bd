"""All faults of a command line are told in one message, and nothing is done before."""

import re
from pathlib import Path

import pytest
from tests.checks import CASE
from tests.command_line.test_options import COMMANDS


def heads(line):
    """Return what a message says something of: one name for each of its faults."""
    assert line.startswith("carom: ")
    count = re.match(r"carom: (\d+) faults: ", line)
    if count is None:
        return [re.match(r"carom: (No such option: \S+?|[^:]+)[:;]", line)[1]]
    told = re.findall(r"\(\d+\) (No such option: [^;]+|Option '[^']+'|[^:;]+)", line)
    assert len(told) == int(count[1]), line
    return told


TABLE = r"""
impact
  : friction, radius, material, speed
impact --radius 5mm
  : friction, material, speed
impact --radius 5mm --friction -1 --speed x
  : friction, speed, material
impact --radius -1 --material stel --second-material tin --friction x --speed 0 --angle 95deg \
      --spin y
  : friction, speed, angle, spin, radius, material, material
impact case.toml --spin2 1 --plot a.txt --steps x
  : spin2, output file, steps, steps
impact --speed 1 --normal-speed 1 --restitution 0.9 --loss-time x
  : loss_time, loss_time, speed, friction, radius, material
impact --against cup --thickness 1 --width 2 --second-radius z --gyration-radius 1 \
      --inner-radius 2
  : friction, radius, material, radius, thickness, width, speed
impact case.toml --inner-radius 2 --gyration-radius 1 --speed x
  : sphere, speed
impact none.toml --friction -1 --method fem --elements x --steps 1
  : case file, friction, method, elements, steps
impact --plot a.txt --output a.png --spectrum a.png --animate a.png
  : output file, output file, spectrum, output file, friction, radius, material, speed
impact case.toml --colour red --json --json x --friction
  : No such option: --colour, --json, x, --friction
impact --speed
  : --speed, friction, radius, material
impact case.toml --material --frction --angle 95deg --steps
  : --material, No such option: --frction, --friction, angle, --steps
impact case.toml --frction -1 --jsn
  : No such option: --frction, No such option: --jsn, friction
impact --case case.toml --speed 2 m/s --angle x deg
  : No such option: --case, --speed, --angle, angle
impact case.toml --speed --angle deg
  : --speed, angle
impact case.toml --material brass --material2 glass --angle 95deg
  : No such option: --material2, angle
curve
  : chi
curve --points 0 --chi
  : --chi, points
curve --from x --to y --points 0
  : chi, from, to, points
curve --chi x --chi -1 --restitution 2 --inelasticity 9 --plot a.txt
  : chi, chi, inelasticity, restitution, inelasticity, output file
curve --chi 1 --export d --json --plot a.png --output a.csv
  : export, --json, --plot, output file
curve --chi 1 --from 3 --to 2 --points 0
  : points, to
sweep
  : case
sweep none.toml --workers 0 --output a.txt --decimal x
  : workers, decimal, case file, output file
sweep case.toml --workers 0 --output a.txt
  : workers, output file, sweep
fit --steps x --seed -1 --advice 0 --fix x --confidence 2
  : data, advice, steps, seed, fix, confidence
fit none.csv --for mu --plot a.txt --decimal x --share mu
  : for, output file, decimal, share
fit none.csv --confidence 3 --fix x --case none.toml
  : results, confidence, fix, case file
fit none.csv case.toml --share mu --advice 3 --case none.toml
  : advice, none.csv, none.csv, case.toml, case.toml
fit --dataset kharaz2001 --vary e --confidence 3 --steps x
  : steps, confidence, vary
fit none.csv none.csv
  : data
fit --template x.csv --moon
  : No such option: --moon, template
track
  : data
track --frame-rate x --pixels-per-mm 0 --pixels-per-diameter y --plate-angle 95deg --gravity z \
      --output a.txt
  : data, output file, plate_angle, gravity, pixels_per_mm, pixels_per_diameter, \
      pixels_per_mm, radius, frame_rate
materials stone --pairs
  : --pairs, material
explore --port x --export none/there
  : port, folder
verify laws --psi x --psi y --kappa 0 --law z --chi -1 --restitution 2 --plot a.txt
  : output file, psi_in, psi_in, law, kappa, chi, restitution
verify laws --map a.png --kappa 1
  : map, map
verify yade --steps 1 --time-limit 0 --law z --output a.txt --case none.toml
  : steps, time_limit, law, output file, case file
verify lammps --output a.csv --steps x
  : steps, output
verify score --tolerance 0 --decimal x --case none.toml
  : results, tolerance, decimal, case file
verify score none.csv --tolerance 0 --case none.toml
  : results, tolerance, case file
verify tune --kappa x --from y --restitution 0.5 --measure z
  : measure, restitution, kappa, psi_in, case
verify tune case.toml --chi 1 --kappa 1 --from 95deg --to x --restitution 2
  : chi, kappa, restitution, angle, angle
verify pack
  : folder
lammps build --sizes small --include none --moon
  : No such option: --moon, sizes, include
lammps examples none/there --moon
  : No such option: --moon, folder
verify tune case.toml --chi= --measure x
  : chi, measure
lammps build --folder= --sizes x
  : folder, sizes
liggghts build --source none --folder=
  : folder
liggghts build --folder --source
  : --folder, --source
liggghts build --moon --sun=2
  : No such option: --moon, No such option: --sun, source
"""  # a line, and what its faults are told of
LINES = dict(re.findall(r"^(\S.*)\n  : (.*)$", re.sub(r"\\\n +", "", TABLE), re.MULTILINE))


@pytest.mark.parametrize("line", LINES)
def test_all_faults_are_in_one_message(line, refusal):
    Path("case.toml").write_text(CASE)
    told = heads(refusal(*line.split()))
    assert sorted(told) == sorted(LINES[line].split(", ")), told
    assert [path.name for path in Path().iterdir()] == ["case.toml"]


@pytest.mark.parametrize("words", COMMANDS, ids=" ".join)
def test_every_command_looks_at_all_words_first(words, refusal):
    """Options that no command has, whatever else is there."""
    told = heads(refusal(*words, "--moon", "full", "--sun=1"))
    assert told[:2] == ["No such option: --moon", "No such option: --sun"]
    assert not list(Path().iterdir())


@pytest.mark.parametrize("words", COMMANDS, ids=" ".join)
@pytest.mark.parametrize("option", ["--help", "-h"])
def test_help_comes_whatever_else_is_wrong(option, words, run):
    code, out, err = run(*words, "--moon", option)
    assert (code, err) == (0, "")
    assert out.startswith(f"Usage: carom {' '.join(words)} ")
    assert "str>" not in out  # a type of Python


@pytest.mark.parametrize(
    ("line", "told"),
    [
        ("impact case.toml --angle 30 deg", "--angle: write '30 deg' in quotes"),
        ("impact --case case.toml", "No such option: --case; give FILE alone"),
        ("materials --name steel", "No such option: --name; give name alone"),
        (
            "sweep case.toml case.toml",
            "case.toml: not expected; see carom sweep --help for the files that it takes",
        ),
    ],
)
def test_typical_slips_are_told_with_what_is_right(line, told, refusal):
    Path("case.toml").write_text(CASE)
    assert told in refusal(*line.split())


def test_a_file_may_have_the_name_of_a_unit(run):
    Path("mm").write_text(CASE)
    assert run("impact", "--speed", "2", "mm")[0] == 0


def test_a_misspelt_option_stands_for_the_one_that_is_meant(refusal):
    """What it gives is not missing, and is looked at."""
    line = "impact --radius 5mm --materal stel --friction 0.2 --velocity x"
    assert heads(refusal(*line.split())) == [
        "No such option: --materal",
        "No such option: --velocity",
        "speed",
        "material",
    ]
