"""What the page is told: its fields, contact laws and findings, as JSON holds them."""

import json
import re
from dataclasses import fields
from importlib.resources import files
from urllib.parse import urlencode

import numpy as np
import pytest

pytest.importorskip("flask")

from carom.impacts.curves import REGIMES as LONG
from carom.page.outcomes import apart, impact_of, outcome_of, plain, verdict
from carom.page.overlays import law_curves, laws
from carom.page.page import REGIMES, config
from carom.page.views import FIELDS, LAWS, MATERIALS, NUMBERS, PAGE, View
from carom.plots.bands import BANDS
from carom.plots.impact import ENERGIES as IN_FIGURES, LOST
from carom.plots.regimes import REGIMES as OF_FIGURES
from carom.quantities.verdicts import Finding


def test_laws_are_those_of_the_outcome_as_json_holds_them():
    view = View(given=NUMBERS, psi=1.0, chi=1.61803, law=LAWS)
    followed = json.loads(json.dumps(laws(view), allow_nan=False))
    assert followed["slow"] == []
    assert [law["label"] for law in followed["laws"]] == list(LAWS)
    outcome = outcome_of(view)
    for law, curve in zip(followed["laws"], law_curves(outcome, LAWS), strict=True):
        assert law["at"] == curve.at
        assert law["off"] == pytest.approx(curve.at - outcome.psi_out, abs=1e-15)
        np.testing.assert_allclose(law["out"], curve.psi_out, atol=1e-7)


RUBBER = View(radius=0.2, material="rubber", speed=60.0, second_material="steel", friction=0.05)


@pytest.mark.parametrize(
    "view", [RUBBER, View(thickness=10.0, speed=20.0)], ids=["rubber", "plate"]
)
def test_findings_speak_of_the_page(view):
    reply, actual = verdict(view), impact_of(view).validity
    assert len(reply) == len(actual.findings)
    marks = [row["mark"] for row in reply]
    assert marks == sorted(marks, key=["FAILS", "?", "ok"].index)
    assert marks.count("FAILS") == sum(finding.holds is False for finding in actual.findings) > 0
    for row in reply:
        for word in ("method=", "psi_", "mu ", "chi", "thickness", "inf"):
            assert not re.search(rf"\b{word}", row["text"])


PAGE_STATES = {  # what decides, and what is said of it
    "material=rubber&second_material=steel&speed=30": (
        *("FAILS", "a_max/R*", "rubber is pressed too flat for this theory: {value}, 0.1 allowed"),
    ),
    "material=own&young=0.01&poisson=0.5&density=910&speed=4": (
        *(
            "FAILS",
            "a_max/R*",
            "the ball is pressed too flat for this theory: {value}, 0.1 allowed",
        ),
    ),
    "second_material=own&second_young=0.01&speed=4": (
        *("FAILS", "a_max/R*", "what it strikes is pressed too flat for this theory: {value}"),
    ),
    "speed=5": ("FAILS", "von Mises stress/Y", "the material yields: {value} of its strength, 1"),
    "thickness=40&speed=0.6": ("?", "bending wave/h", "the plate is neither thin nor a thick wall"),
    "speed=0.6": ("?", "rms roughness/penetration", "no roughness of the surfaces is known"),
    "thickness=2&speed=20": ("FAILS", "a_max/h", "too large for the plate: {value} of its"),
    "material=concrete&second_material=steel&speed=0.1": (
        *("FAILS", "energy lost in the material", "always loses energy: {value} of it, 0.02"),
    ),
    "material=own": ("?", "von Mises stress/Y", "no yield strength of your material is known"),
    "restitution=0.9&angle=20": ("?", "e", "what the bodies lose sideways is assumed"),
}


@pytest.mark.parametrize("query", PAGE_STATES)
def test_a_verdict_is_told_in_plain_words_with_its_numbers(query):
    """The first level of the page shows the number and the limit, and no letters."""
    mark, name, words = PAGE_STATES[query]
    view = View.of(query)
    actual = {finding.name: finding for finding in impact_of(view).validity.findings}[name]
    (row,) = [
        row
        for row in verdict(view)
        if row["text"].startswith(f"{name} ") or (row["text"].startswith(f"{name}:"))
    ]
    assert row["mark"] == mark
    assert words.format(value=f"{actual.value:.2g}") in row["plain"]
    assert not set(row["plain"]) & set("ψχκ_*=µ")


