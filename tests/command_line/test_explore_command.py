"""`carom explore` as a user starts and ends it; its refusals. No browser is needed."""

import json
import signal
import socket
import subprocess
import sys
import threading
import time
import urllib.error
import urllib.request

import pytest

pytest.importorskip("flask", reason="the explorer needs flask: pip install 'carom[explore]'")

from carom import InputError
from carom.page import Explorer, explorer, page as page_of_carom, serving

HEARS = "import signal; signal.signal(signal.SIGINT, signal.default_int_handler)"  # in jobs, too
START = f"{HEARS}; from carom.cli import run; run()"
COMMAND = [sys.executable, "-c", START, "explore", "--no-open"]


@pytest.fixture(scope="module")
def page():
    actual = explorer(port=0)
    serving = threading.Thread(target=actual.serve)
    serving.start()
    yield actual
    actual.stop()
    serving.join(timeout=10)


@pytest.mark.parametrize(
    ("flags", "words"),
    [
        (["--port", "99999"], "port: '99999' cannot be used; must be a whole number from 0"),
        (["--port", "-1"], "port: '-1' cannot be used"),
        (["--host", "203.0.113.7", "--port", "0"], "'203.0.113.7' cannot be used"),
        (["--host", "no such host", "--port", "0"], "'no such host' cannot be used"),
        (["--host", "", "--port", "0"], "host: '' cannot be"),
    ],
)
def test_refusals(refusal, monkeypatch, flags, words):
    monkeypatch.setattr(Explorer, "serve", lambda page: pytest.fail(f"it serves at {page.url}"))
    assert words in refusal("explore", "--no-open", *flags)


def test_a_port_that_is_taken(refusal):
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]
        line = refusal("explore", "--no-open", "--port", port)
    assert f"port: {port}" in line
    assert "take another" in line


def test_a_page_without_its_kernels(run, monkeypatch, tmp_path):
    monkeypatch.setattr(page_of_carom, "FOLDER", tmp_path)
    monkeypatch.setattr(serving, "kernels", page_of_carom.kernels.__wrapped__)  # not kept
    code, _, told = run("explore", "--no-open", "--port", "0")
    assert code == 2
    assert told == "carom: the explorer needs the kernels for browsers; install carom again\n"


@pytest.mark.parametrize("port", [True, "8050", 80.5, None])
def test_ports_that_are_none(port):
    with pytest.raises(InputError, match=r"port: .* whole number from 0 to 65535"):
        explorer(port=port)


def port_of(url):
    return int(url.rstrip("/").rpartition(":")[2])


def test_only_this_machine_is_answered(page):
    """Nothing listens at the port on an address of this machine that others know it by."""
    port = port_of(page.url)
    assert page.url == f"http://127.0.0.1:{port}/"
    with socket.socket(socket.AF_INET, socket.SOCK_STREAM) as other:
        other.settimeout(2.0)
        assert other.connect_ex(("127.0.0.2", port)) != 0
    with urllib.request.urlopen(page.url, timeout=10) as answer:
        assert answer.status == 200


def test_an_address_of_ipv6():
    try:
        actual = explorer(host="::1", port=0)
    except InputError:
        pytest.skip("this machine has no IPv6")
    serving = threading.Thread(target=actual.serve)
    serving.start()
    with urllib.request.urlopen(actual.url, timeout=10) as answer:
        assert answer.status == 200
    actual.stop()
    serving.join(timeout=10)


@pytest.mark.slow
@pytest.mark.parametrize("end", ["SIGINT", "SIGTERM", "SIGKILL"])
def test_an_end_is_one_at_once_and_leaves_no_process_behind(end):
    """Whatever is at work; those that fit and write files go even if nobody is left to end them.

    Ctrl-C, which the page tells people to press, is no failure.
    """
    psutil = pytest.importorskip("psutil")
    arguments = [*COMMAND, "--port", "0", "--json"]
    pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE}
    with subprocess.Popen(arguments, text=True, **pipes) as server:
        url = json.loads(server.stdout.readline())["url"]
        with urllib.request.urlopen(url, timeout=10) as answer:
            assert b"Carom" in answer.read()
        helpers, late = [], time.monotonic() + 30.0  # they start once the page is there
        while len(helpers) < 2 and time.monotonic() < late:
            time.sleep(0.1)
            helpers = psutil.Process(server.pid).children(recursive=True)
        with socket.create_connection(("127.0.0.1", port_of(url))) as asking:
            asking.sendall(b"GET /course.png HTTP/1.1\r\nHost: localhost\r\n\r\n")
            server.send_signal(getattr(signal, end))
            server.wait(timeout=10)
        assert server.stderr.read() == ""
    assert server.returncode == {"SIGINT": 0, "SIGTERM": 143, "SIGKILL": -9}[end]
    psutil.wait_procs(helpers, timeout=60)  # they may have to load, or compile, first
    assert len(helpers) == 2
    assert not any(helper.is_running() for helper in helpers)
    with pytest.raises(urllib.error.URLError):
        urllib.request.urlopen(url, timeout=2)
