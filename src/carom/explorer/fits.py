"""Fits that the page asks for: of data sets that come along, and of a user's file."""

from typing import Any

from flask import Flask, Response, jsonify, request

from carom.datasets.shipped import names
from carom.explorer.refused import Refused
from carom.explorer.worker import Worker

SENT = ("contents", "name", "bodies")


def add_fits(server: Flask, worker: Worker) -> None:
    """Let the server answer with a fit at /fit: of ?data=NAME, or of a file that is sent there."""
    known: dict[str, dict[str, Any]] = {}

    def shipped() -> Response:
        name = request.args.get("data", "")
        if name not in names():
            raise Refused("data", f"must be one of {', '.join(names())}")
        if name not in known:
            known[name] = worker.fit(data=name)
        return jsonify(known[name])

    def sent() -> Response:
        given = request.get_json(silent=True)
        if not isinstance(given, dict) or not all(isinstance(given.get(n), str) for n in SENT):
            raise Refused("", "file: it did not arrive; choose it again")
        return jsonify(worker.fit(**{name: given[name] for name in SENT}))

    server.add_url_rule("/fit", "fit_of_data", shipped)
    server.add_url_rule("/fit", "fit_of_file", sent, methods=["POST"])
