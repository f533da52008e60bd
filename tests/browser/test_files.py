"""What is taken along is what the library says, and what is brought is fitted or refused."""

import runpy
from urllib.parse import urlencode

import numpy as np
import pandas as pd
import pytest
from PIL import Image
from tests.checks import measured

import carom
from carom.verify.entries import named

pytestmark = pytest.mark.browser
PAIR = carom.Pair(
    carom.Sphere(radius="5 mm", material="bearing-steel"),
    carom.HalfSpace(material="bearing-steel"),
    0.17,
)
HIT = carom.impact(PAIR, speed=1.5, angle="55 deg")
QUERY = {"friction": 0.17, "speed": 1.5, "angle": 55}
FRICTION = 0.123
LAWS = [entry.label for entry in carom.verify.catalogue()]
PICTURES = ("curve", "history", "contact", "course")


def opened(seen, panel):
    """The page with one of its tabs chosen."""
    seen.page.click(f"#tab-{panel}")
    return seen


def taken(seen, link, folder):
    """The file behind a link, as the browser saves it."""
    with seen.page.expect_download() as waiting:
        seen.page.click(link)
    file = folder / waiting.value.suggested_filename
    waiting.value.save_as(file)
    return file


@pytest.fixture
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr("carom.plots.style.DPI", 50)  # sooner stored
    return tmp_path


def table(file):
    return pd.read_csv(file).rename(columns=lambda head: head.partition(" [")[0])


def test_histories_and_pictures(visit, folder):
    seen = opened(visit(f"?{urlencode(QUERY)}"), "files")
    expected = HIT.history(201)
    for name, tolerance in (("history.csv", 1e-9), ("history.nc", 0.0)):
        file = taken(seen, f"#{name.replace('.', '-')}", folder)
        assert file.name == name
        dataset = carom.read(file) if name == "history.nc" else table(file)
        for column in ("time", "tangential_force", "stick_radius", "spin"):
            values = expected[column].values
            bound = tolerance * np.abs(values).max()
            assert dataset[column].values == pytest.approx(values, rel=0.0, abs=bound), column
    with Image.open(taken(seen, "#contact-png", folder)) as image:
        assert image.format == "PNG"
        assert min(image.size) >= 400
        assert len(image.convert("RGB").getcolors(2**24)) > 50  # not an empty sheet
    assert seen.page.inner_text("#files-notice") == "contact.png is written."
    asked = {name: seen.page.get_attribute(f"#{name}-png", "href") for name in PICTURES}
    query = asked["contact"].partition("?")[2]
    assert asked == {name: f"{name}.png?{query}" for name in PICTURES}


def test_the_lines_of_python_give_the_same_rebound(visit, folder, capsys):
    law = "mindlin"
    seen = opened(visit(f"?{urlencode({**QUERY, 'law': law, 'time': 0.3})}"), "files")
    file = taken(seen, "#view-py", folder)
    seen.page.click("#tab-code-panel")
    seen.until(lambda: seen.page.inner_text("#code").strip() == file.read_text().strip())
    runpy.run_path(str(file))
    first, second = capsys.readouterr().out.splitlines()
    assert [float(part) for part in first.split()[:2]] == [HIT.psi_in, HIT.psi_out]
    by_law = float(named(law)[0].law.rebound(HIT.psi_in, PAIR.chi, kappa=PAIR.kappa))
    assert float(second.split()[-1]) == by_law
    assert {"history.csv", "history.png", "patch.png"} <= {each.name for each in folder.iterdir()}


@pytest.mark.slow
def test_the_files_of_numbers(visit, folder, capsys):
    seen = opened(visit("?given=numbers&psi=2.2&chi=1.3"), "files")
    solved = carom.solve(2.2, 1.3)
    dataset = carom.read(taken(seen, "#history-nc", folder))
    assert float(dataset["psi_out"]) == solved.psi_out
    assert dataset["force"].values == pytest.approx(solved.history(201).force)
    assert b"<svg" in taken(seen, "#contact-svg", folder).read_bytes()
    assert taken(seen, "#curve-pdf", folder).read_bytes().startswith(b"%PDF")
    runpy.run_path(str(taken(seen, "#view-py", folder)))
    assert capsys.readouterr().out.startswith(f"{solved.psi_out} ")


