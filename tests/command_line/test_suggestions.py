"""What a refusal of a file suggests reads the file: options are added as it says, until it is read.

Heads without units, in other words or misspelt, decimal signs, sheets, names of points.
"""

import io
import re
import shlex

import numpy as np
import openpyxl
import pytest
from tests.checks import CASE, PAIR
from tests.interface.test_lab_files import FILES

import carom

OPTION = re.compile(r'--(?:column|decimal|fix) (?:"[^"]*"|[^\s,;]+)')
ANGLES = (8.0, 16.0, 27.0, 38.0, 49.0, 60.0, 68.0)
HITS = [
    carom.impact(PAIR, speed=1.5, angle=f"{a} deg", losses=carom.KelvinVoigt(restitution=0.9))
    for a in ANGLES
]
RPM = 30.0 / np.pi


def rebounds(head, angle=1.0, spin=RPM, between=";", comma=","):
    """A table of these impacts, of angle, speed, restitution and spin, with decimal commas."""
    rows = [
        (a * angle, 1.5, 0.9, f"{spin * hit.spin_out:.6f}")
        for a, hit in zip(ANGLES, HITS, strict=True)
    ]
    texts = [[str(cell).replace(".", comma) for cell in row] for row in rows]
    return "\n".join([head, *map(between.join, texts), ""])


def drops(head):
    return f"{head}\n20;16,2\n30;24,1\n40;32,6\n50;40,3\n"


def two_sheets():
    book, file = openpyxl.Workbook(), io.BytesIO()
    for sheet in (book.active, book.create_sheet("Lauf 2")):
        for line in rebounds("Winkel [°];Tempo;e_n;Drehzahl [1/min]", comma=".").splitlines():
            sheet.append([float(c) if c[-1].isdigit() else c for c in line.split(";")])
    book.save(file)
    return file.getvalue()


def track(head, *columns):
    """Positions in m, at 1 kHz: a ball that falls askew and comes back, and a mark on it."""
    lines = list(head)
    for t in np.arange(24) / 1000.0:
        s = abs(t - 0.0115)
        x, y = 0.4 * t, 1.5 * s - 4.9 * s * s + 0.005
        cells = {"t": t, "x": x, "y": y, "u": x + 0.004 * np.cos(9.0 * t)}
        cells["v"] = y + 0.004 * np.sin(9.0 * t)
        lines.append(",".join(f"{cells[name]:.9f}" for name in columns))
    return "\n".join([*lines, ""])


FOUND = {"friction": 0.2, "restitution": 0.9}
FITS = {
    "in German": rebounds("Winkel [Grad];Tempo;Stoßzahl;Drehzahl [1/min]"),
    "without units": rebounds("Winkel;Tempo;Stoßzahl;Drehzahl", spin=1.0),
    "misspelt": rebounds("angel [deg];sped;normal_restitution;spin_uot [rpm]"),
    "misspelt, without units": rebounds("angel;sped;normal_restitution;spin_out [rpm]"),
    "spins in rpm": rebounds("angle [deg];speed;normal_restitution;spin_out"),
    "spins in revolutions": rebounds(
        "angle [deg];speed;normal_restitution;spin_out", spin=RPM / 60.0
    ),
    "two sheets": two_sheets(),
    "by blanks": rebounds("angle[deg] speed[m/s] e_n omega[rpm]", between="   ", comma="."),
    "by blanks, decimal commas": rebounds("angle[deg] speed[m/s] e_n omega[rpm]", between=" "),
}
DROPS = {
    "heights": drops("Fallhöhe;Sprunghöhe"),
    "heights and errors": "h_0;h_1;h_1_error\n20;16,2;0,1\n30;24,1;0,2\n40;32,6;0,1\n50;40,3;0,1\n",
    "one row": "angle [deg];speed;normal_restitution;spin_out [rpm]\n30;1,5;0,9;-40\n",
    "thousands": "drop_height [mm];rebound_height [mm]\n1,200;1,000\n1,400;1,100\n1,500;1,200\n",
}
TRACKS = {
    "points side by side": track(["mass_A,,,mass_B", "t,x,y,t,x,y"], *"txytuv"),
    "named points": track(["ball,,,mark,,", "t,x,y,t,x,y"], *"txytuv"),
    "one time": track([",ball,,mark", "t,x,y,x,y"], *"txyuv"),
    "heads with points": track(["t,ball.x,ball.y,mark.x,mark.y"], *"txyuv"),
    "a mass": track(["mass_A", "t,x,y"], *"txy"),
}


def applied(run, *arguments):
    """Run a command with what its refusals suggest; return its output, and all it was refused."""
    refusals, options = [], []
    for _ in range(4):
        code, out, err = run(*arguments, *options)
        if code == 0:
            return out, refusals
        assert not {*re.findall(r"\(\d+\) ([^;]*)", err)} & {*refusals}, err
        said = re.search(r"say which, by (\S+?:[^;]*?) or --sheet", err)
        found = dict.fromkeys(OPTION.findall(err))
        new = [part for option in found for part in shlex.split(option)]
        assert said or new, err
        assert not options or new != options[-len(new) :], err
        refusals.append(err)
        heads = {new[i + 1].rpartition("=")[0]: i for i in reversed(range(0, len(new), 2))}
        chosen = [part for i in sorted(heads.values()) for part in new[i : i + 2]]
        options += chosen if new[:1] == ["--column"] else new
        if said:
            arguments = [said[1] if "lab" in str(each) else each for each in arguments]
    raise AssertionError(refusals)


@pytest.fixture
def stored(tmp_path):
    def store(content):
        (tmp_path / "ball.toml").write_text("[first]" + CASE.split("[first]")[1])
        (tmp_path / "lab").write_bytes(content if isinstance(content, bytes) else content.encode())
        return tmp_path / "lab", "--case", tmp_path / "ball.toml"

    return store


@pytest.mark.first_case
@pytest.mark.parametrize("name", FITS)
def test_rebounds_are_read_by_what_refusals_suggest(name, run, stored):
    """And the fit finds what the impacts were made with, so that nothing was misread."""
    out, refusals = applied(run, "fit", *stored(FITS[name]), "--json")
    assert len(refusals) == 1 + ("sheets" in name), refusals
    for parameter, value in FOUND.items():
        found = re.search(rf'"{parameter}": {{\s*"value": ([\d.e-]+)', out)
        assert float(found[1]) == pytest.approx(value, rel=0.02), out


@pytest.mark.first_case
@pytest.mark.parametrize("name", DROPS)
def test_drops_are_read_by_what_refusals_suggest(name, run, stored):
    _, refusals = applied(run, "fit", *stored(DROPS[name]))
    assert len(refusals) == 1 + ("row" in name), refusals  # one after the other is fixed
    assert "fixed=" not in refusals[0]


@pytest.mark.first_case
@pytest.mark.parametrize("name", FILES)
def test_exports_are_read_by_what_refusals_suggest(name, run, stored):
    out, refusals = applied(run, "fit", *stored(FILES[name]()), "--fix", "restitution=1")
    assert len(refusals) <= 1
    assert "6 rows" in out


@pytest.mark.parametrize("name", TRACKS)
def test_tracks_are_read_by_what_refusals_suggest(name, run, stored):
    """In one step, in metres: the ball falls at 1.5 m/s less what gravity takes."""
    out, refusals = applied(run, "track", stored(TRACKS[name])[0], "--json")
    assert len(refusals) == 1
    speeds = [float(v) for v in re.findall(r'"normal_speed(?:_out)?": ([\d.]+)', out)]
    assert speeds == pytest.approx([1.5, 1.5], rel=0.02)
