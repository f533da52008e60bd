"""What the page of `carom explore` makes others wait while it is attacked, beside its usual time.

Attacks: uploads of which one cell never ends and tables as long as they may be; ever new
connections that send a byte now and then, or take no byte of their answer; pictures without pause;
contact laws at the largest chi. A usual visitor moves sliders before and meanwhile.

python benchmarks/explorer_attack.py            ratios of medians and of the slowest answers
python benchmarks/explorer_attack.py --smoke    a quick pass through the same code
"""

import argparse
import json
import socket
import subprocess
import sys
import threading
import time
from base64 import b64encode
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from http.client import HTTPException
from itertools import count
from urllib.parse import urlencode, urlsplit

import numpy as np
from explorer import BODIES, Page, moved

from carom import datasets

SEED = 20261123
COMMAND = [sys.executable, "-c", "from carom.cli import run; run()", "explore"]
SLOW, NEW = 300, 20  # connections of a thread, and how many of them are new every 0.1 s
EASY = f"data:text/csv;base64,{b64encode(datasets.path('kharaz2001').read_bytes()).decode()}"
HEAD = b"GET / HTTP/1.1\r\nHost: localhost\r\n"
BODY = b"POST /fit HTTP/1.1\r\nHost: localhost\r\nContent-Length: 1000000\r\n\r\n"
LARGE = b"GET /plotly.min.js HTTP/1.1\r\n"
STARTS = (HEAD, BODY, LARGE + b"Host: localhost\r\n\r\n")
ROWS = "\n".join(f"{1 + row % 80},{0.2 + row % 7 / 10}" for row in range(2000))
TABLES = ("9**9**9 deg,0.1\n10,0.2\n20,0.3", ROWS)


@contextmanager
def served() -> Iterator[str]:
    """Serve the page in a process of its own, at the address that is returned."""
    arguments = [*COMMAND, "--no-open", "--port", "0", "--json"]
    with subprocess.Popen(arguments, stdout=subprocess.PIPE, text=True) as server:
        assert server.stdout is not None
        try:
            yield json.loads(server.stdout.readline())["url"]
        finally:
            server.terminate()


@contextmanager
def attacked(url: str, kind: str) -> Iterator[None]:
    """Attack the page at this address, from a process of its own."""
    with subprocess.Popen([sys.executable, __file__, "--attack", kind, url]) as attackers:
        try:
            yield
        finally:
            attackers.kill()


def attack(url: str, kinds: list[Callable[[str, int], None]]) -> None:
    """Attack for ever, each kind of attack in two threads."""
    for row in range(2):
        for kind in kinds:
            threading.Thread(target=repeated, args=(kind, url, row)).start()


def repeated(kind: Callable[[str, int], None], url: str, row: int) -> None:
    """Attack again whenever the page refuses or closes."""
    while True:
        with suppress(OSError, HTTPException, AssertionError):
            kind(url, row)
        time.sleep(0.05)


def upload(url: str, row: int) -> None:
    """Upload hostile tables, and ask again soon."""
    table = f"angle [deg],contact_restitution\n{TABLES[row % 2]}\n"
    contents = f"data:text/csv;base64,{b64encode(table.encode()).decode()}"
    Page(url, patience=1.0).upload(contents)


def dribble(url: str, row: int) -> None:
    """Hold many connections that hardly send or take anything; open new ones for those closed."""
    place = urlsplit(url)
    held: list[socket.socket] = []
    starts = count(row)
    while True:
        time.sleep(0.1)
        for each in held[:]:
            try:
                each.sendall(b"a")
            except OSError:
                held.remove(each)
                each.close()
        for _ in range(min(NEW, SLOW - len(held))):
            held.append(socket.create_connection((place.hostname, place.port or 80), 1.0))
            held[-1].sendall(STARTS[next(starts) % len(STARTS)])


def draw(url: str, row: int) -> None:
    """Download pictures without pause."""
    Page(url, patience=5.0).file(f"/history.png?angle={10 + time.time() % 70}")


def follow(url: str, row: int) -> None:
    """Ask for the slowest contact law, at the largest chi."""
    view = {"given": "numbers", "chi": 10 - time.time() % 1, "law": "Walton & Braun"}
    Page(url, patience=0.5).laws(urlencode(view))


KINDS: dict[str, list[Callable[[str, int], None]]] = {
    "hostile uploads": [upload],
    "slow connections": [dribble],
    "pictures": [draw],
    "contact laws": [follow],
    "all at once": [upload, dribble, draw, follow],
}


def answers(url: str, moves: int, random: np.random.Generator) -> list[float]:
    """Return how long a usual visitor waits for each answer, in ms."""
    times = []
    for _ in range(moves):
        query = moved(BODIES, (), False, random)
        begin = time.perf_counter()
        Page(url, patience=60.0).verdict(query)
        times.append(1e3 * (time.perf_counter() - begin))
        time.sleep(0.02)
    return times


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--smoke", action="store_true", help="only to see that it runs")
    parser.add_argument("--attack", nargs=2, metavar=("KIND", "URL"), help="attack a page for ever")
    asked = parser.parse_args()
    if asked.attack:
        kind, url = asked.attack
        attack(url, KINDS[kind])
    else:
        for kind in KINDS:
            measure(kind, 3 if asked.smoke else 100)


def measure(kind: str, moves: int) -> None:
    """Print how a usual visitor is answered before an attack and meanwhile."""
    random = np.random.default_rng(SEED)
    with served() as url:
        Page(url).upload(EASY)  # once the process for uploads is there
        before = answers(url, moves, random)
        with attacked(url, kind):
            time.sleep(2.0)
            during = answers(url, moves, random)
    usual, middle, ratio = np.median(before), np.median(during), max(during) / max(before)
    print(
        f"{kind:18s} {usual:6.1f} ms before, {middle:6.1f} ms meanwhile: {middle / usual:5.2f};"
        f" slowest {max(before):6.1f} and {max(during):6.1f} ms: {ratio:5.2f}",
        flush=True,
    )


if __name__ == "__main__":
    main()
