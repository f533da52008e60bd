"""Files of a view, each at an address of its own; those that take time are written elsewhere."""

from collections.abc import Callable
from pathlib import PurePath
from urllib.parse import parse_qs

from flask import Flask, Response, request

from carom.explorer.refused import Refused
from carom.explorer.scripts import script
from carom.explorer.views import View
from carom.explorer.worker import Worker
from carom.quantities.texts import Unreadable, read_text

KINDS = {
    ".csv": "text/csv; charset=utf-8",
    ".nc": "application/x-netcdf",
    ".png": "image/png",
    ".svg": "image/svg+xml",
    ".pdf": "application/pdf",
    ".py": "text/x-python; charset=utf-8",
}
PICTURES = ("curve", "history", "contact", "course")
WRITTEN = (
    *("template.csv", "history.csv", "history.nc"),
    *(f"{picture}.{kind}" for picture in PICTURES for kind in ("png", "svg", "pdf")),
)


def add_files(server: Flask, worker: Worker) -> None:
    """Let the server answer with files of a view at /history.csv and so on, ?... as in a link."""

    def lines(query: str) -> bytes:
        return script(View.of(query), time_of(query)).encode()

    def written(name: str) -> Callable[[str], bytes]:
        return lambda query: worker.file(name, View.of(query).query(), time_of(query))

    _add(server, "view.py", lines)
    for name in WRITTEN:
        _add(server, name, written(name))


def _add(server: Flask, name: str, content: Callable[[str], bytes]) -> None:
    def answer() -> Response:
        query = request.query_string.decode("ascii", "replace")
        attached = {"Content-Disposition": f"attachment; filename={name}"}
        kind = KINDS[PurePath(name).suffix]
        return Response(content(query), headers=attached, content_type=kind)

    server.add_url_rule(f"/{name}", name, answer)


def time_of(query: str) -> float:
    """Return the time in a link, within the contact, as a share of its duration."""
    text = parse_qs(query).get("time", ["0.5"])[-1]
    try:
        return min(max(read_text(text, "1"), 0.0), 1.0)
    except Unreadable:
        raise Refused("", "time: must be a share of the duration, e.g. 0.5") from None
