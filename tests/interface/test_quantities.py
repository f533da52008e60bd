"""Quantities as texts and arrays: what the functions that read and print them make of examples."""

from math import inf, nan, pi

import numpy as np
import pytest
import xarray as xr

import carom
from carom.plots.style import label
from carom.quantities import arrays, prefixes, texts, units
from carom.quantities.glossary import meant
from carom.quantities.refusals import Faults, known_keywords, refuse
from carom.quantities.statuses import WordedStatus
from carom.verify.tables import text_table


def refused(words):
    return pytest.raises(carom.InputError, match=f"^{words}$")


@pytest.mark.parametrize(
    ("value", "unit", "text"),
    [
        (0.000187666, "m", "187.666 µm"),
        (2.1e11, "Pa", "210 GPa"),
        (-0.0, "N", "0 N"),
        (0.25, "1", "0.25"),
        (0.349066, "rad", "20 deg (0.349066 rad)"),
        (4e-17, "m^3", "40 µm^3"),
        (4.1e-6, "kg", "4.1 mg"),
        (7850.0, "kg/m^3", "7850 kg/m^3"),
    ],
)
def test_values_with_units(value, unit, text):
    assert prefixes.text(value, unit) == text


def test_several_values_in_one_unit():
    assert prefixes.span(0.0, 845.996, "N") == "0 to 845.996 N"
    assert prefixes.span(0.0, 2e-5, "m") == "0 to 20 µm"
    assert prefixes.span(0.5, 0.5, "1") == "0.5"
    assert prefixes.span(0.0, 0.349066, "rad") == "0 to 20 deg (0 to 0.349066 rad)"
    assert prefixes.shared((-6.472e-5, 0.0, 1.385e-4), "m") == (("-64.72", "0", "138.5"), "µm")
    column = prefixes.column((0.0, 1.31886e-5, 3.096e-5), "s")
    assert column == (("0.0000", "13.1886", "30.9600"), "µs")
    assert prefixes.prefixed([0.0, 2.5e-5], "m") == (1e6, "µm")
    assert prefixes.prefixed([0.0, 0.9], "1") == (1.0, "1")
    assert label("tangential_force", "mN") == "$F_x$\xa0(mN)"


def test_texts_are_read():
    assert texts.read_text("\N{MINUS SIGN}3e3 mm/s", "m/s") == -3.0
    assert texts.read_text("20 %", "1") == 0.2
    assert texts.read_text("7", "Pa") == 7.0
    assert texts.is_unit("m/s")
    assert texts.is_unit("%")
    assert not texts.is_unit("fast")
    assert units.number("radius", "5 mm") == 0.005
    assert units.number("angle", "90 deg") == pi / 2
    assert units.finite_or_text("1e99") == 1e99
    assert [units.finite_or_text(text) for text in ("1e999", "inf")] == ["1e999", "inf"]
    assert units.whole("points", "401", 2) == 401
    assert [units.or_none(value) for value in (2, inf, nan)] == [2.0, None, None]


def test_arrays_are_read():
    masked = arrays.pure_numbers("psi", np.ma.masked_greater([0.5, 9.0], 1.0))
    np.testing.assert_equal(masked, [0.5, nan])
    assert arrays.together({"psi": np.zeros((7, 1)), "chi": np.zeros(3)}) == (7, 3)
    np.testing.assert_equal(arrays.plain_numbers(["1.5", " -2e3"]), [1.5, -2000.0])
    assert arrays.plain_numbers(["1.5", "1_000"]) is None
    psi, chi = (xr.DataArray([1.0, 2.0], dims=name) for name in "ab")
    words = "psi, chi: their dimensions are a and b; give arrays along the same ones"
    with refused(words):
        arrays.along_the_same(psi=psi, chi=chi)


def test_keywords_are_refused_with_the_name_that_is_meant():
    @known_keywords
    def slide(*, friction):
        return friction

    with refused("mu: no keyword of slide; write friction"):
        slide(mu=0.2)
    with refused("slide: takes these by name; write friction=0.2"):
        slide(0.2)
    assert meant("mu", ["friction", "speed"]) == "friction"
    assert meant("omega", ["angle", "spin"]) == "spin"
    assert meant("x", ["spin"]) == ""


def test_faults_are_told_together():
    with refused("speed: must be positive"):
        refuse(False, "speed: must be positive")
    with (
        refused(r"2 faults: \(1\) angle: column missing; \(2\) spin: not a number in line 3"),
        Faults() as faults,
    ):
        faults.add("angle: column missing")
        faults.add("spin: not a number in line 3")


def test_statuses_have_words():
    class Landing(WordedStatus):
        SOFT = 0, "landed softly"
        HARD = 1, "landed hard"

    assert Landing(1).message == "landed hard"


def test_tables_in_reports():
    lines = text_table("max:7.3f steps:6d", [(0.25, 28), (0.5, None, "no limit")])
    assert lines == ["      max  steps", "    0.250     28", "    0.500      -  no limit"]
