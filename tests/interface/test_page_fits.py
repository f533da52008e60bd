"""Fits on the page are the library's; columns are explained, and bodies asked for."""

import io
import json
from base64 import b64encode
from functools import cache
from pathlib import Path

import numpy as np
import openpyxl
import pytest
from tests.checks import measured, refused

import carom
from carom.cli import main
from carom.io.heads import TableFormat, as_toml

pytest.importorskip("flask")

from carom.page.uploads import answer
from carom.page.worker import Worker


@cache
def fitted(name):
    return carom.fit(carom.datasets.path(name))


def sent(content):
    return f"data:text/csv;base64,{b64encode(content).decode()}"


def asked(content, bodies="", name="folder/me.csv", columns=""):
    text = content if isinstance(content, bytes) else content.encode()
    return answer({"contents": sent(text), "name": name, "bodies": bodies, "columns": columns})


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    yield tmp_path
    assert not list(tmp_path.iterdir())  # nothing of the user's is left


@pytest.mark.slow
@pytest.mark.parametrize("name", carom.datasets.names())
def test_a_fit_is_the_librarys(name):
    reply, result = answer({"data": name}), fitted(name)
    assert reply == json.loads(json.dumps(reply, allow_nan=False))
    assert reply["words"] == str(result)
    assert reply["bodies"]["from"] == "file"
    values = {row["name"]: row["value"] for row in reply["parameters"]}
    assert float(values["friction"]) == pytest.approx(result.friction.value, rel=0.01)
    dataset = result.to_dataset()
    for chart, response in zip(reply["charts"], dataset["response"].values, strict=True):
        one = dataset.sel(response=response)
        ours = {name: np.array(chart[name], float) for name in ("measured", "residual", "error")}
        scale = np.nanmax(np.abs(one["measured"])) / np.nanmax(np.abs(ours["measured"]))
        for name, values in ours.items():
            np.testing.assert_allclose(values, one[name].values / scale, rtol=1e-5, atol=1e-12)
        scaled = one["residual"].values / one["error"].values
        np.testing.assert_allclose(np.array(chart["scaled"], float), scaled, rtol=1e-5)
        angles = np.degrees(dataset["incidence"])
        np.testing.assert_allclose(chart["x"], angles, rtol=1e-5, atol=1e-9)
        assert [line["law"] for line in chart["lines"]] == list(dataset["law"].values)
        assert chart["lines"][0]["law"] == "exact"


@pytest.mark.slow
def test_an_outlier_is_marked_and_named():
    """One of fourteen values with a wrong first digit: its point, its line and no other."""
    ball = carom.Sphere(radius="5 mm", material="steel")
    pair = carom.Pair(ball, carom.HalfSpace("steel"), friction=0.14)
    angles, rng = np.linspace(8.0, 60.0, 14), np.random.default_rng(1)
    hits = [carom.impact(pair, speed=0.3, angle=f"{angle} deg") for angle in angles]
    values = np.array([hit.contact_restitution for hit in hits]) + rng.normal(0.0, 0.01, 14)
    values[6] += 0.5
    lines = [f"{angle},{value}\n" for angle, value in zip(angles, values, strict=True)]
    bodies = "radius=5 mm&material=steel&friction=0.2"
    reply = asked("angle [deg],contact_restitution\n" + "".join(lines), bodies)
    (chart,) = reply["charts"]
    assert np.flatnonzero(chart["outlier"]).tolist() == [6]
    assert f"outliers: line {chart['row'][6]}" in reply["notes"]


def test_a_plate_in_a_file_is_fitted(tmp_path):
    case = {"first": {"radius": 0.005, "material": "steel"}, "second": {"thickness": 0.005}}
    rows = "0.2,0.59,52\n0.5,0.535,45\n1,0.49,40\n2,0.43,35\n"
    text = f"# case: {json.dumps(case)}\nnormal_speed,normal_restitution,duration [us]\n{rows}"
    reply = asked(text)
    assert reply == json.loads(json.dumps(reply, allow_nan=False))
    (row,) = (row for row in reply["parameters"] if row["name"] == "thickness")
    assert (row["symbol"], row["unit"]) == ("h", "mm")
    assert float(row["value"]) == pytest.approx(3.0, rel=0.02)
    assert "on a plate of 5 mm, steel" in reply["bodies"]["text"]
    assert [column["kind"] for column in reply["columns"]][-1] == "after the impact"
    assert reply["laws"][0]["law"] == "ZenerPlate"


