"""The page as a web application: one server, no other host, never a traceback."""

import json
import logging
from functools import cache
from io import BytesIO
from pathlib import Path
from typing import Any
from urllib.parse import parse_qs, urlsplit

from flask import Flask, Response, abort, request, send_file, send_from_directory
from werkzeug.exceptions import HTTPException

from carom.lab.datasets.shipped import names as dataset_names
from carom.page import outcomes, overlays
from carom.page.limits import LARGEST_REQUEST, Busy
from carom.page.page import KERNELS, kernels as script_of_kernels, page, plotly_file
from carom.page.scripts import script
from carom.page.views import FIELDS, Refused, View, read_number
from carom.page.worker import Worker
from carom.quantities.refusals import InputError
from carom.quantities.texts import Unreadable, read_text
from carom.quantities.units import or_none

OWN_HOST_ONLY = (
    "default-src 'self'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self' 'unsafe-inline'; "
    "img-src 'self' data: blob:; font-src 'self' data:; object-src 'none'; base-uri 'none'; "
    "form-action 'self'; frame-ancestors 'none'"
)  # plotly writes styles; the solver is compiled for browsers
HEADERS = {
    "Content-Security-Policy": OWN_HOST_ONLY,
    "Referrer-Policy": "no-referrer",
    "X-Content-Type-Options": "nosniff",
}
PICTURES = ("curve", "history", "contact", "course")
WRITTEN_FILES = (  # of a view, which take time
    *("template.csv", "history.csv", "history.nc"),
    *(f"{picture}.{kind}" for picture in PICTURES for kind in ("png", "svg", "pdf")),
)
UPLOADED = ("contents", "name", "bodies", "columns")
ASSETS = Path(__file__).with_name("assets")
ANSWERED_IN_JSON = ("/verdict", "/laws", "/number", "/fit")  # whose errors are JSON, of others text
FILM = (-0.6, 1.6)  # durations of the contact, as in clock.js
MOST_LOGGED = 300  # characters

log = logging.getLogger(__name__)


def new_app(worker: Worker, hosts: list[str] | None = None) -> Flask:
    """Return the application, which answers to these names of hosts only, None for all."""
    server = Flask(__name__, static_folder=None)
    server.config["MAX_CONTENT_LENGTH"] = LARGEST_REQUEST
    _add_parts(server)
    _add_answers(server)
    _add_files(server, worker)
    _add_fits(server, worker)
    if hosts is not None:
        server.before_request(lambda: None if _host() in hosts else abort(400))
    server.register_error_handler(Exception, _one_line)
    server.after_request(_guarded)
    return server


def _host() -> str | None:
    """Return the name by which the page was asked for, of IPv6 as well."""
    try:
        return urlsplit(f"//{request.headers.get('Host', '')}").hostname
    except ValueError:
        return None


def _add_parts(server: Flask) -> None:
    """Add the page, and what it is made of: a browser keeps it, and asks whether it is the same."""
    html = cache(page)

    @server.get("/")
    def home() -> Response:
        return Response(html(), content_type="text/html; charset=utf-8")

    @server.get("/assets/<name>")
    def asset(name: str) -> Response:
        return send_from_directory(ASSETS, name)

    @server.get(f"/assets/{KERNELS}")
    def kernels() -> Response:
        answer = Response(script_of_kernels(), content_type="text/javascript; charset=utf-8")
        answer.add_etag()
        answer.cache_control.no_cache = True
        answer.make_conditional(request)
        return answer

    @server.get("/plotly.min.js")
    def plotly() -> Response:
        return send_file(plotly_file())


def _add_answers(server: Flask) -> None:
    """Add what is asked of a view."""

    @server.get("/verdict")
    def verdict() -> Response:
        return _json({"findings": outcomes.verdict(View.of(_query()))})

    @server.get("/laws")
    def laws() -> Response:
        return _json(overlays.laws(View.of(_query())))

    @server.get("/number")
    def number() -> Response:
        name = request.args.get("name", "")
        if name not in FIELDS or not FIELDS[name].is_number:
            abort(404)
        return _json({"value": or_none(read_number(name, request.args.get("text", "")))})


