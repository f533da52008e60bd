"""What a request may take of the page: every limit, and how those wait who want the same."""

from threading import BoundedSemaphore
from typing import Any

LONGEST_LINK = 4000  # characters
LARGEST_UPLOAD = 1_000_000  # bytes
MOST_ROWS = 2000  # of an upload
LARGEST_REQUEST = 2 * LARGEST_UPLOAD  # a file travels in more characters than it has

FIT_SECONDS = 20.0  # that an upload may be read and fitted; 2000 rows take two
FILE_SECONDS = 30.0  # that a file of a view may take, contact laws in it among them
WORK_MEMORY = 1 << 30  # bytes, besides what a process that fits or writes has before
START_SECONDS = 300.0  # until such a process is ready; it may have to compile

LAW_SECONDS = 20.0  # that contact laws are waited for; the slowest takes five, at chi = 10
FOLLOWERS = 16  # requests that wait for contact laws; the latest count

WAITING = 4  # requests that wait until another's upload is fitted, or its file written
WAITING_SECONDS = 20.0  # that they do

CONNECTIONS = 200  # at once
QUEUED = 128  # connections that are not accepted yet: a burst of so many drives nobody out
REQUEST_SECONDS = 60.0  # from the connection until the answer is taken


class Busy(RuntimeError):
    """Others keep the page busy with what is asked for."""

    said = "the page is busy; try again"

    def __init__(self) -> None:
        super().__init__(self.said)


class Turns:
    """Work that one request does at a time; some wait for it, and Busy is raised for the rest."""

    def __init__(self) -> None:
        self._places = BoundedSemaphore(1 + WAITING)
        self._turn = BoundedSemaphore(1)

    def __enter__(self) -> None:
        if not self._places.acquire(blocking=False):
            raise Busy
        if not self._turn.acquire(timeout=WAITING_SECONDS):
            self._places.release()
            raise Busy

    def __exit__(self, *_: Any) -> None:
        self._turn.release()
        self._places.release()