def test_bodies_are_asked_for_where_the_file_does_not_tell_them():
    for bodies in ("", "given=numbers&psi=2"):
        reply = asked(measured(0.123), bodies)
        assert reply["asks"] == "bodies"
        assert reply["message"].startswith("me.csv does not say which bodies")
        taken = {row["head"]: row["name"] for row in reply["lists"]["columns"]}
        assert taken == {"angle [deg]": "angle", "contact_beta": "contact_beta", "run": ""}
    reply = asked(measured(0.123), "given=bodies&radius=5")
    assert reply["bodies"]["from"] == "page"
    assert "ball of 5 mm radius, bearing-steel" in reply["bodies"]["text"]
    friction = next(row for row in reply["parameters"] if row["name"] == "friction")
    low, high = map(float, friction["interval"].split(" to "))
    assert low < 0.123 < high


WRONG = [
    ("angle [deg],contact_beta\nten,half\n", "not a number in cell A2"),
    ("angel [deg],contact_beta\n10,0.5\n", "did you mean"),
    ("colour,size\n1,2\n", "no measured response"),
    ("angle,contact_beta\n10,0.5\n", "for degrees write"),
    ("x [deg],contact_beta\n10,0.5\n", "by another name, choose it in the list of the column"),
    ("theta;contact_beta\n1,234;0,5\n", "If so, choose it in the list of the column"),
    ("angle;contact_beta\n1,234;1,5\n1.2;2\n", "have different decimal signs"),
    ("angle [deg];contact_beta\n1,234;1,235\n", "choose it in the list of decimal signs"),
]


@pytest.mark.parametrize(("content", "words"), WRONG)
def test_bodies_are_not_asked_for_in_vain(content, words):
    refused(words, asked, content)


def test_bodies_of_the_file_are_not_those_of_the_page():
    reply = asked(carom.datasets.path("kharaz2001").read_bytes(), "given=bodies&radius=9")
    assert reply["bodies"]["from"] == "file"
    assert "2.5 mm" in reply["bodies"]["text"]
    assert reply["words"] == str(fitted("kharaz2001"))


@pytest.mark.slow
def test_columns_say_what_they_were_taken_for():
    columns = asked(measured(0.123), "given=bodies")["columns"]
    assert [row["kind"] for row in columns] == ["before the impact", "after the impact", "not used"]
    assert columns[0]["meaning"] == "angle of incidence from the normal"
    assert [row["unit"] for row in columns] == ["deg", "", ""]
    rows = "1,10,-3,1\n1,20,-9,1\n1,30,-20,1\n1,60,-30,1\n"
    columns = asked(f"speed,angle [deg],spin_out,spin_out_error\n{rows}", "given=bodies")["columns"]
    assert columns[0]["unit"] == "m/s (the head names no unit)"
    assert columns[3]["kind"] == "standard deviation"


def test_groups_are_offered_and_said():
    rows = "a;20;-9\na;20;-10\nb;40;-20\nb;40;-21\nc;60;-30\nc;60;-29\n"
    text = f"Gruppe;angle [deg];speed [m/s];spin_out\n{rows.replace(';', ';', 1)}"
    named = "group;angle [deg];spin_out;normal_restitution\n" + rows.replace("\n", ";0.9\n")
    reply = asked(f"speed;{named}".replace("\n", "\n1;", 6), "given=bodies")
    assert reply["columns"][1]["kind"] == "repeats"
    assert reply["columns"][1]["meaning"] == "setting that rows of a table repeat"
    offers = {each["name"]: each["words"] for each in reply["lists"]["quantities"]}
    assert offers["group"] == "setting that rows of a table repeat"
    rows, _ = offered(text)
    assert (rows["Gruppe"]["name"], rows["Gruppe"]["suggested"]) == ("group", True)
    drops = (
        "group;drop_height [cm];rebound_height [cm];rebound_height_2 [cm]\na;20;16;13\na;20;16;13\n"
    )
    refused(
        "group: bounces of a drop are no repeats of one setting, as", asked, drops, "given=bodies"
    )


