"""The first level of the page: a ball that is taken by hand, results in words, stories."""

import math

import pytest

import carom
from carom.page.page import stories

pytestmark = pytest.mark.browser
PLACES = """() => {
  const element = document.getElementById("stage");
  const { seen, ball } = Carom.stage.last(element);
  const box = element.getBoundingClientRect();
  const on = (point) => [seen.at(point)[0] + box.left, seen.at(point)[1] + box.top];
  const arrow = seen.arrows.find(({ when, first }) => when === "before" && first);
  return { tail: on(arrow.from), ball: on([ball.x, ball.y]), radius: ball.radius * seen.unit };
}"""
STORIES = [[story["id"], len(story["steps"])] for story in stories()]
WHOLE_STORIES = "Carom.config.stories.map(({ id, steps }) => [id, steps.length])"


def drag(page, start, *points):
    """Press at a place, move over others, and let go."""
    page.mouse.move(*start)
    page.mouse.down()
    for point in points:
        page.mouse.move(*point)
    page.mouse.up()


def numbers(seen, *names):
    return [float(seen.page.input_value(f"#{name}")) for name in names]


def shown(seen, *places):
    """Return which of these parts of the page are to be seen."""
    return [place for place in places if seen.page.is_visible(place)]


def test_the_arrow_is_dragged_for_direction_and_speed(visit):
    """Turned by an angle around the ball, and made longer, the impact follows by as much."""
    seen = visit("?angle=30&speed=0.6", level="first")
    places = seen.page.evaluate(PLACES)
    (x, y), (x0, y0) = places["tail"], places["ball"]
    length, start = math.hypot(x - x0, y - y0), math.atan2(x0 - x, y0 - y)
    turned, longer = start + math.radians(20.0), 1.25 * length
    to = x0 - longer * math.sin(turned), y0 - longer * math.cos(turned)
    drag(seen.page, places["tail"], ((x + to[0]) / 2, (y + to[1]) / 2), to)
    angle, speed = numbers(seen, "angle", "speed")
    assert angle == pytest.approx(50.0, abs=0.3)
    assert speed == pytest.approx(0.75, rel=0.02)
    seen.until(lambda: seen.page.evaluate("Carom.page.answers()[0].view.angle") == angle)
    seen.linked(f"angle={angle:g}")


def turn(seen):
    """Turn the ball by one radian, counter-clockwise."""
    places = seen.page.evaluate(PLACES)
    (x, y), far = places["ball"], 0.6 * places["radius"]
    ways = [(x + far * math.cos(0.1 * k), y - far * math.sin(0.1 * k)) for k in range(11)]
    drag(seen.page, ways[0], *ways[1:])


def test_the_ball_is_turned_for_its_spin(visit):
    """A radian of turning, counter-clockwise, is the backspin whose rim is as fast as the ball."""
    seen = visit("?speed=0.6&radius=5", level="first")
    turn(seen)
    (spin,) = numbers(seen, "spin")
    assert spin == pytest.approx(0.6 / 5e-3, rel=0.02)
    seen.until(lambda: seen.page.evaluate("Carom.page.answers()[0].view.spin") == spin)


def test_a_hand_reads_other_units(visit):
    """What is typed as 2 in and 60 cm/s turns and flies as 50.8 mm and 0.6 m/s do."""
    seen = visit("?radius=2+in&speed=60+cm/s&angle=30", level="first")
    turn(seen)
    assert numbers(seen, "spin")[0] == pytest.approx(0.6 / 50.8e-3, rel=0.02)
    places = seen.page.evaluate(PLACES)
    (x, y), (x0, y0) = places["tail"], places["ball"]
    drag(seen.page, places["tail"], (x0 + 1.5 * (x - x0), y0 + 1.5 * (y - y0)))
    assert numbers(seen, "speed")[0] == pytest.approx(0.9, rel=0.02)


def test_what_psi_and_chi_give_cannot_be_taken(visit):
    seen = visit("?given=numbers&psi=1.5&chi=1.4")
    box = seen.page.locator("#stage").bounding_box()
    before = seen.pixels("stage")
    middle = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    drag(seen.page, middle, (middle[0] + 40, middle[1] - 40))
    assert seen.pixels("stage") == before
    assert seen.page.input_value("#psi") == "1.5"


def test_a_hand_lets_the_film_run_where_motion_is_welcome(visit):
    seen = visit(still=False, level="first")
    seen.until(lambda: seen.page.inner_text("#play") == "Pause")
    seen.page.mouse.click(5, 5)
    seen.until(lambda: seen.page.inner_text("#play") == "Play")
    places = seen.page.evaluate(PLACES)
    x, y = places["tail"]
    drag(seen.page, (x, y), (x - 15, y), (x - 30, y))
    assert numbers(seen, "angle")[0] > 30.0
    seen.until(lambda: seen.page.inner_text("#play") == "Pause")