def test_laws_laid_over(visit):
    """The curve of a law and its point are the law's own."""
    laws = ("mindlin", "Walton & Braun")
    seen = visit(f"?{urlencode({**QUERY, 'law': laws}, doseq=True)}")
    chart = seen.laid_over(*laws)
    answered = seen.page.evaluate("Carom.page.answers()[0].laws")
    for answer in answered:
        law = named(answer["label"])[0].law
        line = chart[answer["label"], "lines"]
        psi = np.array(line["x"])
        expected = law.rebound(psi, PAIR.chi, kappa=PAIR.kappa)
        assert psi.size > 40
        assert np.array(line["y"]) == pytest.approx(expected, abs=2e-4)
        at = float(law.rebound(HIT.psi_in, PAIR.chi, kappa=PAIR.kappa))
        assert answer["at"] == pytest.approx(at, rel=1e-9)
        assert answer["off"] == pytest.approx(at - HIT.psi_out, abs=1e-8)
    assert {(label, "lines") for label in laws} <= set(seen.laid_over(*laws, chart="forces"))


@pytest.mark.slow
def test_laws_that_take_long_follow_the_answer(visit):
    """However fast the bodies change, in the end all laws are there, for the bodies at last."""
    query = {"given": "numbers", "psi": 1.1, "law": LAWS}
    seen, chi = visit(f"?{urlencode(query, doseq=True)}"), 1.48
    seen.page.focus("#chi-slider")
    for _ in range(8):
        seen.page.keyboard.press("ArrowRight")
    seen.linked(f"chi={chi}")
    expected = {label: float(named(label)[0].law.rebound(1.1, chi)) for label in LAWS}

    def all_there():
        laws = seen.page.evaluate("Carom.page.answers()[0].laws")
        return {law["label"]: law["at"] for law in laws} == pytest.approx(expected, rel=1e-9)

    seen.until(all_there)
    seen.page.wait_for_timeout(500)
    assert all_there()


def upload(seen, content, name="mine.csv"):
    file = {"name": name, "mimeType": "text/csv", "buffer": content}
    seen.page.set_input_files("#upload", file)


def fitted_friction(seen):
    """The friction in the table of parameters, once the fit is there."""
    row = seen.page.locator(".carom-parameters tbody tr").filter(has_text="friction")
    return float(row.locator("td").nth(2).inner_text())


def holds(seen, head):
    """The list of what a column holds, by its name for a screen reader."""
    return seen.page.get_by_label(f"what {head} holds", exact=True)


def holding(seen, head):
    """What a column was taken for, as its list shows it."""
    return holds(seen, head).evaluate("list => list.selectedOptions[0].text")


BAD = {
    "text.csv": b"once upon a time\nthere was a ball\n",
    "columns.csv": b"colour,size\n1,2\n3,4\n",
    "binary.csv": bytes(range(256)) * 40,
    "empty.csv": b"",
    "words.csv": b"angle [deg],contact_beta\nten,half\n",
    "large.csv": b"angle [deg],contact_beta\n" + b"10,0.5\n" * 150_000,
    "../../etc/passwd": b"root\n",
}


def test_bodies_are_asked_for_and_a_fit_stays_until_another_is_wanted(visit):
    seen = opened(visit(), "fit-panel")
    upload(seen, measured(FRICTION).encode())
    seen.page.wait_for_selector("#fit-bodies")
    assert seen.page.locator(".carom-parameters").count() == 0
    words = seen.page.inner_text("#fit-ask")
    assert "mine.csv does not say which bodies struck each other" in words
    assert holding(seen, "angle [deg]") == "angle of incidence from the normal · angle"
    assert holding(seen, "run") == "not used"
    seen.page.fill("#radius", "6")
    seen.until(lambda: "ball of 6 mm radius" in seen.page.inner_text("#fit-bodies"))
    seen.page.fill("#radius", "5")
    seen.page.click("#fit-bodies")
    assert seen.until(lambda: fitted_friction(seen)) == pytest.approx(FRICTION, rel=0.02)
    assert "those of the page: ball of 5 mm radius" in seen.page.inner_text(".carom-fit-head")
    seen.page.fill("#radius", "7")
    seen.page.wait_for_selector("#fit-again")
    seen.page.wait_for_timeout(300)
    assert "ball of 5 mm" in seen.page.inner_text(".carom-fit-head")
    seen.page.click("#fit-again")
    seen.until(lambda: "ball of 7 mm" in seen.page.inner_text(".carom-fit-head"))
    seen.page.fill("#angle", "20")  # no body of the fit
    seen.linked("angle=20")
    assert seen.page.is_hidden("#fit-ask")
    seen.choose("given", "ψ₁ and χ")
    upload(seen, measured(FRICTION).encode())
    seen.until(lambda: "Choose bodies in the controls first" in seen.page.inner_text("#fit-ask"))
    assert seen.page.locator("#fit-bodies").count() == 0
    seen.choose("given", "bodies")
    seen.page.click("#fit-bodies")
    assert seen.until(lambda: fitted_friction(seen)) == pytest.approx(FRICTION, rel=0.02)


