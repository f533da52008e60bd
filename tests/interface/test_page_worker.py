"""Uploads are fitted in a process that is killed at its time limit; the page goes on meanwhile."""

import os
import threading
import time
from base64 import b64encode
from concurrent.futures import ThreadPoolExecutor

import pytest

import carom

pytest.importorskip("dash")

from carom.explorer import worker as workers
from carom.explorer.limits import WAITING, Busy
from carom.explorer.worker import Worker

ECHO = """\
import json, os, sys
print(json.dumps({"ready": True}), flush=True)
for line in sys.stdin:
    asked = json.loads(line)["contents"]
    if asked == "hang":
        9 ** 9 ** 9  # no other thread gets a turn, and no signal of Python is heard
    if asked == "die":
        os._exit(1)
    answer = {"words": asked, "process": os.getpid()}
    print(json.dumps({"refused": "file: no"} if asked == "refuse" else answer), flush=True)
"""
PATIENCE = 20.0  # s


@pytest.fixture
def worker(monkeypatch):
    """A worker that echoes, and has a second for each answer."""
    monkeypatch.setattr(workers, "PROGRAM", ECHO)
    monkeypatch.setattr(workers, "FIT_SECONDS", 1.0)
    found = Worker()
    yield found
    found.close()


def gone(process):
    """Tell whether a process has ended, soon."""
    end = time.monotonic() + PATIENCE
    while time.monotonic() < end:
        try:
            os.kill(process, 0)
        except ProcessLookupError:
            return True
        time.sleep(0.02)
    return False


def test_what_never_ends_is_killed_and_the_next_is_answered(worker):
    first = worker.fit("", "what", "a.csv")
    assert first["words"] == "what"
    begin = time.monotonic()
    with pytest.raises(carom.InputError, match=r"^file: fitting it takes longer than 1 s; "):
        worker.fit("", "hang", "a.csv")
    assert time.monotonic() - begin < PATIENCE
    assert gone(first["process"])
    assert worker.fit("", "again", "a.csv")["words"] == "again"


def test_refusals_and_failures_are_told_apart(worker):
    with pytest.raises(carom.InputError, match=r"^file: no$"):
        worker.fit("", "refuse", "a.csv")
    with pytest.raises(RuntimeError, match="has ended"):
        worker.fit("", "die", "a.csv")
    assert worker.fit("", "again", "a.csv")["words"] == "again"


def test_a_few_wait_and_the_rest_is_told_that_the_page_is_busy(worker):
    worker.fit("", "what", "a.csv")
    with ThreadPoolExecutor(WAITING + 4) as visitors:
        asked = [visitors.submit(worker.fit, "", "hang", "a.csv")]
        time.sleep(0.3)
        asked += [visitors.submit(worker.fit, "", str(row), "a.csv") for row in range(WAITING + 3)]
        found = [each.exception(PATIENCE) for each in asked]
    assert isinstance(found[0], carom.InputError)
    assert sum(each is None for each in found) == WAITING
    assert sum(isinstance(each, Busy) for each in found) == 3
    assert str(Busy()) == "the page is busy; try again"


def test_closed_it_leaves_nothing_behind(worker):
    process = worker.fit("", "what", "a.csv")["process"]
    folder = worker._folder.name
    asking = threading.Thread(target=pytest.raises, args=(Busy, worker.fit, "", "hang", "a.csv"))
    asking.start()
    time.sleep(0.3)
    worker.close()
    asking.join(PATIENCE)
    assert not asking.is_alive()
    assert gone(process)
    assert not os.path.exists(folder)
    with pytest.raises(Busy):
        worker.fit("", "what", "a.csv")


def sent(content):
    return f"data:text/csv;base64,{b64encode(content).decode()}"


@pytest.fixture(scope="module")
def fitting():
    found = Worker()
    yield found
    found.close()


def test_a_file_is_fitted_as_the_library_does(fitting):
    file = carom.datasets.path("kharaz2001")
    found = fitting.fit("", sent(file.read_bytes()), "measured.csv")
    assert found["words"] == str(carom.fit(file))
    assert len(found["figures"]) == 3


@pytest.mark.parametrize(
    ("contents", "words"),
    [
        (sent(b"what"), "'me.csv' cannot be used"),
        (sent(b"a" * 1_000_001), "must be at most 1000000 bytes"),
        (sent(b"angle [deg],contact_restitution\n" + b"10,0.2\n" * 2001), "at most 2000 rows"),
        ("data:text/csv;base64,a", "file: it did not arrive whole"),
        ("data:text/csv;base64,é", "file: it did not arrive whole"),
        ("", "me.csv"),
    ],
)
def test_files_that_are_none_are_refused_by_their_name(fitting, contents, words):
    with pytest.raises(carom.InputError) as error:
        fitting.fit("", contents, "folder/me.csv")
    assert words in str(error.value)
    assert "\n" not in str(error.value)
    assert fitting._folder.name not in str(error.value)


def test_memory_is_limited_where_the_system_can(monkeypatch):
    pytest.importorskip("resource")
    hungry = "from carom.explorer import uploads; uploads.fit_of_upload = lambda *_: bytes(1 << 31)"
    monkeypatch.setattr(
        workers, "PROGRAM", workers.PROGRAM.replace("from carom", f"{hungry}\nfrom carom")
    )
    found = Worker()
    try:
        with pytest.raises(carom.InputError, match=r"^file: fitting it takes more than 1024 MB"):
            found.fit("", "", "a.csv")
    finally:
        found.close()
