"""The page for everyone: by keys alone, heard, on a small screen, in the dark, from one host."""

import pytest
from tests.browser.conftest import PREPARED
from tests.browser.scripts import script

pytestmark = [pytest.mark.browser, pytest.mark.slow]
CONTROLS = (
    *("link", "copy", "theme", "play", "back", "forth", "time", "pace", "slow", "preset", "given"),
    *("angle", "speed", "spin", "friction", "radius", "material", "against", "second_material"),
    *("angle-slider", "speed-slider", "spin-slider", "friction-slider", "compare"),
)
PANELS = {  # what only a panel has
    "Charts": ("tab-charts-panel", "law-0"),
    "Measurements": ("tab-fit-panel", "data", "template"),
    "Files": ("tab-files", "history-csv", "history-nc", "history-png", "contact-pdf", "curve-svg"),
    "Python": ("tab-code-panel", "code"),
}
FOCUSED = script("focused")
CONTRASTS = script("contrasts")


@pytest.mark.first_case
@pytest.mark.parametrize("panel", PANELS)
def test_every_control_is_reached_by_tab_and_seen(visit, panel):
    seen, reached = visit(f"?tab={panel}&law=linear+spring,+k_t/k_n+=+kappa"), {}
    if panel == "Python":
        seen.until(lambda: "carom" in seen.page.inner_text("#code"))
    for _ in range(150):
        seen.page.keyboard.press("Tab")
        at = seen.page.evaluate(FOCUSED)
        if at["tag"] == "BODY":
            break
        reached[at["id"]] = at["marked"]
    assert [name for name in (*CONTROLS, *PANELS[panel]) if name not in reached] == []
    assert [name for name, marked in reached.items() if not marked] == []


@pytest.mark.parametrize(
    "query",
    ["", "?given=numbers&against=sphere&data=kharaz2001", "?tab=Files", "?tab=Measurements"],
)
def test_every_control_has_a_name(visit, query):
    """As the browser tells a screen reader."""
    seen = visit(query)
    asked = seen.page.context.new_cdp_session(seen.page)
    nodes = asked.send("Accessibility.getFullAXTree")["nodes"]
    roles = ("button", "slider", "textbox", "spinbutton", "combobox", "link", "radio", "checkbox")
    values = [node for node in nodes if node.get("role", {}).get("value") in roles]
    assert len(values) >= 20
    nameless = [node["role"]["value"] for node in values if not node["name"]["value"].strip()]
    assert nameless == []


PICTURES = """() => [...document.querySelectorAll('canvas, [role=img], svg, figure, .carom-chart')]
  .filter(each => each.checkVisibility() && !each.closest('[aria-hidden=true], .carom-plot'))
  .filter(each => !(each.ariaLabel || each.getAttribute('aria-label')
    || each.querySelector('h2, figcaption'))).map(each => each.outerHTML.slice(0, 80))"""


@pytest.mark.parametrize("level", ["first", "full"])
def test_pictures_have_names_before_anything_is_computed(visit, level):
    """The solver is held back: nothing is drawn, and each picture says what it is to show."""
    seen = visit(level=level, fresh=True)
    held = []
    seen.page.route("**/assets/wasm.js", lambda route: held.append(route))
    seen.page.goto(seen.page.url, wait_until="commit")
    seen.until(lambda: held)
    assert seen.page.evaluate("!window.Carom?.page")
    assert seen.page.evaluate(PICTURES) == []
    for name in ("stage", "patch"):
        assert seen.page.get_attribute(f"#{name}", "aria-label")
        assert seen.page.get_attribute(f"#{name}-beside", "aria-label")
    for route in held:
        route.continue_()
    seen.page.unroute("**/assets/wasm.js")
    seen.until(lambda: seen.page.evaluate("Boolean(Carom.page.answers()[0])"))
    assert seen.page.evaluate(PICTURES) == []


