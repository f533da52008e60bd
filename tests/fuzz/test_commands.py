"""Command lines, mutated: a result and exit code 0, or exit code 2 and one line."""

import shlex
from pathlib import Path

import pytest

from carom.cli import main

EXAMPLES = Path(__file__).parents[2] / "examples"
BODIES = "--radius '5 mm' --material steel --friction 0.2"
LINES = [
    f"impact {BODIES} --speed '2 m/s' --angle '30 deg'",
    f"impact {BODIES} --normal-speed 1 --tangential-speed -0.5 --spin '600 rpm' --json",
    f"impact {BODIES} --against cup --second-radius '20 mm' --speed 2 --restitution 0.9",
    "impact ball.toml --angle '−10 deg' --output hit.csv",
    "curve --chi 1.44 --from 0 --to 3 --points 11",
    "curve --chi 1.44 --chi 2 --points 11 --output made.csv --json",
    "materials --json",
    "sweep sweep.toml --no-progress",
    "verify score curve.csv --chi 1.44 --tolerance 0.01 --json",
    "track track.csv --frame-rate '1 kHz' --pixels-per-mm 10 --plate-angle '1 deg' --json",
    "fit measured.csv --case ball.toml --fix restitution=0.98 --vary friction --confidence 0.9",
]
CURVE = "psi_1,psi_2\n0.5,0.04\n1.5,-0.4\n3.5,-1.5\n6,0.2\n"
MEASURED = "angle [deg],spin_out,speed\n10,-60,2\n30,-200,2\n50,-300,2\n70,-150,2\n"


@pytest.fixture
def folder(tmp_path, monkeypatch):
    ball = (EXAMPLES / "steel_ball.toml").read_text(encoding="utf-8").partition("[output]")[0]
    sweep = '[sweep.axes]\nangle = ["10 deg", "40 deg"]\n'
    files = {"ball.toml": ball, "sweep.toml": ball + sweep}
    files["track.csv"] = (EXAMPLES / "data" / "track_sleap.csv").read_text(encoding="utf-8")
    for name, text in (files | {"curve.csv": CURVE, "measured.csv": MEASURED}).items():
        (tmp_path / name).write_text(text, encoding="utf-8")
    monkeypatch.chdir(tmp_path)


def changed(words, rng, mutated):
    words = list(words)
    place = rng.randrange(len(words))
    match rng.randrange(6):
        case 0:
            del words[place]
        case 1:
            words.insert(place, words[rng.randrange(len(words))])
        case 2:
            words.insert(place, rng.choice(["--help", "--nope", "-", "--", "--json", "--plot"]))
        case _:
            words[place] = mutated(words[place])
    return [word for word in words if "/" not in word or "m/s" in word]  # stays in its folder


def test_lines_as_they_are(folder, capsys):
    for line in LINES:
        assert main(shlex.split(line)) in (0, 1), capsys.readouterr().err


def test_mutated_lines(calls, folder, rng, mutated, capsys):
    codes = []
    for _ in range(calls // 20):
        words = changed(shlex.split(rng.choice(LINES)), rng, mutated)
        codes.append(main(words))
        answer = capsys.readouterr()
        text = f"{words}: {answer.err}"
        assert codes[-1] in (0, 1, 2), text
        assert "Traceback" not in answer.err, text
        assert "carom: the command failed" not in answer.err, text
        if codes[-1] == 2:
            lines = [line for line in answer.err.splitlines() if line.startswith("carom: ")]
            assert lines, text
            assert not answer.out, text
    assert {0, 2} <= set(codes)
