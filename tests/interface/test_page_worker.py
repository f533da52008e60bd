"""Fits and files are made in processes that are killed at their limits; the page goes on."""

import os
import signal
import threading
import time
from concurrent.futures import ThreadPoolExecutor

import pytest

pytest.importorskip("flask")

from carom.page import worker as workers
from carom.page.limits import MOST_WAITING, Busy
from carom.page.views import Refused
from carom.page.worker import Desk, Worker

ECHO = """\
import os, pickle, sys, time
answer = None
while True:
    pickle.dump(answer, sys.stdout.buffer)
    sys.stdout.flush()
    asked = pickle.load(sys.stdin.buffer)["name"]
    if asked == "hang":
        9 ** 9 ** 9  # no other thread gets a turn, and no signal of Python is heard
    if asked == "die":
        os._exit(1)
    if asked == "slow":
        time.sleep(0.6)
    answer = asked, os.getpid()
    if asked in ("refuse", "busy", "fail"):
        from carom.page.views import Refused
        from carom.page.limits import Busy
        refusal, busy, failure = Refused("angle", "no"), Busy(), RuntimeError("no")
        answer = {"refuse": refusal, "busy": busy, "fail": failure}[asked]
"""
PATIENCE = 20.0  # s


@pytest.fixture
def desk(monkeypatch, tmp_path):
    """A process that echoes, and has a second for each answer."""
    monkeypatch.setattr(workers, "PROGRAM", ECHO)
    value = Desk("fit", 1.0, str(tmp_path))
    yield value
    value.close()


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
    _, first = desk.ask(name="one")
    begin = time.monotonic()
    with pytest.raises(Refused, match=r"^file: fitting it takes longer than 1 s; "):
        desk.ask(name="hang")
    assert time.monotonic() - begin < PATIENCE
    assert gone(first)
    assert desk.ask(name="again")[0] == "again"


def test_refusals_failures_and_crashes_are_told_apart(desk):
    desk._seconds = PATIENCE
    with pytest.raises(Refused, match=r"^Incidence: no$") as refused:
        desk.ask(name="refuse")
    assert refused.value.field == "angle"
    with pytest.raises(Busy, match="the page is busy"):
        desk.ask(name="busy")
    with pytest.raises(RuntimeError, match=r"^no$"):
        desk.ask(name="fail")
    with pytest.raises(Busy, match="has ended; try again"):
        desk.ask(name="die")
    assert desk.ask(name="again")[0] == "again"


@pytest.mark.parametrize("when", ["between", "at once", "at work"])
def test_a_question_is_asked_again_if_its_process_was_killed(desk, when):
    """As the system does where memory is short; whoever asks does not notice."""
    _, process = desk.ask(name="one")
    with ThreadPoolExecutor(1) as visitor:
        asked = visitor.submit(desk.ask, name="slow") if when == "at work" else None
        time.sleep(0.3 if asked else 0.0)
        os.kill(process, signal.SIGKILL)
        assert when != "between" or desk._process.wait(PATIENCE) == -signal.SIGKILL
        name, other = asked.result(PATIENCE) if asked else desk.ask(name="slow")
    assert name == "slow"
    assert other != process


def test_a_few_wait_and_the_rest_is_told_that_the_page_is_busy(desk):
    desk.ask(name="one")
    with ThreadPoolExecutor(MOST_WAITING + 4) as visitors:
        asked = [visitors.submit(desk.ask, name="hang")]
        time.sleep(0.3)
        asked += [visitors.submit(desk.ask, name=str(row)) for row in range(MOST_WAITING + 3)]
        value = [each.exception(PATIENCE) for each in asked]
    assert isinstance(value[0], Refused)
    assert sum(each is None for each in value) == MOST_WAITING
    assert sum(isinstance(each, Busy) for each in value) == 3


def test_a_fit_that_never_ends_holds_up_no_file_and_an_end_leaves_nothing_behind(monkeypatch):
    monkeypatch.setattr(workers, "PROGRAM", ECHO)
    value = Worker()
    folder = value._folder.name
    _, process = value.fit(name="one")
    value.file("curve.png", "", 0.5)
    asking = threading.Thread(target=pytest.raises, args=(Busy, value.fit), kwargs={"name": "hang"})
    asking.start()
    time.sleep(0.3)
    begin = time.monotonic()
    assert value.file("curve.png", "", 0.5)[0] == "curve.png"
    assert time.monotonic() - begin < 1.0
    assert asking.is_alive()
    value.close()
    asking.join(PATIENCE)
    assert not asking.is_alive()
    assert gone(process)
    assert not os.path.exists(folder)
    with pytest.raises(Busy):
        value.fit(name="one")


def test_memory_is_limited_where_the_system_can(monkeypatch, tmp_path):
    pytest.importorskip("resource")
    hungry = "worker.TASKS['fit'] = lambda size: bytes(size), {'size': 1}"
    program = workers.PROGRAM.replace("\nworker.work", f"\n{hungry}\nworker.work")
    monkeypatch.setattr(workers, "PROGRAM", program)
    value = Desk("fit", 20.0, str(tmp_path))
    try:
        with pytest.raises(Refused, match=r"^file: it takes more than 1024 MB of memory$"):
            value.ask(size=1 << 31)
        assert value.ask(size=3) == bytes(3)
    finally:
        value.close()
