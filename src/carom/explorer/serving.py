"""The page on a port of this machine."""

import socket
from dataclasses import dataclass, field
from errno import EADDRNOTAVAIL

from carom.explorer.app import new_app
from carom.explorer.connections import Server
from carom.explorer.limits import QUEUED
from carom.explorer.overlays import followers
from carom.explorer.page import plotly_file
from carom.explorer.warming import Warming
from carom.explorer.worker import Worker
from carom.quantities.refusals import InputError, refusal

LOOPBACK = "127.0.0.1"
OWN_NAMES = [LOOPBACK, "localhost", "::1", "[::1]"]
PORT = 8050
PORTS = 65535


@dataclass(frozen=True)
class Explorer:
    """The page, ready to be served at `url`."""

    url: str
    _server: Server = field(repr=False)
    _worker: Worker = field(repr=False)
    _warming: Warming = field(repr=False)

    def serve(self) -> None:
        """Answer until `stop`, or an interrupt."""
        try:
            self._server.serve_forever()
        finally:
            self.close()

    def stop(self) -> None:
        """Let `serve`, which runs in another thread, return."""
        self._server.shutdown()

    def close(self) -> None:
        """Give the port back, of a page that is not served."""
        self._server.server_close()
        self._worker.close()
        self._warming.stop()
        followers.dismiss()


def explorer(*, host: str = LOOPBACK, port: int = PORT) -> Explorer:
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
    >>> from carom.explorer import explorer
    >>> page = explorer(port=0)
    >>> page.url.startswith("http://127.0.0.1:")
    True
    >>> page.close()
    """
    if isinstance(port, bool) or not isinstance(port, int) or not 0 <= port <= PORTS:
        allowed = f"must be a whole number from 0 to {PORTS}; 0 takes any that is free"
        raise refusal("port", port, allowed)
    if not host:
        raise refusal("host", host, "must be an address, e.g. 127.0.0.1; 0.0.0.0 is every one")
    plotly_file()
    with _bound(host, port) as listening:
        worker, warming = Worker(), Warming()
        app = new_app(worker, warming, OWN_NAMES if host in OWN_NAMES else None)
        server = Server(host, listening.getsockname()[1], app, listening.fileno())
        warming.start()
        worker.start()
    shown = {"0.0.0.0": LOOPBACK, "::": "[::1]"}.get(host, f"[{host}]" if ":" in host else host)
    return Explorer(f"http://{shown}:{server.port}/", server, worker, warming)


def _bound(host: str, port: int) -> socket.socket:
    """Return a socket that listens, or raise InputError."""
    family = socket.AF_INET6 if ":" in host else socket.AF_INET
    found = socket.socket(family, socket.SOCK_STREAM)
    try:
        found.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        found.bind((host, port))
        found.listen(QUEUED)
    except OSError as error:
        found.close()
        if isinstance(error, socket.gaierror) or error.errno == EADDRNOTAVAIL:
            allowed = "is no address of this machine; 127.0.0.1 is, and 0.0.0.0 is every one"
            raise refusal("host", host, allowed) from None
        reason = error.strerror or str(error)
        raise InputError(
            f"port: {port} at {host!r} cannot be listened at, {reason.lower()}; "
            "take another, or 0 for any that is free"
        ) from None
    return found
