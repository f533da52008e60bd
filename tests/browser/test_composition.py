"""The page as a picture at four widths, light and dark: what is in view, fits, is told apart."""

import itertools

import pytest
from tests.browser.scripts import script

pytestmark = [pytest.mark.browser, pytest.mark.slow]
WIDTHS = [400, 1024, 1440, 1920]
CHARTS = ("rebounds", "forces", "energies")
STATES = {
    "as it opens": "",
    "three laws": "against=sphere&angle=53.75&law=mindlin&law=YADE+Mindlin&law=Walton+%26+Braun",
    "numbers": "given=numbers&psi=-3.5&chi=0.7",
    "losses, beside": "restitution=0.7&angle=12&beside=angle%3D60",
    "a story": "preset=superball",
}
PANELS = ("Measurements", "Files", "Python")
SOON = ((400, "three laws"), (1920, "as it opens"))
SOON += ((400, "Measurements"), (1920, "Files"))  # the others are slow together
EMPTIEST = 1 / 3  # of a card
ABOUT = 28  # pixels around what a card holds that are not empty
STAGES = script("stages")
REDRAWN = script("redrawn")
EMPTY = script("empty")
WORDS = script("page_words")
CANVAS_WORDS = script("canvas_words")


def apart(one, other, least=1.0):
    """Whether two boxes overlap by less than some pixels."""
    width = min(one[2], other[2]) - max(one[0], other[0])
    height = min(one[3], other[3]) - max(one[1], other[1])
    return width < least or height < least + 1.0


def overlapping(words, least=1.0):
    """Return pairs of words that are drawn one over the other."""
    pairs = itertools.combinations(words, 2)
    return [
        (a["text"], b["text"])
        for a, b in pairs
        if a["box"] != b["box"] and not apart(a["box"], b["box"], least)
    ]


def check_words(seen):
    words = seen.page.evaluate(WORDS)
    assert len(words) > 30
    assert seen.page.evaluate("document.documentElement.scrollWidth - innerWidth") <= 0
    assert [each["text"] for each in words if each["aside"]] == []
    assert overlapping([each for each in words if each["seen"]], 2.0) == []


def check_pictures(seen):
    words = seen.page.evaluate(CANVAS_WORDS)
    cut = [
        (each["canvas"], each["time"], each["text"])
        for each in words
        if min(each["box"][:2]) < -1
        or each["box"][2] > each["room"][0] + 1
        or each["box"][3] > each["room"][1] + 1
    ]
    assert cut == []
    for canvas, time in {(each["canvas"], each["time"]) for each in words}:
        there = [w for w in words if w["canvas"] == canvas and (w["still"] or w["time"] == time)]
        once = {(w["text"], *w["box"]): w for w in there}.values()
        assert overlapping(once) == []


def check_cards(seen):
    empty = {each["card"]: each["empty"] for each in seen.page.evaluate(EMPTY, ABOUT)}
    assert len(empty) >= 6
    assert {card: share for card, share in empty.items() if share > EMPTIEST} == {}
    charts = [seen.page.locator(f"#{name}").bounding_box() for name in CHARTS]
    heights = [box["height"] for box in charts]
    assert max(heights) - min(heights) < 1
    assert min(heights) > 200


def check_sliders(seen):
    """The pictures stay in view while a slider is moved, and do not hide it."""
    sliders = seen.page.locator("#fields input[type=range]:visible").all()
    assert len(sliders) >= 4
    for slider in sliders:
        slider.focus()  # which scrolls to it
        seen.page.keyboard.press("ArrowRight")
        seen.settle()
        assert min(seen.page.evaluate(STAGES)) >= 0
        box, film = slider.bounding_box(), seen.page.locator("#film").bounding_box()
        if box["x"] < film["x"] + film["width"] and film["x"] < box["x"] + box["width"]:
            assert box["y"] >= film["y"] + film["height"]


def at_widths(states):
    """Every width with every state, most of them slow."""
    return [
        pytest.param(*each, marks=[pytest.mark.slow] * (each not in SOON))
        for each in itertools.product(WIDTHS, states)
    ]


@pytest.mark.parametrize(("width", "state"), at_widths(STATES))
def test_the_page_is_composed(visit, width, state):
    seen = visit(f"?{STATES[state]}", width=width)
    seen.until(lambda: seen.traces("energies"))
    for dark in (False, True) if state == "as it opens" else (False,):  # nothing but colours differ
        if dark:
            seen.page.evaluate(REDRAWN, "dark")
        check_words(seen)
        check_pictures(seen)
        check_cards(seen)
    check_sliders(seen)


@pytest.mark.parametrize(("width", "panel"), at_widths(PANELS))
def test_panels_are_composed(visit, width, panel):
    seen = visit(f"?tab={panel}&data=kharaz2001", width=width)
    place = {"Measurements": "#fit .main-svg", "Files": "#files a", "Python": "#code"}[panel]
    seen.until(lambda: seen.page.locator(place).first.is_visible())
    seen.until(lambda: panel != "Python" or "carom" in seen.page.inner_text("#code"))
    seen.settle()
    check_words(seen)
    empty = {each["card"]: each["empty"] for each in seen.page.evaluate(EMPTY, ABOUT)}
    assert {card: share for card, share in empty.items() if share > EMPTIEST} == {}
