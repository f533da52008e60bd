"""`carom impact --spectrum`, as a user would type it."""

import json
from pathlib import Path

import pandas as pd
import pytest

import carom
from carom.cli import main

BALL = ["impact", "--radius", "5 mm", "--material", "steel", "--friction", "0.2"]
SPEED = ["--speed", "2", "--angle", "30 deg"]
CASE = """\
friction = 0.2
speed = "2 m/s"
angle = "30 deg"

[first]
radius = "5 mm"
material = "steel"

[output]
spectrum = "forces.nc"
"""


@pytest.fixture
def run(capsys, monkeypatch, tmp_path):
    monkeypatch.chdir(tmp_path)

    def call(*arguments):
        code = main(list(arguments))
        caught = capsys.readouterr()
        return code, caught.out, caught.err

    return call


def expected():
    ball = carom.Sphere(radius="5 mm", material="steel")
    pair = carom.Pair(ball, carom.HalfSpace(material="steel"), friction=0.2)
    return carom.impact(pair, speed=2.0, angle="30 deg").spectrum()


def test_the_file_is_the_spectrum_of_the_library(run):
    code, out, err = run(*BALL, *SPEED, "--spectrum", "forces.csv", "--json")
    assert (code, err) == (0, "Carom has stored forces.csv.\n")
    assert "result" in json.loads(out)
    table = pd.read_csv("forces.csv")
    assert list(table.columns[:2]) == ["frequency [Hz]", "normal_spectrum [N s]"]
    assert table["normal_spectrum [N s]"].values == pytest.approx(expected().normal_spectrum.values)
    assert len(table) == 601


def test_beside_the_history(run):
    code, _, err = run(*BALL, *SPEED, "--output", "hit.nc", "--spectrum", "forces.nc")
    assert (code, err) == (0, "Carom has stored hit.nc.\nCarom has stored forces.nc.\n")
    assert "time" in carom.read("hit.nc").dims
    assert "frequency" in carom.read("forces.nc").dims


def test_a_case_file_asks_for_it(run):
    Path("case.toml").write_text(CASE, encoding="utf-8")
    code, _, err = run("impact", "case.toml")
    assert (code, err) == (0, "Carom has stored forces.nc.\n")
    assert carom.read("forces.nc").identical(expected())
    code, _, err = run("impact", "case.toml", "--spectrum", "other.csv")
    assert (code, err) == (0, "Carom has stored other.csv.\n")


@pytest.mark.parametrize(
    "more", [["--yield-velocity", "0.1 m/s"], ["--restitution", "0.9"], ["--friction", "0"]]
)
def test_of_impacts_of_other_kinds(run, more):
    without = BALL[:-2] if "--friction" in more else BALL
    code, _, err = run(*without, *SPEED, *more, "--spectrum", "forces.nc")
    assert (code, err) == (0, "Carom has stored forces.nc.\n")
    found = carom.read("forces.nc")
    assert float(found.normal_spectrum[0]) == pytest.approx(float(found.normal_impulse), rel=1e-5)


@pytest.mark.parametrize(
    ("flags", "said"),
    [
        (["--spectrum", "forces.txt"], "output file: 'forces.txt' cannot be used; must end in .nc"),
        (["--spectrum", "no/forces.csv"], "output file: 'no/forces.csv' cannot be used"),
        (["--spectrum", ""], "output file: '' cannot be used"),
        (
            ["--spectrum", "a.csv", "--output", "a.csv"],
            "spectrum: 'a.csv' cannot be used; this file is also that of output",
        ),
    ],
)
def test_bad_names_take_one_line(run, flags, said):
    code, out, err = run(*BALL, *SPEED, *flags)
    assert (code, out) == (2, "")
    assert err.startswith(f"carom: {said}")
    assert len(err.splitlines()) == 1
    assert list(Path().iterdir()) == []


def test_a_sweep_computes_none(run):
    sweep = CASE.replace('angle = "30 deg"\n', "") + '[sweep.axes]\nangle = ["10 deg", "40 deg"]\n'
    Path("case.toml").write_text(sweep, encoding="utf-8")
    code, _, err = run("sweep", "case.toml")
    assert code == 2
    allowed = "carom sweep computes none, carom impact does; leave it out"
    assert f"spectrum: 'forces.nc' cannot be used; {allowed}" in err
