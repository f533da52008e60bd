"""How requests are handled: without a line on the terminal for each."""

from typing import Any

from werkzeug.serving import WSGIRequestHandler


class Quiet(WSGIRequestHandler):
    """A handler that keeps connections open and tells of errors only."""

    protocol_version = "HTTP/1.1"
    timeout = 60  # seconds that an idle connection is kept

    def log_request(self, code: Any = "-", size: Any = "-") -> None:
        """Say nothing."""

    def log(self, type: str, message: str, *args: Any) -> None:
        """Say nothing of a browser that went away."""