def test_pictures_are_named_as_they_are(visit):
    """At an instant, of both impacts; while the film runs, the film and no instant that is past."""
    seen = visit("?time=0.5&beside=angle%3D60")
    for beside, way in (("", "backwards"), ("-beside", "forwards")):
        name = seen.until(
            lambda at=beside: "µs" in (label(seen, f"stage{at}")) and label(seen, f"stage{at}")
        )
        assert "largest compression" in name
        assert way in name
        assert "19.9 µs" in label(seen, f"patch{beside}")
    seen.page.click("#play")
    seen.until(lambda: label(seen, "patch") == "The contact from above as the film runs")
    assert label(seen, "stage") == "The bodies as the film runs."
    seen.page.click("#play")
    seen.until(lambda: "µs" in label(seen, "stage"))


def label(seen, name):
    return seen.page.get_attribute(f"#{name}", "aria-label")


def test_no_text_is_evaluated_on_the_page(visit):
    """The policy refuses it, and the page computes, draws, fits and judges without."""
    seen = visit("?tab=Measurements&data=kharaz2001&law=mindlin", fresh=True)
    seen.until(lambda: "friction" in seen.page.inner_text("#fit"), PREPARED)
    words = """() => { const found = []; document.addEventListener("securitypolicyviolation",
      ({ blockedURI }) => found.push(blockedURI));
      try { setTimeout("window.evaluated = true"); } catch { found.push("refused"); }
      return new Promise(done => setTimeout(() => done([window.evaluated ?? false, found]), 100));
    }"""
    evaluated, found = seen.page.evaluate(words)
    assert evaluated is False
    assert found
    refused = [line for line in seen.trouble if "evaluate" in line or "eval" in line]
    assert refused == seen.trouble
    seen.trouble.clear()


@pytest.mark.slow
@pytest.mark.parametrize("theme", ["light", "dark"])
def test_words_stand_out(visit, theme):
    seen = visit(f"?theme={theme}&data=kharaz2001&tab=Measurements&law=mindlin")
    seen.until(lambda: "friction" in seen.page.inner_text("#fit"), PREPARED)
    seen.page.fill("#angle", "95")
    seen.until(lambda: seen.notice())
    answer = seen.page.evaluate(CONTRASTS)
    assert len(answer) > 50
    assert [each for each in answer if each["ratio"] < 4.5] == []


def test_dark_and_light(visit):
    """As the system is, as the link says, and as the button says: auto, light, dark in turn."""
    body = "getComputedStyle(document.body).backgroundColor"
    seen = visit()
    grounds = {"light": seen.page.evaluate(body)}
    seen.page.emulate_media(color_scheme="dark")
    grounds["dark"] = seen.until(lambda: {seen.page.evaluate(body)} - {grounds["light"]}).pop()
    seen.page.emulate_media(color_scheme="light")
    seen.until(lambda: seen.page.evaluate(body) == grounds["light"])
    seen = visit("?theme=dark")
    assert seen.page.evaluate(body) == grounds["dark"]
    drawn = seen.pixels("stage")
    for choice, ground in (("auto", "light"), ("light", "light"), ("dark", "dark")):
        seen.page.click("#theme")
        seen.until(lambda choice=choice: choice in seen.page.inner_text("#theme"))
        assert seen.page.evaluate(body) == grounds[ground]
        seen.until(lambda same=ground == "dark": (seen.pixels("stage") == drawn) == same)


def test_a_small_screen_can_be_used(visit):
    seen = visit(width=400)
    slider = seen.page.locator("#angle-slider")
    slider.scroll_into_view_if_needed()
    box = slider.bounding_box()
    assert box["width"] > 150
    assert box["height"] >= 20
    row = "rebound_angle"
    before = seen.result(row)
    seen.page.mouse.click(box["x"] + 0.75 * box["width"], box["y"] + 0.5 * box["height"])
    seen.linked("angle=")
    seen.until(lambda: seen.result(row) != before)
    for name in ("stage", "patch", "forces", "rebounds"):
        assert seen.page.locator(f"#{name}").bounding_box()["width"] > 300
