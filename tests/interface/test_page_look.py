"""Phases and regimes have the names and colours of figures and fits on the page, too."""

import re
from importlib.resources import files

import pytest

pytest.importorskip("flask")

from carom.explorer.config import config
from carom.impacts.curves import REGIMES as LONG
from carom.plots.bands import BANDS
from carom.plots.regimes import REGIMES

SHEET = files("carom.explorer").joinpath("assets", "carom.css").read_text("utf-8")
LIGHT, DARK = SHEET.split(':root[data-theme="dark"]')
FILLS = {"stick": ("stick", 0), "slip": ("slip", 1), "gross": ("gross slip", 1)}


def variables(sheet):
    return dict(re.findall(r"--([\w-]+): ([^;]+);", sheet))


@pytest.mark.parametrize("name", FILLS)
def test_phases_have_the_tints_of_figures(name):
    band = BANDS[FILLS[name]]
    assert variables(LIGHT)[f"{name}-fill"] == band.face.lower()
    if band.hatch:
        assert variables(LIGHT)[f"{name}-hatch"] == band.edge.lower()


def test_regimes_have_the_names_and_tints_of_figures_and_fits():
    told = config()["regimes"]
    assert [each["name"] for each in told] == list(REGIMES)
    assert [each["long"] for each in told] == list(LONG)
    assert variables(LIGHT)["only-fill"] == REGIMES["gross slip only"].face.lower()


def test_dark_colours_are_those_of_the_light_in_another_tone():
    light, dark = variables(LIGHT), variables(DARK)
    assert set(dark) == set(light)
    assert all(dark[name] != light[name] for name in FILLS)