def test_the_first_level_has_words_and_no_symbols(visit):
    seen = visit(level="first")
    fields = seen.page.locator(".carom-field:visible label").all_inner_texts()
    assert fields == ["Angle", "Speed", "Backspin", "Friction", "Bounce", "Ball", "It strikes"]
    words = seen.page.inner_text("body")
    assert not set("ψχκθω") & set(words)
    assert all(told in words for told in ("18.6°", "turns", "94.3 %"))
    assert not shown(seen, "#tabs", "#results")


def tiles(seen):
    """Return the words of the three results."""
    return [" ".join(tile.split()) for tile in seen.page.locator(".carom-tile").all_inner_texts()]


def test_two_balls_are_told_as_one_sees_them(visit):
    """A half-ball hit of billiard balls; the numbers by the impulses, the struck ball at rest."""
    seen = visit("?preset=throw&time=1.5", level="first")
    leaves, spins, left = tiles(seen)
    assert "at 90° to the line of centres" in leaves
    assert "The other ball is thrown 3.43° off the line of centres." in leaves
    assert "with 0.724 turns/s, side spin against the motion" in spins
    assert "96.7 % 3.31 % is lost to friction." in left
    fields = seen.page.locator(".carom-field:visible label").all_inner_texts()
    assert "Side spin" in fields
    assert "Backspin" not in fields
    assert not {"topspin", "backspin"} & set(seen.page.inner_text("body").lower().split())
    assert "The balls have parted" in seen.page.inner_text("#sentence")
    arrows = seen.page.evaluate(ARROWS)
    assert abs(math.degrees(math.atan2(*arrows["after"]))) == pytest.approx(90.0, abs=0.2)
    assert math.degrees(math.atan2(*arrows["before"])) == pytest.approx(150.0, abs=0.2)
    assert "thrown" in seen.page.inner_text("#summary")
    seen = visit("?angle=20", level="first")
    assert "Backspin" in seen.page.locator(".carom-field:visible label").all_inner_texts()


ARROWS = """() => Object.fromEntries(
  Carom.stage.last(document.getElementById("stage")).seen.arrows
  .filter(({ first }) => first)
  .map(({ when, from, to }) => [when, [to[0] - from[0], to[1] - from[1]]]))"""


@pytest.mark.parametrize(
    ("query", "leaves"),
    [
        ("against=sphere&second_radius=5&angle=0", "It stops where it struck"),
        ("against=sphere&second_radius=2&angle=10&friction=0.05", "onwards"),
        ("against=sphere&second_radius=30&angle=10&friction=0.05", "back"),
        ("against=sphere&second_radius=5&angle=5&spin=200", "to the side it came from"),
    ],
)
def test_where_a_ball_goes_that_struck_another(visit, query, leaves):
    assert leaves in tiles(visit(f"?{query}", level="first"))[0]


def test_what_is_too_little_to_be_told_is_not_told_as_nothing(visit):
    """Balls that all but gear: the throw and the loss are both told as less than something."""
    seen = visit("?preset=gearing", level="first")
    seen.page.fill("#spin", "-17.5")
    seen.until(lambda: seen.page.evaluate("Carom.page.answers()[0].view.spin") == -17.5)
    told = seen.page.inner_text("#summary")
    assert "thrown less than 0.01° off the line of centres." in told
    assert "Less than 0.01 % is lost." in told
    assert "Nothing is lost" not in told
    seen.page.fill("#friction", "0")
    seen.until(lambda: "Nothing is lost." in seen.page.inner_text("#summary"))
    assert "The other ball leaves along the line of centres." in seen.page.inner_text("#summary")


@pytest.mark.parametrize(
    ("query", "hit", "words"),
    [
        ("thickness=4&speed=2", {"thickness": 4e-3}, "lost to waves in the plate"),
        ("restitution=0.8&speed=2", {"restitution": 0.8}, "lost in the bodies"),
    ],
)
def test_what_is_lost_is_told_in_the_same_words_everywhere(visit, query, hit, words):
    """In the tile, in the sentence, in the key of the chart and beside the results."""
    seen = visit(f"?{query}&time=1.5", level="first")
    wall = carom.HalfSpace(material="bearing-steel", thickness=hit.get("thickness"))
    ball = carom.Sphere(radius="5 mm", material="bearing-steel")
    losses = carom.KelvinVoigt(restitution=0.8) if "restitution" in hit else None
    pair = carom.Pair(ball, wall, friction=0.2)
    struck = carom.impact(pair, speed=2.0, angle="30 deg", losses=losses)
    whole = 0.5 * ball.mass * 2.0**2
    lost = (struck.lost_energy + struck.shear_lost_energy) / whole
    left = tiles(seen)[2]
    assert f"{100.0 * struck.dissipated_energy / whole:.3g} % is lost to friction" in left
    assert f"{100.0 * lost:.3g} % is {words}" in left
    assert f"part of the energy is {words}" in seen.page.inner_text("#sentence")
    seen.page.click("#level")
    seen.until(lambda: words in seen.page.inner_text("#energies"))
    assert words.partition(" in the plate")[0] in seen.page.inner_text("#results")
    everything = seen.page.inner_text("body")
    assert not any(old in everything for old in ("inside the bodies", "carr", "rubbed away"))


