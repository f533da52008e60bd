"""Tracks of known impacts with pixel noise: the truth, and errors that are those of the noise."""

import io
import json
import re
from pathlib import Path

import numpy as np
import openpyxl
import pandas as pd
import pytest
from tests.checks import refused
from tests.films import NAMES, PAIR, filmed, impacts, store

import carom

EXAMPLES = Path(__file__).parents[2] / "examples"
HIT = carom.impact(
    PAIR, speed=1.5, angle="32 deg", spin=-50.0, losses=carom.KelvinVoigt(restitution=0.9)
)
SCALE = {"frame_rate": "1 kHz", "pixels_per_mm": 10}
SETS = 400
FILES = {  # how each is read
    "track_deeplabcut.csv": SCALE,
    "track_sleap.csv": SCALE,
    "track_tracker.txt": {"columns": {"x": "x [m]", "y": "y [m]"}},
}


def truth(hit, names=NAMES):
    return np.array([getattr(hit, name) for name in names])


def values(motions, end="", names=NAMES):
    return np.array([motions[name + end].values[0] for name in names])


CONDITIONS = {
    "level": ({}, {}),
    "tilted plate": ({"tilt": 0.35}, {"plate_angle": 0.35}),
    "gravity fitted": ({}, {"gravity": "fit"}),
    "few frames": ({"frames": 6, "noise": 0.5}, {}),
}


@pytest.mark.slow
@pytest.mark.parametrize(("film", "asked"), CONDITIONS.values(), ids=CONDITIONS)
def test_errors_are_those_of_the_noise(film, asked):
    """Over 400 seeds: what is off has the standard deviation that is told, to 10 %, and no bias."""
    tracks = [filmed(HIT, seed, **film) for seed in range(SETS)]
    motions = carom.track(tracks, **SCALE, **asked)
    off = np.array([motions[n].values - getattr(HIT, n) for n in NAMES])
    told = np.sqrt(np.array([np.mean(motions[f"{n}_error"].values ** 2) for n in NAMES]))
    np.testing.assert_allclose(off.std(axis=1), told, rtol=0.1)
    assert np.all(np.abs(off.mean(axis=1)) < 3.5 * told / np.sqrt(SETS))


@pytest.mark.parametrize("name", FILES)
def test_exports_give_the_impact_within_three_errors(name):
    """The files are those that the example writes: of the fifth of its impacts."""
    hit = impacts()[4]
    motions = carom.track(EXAMPLES / "data" / name, **FILES[name])
    names = [each for each in NAMES if each in motions]
    assert len(names) == (4 if "tracker" in name else 6)
    off = values(motions, names=names) - truth(hit, names)
    assert np.all(np.abs(off) < 3.0 * values(motions, "_error", names))


def rows_of(text):
    """Return the cells of an export, with numbers as numbers."""
    between = "\t" if "\t" in text else ","
    rows = [line.split(between) for line in text.splitlines()]
    return [[float(c) if re.fullmatch(r"[-+.\dE]+", c) else c for c in row] for row in rows]


def german(rows):
    """Return them as German Excel exports them, with a comment and a frame without a position."""
    texts = [[str(c).replace(".", ",") if isinstance(c, float) else c for c in r] for r in rows]
    last = rows[-1][0] + 1.0 if isinstance(rows[-1][0], float) else rows[-1][0]
    texts += [[str(last).replace(".", ","), *["-"] * (len(rows[0]) - 1)]]
    lines = ["# Kugel in der Höhe", *map(";".join, texts[:9]), ";" * 9, *map(";".join, texts[9:])]
    return "\r\n".join(lines).encode("cp1252")


def workbook(rows):
    """Return them as the second of two sheets with numbers, with its title above them."""
    book, file = openpyxl.Workbook(), io.BytesIO()
    for sheet, start in ((book.active, 5), (book.create_sheet("Versuch 2"), 0)):
        for row in rows[start:] if start else [["Flug"], [], *rows]:
            sheet.append(row)
    book.save(file)
    return file.getvalue()


