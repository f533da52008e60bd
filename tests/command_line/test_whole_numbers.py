"""Whole numbers of the command line: ASCII digits within limits that are stated, else one line."""

import pytest

from carom.cli import main

BALL = ["--radius", "5 mm", "--material", "steel", "--friction", "0.2", "--speed", "1 m/s"]
OPTIONS = {
    "points": ["curve", "--chi", "1.44"],
    "elements": ["impact", *BALL, "--method", "halfspace"],
    "steps": ["impact", *BALL, "--method", "halfspace"],
    "advice": ["fit", "--dataset", "kharaz2001"],
    "seed": ["fit", "--dataset", "kharaz2001"],
    "port": ["explore", "--no-open"],
}
ENGINE = ["verify", "lammps"]


@pytest.mark.parametrize("text", ["1_000", "٣٠", "3.0", "1e3", "many", "", "-5", "9" * 30])
@pytest.mark.parametrize(
    ("name", "command"), [*OPTIONS.items(), ("steps", ENGINE)], ids=[*OPTIONS, "verify steps"]
)
def test_what_is_no_count_is_refused(capsys, name, command, text):
    assert main([*command, f"--{name}", text]) == 2
    line = capsys.readouterr().err
    assert line.startswith(f"carom: {name}: ")
    assert "must be a whole number" in line
    assert line.count("\n") == 1


def test_points_of_a_curve_have_a_stated_limit(capsys):
    assert main(["curve", "--chi", "1.44", "--points", "100000000"]) == 2
    assert "from 2 to 100000" in capsys.readouterr().err
    assert main(["curve", "--chi", "1.44", "--points", "3"]) == 0
