"""The animation: a clock that runs and stops, pictures that follow it, a patch as the library's."""

from urllib.parse import parse_qsl

import numpy as np
import pytest

pytestmark = [pytest.mark.browser, pytest.mark.slow]
MICROSECOND = 1e6


def share(seen):
    return float(seen.page.input_value("#time"))


def time_and_phase(seen):
    """The time on the clock in µs, and the phase."""
    number, _, phase = seen.page.inner_text("#clock").partition(" µs · ")
    return float(number.replace("\N{MINUS SIGN}", "-")), phase.replace("\N{MINUS SIGN}", "-")


def test_play_and_pause_by_keys(visit):
    seen = visit("?time=0.1")
    still = {name: seen.pixels(name) for name in ("stage", "patch")}
    assert seen.page.get_by_role("button", name="Play", exact=True).count() == 1
    seen.page.focus("#play")
    seen.page.keyboard.press("Enter")
    seen.until(lambda: seen.page.inner_text("#play") == "Pause")
    seen.until(lambda: share(seen) > 0.3)
    seen.page.keyboard.press("Space")
    seen.until(lambda: seen.page.inner_text("#play") == "Play")
    stopped = share(seen)
    moved = {name: seen.pixels(name) for name in still}
    assert all(moved[name] != still[name] for name in still)
    seen.page.wait_for_timeout(400)
    assert share(seen) == stopped
    assert {name: seen.pixels(name) for name in still} == moved
    linked = seen.until(lambda: dict(parse_qsl(seen.link())).get("time") != "0.1" and seen.link())
    assert float(dict(parse_qsl(linked))["time"]) == pytest.approx(stopped, abs=0.0011)


SLOW_TOUCHES = [pytest.param(touch, marks=pytest.mark.slow) for touch in ("key", "wheel", "Pause")]


@pytest.mark.parametrize("touch", ["click", *SLOW_TOUCHES])
def test_the_film_runs_by_itself_until_somebody_touches_the_page(visit, touch):
    seen = visit(still=False)
    seen.until(lambda: seen.page.inner_text("#play") == "Pause")
    first = share(seen)
    seen.until(lambda: share(seen) != first)
    assert seen.page.get_attribute("#sentence", "aria-live") == "off"
    assert "time" not in seen.link()
    if touch == "Pause":
        seen.page.click("#play")
    else:
        seen.page.mouse.move(5, 5)
        {
            "click": lambda: seen.page.mouse.click(5, 5),
            "key": lambda: seen.page.keyboard.press("Tab"),
            "wheel": lambda: seen.page.mouse.wheel(0, 10),
        }[touch]()
    seen.until(lambda: seen.page.inner_text("#play") == "Play")
    stopped = share(seen)
    seen.page.wait_for_timeout(300)
    assert share(seen) == stopped
    assert seen.page.get_attribute("#sentence", "aria-live") == "polite"
    seen.page.locator("#angle").press("ArrowRight")  # no film begins anew
    seen.page.wait_for_timeout(300)
    assert share(seen) == stopped


@pytest.mark.parametrize(("query", "still"), [("?time=0.1", False), ("", True)])
def test_a_link_to_an_instant_and_who_prefers_less_motion_see_it_stand(visit, query, still):
    seen = visit(query, still=still, loading=True)
    at = share(seen)
    seen.page.wait_for_timeout(300)
    assert share(seen) == at == (0.5 if still else 0.1)
    assert seen.page.inner_text("#play") == "Play"


def test_the_pace_is_as_chosen(visit):
    """The whole takes the seconds that are told: 2.2 durations in 10 s is 0.22 a second."""
    seen = visit("?time=-0.6")
    seen.choose("pace", "10 s film")
    seen.page.click("#play")
    words = (
        "() => new Promise(done => { const slider = document.getElementById('time');"
        " const [at, when] = [Number(slider.value), performance.now()];"
        " setTimeout(() => done(1000 * (Number(slider.value) - at) / (performance.now() - when)),"
        " 1500); })"
    )
    assert seen.page.evaluate(words) == pytest.approx(0.22, rel=0.15)


def test_the_clock_tells_time_and_phase(visit, usual):
    seen = visit()
    for phase in usual.phases:
        middle = 0.5 * (phase.start + phase.end)
        words = f"Carom.clock.set({middle / usual.duration!r})"
        seen.page.evaluate(words)
        time = pytest.approx(middle * MICROSECOND, abs=0.051)
        sign = {0: "", 1: " +", -1: " -"}[phase.sign]
        seen.until(lambda time=time, name=phase.kind + sign: time_and_phase(seen) == (time, name))
    seen.page.focus("#time")
    seen.page.keyboard.press("End")
    seen.until(
        lambda: time_and_phase(seen) == (pytest.approx(1.6e6 * usual.duration, abs=0.051), "after")
    )
    seen.page.keyboard.press("Home")
    seen.until(lambda: time_and_phase(seen)[1] == "before")


def test_the_cursor_stands_at_the_time_in_both_charts(visit, usual):
    """Where the line stands between the ticks of the time axis is the time."""
    seen = visit("?time=0.8")
    words = (
        "id => { const chart = document.getElementById(id);"
        " const middle = part => { const box = part.getBoundingClientRect();"
        " return box.left + box.width / 2; };"
        " const ticks = [...chart.querySelectorAll('.xtick text')];"
        " const cursor = chart.closest('section').querySelector('.carom-cursor');"
        " return [ticks.map(t => [Number(t.textContent), middle(t)]), middle(cursor)]; }"
    )
    for chart in ("forces", "energies"):
        for at in (0.8, 0.2):
            seen.page.evaluate(f"Carom.clock.set({at})")
            seen.page.wait_for_timeout(100)
            ticks, cursor = seen.page.evaluate(words, chart)
            slope, offset = np.polyfit(*np.array(ticks).T[::-1], 1)
            expected = at * usual.duration * MICROSECOND
            assert slope * cursor + offset == pytest.approx(expected, abs=2.0 * slope)


def test_pointing_at_a_chart_sets_the_time(visit):
    seen = visit()
    box = seen.page.locator("#forces .nsewdrag").bounding_box()
    seen.page.mouse.move(box["x"] + 0.25 * box["width"], box["y"] + 0.5 * box["height"])
    seen.until(lambda: share(seen) == pytest.approx(0.25, abs=0.01))


def test_forces_drawn_are_those_of_the_history(visit, usual):
    history = usual.history(201)
    seen = visit()
    drawn = seen.traces("forces")["exact", "lines"]
    assert np.array(drawn["x"]) == pytest.approx(history["time"].values * 1e6, abs=1e-4)
    force = history["tangential_force"].values
    assert np.array(drawn["y"]) == pytest.approx(force, abs=1e-4 * np.abs(force).max())


def test_the_zones_at_a_time(visit, usual):
    """Stick radius, contact radius and traction are the history's and the fields' of the time."""
    seen = visit()
    history = usual.history(201)
    for row in (30, 86, 100, 120, 140, 160):
        at = seen.page.evaluate(f"Carom.page.scenes[0].at({row / 200})")
        for name in ("contact", "stick"):
            radius = float(history[f"{name}_radius"][row]) / usual.max_radius
            assert at[name] == pytest.approx(radius, abs=2e-4), (name, row)
        time = row / 200 * usual.duration
        edge = at["contact"] * usual.max_radius
        points = np.column_stack([np.linspace(0.0, edge, 33), np.zeros(33)])
        field = usual.fields(time, points=points)
        expected = field["traction_x"].values / (usual.pair.friction * usual.max_pressure)
        assert np.array(at["traction"]) == pytest.approx(expected, abs=0.03), row
