"""`carom impact` with boundary elements, spectra and peaks, as a user would type it."""

import json
from pathlib import Path

import pandas as pd
import pytest
from tests import checks

import carom

BALL = ["impact", "--radius", "5 mm", "--material", "steel", "--friction", "0.2"]
SPEED = ["--speed", "2", "--angle", "30 deg"]
CASE = f'{checks.CASE}[output]\nspectrum = "forces.nc"\n'


def test_the_file_is_the_spectrum_of_the_library(run, hit):
    files = ["--output", "hit.csv", "--spectrum", "forces.csv"]
    code, out, err = run(*BALL, *SPEED, *files, "--json")
    assert (code, err) == (0, "Carom has stored hit.csv.\nCarom has stored forces.csv.\n")
    assert "result" in json.loads(out)
    table = pd.read_csv("forces.csv")
    assert list(table.columns[:2]) == ["frequency [Hz]", "normal_spectrum [N s]"]
    expected = hit.spectrum().normal_spectrum.values
    assert table["normal_spectrum [N s]"].values == pytest.approx(expected)
    assert len(table) == 601


def test_a_case_file_asks_for_it(run, hit):
    Path("case.toml").write_text(CASE, encoding="utf-8")
    code, _, err = run("impact", "case.toml")
    assert (code, err) == (0, "Carom has stored forces.nc.\n")
    assert carom.read("forces.nc").identical(hit.spectrum())
    code, _, err = run("impact", "case.toml", "--spectrum", "other.csv")
    assert (code, err) == (0, "Carom has stored other.csv.\n")


@pytest.mark.parametrize(
    ("flags", "said"),
    [
        (["--spectrum", "forces.txt"], "output file: 'forces.txt' cannot be used; must end in .nc"),
        (["--spectrum", "no/forces.csv"], "output file: 'no/forces.csv' cannot be used"),
        (["--spectrum", ""], "output file: '' cannot be used"),
        (
            ["--spectrum", "a.csv", "--output", "a.csv"],
            "spectrum: 'a.csv' cannot be used; this file",
        ),
    ],
)
def test_bad_names_take_one_line(refusal, flags, said):
    assert refusal(*BALL, *SPEED, *flags).startswith(f"carom: {said}")
    assert list(Path().iterdir()) == []


def test_a_sweep_computes_none(refusal):
    sweep = CASE.replace('angle = "30 deg"\n', "") + '[sweep.axes]\nangle = ["10 deg", "40 deg"]\n'
    Path("case.toml").write_text(sweep, encoding="utf-8")
    allowed = "carom sweep computes none, carom impact does; leave it out"
    assert f"spectrum: 'forces.nc' cannot be used; {allowed}" in refusal("sweep", "case.toml")


GLASS_BALL = [word.replace("steel", "glass") for word in BALL]
COARSE = ["--method", "halfspace", "--elements", "10", "--steps", "30"]


def test_json_is_the_impact_of_the_library(run):
    code, out, err = run(*GLASS_BALL, *SPEED, *COARSE, "--json")
    record = json.loads(out)
    ball = carom.Sphere(radius="5 mm", material="glass")
    pair = carom.Pair(ball, carom.HalfSpace(material="glass"), friction=0.2)
    grid = carom.BoundaryElements(elements=10, steps=30)
    hit = carom.impact(pair, speed=2.0, angle="30 deg", method=grid)
    assert (code, err) == (0, "")
    assert record["result"]["psi_out"] == hit.psi_out
    assert record["result"]["psi_out_error"] == hit.psi_out_error
    assert record["inputs"]["method"] == "halfspace"
    assert record["phases"][0]["slip_angle_mean"] == hit.slip_angles[0].mean


@pytest.mark.slow
def test_the_table_tells_the_error_and_files_are_stored(run, tmp_path):
    files = ["--plot", "hit.png", "--output", "hit.nc"]
    code, out, err = run(*GLASS_BALL, *SPEED, *COARSE, *files)
    assert code == 0
    assert "error of the rebound by grid and time steps" in out
    assert "energy lost in the normal motion" not in out, "like materials lose none"
    assert (tmp_path / "hit.png").stat().st_size > 20_000
    assert carom.read(tmp_path / "hit.nc").slip_angle.dims == ("time",)
    assert err.splitlines() == ["Carom has stored hit.nc.", "Carom has stored hit.png."]