@pytest.mark.parametrize("name", FILES)
def test_exports_stored_by_a_spreadsheet_are_the_same_to_the_last_bit(name, tmp_path):
    """As .xlsx, of which the sheet is named, and as German CSV, of which the encoding is told."""
    text = (EXAMPLES / "data" / name).read_text(encoding="utf-8")
    wanted = carom.track(EXAMPLES / "data" / name, **FILES[name])
    csv, book = tmp_path / "lab.csv", tmp_path / "lab.xlsx"
    csv.write_bytes(german(rows_of(text)))
    book.write_bytes(workbook(rows_of(text)))
    for source, more in ((csv, {}), (book, {"sheet": "Versuch 2"}), (f"{book}:Versuch 2", {})):
        motions = carom.track(source, **FILES[name], **more)
        for each in wanted:
            assert motions[each].values.tolist() == wanted[each].values.tolist()
        (about,) = json.loads(motions.attrs["tracks"])
        assert any("Latin-1" in note for note in about["notes"]) == (source == csv)


def test_all_faults_of_all_tracks_are_told_with_their_cells(tmp_path):
    paths = [tmp_path / name for name in ("one.csv", "two.csv")]
    paths[0].write_text("x [px];y;t\n1,5;2;0\n1,x;2;1\n1;2\n")
    paths[1].write_text("a;y [mm];frame\n1;2;3\n")
    line = refused("^5 faults: ", carom.track, [*map(str, paths)], pixels_per_mm=1)
    for words in (
        r"track .*one.csv: .*line 4 has 2 values, the header has 3 names",
        r"x: not a number in cell A3; '1.x' cannot",
        r"y: it is in mm; leave the scale",
        r"x: column missing; the columns are a, y \[mm\], frame",
        r"track .*two.csv: frame_rate: missing",
    ):
        assert re.search(words, line), words


def test_files_of_the_examples_are_what_the_camera_saw(tmp_path):
    store(tmp_path)
    for name in FILES:
        stored = (EXAMPLES / "data" / name).read_text(encoding="utf-8")
        assert (tmp_path / name).read_text(encoding="utf-8") == stored


def table(**film):
    return pd.DataFrame(filmed(HIT, 1, **film))


def mirrored(track):
    """Return the same impact seen from behind the plane of motion."""
    return track.assign(x=-track.x, mark_x=-track.mark_x)


def in_metres(track):
    """Return it in units, with y upwards and times of its own."""
    heads = {"x": "x [mm]", "y": "y [cm]", "mark_x": "mark_x [mm]", "mark_y": "mark_y [mm]"}
    signed = track.assign(y=-0.1 * track.y, mark_y=-track.mark_y, t=0.5 + track.frame / 1e3)
    scaled = signed.assign(**{name: 0.1 * signed[name] for name in heads})
    return scaled.drop(columns="frame").rename(columns={**heads, "t": "t [s]"})


def moved(track):
    """Return it with the later half 60 pixels too low, as of another camera."""
    return track.assign(y=track.y + 60.0 * (track.frame >= 12))


def as_angles(track):
    """Return it with the angle of the mark, wrapped, in place of its position."""
    angle = np.degrees(np.arctan2(track.y - track.mark_y, track.mark_x - track.x))
    return track.drop(columns=["mark_x", "mark_y"]).assign(**{"mark_angle [deg]": angle})


WAYS = {
    "mirrored": (mirrored, SCALE),
    "in units": (in_metres, {}),
    "angles of the mark": (as_angles, SCALE),
    "scale by the ball": (
        lambda track: track,
        {"frame_rate": 1000.0, "pixels_per_diameter": 100.0, "radius": "5 mm"},
    ),
    "frames with gaps": (
        lambda track: pd.concat([track, pd.DataFrame({"frame": [40]})], ignore_index=True),
        SCALE,
    ),
    "a direction that is told": (lambda track: track, {**SCALE, "y_down": True}),
}


@pytest.mark.parametrize(("change", "asked"), WAYS.values(), ids=WAYS)
def test_one_track_in_many_ways_is_one_motion(change, asked):
    wanted, actual = carom.track(table(), **SCALE), carom.track(change(table()), **asked)
    for end in ("", "_error"):
        np.testing.assert_allclose(values(actual, end), values(wanted, end), rtol=1e-8)


def test_a_stored_table_goes_into_a_fit(tmp_path):
    """As .csv and as it is: one fit, in which the errors of the tracks count."""
    tracks = [filmed(hit, seed) for seed, hit in enumerate(impacts())]
    motions = carom.track(tracks, **SCALE)
    found = carom.fit(motions, pair=PAIR)
    again = carom.fit(carom.save(motions, tmp_path / "rebounds.csv"), pair=PAIR)
    assert found.friction.low < PAIR.friction < found.friction.high
    for name in ("friction", "kappa", "restitution"):
        assert again[name].value == pytest.approx(found[name].value, rel=1e-6)


