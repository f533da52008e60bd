"""How long the page of `carom explore` waits for its program, over random moves of its sliders.

It asks whether the theory holds, and for contact laws; all else it computes by itself, as
benchmarks/explorer_browser.py measures.

python benchmarks/explorer.py            medians and 95 % of each kind of view
python benchmarks/explorer.py --smoke    a quick pass through the same code
"""

import argparse
import http.client
import json
import threading
import time
from urllib.parse import urlencode, urlsplit

import numpy as np

from carom.page import explorer
from carom.verify.entries import CATALOGUE

SEED = 20261122
LAWS = ("mindlin", "YADE Mindlin", "Walton & Braun")
ALL = tuple(entry.label for entry in CATALOGUE)
BODIES = {"given": "bodies", "material": "steel", "against": "half-space", "radius": 5.0}
KINDS = {
    "whether the theory holds": (BODIES, (), True),
    "three laws, other bodies each time": (BODIES, LAWS, True),
    "three laws, the same bodies": (BODIES, LAWS, False),
    "all laws, other bodies each time": (BODIES, ALL, True),
    "three laws, numbers": ({"given": "numbers"}, LAWS, False),
    "three laws, with losses": (BODIES | {"restitution": 0.8}, LAWS, True),
}
TRIES = 3  # of a question


class Page:
    """What the browser sends when a control moves, on one connection."""

    def __init__(self, url: str, patience: float = 60.0) -> None:
        self._line = http.client.HTTPConnection(urlsplit(url).netloc, timeout=patience)

    def verdict(self, query: str) -> list[dict[str, str]]:
        """Return the findings on the theory of a view."""
        return json.loads(self.file(f"/verdict?{query}"))["findings"]

    def laws(self, query: str) -> list[str]:
        """Return the names of the contact laws of a view once they are solved."""
        return [law["label"] for law in json.loads(self.file(f"/laws?{query}"))["laws"]]

    def upload(self, contents: str) -> None:
        """Ask for the fit of a file, to the bodies of the page."""
        file = {"contents": contents, "name": "measured.csv", "bodies": "given=bodies"}
        status, found = self._ask("POST", "/fit", json.dumps(file))
        assert status == 200, found

    def file(self, path: str) -> bytes:
        """Return what is at an address."""
        status, found = self._ask("GET", path)
        assert status == 200, found
        return found

    def close(self) -> None:
        """Let the connection go."""
        self._line.close()

    def _ask(self, method: str, path: str, body: str | None = None) -> tuple[int, bytes]:
        """Ask, and ask again as the page does, if the connection was refused or closed."""
        for left in range(TRIES - 1, -1, -1):
            try:
                self._line.request(method, path, body, {"Content-Type": "application/json"})
                answer = self._line.getresponse()
                found = answer.status, answer.read()
                if answer.status != 503 or not left:
                    return found
            except (OSError, http.client.HTTPException):
                self._line.close()
                if not left:
                    raise
            time.sleep(0.3)
        raise AssertionError


def moved(start: dict, laws: tuple[str, ...], bodies: bool, random: np.random.Generator) -> str:
    """Return the query of a view with its sliders somewhere."""
    sliders = {
        "angle": round(random.uniform(0.0, 89.0), 2),
        "speed": round(random.uniform(0.05, 10.0), 2),
        "spin": round(random.uniform(-1000.0, 1000.0)),
        "friction": round(random.uniform(0.05, 1.0), 3),
        "psi": round(random.uniform(0.0, 10.0), 2),
        "chi": round(random.uniform(0.5, 3.0), 3),
    }
    if bodies:
        sliders |= {"against": "sphere", "second_radius": round(random.uniform(1.0, 50.0), 3)}
        sliders |= {"second_material": random.choice(["brass", "pmma", "alumina", "rubber"])}
    return urlencode([*(start | sliders).items(), *(("law", law) for law in laws)])


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--smoke", action="store_true", help="only to see that it runs")
    moves = 5 if parser.parse_args().smoke else 60
    served = explorer(port=0)
    serving = threading.Thread(target=served.serve)
    serving.start()
    try:
        page, random = Page(served.url), np.random.default_rng(SEED)
        for path in ("/fit?data=kharaz2001", "/history.png"):
            page.file(path)  # once the processes that fit and that write files are there
        for kind, (start, laws, bodies) in KINDS.items():
            times = []
            for _ in range(moves):
                query = moved(start, laws, bodies, random)
                begin = time.perf_counter()
                assert page.laws(query) if laws else page.verdict(query)
                times.append(1e3 * (time.perf_counter() - begin))
            middle, most = np.percentile(times, [50, 95])
            print(f"{kind:36s} {middle:6.1f} ms, 95 % within {most:6.1f} ms")
    finally:
        served.stop()
        serving.join()


if __name__ == "__main__":
    main()
