"""Heavy work that might never end, in processes of their own: fits, and files of a view."""

import faulthandler
import json
import os
import pickle
import subprocess
import sys
from collections.abc import Callable
from contextlib import suppress
from os.path import abspath
from pathlib import Path
from tempfile import TemporaryDirectory
from threading import BoundedSemaphore, Lock, Timer
from time import monotonic
from typing import Any

from carom.page.limits import (
    FILE_SECONDS,
    FIT_SECONDS,
    MOST_WAITING,
    START_SECONDS,
    WAITING_SECONDS,
    WORK_MEMORY,
    Busy,
)
from carom.page.views import Refused
from carom.quantities.refusals import InputError

PROGRAM = """\
import json, sys
sys.path[:] = json.loads(sys.argv[1])
from carom.page import worker
worker.work(sys.argv[2], float(sys.argv[3]))
"""
LATE_WORDS = {
    "fit": "file: fitting it takes longer than {:g} s; leave out what is not needed, or use "
    "carom fit",
    "file": "file: it takes longer than {:g} s to write; choose fewer contact laws",
}
MEMORY_PAGES = Path("/proc/self/statm")  # Linux has it
ORPHAN_FACTOR = 1.25  # times the limit: only where nobody is left to kill


class Ended(Busy):
    """A process ended before it answered."""

    said = "the process that works for the page has ended; try again"


class Desk:
    """A process that does one kind of work, one piece at a time; a few requests wait for it.

    Python code that holds the interpreter cannot be ended from within, and holds up every thread
    of its process; the time limit is sure as the whole process is killed, and started anew. It ends
    with this one, even if that is killed.
    """

    def __init__(self, task: str, seconds: float, folder: str) -> None:
        self._task, self._seconds, self._folder = task, seconds, folder
        self._places = BoundedSemaphore(1 + MOST_WAITING)
        self._turn = Lock()
        self._guard = Lock()
        self._process: subprocess.Popen[bytes] | None = None
        self._ready = self._closed = False

    def start(self) -> subprocess.Popen[bytes]:
        """Return the process, which is started if there is none, before it is ready."""
        with self._guard:
            if self._closed:
                raise Busy
            if self._process is None or self._process.poll() is not None:
                _end(self._process)
                paths = json.dumps([abspath(path) for path in sys.path])
                self._ready = False
                self._process = subprocess.Popen(
                    [sys.executable, "-c", PROGRAM, paths, self._task, str(self._seconds)],
                    cwd=self._folder,
                    stdin=subprocess.PIPE,
                    stdout=subprocess.PIPE,
                    stderr=subprocess.DEVNULL,
                    start_new_session=True,  # an interrupt from the keyboard is not for it
                )
            return self._process

    def close(self) -> None:
        """End the process; none is started any more."""
        with self._guard:
            self._closed = True
            _end(self._process)

    def ask(self, **asked: Any) -> Any:
        """Return what the process answers, or raise what it raises.

        Raises Refused for what takes too long, and Busy if others wait already, or if the process
        is killed twice.
        """
        if not self._places.acquire(blocking=False):
            raise Busy
        try:
            answer = self._answer(asked)
        except Ended:  # killed, perhaps by the system for want of memory: once more
            answer = self._answer(asked)
        finally:
            self._places.release()
        if isinstance(answer, Exception):
            raise answer
        return answer

    def _answer(self, asked: dict[str, Any]) -> Any:
        """Return what the process answers; if there is nothing, another takes its place."""
        if not self._turn.acquire(timeout=WAITING_SECONDS):
            raise Busy
        try:
            process = self.start()
            if not self._ready:
                _exchanged(process, START_SECONDS)
                self._ready = True
            return _exchanged(process, self._seconds, asked)
        except TimeoutError:
            self.start()
            raise Refused("", LATE_WORDS[self._task].format(self._seconds)) from None
        finally:
            self._turn.release()