def notes(track, **asked):
    (about,) = json.loads(carom.track(track, **(SCALE | asked)).attrs["tracks"])
    return about["notes"]


def test_what_is_odd_is_said():
    """A wrong frame rate bends the path, or gives a gravity of its own; few frames a turn."""
    assert not any(note.startswith("path") for note in notes(table()))
    slow = table(frames=40)
    assert any("bent otherwise than by gravity" in note for note in notes(slow, frame_rate=500))
    (said,) = [n for n in notes(slow, frame_rate=500, gravity="fit") if n.startswith("gravity")]
    assert said.endswith("check the scale and the frame rate")
    fast = carom.impact(PAIR, speed=1.5, angle="32 deg", spin=2900.0)
    assert any("its sense may be the other one" in n for n in notes(filmed(fast, 1)))
    bare = table().drop(columns=["mark_x", "mark_y"])
    assert "spin: no mark is seen at all; a fit takes the spin before as zero" in notes(bare)


@pytest.mark.parametrize("seed", range(3))
def test_a_plate_whose_tilt_is_forgotten_is_suspected(seed):
    """A ball that falls on a tilted plate: friction lets speed and spin change in one sense."""
    tilt = np.radians(-20.0)
    fall = carom.impact(PAIR, speed=1.5, angle=-tilt)
    track = filmed(fall, seed, tilt=tilt)
    suspected = {
        angle: any("against each other" in note for note in notes(track, plate_angle=angle))
        for angle in ("-20 deg", "0 deg", "20 deg")
    }
    assert suspected == {"-20 deg": False, "0 deg": True, "20 deg": True}


BARE = "x,y,frame\n" + "\n".join(f"{i},{abs(i - 5)},{i}" for i in range(11)) + "\n"
REFUSED = {
    "time: column missing; give time, or frame": (table().drop(columns="frame"), SCALE),
    "frame_rate: missing; the track has frames": (table(), {"pixels_per_mm": 10}),
    "x: column missing; the columns are frame, a.x": (
        pd.DataFrame({"frame": [1], "a.x": [1], "a.y": [1], "b.x": [1], "b.y": [1]}),
        SCALE,
    ),
    "pixels_per_mm: it gives the same as": (table(), {**SCALE, "pixels_per_diameter": 3}),
    "radius: missing": (table(), {"pixels_per_diameter": 100, "frame_rate": 1000}),
    "x: it is in mm; leave the scale of pixels out": (in_metres(table()), SCALE),
    "track: no impact is seen": (table()[:12], SCALE),
    "track: the paths before and after meet at": (moved(table()), SCALE),
    "time: it does not grow": (pd.concat([table(), table()]), SCALE),
}


@pytest.mark.parametrize(("words", "case"), REFUSED.items(), ids=REFUSED)
def test_what_cannot_be_used_is_refused(words, case):
    refused(words, carom.track, case[0], **case[1])


def test_lengths_of_a_file_without_a_unit_are_asked_for(tmp_path):
    path = tmp_path / "track.csv"
    path.write_text(BARE)
    line = refused("x: no unit; give pixels_per_mm", carom.track, path, frame_rate=9)
    assert "if it is a length, give columns={'x': 'x [m]', 'y': 'y [m]'}" in line
    path.write_text("mass_A,,,mass_B,,\nt,x,y,t,x,y\n0,1,2,0,1,2\n1,3,2,2,3,2\n")
    refused("time: mass_A.t and mass_B.t differ; give all points of a time", carom.track, path)


@pytest.mark.parametrize("separator", [";", "\t"])
def test_decimal_commas_and_columns_of_two_masses(tmp_path, separator):
    """As Tracker writes them in a German system, the ball and the mark side by side."""
    track = table()
    heads = ["#multi:", separator.join(["", "ball", "", "mark", ""]), separator.join("txyxy")]
    rows = [
        separator.join(f"{value:.9f}".replace(".", ",") for value in row)
        for row in track.assign(frame=track.frame / 1e3).to_numpy()
    ]
    path = tmp_path / "track.txt"
    path.write_text("\n".join([*heads, *rows]))
    actual, wanted = carom.track(path, pixels_per_mm=10), carom.track(track, **SCALE)
    np.testing.assert_allclose(values(actual), values(wanted), rtol=1e-6)
