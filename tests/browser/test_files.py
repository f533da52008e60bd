"""What is taken along is what the library says, and what is brought is fitted or refused."""

import csv
import io
import json
import runpy
import urllib.error
import urllib.request
from urllib.parse import urlencode

import numpy as np
import pytest
from PIL import Image

import carom
from carom.verify.catalogue import named

pytestmark = pytest.mark.browser
PAIR = carom.Pair(
    carom.Sphere(radius="5 mm", material="bearing-steel"),
    carom.HalfSpace(material="bearing-steel"),
    0.17,
)
HIT = carom.impact(PAIR, speed=1.5, angle="55 deg")
QUERY = {"friction": 0.17, "speed": 1.5, "angle": 55}
FRICTION = 0.123
LAWS = [entry.label for entry in carom.verify.CATALOGUE]


def taken(seen, link, folder):
    """The file behind a link, as the browser saves it."""
    with seen.page.expect_download() as waiting:
        seen.page.click(link)
    file = folder / waiting.value.suggested_filename
    waiting.value.save_as(file)
    return file


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_histories_and_pictures(visit, folder):
    seen = visit(f"?{urlencode(QUERY)}")
    expected = HIT.history(201)
    for link, name, tolerance in (
        ("#history-csv", "history.csv", 1e-9),
        ("#history-nc", "history.nc", 0.0),
    ):
        file = taken(seen, link, folder)
        assert file.name == name
        found = carom.read(file)
        for column in ("time", "tangential_force", "stick_radius", "spin"):
            values = expected[column].values
            bound = tolerance * np.abs(values).max()
            assert np.asarray(found[column]) == pytest.approx(values, rel=0.0, abs=bound), column
    for link in ("#history-png", "#patch-png"):
        with Image.open(taken(seen, link, folder)) as image:
            assert image.format == "PNG"
            assert min(image.size) >= 400
            assert len(image.convert("RGB").getcolors(2**24)) > 50  # not an empty sheet


def test_the_lines_of_python_give_the_same_rebound(visit, folder, capsys):
    law = "mindlin"
    seen = visit(f"?{urlencode({**QUERY, 'law': law, 'time': 0.3})}")
    file = taken(seen, "#view-py", folder)
    seen.until(lambda: seen.page.inner_text("#code").strip() == file.read_text().strip())
    runpy.run_path(str(file))
    first, second = capsys.readouterr().out.splitlines()
    assert [float(part) for part in first.split()[:2]] == [HIT.psi_in, HIT.psi_out]
    by_law = float(named(law)[0].law.rebound(HIT.psi_in, PAIR.chi, kappa=PAIR.kappa))
    assert float(second.split()[-1]) == by_law
    assert {"history.csv", "history.png", "patch.png"} <= {each.name for each in folder.iterdir()}


def test_the_files_of_numbers(visit, folder, capsys):
    seen = visit("?given=numbers&psi=2.2&chi=1.3")
    assert seen.page.is_hidden("#patch-png")
    solved = carom.solve(2.2, 1.3)
    found = carom.read(taken(seen, "#history-nc", folder))
    assert float(found["psi_out"]) == solved.psi_out
    assert found["force"].values == pytest.approx(solved.history(201).force)
    runpy.run_path(str(taken(seen, "#view-py", folder)))
    assert capsys.readouterr().out.startswith(f"{solved.psi_out} ")


def test_laws_laid_over(visit):
    """The curve of a law, its point and its words in the table are the law's own."""
    laws = ("mindlin", "Walton & Braun")
    seen = visit(f"?{urlencode({**QUERY, 'law': laws}, doseq=True)}")
    chart = seen.laid_over(*laws)
    for label in laws:
        law = named(label)[0].law
        line, point = chart[label, "lines"], chart[label, "markers"]
        psi = np.array(line["x"])
        expected = law.rebound(psi, PAIR.chi, kappa=PAIR.kappa)
        assert psi.size > 40
        assert np.array(line["y"]) == pytest.approx(expected, abs=2e-4)
        at = float(law.rebound(HIT.psi_in, PAIR.chi, kappa=PAIR.kappa))
        assert point["y"] == pytest.approx([at], rel=1e-9)
        told = seen.result(f"ψ₂ by {label}")
        off = at - HIT.psi_out  # laws are solved to 1e-8
        assert told == f"{at:.6g}, " + (f"off by {off:+.3g}" if abs(off) > 1e-6 else "exact")
    assert {(label, "lines") for label in laws} <= set(seen.laid_over(*laws, chart="forces"))


def test_laws_that_take_long_follow_the_answer(visit):
    """However fast the bodies change, in the end all laws are there, for the bodies at last."""
    query = {"given": "numbers", "psi": 1.1, "law": LAWS}
    seen, chi = visit(f"?{urlencode(query, doseq=True)}"), 1.48
    seen.page.focus("#chi-slider")
    for _ in range(8):
        seen.page.keyboard.press("ArrowRight")
    seen.linked(f"chi={chi}")
    expected = {label: float(named(label)[0].law.rebound(1.1, chi)) for label in LAWS}

    def points():
        chart = seen.traces("rebounds")
        found = {name: line["y"][0] for (name, kind), line in chart.items() if kind == "markers"}
        found.pop("this impact")
        return found == pytest.approx(expected, rel=1e-9)

    seen.until(points)
    seen.page.wait_for_timeout(500)
    assert points()


