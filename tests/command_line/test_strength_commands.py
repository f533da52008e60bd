"""`carom impact --peaks` and `carom sweep --quantities`: what an impact does to its bodies."""

import json
from pathlib import Path

import pytest

import carom
from carom.cli import main

ROOT = Path(__file__).parents[2]
BALL = ["impact", "--radius", "5 mm", "--material", "bearing steel", "--friction", "0.2"]
GLASS = ["--second-material", "name=float glass, flaw_size=20 um"]
HIT = [*BALL, *GLASS, "--speed", "0.3", "--angle", "30 deg"]


@pytest.fixture
def run(capsys):
    def call(*arguments):
        code = main([str(each) for each in arguments])
        caught = capsys.readouterr()
        return code, caught.out, caught.err

    return call


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
    found = json.loads(run(*HIT, "--peaks", "--json")[1])["peaks"]
    peaks = same_impact().peaks()
    for body in ("first", "second"):
        for name in ("peak_shear", "peak_tension_time", "yield_ratio", "toughness_ratio"):
            known = float(peaks[name].sel(body=body))
            told = found[body][name]
            assert told is None if known != known else told == pytest.approx(known, rel=1e-12)
    assert "peaks" not in json.loads(run(*HIT, "--json")[1])


def test_boundary_elements_have_no_peaks(run):
    coarse = "--method", "halfspace", "--elements", "8", "--steps", "20"
    code, _, error = run(*HIT, "--peaks", *coarse)
    assert code == 2
    assert "peaks: boundary elements give no stress below the surface; leave --method out" in error


def test_quantities_of_a_sweep(run):
    """They take the place of the outputs of the file."""
    case = ROOT / "examples/sweep.toml"
    small = ["sweep", case, "--json", "--no-progress"]
    found = json.loads(run(*small, "--quantities", "yield_speed_second,rebound_angle")[1])
    assert list(found["ranges"]) == ["yield_speed_second", "rebound_angle"]
    low = found["ranges"]["yield_speed_second"]["min"]
    ball = carom.Sphere(radius="5 mm", material="bearing-steel")
    pair = carom.Pair(ball, carom.HalfSpace(material="bearing-steel"), friction=0.3)
    speeds = carom.bearable_speeds(pair, angle=[0.0], friction=[0.05]).yield_speed_second
    assert low <= float(speeds[0, 0]) * (1.0 + 1e-9)
    for wrong, words in (("foo", "is not a result"), ("crack_speed_second", "missing for the")):
        code, _, error = run(*small, "--quantities", wrong)
        assert code == 2
        assert words in error
