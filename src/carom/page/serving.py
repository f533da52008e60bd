"""The page on a port of this machine: no request holds up the others."""

import logging
import socket
from dataclasses import dataclass, field
from math import inf
from time import time
from typing import Any

from flask import Flask
from waitress.channel import HTTPChannel
from waitress.server import TcpWSGIServer

from carom.page.address import DEFAULT_PORT, LOOPBACK, listening, url_of
from carom.page.app import new_app
from carom.page.limits import (
    IDLE_SECONDS,
    LARGEST_HEAD,
    LARGEST_REQUEST,
    MOST_CONNECTIONS,
    MOST_QUEUED,
    THREADS,
)
from carom.page.overlays import followers
from carom.page.page import kernels
from carom.page.worker import Worker
from carom.quantities.refusals import InputError

OWN_NAMES = [LOOPBACK, "localhost", "::1"]
LOADED_SECONDS = 3.0  # in which a page is there; only then others take a processor
SENT_AT_ONCE = 1 << 17  # bytes of an answer that are sent, or tried to be sent, at a time


class Connection(HTTPChannel):  # type: ignore[misc]
    """A connection; since when it waits for its request, or for its answer to be taken."""

    def __init__(self, *arguments: Any, **more: Any) -> None:
        super().__init__(*arguments, **more)
        self.sendbuf_len = SENT_AT_ONCE

    def service(self) -> None:
        """Answer a request."""
        super().service()
        if not self.requests:
            self.creation_time = time()


class Server(TcpWSGIServer):  # type: ignore[misc]
    """waitress, which lets no connection wait for others that are slow.

    A request occupies a thread once all of it is there, until its answer is known. If too many
    other connections are open, the oldest are closed: those that have waited the longest for their
    request, or for their answer to be taken.
    """

    channel_class = Connection

    def __init__(self, app: Flask, bound: socket.socket) -> None:
        logging.getLogger("waitress").setLevel(logging.CRITICAL)  # browsers come and go
        self._stopped = False
        settings: dict[str, Any] = {
            "threads": THREADS,
            "backlog": MOST_QUEUED,
            "channel_timeout": IDLE_SECONDS,
            "connection_limit": 2 * MOST_CONNECTIONS,  # the other half is at work
            "max_request_header_size": LARGEST_HEAD,
            "max_request_body_size": 2 * LARGEST_REQUEST,  # less is refused in a line
            "outbuf_high_watermark": 1 << 40,  # answers wait in files, not in their threads
            "ident": None,
        }
        place = bound.family, bound.type, bound.proto, bound.getsockname()
        super().__init__(app, _sock=bound, sockinfo=place, bind_socket=False, **settings)

    def handle_accept(self) -> None:
        """Accept connections, of a flood so many at a time that they cannot close each other."""
        for _ in range(MOST_CONNECTIONS // 2):
            before = len(self.active_channels)
            super().handle_accept()
            if len(self.active_channels) == before:
                return

    def add_task(self, task: Any) -> None:
        """Let the request of a connection be answered, which does not wait meanwhile."""
        task.creation_time = inf
        super().add_task(task)

    def serve(self) -> None:
        """Answer until `stop`, or an interrupt."""
        while not self._stopped:
            waiting = [each for each in self.active_channels.values() if each.creation_time < inf]
            waiting.sort(key=lambda each: each.creation_time)
            for each in waiting[:-MOST_CONNECTIONS]:
                each.handle_close()
            self.asyncore.loop(timeout=1.0, use_poll=True, map=self._map, count=1)

    def stop(self) -> None:
        """Let `serve`, which runs in another thread, return."""
        self._stopped = True
        self.pull_trigger()

    def end(self) -> None:
        """Close all connections, and let threads go that have nothing to do."""
        for channel in list(self.active_channels.values()):
            channel.handle_close()
        self.close()
        self.task_dispatcher.shutdown(timeout=0)


@dataclass(frozen=True)
class Explorer:
    """The page, ready to be served at `url`."""

    url: str
    _server: Server = field(repr=False)
    _worker: Worker = field(repr=False)

    def serve(self) -> None:
        """Answer until `stop`, or an interrupt."""
        try:
            self._server.serve()
        finally:
            self.close()

    def stop(self) -> None:
        """Let `serve`, which runs in another thread, return."""
        self._server.stop()

    def close(self) -> None:
        """Give the port back, of a page that is not served."""
        self._server.end()
        self._worker.close()
        followers.dismiss()


def explorer(*, host: str = LOOPBACK, port: int = DEFAULT_PORT) -> Explorer:
    """Return the page to explore impacts, bound to a port of this machine.

    Parameters
    ----------
    host : str
        Address to listen at; by default only this machine can ask.
    port : int
        Port to listen at, 0 for any that is free.

    Raises
    ------
    InputError
        If flask or plotly is not installed, the port is no port or taken, or the address is not one
        of this machine.

    Examples
    --------
    >>> from carom.page import explorer
    >>> page = explorer(port=0)
    >>> page.url.startswith("http://127.0.0.1:")
    True
    >>> page.close()
    """
    return serving(listening(host, port), host)


def serving(bound: socket.socket, host: str) -> Explorer:
    """Return the page on a socket that listens."""
    try:
        kernels()
    except InputError:
        bound.close()
        raise
    worker = Worker()
    server = Server(new_app(worker, OWN_NAMES if host in OWN_NAMES else None), bound)
    worker.start(LOADED_SECONDS)
    return Explorer(url_of(bound, host), server, worker)
