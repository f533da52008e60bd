"""Stories of the page: their questions are open at first, and what they tell answers them."""

import re
from functools import partial
from math import inf
from urllib.parse import parse_qsl, urlencode

import numpy as np
import pytest
from scipy.optimize import brentq, minimize_scalar
from tests.told_numbers import check_numbers

import carom
from carom.page.outcomes import impact_of
from carom.page.overlays import laws
from carom.page.page import stories
from carom.page.views import FIELDS, View

STEPS = [
    (f"{story['id']}.{row}", step)
    for story in stories()
    for row, step in enumerate(story["steps"], 1)
]
TOLD = dict(STEPS)
KINETIC = ("normal_kinetic_energy", "tangential_kinetic_energy", "spin_kinetic_energy")


def quantity(name, query):
    """Return what a step asks for, computed by the library."""
    view = View.of(query)
    hit = impact_of(view)
    if name == "off":
        (law,) = laws(view)["laws"]
        return abs(law["off"])
    if name == "throw":  # of the impulses along the surface and along the normal
        before, after = hit.psi_in, hit.psi_out
        along = hit.pair.tangential_mass * (before - after) * hit.scales.tangential_speed
        normal = hit.pair.normal_mass * hit.normal_speed * (1.0 + hit.normal_restitution)
        return np.arctan2(along, normal)
    if name == "slides":
        spans = [phase.end - phase.start for phase in hit.phases if phase.kind == "gross slip"]
        return sum(spans) / hit.duration
    if name == "contact_kept":
        return abs(hit.psi_in - hit.psi_out)
    if name == "energy_kept":
        history = hit.history(3)
        first, last = (sum(float(history[part][at]) for part in KINETIC) for at in (0, -1))
        return last / first
    return hit.scalars()[name]


def answers(step, **changed):
    """Tell whether the question of a step is answered, with another value of its control."""
    query = urlencode(dict(parse_qsl(step["query"])) | changed)
    until = step["until"]
    return until.get("above", -inf) < quantity(until["quantity"], query) < until.get("below", inf)


def test_six_stories_of_four_or_five_steps():
    assert len(stories()) == 6
    assert {len(story["steps"]) for story in stories()} <= {4, 5}


@pytest.mark.parametrize(("name", "step"), STEPS, ids=[name for name, _ in STEPS])
def test_a_question_is_open_until_its_control_is_moved(name, step):
    low, high, _ = step.get("slider") or FIELDS[step["control"]].slider
    assert low <= step["value"] <= high
    assert not answers(step)
    assert answers(step, **{step["control"]: step["value"]})
    assert step["question"].endswith(("?", "."))


@pytest.mark.parametrize(("name", "step"), STEPS, ids=[name for name, _ in STEPS])
def test_the_slider_reaches_the_answer(name, step):
    """By one of its own places, so that nobody has to type."""
    low, high, width = step.get("slider") or FIELDS[step["control"]].slider
    near = np.arange(-40, 41) * width + round((step["value"] - low) / width) * width + low
    places = sorted(near[(near >= low) & (near <= high)], key=lambda at: abs(at - step["value"]))
    assert any(answers(step, **{step["control"]: f"{place:.6g}"}) for place in places)


def at(name, wanted, **changed):
    """Return what a step's impact comes to, with some of it changed."""
    words = {key: f"{value:.15g}" for key, value in changed.items()}
    return quantity(wanted, urlencode(dict(parse_qsl(TOLD[name]["query"])) | words))


def given(name, field):
    """Return what a step sets, in the unit of the page."""
    return getattr(View.of(TOLD[name]["query"]), field)


def asked(name, bound):
    """Return the number in the question of a step, from which on it is answered."""
    return TOLD[name]["until"][bound]


def in_degrees(name, wanted, **changed):
    return np.degrees(at(name, wanted, **changed))


def threshold(name, wanted, level, control, low, high):
    """Return where between two values of its control a quantity passes a level."""
    return brentq(lambda x: at(name, wanted, **{control: x}) - level, low, high, xtol=1e-9)


def grips(name, control, low, high, sign=1.0):
    """Return where the contact slides to the end no more: |psi_1| = 4 chi - 1."""
    limit = sign * (4.0 * View.of(TOLD[name]["query"]).pair.chi - 1.0)
    return threshold(name, "psi_in", limit, control, low, high)


def largest(name, wanted, control, low, high):
    """Return the largest size of a quantity between two values of its control."""
    return abs(at(name, wanted, **{control: place_of_largest(name, wanted, control, low, high)}))


def place_of_largest(name, wanted, control, low, high):
    found = minimize_scalar(
        lambda x: -abs(at(name, wanted, **{control: x})), bounds=(low, high), method="bounded"
    )
    return found.x


def frictions(name, first, second):
    return given(first, "friction") / given(second, "friction")


def arctan_of_throw(name, angle):
    return np.tan(at(name, "throw", angle=angle))


