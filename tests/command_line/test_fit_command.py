"""`carom fit`: what it prints and stores, exit codes, and one clear line for bad input."""

import json

import numpy as np
import pytest

import carom
from carom.cli import main

CASE = """
[first]
radius = "2.5 mm"
material = "steel"
"""
DEGREES = (4.0, 9.0, 14.0, 19.0, 24.0, 29.0, 34.0, 45.0, 60.0)
MU = 0.12


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch, table):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "ball.toml").write_text(CASE)
    (tmp_path / "data.csv").write_text(table)


@pytest.fixture(scope="module")
def table():
    ball = carom.Sphere(radius="2.5 mm", material="steel")
    pair = carom.Pair(ball, carom.HalfSpace(material="steel"), friction=MU)
    noise = np.random.default_rng(9).normal(0.0, 0.01, len(DEGREES))
    lines = ["angle [deg],tangential_restitution,tangential_restitution_error"]
    for degrees, error in zip(DEGREES, noise, strict=True):
        hit = carom.impact(pair, speed=2.0, angle=f"{degrees} deg")
        lines.append(f"{degrees},{hit.tangential_restitution + error},0.01")
    return "\n".join(lines) + "\n"


def run(capsys, *arguments):
    code = main(["fit", *arguments])
    shown = capsys.readouterr()
    return code, shown.out, shown.err


def test_table_of_a_file_with_a_case(capsys):
    code, out, _ = run(capsys, "data.csv", "--case", "ball.toml", "--fix", "restitution=1")
    assert code == 0
    value = float(out.split("friction")[1].split()[0])
    assert value == pytest.approx(MU, rel=0.1)
    assert "restitution    1, not varied" in out
    assert "rows by regime: 1 stick from the first touch; " in out


def test_json_and_advice(capsys):
    given = ("data.csv", "--case", "ball.toml", "--fix", "restitution=1", "--json")
    code, out, _ = run(capsys, *given, "--advice", "3", "--for", "friction")
    record = json.loads(out)
    assert code == 0
    low, high = (record["parameters"]["friction"][end] for end in ("low", "high"))
    assert low < MU < high
    assert record["advice"]["parameter"] == "friction"
    assert len(record["advice"]["places"]) == 3


def test_shipped_data(capsys):
    code, out, _ = run(capsys, "--dataset", "kharaz2001", "--fix", "restitution=0.98")
    assert code == 0
    assert "24 values" in out


def test_files_are_stored(capsys, tmp_path):
    files = ("--plot", "fit.png", "--output", "fit.nc", "--posterior", "samples.nc")
    given = ("data.csv", "--case", "ball.toml", "--fix", "restitution=1", "--steps", "100")
    code, _, err = run(capsys, *given, *files)
    assert code == 0
    assert {"fit.png", "fit.nc", "samples.nc"} <= {path.name for path in tmp_path.iterdir()}
    assert "The chain is short" in err
    samples = carom.read("samples.nc")
    assert samples.sizes["sample"] == 75 * 16  # steps kept, walkers
    code, _, _ = run(capsys, *given, "--posterior", "corner.png")
    assert code == 0
    assert (tmp_path / "corner.png").exists()


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ((), "give a CSV file, or --dataset"),
        (("data.csv", "--dataset", "kharaz2001"), "give a CSV file, or --dataset"),
        (("data.csv",), "pair: missing"),
        (("data.csv",), "give pair=carom.Pair(...) in Python or --case FILE in a shell, or write"),
        (("none.csv", "--case", "ball.toml"), "cannot be read"),
        (("--dataset", "kharaz"), "did you mean 'kharaz2001'"),
        (("data.csv", "--case", "ball.toml", "--fix", "restitution"), "restitution=0.98"),
        (("data.csv", "--case", "ball.toml", "--fix", "e=1"), "'e' is no parameter"),
        (("data.csv", "--case", "ball.toml", "--vary", "friction,x"), "'x' is no parameter"),
        (("data.csv", "--case", "ball.toml", "--plot", "fit.txt"), "must end in"),
        (
            ("data.csv", "--case", "ball.toml", "--output", "data.csv"),
            "this file is also that of data",
        ),
        (("data.csv", "--case", "ball.toml", "--confidence", "95"), "between 0.5 and 1"),
        (("data.csv", "--case", "ball.toml", "--for", "friction"), "--advice"),
        (("data.csv", "--case", "ball.toml", "--advice", "0"), "advice: '0' cannot be used"),
        (("data.csv", "--case", "ball.toml", "--advice", "-2"), "advice: '-2' cannot be used"),
        (("data.csv", "--case", "ball.toml", "--advice", str(10**12)), "from 1 to 1000\n"),
        (("data.csv", "--case", "ball.toml", "--advice", "1.5"), "advice: '1.5' cannot"),
        (("data.csv", "--case", "ball.toml", "--steps", "0"), "steps: '0' cannot be used"),
        (("data.csv", "--case", "ball.toml", "--steps", str(10**12)), "from 100 to 100000"),
        (("data.csv", "--case", "ball.toml", "--seed", "-1"), "seed: '-1' cannot be used"),
        (("data.csv", "--case", "ball.toml", "--seed", str(10**30)), "seed: '1000"),
    ],
)
def test_bad_input_is_one_line_and_code_2(capsys, arguments, words):
    code, out, err = run(capsys, *arguments)
    assert code == 2
    assert out == ""
    assert words in err
    assert len(err.strip().splitlines()) == 1


def test_help_has_an_example(capsys):
    code, out, _ = run(capsys, "--help")
    assert code == 0
    assert "Example: carom fit" in out


def test_the_template_is_a_table_once_it_is_filled_in(capsys, tmp_path):
    """Empty it holds no row, as one line says; with three rows of sliding impacts it fits."""
    code, out, _ = run(capsys, "--template")
    assert code == 0
    (tmp_path / "own.csv").write_text(out)
    code, _, error = run(capsys, "own.csv")
    assert code == 2
    assert error.count("\n") == 1
    rows = ["50,2.0,1.0,44.14,-96.2", "60,2.0,1.0,57.0,-74", "70,2.0,-,69.2,-50.6"]
    (tmp_path / "own.csv").write_text(out + "\n".join(rows) + "\n")
    code, out, error = run(capsys, "own.csv")
    assert code == 0, error
    assert "8 values of normal_restitution, rebound_angle, spin_out in 3 rows" in out


def test_the_template_wants_no_data(capsys):
    code, out, error = run(capsys, "data.csv", "--template")
    assert (code, out) == (2, "")
    assert "prints an empty table" in error
