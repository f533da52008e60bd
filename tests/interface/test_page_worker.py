"""Fits and files are made in processes that are killed at their limits; the page goes on."""

import os
import signal
import threading
import time
from concurrent.futures import ThreadPoolExecutor

import pytest

pytest.importorskip("flask")

from carom.explorer import worker as workers
from carom.explorer.limits import WAITING, Busy
from carom.explorer.refused import Refused
from carom.explorer.worker import Desk, Worker

ECHO = """\
import json, os, sys, time
print(json.dumps({"ready": True}), flush=True)
for line in sys.stdin:
    asked = json.loads(line)["what"]
    if asked == "hang":
        9 ** 9 ** 9  # no other thread gets a turn, and no signal of Python is heard
    if asked == "die":
        os._exit(1)
    if asked == "slow":
        time.sleep(0.6)
    told = {"refuse": {"refused": "no", "field": "angle"}, "busy": {"busy": True}}
    print(json.dumps(told.get(asked, {"told": asked, "process": os.getpid()})), flush=True)
"""
PATIENCE = 20.0  # s


@pytest.fixture
def desk(monkeypatch):
    """A process that echoes, and has a second for each answer."""
    monkeypatch.setattr(workers, "PROGRAM", ECHO)
    found = Desk("fit", 1.0)
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


def test_what_never_ends_is_killed_and_the_next_is_answered(desk):
    first = desk.ask(what="one")
    assert first["told"] == "one"
    begin = time.monotonic()
    with pytest.raises(Refused, match=r"^file: fitting it takes longer than 1 s; "):
        desk.ask(what="hang")
    assert time.monotonic() - begin < PATIENCE
    assert gone(first["process"])
    assert desk.ask(what="again")["told"] == "again"


def test_refusals_failures_and_crashes_are_told_apart(desk):
    with pytest.raises(Refused, match=r"^no$") as refused:
        desk.ask(what="refuse")
    assert refused.value.field == "angle"
    with pytest.raises(Busy):
        desk.ask(what="busy")
    with pytest.raises(Busy, match="has ended; try again"):
        desk.ask(what="die")
    assert desk.ask(what="again")["told"] == "again"


@pytest.mark.parametrize("when", ["between", "at once", "at work"])
def test_a_question_is_asked_again_if_its_process_was_killed(desk, when):
    """As the system does where memory is short; whoever asks does not notice."""
    process = desk.ask(what="one")["process"]
    if when != "at work":
        os.kill(process, signal.SIGKILL)
        assert when == "at once" or desk._process.wait(PATIENCE) == -signal.SIGKILL
        assert desk.ask(what="two")["told"] == "two"
        return
    with ThreadPoolExecutor(1) as visitor:
        asked = visitor.submit(desk.ask, what="slow")
        time.sleep(0.3)
        os.kill(process, signal.SIGKILL)
        found = asked.result(PATIENCE)
    assert found["told"] == "slow"
    assert found["process"] != process


def test_a_few_wait_and_the_rest_is_told_that_the_page_is_busy(desk):
    desk.ask(what="one")
    with ThreadPoolExecutor(WAITING + 4) as visitors:
        asked = [visitors.submit(desk.ask, what="hang")]
        time.sleep(0.3)
        asked += [visitors.submit(desk.ask, what=str(row)) for row in range(WAITING + 3)]
        found = [each.exception(PATIENCE) for each in asked]
    assert isinstance(found[0], Refused)
    assert sum(each is None for each in found) == WAITING
    assert sum(isinstance(each, Busy) for each in found) == 3
    assert str(Busy()) == "the page is busy; try again"


def test_closed_it_leaves_nothing_behind(desk):
    process = desk.ask(what="one")["process"]
    folder = desk._folder.name
    asking = threading.Thread(target=pytest.raises, args=(Busy, desk.ask), kwargs={"what": "hang"})
    asking.start()
    time.sleep(0.3)
    desk.close()
    asking.join(PATIENCE)
    assert not asking.is_alive()
    assert gone(process)
    assert not os.path.exists(folder)
    with pytest.raises(Busy):
        desk.ask(what="one")


def test_a_fit_that_never_ends_holds_up_no_file(monkeypatch):
    content = '{"told": asked, "content": "b2s="}'
    echo = ECHO.replace('["what"]', '.get("contents")')
    echo = echo.replace('{"told": asked, "process": os.getpid()}', content)
    monkeypatch.setattr(workers, "PROGRAM", echo)
    found = Worker(fit_seconds=3.0)
    try:
        found.file("curve.png", "", 0.5)
        asking = threading.Thread(
            target=pytest.raises, args=(Refused, found.fit), kwargs={"contents": "hang"}
        )
        asking.start()
        time.sleep(0.3)
        begin = time.monotonic()
        assert found.file("curve.png", "", 0.5) == b"ok"
        assert time.monotonic() - begin < 1.0
        assert asking.is_alive()
        asking.join(PATIENCE)
    finally:
        found.close()


def test_memory_is_limited_where_the_system_can(monkeypatch):
    pytest.importorskip("resource")
    hungry = "from carom.explorer import tasks; tasks._fitting = lambda: lambda _: bytes(1 << 31)"
    program = workers.PROGRAM.replace(
        "from carom.explorer.tasks", f"{hungry}\nfrom carom.explorer.tasks"
    )
    monkeypatch.setattr(workers, "PROGRAM", program)
    found = Desk("fit", 20.0)
    try:
        with pytest.raises(Refused, match=r"^file: it takes more than 1024 MB of memory$"):
            found.ask(contents="")
    finally:
        found.close()
