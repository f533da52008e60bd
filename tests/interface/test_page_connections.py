"""Connections to the page that are slow, many or garbled cannot keep others out; no browser."""

import socket
import threading
import time
from contextlib import suppress

import pytest

pytest.importorskip("flask")

from flask import Flask, request

from carom.explorer import connections
from carom.explorer.connections import Server

PATIENCE = 20.0  # s
GET = b"GET / HTTP/1.1\r\nHost: localhost\r\n\r\n"
SENT = b"POST / HTTP/1.1\r\nHost: localhost\r\nContent-Length: 4\r\n\r\nwhat"
LARGE = b"GET /large HTTP/1.1\r\nHost: localhost\r\n\r\n"
ENDLESS = b"GET / HTTP/1.1\r\nHost: localhost\r\nX: "
BODY = b"POST / HTTP/1.1\r\nHost: localhost\r\nContent-Length: 1000\r\n\r\n"


@pytest.fixture
def slow():
    """Whether the application is to take its time: it waits until this is set."""
    found = threading.Event()
    found.set()
    return found


@pytest.fixture
def seconds(request):
    """How long a connection has; a minute unless a test says otherwise."""
    return getattr(request, "param", 60.0)


@pytest.fixture
def port(slow, seconds, monkeypatch):
    """A server for four connections."""
    monkeypatch.setattr(connections, "CONNECTIONS", 4)
    monkeypatch.setattr(connections, "REQUEST_SECONDS", seconds)
    app = Flask("small")

    @app.route("/", methods=["GET", "POST"])
    def answer():
        slow.wait(PATIENCE)
        return f"told {request.get_data(as_text=True)}"

    @app.route("/large")
    def large():
        slow.wait(PATIENCE)
        return b"a" * 50_000_000  # more than a connection holds on its way

    with socket.create_server(("127.0.0.1", 0)) as listening:
        server = Server("127.0.0.1", listening.getsockname()[1], app, listening.fileno())
    serving = threading.Thread(target=server.serve_forever, args=(0.01,))
    serving.start()
    yield server.port
    server.shutdown()
    serving.join(PATIENCE)


def opened(port, sent):
    found = socket.create_connection(("127.0.0.1", port), PATIENCE)
    found.sendall(sent)
    return found


def told(connection):
    """Return all that a connection says until it is closed."""
    parts = []
    with connection:
        while True:
            try:
                part = connection.recv(1 << 16)
            except ConnectionResetError:
                part = b""
            if not part:
                return b"".join(parts)
            parts.append(part)


@pytest.mark.parametrize("start", [b"", ENDLESS, BODY, b"GET / HT"])
def test_slow_connections_give_way_to_new_ones(port, start):
    held = [opened(port, start) for _ in range(12)]
    begin = time.monotonic()
    assert told(opened(port, GET)).endswith(b"told ")
    assert told(opened(port, SENT)).endswith(b"told what")
    assert time.monotonic() - begin < PATIENCE
    for each in held[:8]:  # the oldest were closed, long before their time was over
        each.settimeout(1.0)
        assert told(each) == b""
    for each in held[8:]:
        each.close()


def test_answers_that_are_not_taken_give_way_to_new_ones(port):
    held = []
    for _ in range(4):
        held.append(opened(port, LARGE))
        assert held[-1].recv(1) == b"H"  # the answer is on its way
    assert told(opened(port, GET)).endswith(b"told ")
    sizes = [len(told(each)) for each in held]
    assert sizes[0] < 50_000_000 < min(sizes[1:])  # the first had waited the longest


def test_an_answer_that_begins_outlasts_connections_that_came_meanwhile(port, slow):
    slow.clear()
    working = opened(port, LARGE)
    held = [opened(port, ENDLESS) for _ in range(3)]
    time.sleep(0.5)
    slow.set()
    assert working.recv(1) == b"H"
    assert told(opened(port, GET)).endswith(b"told ")
    assert told(held[0]) == b""
    assert len(told(working)) > 50_000_000
    for each in held[1:]:
        each.close()


@pytest.mark.parametrize("seconds", [2.0], indirect=True)
def test_a_connection_has_its_time(port):
    """It is closed then, however often it sends another byte."""
    with opened(port, ENDLESS) as drip:
        begin = time.monotonic()
        with suppress(OSError):
            while time.monotonic() - begin < PATIENCE:
                drip.sendall(b"a")
                time.sleep(0.1)
        assert 1.5 < time.monotonic() - begin < 10.0


def test_the_page_is_busy_if_all_are_at_work(port, slow):
    slow.clear()
    working = [opened(port, GET) for _ in range(4)]
    time.sleep(0.5)
    refused = told(opened(port, GET))
    slow.set()
    assert refused.startswith(b"HTTP/1.1 503 ")
    assert refused.endswith(b"carom: the page is busy; try again\n")
    for each in working:
        assert told(each).endswith(b"told ")
    assert told(opened(port, GET)).endswith(b"told ")


CHUNKS = b"POST / HTTP/1.1\r\nHost: localhost\r\nTransfer-Encoding: chunked\r\n\r\n"


@pytest.mark.parametrize(
    ("sent", "status"),
    [
        (b"GET http://[ HTTP/1.1\r\nHost: localhost\r\n\r\n", 400),
        (b"GET /" + b"a" * 70_000 + b" HTTP/1.1\r\n\r\n", 414),
        (b"GET / HTTP/1.1\r\n" + b"X: a\r\n" * 200 + b"\r\n", 431),
        (b"GET / HTTP/1.1\r\nX: " + b"a" * 70_000 + b"\r\n\r\n", 431),
        (b"GET / HTTP/9.9\r\n\r\n", 505),
        (b"what is this\r\n\r\n", 400),
        (b"GET / HTTP/1.1\r\nHost: localhost\r\nContent-Length: -4\r\n\r\n", 200),
        (b"GET / HTTP/1.1\r\nHost: localhost\r\nContent-Length: many\r\n\r\n", 200),
        (CHUNKS + b"4\r\nwhat\r\n0\r\n\r\n", 200),
        (CHUNKS + b"this is no chunk\r\n", 200),
        (CHUNKS + b"-1\r\n", 200),
    ],
    ids=range(11),
)
def test_garbled_requests_are_answered_in_a_line(port, sent, status, capfd):
    found = told(opened(port, sent))
    bare = f"carom: {status}: "  # before a version of HTTP is agreed on
    assert found.startswith((f"HTTP/1.1 {status} ".encode(), bare.encode()))
    last = found.rpartition(b"\r\n\r\n")[2]
    assert last.count(b"\n") <= 1
    assert b"Traceback" not in found
    assert capfd.readouterr().err == ""
    assert told(opened(port, GET)).endswith(b"told ")
