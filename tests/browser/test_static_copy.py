"""The copy of the page, from disk without a network, and from a server: as the live page is."""

import json
import shutil
import threading
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer

import pytest
from tests.browser.scripts import script

from carom.page.export import export
from carom.page.outcomes import outcome_of
from carom.page.overlays import laws
from carom.page.views import Refused, View

pytestmark = [pytest.mark.browser, pytest.mark.slow]

ANSWER = script("answer")
LAWS = """async (queries) => {
  const answers = await Promise.all(queries.map(Carom.reading.answer));
  const told = await Promise.all(answers.map((each) => Carom.source.laws(each)));
  return told.map(({ laws }) => laws[0]);
}"""
DRAWN = "document.querySelector('#rebounds .main-svg') && Carom.page.answers()[0]"
QUERIES = (
    *("", "angle=40&spin=-50&material=brass", "restitution=0.63&against=cup&angle=12"),
    *("thickness=3", "friction=0", "given=numbers&psi=-6&chi=9&inelasticity=0.4"),
)


@pytest.fixture(scope="module")
def copy(tmp_path_factory):
    """A folder with a copy of the page."""
    folder = tmp_path_factory.mktemp("course") / "impact page"
    export(folder)
    yield folder
    shutil.rmtree(folder)


class Quiet(SimpleHTTPRequestHandler):
    """A server of files that writes nothing."""

    def log_message(self, *_):
        """Be silent."""


@pytest.fixture(scope="module")
def hosted(copy):
    """The address of the copy at a server of files."""
    with ThreadingHTTPServer(("127.0.0.1", 0), partial(Quiet, directory=copy)) as server:
        threading.Thread(target=server.serve_forever).start()
        yield f"http://127.0.0.1:{server.server_port}"
        server.shutdown()


@pytest.fixture(scope="module")
def offline(chromium, copy):
    """The copy in a browser that has no network."""
    yield from opened(chromium, copy.as_uri(), offline=True)


def opened(chromium, place, *, offline=False):
    """Open the copy; nothing but its own files is asked for, and nothing is complained of."""
    size = {"width": 1280, "height": 900}
    context = chromium.new_context(viewport=size, reduced_motion="reduce", offline=offline)
    tab, trouble = context.new_page(), []
    tab.on("console", lambda m: m.type in ("error", "warning") and trouble.append(m.text))
    tab.on("pageerror", lambda error: trouble.append(str(error)))
    own = (place, "data:", "blob:")
    tab.on("request", lambda r: r.url.startswith(own) or trouble.append(f"asked for {r.url}"))
    tab.goto(f"{place}/index.html?angle=41.5&time=0.25&level=full")
    tab.wait_for_function(DRAWN)
    yield tab
    assert trouble == []
    context.close()


def check_film(tab):
    """A link is shown as it says, and the film runs."""
    assert tab.input_value("#angle") == "41.5"
    assert tab.input_value("#time") == "0.25"
    assert "angle=41.5" in tab.input_value("#link")
    assert tab.locator("#results tr").count() > 10
    tab.click("#play")
    tab.wait_for_function("Number(document.getElementById('time').value) > 0.3")
    tab.click("#play")


def test_from_disk(offline):
    check_film(offline)


def test_from_a_server(chromium, hosted):
    for tab in opened(chromium, hosted):
        check_film(tab)


def test_answers_are_those_of_the_live_page(offline, page):
    """To the last bit, but for what the program alone judges."""
    copied, live = (tab.evaluate(ANSWER, QUERIES) for tab in (offline, page))
    for each in (*copied, *live):
        each["answer"].update(findings=None, laws=None, slow=None)
    assert json.dumps(copied) == json.dumps(live)


REFUSED = {
    "given=numbers&chi=11": ("chi", "must be a number from 0.05 to 10, not '11'"),
    "restitution=1.2": ("restitution", "must be a number from 0.05 to 1, not '1.2'"),
    "thickness=3&restitution=0.9": ("restitution", "must be 1 on a plate"),
    "angle=95": ("angle", "must be a number from 0 to 89.9 deg, not '95'"),
    "speed=fast": ("speed", "not 'fast'"),
    "radius=3 cm": ("radius", "not '3 cm'; this copy takes mm only"),
    "given=numbers&friction=0": ("friction", "must be above 0"),
    "speed=": ("speed", "it is empty"),
    "against=cup&second_radius=2": ("second_radius", "must be above 5 mm"),
    "against=sphere&second_material=rigid": ("second_material", "density"),
    "material=cheese": ("material", "there is no 'cheese'; there are steel; "),
    "law=cheese": ("law", "there is no 'cheese'; there are "),
    "taste=mild": ("", "the link says 'taste', which is unknown; leave it out"),
    "thickness=0": ("thickness", "must be a number from 0.001 to 10000 mm, or thick, not '0'"),
    "thickness=0.01": ("thickness", "so thin a plate gives way like a foil"),
    "given=numbers&inelasticity=2.4": ("inelasticity", "must be a number from 0 to 2.18"),
    "angle=1e400&friction=nan": ("angle", "not '1e400'"),
    "a" * 20000: ("", "the link has 20000 characters; at most "),
}


def test_refusals(offline):
    """The program refuses the same."""
    for query, (field, words) in REFUSED.items():
        (value,) = offline.evaluate(ANSWER, [query])
        assert value["refusal"]["field"] == field, query
        assert words in value["refusal"]["message"]
        if query != "radius=3 cm":  # a unit that the program reads
            with pytest.raises(Refused) as refused:
                outcome_of(View.of(query))
            assert refused.value.field == field, query
    (unused,) = offline.evaluate(ANSWER, ["given=numbers&angle=95"])
    assert "answer" in unused
    (twice,) = offline.evaluate(ANSWER, ["angle=95&angle=40&pace=5"])
    assert twice["answer"]["query"] == "angle=40"


def test_what_needs_the_program_is_a_sentence(offline):
    """No tab is dead; a law is known where a story brought its curve along."""
    assert offline.locator("#tabs").is_hidden()
    assert offline.locator("#laws fieldset").is_hidden()
    assert "carom explore" in offline.inner_text(".carom-program")
    (odd,) = offline.evaluate("Carom.fields.set(new URLSearchParams('data=kharaz2001'))")
    assert odd.endswith("not fitted in this copy")


def test_nothing_is_judged_here(offline):
    """In both levels, and after another impact is set, nothing is said to hold or to fail."""
    verdict, findings = (offline.locator(place) for place in ("#verdict", "#findings"))
    words = "Not judged here: the program tells whether the theory holds."
    for speed in ("0.6", "30"):
        offline.fill("#speed", speed)
        offline.wait_for_function(f"Carom.page.answers()[0].view.speed === {speed}")
        assert findings.inner_text() == words
        offline.click("#level")
        assert verdict.inner_text() == f"? {words}"
        offline.click("#level")
    offline.fill("#speed", "0.6")


def test_the_law_of_a_story_is_as_the_program_says(offline):
    """To what its curve, with 241 points, allows."""
    query = "law=mindlin&angle=22.2&speed=0.6"
    (mine,) = offline.evaluate(LAWS, [query])
    (law,) = laws(View.of(query))["laws"]
    assert mine["at"] == pytest.approx(law["at"], abs=1e-3)
    assert mine["off"] == pytest.approx(law["off"], abs=1e-3)


def test_size(copy):
    assert sum(each.stat().st_size for each in copy.rglob("*") if each.is_file()) <= 15e6