def _add_files(server: Flask, worker: Worker) -> None:
    """Add files of a view, at /history.csv and so on, ?... as in a link."""

    @server.get("/<name>")
    def file(name: str) -> Response:
        if name not in ("view.py", *WRITTEN_FILES):
            abort(404)
        view, time = View.of(_query()), _time_of(_query())
        if name == "view.py":
            content = script(view, time).encode()
        else:
            content = worker.file(name, view.query(), time)
        return send_file(BytesIO(content), as_attachment=True, download_name=name)


def _time_of(query: str) -> float:
    """Return the time in a link, within the film, as a share of the contact's duration."""
    text = parse_qs(query).get("time", ["0.5"])[-1]
    try:
        return min(max(read_text(text, "1"), FILM[0]), FILM[1])
    except Unreadable:
        raise Refused("", "time: must be a share of the duration, e.g. 0.5") from None


def _add_fits(server: Flask, worker: Worker) -> None:
    """Add fits of a data set that comes along, ?data=NAME, and of a file that is sent."""
    shipped = cache(lambda name: worker.fit(data=name))

    @server.get("/fit")
    def fit_of_data() -> Response:
        name = request.args.get("data", "")
        if name not in dataset_names():
            raise Refused("data", f"must be one of {', '.join(dataset_names())}")
        return _json(shipped(name))

    @server.post("/fit")
    def fit_of_file() -> Response:
        sent = request.get_json(silent=True)
        if not isinstance(sent, dict) or not all(isinstance(sent.get(n), str) for n in UPLOADED):
            raise Refused("", "file: it did not arrive; choose it again")
        return _json(worker.fit(**{name: sent[name] for name in UPLOADED}))


def _query() -> str:
    return request.query_string.decode("ascii", "replace")


def _json(answer: Any, status: int = 200) -> Response:
    content = json.dumps(answer, ensure_ascii=False, allow_nan=False, separators=(",", ":"))
    return Response(content.encode("utf-8", "replace"), status, content_type="application/json")


def _one_line(error: Exception) -> Response:
    """Return an error of a request in a line, with the field that it is about."""
    if isinstance(error, Refused):
        return _refusal(error.field, error.message, **error.more)
    if isinstance(error, InputError):  # of the library, which begins with what it is about
        name, _, rest = str(error).partition(": ")
        return _refusal(name, rest) if name in FIELDS else _refusal("", str(error))
    if isinstance(error, Busy):
        return _refusal("", str(error), 503)
    if isinstance(error, RecursionError) and request.is_json:
        return _line("what was sent is nested too deeply", 400)
    if isinstance(error, HTTPException):
        return _line(f"{error.code}: {error.name}", error.code or 500)
    log.error("%s: %s", type(error).__name__, " ".join(str(error).split())[:MOST_LOGGED])
    return _line(f"failed, {type(error).__name__}", 500)


def _refusal(field: str, message: str, status: int = 400, **more: Any) -> Response:
    """Return what is told of a question that is refused, which is no fault of the page.

    The page gets it with the status of an answer, as browsers log all others as errors.
    """
    if request.path in ANSWERED_IN_JSON:
        return _json({"field": field, "message": message, **more})
    return _line(f"{FIELDS[field].label}: {message}" if field else message, status)


def _line(message: str, status: int) -> Response:
    if request.path in ANSWERED_IN_JSON:
        return _json({"field": "", "message": message}, status)
    content = f"carom: {message}\n".encode("utf-8", "replace")
    return Response(content, status, content_type="text/plain; charset=utf-8")


def _guarded(response: Response) -> Response:
    response.headers.update(HEADERS)
    return response