SCREENS = [(320, 568), (360, 640), (390, 844), (640, 360), (800, 360), (932, 430), (1280, 560)]
COVERED = """() => { const film = document.getElementById("film").getBoundingClientRect();
  const seen = Math.min(innerHeight, film.bottom) - Math.max(0, film.top);
  return Math.max(0, seen) / innerHeight; }"""
STICKY = "getComputedStyle(document.getElementById('film')).position === 'sticky'"


@pytest.mark.parametrize("level", ["first", "full"])
def test_a_low_screen_has_room_for_what_is_below_the_film(visit, level):
    """Where the film stays it covers less than two thirds; where it would cover more it scrolls."""
    seen = visit(level=level)
    for width, height in SCREENS:
        seen.page.set_viewport_size({"width": width, "height": height})
        seen.settle()
        if seen.page.evaluate(STICKY):
            seen.page.evaluate("scrollTo(0, 1e6)")
            assert seen.page.evaluate(COVERED) < 0.62, (width, height)
        slider = seen.page.locator("#friction-slider")
        slider.blur()  # or it would not be scrolled to
        slider.focus()
        box, film = slider.bounding_box(), seen.page.locator("#film").bounding_box()
        apart = box["x"] >= film["x"] + film["width"] or box["x"] + box["width"] <= film["x"]
        assert apart or box["y"] >= film["y"] + film["height"] - 1, (width, height)
        assert 0 <= box["y"] < height, (width, height)
        seen.page.evaluate("scrollTo(0, 0)")


def test_the_levels_are_one_switch_in_the_link(visit):
    seen = visit("?angle=40", level="first")
    seen.page.click("#level")
    assert shown(seen, "#tabs", "#results") == ["#tabs", "#results"]
    seen.until(lambda: "level=full" in seen.page.input_value("#link"))
    seen.page.click("#level")
    seen.until(lambda: "level" not in seen.page.input_value("#link"))
    assert not shown(seen, "#tabs", "#results")


@pytest.mark.parametrize("query", ["?given=numbers", "?tab=Files", "?law=mindlin", "?beside="])
def test_links_that_need_the_full_level_open_it(visit, query):
    seen = visit(query, level="first")
    assert seen.page.evaluate("Carom.level.isFull()")


@pytest.mark.parametrize(
    ("name", "steps"),
    [
        pytest.param(*story, id=story[0], marks=[pytest.mark.slow] * (row > 0))
        for row, story in enumerate(STORIES)
    ],
)
def test_every_step_of_a_story_is_told_shown_and_left(visit, name, steps):
    """As one who presses "Show me" and "Next" to the end."""
    seen = visit(f"?story={name}.1", level="first")
    page = seen.page
    assert page.evaluate(WHOLE_STORIES) == STORIES
    for step in range(1, steps + 1):
        seen.linked(f"story={name}.{step}")
        assert f"{step} of {steps}" in page.inner_text("#stories")
        assert not page.is_visible(".carom-answer")
        assert page.locator(".carom-field:visible").count() == 1
        page.get_by_role("button", name="Show me").click()
        page.wait_for_selector(".carom-answer:visible")
        assert not seen.notice()
        page.locator(".carom-next").click()
    seen.linked("!story")
    assert page.locator(".carom-story").count() == len(STORIES) == 6


def test_doing_it_shows_the_answer(visit):
    seen = visit("?story=superball.1", level="first")
    assert not seen.page.is_visible(".carom-answer")
    seen.page.fill("#spin", "60")
    seen.until(lambda: seen.page.evaluate("Carom.page.answers()[0].view.spin") == 60)
    assert not seen.page.is_visible(".carom-answer")
    seen.page.fill("#spin", "180")
    seen.until(lambda: seen.page.is_visible(".carom-answer"))
    assert "comes back" in seen.page.inner_text(".carom-answer")


def test_a_link_to_no_story_says_so(visit):
    seen = visit("?story=no.7", level="first")
    assert "story: there is no no.7" in seen.notice()
