"""Processes of their own for heavy work that might never end, killed at its time limit."""

import json
import subprocess
import sys
from base64 import b64decode
from contextlib import suppress
from os.path import abspath
from tempfile import TemporaryDirectory
from threading import Lock, Timer
from time import monotonic
from typing import Any

from carom.explorer.limits import FILE_SECONDS, FIT_SECONDS, START_SECONDS, Busy, Turns
from carom.explorer.refused import Refused

PROGRAM = """\
import json, os, sys
if hasattr(os, "nice"):
    os.nice(10)  # answers of the page go first
sys.path[:] = json.loads(sys.argv[1])
from carom.explorer.tasks import answer_lines
answer_lines(sys.argv[2], float(sys.argv[3]))
"""
READY = {"ready": True}
LATE = {
    "fit": "file: fitting it takes longer than {:g} s; leave out what is not needed, or use "
    "carom fit",
    "file": "file: it takes longer than {:g} s to write; choose fewer contact laws",
}


class Ended(Busy):
    """A process ended before it answered."""

    said = "the process that works for the page has ended; try again"


class Desk:
    """A process that does one kind of work, one piece at a time.

    Python code that holds the interpreter cannot be ended from within, and holds up every thread
    of its process; the time limit is sure as the whole process is killed, and started anew. It ends
    with this one, even if that is killed.
    """

    def __init__(self, task: str, seconds: float) -> None:
        self._task = task
        self._seconds = seconds
        self._turns = Turns()
        self._guard = Lock()
        self._process: subprocess.Popen[str] | None = None
        self._folder: TemporaryDirectory[str] | None = None
        self._ready = self._closed = False

    def start(self) -> None:
        """Let the process start if there is none, without waiting until it is ready."""
        with self._guard:
            if self._closed or (self._process is not None and self._process.poll() is None):
                return
            if self._process is not None:
                _end(self._process)
            if self._folder is None:
                self._folder = TemporaryDirectory(prefix="carom-")
            paths = json.dumps([abspath(path) for path in sys.path])
            self._process = subprocess.Popen(
                [sys.executable, "-c", PROGRAM, paths, self._task, str(self._seconds)],
                cwd=self._folder.name,
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=subprocess.DEVNULL,
                text=True,
                encoding="utf-8",
                start_new_session=True,  # an interrupt from the keyboard is not for it
            )
            self._ready = False

    def close(self) -> None:
        """End the process; none is started any more."""
        with self._guard:
            self._closed = True
            if self._process is not None:
                _end(self._process)
            if self._folder is not None:
                self._folder.cleanup()

    def ask(self, **asked: Any) -> dict[str, Any]:
        """Return what the process answers.

        Raises Refused, for what takes too long as well, Busy if others wait already, or if the
        process is killed twice, and RuntimeError if it fails.
        """
        question = json.dumps(asked) + "\n"
        with self._turns:
            try:
                answer = self._answer(question)
            except Ended:  # killed, perhaps by the system for want of memory: once more
                answer = self._answer(question)
        if "failed" in answer:
            raise RuntimeError(answer["failed"])
        if "busy" in answer:
            raise Busy
        if "refused" in answer:
            raise Refused(answer.get("field", ""), answer["refused"])
        return answer

    def _answer(self, question: str) -> dict[str, Any]:
        """Return what the process answers; if there is nothing, another takes its place."""
        self.start()
        process = self._process
        try:
            if self._closed or process is None:
                raise Busy
            if not self._ready:
                self._ready = _exchanged(process, START_SECONDS) == READY
            return _exchanged(process, self._seconds, question)
        except (TimeoutError, Ended) as error:
            if self._closed or process is None:
                raise Busy from None
            _end(process)
            self.start()
            if isinstance(error, TimeoutError):
                raise Refused("", LATE[self._task].format(self._seconds)) from None
            raise


class Worker:
    """What the page leaves to others: fits in one process, files in another."""

    def __init__(self, fit_seconds: float = FIT_SECONDS, file_seconds: float = FILE_SECONDS):
        self._fits = Desk("fit", fit_seconds)
        self._files = Desk("file", file_seconds)

    def start(self) -> None:
        """Let both processes start, without waiting until they are ready."""
        self._files.start()
        self._fits.start()

    def close(self) -> None:
        """End both processes; none is started any more."""
        self._files.close()
        self._fits.close()

    def fit(self, **asked: str) -> dict[str, Any]:
        """Return a fit as `uploads.answer` does; raises as `Desk.ask`."""
        return self._fits.ask(**asked)

    def file(self, name: str, query: str, time: float) -> bytes:
        """Return a file of the view of a query; raises as `Desk.ask`."""
        return b64decode(self._files.ask(name=name, query=query, time=time)["content"])


def _exchanged(
    process: subprocess.Popen[str], seconds: float, question: str = ""
) -> dict[str, Any]:
    """Return what the process writes next.

    Raises TimeoutError if it was killed after that time, Ended if it ended before.
    """
    assert process.stdin is not None
    assert process.stdout is not None
    end = monotonic() + seconds
    limit = Timer(seconds, process.kill)
    limit.daemon = True
    limit.start()
    try:
        process.stdin.write(question)
        process.stdin.flush()
        found: dict[str, Any] = json.loads(process.stdout.readline())
    except (OSError, ValueError):
        if monotonic() < end:
            raise Ended from None
        raise TimeoutError from None
    finally:
        limit.cancel()
    return found


def _end(process: subprocess.Popen[str]) -> None:
    process.kill()
    process.wait()
    for pipe in (process.stdin, process.stdout):
        with suppress(OSError):  # there is nobody to take what is left
            pipe.close()  # type: ignore[union-attr]
