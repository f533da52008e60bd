"""Where the page is: a port that listens, while what answers there is still being loaded."""

import socket
from errno import EADDRNOTAVAIL
from importlib.util import find_spec

from carom.page.limits import MOST_QUEUED
from carom.quantities.refusals import InputError, refusal

LOOPBACK = "127.0.0.1"
DEFAULT_PORT = 8050
LARGEST_PORT = 65535
PACKAGES = ("flask", "waitress", "plotly")


def require() -> None:
    """Raise InputError if a package is missing."""
    for name in PACKAGES:
        if find_spec(name) is None:
            hint = "pip install 'carom[explore]'"
            raise InputError(f"the explorer needs the package {name}; {hint}")


def listening(host: str, port: int) -> socket.socket:
    """Return a socket that listens, or raise InputError."""
    require()
    if isinstance(port, bool) or not isinstance(port, int) or not 0 <= port <= LARGEST_PORT:
        allowed = f"must be a whole number from 0 to {LARGEST_PORT}; 0 takes any that is free"
        raise refusal("port", port, allowed)
    if not host:
        raise refusal("host", host, "must be an address, e.g. 127.0.0.1; 0.0.0.0 is every one")
    bound = socket.socket(socket.AF_INET6 if ":" in host else socket.AF_INET)
    try:
        bound.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        bound.bind((host, port))
        bound.listen(MOST_QUEUED)
    except OSError as error:
        bound.close()
        if isinstance(error, socket.gaierror) or error.errno == EADDRNOTAVAIL:
            allowed = "is no address of this machine; 127.0.0.1 is, and 0.0.0.0 is every one"
            raise refusal("host", host, allowed) from None
        reason = (error.strerror or str(error)).lower()
        raise InputError(
            f"port: {port} at {host!r} cannot be listened at, {reason}; "
            "take another, or 0 for any that is free"
        ) from None
    return bound


def url_of(bound: socket.socket, host: str) -> str:
    """Return the address of the page."""
    shown = {"0.0.0.0": LOOPBACK, "::": "[::1]"}.get(host, f"[{host}]" if ":" in host else host)
    return f"http://{shown}:{bound.getsockname()[1]}/"
