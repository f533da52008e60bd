"""The verdict on the impact that is shown: in one line, and never that on another one."""

import json

import pytest

from carom.page.outcomes import verdict
from carom.page.page import presets, stories
from carom.page.views import View

pytestmark = pytest.mark.browser
WAITS = "Whether the theory holds is being judged"
RUBBER = "?material=rubber&second_material=steel&speed=30"
STARTERS = [preset for preset in presets() if preset["short"]]
STEPS = [(story["id"], step) for story in stories() for step in story["steps"][:1]]


def line(seen):
    return seen.page.inner_text("#verdict")


def judged(seen):
    """Return the line once it is there."""
    return seen.until(lambda: WAITS not in line(seen) and line(seen))


def told(query):
    """Return what decides the verdict on a view, as the page begins to tell it, and the mark."""
    findings = verdict(View.of(query))
    first = findings[0]
    if first["mark"] == "ok":
        return "✓", "The theory holds here: all that it assumes is met."
    begin = {"FAILS": "The theory does not hold here", "?": "Whether the theory holds is open"}
    same = sum(each["mark"] == first["mark"] for each in findings) - 1
    more = f" (and {same} more)" if same else ""
    return {"FAILS": "✗", "?": "?"}[
        first["mark"]
    ], f"{begin[first['mark']]}: {first['plain']}{more}."


def test_the_first_level_tells_what_fails_and_by_how_much(visit):
    seen = visit(RUBBER, level="first")
    assert (
        "✗ The theory does not hold here: rubber is pressed too flat for this theory: "
        in judged(seen)
    )
    assert "0.1 allowed" in line(seen)
    seen.page.fill("#speed", "0.03")
    seen.until(lambda: "pressed too flat" not in line(seen) and WAITS not in line(seen))


@pytest.mark.parametrize("query", [RUBBER, "?", "?material=own", "?speed=5", "?thickness=300"])
def test_the_line_is_what_the_library_says(visit, query):
    seen = visit(query, level="first")
    mark, words = told(query.lstrip("?"))
    assert judged(seen) == f"{mark} {words}"


@pytest.mark.parametrize("preset", STARTERS, ids=[preset["id"] for preset in STARTERS])
def test_starters_are_judged(visit, preset):
    seen = visit(level="first")
    seen.page.get_by_role("button", name=preset["short"], exact=True).click()
    mark, words = told(preset["query"])
    seen.until(lambda: line(seen) == f"{mark} {words}")
    assert seen.page.is_visible("#verdict")


@pytest.mark.slow
@pytest.mark.parametrize(("name", "step"), STEPS, ids=[name for name, _ in STEPS])
def test_stories_are_judged(visit, name, step):
    seen = visit(f"?story={name}.1", level="first")
    mark, words = told(step["query"])
    seen.until(lambda: line(seen) == f"{mark} {words}")
    assert seen.page.is_visible("#verdict")


class Server:
    """What answers in the place of the server when a verdict is asked for."""

    def __init__(self, seen):
        self.held, self.seen = [], seen
        seen.page.route("**/verdict?*", lambda route: self.held.append(route))

    def release(self):
        for route in self.held:
            route.continue_()
        self.seen.page.unroute("**/verdict?*")


@pytest.fixture
def slow(visit):
    """The page with rubber that fails, and a server that does not answer any more."""
    seen = visit(RUBBER, level="first", fresh=True)
    assert "rubber" in judged(seen)
    return seen, Server(seen)


def folds(seen):
    return seen.page.locator("#findings").inner_text() if seen.page.is_visible("#findings") else ""


@pytest.mark.slow
def test_a_verdict_that_is_on_its_way_is_not_the_old_one(slow):
    """In the line, and in the list of all findings."""
    seen, server = slow
    seen.page.click("#level")
    assert "fails" in folds(seen)
    seen.page.fill("#speed", "0.6")
    seen.until(lambda: server.held)
    assert WAITS in folds(seen)
    assert "fails" not in folds(seen)
    seen.page.click("#level")
    assert WAITS in line(seen)
    assert "rubber" not in line(seen)
    server.release()
    judged(seen)


@pytest.mark.slow
def test_a_verdict_that_fails_is_none(slow):
    seen, _ = slow
    seen.page.unroute("**/verdict?*")
    refusal = json.dumps({"field": "", "message": "the page is asked too much at once"})
    seen.page.route(
        "**/verdict?*", lambda route: route.fulfill(body=refusal, content_type="application/json")
    )
    seen.page.fill("#speed", "0.6")
    seen.until(lambda: "Not judged: the page is asked too much at once" in line(seen))
    seen.page.click("#level")
    assert "Not judged: the page is asked too much at once" in folds(seen)
    seen.page.unroute("**/verdict?*")
    seen.page.click("#level")
    seen.page.fill("#speed", "0.7")
    assert "Not judged: the page" not in judged(seen)


@pytest.mark.slow
def test_a_verdict_out_of_date_is_not_shown(slow):
    """The answer to the question before comes after that to the last one."""
    seen, server = slow
    seen.page.fill("#speed", "0.6")
    seen.until(lambda: len(server.held) == 1)
    seen.page.select_option("#material", "steel")
    seen.until(lambda: len(server.held) == 2)
    server.held.pop().continue_()
    seen.until(lambda: WAITS not in line(seen))
    last = line(seen)
    server.release()
    seen.page.wait_for_timeout(300)
    assert line(seen) == last
    assert "rubber" not in last


def test_an_impact_that_is_still_computed_has_no_verdict(visit):
    """A unit is read by the server, which is slow: what is shown meanwhile is the impact before."""
    seen = visit(RUBBER, level="first")
    assert "rubber" in judged(seen)
    held = []
    seen.page.route("**/number?*", lambda route: held.append(route))
    seen.page.fill("#speed", "3 cm/s")
    seen.until(lambda: held)
    assert WAITS in line(seen)
    seen.page.click("#level")
    assert WAITS in folds(seen)
    seen.page.click("#level")
    held[0].continue_()
    seen.page.unroute("**/number?*")
    assert "pressed too flat" not in judged(seen)


def test_what_is_no_impact_has_no_verdict(visit):
    seen = visit(RUBBER, level="first")
    assert "rubber" in judged(seen)
    seen.page.fill("#angle", "95")
    seen.until(lambda: seen.notice())
    assert line(seen) == "? Not judged: what is set is no impact that can be shown."
    seen.page.click("#level")
    assert "fails" not in folds(seen)
    seen.page.fill("#angle", "30")
    seen.until(lambda: "fails" in folds(seen))


def test_numbers_tell_no_bodies_to_be_judged(visit):
    seen = visit("?given=numbers&level=first", level="first")
    assert line(seen) == "? Not judged: two numbers tell no bodies."
