"""How results look in a notebook, and what they say to cite."""

import re
from base64 import b64decode
from html.parser import HTMLParser
from io import BytesIO

import numpy as np
import pytest
from PIL import Image

import carom
from carom.citations import ELEMENTS, IMPACT, LOADS, bibtex
from carom.notebooks import card

BALL = carom.Sphere(radius="5 mm", material="steel")
PAIR = carom.Pair(BALL, carom.HalfSpace(material="steel"), friction=0.2)
MOTION = {"speed": 2.0, "angle": "30 deg"}
TINY = carom.BoundaryElements(elements=8, steps=20)


class Balanced(HTMLParser):
    """Tags that are open, and what stands in cells."""

    def __init__(self, text):
        super().__init__()
        self.open, self.cells, self.tags = [], [], []
        self.feed(text)
        assert self.open == []

    def handle_starttag(self, tag, attrs):
        self.tags.append(tag)
        if tag != "img":
            self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        if self.open and self.open[-1] in ("th", "td"):
            self.cells.append(data)


def picture(html):
    (data,) = re.findall(r"src='data:image/png;base64,([^']+)'", html)
    return np.asarray(Image.open(BytesIO(b64decode(data))).convert("L"))


@pytest.mark.parametrize(
    "how",
    [{}, {"method": TINY}, {"normal": carom.KelvinVoigt(restitution=0.9)}],
    ids=["exact", "halfspace", "lossy"],
)
def test_impacts_are_a_table_and_a_picture(how):
    hit = carom.impact(PAIR, **MOTION, **how)
    html = hit._repr_html_()
    told = Balanced(html)
    rows = dict(zip(told.cells[::2], told.cells[1::2], strict=True))
    assert 8 <= len(rows) <= 12
    assert float(rows["dimensionless velocity of the contact point after"]) == pytest.approx(
        hit.psi_out, rel=1e-5
    )
    assert rows["speed of the centres after the impact"].endswith(" m/s")
    for phase in hit.phases:
        assert phase.kind in html
    assert "a_max/R*" in html
    shown = picture(html)
    assert min(shown.shape) > 200
    assert shown.std() > 10.0, "something is drawn"
    assert len(html) < 300_000


def test_fits_are_a_table_and_a_picture():
    fit = carom.fit(carom.datasets.load("kharaz2001"))
    told = Balanced(fit._repr_html_())
    assert "friction" in told.cells
    assert told.tags.count("img") == 1


def test_text_is_escaped():
    from matplotlib.figure import Figure

    html = card("a < b", {"<x>": "1 & 2"}, Figure(figsize=(1, 1)), "p < q")
    assert "<x>" not in html
    assert Balanced(html).cells == ["<x>", "1 & 2"]


def entries(text):
    return re.findall(r"^@\w+\{(\w+),$", text, re.M)


def test_what_was_used_is_cited():
    lossy = carom.impact(PAIR, **MOTION, normal=carom.KelvinVoigt(restitution=0.9))
    yielding = carom.impact(PAIR, **MOTION, normal=carom.ElasticPlastic(yield_velocity=0.1))
    assert entries(carom.impact(PAIR, **MOTION).cite()) == ["carom", "barber1979", "maw1976"]
    assert entries(lossy.cite())[-1] == "kuwabara1987"
    assert entries(yielding.cite())[-1] == "thornton1997"
    path = carom.load_path(PAIR, penetration=[1e-6], displacement=[0.0])
    assert "mindlin1953" in entries(path.cite())
    assert "kalker1990" in entries(carom.impact(PAIR, **MOTION, method=TINY).cite())


@pytest.mark.parametrize(
    "key", sorted({*IMPACT, *LOADS, *ELEMENTS, "thornton1997", "kuwabara1987"})
)
def test_every_entry_is_complete(key):
    text = bibtex(key)
    assert entries(text) == [key]
    assert text.count("{") == text.count("}")
    fields = dict(re.findall(r"^  (\w+) = \{(.+)\},$", text, re.M))
    assert {"title", "author"} <= set(fields)
    assert fields.get("year", "2026").isdigit()
    assert carom.__version__ in fields.get("version", carom.__version__)
