"""The first level of the page: a ball that is taken by hand, results in words, stories."""

import math

import pytest

from carom.explorer.page import stories

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