@pytest.mark.slow
def test_unlike_materials_show_what_the_normal_motion_loses(run):
    code, out, _ = run(*GLASS_BALL, *SPEED, *COARSE, "--second-material", "steel")
    assert code == 0
    assert "energy lost in the normal motion" in out


@pytest.mark.slow
def test_spin_about_the_normal(run):
    """It slows down, and the table says to what."""
    code, out, _ = run(*GLASS_BALL, *SPEED, *COARSE, "--normal-spin", "3000 rpm", "--json")
    record = json.loads(out)
    assert code == 0
    before, after = record["inputs"]["normal_spin"], record["result"]["normal_spin_out"]
    assert before == pytest.approx(100.0 * 3.141592653589793)
    assert 0.9 * before < after < before
    code, out, _ = run(*GLASS_BALL, *SPEED, *COARSE, "--normal-spin", "3000 rpm")
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
    assert refusal(*GLASS_BALL, *SPEED, *flags).startswith(f"carom: {said}")


ROOT = Path(__file__).parents[2]
BEARING = [word.replace("steel", "bearing steel") for word in BALL]
GLASS = ["--second-material", "name=float glass, flaw_size=20 um"]
HIT = [*BEARING, *GLASS, "--speed", "0.3", "--angle", "30 deg"]


def same_impact():
    glass = carom.material("float glass", flaw_size="20 um")
    ball = carom.Sphere(radius="5 mm", material="bearing steel")
    pair = carom.Pair(ball, carom.HalfSpace(material=glass), friction=0.2)
    return carom.impact(pair, speed=0.3, angle="30 deg")


def test_peaks_are_told_in_words(run):
    """Of both bodies, in units to read, with what is not known and what is left out."""
    code, output, _ = run(*HIT, "--peaks")
    assert code == 0
    peaks = same_impact().peaks()
    first, second = output.split("Largest stresses in the first body")[1].split(
        "Largest stresses in the second body"
    )
    for text, body in ((first, "first"), (second, "second")):
        value = float(peaks.peak_von_mises.sel(body=body)) / 1e6
        assert f"largest von Mises stress of the impact   {value:.4g} MPa" in text
    assert "MPa m^0.5" in second
    assert "radial tractions of unlike materials, which the theory neglects" in second
    assert "not known of the first body: tensile_strength" in second


def test_peaks_as_json(run):
    actual = json.loads(run(*HIT, "--peaks", "--json")[1])["peaks"]
    peaks = same_impact().peaks()
    for body in ("first", "second"):
        for name in ("peak_shear", "peak_tension_time", "yield_ratio", "toughness_ratio"):
            value = float(peaks[name].sel(body=body))
            answer = actual[body][name]
            assert answer is None if value != value else answer == pytest.approx(value, rel=1e-12)
    assert "peaks" not in json.loads(run(*HIT, "--json")[1])


def test_boundary_elements_have_no_peaks(refusal):
    coarse = "--method", "halfspace", "--elements", "8", "--steps", "20"
    words = "peaks: boundary elements give no stress below the surface; leave --method out"
    assert words in refusal(*HIT, "--peaks", *coarse)


def test_quantities_of_a_sweep(run, refusal):
    """They take the place of the outputs of the file."""
    whole = (ROOT / "examples/sweep.toml").read_text(encoding="utf-8")
    Path("few.toml").write_text(whole.replace("points = 86", "points = 5"), encoding="utf-8")
    small = ["sweep", "few.toml", "--json", "--no-progress"]
    record = json.loads(run(*small, "--quantities", "yield_speed_second,rebound_angle")[1])
    assert list(record["ranges"]) == ["yield_speed_second", "rebound_angle"]
    low = record["ranges"]["yield_speed_second"]["min"]
    ball = carom.Sphere(radius="5 mm", material="bearing-steel")
    pair = carom.Pair(ball, carom.HalfSpace(material="bearing-steel"), friction=0.3)
    speeds = carom.bearable_speeds(pair, angle=[0.0], friction=[0.05]).yield_speed_second
    assert low <= float(speeds[0, 0]) * (1.0 + 1e-9)
    for wrong, words in (("foo", "no result is so"), ("crack_speed_second", "missing for the")):
        assert words in refusal(*small, "--quantities", wrong)
