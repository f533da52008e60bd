"""Requests that are slow, many or garbled hold up no others; no browser."""

import socket
import threading
import time

import pytest

pytest.importorskip("flask")

from flask import Flask, request

from carom.page import serving
from carom.page.limits import LARGEST_HEAD, LARGEST_REQUEST
from carom.page.serving import Server

PATIENCE = 20.0  # s
GET = b"GET / HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n"
POST = b"POST / HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\nContent-Length: "
SENT = POST + b"4\r\n\r\nwhat"
LARGE = GET.replace(b"/ ", b"/large ", 1)
ENDLESS = b"GET / HTTP/1.1\r\nHost: localhost\r\nX: "
BODY = POST + b"1000\r\n\r\n"
SIZE = 16_000_000  # bytes, more than a connection holds on its way
LARGE_BODY = 2 * LARGEST_REQUEST


@pytest.fixture
def slow():
    """Whether the application is to take its time: it waits until this is set."""
    event = threading.Event()
    event.set()
    return event


@pytest.fixture
def port(slow, monkeypatch):
    """A server for four connections and as many requests at a time."""
    monkeypatch.setattr(serving, "MOST_CONNECTIONS", 4)
    monkeypatch.setattr(serving, "THREADS", 4)
    app = Flask("small")

    @app.route("/", methods=["GET", "POST"])
    def answer():
        slow.wait(PATIENCE)
        return f"told {request.get_data(as_text=True)}"

    @app.route("/large")
    def large():
        return b"a" * SIZE

    server = Server(app, socket.create_server(("127.0.0.1", 0)))
    thread = threading.Thread(target=server.serve)
    thread.start()
    yield server.effective_port
    server.stop()
    thread.join(PATIENCE)
    assert not thread.is_alive()
    server.end()


def opened(port, sent):
    actual = socket.create_connection(("127.0.0.1", port), PATIENCE)
    actual.sendall(sent)
    return actual


def received(connection):
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
    """However many there are, and though they send another byte now and then."""
    held = [opened(port, start) for _ in range(12)]
    for each in held[8:]:
        each.sendall(b"a")
    assert received(opened(port, GET)).endswith(b"told ")
    assert received(opened(port, SENT)).endswith(b"told what")
    for each in held[:8]:
        each.settimeout(1.0)
        assert received(each) == b""
    for each in held[8:]:
        each.close()


def test_answers_that_are_not_taken_give_way_to_new_ones(port):
    """They occupy no thread meanwhile, of which there are four."""
    held = []
    for _ in range(8):
        held.append(opened(port, LARGE))
        assert held[-1].recv(1) == b"H"  # the answer is on its way
    time.sleep(0.5)
    assert received(opened(port, GET)).endswith(b"told ")
    cut = [len(received(each)) < SIZE for each in held]
    assert 2 <= sum(cut) < 8  # those that had waited the longest, four where all were known by then


def test_requests_at_work_are_not_closed_and_others_wait_for_them(port, slow):
    slow.clear()
    working = [opened(port, GET) for _ in range(7)]
    time.sleep(0.5)
    slow.set()
    for each in working:
        assert received(each).endswith(b"told ")


def test_a_client_that_goes_away_takes_nothing_with_it(port, slow):
    slow.clear()
    for sent in (GET, SENT, LARGE, BODY):
        opened(port, sent).close()
    slow.set()
    assert received(opened(port, GET)).endswith(b"told ")


CHUNKS = b"POST / HTTP/1.1\r\nHost: localhost\r\nTransfer-Encoding: chunked\r\n\r\n"


@pytest.mark.parametrize(
    ("sent", "status"),
    [
        (b"GET http://[ HTTP/1.1\r\nHost: localhost\r\n\r\n", None),
        *((ENDLESS.ljust(LARGEST_HEAD, b"a"), 431), (b"what is this\r\n\r\n", 400)),
        *((POST + b"-4\r\n\r\n", 400), (POST + b"%d\r\n\r\n" % LARGE_BODY, 413)),
        (CHUNKS + b"%x\r\n" % (1 << 40) + b"a" * LARGE_BODY, 413),
        (CHUNKS + b"this is no chunk\r\n", 400),
    ],
    ids=range(7),
)
def test_garbled_and_large_requests_are_refused(port, sent, status, capfd):
    actual = received(opened(port, sent))
    assert actual[8:13] == (b" %d " % status if status else b"")
    assert b"Traceback" not in actual
    assert capfd.readouterr().err == ""
    assert received(opened(port, GET)).endswith(b"told ")
