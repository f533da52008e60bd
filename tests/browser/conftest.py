"""The page in a real browser: one server and one Chromium for all tests, mostly one tab.

Loading the page takes a while, nearly all of it in plotly. So a visit opens its link in the tab
that is there, as the browser's buttons for back and forward do, unless it asks to load the page.
Every test ends with the console free of errors and warnings and no other host asked.
"""

import json
import re
import shutil
import subprocess
import sys
import time
from urllib.parse import urlsplit

import pytest

import carom

BROWSERS = ("chromium", "chromium-browser", "google-chrome")
COMMAND = [sys.executable, "-c", "from carom.cli import run; run()", "explore"]
PATIENCE = 30.0  # s, on a machine that does other things too
PREPARED = 300.0  # s; without its library Carom compiles first
FULL = "level=full"
REDUCED = "reduce"  # motion
READY = "document.querySelector('#results table') && window.Carom && Carom.page.answers()[0]"
BETWEEN = "?angle=1.5&friction=0.05"  # no test begins here
CHARTED = "Carom.tabs.chosen() === 'Charts' && Carom.level.isFull()"
CHART = "document.querySelector('#rebounds .js-plotly-plot')?._fullData"
TRAVEL = f"""query => {{
  const top = Object.assign(document.createElement("i"), {{ tabIndex: -1 }});
  document.body.prepend(top);
  top.focus(); // from where the tab key goes on
  top.remove();
  scrollTo(0, 0);
  window.left = Carom.page.scenes[0];
  window.drawn = {CHART};
  history.pushState({{}}, "", query);
  dispatchEvent(new Event("popstate"));
}}"""


class Visit:
    """A page of the explorer in a tab of a browser."""

    def __init__(self, browser, address):
        self.address = address
        self.trouble = []
        self.page = browser.new_context(reduced_motion=REDUCED).new_page()
        self.page.on("console", self._heard)
        self.page.on("pageerror", lambda error: self.trouble.append(f"page error: {error}"))
        self.page.on("request", self._asked)
        self._moving = False

    def moves(self, welcome):
        """Let the browser say whether motion is welcome; where it is not, the film stands."""
        if self._moving and not welcome:
            self.page.evaluate("Carom.clock.pause()")
        if self._moving != welcome:
            self.page.emulate_media(reduced_motion="no-preference" if welcome else REDUCED)
        self._moving = welcome

    def load(self, query, ready):
        """Load the page."""
        self.page.goto(f"{self.address}{query}")
        if ready:
            self.until(lambda: self.page.evaluate(f"Boolean({READY})"), PREPARED)
            self.until(self._drawn)

    def travel(self, query):
        """Go to a link within the page, and wait for its charts.

        From a tab without charts it goes by way of another link, as there is no chart to change.
        """
        charts = self.page.evaluate(CHARTED)
        for where in (query or "?",) if charts else (BETWEEN, query or "?"):
            self.page.evaluate(TRAVEL, where)
            self.until(lambda: self.page.evaluate("Carom.page.scenes[0] !== window.left"))
        self.until(self._drawn)

    def _drawn(self):
        """Tell whether the chart shows the impact, if it is to be seen."""
        if not self.page.evaluate(CHARTED):
            return True
        if not self.page.evaluate(f"{CHART} !== window.drawn"):
            return False
        at = self.page.evaluate("Carom.page.answers()[0].curve.at")
        traces = self.traces("rebounds")
        return traces if at is None else traces["this impact", "markers"]["x"] == at[:1]

    def _heard(self, message):
        if message.type in ("error", "warning"):
            self.trouble.append(f"console {message.type}: {message.text}")

    def _asked(self, request):
        parts = urlsplit(request.url)
        if parts.scheme not in ("data", "blob") and parts.netloc != urlsplit(self.address).netloc:
            self.trouble.append(f"another host was asked: {request.url}")

    def until(self, check, seconds=PATIENCE):
        """Return what check returns once it is true and raises nothing, or fail with why not.

        `wait_for_function` of playwright makes a function of a text, which the page forbids.
        """
        end = time.monotonic() + seconds
        while True:
            try:
                value = check()
                assert value, "not so in time"
                return value
            except Exception:
                if time.monotonic() > end:
                    raise
            self.page.wait_for_timeout(30)

    def link(self):
        """Return the query of the link that the page offers, but for the level that tests take."""
        words = urlsplit(self.page.input_value("#link")).query.split("&")
        return "&".join(word for word in words if word != FULL)

    def linked(self, word):
        """Wait until the link holds these words, or does not: "!angle"."""
        wanted, word = not word.startswith("!"), word.lstrip("!")
        self.until(lambda: (word in self.link()) == wanted)

    def result(self, name):
        """Return the words of a row of the results, by its name in the glossary."""
        row = self.page.locator(f"#results tr[data-name={name}]")
        return row.locator("td:not(.carom-meaning)").first.inner_text()

    def number(self, name):
        """Return the number that a row of the results begins with."""
        return float(re.match(r"[-+\d.eE]+", self.result(name).replace("\N{MINUS SIGN}", "-"))[0])

    def notice(self):
        """Return what the page complains of, empty if of nothing."""
        return self.page.inner_text("#notice")

    def traces(self, chart):
        """Return the traces of a chart by their names, as plotly drew them."""
        words = (
            "id => { const plot = document.querySelector("
            "`#${id}.js-plotly-plot, #${id} .js-plotly-plot`);"
            " return plot && plot._fullData && plot.querySelector('.main-svg')"
            " ? plot._fullData.map(t => ({name: t.name, mode: t.mode,"
            " x: Array.from(t.x), y: Array.from(t.y)})) : []; }"
        )
        return {(t["name"], t["mode"]): t for t in self.page.evaluate(words, chart)}

    def laid_over(self, *laws, chart="rebounds"):
        """Return the traces of a chart once these laws, which follow the answer, are among them."""

        def actual():
            traces = self.traces(chart)
            return traces if set(laws) <= {name for name, _ in traces} else None

        return self.until(actual)

    def choose(self, name, option):
        """Choose from a list."""
        self.page.locator(f"#{name}").select_option(label=option)

    def settle(self):
        """Wait until what is due is drawn."""
        self.page.evaluate(
            "new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))"
        )

    def pixels(self, canvas):
        """Return the picture of a canvas as text."""
        return self.page.evaluate(f"document.getElementById('{canvas}').toDataURL()")