def test_what_is_beside_its_limit_is_told_apart_from_it():
    assert apart(0.31, 0.1) == ("0.31", "0.1")
    assert apart(0.1004, 0.1) == ("0.1004", "0.1")
    assert apart(213.0, 1.0) == ("210", "1")


def test_findings_that_the_page_does_not_know_are_told_in_their_own_words():
    pair = View().pair
    new = Finding("roughness/d", 0.3, 0.1, False, "the surfaces are too rough")
    lacks = Finding("roughness/d", 0.3, 0.1, None, "not judged: no roughness of own", "roughness")
    assert plain(new, pair) == "the surfaces are too rough"
    assert plain(lacks, pair) == "no roughness of your material is known"


def test_no_finding_on_random_impacts_is_told_in_letters():
    """Each is told; each that has plain words has its number and its limit in them."""
    random = np.random.default_rng(63)
    for _ in range(60):
        view = View(
            material=str(random.choice(MATERIALS)),
            second_material=str(random.choice(MATERIALS)),
            against=str(random.choice(["half-space", "sphere"])),
            angle=float(random.choice([0.0, 20.0, 60.0])),
            speed=float(10.0 ** random.uniform(-2.0, 1.5)),
            friction=float(random.choice([0.0, 0.2, 0.6])),
            restitution=float(random.choice([1.0, 0.8])),
            radius=float(10.0 ** random.uniform(-1.0, 1.5)),
        )
        for row in verdict(view):
            assert row["plain"]
            if row["mark"] != "ok":
                assert not set(row["plain"].replace("µm", "")) & set("ψχκ_*=µβ"), row


def test_the_page_is_told_all_that_it_shows():
    record = json.loads(json.dumps(config(), allow_nan=False))
    assert set(record["fields"]) == {field.name for field in fields(View)}
    for name, field in record["fields"].items():
        assert field["label"]
        assert FIELDS[name].is_number == (field["most"] is not None)
        assert View.of(urlencode({name: field["default"]}, doseq=True)) == View()
        assert field["symbol"] in ("", *record["symbols"])
    assert [law["label"] for law in record["laws"]] == list(LAWS)
    assert record["materials"]["rigid"]["young"] is None
    assert record["materials"]["steel"] == {"young": 210e9, "poisson": 0.3, "density": 7850}
    assert tuple(OF_FIGURES) == REGIMES
    assert set(PAGE["energies"]) == {*IN_FIGURES, *LOST}
    assert {name: PAGE["energies"][name] for name in IN_FIGURES} == {
        name: words for name, (words, *_) in IN_FIGURES.items()
    }
    assert PAGE["energies"]["normal_loss"] == PAGE["lost"]["bodies"]  # the page knows which it is
    assert PAGE["energies"]["frictional_work"] == PAGE["lost"]["friction"]
    assert set(record["energies"]) == {*PAGE["energies"], *PAGE["energies_of_contact"]}
    for preset in record["presets"]:
        verdict(View.of(preset["query"]))


SHEET = files("carom.page").joinpath("assets", "carom.css").read_text("utf-8")
LIGHT, DARK = SHEET.split(':root[data-theme="dark"]')
FILLS = {"stick": ("stick", 0), "slip": ("slip", 1), "gross": ("gross slip", 1)}


def variables(sheet):
    return dict(re.findall(r"--([\w-]+): ([^;]+);", sheet))


def test_phases_have_the_tints_of_figures():
    tints = variables(LIGHT)
    for name, phase in FILLS.items():
        assert tints[f"{name}-fill"] == BANDS[phase].face.lower()
        assert name == "stick" or tints[f"{name}-hatch"] == BANDS[phase].edge.lower()


def test_regimes_have_the_names_and_tints_of_figures_and_fits():
    regimes = config()["regimes"]
    assert [each["name"] for each in regimes] == list(OF_FIGURES)
    assert [each["long"] for each in regimes] == list(LONG)
    assert variables(LIGHT)["only-fill"] == OF_FIGURES["gross slip only"].face.lower()


def test_dark_colours_are_those_of_the_light_in_another_tone():
    light, dark = variables(LIGHT), variables(DARK)
    assert set(dark) == set(light)
    assert all(dark[name] != light[name] for name in FILLS)
