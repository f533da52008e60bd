"""The report of a fit: one file that holds everything, safe to open, whole or not at all."""

import re
from html.parser import HTMLParser

import numpy as np
import pytest
from matplotlib.backends.backend_pdf import PdfPages
from tests.checks import refused

import carom

BALL = carom.Sphere(radius="10 mm", material="bearing steel")
PAIR = carom.Pair(BALL, carom.HalfSpace(material="bearing steel"), friction=0.12)
DEGREES = np.array([5.0, 10.0, 15.0, 20.0, 30.0, 40.0, 50.0, 60.0])
HOSTILE = "<script>alert(1)</script>&\"'"
SECTIONS = [
    "What was read",
    "Data and fit",
    "Parameters",
    "What the uncertainty comes from",
    "What was neglected",
    "Notes",
    "Laws of rebound",
    "To copy into a paper",
    "How it was made",
    "References",
]


class Tags(HTMLParser):
    """The tags of a page, with their attributes, and the text of each heading."""

    def __init__(self, page):
        super().__init__()
        self.tags, self.headings, self.open = [], [], []
        self.feed(page)

    def handle_starttag(self, tag, attributes):
        self.tags.append((tag, dict(attributes)))
        if tag not in {"meta", "img", "source"}:
            self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        if self.open and self.open[-1] == "h2":
            self.headings.append(data)


@pytest.fixture(scope="module")
def table():
    hits = [carom.impact(PAIR, speed=0.6, angle=f"{angle} deg") for angle in DEGREES]
    noise = np.random.default_rng(3).normal(0.0, 0.4, (2, len(hits)))
    return {
        "angle [deg]": DEGREES,
        "speed [m/s]": np.full(len(hits), 0.6),
        "rebound_angle [deg]": np.degrees([hit.rebound_angle for hit in hits]) + noise[0],
        "spin_out": np.array([hit.spin_out for hit in hits]) + noise[1],
        HOSTILE: np.zeros(len(hits)),
    }


@pytest.fixture(scope="module")
def outlying(table):
    """A fit with one spin ten times too large, and an unused column with a hostile head."""
    spins = np.where(np.arange(len(DEGREES)) == 5, 10.0, 1.0) * table["spin_out"]
    return carom.fit({**table, "spin_out": spins}, pair=PAIR, fixed={"restitution": 1.0})


@pytest.fixture(scope="module")
def page(outlying, tmp_path_factory):
    path = tmp_path_factory.mktemp("report") / "report.html"
    assert outlying.report(path, f"Title {HOSTILE}", f"carom fit {HOSTILE}") == path
    return path.read_text(encoding="utf-8")


@pytest.mark.slow
def test_all_sections_are_there(page):
    assert Tags(page).headings == SECTIONS


def test_it_stands_alone_without_scripts(page):
    tags = Tags(page).tags
    assert not {name for name, _ in tags} & {"script", "link", "iframe", "object", "form", "a"}
    assert not [key for _, attributes in tags for key in attributes if key.startswith("on")]
    sources = [attributes["srcset"] for name, attributes in tags if name in ("img", "source")]
    assert len(sources) == 2
    assert sources[0] != sources[1]  # for a wide and a narrow screen
    assert all(source.startswith("data:image/png;base64,") for source in sources)
    policy = [a["content"] for name, a in tags if name == "meta" and "content" in a][-1]
    assert "default-src 'none'" in policy
    assert "script" not in policy


def test_texts_of_the_user_are_escaped(page):
    assert HOSTILE not in page
    assert (
        page.count("&lt;script&gt;alert(1)&lt;/script&gt;") == 4
    )  # twice the title; note; command


def test_it_tells_the_parameters_the_outlier_and_the_sentence(page, outlying):
    text = re.sub("<[^>]*>", " ", page)
    assert str(outlying.friction) in text
    assert "outliers: row 6" in text
    assert "From 8 rebounds of a sphere (bearing-steel, R = 10 mm)" in text
    assert "restitution 1 held fixed" in text
    assert "speed_error, angle_error: none, taken as zero" in text.replace(
        "angle_error, speed_error", "speed_error, angle_error"
    )
    assert "both bodies stay elastic" in text


