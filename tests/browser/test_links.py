"""A link restores the page; nonsense in one is told in a line and leaves the page as it opens."""

from urllib.parse import parse_qsl, urlencode, urlsplit

import pytest

import carom
from carom.verify.entries import named

pytestmark = [pytest.mark.browser, pytest.mark.slow]
AFTER, BEFORE = "psi_out", "psi_in"
LAWS = ("mindlin", "YADE Mindlin", "Walton & Braun")
BODIES = {"radius": "3.5", "material": "brass", "against": "sphere", "second_radius": "7.25"}
BODIES |= {"second_material": "pmma", "friction": "0.345", "speed": "1.35", "angle": "52.25"}
BODIES["spin"] = "-240"
DATA = carom.datasets.names()[0]
GO = "query => { history.pushState({}, '', query); dispatchEvent(new Event('popstate')); }"


def hit_of(inputs):
    first = carom.Sphere(radius=f"{inputs['radius']} mm", material=inputs["material"])
    radius = f"{inputs['second_radius']} mm"
    second = carom.Sphere(radius=radius, material=inputs["second_material"])
    pair = carom.Pair(first, second, float(inputs["friction"]))
    angle = f"{inputs['angle']} deg"
    return carom.impact(pair, speed=float(inputs["speed"]), angle=angle, spin=float(inputs["spin"]))


def checked(seen):
    words = "[...document.querySelectorAll('#laws input:checked')].map(each => each.value)"
    return seen.page.evaluate(words)


@pytest.mark.slow
def test_a_link_restores_everything_in_a_fresh_browser(visit):
    words = [*BODIES.items(), *(("law", law) for law in LAWS), ("data", DATA)]
    query = urlencode([*words, ("time", "0.25"), ("pace", "10"), ("theme", "dark")])
    seen, hit = visit(f"?{query}", fresh=True), hit_of(BODIES)
    assert {name: seen.page.input_value(f"#{name}") for name in BODIES} == BODIES
    assert checked(seen) == list(LAWS)
    assert seen.number(BEFORE) == pytest.approx(hit.psi_in, rel=1e-5)
    assert seen.number(AFTER) == pytest.approx(hit.psi_out, rel=1e-5)
    assert float(seen.page.input_value("#time")) == pytest.approx(0.25)
    assert seen.page.evaluate("document.documentElement.dataset.theme") == "dark"
    assert seen.page.input_value("#pace") == "10"
    moment = 0.25 * hit.duration * 1e6
    assert float(seen.page.inner_text("#clock").split()[0]) == pytest.approx(moment, abs=0.051)
    chart = seen.laid_over(*LAWS)
    assert {name for name, _ in chart} == {"exact", "this impact", "contact laws", *LAWS}
    seen.until(lambda: "friction" in seen.page.inner_text("#fit", timeout=1000))
    assert sorted(parse_qsl(seen.link())) == sorted(parse_qsl(query))
    assert urlsplit(seen.page.url).query == urlsplit(seen.page.input_value("#link")).query
    assert seen.notice() == ""


def test_a_link_of_numbers(visit):
    seen = visit("?given=numbers&psi=-3.5&chi=1.2&law=mindlin")
    assert seen.number(AFTER) == pytest.approx(carom.solve(-3.5, 1.2).psi_out, rel=1e-5)
    assert seen.page.input_value("#psi") == "-3.5"
    assert seen.page.input_value("#chi") == "1.2"
    assert seen.page.is_hidden("#radius")
    assert seen.page.input_value("#given") == "numbers"
    point = seen.laid_over("mindlin")["contact laws", "markers"]
    law = named("mindlin")[0].law.rebound(-3.5, 1.2, kappa=2.0 / 7.0 * 1.2)
    assert point["y"] == pytest.approx([float(law)], rel=1e-9)


def test_the_link_that_is_told_opens_the_same_page(visit):
    seen = visit()
    seen.page.fill("#angle", "61.5")
    seen.page.click("#laws .carom-more")
    seen.page.get_by_role("checkbox", name="mindlin", exact=True).check(force=True)
    seen.page.focus("#time")
    for _ in range(5):
        seen.page.keyboard.press("ArrowLeft")
    seen.page.click("#theme")
    seen.until(lambda: {"angle", "law", "time", "theme"} == set(dict(parse_qsl(seen.link()))))
    drawn = "[...document.querySelectorAll('#film canvas')].filter((each) => each.offsetParent)"
    sizes = f"{drawn}.map((each) => [each.id, each.width, each.height])"

    def shown():
        words = [seen.page.inner_text(part) for part in ("#results", "#clock", "#theme")]
        return *words, seen.link(), seen.page.evaluate(sizes), seen.pixels("patch")

    before = shown()
    visit(f"?{seen.link()}", loading=True)
    assert shown() == before
    assert checked(seen) == ["mindlin"]


