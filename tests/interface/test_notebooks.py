"""How results look in a notebook, and what they say to cite."""

import re
from base64 import b64decode
from html import unescape
from html.parser import HTMLParser
from io import BytesIO

import numpy as np
import pandas as pd
import pytest
from matplotlib.figure import Figure
from PIL import Image

import carom
from carom.io.citations import ELEMENTS, FITS, IMPACT, LOADS, SAMPLES, VISCOUS, bibtex
from carom.plots.result import card

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


@pytest.mark.first_case
@pytest.mark.parametrize(
    "how",
    [{}, {"method": TINY}, {"losses": carom.KelvinVoigt(restitution=0.9)}],
    ids=["exact", "halfspace", "lossy"],
)
def test_impacts_are_a_table_and_a_picture(pair, how):
    hit = carom.impact(pair, **MOTION, **how)
    rows, html = table_and_html(hit)
    assert 8 <= len(rows) <= 12
    after = float(rows["dimensionless velocity of the contact point after"])
    assert after == pytest.approx(hit.psi_out, rel=1e-5)
    assert rows["speed of the centres after the impact"].endswith(" m/s")
    for phase in hit.phases:
        assert phase.kind in html
    assert "a_max/R*" in html
    shown = picture(html)
    assert min(shown.shape) > 200
    assert shown.std() > 10.0, "something is drawn"
    assert len(html) < 300_000


@pytest.mark.slow
def test_fits_are_a_table_and_a_picture():
    fit = carom.fit(carom.datasets.load("kharaz2001"))
    answer = Balanced(fit._repr_html_())
    assert "friction" in answer.cells
    assert answer.tags.count("img") == 1


def table_and_html(result):
    """Return the table of a result, and its HTML."""
    html = result._repr_html_()
    cells = Balanced(html).cells
    return dict(zip(cells[::2], cells[1::2], strict=True)), html


def test_load_paths_are_a_table_and_a_picture(pair):
    path = carom.load_path(pair, normal_force=[1.0, 10.0], tangential_force=[0.0, 1.5])
    rows, html = table_and_html(path)
    assert rows["normal force"] == "1 to 10 N"
    assert rows["tangential force, positive against V_x"] == "0 to 1.5 N"
    for line, row in zip(str(path).splitlines()[1:], rows.items(), strict=True):
        assert re.split(rf"(?<={row[0][-9:]}) +", line.strip()) == [*row]
    assert picture(html).std() > 10.0
    one = carom.load_path(pair, normal_force=1.0, tangential_force=0.0)
    assert "<img" not in one._repr_html_(), "a single step is no line"


def test_rankings_are_a_table_and_a_picture():
    laws = [carom.dem.LinearSpring(), carom.dem.HardSphere()]
    ranking = carom.verify.rank(laws, psi_1=[1.0, 2.0])
    rows, html = table_and_html(ranking)
    worst = {one.entry.label: one.max_error for one in ranking.standings}
    shown = {name: float(text.split()[0]) for name, text in rows.items()}
    assert shown == pytest.approx(worst, abs=5e-4)
    assert picture(html).std() > 10.0


def test_tunings_are_a_table():
    laws = [carom.dem.HardSphere(), carom.dem.ThorntonLaw()]
    rows, html = table_and_html(carom.verify.tune(laws, chi=1.44))
    assert next(iter(rows)) == "Thornton, incremental"
    assert "tangential_restitution 0.36" in rows["hard sphere"]
    assert "<img" not in html


@pytest.mark.parametrize(("error", "verdict"), [(0.0, "PASS"), (0.1, "FAIL")])
def test_scores_are_a_verdict_a_table_and_a_picture(error, verdict):
    psi = np.array([0.5, 1.0, 2.0])
    results = {"psi_1": psi, "psi_2": carom.rebound(psi, 1.44) - error}
    rows, html = table_and_html(carom.verify.score(results, chi=1.44))
    assert f"<strong>{verdict}: max |error in psi_2| = {error:.4g} " in html
    assert float(rows["all"]) == pytest.approx(error)
    assert picture(html).std() > 10.0


def test_collisions_are_counted(pair):
    velocity = [[0.0, 0.0, 1.0], [0.0, 0.0, -1.0], [0.0, 0.0, 2.0], [0.0, 0.0, np.nan]]
    with pytest.warns(UserWarning, match="1 with a number that is not finite"):
        after = carom.collide(pair, velocity1=velocity, normal=[0.0, 0.0, 1.0])
    rows, html = table_and_html(after)
    assert rows["collided"] == "2"
    assert rows["left alone: the bodies do not approach"] == "1"
    assert "4 collisions" in html


@pytest.mark.parametrize(
    ("of", "text"),
    [
        (
            lambda hit: hit.pair,
            "sphere (steel, R = 5 mm) on half-space (steel): friction 0.2, chi 1.441, ",
        ),
        (lambda hit: hit.validity, "ok    a_max/R* = 0.0604: the contact is small"),
        (
            lambda _: carom.results.Estimate("friction", 0.0921, 0.0914, 0.0928),
            "0.0921 (0.0914 to 0.0928)",
        ),
    ],
    ids=["pair", "validity", "estimate"],
)
def test_what_prints_as_text_is_that_text_in_notebooks_and_data_frames(hit, of, text):
    shown = of(hit)
    assert str(shown).startswith(text)
    assert unescape(shown._repr_html_()) == f"<pre>{shown}</pre>"
    assert text in pd.DataFrame({"it": [shown]}).to_string(max_colwidth=None)