def how_full(name):
    """Return how far off its middle a ball is struck: by half a ball, or not."""
    return np.sin(np.radians(given(name, "angle")))


def slider(name, control, end):
    return FIELDS[control].slider[end]


def springs(name):
    return float(next(e.label for e in carom.verify.catalogue() if "springs" in e.label).split()[1])


def largest_error(name, label):
    """Return how far a contact law is off, over all regimes of a step's bodies."""
    pair = View.of(TOLD[name]["query"]).pair
    psi = np.linspace(0.0, 4.5 * pair.chi, 400)
    laws = {entry.label: entry.law for entry in carom.verify.catalogue()}
    out = laws[label].rebound(psi, pair.chi, kappa=pair.kappa)
    return np.max(np.abs(out - carom.rebound(psi, pair.chi)))


def rounded_down(function):
    return lambda *arguments: np.floor(function(*arguments))


def times(factor, function):
    """Return a function whose values are so many times those of another."""
    return lambda *arguments, **more: factor * function(*arguments, **more)


in_turns, size, percent = (partial(times, factor) for factor in (0.5 / np.pi, -1.0, 100.0))
told_in_degrees = partial(times, 180.0 / np.pi)
BACK = ("rebound_angle", 0.0)
CLAIMS = {  # by step: words with a place for each number, and what computes it
    "superball.1": [
        ("From {:.0f} rad/s on", threshold, *BACK, "spin", 50, 180),
        ("{:.0f} turns a second", in_turns(threshold), *BACK, "spin", 50, 180),
    ],
    "superball.2": [("Below {:.1f} it slides", threshold, *BACK, "friction", 0.2, 0.4)],
    "superball.3": [("At {:.0f} degrees", threshold, "psi_in", 1.0, "angle", 30, 60)],
    "superball.4": [
        ("with a friction of {:g}.", given, "friction"),
        ("with {:.0f} rad/s it jumps straight up", threshold, *BACK, "spin", 20, 80),
        ("than {:.1f} degrees", told_in_degrees(largest), "rebound_angle", "spin", 62, 1000),
        ("{:.1f} times the friction", frictions, "superball.1", "superball.4"),
    ],
    "billiards.1": [
        ("comes from {:g} degrees", given, "angle"),
        ("Below {:.0f} degrees", grips, "angle", 10, 40),
        ("throw is {:.1f} degrees", partial(in_degrees, angle=20), "throw"),
        ("arctan {:g}", arctan_of_throw, 75),
        ("is then {:g} times", given, "friction"),
    ],
    "billiards.2": [
        ("less than {one} degree", told_in_degrees(asked), "below"),
        ("Some {:.0f} to", size(threshold), "throw", np.radians(1.0), "spin", -17, -5),
        ("to {:.0f} rad/s", size(threshold), "throw", -np.radians(1.0), "spin", -30, -18),
        ("With {:.1f} both", size(threshold), "throw", 0.0, "spin", -30, -5),
    ],
    "billiards.3": [
        ("From {:.0f} rad/s on", grips, "spin", -60, -18, -1.0),
        ("is {:.1f} degrees", size(partial(in_degrees, spin=-35)), "throw"),
    ],
    "billiards.4": [
        ("{half}-ball", how_full),
        ("more than {:.0f} degrees", told_in_degrees(asked), "above"),
        ("largest, {:.0f} degrees", told_in_degrees(largest), "throw", "friction", 0.1, 0.3),
        ("friction of {:.2f}", place_of_largest, "throw", "friction", 0.1, 0.3),
    ],
    "spin.1": [
        ("comes at {:g} degrees", given, "angle"),
        ("leaves at {:.0f} degrees", in_degrees, "rebound_angle"),
        ("some {:.0f} rad/s", threshold, *BACK, "spin", 20, 80),
    ],
    "spin.2": [
        ("up to {:.0f} rad/s", slider, "spin", 1),
        ("from {:.0f} rad/s on", grips, "spin", 50, 200),
        ("at {:.1f} degrees", told_in_degrees(largest), "rebound_angle", "spin", 90, 1000),
    ],
    "spin.3": [("At {:.0f} rad/s", threshold, "psi_in", 0.0, "spin", -80, 0)],
    "spin.4": [
        ("Pass {:.1f} turns", size(in_turns(asked)), "below"),
        ("At {:.0f} degrees", place_of_largest, "spin_out", "angle", 20, 70),
        ("with {:.1f} turns", in_turns(largest), "spin_out", "angle", 20, 70),
    ],
    "contact.1": [
        ("comes at {:g} degrees", given, "angle"),
        ("than {:.1f} degrees", threshold, "psi_in", 1.0, "angle", 5, 30),
    ],
    "contact.2": [("friction of {:.1f}", threshold, "slides", 0.0078, "friction", 0.5, 1.0)],
    "contact.3": [
        ("From {:.0f} degrees on", grips, "angle", 30, 70),
        ("is {:g} times", given, "friction"),
    ],
    "contact.4": [
        ("Below {:.1f} the contact slides", grips, "friction", 0.05, 0.2),
        ("Below {:.3f} its point", threshold, "psi_out", 0.0, "friction", 0.05, 0.095),
    ],
    "mindlin.1": [
        ("more than {:g}?", asked, "above"),
        ("Around {:.0f} degrees", place_of_largest, "off", "angle", 7, 14),
    ],
    "mindlin.2": [
        ("From {:.0f} degrees on the contact", grips, "angle", 30, 70),
        ("From {:.0f} degrees on both", threshold, "off", 1e-3, "angle", 45, 54),
    ],
    "mindlin.3": [
        ("At {:g} degrees", given, "angle"),
        ("Below {:.1f} the contact slides", grips, "friction", 0.05, 0.2),
        ("below {:.2f} the law", threshold, "off", 1e-3, "friction", 0.08, 0.0997),
    ],
    "mindlin.4": [
        ("friction is {:g} now", given, "friction"),
        ("more than {:g}?", asked, "above"),
        ("from {:.0f} to", threshold, "off", 0.3, "angle", 10, 20),
        ("to {:.0f} degrees.", rounded_down(threshold), "off", 0.3, "angle", 60, 75),
        ("{:.0f} springs", springs),
        ("come to {:.3f}.", largest_error, "exact, 16 springs"),
    ],
    "plate.1": [
        ("{:g} mm thick", given, "thickness"),
        ("less than {half} of its speed", asked, "below"),
        ("Below {:.1f} mm", threshold, "normal_restitution", 0.5, "thickness", 2.5, 5),
    ],
    "plate.2": [
        ("is {:g} mm thick", given, "thickness"),
        ("at {:g} m/s", given, "speed"),
        ("from {:.0f} to", percent(at), "normal_restitution"),
        ("to {:.0f} percent", percent(partial(at, speed=0.05)), "normal_restitution"),
    ],
    "plate.3": [
        ("Below {:.1f} mm", threshold, "rebound_angle", np.radians(30.0), "thickness", 3, 5),
        ("than {:g} degrees", given, "angle"),
    ],
    "plate.4": [
        ("plate of {:g} mm", given, "thickness"),
        ("Some {:.0f} percent", percent(partial(at, angle=0.0)), "energy_kept"),
    ],
}


