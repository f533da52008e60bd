"""What the server of the page says: answers as JSON, refusals by field, files; no browser."""

import json
import logging
import subprocess
import sys
import threading
import time

import pytest

pytest.importorskip("flask")

from carom.explorer import answers, warming
from carom.explorer.app import WRITTEN_FILES, new_app
from carom.explorer.page import plotly_file
from carom.explorer.views import LAWS, View
from carom.explorer.warming import Preparing, Warming

PATIENCE = 60.0  # s


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
    actual = Warming()
    actual.start()
    end = time.monotonic() + 5 * PATIENCE  # it may compile
    while time.monotonic() < end:
        try:
            actual.check(View(law=LAWS, restitution=0.8), laws=True)
            break
        except Preparing:
            continue
    return new_app(Told(), actual, ["localhost"]).test_client()


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
    assert "script-src 'self' 'unsafe-eval';" in policy  # nor scripts within the page
    config = json.loads(text.partition('id="config">')[2].partition("</script>")[0])
    assert config["static"] is False


def test_parts_are_kept_by_the_browser_as_long_as_they_are_the_same(client):
    for path in ("/assets/theme.js", "/plotly.min.js"):
        with client.get(path) as first:
            assert first.data
        assert first.headers["Cache-Control"] == "no-cache"
        tag = {"If-None-Match": first.headers["ETag"]}
        with client.get(path, headers=tag) as same:
            assert same.status_code == 304
    assert plotly_file().stat().st_size > 1_000_000


def test_an_answer_and_its_laws(client):
    query = "given=numbers&psi=2&chi=1.5&law=mindlin"
    answer = client.get(f"/answer?{query}&time=0.3&tab=Files").get_json()
    assert answer["query"] == View.of(query).query()
    laws = client.get(f"/laws?{query}").get_json()
    assert [law["label"] for law in laws["laws"]] == ["mindlin"]


@pytest.mark.parametrize(
    ("path", "field", "message"),
    [
        ("answer?angle=95", "angle", "must be a number from 0 to 89.9 deg, not '95'"),
        ("answer?angle=3 m", "angle", "must be a number from 0 to 89.9 deg, not '3 m'"),
        ("answer?material=stell", "material", "there is no 'stell'; did you mean 'steel'"),
        ("answer?against=wall", "against", "there is no 'wall'; there are half-space; sphere; cup"),
        ("answer?" + "psi=1&" * 1000, "", "the link has 6000 characters; at most "),
        ("answer?friction=", "friction", "must be a number from 0 to 10; it is empty"),
        ("answer?frction=1", "", "the link says 'frction', which is unknown; did you mean"),
        ("laws?law=mindlinn", "law", "there is no 'mindlinn'; did you mean 'mindlin'"),
        ("answer?against=cup&second_radius=3", "second_radius", "must be above 5 mm"),
        ("fit?data=none", "data", "must be one of foerster1994"),
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
    assert client.post("/answer").get_json()["message"] == "405: Method Not Allowed"
    for host in ("elsewhere", "elsewhere:8050", "localhost.elsewhere", "[", "a@b", ""):
        answered = client.get("/answer", headers={"Host": host})
        assert answered.json == {"field": "", "message": "400: Bad Request"}


def test_addresses_of_files(client):
    for name in WRITTEN_FILES:
        if name != "history.png":
            answered = client.get(f"/{name}?angle=50&time=0.25")
            assert answered.text == f"{name} angle=50 0.25"
            assert answered.headers["Content-Disposition"] == f"attachment; filename={name}"
    assert 'angle="50.0 deg"' in client.get("/view.py?angle=50&time=0.3").text
    assert client.get("/curve.png?time=7").text.endswith(" 1.0")
    for wrong in ("curve.png?angle=x", "view.py?angle=x", "history.nc?time=soon"):
        answered = client.get(f"/{wrong}")
        assert answered.status_code == 400
        assert answered.text.count("\n") == 1
    assert client.get("/curve.exe").status_code == 404


def test_addresses_of_fits():
    worker = Told()
    client = new_app(worker, Warming()).test_client()
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
    line = "import sys, carom.explorer; print(*sys.modules)"
    ran = subprocess.run([sys.executable, "-c", line], capture_output=True, text=True, check=True)
    heavy = {"lmfit", "matplotlib", "xarray", "pandas", "carom.fitting"}
    assert heavy.isdisjoint(ran.stdout.split())


def test_a_failure_is_a_line(client, monkeypatch, caplog):
    def fail(_):
        raise ZeroDivisionError("a secret\nof the program")

    caplog.set_level(logging.ERROR)
    monkeypatch.setattr(answers, "answer", fail)
    response = client.get("/answer")
    assert response.status_code == 500
    assert response.get_json() == {"field": "", "message": "failed, ZeroDivisionError"}
    assert "Traceback" not in caplog.text


def test_what_is_compiled_is_told_with_how_far_it_is(monkeypatch):
    go = threading.Event()
    steps = [lambda: None, *[lambda: go.wait(PATIENCE)] * 4]
    monkeypatch.setattr(warming, "STEPS", steps)
    monkeypatch.setattr(warming, "PATIENCE_SECONDS", 0.2)
    monkeypatch.setattr(warming.shared_library, "reason", lambda: "there is none")
    busy = Warming()
    client = new_app(Told(), busy, ["localhost"]).test_client()
    busy.start()
    response = client.get("/answer")
    assert response.status_code == 200
    answer = response.get_json()
    assert (answer["percent"], answer["again"]) == (33, 1)  # one step of three
    assert "33 % of what this answer needs" in answer["message"]
    go.set()
    monkeypatch.setattr(warming, "PATIENCE_SECONDS", PATIENCE)
    for query in ("angle=3", "restitution=0.9"):
        assert "scene" in client.get(f"/answer?{query}").get_json()


def test_with_the_library_nothing_is_waited_for(monkeypatch):
    monkeypatch.setattr(warming.shared_library, "reason", lambda: "")
    Warming().check(View(law=LAWS), laws=True)