def test_an_outlier_is_marked_and_leaves_the_residuals_readable(outlying):
    dataset = outlying.to_dataset()
    row, response = np.argwhere(dataset.outlier.values == 1).T
    assert [*dataset.row.values[row]] == [6]
    assert [*dataset.response.values[response]] == ["spin_out"]
    figure = outlying.plot()
    residuals = figure.axes[3]
    others = np.nanmax(np.abs(np.where(dataset.outlier == 1, np.nan, dataset.residual)[:, 1]))
    error = dataset.error.values[:, 1].max()
    assert np.ptp(residuals.get_ylim()) < 5.0 * (others + error)
    assert [text.get_text() for text in residuals.texts] == ["6"]
    assert "outlier, with its row" in [text.get_text() for text in figure.legends[0].get_texts()]


def test_normal_drops_have_a_report_of_the_restitution_alone(tmp_path):
    heights = {"drop_height": np.full(5, 0.02), "rebound_height": 0.02 * np.linspace(0.8, 0.84, 5)}
    found = carom.fit(heights, pair=PAIR)
    page = found.report(tmp_path / "drops.html").read_text()
    assert "Laws of rebound" not in Tags(page).headings
    assert "drop_height" in page
    assert "rebound_height" in page
    assert "From 5 drops of a sphere" in page
    assert "Maw, Barber &amp; Fawcett" not in page
    assert found.plot().axes[1].get_xlabel() == "row"


@pytest.fixture
def pages(monkeypatch):
    """The figures that become the pages of a PDF."""
    kept, save = [], PdfPages.savefig

    def keep(self, figure):
        kept.append(figure)
        save(self, figure)

    monkeypatch.setattr(PdfPages, "savefig", keep)
    return kept


@pytest.mark.slow
def test_pages_have_room_for_all_texts_and_the_figure_below_its_heading(outlying, tmp_path, pages):
    path = outlying.report(tmp_path / "report.pdf", "Title $x \ud800", "carom fit $" + 300 * "x")
    content = path.read_bytes()
    assert content.startswith(b"%PDF")
    assert content.count(b"/Type /Page ") == len(pages) >= 3
    words = [text.get_text() for page in pages for text in page.texts]
    assert words[1] == "Title $x ?"
    assert [each for each in words if each in SECTIONS] == SECTIONS
    for page in pages:
        boxes = [text.get_window_extent() for text in page.texts if text.get_text()]
        boxes += [axis.get_window_extent() for axis in page.axes]
        for place, box in enumerate(boxes):
            assert page.bbox.x0 < box.x0 < box.x1 < page.bbox.x1
            assert page.bbox.y0 < box.y0 < box.y1 < page.bbox.y1
            assert not any(box.overlaps(other) for other in boxes[:place])


@pytest.mark.slow
def test_tables_stand_whole_on_a_page_with_their_heading(outlying, tmp_path, pages):
    outlying.report(tmp_path / "report.pdf")
    laws = ["Laws of rebound", "exact", "Walton", "rigid Coulomb"]
    places = [{text.get_text() for text in page.texts} & {*laws} for page in pages]
    assert sorted(map(len, places)) == [0] * (len(pages) - 1) + [len(laws)]


def test_another_ending_is_refused_and_nothing_written(outlying, tmp_path):
    refused(".html or .pdf", outlying.report, tmp_path / "report.docx")
    refused("title", outlying.report, tmp_path / "report.html", 5)
    assert not [*tmp_path.iterdir()]


def test_a_report_that_fails_leaves_the_old_one(outlying, tmp_path, monkeypatch):
    old = tmp_path / "report.pdf"
    old.write_text("old")

    def fail(*_, **__):
        raise RuntimeError("full")

    monkeypatch.setattr(PdfPages, "savefig", fail)
    with pytest.raises(RuntimeError, match="full"):
        outlying.report(old)
    assert old.read_text() == "old"
    assert [*tmp_path.iterdir()] == [old]