@pytest.mark.parametrize(
    ("of", "text"),
    [
        (lambda hit: hit.pair.first, "sphere (steel, R = 5 mm)"),
        (lambda hit: hit.pair.second, "half-space (steel)"),
        (lambda hit: hit.pair.first.material, "steel\n  Young's modulus 210 GPa\n"),
        (lambda _: carom.materials(), "name                     E (GPa)     nu  rho (kg/m^3)"),
        (lambda _: carom.solve(1.5, 1.44), "psi_1 = 1.5, chi = 1.44: psi_2 = -0.429967 (solved)\n"),
        (lambda hit: hit.contact("10 us"), "Contact, gross slip +\n  coefficient of friction  "),
        (
            lambda _: carom.datasets.table("kharaz2001"),
            "       angle  angle_error  speed  tangential_restitution",
        ),
    ],
    ids=["sphere", "half-space", "material", "materials", "solution", "contact", "table"],
)
def test_print_and_a_notebook_show_the_same_lines(hit, of, text):
    shown = of(hit)
    assert str(shown).startswith(text)
    assert unescape(shown._repr_html_()) == f"<pre>{shown}</pre>"


def test_cards_are_readable_on_any_ground(hit):
    """Text has the colours of the notebook; pictures are black on white."""
    html = hit._repr_html_()
    assert not re.search(r"(?<!-)color:", html)
    shown = picture(html)
    edges = (shown[0], shown[-1], shown[:, 0], shown[:, -1])
    assert all(np.all(edge == 255) for edge in edges)


def test_text_is_escaped():
    html = card("a < b", {"<x>": "1 & 2"}, Figure(figsize=(1, 1)), "p < q")
    assert "<x>" not in html
    assert Balanced(html).cells == ["<x>", "1 & 2"]


def entries(text):
    return re.findall(r"^@\w+\{(\w+),$", text, re.M)


def test_what_was_used_is_cited(pair):
    lossy = carom.impact(pair, **MOTION, losses=carom.KelvinVoigt(restitution=0.9))
    yielding = carom.impact(pair, **MOTION, losses=carom.ElasticPlastic(yield_velocity=0.1))
    assert entries(carom.impact(pair, **MOTION).cite()) == ["carom", "barber1979", "maw1976"]
    assert entries(lossy.cite())[-1] == "kuwabara1987"
    assert entries(yielding.cite())[-1] == "thornton1997"
    path = carom.load_path(pair, penetration=[1e-6], displacement=[0.0])
    assert "mindlin1953" in entries(path.cite())
    aside = path.then(normal_force=10.0, tangential_force=[[0.0, 0.5]])
    assert entries(aside.cite())[-1] == "moreau1977"
    assert "kalker1990" in entries(carom.impact(pair, **MOTION, method=TINY).cite())
    assert entries(carom.laws.ReboundLaw(1.44).cite()) == list(IMPACT)
    table = {"psi_1": [0.5, 1.0, 2.0], "psi_2": [0.0, 0.0, 0.0]}
    assert entries(carom.verify.score(table, chi=1.44).cite()) == list(IMPACT)


LOADED = [(carom.datasets.load, name) for name in carom.datasets.names()]


@pytest.mark.first_case
@pytest.mark.parametrize(("get", "name"), [*LOADED, (carom.datasets.path, "foerster1994")])
def test_the_data_of_a_fit_are_cited(name, get):
    """As file and as dataset; the entry has the DOI that the data tell."""
    fit = carom.fit(get(name), fixed={"restitution": 1.0})
    source = name.split("_")[0]
    assert entries(fit.cite()) == [*FITS, source]
    assert carom.datasets.load(name).doi in fit.cite()
    assert entries(fit.cite(posterior=True))[4:] == [*SAMPLES, source]


def test_fits_cite_losses_and_data_of_ones_own(pair, tmp_path):
    table = {"angle [deg]": [10.0, 20.0, 40.0, 60.0, 75.0]}
    motion = {"speed": 2.0, "losses": carom.KelvinVoigt(restitution=0.9)}
    hits = [carom.impact(pair, angle=f"{a} deg", **motion) for a in table["angle [deg]"]]
    for name in ("contact_restitution", "normal_restitution"):
        table[name] = [getattr(hit, name) for hit in hits]
    file = tmp_path / "own.csv"
    file.write_text("# doi: 10.1000/182\n" + pd.DataFrame(table).to_csv(index=False))
    text = carom.fit(file, pair=pair).cite()
    assert entries(text) == [*FITS, "kuwabara1987", "data"]
    assert "doi = {10.1000/182}" in text
    assert entries(carom.fit(table, pair=pair).cite()) == [*FITS, "kuwabara1987"]


@pytest.mark.parametrize(
    "key",
    sorted({*IMPACT, *LOADS, *ELEMENTS, *FITS, *SAMPLES, "thornton1997", VISCOUS, "kharaz2001"}),
)
def test_every_entry_is_complete(key):
    text = bibtex(key)
    assert entries(text) == [key]
    assert text.count("{") == text.count("}")
    fields = dict(re.findall(r"^  (\w+) = \{(.+)\},$", text, re.M))
    assert {"title", "author"} <= set(fields)
    assert fields["year"].isdigit()
    assert carom.__version__ in fields.get("version", carom.__version__)
