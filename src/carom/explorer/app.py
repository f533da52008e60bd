"""The page as a web application: one server, no other host, never a traceback."""

import logging
from typing import Any

from dash import Dash, set_props as set_on_page
from flask import Flask, Response, abort, request
from werkzeug.exceptions import HTTPException

from carom.explorer.answers import connect_answers
from carom.explorer.controls import connect_controls
from carom.explorer.downloads import add_downloads
from carom.explorer.layout import page
from carom.explorer.limits import LARGEST_REQUEST, Busy
from carom.explorer.measures import connect_measures
from carom.explorer.worker import Worker
from carom.quantities.refusals import InputError

OWN_HOST_ONLY = (
    "default-src 'self'; script-src 'self' 'unsafe-inline' 'unsafe-eval'; "
    "style-src 'self' 'unsafe-inline'; img-src 'self' data: blob:; font-src 'self' data:; "
    "object-src 'none'; base-uri 'none'; form-action 'self'; frame-ancestors 'none'"
)
HEADERS = {
    "Content-Security-Policy": OWN_HOST_ONLY,
    "Referrer-Policy": "no-referrer",
    "X-Content-Type-Options": "nosniff",
}

UPDATES, PARTS, ANY_OTHER = (  # of dash
    "/_dash-update-component",
    "/_dash-component-suites/",
    "/<path:path>",
)

LOGGED = 300  # characters of what went wrong

log = logging.getLogger(__name__)


def new_app(worker: Worker, hosts: list[str] | None = None) -> Dash:
    """Return the application, which answers to these names of hosts only, None for all."""
    server: Any = Flask(__name__)
    server.config["MAX_CONTENT_LENGTH"] = LARGEST_REQUEST
    server.config["TRUSTED_HOSTS"] = hosts
    app = Dash(
        __name__,
        server=server,
        title="Carom explorer",
        update_title="",
        on_error=_told_on_page,
        enable_mcp=False,
        meta_tags=[{"name": "viewport", "content": "width=device-width, initial-scale=1"}],
        index_string=INDEX,
    )
    app.layout = page
    connect_controls(app)
    connect_answers(app)
    connect_measures(app, worker)
    add_downloads(server)
    server.register_error_handler(Exception, _one_line)
    server.before_request(_refuse_unknown)
    server.after_request(_guarded)
    return app


def _told_on_page(error: Exception) -> None:
    if isinstance(error, InputError | Busy):
        set_on_page("notice", {"children": str(error)})
        return
    log.error("%s: %s", type(error).__name__, error)
    set_on_page("notice", {"children": f"failed, {type(error).__name__}"})


def _refuse_unknown() -> None:
    """Refuse addresses that dash would answer with the page."""
    if request.url_rule is not None and request.url_rule.rule == ANY_OTHER:
        abort(404)


def _one_line(error: Exception) -> Response:
    """Return an error of a request as one line of text."""
    if isinstance(error, InputError):
        return _text(str(error), 400)
    if isinstance(error, Busy):
        return _text(str(error), 503)
    if isinstance(error, HTTPException):
        return _text(f"{error.code}: {error.name}", error.code or 500)
    if request.path.startswith(PARTS):
        return _text("404: Not Found", 404)
    log.error("%s: %s", type(error).__name__, " ".join(str(error).split())[:LOGGED])
    if request.path == UPDATES:  # what callbacks raise is told on the page
        return _text("400: this is no request of the page", 400)
    return _text(f"failed, {type(error).__name__}", 500)


def _text(line: str, status: int) -> Response:
    return Response(f"carom: {line}\n", status, content_type="text/plain; charset=utf-8")


def _guarded(response: Response) -> Response:
    response.headers.update(HEADERS)
    return response


INDEX = """<!DOCTYPE html>
<html lang="en">
  <head>
    {%metas%}
    <title>{%title%}</title>
    {%favicon%}
    {%css%}
  </head>
  <body>
    {%app_entry%}
    <noscript>This page computes and draws with JavaScript; switch it on.</noscript>
    <footer>{%config%}{%scripts%}{%renderer%}</footer>
  </body>
</html>
"""
