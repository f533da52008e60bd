"""What the page is told: its fields, contact laws and findings, as JSON holds them."""

import json
import re
from dataclasses import fields
from importlib.resources import files
from urllib.parse import urlencode

import numpy as np
import pytest

pytest.importorskip("flask")

from carom.explorer.outcomes import impact_of, outcome_of, verdict
from carom.explorer.overlays import law_curves, laws
from carom.explorer.page import REGIMES, config
from carom.explorer.views import FIELDS, LAWS, NUMBERS, PAGE, View
from carom.impacts.curves import REGIMES as LONG
from carom.plots.bands import BANDS
from carom.plots.impact import ENERGIES as IN_FIGURES, LOST
from carom.plots.regimes import REGIMES as OF_FIGURES


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
    assert {name: words[0] for name, words in (IN_FIGURES | LOST).items()} == PAGE["energies"]
    assert set(record["energies"]) == {*PAGE["energies"], *PAGE["energies_of_contact"]}
    for preset in record["presets"]:
        verdict(View.of(preset["query"]))


SHEET = files("carom.explorer").joinpath("assets", "carom.css").read_text("utf-8")
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
