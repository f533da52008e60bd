"""Whatever is asked of the page of the explorer, it answers soon and in a line, never by failing.

Requests are mutations of those that the page makes. Uploads are fitted in the process of the tests
here; that a fit cannot hold up the page is what tests/interface/test_page_under_attack.py is about.
"""

import json
import logging
import random
import time
from base64 import b64encode
from pathlib import Path
from urllib.parse import quote, urlencode

import pytest

pytest.importorskip("flask")

from carom.page import files, uploads
from carom.page.app import ANSWERED_IN_JSON, WRITTEN_FILES, new_app
from carom.page.limits import LARGEST_REQUEST, LONGEST_LINK
from carom.page.outcomes import outcome_of
from carom.page.overlays import law_curves
from carom.page.views import CHOICES, FIELDS, LAWS, View

SOON = 5.0  # s of a core, for the slowest answer
REFUSED = {400, 403, 404, 405, 411, 413, 414, 415, 503}
FAST_LAWS = tuple(label for label in LAWS if label != "Walton & Braun")  # up to 5 s at chi = 10
NUMBERS = ["0", "-0", "1e400", "-1e400", "nan", "inf", "1e-320", "1_0", "٣"]
NUMBERS += ["\u2212 3", "1,5", "0x1"]
WORDS = ["", " ", "\0", "\n", "%", "%00", "%ff", "é", "\U0001f3b1", "\ud800", "..", "/", "\\", "'"]
WORDS += ['"', "null", "true", "[]", "{}", "<script>", "../../etc/passwd", "{0}", "%s"]
WORDS += ["a" * 5000, ";", "&"]
VALUES = [None, True, False, 0, -1, 1.5, 10**30, float("nan"), float("inf"), 1e308, [], {}, [[]]]
VALUES += [[None], {"a": 1}, [{}], {"id": "x"}, ["x"] * 300, {"": ""}]
CELLS = ["", " ", "-", "1 m", "1e400", "nan", "inf", '"', '""', "(" * 300, "1,5"]
CELLS += ["5 parsec", "=1+1"]
TABLE = """angle [deg],speed [m/s],contact_restitution,spin_out [rad/s]
10,0.6,-0.4,3.1
30,0.6,0.2,12
50,0.6,0.55,13.5
70,0.6,0.8,8
"""
METHODS = ["GET", "POST", "PUT", "DELETE", "HEAD", "OPTIONS", "PATCH", "TRACE", "BREW", "get"]
HEADERS = ["Content-Type", "Content-Length", "Host", "Cookie", "Accept", "Range", "If-None-Match"]
HEADERS += ["If-Modified-Since", "Transfer-Encoding", "X-Forwarded-For", "Authorization", "Origin"]


class InThisProcess:
    """The worker's part, in this process."""

    def fit(self, **asked):
        return uploads.answer(asked)

    def file(self, name, query, time):
        return files.write(name, View.of(query), time, Path.cwd()).read_bytes()


@pytest.fixture(scope="module")
def server():
    law_curves(outcome_of(View()), LAWS)  # compiles, if need be
    return new_app(InThisProcess(), ["localhost"])