class Worker:
    """What the page leaves to others: fits in one process, files in another."""

    def __init__(self, fit_seconds: float = FIT_SECONDS, file_seconds: float = FILE_SECONDS):
        self._folder = TemporaryDirectory(prefix="carom-")
        self._fits = Desk("fit", fit_seconds, self._folder.name)
        self._files = Desk("file", file_seconds, self._folder.name)

    def start(self, after: float = 0.0) -> None:
        """Let both processes start some seconds later."""
        timer = Timer(after, self._start)
        timer.daemon = True
        timer.start()

    def _start(self) -> None:
        with suppress(Busy):  # closed meanwhile
            self._files.start()
            self._fits.start()

    def close(self) -> None:
        """End both processes; none is started any more."""
        self._files.close()
        self._fits.close()
        self._folder.cleanup()

    def fit(self, **asked: str) -> Any:
        """Return a fit as `uploads.answer` does; raises as `Desk.ask`."""
        return self._fits.ask(**asked)

    def file(self, name: str, query: str, time: float) -> Any:
        """Return the bytes of a file of the view of a query; raises as `Desk.ask`."""
        return self._files.ask(name=name, query=query, time=time)


def _exchanged(process: subprocess.Popen[bytes], seconds: float, asked: Any = None) -> Any:
    """Return what a process says next, after it is asked something; end it if that fails.

    Raises TimeoutError if there was nothing after that time, Ended if the process ended before.
    """
    questions: Any = process.stdin
    answers: Any = process.stdout
    end = monotonic() + seconds
    limit = Timer(seconds, process.kill)
    limit.daemon = True
    limit.start()
    try:
        if asked is not None:
            pickle.dump(asked, questions)
            questions.flush()
        return pickle.load(answers)
    except (OSError, EOFError, ValueError, pickle.UnpicklingError):  # ValueError: it was closed
        _end(process)
        raise (Ended if monotonic() < end else TimeoutError) from None
    finally:
        limit.cancel()


def _end(process: subprocess.Popen[bytes] | None) -> None:
    if process is not None:
        process.kill()
        process.wait()
        for pipe in (process.stdin, process.stdout):
            with suppress(OSError):  # there is nobody to take what is left
                pipe.close()  # type: ignore[union-attr]


def work(task: str, seconds: float) -> None:
    """Do a kind of work in this process, for each question on standard input until that ends."""
    if hasattr(os, "nice"):
        os.nice(10)  # answers of the page go first
    answers = os.fdopen(os.dup(sys.stdout.fileno()), "wb")
    os.dup2(sys.stderr.fileno(), sys.stdout.fileno())  # nobody else writes among the answers
    do, asked = TASKS[task]
    answer = do(**asked)  # loads all that it needs
    _limit_memory()
    with suppress(EOFError):
        while True:
            pickle.dump(answer, answers)
            answers.flush()
            asked = pickle.load(sys.stdin.buffer)
            faulthandler.dump_traceback_later(ORPHAN_FACTOR * seconds, exit=True)
            answer = _done(do, asked)
            faulthandler.cancel_dump_traceback_later()


def _done(do: Callable[..., Any], asked: dict[str, Any]) -> Any:
    """Return what comes of a question, or the error that it ends with."""
    try:
        return do(**asked)
    except (Refused, Busy) as error:
        return error
    except InputError as error:
        return Refused("", str(error))
    except MemoryError:
        return Refused("", f"file: it takes more than {WORK_MEMORY >> 20} MB of memory")
    except Exception as error:
        return RuntimeError(f"{type(error).__name__}: {error}")


def _fit(**asked: str) -> dict[str, Any]:
    from carom.page import uploads

    return uploads.answer(asked)


def _file(name: str, query: str, time: float) -> bytes:
    from carom.page import files
    from carom.page.views import View

    file = files.write(name, View.of(query), time, Path.cwd())
    content = file.read_bytes()
    file.unlink()
    return content


TASKS: dict[str, tuple[Callable[..., Any], dict[str, Any]]] = {  # each with a first question
    "fit": (_fit, {"data": "kharaz2001"}),
    "file": (_file, {"name": "history.png", "query": "", "time": 0.5}),
}


def _limit_memory() -> None:
    try:
        import resource
    except ImportError:  # on Windows
        return
    if MEMORY_PAGES.exists():
        now = int(MEMORY_PAGES.read_text().split()[0]) * resource.getpagesize()
        with suppress(OSError, ValueError):  # a stricter limit may be there already
            resource.setrlimit(resource.RLIMIT_AS, (now + WORK_MEMORY, resource.RLIM_INFINITY))
