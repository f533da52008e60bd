"""What the server of the page says: JSON, refusals by field, files; no browser."""

import json
import logging
import math
import subprocess
import sys

import pytest

pytest.importorskip("flask")

from carom.page import outcomes
from carom.page.app import WRITTEN_FILES, new_app
from carom.page.page import kernels, plotly_file


class Told:
    """A worker that says what it was asked; it has no history."""

    def __init__(self):
        self.asked = []

    def fit(self, **asked):
        self.asked.append(asked)
        return {"words": "fitted"}

    def file(self, name, query, time):
        if name == "history.png":
            raise RuntimeError("a secret")
        return f"{name} {query} {time}".encode()


@pytest.fixture(scope="module")
def client():
    return new_app(Told(), ["localhost"]).test_client()


def test_the_page_asks_only_what_is_here(client):
    html = client.get("/")
    assert html.status_code == 200
    text = html.get_data(as_text=True)
    for part in text.split('src="')[1:] + text.split('href="')[1:]:
        address = part.partition('"')[0]
        if not address.startswith("data:"):
            with client.get(address) as response:
                assert response.status_code == 200, address
    policy = html.headers["Content-Security-Policy"]
    assert "script-src 'self' 'wasm-unsafe-eval';" in policy  # nor texts, nor scripts in the page
    assert text.count('src="assets/server.js"') == 1
    assert "assets/copy.js" not in text


def test_parts_are_kept_by_the_browser_as_long_as_they_are_the_same(client):
    for path in ("/assets/theme.js", "/assets/wasm.js", "/plotly.min.js"):
        with client.get(path) as first:
            assert first.data
        assert first.headers["Cache-Control"] == "no-cache"
        tag = {"If-None-Match": first.headers["ETag"]}
        with client.get(path, headers=tag) as same:
            assert same.status_code == 304
    assert plotly_file().stat().st_size > 1_000_000


def test_the_kernels_are_a_script_of_the_page(client):
    with client.get("/assets/wasm.js") as script:
        assert script.data == kernels()
        assert script.content_type == "text/javascript; charset=utf-8"
    assert client.get("/").text.count('src="assets/wasm.js"') == 1


def test_a_verdict_and_laws(client):
    query = "given=numbers&psi=2&chi=1.5&law=mindlin"
    assert client.get(f"/verdict?{query}&time=0.3&tab=Files").get_json() == {"findings": []}
    laws = client.get(f"/laws?{query}").get_json()
    assert [law["label"] for law in laws["laws"]] == ["mindlin"]
    assert client.get("/verdict?angle=50").get_json()["findings"]


@pytest.mark.parametrize(
    ("name", "text", "value"),
    [
        *(("radius", "2 in", 50.8), ("radius", "3 cm", 30.0), ("radius", "7", 7.0)),
        *(("spin", "-60 rpm", -2.0 * math.pi), ("angle", "0.5 rad", math.degrees(0.5))),
        *(("young", "200 MPa", 0.2), ("density", "1 g/cm^3", 1000.0), ("chi", "1.44", 1.44)),
        ("thickness", "thick", None),  # an infinite one, which JSON has not
    ],
)
def test_a_number_is_read_in_the_unit_of_its_field(client, name, text, value):
    told = client.get("/number", query_string={"name": name, "text": text}).get_json()
    assert told == {"value": value and pytest.approx(value, rel=1e-12)}


def test_a_number_is_asked_of_fields_that_hold_one(client):
    for query in ("", "name=material&text=steel", "name=nowhere&text=1", "name=law"):
        assert client.get(f"/number?{query}").status_code == 404


