"""The worksheet: its links open states of the page, and what its answers say of laws is so."""

import re
import sys
from pathlib import Path

import numpy as np
import pytest

import carom
from carom.page.page import stories
from carom.page.views import View

DOCS = Path(__file__).parents[2] / "docs"
sys.path.append(str(DOCS / "_ext"))

explore_links = pytest.importorskip("explore_links")  # of the manual, which needs sphinx

TEXT = (DOCS / "how-to/worksheet.md").read_text(encoding="utf-8")
OPENED = [explore_links.opened(link) for link in re.findall(r"{explore}`[^<`]*<([^>]*)>`", TEXT)]
LINKS = [query for _, query in OPENED]
LIVE = [query for page, query in OPENED if page == explore_links.LIVE]
COPY = [query for query in LINKS if query not in LIVE]


def test_ten_questions_each_with_a_link_and_a_folded_answer():
    questions = re.split(r"^## ", TEXT, flags=re.MULTILINE)[1:]
    assert [question.split(".")[0] for question in questions] == [str(n) for n in range(1, 11)]
    for question in questions:
        asked, answered = question.split("<details><summary>Answer</summary>")
        assert "{explore}`Open: " in asked
        assert asked.count("?") >= 2
        assert "```python" in answered
        assert answered.rstrip().endswith("</details>")


def test_the_copy_can_show_what_links_to_it_open():
    assert len(COPY) == 20  # nine of them stories, which bring their laws along
    assert [(view.law, view.data) for view in map(View.of, COPY)] == 20 * [((), "")]


def test_stories_stand_in_questions_and_are_there():
    """A story tells whether a question is answered: it is named beside it, never in the answer."""
    steps = {f"{story['id']}.{n}" for story in stories() for n in range(1, len(story["steps"]) + 1)}
    questions = re.split(r"^## ", TEXT, flags=re.MULTILINE)[1:]
    asked = [question.split("<details>")[0] for question in questions]
    told = [re.findall(r"{explore}`story <story=([^>]*)>`\)", text) for text in asked]
    assert [len(named) for named in told] == [1, 1, 2, 2, 0, 1, 0, 0, 2, 0]
    assert {name for named in told for name in named} <= steps
    assert TEXT.count("story=") == 9


def test_laws_and_data_need_the_live_page():
    assert [(view.law, view.data) for view in map(View.of, LIVE)] == [
        (("mindlin", "mindlin_rescale/force"), ""),
        ((), "kharaz2001"),
    ]


def test_an_example_is_a_link_of_its_own():
    assert "example" not in "".join(LINKS)
    assert [query.rpartition("=")[2] for query in LINKS if "preset=" in query] == [
        "superball",
        "superball-back",
        "alumina",
    ]


def test_forces_of_laws_are_as_the_answer_says():
    """Two fifths too large while the contact grows, then twice as far back."""
    pair = carom.Pair(
        carom.Sphere(radius="5 mm", material="bearing-steel"),
        carom.HalfSpace(material="bearing-steel"),
        friction=0.2,
    )
    hit = carom.impact(pair, speed=0.6, angle="10 deg")
    exact = carom.solve(hit.psi_in, pair.chi)
    share = np.array([0.2, 0.8]) * exact.duration

    def ratio(name):
        history = carom.dem.LammpsMindlin(name).history(hit.psi_in, pair.chi, steps=4000)
        force = np.interp(share, history["time"], history["tangential_force"])
        return force / (1.5 * exact.at(share).force)

    assert ratio("mindlin") == pytest.approx([1.4, 2.0], abs=0.05)
    assert ratio("mindlin_rescale/force") == pytest.approx([1.0, 1.5], abs=0.05)
