"""Connections to the page: so many at once, none for ever, and none that holds up others."""

import logging
import socket
import sys
from collections.abc import Iterable, Iterator
from contextlib import contextmanager, suppress
from http import HTTPStatus
from io import BytesIO
from threading import Lock
from time import monotonic
from typing import Any
from urllib.parse import urlsplit

from flask import Flask
from werkzeug.serving import ThreadedWSGIServer, WSGIRequestHandler

from carom.explorer.limits import CONNECTIONS, LARGEST_REQUEST, REQUEST_SECONDS, Busy

log = logging.getLogger(__name__)
REFUSED = f"HTTP/1.1 503 Service Unavailable\r\nConnection: close\r\n\r\ncarom: {Busy()}\n"


class Handler(WSGIRequestHandler):
    """A handler of one request that tells of errors in a line."""

    protocol_version = "HTTP/1.1"
    timeout = REQUEST_SECONDS
    error_message_format = "carom: %(code)d: %(message)s\n"
    error_content_type = "text/plain; charset=utf-8"

    def run_wsgi(self) -> None:
        """Answer a request whose head has arrived."""
        try:
            urlsplit(self.path)
        except ValueError:
            self.send_error(HTTPStatus.BAD_REQUEST, "this is no address")
            return
        super().run_wsgi()

    def log_request(self, code: Any = "-", size: Any = "-") -> None:
        """Say nothing."""

    def log(self, type: str, message: str, *args: Any) -> None:
        """Say nothing of a browser that went away."""


class Server(ThreadedWSGIServer):
    """A server that answers each connection in a thread, and closes those that keep it waiting.

    A connection is at work once its request has arrived whole, until there is an answer. If there
    are `CONNECTIONS`, one that is not at work is closed for a new one: the one that has waited the
    longest for its request, or for its answer to be taken, so that many slow ones cannot keep
    others out.
    """

    def __init__(self, host: str, port: int, app: Flask, listening: int) -> None:
        self._app = app
        self._guard = Lock()
        self._since: dict[socket.socket, float] = {}  # open ones, the longest waiting first
        self._at_work: set[socket.socket] = set()
        super().__init__(host, port, self._answer, Handler, fd=listening)

    def process_request(self, request: Any, client_address: Any) -> None:
        """Answer a connection in a thread, or refuse it if all others are at work."""
        if self._admitted(request):
            super().process_request(request, client_address)
            return
        with suppress(OSError):
            request.sendall(REFUSED.encode())
        self.shutdown_request(request)

    def _admitted(self, request: socket.socket) -> bool:
        with self._guard:
            if len(self._since) >= CONNECTIONS:
                waiting = next((each for each in self._since if each not in self._at_work), None)
                if waiting is None:
                    return False
                self._drop(waiting)
            self._since[request] = monotonic()
            return True

    def _drop(self, connection: socket.socket) -> None:
        """Close a connection, of which the thread ends as it can neither read nor write."""
        del self._since[connection]
        with suppress(OSError):
            connection.shutdown(socket.SHUT_RDWR)

    def service_actions(self) -> None:
        """Close connections that have had their time; called twice a second and more."""
        with self._guard:
            late = monotonic() - REQUEST_SECONDS
            for each in [each for each, since in self._since.items() if since < late]:
                self._drop(each)

    def shutdown_request(self, request: Any) -> None:
        """Forget and close a connection."""
        with self._guard:
            self._since.pop(request, None)
            self._at_work.discard(request)
        super().shutdown_request(request)

    def handle_error(self, request: Any, client_address: Any) -> None:
        """Say in a line what went wrong with a connection."""
        error = sys.exc_info()[1]
        if isinstance(error, OSError):  # it was closed meanwhile
            return
        log.error("%s: %s", type(error).__name__, " ".join(str(error).split()))

    def _answer(self, environ: dict[str, Any], start_response: Any) -> Iterable[bytes]:
        connection = environ["werkzeug.socket"]
        _take_body(environ)
        if connection not in self._since:
            raise ConnectionAbortedError  # it was closed before all had arrived
        with self._working(connection):
            return self._app(environ, start_response)

    @contextmanager
    def _working(self, connection: socket.socket) -> Iterator[None]:
        self._at_work.add(connection)
        try:
            yield
        finally:
            with self._guard:
                self._at_work.discard(connection)
                if connection in self._since:  # its answer begins to wait
                    self._since[connection] = self._since.pop(connection)


def _take_body(environ: dict[str, Any]) -> None:
    """Read what a request carries, as far as it is allowed; none if it does not arrive."""
    try:
        length = int(environ.get("CONTENT_LENGTH") or 0)
        if environ.get("wsgi.input_terminated"):  # it comes in chunks
            length = LARGEST_REQUEST + 1
        if length <= LARGEST_REQUEST + 1:  # otherwise it is refused unread
            environ["wsgi.input"] = BytesIO(environ["wsgi.input"].read(max(0, length)))
    except (OSError, ValueError):
        environ["wsgi.input"] = BytesIO()
        environ["CONTENT_LENGTH"] = "0"