@pytest.mark.parametrize(
    ("path", "field", "message"),
    [
        ("verdict?angle=95", "angle", "must be a number from 0 to 89.9 deg, not '95'"),
        ("verdict?angle=3 m", "angle", "must be a number from 0 to 89.9 deg, not '3 m'"),
        ("verdict?material=stell", "material", "there is no 'stell'; did you mean 'steel'"),
        ("laws?against=wall", "against", "there is no 'wall'; there are half-space; sphere; cup"),
        ("verdict?" + "psi=1&" * 1000, "", "the link has 6000 characters; at most "),
        ("laws?friction=", "friction", "must be a number from 0 to 10; it is empty"),
        ("verdict?frction=1", "", "the link says 'frction', which is unknown; did you mean"),
        ("laws?law=mindlinn", "law", "there is no 'mindlinn'; did you mean 'mindlin'"),
        ("verdict?against=cup&second_radius=3", "second_radius", "must be above 5 mm"),
        ("laws?against=cup&second_radius=3", "second_radius", "must be above 5 mm"),
        ("fit?data=none", "data", "must be one of foerster1994"),
        ("number?name=radius&text=2 kg", "radius", "must be a number from 0.001 to 10000 mm, not"),
        ("number?name=radius&text=2 km", "radius", "must be a number from 0.001 to 10000 mm, not"),
        ("number?name=radius", "radius", "must be a number from 0.001 to 10000 mm; it is empty"),
        ("number?name=psi&text=nan", "psi", "must be a number from -1e+06 to 1e+06, not 'nan'"),
        ("number?name=thickness&text=thin", "thickness", "must be a number from 0.001 to 10000 mm"),
    ],
)
def test_refusals_name_the_field(client, path, field, message):
    response = client.get(f"/{path}")
    assert response.status_code == 200  # a browser would log others as faults of the page
    answer = response.get_json()
    assert set(answer) == {"field", "message"}
    assert answer["field"] == field
    assert answer["message"].startswith(message)
    assert "\n" not in answer["message"]


def test_files_are_refused_in_a_line_of_text(client, caplog):
    caplog.set_level(logging.CRITICAL)
    assert client.get("/view.py?angle=95").data.startswith(b"carom: Incidence: must be a number")
    assert client.get("/nowhere").data == b"carom: 404: Not Found\n"
    assert client.get("/assets/../app.py").status_code == 404
    assert client.get("/history.png").data == b"carom: failed, RuntimeError\n"
    assert client.post("/verdict").get_json()["message"] == "405: Method Not Allowed"
    for host in ("elsewhere", "elsewhere:8050", "localhost.elsewhere", "[", "a@b", ""):
        answered = client.get("/verdict", headers={"Host": host})
        assert answered.json == {"field": "", "message": "400: Bad Request"}


def test_addresses_of_files(client):
    for name in WRITTEN_FILES:
        if name != "history.png":
            answered = client.get(f"/{name}?angle=50&time=0.25")
            assert answered.text == f"{name} angle=50 0.25"
            assert answered.headers["Content-Disposition"] == f"attachment; filename={name}"
    assert 'angle="50.0 deg"' in client.get("/view.py?angle=50&time=0.3").text
    assert "hit.fields(1.0 * hit.duration)" in client.get("/view.py?time=1.6").text
    assert client.get("/contact.png?time=7").text.endswith(" 1.6")  # where the film ends
    assert client.get("/contact.png?time=-7").text.endswith(" -0.6")
    for wrong in ("curve.png?angle=x", "view.py?angle=x", "history.nc?time=soon"):
        answered = client.get(f"/{wrong}")
        assert answered.status_code == 400
        assert answered.text.count("\n") == 1
    assert client.get("/curve.exe").status_code == 404


def test_addresses_of_fits():
    worker = Told()
    client = new_app(worker).test_client()
    for _ in range(2):  # a data set is fitted once
        assert client.get("/fit?data=kharaz2001").json == {"words": "fitted"}
    assert worker.asked == [{"data": "kharaz2001"}]
    assert client.get("/fit?data=nothing").json["field"] == "data"
    file = {"contents": "data:text/csv;base64,eA==", "name": "a.csv", "bodies": "", "columns": ""}
    assert client.post("/fit", json=file).json == {"words": "fitted"}
    assert worker.asked[1:] == [file]
    refused = {"field": "", "message": "file: it did not arrive; choose it again"}
    for wrong in ({}, [], {**file, "bodies": 1}, "x"):
        assert client.post("/fit", json=wrong).json == refused
    assert client.post("/fit", data=json.dumps(file)).json == refused  # from a form elsewhere


def test_the_server_itself_loads_none_of_what_fits_and_draws():
    line = "import sys, carom.page; print(*sys.modules)"
    ran = subprocess.run([sys.executable, "-c", line], capture_output=True, text=True, check=True)
    heavy = {"lmfit", "matplotlib", "xarray", "pandas", "carom.lab.fitting"}
    assert heavy.isdisjoint(ran.stdout.split())


def test_a_failure_is_a_line(client, monkeypatch, caplog):
    def fail(_):
        raise ZeroDivisionError("a secret\nof the program")

    caplog.set_level(logging.ERROR)
    monkeypatch.setattr(outcomes, "verdict", fail)
    response = client.get("/verdict")
    assert response.status_code == 500
    assert response.get_json() == {"field": "", "message": "failed, ZeroDivisionError"}
    assert "Traceback" not in caplog.text
