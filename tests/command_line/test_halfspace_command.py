"""`carom impact --method halfspace`, as a user would type it."""

import json

import pytest

import carom

BALL = ["impact", "--radius", "5 mm", "--material", "glass", "--friction", "0.2"]
MOTION = ["--speed", "2", "--angle", "30 deg"]
COARSE = ["--method", "halfspace", "--elements", "10", "--steps", "30"]


def test_json_is_the_impact_of_the_library(run):
    code, out, err = run(*BALL, *MOTION, *COARSE, "--json")
    told = json.loads(out)
    ball = carom.Sphere(radius="5 mm", material="glass")
    pair = carom.Pair(ball, carom.HalfSpace(material="glass"), friction=0.2)
    grid = carom.BoundaryElements(elements=10, steps=30)
    hit = carom.impact(pair, speed=2.0, angle="30 deg", method=grid)
    assert (code, err) == (0, "")
    assert told["result"]["psi_out"] == hit.psi_out
    assert told["result"]["psi_out_error"] == hit.psi_out_error
    assert told["inputs"]["method"] == "halfspace"
    assert told["phases"][0]["slip_angle_mean"] == hit.slip_angles[0].mean


def test_the_table_tells_the_error_and_files_are_stored(run, tmp_path):
    files = ["--plot", "hit.png", "--output", "hit.nc"]
    code, out, err = run(*BALL, *MOTION, *COARSE, *files)
    assert code == 0
    assert "error of the rebound by grid and time steps" in out
    assert "energy lost in the normal motion" not in out, "like materials lose none"
    assert (tmp_path / "hit.png").stat().st_size > 20_000
    assert carom.read(tmp_path / "hit.nc").slip_angle.dims == ("time",)
    assert err.splitlines() == ["Carom has stored hit.nc.", "Carom has stored hit.png."]


def test_unlike_materials_show_what_the_normal_motion_loses(run):
    code, out, _ = run(*BALL, *MOTION, *COARSE, "--second-material", "steel")
    assert code == 0
    assert "energy lost in the normal motion" in out


def test_spin_about_the_normal(run):
    """It slows down, and the table says to what."""
    code, out, _ = run(*BALL, *MOTION, *COARSE, "--normal-spin", "3000 rpm", "--json")
    told = json.loads(out)
    assert code == 0
    before, after = told["inputs"]["normal_spin"], told["result"]["normal_spin_out"]
    assert before == pytest.approx(100.0 * 3.141592653589793)
    assert 0.9 * before < after < before
    code, out, _ = run(*BALL, *MOTION, *COARSE, "--normal-spin", "3000 rpm")
    assert "spin about the line of impact after" in out


@pytest.mark.parametrize(
    ("flags", "said"),
    [
        (["--method", "fem"], "method: 'fem' cannot be used; must be exact or halfspace"),
        (["--elements", "32"], "elements: 32 cannot be used; it is an option of boundary elements"),
        (["--method", "halfspace", "--steps", "5"], "steps: '5' cannot be used; must be a"),
        ([*COARSE, "--restitution", "0.9"], "losses: KelvinVoigt(restitution=0.9"),
    ],
)
def test_what_cannot_be_solved_takes_one_line(refusal, flags, said):
    assert refusal(*BALL, *MOTION, *flags).startswith(f"carom: {said}")