def words_of(step):
    return " ".join(step[part] for part in ("text", "question", "answer"))


@pytest.mark.parametrize("name", TOLD)
def test_every_number_in_a_story_is_what_the_library_computes(name):
    """Each to its last digit; and none is told that is not computed."""
    claims = [(words, compute(name, *more)) for words, compute, *more in CLAIMS.get(name, [])]
    check_numbers(words_of(TOLD[name]), claims)


@pytest.mark.parametrize("name", [name for name in TOLD if CLAIMS.get(name)])
def test_a_wrong_number_in_a_story_is_noticed(name):
    """Any number changed in its last digit."""
    claims = [(words, compute(name, *more)) for words, compute, *more in CLAIMS[name]]
    text = words_of(TOLD[name])
    for found in re.finditer(r"\d+(?:\.\d+)?", text):
        wrong = f"{found[0][:-1]}{(int(found[0][-1]) + 1) % 10}"
        with pytest.raises(AssertionError):
            check_numbers(text[: found.start()] + wrong + text[found.end() :], claims)
    with pytest.raises(AssertionError):
        check_numbers(f"{text} Some 7 degrees.", claims)


def test_what_the_stories_tell_without_numbers():
    """Which way balls and contact points go, on either side of what the answers tell."""
    assert (
        at("contact.4", "psi_out", friction=0.080)
        > 0.0
        > at("contact.4", "psi_out", friction=0.085)
    )
    assert (
        at("contact.4", "slides", friction=0.099)
        > 0.999
        > at("contact.4", "slides", friction=0.101)
    )
    assert at("superball.2", "slides", friction=0.3) > 0.999
    assert at("superball.1", "spin_out") < 0.0  # topspin
    assert at("plate.2", "normal_restitution", thickness=30) > at(
        "plate.2", "normal_restitution", speed=0.05
    )
    assert at("billiards.4", "slides", friction=0.1) > 0.999
    assert at("spin.2", "slides", spin=91) > 0.999 > at("spin.2", "slides", spin=88)
    nearer = {
        name: largest_error("mindlin.4", name)
        for name in ("mindlin", "mindlin_rescale", "mindlin/force")
    }
    assert max(nearer["mindlin_rescale"], nearer["mindlin/force"]) < 0.9 * nearer["mindlin"]
    between = [at("mindlin.4", "off", angle=angle) for angle in range(15, 68)]
    assert min(between) > 0.3


def test_spins_after_are_told_in_turns_as_the_page_shows_them():
    """Spin before is set in rad/s; what is told of the spin after is in the unit of the results."""
    for name, step in TOLD.items():
        if step["until"]["quantity"] == "spin_out" and step["control"] != "spin":
            assert "rad/s" not in words_of(step), name