def measured(friction):
    """A table of rebounds of known friction, as a user would upload it."""
    pair = carom.Pair(PAIR.first, PAIR.second, friction)
    lines, random = io.StringIO(), np.random.default_rng(20261121)
    writer = csv.writer(lines)
    writer.writerow(["angle [deg]", "contact_beta"])
    for angle in range(4, 76, 4):
        hit = carom.impact(pair, speed=0.6, angle=f"{angle} deg")
        writer.writerow([angle, -hit.contact_restitution + random.normal(0.0, 0.004)])
    return lines.getvalue().encode()


def upload(seen, content, name="mine.csv"):
    file = {"name": name, "mimeType": "text/csv", "buffer": content}
    seen.page.set_input_files("#upload input[type=file]", file)


def refused(seen):
    notice = seen.page.inner_text("#fit-notice")
    return "fitted" not in notice and notice


BAD = {
    "text.csv": b"once upon a time\nthere was a ball\n",
    "columns.csv": b"colour,size\n1,2\n3,4\n",
    "binary.csv": bytes(range(256)) * 40,
    "empty.csv": b"",
    "words.csv": b"angle [deg],contact_beta\nten,half\n",
    "large.csv": b"angle [deg],contact_beta\n" + b"10,0.5\n" * 150_000,
    "../../etc/passwd": b"root\n",
}


@pytest.mark.slow
def test_uploads_are_fitted_or_refused_in_a_line(visit):
    seen = visit(fresh=True)
    for name, content in BAD.items():
        upload(seen, content, name)
        short = name.rpartition("/")[2]
        notice = seen.until(lambda: refused(seen))
        assert "\n" not in notice, short
        assert "Traceback" not in notice
        assert "failed" not in notice, notice
        assert "/tmp" not in notice
        upload(seen, measured(FRICTION), "good.csv")
        seen.until(lambda: "fitted" in seen.page.inner_text("#fit-notice"))
        words = seen.page.inner_text("#fit")
        line = next(line for line in words.splitlines() if line.strip().startswith("friction"))
        assert float(line.split()[1]) == pytest.approx(FRICTION, rel=0.02), line
    with seen.page.expect_request(lambda asked: "fit.children" in (asked.post_data or "")):
        seen.choose("material", "pmma")  # the file does not tell its bodies: it is fitted again
    seen.until(lambda: "fitted" in seen.page.inner_text("#fit-notice"))
    assert seen.notice() == ""


@pytest.mark.slow
def test_the_last_of_file_and_data_set_counts(visit):
    seen, name = visit(fresh=True), carom.datasets.names()[0]
    for _ in range(2):  # the same file can be sent again
        upload(seen, measured(FRICTION), "own.csv")
        seen.until(lambda: "own.csv: fitted" in seen.page.inner_text("#fit-notice"))
        assert "data=" not in seen.link()
        seen.choose("data", name)
        seen.until(lambda: seen.page.inner_text("#fit-notice") == "")
        seen.linked(f"data={name}")
        seen.page.fill("#radius", "6.5")
        seen.linked("radius=6.5")
        seen.page.wait_for_timeout(500)
        assert seen.page.inner_text("#fit-notice") == ""  # still that of the data set
        seen.page.fill("#radius", "5")
        seen.linked("!radius")


def test_the_lines_are_those_of_the_link(visit):
    seen = visit("?angle=50")
    seen.until(lambda: 'angle="50.0 deg"' in seen.page.inner_text("#code"))
    seen.page.focus("#angle-slider")
    for key in ("ArrowRight", "ArrowLeft"):
        seen.page.keyboard.press(key)
        seen.page.wait_for_timeout(250)
    seen.linked("angle=50")
    seen.page.wait_for_timeout(800)
    assert 'angle="50.0 deg"' in seen.page.inner_text("#code")


def post(address, content, kind="application/json"):
    where = f"{address}_dash-update-component"
    request = urllib.request.Request(where, content, {"Content-Type": kind})
    with pytest.raises(urllib.error.HTTPError) as error:
        urllib.request.urlopen(request, timeout=10)
    with error.value as answer:
        return answer.code, answer.read().decode()


def test_the_server_itself_refuses(address):
    """Too much, nonsense and unknown paths: a line, the right number, no traceback."""
    value = {"contents": "data:;base64," + "A" * 3_000_000, "name": "x.csv"}
    large = json.dumps({"inputs": [{"id": "file", "property": "data", "value": value}]})
    for content, kind, codes in (
        (large.encode(), "application/json", (413,)),
        (b"nonsense", "application/json", (400,)),
        (b'{"x": 1}', "application/json", (400, 500)),
        (b"[]", "application/json", (400, 500)),
        (b"nonsense", "text/plain", (415,)),
    ):
        code, words = post(address, content, kind)
        assert code in codes, words
        assert words.startswith("carom: ")
        assert words.count("\n") == 1
    for path in ("nowhere", "assets/../layout.py", "history.exe", "view.py?angle=x"):
        with pytest.raises(urllib.error.HTTPError) as error:
            urllib.request.urlopen(f"{address}{path}", timeout=10)
        with error.value as answer:
            assert answer.code == (400 if "?" in path else 404)
            assert answer.read().count(b"\n") == 1