@pytest.fixture(autouse=True)
def in_a_folder_of_its_own(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


@pytest.fixture
def ask(server, caplog):
    """Ask the page something, and look at the answer: True if it is not refused."""
    client = server.test_client()
    caplog.set_level(logging.ERROR)

    def asked(path, method="GET", **sent):
        caplog.clear()
        begin = time.process_time()
        with client.open(path, method=method, **sent) as answer:
            text = answer.get_data()
        took = time.process_time() - begin
        request = f"{method} {path[:300]!r} {str(sent)[:600]}"
        assert answer.status_code in {200, 204, 206, 304, 416} | REFUSED, f"{request}: {text[:300]}"
        assert took < SOON, request
        for word in (b"Traceback", b"failed, ", b'File "', b"NaN", b"Infinity"):
            assert word not in text[:2000] + text[-2000:], f"{request}: {text[-500:]} {caplog.text}"
        refused = answer.status_code in REFUSED or text.startswith(b'{"field":')
        if refused and method != "HEAD":
            if answer.is_json:
                told = json.loads(text)
                told.pop("lists", None)  # from which columns of a file may be chosen
                assert set(told) == {"field", "message"}, request
                text = json.dumps(told, ensure_ascii=False).encode()
            else:
                assert text.startswith(b"carom: "), request
            assert text.count(b"\n") == (not answer.is_json), request
            assert len(text) < 1000, request
        return not refused

    return asked


def garbled(rng, text):
    """Return a text with a few characters changed, dropped or repeated."""
    letters = list(text)
    for _ in range(rng.randint(1, 4)):
        place = rng.randrange(len(letters) + 1)
        letters[place : place + rng.randint(0, 3)] = rng.choice(
            [*WORDS, *NUMBERS, *"0123456789e.,"]
        )
    return "".join(letters)


def word(rng, name):
    """Return what a link may say of a thing: often right, or nearly."""
    kind = rng.random()
    if kind < 0.2:
        return rng.choice(WORDS + NUMBERS)
    if name in FIELDS and FIELDS[name].is_number:
        field = FIELDS[name]
        value = rng.choice([field.least, field.most, rng.uniform(field.least, field.most)])
        right = repr(value * rng.choice([1.0, 1.0, 1.0, -1.0, 1.1]))
    else:
        right = rng.choice((CHOICES | {"law": FAST_LAWS}).get(name, FAST_LAWS))
    return right if kind < 0.9 else garbled(rng, right)


def link(rng):
    """Return the query of a link, seldom quite right."""
    names = [*FIELDS, "law", "time", "theme", "other"]
    pairs = [(name, word(rng, name)) for name in rng.choices(names, k=rng.randint(0, 7))]
    query = urlencode(pairs, errors="replace")
    return garbled(rng, query) if rng.random() < 0.2 else query


def test_links_and_files(ask, calls):
    """Addresses of files, with links that say mutated words."""
    rng = random.Random(0)
    right = 0
    for _ in range(calls // 20):
        name = rng.choice(["view.py", "verdict"] * 20 + ["laws"] * 8 + [*WRITTEN_FILES])
        right += ask(f"/{name}?{quote(link(rng), safe='=&%+', errors='replace')}")
    assert right > 0
    assert not ask(f"/view.py?{'a' * (LONGEST_LINK + 1)}")


def test_numbers(ask, calls):
    """Texts of fields, which are often numbers, with units that are often right."""
    rng = random.Random(4)
    right = 0
    for _ in range(calls // 4):
        name = rng.choice([*FIELDS, "law", "other"])
        units = ["", "", " mm", " in", " rpm", " deg", "kg"]
        text = word(rng, name) + rng.choice(units)
        asked = {"name": name, "text": text}
        right += ask(f"/number?{urlencode(asked, errors='replace')}")
    assert right > 0


def test_addresses_methods_and_headers(ask, calls):
    rng = random.Random(1)
    values = ["/", "/view.py", "/assets/stage.js", "/plotly.min.js", *ANSWERED_IN_JSON]
    for _ in range(calls // 4):
        path = rng.choice(values)
        if rng.random() < 0.7:
            path = "/" + quote(garbled(rng, path).lstrip("/"), safe="/%", errors="replace")
        headers = [
            (name, "".join(filter(str.isprintable, garbled(rng, "1"))).encode("latin-1", "replace"))
            for name in rng.sample(HEADERS, rng.randint(0, 3))
        ]
        headers = [(name, value.decode("latin-1")) for name, value in headers]
        method = rng.choice(METHODS)
        ask(path, method, headers=headers, data=rng.randbytes(rng.choice([0, 0, 30])))


def mutated(rng, value):
    """Return what JSON holds with a part of it replaced, dropped or repeated."""
    if isinstance(value, dict) and value and rng.random() < 0.9:
        name = rng.choice(list(value))
        if rng.random() < 0.15:
            return {key: each for key, each in value.items() if key != name}
        return value | {name: mutated(rng, value[name])}
    if isinstance(value, list) and value and rng.random() < 0.9:
        row = rng.randrange(len(value))
        if rng.random() < 0.2:
            return value[:row] + value[row + 1 :] * rng.randint(0, 2)
        return [*value[:row], mutated(rng, value[row]), *value[row + 1 :]]
    if isinstance(value, str) and rng.random() < 0.4:
        return garbled(rng, value)
    return rng.choice(VALUES + WORDS + NUMBERS)


def as_sent(content):
    return f"data:text/csv;base64,{b64encode(content).decode()}"


def test_bodies(ask, calls):
    """Bodies of JSON as the page sends them, with values and structure mutated."""
    rng = random.Random(2)
    right = 0
    for _ in range(calls // 8):
        body = {"contents": as_sent(TABLE.encode()), "name": "a.csv", "bodies": link(rng)}
        body["columns"] = ""
        for _ in range(rng.randint(0, 2)):
            body = mutated(rng, body)
        sent = json.dumps(body)
        if rng.random() < 0.1:
            sent = garbled(rng, sent)
        right += ask("/fit", "POST", data=sent.encode("utf-8", "replace"), headers=JSON)
    assert right > 0
    assert not ask("/fit", "POST", data=b"[" * 100_000, headers=JSON)
    assert not ask("/fit", "POST", data=b" " * (LARGEST_REQUEST + 1), headers=JSON)


JSON = {"Content-Type": "application/json"}


def table(rng):
    """Return a table of measured rebounds with hostile cells, lines or bytes."""
    rows = [line.split(",") for line in TABLE.splitlines()]
    for _ in range(rng.randint(0, 3)):
        row = rng.choice(rows)
        if row:
            row[rng.randrange(len(row))] = rng.choice([*CELLS, *NUMBERS, *WORDS[:20]])
    if rng.random() < 0.3:
        rows.insert(rng.randrange(len(rows)), [rng.choice(CELLS)] * rng.randint(0, 6))
    separator = rng.choice([",", ",", ";", "\t"])
    text = rng.choice(["\n", "\n", "\r\n"]).join(map(separator.join, rows))
    actual = text.encode("utf-8", "replace")
    if rng.random() < 0.3:
        place = rng.randrange(len(actual))
        actual = actual[:place] + rng.randbytes(rng.randint(1, 8)) + actual[place + 2 :]
    return actual if rng.random() < 0.95 else rng.randbytes(300)


def mapping(rng):
    """Return what the columns of the table hold, with hostile names, or a text that is no TOML."""
    words = [*CELLS, *NUMBERS, *WORDS, "angle", "angle [deg]", "speed", "spin_out_error", "h1"]
    names = {rng.choice([*TABLE.split(",")[:3], *words]): rng.choice(words) for _ in range(3)}
    rows = (f"{json.dumps(head)} = {json.dumps(name)}\n" for head, name in names.items())
    signs = rng.choice(["", 'decimal = ","\n', 'sheet = "A"\n', "x = 1\n"])
    text = f"{signs}[columns]\n{''.join(rows)}"
    return garbled(rng, text) if rng.random() < 0.3 else text


def test_uploads(ask, calls):
    """Files of random bytes, and tables with hostile cells."""
    rng = random.Random(3)
    right = 0
    for _ in range(calls // 20):
        contents = as_sent(table(rng))
        if rng.random() < 0.1:
            contents = garbled(rng, contents)
        file = {"contents": contents, "name": rng.choice(["a.csv", *WORDS])}
        file["bodies"] = link(rng) if rng.random() < 0.3 else "given=bodies"
        file["columns"] = mapping(rng) if rng.random() < 0.4 else ""
        right += ask("/fit", "POST", data=json.dumps(file).encode(), headers=JSON)
    assert right > 0