def test_back_and_forward(visit):
    """Each link visited in turn is restored when the browser goes back, and forward again."""
    seen = visit("?angle=20")
    seen.page.goto(f"{seen.address}?angle=70")
    for going, angle in (("go_back", 20.0), ("go_forward", 70.0)):
        getattr(seen.page, going)()
        seen.until(lambda angle=angle: float(seen.page.input_value("#angle")) == angle)
        seen.linked(f"angle={angle:g}")


def test_back_and_forward_restore_the_film_and_the_theme(visit):
    first, second = ("0.25", "5", "dark"), ("0.8", "10", "light")
    seen = visit("?angle=20&time=0.25&theme=dark")

    def shown():
        theme = seen.page.evaluate("document.documentElement.dataset.theme")
        return seen.page.input_value("#time"), seen.page.input_value("#pace"), theme

    assert shown() == first
    seen.page.evaluate(GO, "?angle=20&time=0.8&pace=10")
    seen.linked("pace=10")
    assert shown() == second
    for going, wanted in (("go_back", first), ("go_forward", second)):
        getattr(seen.page, going)()
        seen.until(lambda wanted=wanted: shown() == wanted)


def test_an_example_goes_with_its_impact_when_two_are_swapped(visit):
    seen = visit("?preset=glass")
    seen.page.click("#compare")
    seen.page.select_option("#preset", "steel")
    for title, chosen in (("Glass on glass", "glass"), ("Steel on steel", "steel")):
        seen.page.click("#swap")
        seen.until(lambda title=title: title in seen.page.inner_text("#story"))
        assert seen.page.input_value("#preset") == chosen
        seen.linked(f"preset={chosen}")


NONSENSE = {
    "angle=ninety": "Incidence: ",
    "radius=-5": "Ball radius: ",
    "material=unobtainium": "Ball material: ",
    "law=nobody": "Contact law: ",
    "colour=red": "colour: ",
    "angle=1e400&friction=nan": "Incidence: ",
    "data=/etc/passwd": "Measured rebounds: ",
    "preset=nope": "preset: there is no nope",
    "time=soon&theme=dark": "time: there is no soon",
    "angle=" + "9" * 5000: "The link is too long",
}


def refuses(seen, beginning):
    """The page as it opens, below one line that begins so."""
    notice = seen.until(lambda: seen.notice())
    assert notice.startswith(beginning)
    assert "\n" not in notice
    assert seen.page.input_value("#angle") == "30"
    assert seen.number(BEFORE) == pytest.approx(2.38728, rel=1e-5)
    return True


@pytest.mark.slow
def test_nonsense_in_a_link(visit):
    for query in ("angle=ninety", "%ff%00=%fe&&=&=3"):
        seen = visit(f"?{query}", loading=True)
        assert refuses(seen, NONSENSE.get(query, ""))
        seen.page.wait_for_timeout(500)
        assert refuses(seen, NONSENSE.get(query, ""))  # and it stays
    for query, beginning in NONSENSE.items():
        seen.page.evaluate(GO, f"?{query}&level=full")
        seen.until(lambda beginning=beginning: refuses(seen, beginning))


def test_nonsense_beside_sense_keeps_the_sense(visit):
    seen = visit("?angle=50&law=nobody&time=soon&theme=pink")
    assert seen.page.input_value("#angle") == "50"
    assert seen.page.input_value("#time") == "0.5"
    assert seen.until(lambda: seen.notice()).startswith("Contact law: ")


def test_a_link_of_bodies_that_do_not_fit(visit):
    """It is told, and what fits takes the place of what does not, also in links to files."""
    seen = visit("?against=cup&second_radius=3")
    notice = seen.until(lambda: seen.notice())
    assert notice.startswith("Its radius: must be above 5 mm")
    assert "\n" not in notice
    hrefs = "[...document.querySelectorAll('a.carom-download')].map(each => each.href)"
    assert all("second_radius" not in href for href in seen.page.evaluate(hrefs))
    seen.page.fill("#second_radius", "30")
    seen.until(lambda: seen.notice() == "" and "second_radius=30" in seen.link())
    assert all("second_radius=30" in href for href in seen.page.evaluate(hrefs))


@pytest.mark.parametrize(
    ("query", "beginning"),
    [
        ("?against=cup&radius=20", "Its radius: must be above 20 mm"),
        ("?beside=angle%3D1000", "Beside: Incidence: must be a number from 0 to 89.9 deg"),
    ],
)
def test_a_link_that_cannot_be_mended_is_asked_for_only_once(visit, query, beginning):
    seen = visit(query, loading=True, ready=False)
    assert seen.until(lambda: seen.notice()).startswith(beginning)
    seen.page.wait_for_timeout(500)
    asked = "performance.getEntriesByType('resource').filter(each => each.name.includes('answer?'))"
    assert seen.page.evaluate(f"{asked}.length") <= 4
