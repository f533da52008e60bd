"""The standard input in place of a file, and several files of which each gives a result."""

import io
import json
import sys
from pathlib import Path

import pytest
from tests.checks import CASE

import carom
from carom.io import progress

REBOUNDS = carom.datasets.path("kharaz2001").read_bytes()
TRACK = Path(__file__).parents[2] / "examples" / "data" / "track_deeplabcut.csv"
SWEEP = CASE.replace('angle = "30 deg"\n', "") + '[sweep.axes]\nangle = ["10 deg", "40 deg"]\n'
SCORED = b"psi_1,psi_2\n0.5,0.047\n1.5,-0.43\n3.5,-1.477\n"
BALL = f"[first]{CASE.split('[first]')[1]}".encode()
DROPS = "drop_height [m],rebound_height [m]\n0.2,0.162\n0.3,0.241\n0.4,0.326\n0.5,0.403\n"
READ = {  # a command that reads a file, by that and by the standard input
    "impact FILE --json": CASE.encode(),
    "sweep FILE --json": SWEEP.encode(),
    "fit FILE --json": REBOUNDS,
    "fit drops.csv --case FILE --json": BALL,
    "track FILE --frame-rate 1000 --pixels-per-mm 10 --json": TRACK.read_bytes(),
    "verify laws --law mindlin --case FILE --json": CASE.encode(),
    "verify score FILE --chi 1.44 --tolerance 0.1 --json": SCORED,
    "verify score scored.csv --columns FILE --chi 1.44 --json": b'[columns]\n"a" = "psi_1"\n',
    "verify tune FILE --json": CASE.encode(),
}


@pytest.fixture
def typed(monkeypatch):
    """A function that gives the standard input its content."""

    def give(content):
        monkeypatch.setattr(sys, "stdin", io.TextIOWrapper(io.BytesIO(content)))

    return give


@pytest.mark.first_case
@pytest.mark.parametrize("line", READ)
def test_the_standard_input_is_read_like_a_file(line, run, typed):
    Path("drops.csv").write_text(DROPS)
    Path("scored.csv").write_bytes(SCORED.replace(b"psi_1", b"a"))
    Path("file").write_bytes(READ[line])
    of_file = run(*line.replace("FILE", "file").split())
    assert of_file[1], of_file[2]
    typed(READ[line])
    code, out, err = run(*line.replace("FILE", "-").split())
    assert code == of_file[0], err
    assert json.loads(out.replace('"-"', '"file"')) == json.loads(of_file[1])


@pytest.mark.parametrize(
    ("content", "said"),
    [
        (b"", "friction: missing"),
        (b"\xff\xfe\x00", "case file: '-' is not text"),
        (b"friction = = 1", "case file: '-' is not TOML"),
        (b"friction = 0.2\nsped = 1", "sped: unknown key in -, line 2"),
    ],
)
def test_what_cannot_be_used_there_is_told_in_one_line(content, said, refusal, typed):
    typed(content)
    assert said in refusal("impact", "-")


def test_a_standard_input_that_is_closed_takes_one_line(refusal, monkeypatch):
    monkeypatch.setattr(sys, "stdin", None)
    assert "case file: '-' cannot be read; the standard input is closed" in refusal("impact", "-")


def test_it_is_one_file_only(refusal, typed):
    typed(REBOUNDS)
    assert "this file is also that of data" in refusal("fit", "-", "--case", "-")
    assert "one file is given twice" in refusal("fit", "-", "-")


def test_a_call_of_the_library_reads_a_file_of_that_name(tmp_path, monkeypatch, typed):
    typed(b"friction = 0.1\n")
    monkeypatch.chdir(tmp_path)
    Path("-.toml").touch()
    with pytest.raises(carom.InputError, match=r"'-' cannot be read; No such file"):
        carom.fit("-")


def test_several_impacts(run, typed):
    """A list in their order; the table of each stands below the name of its file."""
    Path("a.toml").write_text(CASE)
    Path("b.toml").write_text(CASE.replace("0.2", "0.4"))
    typed(CASE.encode())
    code, out, err = run("impact", "a.toml", "b.toml", "-", "--json", "--peaks")
    records = json.loads(out)
    alone = [json.loads(run("impact", f"{name}.toml", "--json", "--peaks")[1]) for name in "ab"]
    assert (code, err, records) == (0, "", [*alone, alone[0]])
    code, out, _ = run("impact", "a.toml", "b.toml", "--friction", "0.3")
    lines = out.splitlines()
    tables = [run("impact", f"{name}.toml", "--friction", "0.3")[1].splitlines() for name in "ab"]
    assert lines == ["a.toml", *tables[0], "b.toml", *tables[1]]


def test_several_impacts_tell_how_many_are_solved(run, monkeypatch):
    """JSON comes at the end, as one document; one impact alone tells its own progress."""
    monkeypatch.setattr(progress, "PATIENCE", dict.fromkeys(progress.Place, 0.0))
    Path("a.toml").write_text(CASE)
    Path("b.toml").write_text(CASE.replace("0.2", "0.4"))
    words = ("--method", "halfspace", "--elements", "16", "--steps", "40", "--json")
    code, out, err = run("impact", "a.toml", "b.toml", *words)
    assert (code, len(json.loads(out))) == (0, 2)
    assert err.splitlines()[-1] == "solving the impacts: 2/2, 0:00:00 left"
    assert "solving by boundary elements" not in err
    code, out, err = run("impact", "a.toml", *words)
    assert (code, type(json.loads(out))) == (0, dict)
    assert "solving the impacts" not in err
    assert "solving by boundary elements: " in err


def test_faults_of_several_impacts_are_told_by_file(refusal):
    Path("a.toml").write_text(CASE.replace("0.2", "-1"))
    Path("b.toml").write_text(CASE.replace("steel", "stel"))
    told = refusal("impact", "a.toml", "b.toml", "none.toml", "--steps", "1")
    for text in ("(1) steps: '1'", "a.toml: friction: -1", "b.toml: material: 'stel'"):
        assert text in told
    assert "none.toml: case file: 'none.toml' cannot be read" in told


def test_several_impacts_are_not_stored_in_one_file(refusal, run):
    Path("a.toml").write_text(CASE)
    Path("b.toml").write_text(CASE)
    assert "output file: " in refusal("impact", "a.toml", "b.toml", "--output", "hit.csv")
    Path("a.toml").write_text(CASE + '[output]\ndata = "a.csv"\n')
    Path("b.toml").write_text(CASE + '[output]\ndata = "b.csv"\n')
    code, _, err = run("impact", "a.toml", "b.toml")
    assert (code, err) == (0, "Carom has stored a.csv.\nCarom has stored b.csv.\n")
    assert Path("a.csv").read_text() == Path("b.csv").read_text()