@pytest.mark.slow
def test_uploads_are_fitted_or_refused_in_a_line(visit):
    seen = opened(visit(), "fit-panel")
    for name, content in BAD.items():
        upload(seen, content, name)
        notice = seen.until(lambda: seen.page.inner_text("#fit-notice"))
        for odd in ("\n", "Traceback", "failed", "/tmp"):
            assert odd not in notice, (name, notice)
        upload(seen, measured(FRICTION).encode(), "good.csv")
        seen.page.click("#fit-bodies")
        assert seen.until(lambda: fitted_friction(seen)) == pytest.approx(FRICTION, rel=0.02)
        assert seen.page.inner_text("#fit-notice") == ""
    assert seen.notice() == ""
    seen.trouble[:] = [line for line in seen.trouble if "400" not in line]  # of what is refused


@pytest.mark.slow
def test_the_last_of_file_and_data_set_counts(visit):
    seen, name = opened(visit(), "fit-panel"), carom.datasets.names()[0]
    head = ".carom-fit-head h3"
    for _ in range(2):  # the same file can be sent again
        upload(seen, measured(FRICTION).encode(), "own.csv")
        seen.page.click("#fit-bodies")
        seen.until(lambda: seen.page.inner_text(head) == "own.csv")
        seen.linked("!data=")
        seen.choose("data", name)
        seen.until(lambda: seen.page.inner_text(head) == name)
        seen.linked(f"data={name}")
    seen.page.fill("#radius", "6.5")
    seen.linked("radius=6.5")
    seen.page.wait_for_timeout(300)
    assert seen.page.inner_text(head) == name  # still that of the data set
    assert seen.page.is_hidden("#fit-ask")


def test_a_fit_is_drawn_in_one_view_without_anything_cut(visit):
    seen = opened(visit("?data=kharaz2001"), "fit-panel")
    seen.page.wait_for_selector("#fit .carom-fit-residual .main-svg", state="attached")
    for width in (400, 1024, 1440, 1920):
        seen.page.set_viewport_size({"width": width, "height": 900})
        seen.settle()
        check_fit(seen, width)


def check_fit(seen, width):
    assert seen.page.evaluate("document.documentElement.scrollWidth") <= width
    boxes = seen.page.evaluate(
        "[...document.querySelectorAll('#fit .carom-cell, #fit table')].map(each => {"
        " const {left, right, top, bottom} = each.getBoundingClientRect();"
        " return [left, right, top, bottom, each.scrollWidth - each.clientWidth]; })"
    )
    assert len(boxes) >= 6
    for row, (left, right, top, bottom, over) in enumerate(boxes):
        assert over <= 1
        for left2, right2, top2, bottom2, _ in boxes[row + 1 :]:
            apart = right <= left2 + 1 or right2 <= left + 1 or bottom <= top2 + 1
            assert apart or bottom2 <= top + 1
    if width >= 1000:  # the three responses stand beside each other
        tops = {round(box[2]) for box in boxes[-4:-1]}
        assert len(tops) == 1


def test_the_lines_are_those_of_the_link(visit):
    seen = opened(visit("?angle=50"), "code-panel")
    seen.until(lambda: 'angle="50.0 deg"' in seen.page.inner_text("#code"))
    seen.page.focus("#angle-slider")
    for key in ("ArrowRight", "ArrowLeft"):
        seen.page.keyboard.press(key)
        seen.page.wait_for_timeout(250)
    seen.linked("angle=50")
    seen.until(lambda: 'angle="50.0 deg"' in seen.page.inner_text("#code"))
    seen.page.wait_for_timeout(300)
    assert 'angle="50.0 deg"' in seen.page.inner_text("#code")  # and stays