def test_drops_are_told_as_restitution_against_speed():
    drops = "drop_height [mm],rebound_height [mm]\n100,60\n200,100\n400,170\n800,290\n"
    reply = asked(drops, "given=bodies")
    (chart,) = reply["charts"]
    assert chart["along_unit"] == "m/s"
    np.testing.assert_allclose(chart["measured"], np.sqrt([0.6, 0.5, 0.425, 0.3625]), rtol=1e-5)
    assert {law["law"] for law in reply["laws"]} == {
        *("ElasticPlastic", "KelvinVoigt", "Metal", "constant")
    }


@pytest.mark.parametrize(
    ("content", "words"),
    [
        *((b"what", "me.csv"), (b"a" * 1_000_001, "must be at most 1000000 bytes")),
        (b"angle [deg],contact_restitution\n" + b"10,0.2\n" * 2001, "at most 2000 rows"),
        *((b"", "me.csv"), (b"angle [deg],contact_beta\n10,0.5\n", "cannot determine"), *WRONG),
    ],
)
def test_what_cannot_be_fitted_is_refused_in_the_words_of_the_page(content, words, folder):
    reply = refused("", asked, content, "given=bodies")
    assert words in reply
    for odd in (str(folder), "pair=", "fixed=", "--", "data: ", "results: "):
        assert odd not in reply, reply


@pytest.mark.parametrize("contents", ["data:text/csv;base64,a", "data:text/csv;base64,é"])
def test_what_did_not_arrive_whole_is_refused(contents):
    upload = {"contents": contents, "name": "a.csv", "bodies": ""}
    refused("^file: it did not arrive whole", answer, upload)


@pytest.mark.slow
def test_the_process_that_fits():
    worker = Worker()
    try:
        result = worker.fit(contents=sent(measured(0.123).encode()), name="a.csv", bodies="")
        assert result["asks"] == "bodies"
        refused("^file: ", worker.fit, contents=sent(b"what"), name="a.csv", bodies="")
    finally:
        worker.close()


HEADS = "Winkel zur Platte [\N{DEGREE SIGN}];Drehzahl;Vorher;v_in;Notiz\r\n"
SAID = {  # in the lists: what they write for each head
    "Winkel zur Platte [\N{DEGREE SIGN}]": "surface_angle",
    "Drehzahl": "spin_out [rpm]",
    "Vorher": "spin [rad/s]",
    "v_in": "speed",
}


def german():
    """A table as German Excel exports it, of a ball of bearing steel whose friction is 0.17."""
    body = {"material": "bearing-steel"}
    pair = carom.Pair(carom.Sphere(radius="5 mm", **body), carom.HalfSpace(**body), 0.17)
    rows = []
    for angle in range(8, 80, 8):
        hit = carom.impact(pair, speed=1.2, angle=f"{angle} deg", spin="0 rpm")
        turns = hit.spin_out * 30.0 / np.pi
        rows.append(f"{90.0 - angle:.1f};{turns:.4f};0;1,2;gut\r\n".replace(".", ","))
    return (HEADS + "".join(rows)).encode("cp1252")


def offered(content, columns=""):
    with pytest.raises(carom.InputError) as error:
        asked(content, "given=bodies", columns=columns)
    lists = error.value.more["lists"]
    return {column["head"]: column for column in lists["columns"]}, lists


def test_what_a_column_may_hold_is_offered_and_suggestions_are_not_used():
    rows, lists = offered(german())
    assert [row["letter"] for row in rows.values()] == [*"ABCDE"]
    assert {head: (row["name"], row["suggested"]) for head, row in rows.items()} == {
        "Winkel zur Platte [\N{DEGREE SIGN}]": ("surface_angle", True),
        "Drehzahl": ("spin_out", True),
        "Vorher": ("", False),
        "v_in": ("speed", True),
        "Notiz": ("", False),
    }
    assert [row["fits"] for row in rows.values()] == [["rad"], [], [], [], []]
    assert rows["v_in"]["first"] == ["1,2", "1,2", "1,2"]  # as it is written
    assert (lists["sheets"], lists["asks_decimal"]) == ([], False)
    offers = {each["name"]: each for each in lists["quantities"]}
    assert offers["surface_angle"]["words"] == "angle of incidence from the surface"
    columns = as_toml(TableFormat({"Drehzahl": "spin [rpm]", "v_in": "column D"}))
    rows, _ = offered(german(), columns)
    assert (rows["Drehzahl"]["name"], rows["Drehzahl"]["chosen"]) == ("spin", "rpm")
    assert (rows["v_in"]["name"], rows["v_in"]["suggested"], rows["v_in"]["likely"]) == (
        *("", False, True),
    )


