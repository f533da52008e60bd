"""Whole impacts against a table that `tests/oracles/generate_impacts.py` made at 50 digits.

The generator finds the slip front from the memory itself, F(s_a) = l, where the phase machine
integrates the load backwards; the two have no code in common.
"""

import csv
import subprocess
import sys
from pathlib import Path

import pytest

import carom

HERE = Path(__file__).parent
ROWS = list(csv.DictReader((HERE / "impacts.csv").read_text().splitlines()))
# the double next to 65/6 leaves a slip ring of 1e-16, taken for stick
RESOLVED = [row for row in ROWS if float(row["chi"]) != 65 / 6]
FEATURES = (
    *("stick from the start", "ring closes (slip) unloading"),
    *("ring closes on own slip: gross slip at once", "front jumps as its slip starts"),
    *("front jumps across own slip unloading", "front crosses opposite slip unloading"),
    *("all sticks (slip) loading", "slip reverses (gross slip) unloading", "gross slip throughout"),
)


def test_the_table_covers_every_route():
    text = "; ".join(row["features"] for row in ROWS)
    assert all(feature in text for feature in FEATURES)
    assert len(ROWS) > 40


@pytest.mark.parametrize("row", ROWS, ids=lambda row: f"{row['psi_1']}-{row['chi']}")
def test_rebound(row):
    """A tenth of what is promised: 1e-10 max(1, |psi_1|), ten times that beyond chi = 10."""
    psi, chi = float(row["psi_1"]), float(row["chi"])
    bound = (1e-11 if chi <= 10.0 else 1e-10) * max(1.0, abs(psi))
    assert abs(carom.rebound(psi, chi) - float(row["psi_out"])) <= bound


@pytest.mark.parametrize("row", RESOLVED, ids=lambda row: f"{row['psi_1']}-{row['chi']}")
def test_phases(row):
    """Kinds, signs and times of all phases."""
    psi, chi = float(row["psi_1"]), float(row["chi"])
    phases = carom.solve(psi, chi).phases
    expected = [text.split(":") for text in row["phases"].split(";")]
    assert [(p.kind, p.sign) for p in phases] == [(kind, int(sign)) for kind, sign, *_ in expected]
    for phase, (_, _, start, end, _) in zip(phases, expected, strict=True):
        assert phase.start == pytest.approx(float(start), abs=3e-11)
        assert phase.end == pytest.approx(float(end), abs=3e-11)


@pytest.mark.slow
def test_the_generator_confirms_its_table():
    """With other precision and order, for the first line; `--check` alone does all, in minutes."""
    program = [sys.executable, "-m", "tests.oracles.generate_impacts", "--check", "--first", "1"]
    done = subprocess.run(program, cwd=HERE.parents[1], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    assert "1 impacts confirmed" in done.stdout
