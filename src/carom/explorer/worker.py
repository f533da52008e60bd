"""A process of its own for work that might never end, killed at its time limit."""

import json
import subprocess
import sys
from contextlib import suppress
from os.path import abspath
from tempfile import TemporaryDirectory
from threading import Lock, Timer
from time import monotonic
from typing import Any

from carom.explorer.limits import FIT_SECONDS, START_SECONDS, Busy, Turns
from carom.quantities.refusals import InputError

PROGRAM = """\
import json, os, sys
if hasattr(os, "nice"):
    os.nice(10)  # answers of the page go first
sys.path[:] = json.loads(sys.argv[1])
from carom.explorer.uploads import answer_lines
answer_lines()
"""
READY = {"ready": True}


class Worker:
    """A process that fits uploads one at a time; it ends with this one, even if that is killed.

    Python code that holds the interpreter cannot be ended from within, and holds up every thread
    of its process; the time limit is sure as the whole process is killed, and started anew.
    """

    def __init__(self) -> None:
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
            if self._folder is None:
                self._folder = TemporaryDirectory(prefix="carom-")
            self._process = subprocess.Popen(
                [sys.executable, "-c", PROGRAM, json.dumps([abspath(path) for path in sys.path])],
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

    def fit(self, query: str, contents: str, name: str) -> dict[str, Any]:
        """Return what `uploads.fit_of_upload` returns.

        Raises InputError, for what takes too long as well, Busy if others wait already, and
        RuntimeError if it fails.
        """
        asked = {"query": query, "contents": contents, "name": name}
        with self._turns:
            answer = self._answer(json.dumps(asked) + "\n")
        if "failed" in answer:
            raise RuntimeError(answer["failed"])
        if "refused" in answer:
            raise InputError(answer["refused"])
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
            return _exchanged(process, FIT_SECONDS, question)
        except (InputError, RuntimeError):
            if self._closed or process is None:
                raise Busy from None
            _end(process)
            self.start()
            raise


def _exchanged(
    process: subprocess.Popen[str], seconds: float, question: str = ""
) -> dict[str, Any]:
    """Return what the process writes next.

    Raises InputError if it was killed after that time, RuntimeError if it ended.
    """
    assert process.stdin is not None
    assert process.stdout is not None
    end = monotonic() + seconds
    limit = Timer(seconds, process.kill)
    limit.start()
    try:
        process.stdin.write(question)
        process.stdin.flush()
        found: dict[str, Any] = json.loads(process.stdout.readline())
    except (OSError, ValueError):
        if monotonic() < end:
            raise RuntimeError("the process that fits has ended") from None
        allowed = "leave out what is not needed, or use carom fit"
        raise InputError(f"file: fitting it takes longer than {seconds:g} s; {allowed}") from None
    finally:
        limit.cancel()
    return found


def _end(process: subprocess.Popen[str]) -> None:
    process.kill()
    process.wait()
    for pipe in (process.stdin, process.stdout):
        with suppress(OSError):  # there is nobody to take what is left
            pipe.close()  # type: ignore[union-attr]