@pytest.fixture(scope="session")
def usual():
    """The impact that the page opens with."""
    ball = carom.Sphere(radius="5 mm", material="bearing-steel")
    pair = carom.Pair(ball, carom.HalfSpace(material="bearing-steel"), 0.2)
    return carom.impact(pair, speed=0.6, angle="30 deg")


@pytest.fixture(scope="session")
def address():
    """The address of `carom explore`."""
    pytest.importorskip("flask", reason="the explorer needs flask: pip install 'carom[explore]'")
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
def tabs():
    """The tab that visits share, once there is one."""
    return []


@pytest.fixture
def page(visit, tabs):
    """The page with all of it shown, whatever the impact, for its functions."""
    seen = tabs and tabs[0].page.evaluate("Carom.level.isFull()")
    return (tabs[0] if seen else visit()).page


@pytest.fixture
def visit(address, chromium, tabs):
    """Open a link: in the page that is there, loading it, or fresh in a browser never here.

    The film does not run by itself, as for those who prefer that, unless it is not `still`, which
    loads the page. All of the page is shown, unless another level is asked for.
    """
    own = []

    def open_page(
        query="", *, width=1280, loading=False, fresh=False, ready=True, still=True, level="full"
    ):
        if level == "full":
            query = f"{query or '?'}&{FULL}" if query.strip("?") else f"?{FULL}"
        loading |= fresh or not tabs or not still
        if fresh or not tabs:
            (own if fresh else tabs).append(Visit(chromium, address))
        seen = (own if fresh else tabs)[-1]
        seen.moves(not still)
        seen.page.set_viewport_size({"width": width, "height": 900})
        if loading:
            seen.load(query, ready)
        else:
            seen.travel(query)
        return seen

    yield open_page
    for each in tabs:
        each.moves(False)
    trouble = [line for each in (*own, *tabs) for line in each.trouble]
    while own or (trouble and tabs):
        (own or tabs).pop().page.context.close()
    assert trouble == []
