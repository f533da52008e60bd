"""The page in a real browser: one server and one Chromium for all tests, a fresh visitor for each.

Every visit ends with the console free of errors and warnings and no other host asked.
"""

import json
import re
import shutil
import subprocess
import sys
import time
from urllib.parse import urlsplit

import pytest

BROWSERS = ("chromium", "chromium-browser", "google-chrome")
COMMAND = [sys.executable, "-c", "from carom.cli import run; run()", "explore"]
PATIENCE = 8.0  # s
READY = "document.querySelector('#results table') && window.Carom && Carom.scene.data()"


class Visit:
    """A page of the explorer in a browser of its own."""

    def __init__(self, context, address, query, ready):
        self.address = address
        self.trouble = []
        self.page = context.new_page()
        self.page.on("console", self._heard)
        self.page.on("pageerror", lambda error: self.trouble.append(f"page error: {error}"))
        self.page.on("request", self._asked)
        self.response = self.page.goto(f"{address}{query}")
        if ready:
            self.page.wait_for_function(READY, timeout=30_000)
            self.until(lambda: self.traces("rebounds"))

    def _heard(self, message):
        if message.type in ("error", "warning"):
            self.trouble.append(f"console {message.type}: {message.text}")

    def _asked(self, request):
        parts = urlsplit(request.url)
        if parts.scheme not in ("data", "blob") and parts.netloc != urlsplit(self.address).netloc:
            self.trouble.append(f"another host was asked: {request.url}")

    def until(self, check):
        """Return what check returns once it is true and raises nothing, or fail with why not."""
        end = time.monotonic() + PATIENCE
        while True:
            try:
                found = check()
                assert found, "not so in time"
                return found
            except Exception:
                if time.monotonic() > end:
                    raise
            self.page.wait_for_timeout(30)

    def link(self):
        """Return the query of the link that the page offers."""
        return urlsplit(self.page.input_value("#link")).query

    def linked(self, word):
        """Wait until the link holds these words, or does not: "!angle"."""
        wanted, word = not word.startswith("!"), word.lstrip("!")
        self.until(lambda: (word in self.link()) == wanted)

    def result(self, name):
        """Return the words of a row of the results."""
        row = self.page.locator("#results tr").filter(has=self.page.get_by_text(name, exact=True))
        return row.locator("td").inner_text()

    def number(self, name):
        """Return the number that a row of the results begins with."""
        return float(re.match(r"[-+\d.eE]+", self.result(name).replace("\N{MINUS SIGN}", "-"))[0])

    def notice(self):
        """Return what the page complains of, empty if of nothing."""
        lines = self.page.locator(".carom-head [role=alert]").all_inner_texts()
        return "; ".join(filter(None, lines))

    def traces(self, chart):
        """Return the traces of a chart by their names, as plotly drew them."""
        words = (
            "id => { const plot = document.querySelector(`#${id} .js-plotly-plot`);"
            " return plot && plot._fullData && plot.querySelector('.main-svg')"
            " ? plot._fullData.map(t => ({name: t.name, mode: t.mode,"
            " x: Array.from(t.x), y: Array.from(t.y)})) : []; }"
        )
        return {(t["name"], t["mode"]): t for t in self.page.evaluate(words, chart)}

    def choose(self, name, option):
        """Choose from a list as a mouse does."""
        control = self.page.locator(f"#{name}")
        if control.evaluate("element => element.tagName") == "SELECT":
            control.select_option(label=option)
            return
        control.click()
        self.page.get_by_role("option", name=option, exact=True).locator("visible=true").click()

    def pixels(self, canvas):
        """Return the picture of a canvas as text."""
        return self.page.evaluate(f"document.getElementById('{canvas}').toDataURL()")


@pytest.fixture(scope="session")
def address():
    """The address of `carom explore`."""
    pytest.importorskip("dash", reason="the explorer needs dash: pip install 'carom[explore]'")
    arguments = [*COMMAND, "--no-open", "--port", "0", "--json"]
    with subprocess.Popen(arguments, stdout=subprocess.PIPE, text=True) as server:
        try:
            yield json.loads(server.stdout.readline())["url"]
        finally:
            server.terminate()


@pytest.fixture(scope="session")
def chromium():
    """A browser."""
    drive = pytest.importorskip("playwright.sync_api", reason="playwright is not installed")
    path = next(filter(None, map(shutil.which, BROWSERS)), None)
    if path is None:
        pytest.skip("no Chromium on this machine: apt-get install chromium")
    with drive.sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=path, args=["--no-sandbox"])
        yield browser
        browser.close()


@pytest.fixture(scope="session")
def contexts(chromium):
    """Browsers' memories by width and scheme: what one visit has loaded, the next has."""
    known = {}

    def context(width, scheme, fresh):
        if fresh or (width, scheme) not in known:
            size = {"width": width, "height": 900}
            known[width, scheme] = chromium.new_context(viewport=size, color_scheme=scheme)
        return known[width, scheme]

    return context


@pytest.fixture
def visit(address, contexts):
    """Open the page with a query; fresh: in a browser that was never here."""
    visits = []

    def open_page(query="", *, width=1280, scheme="light", fresh=False, ready=True):
        visits.append(Visit(contexts(width, scheme, fresh), address, query, ready))
        return visits[-1]

    yield open_page
    trouble = [line for each in visits for line in each.trouble]
    for each in visits:
        each.page.close()
    assert trouble == []
