"""`carom track`: what it prints and stores, and one clear line for bad input."""

import json
from pathlib import Path

import pytest

import carom

DATA = Path(__file__).parents[2] / "examples" / "data"
SCALE = ("--frame-rate", "1 kHz", "--pixels-per-mm", "10")
TRACK = ("track", str(DATA / "track_deeplabcut.csv"), *SCALE)
CASE = '[first]\nradius = "5 mm"\nmaterial = "steel"\n'


def test_it_prints_what_the_library_finds(run):
    code, out, err = run(*TRACK, "--json")
    (record,) = json.loads(out)
    found = carom.track(DATA / "track_deeplabcut.csv", frame_rate=1000.0, pixels_per_mm=10)
    assert (code, err) == (0, "")
    assert {name: record[name] for name in found} == {n: v.item() for n, v in found.items()}
    assert record["frames"] == [12, 12]
    code, out, _ = run(*TRACK)
    lines = out.splitlines()
    assert code == 0
    assert "12 frames before and 12 after the impact at 11.628" in lines[0]
    assert lines[1].split()[:2] == ["normal_speed", f"{found.normal_speed.item():.4f}"]
    assert lines[-1].startswith("  note: spin: right below 3140 rad/s")


def test_its_table_goes_into_a_fit(run):
    Path("ball.toml").write_text(CASE)
    tracks = [str(DATA / f"track_{name}.csv") for name in ("deeplabcut", "sleap")]
    code, _, err = run("track", *tracks, *SCALE, "--output", "rebounds.csv")
    assert (code, err) == (0, "Carom has stored rebounds.csv.\n")
    code, out, _ = run("fit", "rebounds.csv", "--case", "ball.toml", "--fix", "kappa=0.8", "--json")
    assert code == 0
    assert json.loads(out)["rows"] == 2


@pytest.mark.parametrize(
    ("words", "arguments"),
    [
        ("2 faults: (1) x: no unit; give pixels_per_mm", TRACK[:2]),
        ("(2) frame_rate: missing; the track has frames", TRACK[:2]),
        ("x: no unit; give pixels_per_mm", ("track", str(DATA / "track_tracker.txt"))),
        ("gravity: 'moon' cannot be used", (*TRACK, "--gravity", "moon")),
        ("must be from 0.001 to 1e+09 Hz; check its unit", (*TRACK[:3], "1 THz")),
        ("plate_angle:", (*TRACK, "--plate-angle", "95 deg")),
        ("column: 'x' cannot be used", (*TRACK, "--column", "x")),
        ("track: 'nowhere.csv' cannot be read", ("track", "nowhere.csv")),
    ],
)
def test_bad_input_is_one_line(refusal, words, arguments):
    assert words in refusal(*arguments)
