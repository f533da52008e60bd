"""What commands print is plain text wherever it goes; only a bar on a terminal has colours."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest
from tests.checks import CASE
from tests.command_line.test_options import COMMANDS
from tests.interface.test_progress import CONTROL, on_terminal

TRACK = Path(__file__).parents[2] / "examples" / "data" / "track_deeplabcut.csv"
LINES = {
    ("impact",): ["case.toml"],
    ("curve",): ["--chi", "1.44"],
    ("sweep",): ["sweep.toml"],
    ("fit",): ["--dataset", "kharaz2001"],
    ("track",): [str(TRACK), "--frame-rate", "1 kHz", "--pixels-per-mm", "10"],
    ("materials",): [],
    ("verify", "laws"): ["--law", "mindlin"],
    ("verify", "score"): ["scored.csv", "--chi", "1.44"],
    ("verify", "tune"): ["--chi", "1.44"],
    ("verify", "pack"): ["bench"],
    ("lammps", "examples"): ["inputs"],
}
ENVIRONMENTS = {
    "": {},
    "no colour": {"NO_COLOR": "1"},
    "dumb": {"TERM": "dumb"},
    "forced": {"FORCE_COLOR": "1", "CLICOLOR_FORCE": "1", "TTY_COMPATIBLE": "1"},
}
SOON = """
import carom.io.progress as p
p.PATIENCE = dict.fromkeys(p.Place, 0.0)
"""


@pytest.fixture
def files(tmp_path):
    sweep = CASE.replace('angle = "30 deg"\n', "") + '[sweep.axes]\nangle = ["10 deg", "40 deg"]\n'
    contents = {
        "case.toml": CASE,
        "sweep.toml": sweep,
        "scored.csv": "psi_1,psi_2\n1,0\n2,1\n3,1\n",
    }
    for name, text in contents.items():
        (tmp_path / name).write_text(text)
    return tmp_path


@pytest.mark.first_case
@pytest.mark.parametrize("environment", ENVIRONMENTS)
@pytest.mark.parametrize("words", COMMANDS, ids=" ".join)
def test_no_control_sequences_in_pipes(words, environment, files, command):
    """Results, help and refusals; while progress is shown from the first moment on."""
    before = f"import os\nos.environ.update({ENVIRONMENTS[environment]!r})\n{SOON}"
    lines = [LINES[words]] if words in LINES else []
    for line in (*lines, ["--help"], ["--moon", "x", "--json"]):
        code, out, err = command(files, *words, *line, before=before)
        assert code in ((2,) if "--moon" in line else (0, 1)), err
        assert out or "--moon" in line
        assert "\x1b" not in out + err
        assert all(letter.isprintable() or letter == "\n" for letter in out + err)


@pytest.mark.slow
@pytest.mark.parametrize("environment", ENVIRONMENTS)
def test_a_bar_on_a_terminal_has_colours_unless_they_are_not_wanted(environment):
    """Its result in a pipe has none; NO_COLOR leaves what moves the cursor."""
    code = f"{SOON}import sys\nfrom carom.cli import main\n"
    code += "sys.exit(main(['verify', 'laws', '--psi', '1', '--json']))"
    got, stdout, status = on_terminal(code, **ENVIRONMENTS[environment])
    assert status == 0
    assert json.loads(stdout)["laws"]
    sequences = [letter for _, letter in CONTROL.findall(got)]
    colours = [argument for argument, letter in CONTROL.findall(got) if letter == "m" and argument]
    assert "laws" in got
    if environment == "dumb":
        assert not sequences
    else:
        assert "K" in sequences
        coloured = [each for each in colours if "38;" in each or each[0] in "39"]
        assert bool(coloured) == (environment != "no colour")


@pytest.mark.slow
def test_a_refusal_on_a_terminal_is_plain(tmp_path):
    got, _, status = on_terminal(
        "from carom.cli import main\nimport sys; sys.exit(main(['curve']))"
    )
    assert (got, status) == ("carom: chi: missing; give --chi\r\n", 2)


@pytest.mark.slow
def test_a_long_sweep_in_a_log_writes_plain_lines(files):
    """And is silent with --no-progress, or if it is short."""
    grid = 'angle = {from = "1 deg", to = "80 deg", points = 20000}'
    (files / "sweep.toml").write_text(
        CASE.replace('angle = "30 deg"\n', "") + f"[sweep.axes]\n{grid}"
    )
    command = "sweep", "sweep.toml", "--json"
    told = "solving the sweep: 20,000/20,000 points, 0:00:00 left"
    for start, more, lines in ((SOON, [], [told]), (SOON, ["--no-progress"], []), ("", [], [])):
        program = f"{start}from carom.cli import run\nrun()"
        words = [sys.executable, "-c", program, *command, *more]
        done = subprocess.run(words, cwd=files, capture_output=True, text=True, env=os.environ)
        assert json.loads(done.stdout)["points"] == 20_000
        shown = [line for line in done.stderr.splitlines() if "solving" in line]
        assert shown[-1:] == lines
