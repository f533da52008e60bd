"""What the columns of a lab file hold, said by lists on the page: the fit is the command's."""

from itertools import pairwise
from math import pi
from pathlib import Path

import openpyxl
import pytest
from tests.browser.test_files import fitted_friction, holding, holds, opened, taken, upload

import carom
from carom.cli import main
from carom.io.heads import as_toml, table_format

pytestmark = pytest.mark.browser
FRICTION = 0.17
ANGLES = range(8, 80, 8)
GERMAN = "Winkel zur Platte [\N{DEGREE SIGN}]"
CASE = 'friction = 0.3\n[first]\nradius = "5 mm"\nmaterial = "bearing-steel"\n'


def rows(speed=1.2):
    """Angles from the surface in deg, speeds in m/s and spins after in rpm, of a known friction."""
    body = {"material": "bearing-steel"}
    pair = carom.Pair(carom.Sphere(radius="5 mm", **body), carom.HalfSpace(**body), FRICTION)
    for angle in ANGLES:
        hit = carom.impact(pair, speed=speed, angle=f"{angle} deg")
        yield 90.0 - angle, speed, round(hit.spin_out * 30.0 / pi, 4)


def german():
    """A table as German Excel exports it."""
    lines = [f"{a};{v};{spin};gut\r\n".replace(".", ",") for a, v, spin in rows()]
    return f"{GERMAN};Tempo [m/s];Drehzahl [U/min];Notiz\r\n{''.join(lines)}".encode("cp1252")


def by_command(arguments, capsys):
    """The words of a fit that the command prints."""
    Path("case.toml").write_text(CASE)
    capsys.readouterr()
    assert main(["fit", *arguments, "--case", "case.toml", "--columns", "map.toml"]) == 0
    return capsys.readouterr().out.strip()


def fit_with_bodies_of_page(seen):
    seen.page.click("#fit-bodies")
    assert seen.until(lambda: fitted_friction(seen)) == pytest.approx(FRICTION, rel=5e-3)
    return seen.page.locator(".carom-fit-words pre").text_content().strip()


def notice(seen):
    return seen.until(lambda: seen.page.inner_text("#fit-notice"))


@pytest.mark.slow
def test_a_german_export_is_read_by_lists_and_stored(visit, tmp_path, monkeypatch, capsys):
    """By keys alone; nothing that is suggested is used before it is wanted."""
    monkeypatch.chdir(tmp_path)
    Path("lab.csv").write_bytes(german())
    seen = opened(visit(), "fit-panel")
    upload(seen, german(), "lab.csv")
    said = notice(seen)
    assert "did you mean 'spin_out'? If so, choose it in the list of the column" in said
    assert "--" not in said
    assert seen.page.locator("#fit-bodies").count() == 0
    assert holding(seen, GERMAN) == "angle of incidence from the surface · surface_angle"
    assert holding(seen, "Notiz") == "not used"
    assert holding(seen, "Drehzahl [U/min]") == "spin of the first body after · spin_out"
    assert seen.page.locator("#fit-columns").get_by_text("suggested").count() == 3
    assert "82,0 · 74,0 · 66,0" in seen.page.inner_text("#fit-columns")
    for head, quantity in (GERMAN, "angle of incidence from the s"), ("Tempo [m/s]", "speed of a"):
        holds(seen, head).focus()
        seen.page.keyboard.type(quantity)
    assert holding(seen, GERMAN) == "angle of incidence from the surface · surface_angle"
    seen.page.focus("#fit-columns-use")
    seen.page.keyboard.press("Enter")
    seen.until(lambda: seen.page.locator("#fit-bodies").is_visible())
    assert seen.page.evaluate("document.activeElement.tagName") == "SUMMARY"  # it stays there
    file = taken(seen, "#fit-columns-save", tmp_path)
    assert file.name == "map.toml"
    assert file.read_text("utf-8") == as_toml(table_format(file))  # as --save-columns writes it
    words = fit_with_bodies_of_page(seen)
    assert by_command(["lab.csv"], capsys) == words
    assert seen.page.locator("#fit-columns").get_attribute("open") is None
    seen.choose("data", "kharaz2001")
    seen.until(lambda: seen.page.inner_text(".carom-fit-head h3") == "kharaz2001")
    assert seen.page.locator("#fit-columns").count() == 0
    upload(seen, file.read_bytes(), "map.toml")
    assert "now choose the table" in notice(seen)
    upload(seen, german(), "again.csv")
    seen.page.wait_for_selector("#fit-bodies")
    said = seen.page.evaluate("document.getElementById('fit-columns').said()")
    assert said == file.read_text("utf-8")  # lists that nobody touches say what they were told
    assert fit_with_bodies_of_page(seen) == words


def test_one_of_two_sheets(visit, tmp_path, monkeypatch, capsys):
    """With a unit that no head says; a column that is taken off is no longer fitted."""
    monkeypatch.chdir(tmp_path)
    book = openpyxl.Workbook()
    for sheet, speed in ((book.active, 0.1), (book.create_sheet("Neu"), 1.2)):
        sheet.append(["surface_angle [deg]", "speed", "w", "contact_beta"])
        for row in rows(speed):
            sheet.append([*row, 0.5])
    book.save("lab.xlsx")
    seen = opened(visit(), "fit-panel")
    upload(seen, Path("lab.xlsx").read_bytes(), "lab.xlsx")
    assert "choose one in the list of sheets" in notice(seen)
    seen.page.get_by_label("Sheet").select_option("Neu")
    seen.page.click("#fit-columns-use")
    seen.until(lambda: holding(seen, "speed").startswith("speed of approach"))
    assert seen.page.locator("#fit-bodies").is_visible()
    unit = seen.page.get_by_label("unit of w", exact=True)
    assert unit.is_hidden()
    holds(seen, "w").select_option("spin_out")
    assert unit.locator("option").all_inner_texts() == ["none: rad/s", "rpm", "rad/s", "rps"]
    unit.select_option("rpm")
    holds(seen, "contact_beta").select_option("")
    words = fit_with_bodies_of_page(seen)
    seen.page.click("#fit-columns > summary")
    assert seen.page.get_by_label("Sheet").input_value() == "Neu"
    taken(seen, "#fit-columns-save", tmp_path)
    assert by_command(["lab.xlsx"], capsys) == words


@pytest.mark.parametrize("width", [400, 1400])
def test_lists_have_room_and_names(visit, width):
    seen = opened(visit("?theme=dark", width=width), "fit-panel")
    upload(seen, f"angle [deg];w{width}\n".encode() + b"1,234;2,345\n" * 3)
    seen.until(lambda: holds(seen, f"w{width}").is_visible())
    assert seen.page.evaluate("document.documentElement.scrollWidth") <= width
    boxes = [each.bounding_box() for each in seen.page.locator("#fit-columns select:visible").all()]
    assert len(boxes) == 3
    assert min(box["width"] for box in boxes) > 90
    for above, below in pairwise(boxes):
        assert above["y"] + above["height"] <= below["y"]
    asked = seen.page.context.new_cdp_session(seen.page)
    nodes = asked.send("Accessibility.getFullAXTree")["nodes"]
    lists = [each for each in nodes if each.get("role", {}).get("value") == "combobox"]
    names = {each["name"]["value"] for each in lists}
    assert {"Decimal sign", "what angle [deg] holds", f"what w{width} holds"} <= names