def test_what_the_lists_say_is_what_the_command_reads(capsys, folder):
    """One file says it to both, and both give one fit: that of the quantities that are meant."""
    columns = as_toml(TableFormat(SAID))
    reply = asked(german(), "given=bodies&radius=5", columns=columns)
    assert float(reply["parameters"][0]["value"]) == pytest.approx(0.17, rel=2e-3)
    case = '[first]\nradius = "5 mm"\nmaterial = "bearing-steel"\n'
    for name, text in {"map.toml": columns, "case.toml": case}.items():
        Path(name).write_text(text, encoding="utf-8")
    Path("lab.csv").write_bytes(german())
    capsys.readouterr()
    assert main(["fit", "lab.csv", "--case", "case.toml", "--columns", "map.toml"]) == 0
    assert capsys.readouterr().out.strip() == reply["words"]
    for name in ("map.toml", "case.toml", "lab.csv"):
        Path(name).unlink()
    rows = {column["head"]: column for column in reply["lists"]["columns"]}
    assert {head: rows[head]["name"] for head in SAID} == {
        head: name.partition(" ")[0] for head, name in SAID.items()
    }


def test_sheets_and_decimal_signs_are_offered_where_they_matter():
    book, file = openpyxl.Workbook(), io.BytesIO()
    for sheet, factor in ((book.active, 1.0), (book.create_sheet("Neu"), 0.5)):
        for row in ("angle [deg]", "contact_beta"), (10, factor), (20, 0.9 * factor), (60, 0.1):
            sheet.append(row)
    book.save(file)
    _, lists = offered(file.getvalue())
    assert (lists["sheets"], lists["columns"]) == (["Sheet", "Neu"], [])
    reply = asked(file.getvalue(), columns='sheet = "Neu"')
    assert reply["lists"]["columns"][1]["first"] == ["0.5", "0.45", "0.1"]
    text = "angle [deg];rebound_angle [deg]\n1,234;1,111\n2,345;2,222\n"
    rows, lists = offered(text)
    assert lists["asks_decimal"]
    assert rows["angle [deg]"]["first"] == ["1,234", "2,345"]
    lists = asked(text, columns='decimal = ","')["lists"]
    assert (lists["asks_decimal"], lists["decimal"]) == (True, ",")


@pytest.mark.parametrize(
    ("columns", "words"),
    [
        ("angel", "columns: 'map.toml' is not TOML"),
        ("colour = 1", "columns: 'colour' in map.toml is unknown"),
        ('[columns]\nx = "speed"', "file has no column of that name"),
        ('[columns]\nrun = "angle"', "'angle': two columns, A and C, have this name"),
        ('sheet = "A"', "me.csv is no spreadsheet"),
    ],
)
def test_a_mapping_that_does_not_fit_is_refused(columns, words, folder):
    line = refused("", asked, measured(0.123), "given=bodies", columns=columns)
    assert words in line
    assert str(folder) not in line


def test_nothing_is_offered_for_what_lists_cannot_mend():
    """Two columns of one head, which no mapping tells apart; a text without numbers."""
    for content in ("angle [deg],x,x\n10,1,2\n20,2,3\n", "once upon a time\nthere was\n"):
        with pytest.raises(carom.InputError) as error:
            asked(content)
        assert error.value.more == {}


@pytest.mark.parametrize(
    ("head", "own", "own_unit", "fits"),
    [
        ("angle_deg", "angle", "deg", []),
        ("psi_1", "psi_in", "", []),
        ("h1 (cm)", "h1", "", ["m"]),
        ("rebound_height_2_error [mm]", "rebound_height_2_error", "", ["m"]),
        ("spin_out [1/min]", "spin_out", "", []),  # turns or radians
        ("column C", "", "", []),
    ],
)
def test_what_a_head_says(head, own, own_unit, fits):
    rows, lists = offered(f"x [deg],{head}\n10,0.5\n", as_toml(TableFormat({head: "column B"})))
    row = rows[head]
    assert (row["own"], row["own_unit"], row["fits"], row["name"]) == (own, own_unit, fits, "")
    names = {each["name"] for each in lists["quantities"]}
    assert own.removesuffix("_error") in {"", *names}
