"""Stories of the page: their questions are open at first, and what they tell answers them."""

from math import inf
from urllib.parse import parse_qsl, urlencode

import numpy as np
import pytest

import carom
from carom.explorer.outcomes import impact_of
from carom.explorer.overlays import laws
from carom.explorer.page import stories
from carom.explorer.views import FIELDS, View

STEPS = [
    (f"{story['id']}.{row}", step)
    for story in stories()
    for row, step in enumerate(story["steps"], 1)
]
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


def test_what_the_answers_tell_in_numbers():
    """Some of the numbers in their words, each computed."""
    told = dict(STEPS)
    ball = carom.Sphere(radius="5 mm", material="bearing-steel")
    steel = carom.Pair(ball, carom.HalfSpace(material="bearing-steel"), 0.2)
    assert "13.6 degrees" in told["contact.1"]["answer"]
    assert np.degrees(np.arctan(steel.friction / steel.kappa)) == pytest.approx(13.6, abs=0.05)
    assert "From 49 degrees" in told["contact.3"]["answer"]
    slides = np.degrees(np.arctan((4.0 * steel.chi - 1.0) * steel.friction / steel.kappa))
    assert slides == pytest.approx(49.0, abs=0.5)
    assert "At 45 degrees, with 81 rad/s" in told["spin.4"]["answer"]
    spins = {a: carom.impact(steel, speed=0.6, angle=f"{a} deg").spin_out for a in range(1, 89)}
    assert min(spins, key=spins.get) == 45
    assert spins[45] == pytest.approx(-81.0, abs=0.5)
    assert "arctan 0.06" in told["billiards.1"]["answer"]
    assert np.degrees(np.arctan(0.06)) == pytest.approx(3.4, abs=0.05)
