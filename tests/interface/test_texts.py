"""One grammar for a quantity: what is read, and as what; all else is refused, wherever it stands.

Texts that were once read as something else are marked by what they were read as.
"""

import json
import math
import re
import time
import tomllib
from contextlib import suppress
from functools import partial
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st
from tests.checks import refused

from carom.io.user_table import column_in_si
from carom.quantities import texts
from carom.quantities.arrays import numbers, plain_numbers
from carom.quantities.glossary import GLOSSARY
from carom.quantities.refusals import InputError
from carom.quantities.texts import LONGEST_TEXT, Unreadable, read_text
from carom.quantities.units import number

DEGREE = math.pi / 180
READ = {  # quantity and value in SI units: texts
    ("radius", 0.005): (
        *("5 mm", "5mm", "5.E-3", ".5 cm", "+5 mm", "  5\tmm ", "5\u00a0mm", "5\u202fmm"),
        *("5 millimeters", "0.005"),
    ),
    ("radius", 5.0): ("5e3mm",),
    ("radius", 5e-6): ("5 µm", "5 μm", "5 um"),  # micro sign; Greek mu
    ("radius", 0.0508): ("2 in",),
    ("spin", -100.0): ("−100 rad/s",),  # once +100
    ("spin", -700 * 2 * math.pi / 60): ("−700 rpm",),
    ("spin", 0.01): ("1e−2 rad/s",),
    ("spin", 20 * math.pi): ("600 rpm", "10 rev/s"),
    ("spin", 2 * math.pi): ("360 deg/s",),
    ("speed", 2.0): (
        *("2 m/s", "2 m s^-1", "2 m·s⁻¹", "2 m⋅s⁻¹", "2 m*s**-1", "2 m s^−1", "2 m / s"),
        *("2 m s-1", "2 m s−1", "7.2 km/h", "7.2 kph"),
    ),
    ("density", 7850.0): (
        *("7850 kg m-3", "7850 kilogram / meter ** 3", "7850 kg/m^3", "7.85 g/cm^3"),
        *("7.85 g/cm³", "7.85 kg/L"),
    ),
    ("angle", 30 * DEGREE): ("30 deg", "30°", "30 °"),
    ("angle", -30 * DEGREE): ("-30 degrees",),
    ("angle", DEGREE): ("60 arcmin",),
    ("angle", 0.5): ("500 mrad",),
    ("young", 210e9): ("210 GPa", "210e3 MPa", "210 kN/mm^2", "210 kN/mm²", "2100000 bar"),
    ("loss_time", 5e-6): ("5 us",),
    ("normal_force", 1e4): ("10 kN",),
    ("normal_force", 10.0): ("10 kg m s^-2",),
    # "20 percent" was once 20; "200 mm/m" was once 200
    ("friction", 0.2): ("0.2", "20 percent", "20 %", "20%", "200 permille", "200 mm/m"),
    ("friction", 20e-6): ("20 ppm", "20 µm/m"),  # "20 ppm" was once 20
}
READ = [(text, *what) for what, texts in READ.items() for text in texts]
REFUSED = [  # text, quantity, part of the message
    ("2–3 m/s", "speed", "not a unit"),  # 6
    ("–2 m/s", "speed", "give a number"),  # en dash
    ("—2 m/s", "speed", "give a number"),  # em dash
    ("‐2 m/s", "speed", "give a number"),  # hyphen
    ("1 500 mm/s", "speed", "not a unit"),  # 0.5 m/s
    *((f"30 {unit}", "angle", "write deg or gon") for unit in ("grad", "Grad")),
    ("1'500 mm/s", "speed", "not a unit"),  # 0.5 m/s
    ("5 mm; 3", "radius", "not a unit"),  # 15 mm
    ("5.5.5 mm", "radius", "not a unit"),  # 2.75 mm
    ("1·5 m/s", "speed", "not a unit"),  # 5
    ("1٫5 m/s", "speed", "not a unit"),  # 5, Arabic decimal separator
    ("5° 10'", "angle", "not a unit"),  # 50 deg
    ("5 deg 10 arcmin", "angle", "not a unit"),  # 0.00025 rad
    ("~2 m/s", "speed", "give a number"),  # 2
    ("<2 m/s", "speed", "give a number"),  # 2
    ("2 m/s?", "speed", "not a unit"),  # 2
    ("5 'mm'", "radius", "not a unit"),  # 5 m
    ("1:2 m", "radius", "not a unit"),  # 2
    ("1/2", "speed", "not a unit"),  # 0.5
    ("=0.5", "speed", "give a number"),  # 0.5
    ("9**9**9 m", "radius", "not a unit"),  # without end
    ("pi/6", "angle", "give a number"),  # 0.1667
    ("١٢", "speed", "give a number"),  # Arabic digits
    ("５ mm", "radius", "give a number"),  # full width
    ("1e305 GPa", "young", "floating point"),  # a rigid body
    ("5 c", "speed", "not known"),  # a number of speeds of light
    ("30 % %", "friction", "'%' stands alone"),  # 0.003
    ("5 m^0", "friction", "not a unit"),  # 5
    ("5 MBAR", "young", "'MBAR' is not known"),  # mbar or Mbar
    ("1 kHz", "spin", "a spin is not in kHz; write rad/s or rpm"),  # 1000 rad/s
    ("100 Bq", "spin", "a spin is not in Bq; write rad/s or rpm"),  # 100 rad/s
    ("5 mm" + " " * LONGEST_TEXT + "?", "radius", f"{LONGEST_TEXT} characters"),
    ("5°10′", "angle", "not a unit"),
    ("≈2 m/s", "speed", "give a number"),
    ("0.5 pi", "angle", "'pi' is not known"),
    ("pi", "angle", "give a number"),
    ("infinity", "young", "give a number"),
    ("1e", "radius", "'e' is not known"),
    ("5 dB", "friction", "not known"),
    ("20 % mm/m", "friction", "'%' stands alone"),
    ("20 ppm2", "friction", "'ppm' stands alone"),
    ("20 percent^2", "friction", "'percent' stands alone"),
    ("20 % mm", "radius", "'%' stands alone"),
    ("30 deg deg rad^-1", "angle", "'deg' is given twice"),
    ("2 m.s", "speed", "not a value in m/s"),
    ("5×103 mm", "radius", "write powers of ten as in 5e3 or 5×10^3"),
    ("5e3×10^3 mm", "radius", "write powers of ten"),
    ("100 s^-1", "spin", "write rad/s or rpm"),
    ("20 degC", "angle", "not known"),
]
ALIKE = {  # quantity and part of the message: texts
    ("speed", "not a unit"): (
        *("1\u2009500 mm/s", "1_500 mm/s", "2±0.1 m/s", "2(1) m/s", "2 m/s.", "1_000"),
        *("2 m..s-1", "2 m. s-1"),
    ),
    ("radius", "not a unit"): (
        *("5 mm 3", '5"', "5 mm!", "2**3 mm", "2*3 mm", "5-3 mm", "5+3 mm", "5² mm", "0x10"),
        *("1e5.5", "1 e3 m", "5\nmm", "5 mm\n6 mm", "5\u200bmm", "5 mm\u0000", "5 mm^1.5"),
        *("5 mm^12", "3 m m m m m", "5 mm m-0", "5×10^3.5 mm"),
    ),
    ("radius", "give a number"): (
        *("[5] mm", "(5) mm", "½ mm", "inf", "-inf m", "nan", "--5 m", "+-5 m", "- 5 m", "mm"),
        *("mm 5", "five mm", "×10^3 mm"),
    ),
    ("radius", "floating point"): (
        *("1e400 m", "1e-400 m", "5 Qm^9 Qm^9 m^-9 m^-8", "5 qm^9 qm^9 m^-9 m^-8"),
        *("5×10^400 mm", "5×10^-400 mm"),
    ),
    ("radius", "not a value in m"): ("5 mm-3", "5 m2", "5 mm mm", "5 kg"),
    ("friction", "not a unit"): ("20 %-1", "0.2 1", "0.2 -"),
    ("angle", "not a value in rad"): ("30 deg deg", "20 %", "200 mm/m"),
    ("speed", "decimal point"): ("1,500 mm/s", "1,5 m/s"),
    ("radius", "empty"): ("", " "),
    ("radius", "not known"): ("5 furlongs", "5 au"),
    ("young", "one unit may follow '/', as in"): ("3 kg/m s^2", "3 kg/m/s^2"),
    ("radius", "'mm' is given twice"): ("5 mm mm m^-1", "5 mm millimeter m^-1"),
    ("friction", "a pure number is needed"): ("30 deg", "0.3 rad"),
}
REFUSED += [(text, *what) for what, texts in ALIKE.items() for text in texts]


def test_the_table_is_as_long_as_it_should_be():
    texts = [row[:2] for row in READ + REFUSED]
    assert len(set(texts)) == len(texts) >= 120


@pytest.mark.parametrize(("text", "name", "value"), READ)
def test_what_is_a_quantity_is_read(text, name, value):
    """In Python, in lists of Python, in a cell, in a case file: the same float everywhere."""
    si = GLOSSARY[name].unit
    actual = number(name, text)
    assert actual == pytest.approx(value, rel=1e-15)
    assert numbers(name, [text, text], "")[1] == actual
    assert column_in_si(name, si, "", [text])[0][0] == actual
    assert number(name, tomllib.loads(f"x = {json.dumps(text)}")["x"]) == actual


@pytest.mark.first_case
@pytest.mark.parametrize(("text", "name", "words"), REFUSED)
def test_all_else_is_refused_in_one_line(text, name, words):
    for what, read in ((text, number), ([text], partial(numbers, allowed=""))):
        message = refused(f"^{name}: ", read, name, what)
        assert words in message
        assert len(message) < 400
    missing, _ = column_in_si(name, GLOSSARY[name].unit, "", [text])
    assert np.isnan(missing[0])


def spellings():
    """The rows of the manual's table: what is written, whether it is read, the right spelling."""
    text = (Path(__file__).parents[2] / "docs/input.md").read_text(encoding="utf-8")
    for row in re.findall(r"^\| (`.*`) \| (read as|refused) \| `(.*)` \|$", text, re.MULTILINE):
        for written in row[0][1:-1].split("`, `"):
            yield written, row[1] == "read as", row[2]


def kinds_of(text):
    """The units of the glossary in which a text is a quantity."""
    for unit in sorted({entry.unit for entry in GLOSSARY.values()}):
        with suppress(Unreadable):
            read_text(text, unit)
            yield unit


@pytest.mark.first_case
@pytest.mark.parametrize(("written", "is_read", "right"), [*spellings()])
def test_spellings_are_as_the_manual_says(written, is_read, right):
    """What is read is what the right spelling is, in every unit; what is refused names that one."""
    kinds = list(kinds_of(right))
    assert kinds
    if is_read:
        assert list(kinds_of(written)) == kinds
    for unit in kinds:
        if is_read:
            expected = pytest.approx(read_text(right, unit), rel=4e-16)
            assert read_text(written, unit) == expected
            assert column_in_si("x", unit, "", [written])[0][0] == expected
            continue
        with pytest.raises(Unreadable, match="write") as refused:
            read_text(written, unit)
        number_of_it, _, unit_of_it = right.partition(" ")
        assert repr(unit_of_it) in str(refused.value) or number_of_it in str(refused.value)


def test_the_table_of_spellings_is_as_long_as_it_should_be():
    assert len(list(spellings())) >= 60


UNITS = {"m": 1.0, "mm": 1e-3, "µm": 1e-6, "km": 1e3, "": 1.0}
LETTERS = {"m": 1.0, "µ": 1e-6, "μ": 1e-6, "Å": 1e-10, "\u212b": 1e-10}  # all lengths of one
PLAIN = st.from_regex(
    r"[+-]?([0-9]{1,8}(\.[0-9]{0,8})?|\.[0-9]{1,8})([eE][+-]?[0-9]{1,2})?", fullmatch=True
)
BLANK = st.sampled_from(["", " ", "\t", "\u00a0", "  "])


@pytest.mark.slow
@settings(max_examples=150, deadline=None, derandomize=True)
@given(PLAIN, st.sampled_from(sorted(UNITS)), BLANK, BLANK)
def test_a_number_and_a_unit_are_their_product(text, unit, between, around):
    text = text.strip()
    read = read_text(f"{around}{text}{between}{unit}{around}", "m")
    assert read == pytest.approx(float(text) * UNITS[unit], rel=4e-16)


@settings(max_examples=150, deadline=None, derandomize=True)
@given(PLAIN, st.characters(), st.integers(0, 20))
def test_a_stray_character_never_changes_a_number_without_a_word(text, stray, place):
    """With one character more a text is refused, or it is the number that Python reads, too."""
    text = text.strip()
    changed = f"{text[:place]}{stray}{text[place:]}"
    try:
        read = read_text(changed, "m")
    except Unreadable:
        return
    plain = changed.replace("\u2212", "-").strip(" \t\u00a0\u2009\u202f")
    size = LETTERS.get(plain[-1:])
    assert read == (float(plain) if size is None else pytest.approx(size * float(plain[:-1])))


@settings(max_examples=150, deadline=None, derandomize=True)
@given(st.lists(st.text(st.sampled_from("0123456789.+-eE _,x\u2212\u0663"), max_size=8)))
def test_a_column_is_read_quickly_only_as_it_is_cell_by_cell(texts):
    fast = plain_numbers(texts)
    if fast is not None:
        assert fast.tolist() == [read_text(text, "1") for text in texts]


@pytest.mark.parametrize(
    "text", ["9**9**9 m", "5 " + "Gm*" * 60, "9" * 200 + "m", "5 " + "m" * 190]
)
def test_the_time_of_a_refusal_is_bounded(text):
    """A thousand times the millisecond that the reader takes: what computes without end is worse.

    Benchmarks measure; this only tells an end from none.
    """
    begun = time.process_time()
    for _ in range(10):
        with pytest.raises(InputError):
            number("radius", text)
    assert time.process_time() - begun < 10.0


@pytest.mark.parametrize("unit", texts.COMMON)
def test_common_units_are_those_of_pint(unit, monkeypatch):
    """The table that spares loading pint, against pint, to the last bit."""
    for expression, ratio in texts.COMMON[unit].items():
        with monkeypatch.context() as without:
            without.setattr(texts, "COMMON", {})
            assert texts._factor.__wrapped__(expression, unit) == texts.as_factor(ratio), expression


@pytest.mark.parametrize("unit", ["mm^3/(N m)", "mm³/Nm", "mm^3/N/m", "mm^3 N^-1 m^-1", "1/GPa"])
def test_coefficients_of_wear_are_read_as_they_are_published(unit):
    read = texts.read_text(f"1e-4 {unit}", texts.WEAR_COEFFICIENT)
    assert read == pytest.approx(1e-13, rel=1e-15)


def test_toughness_is_in_units_of_pint():
    """The only unit with half a power stands in the table alone; pint knows what it is."""
    registry = pytest.importorskip("pint").UnitRegistry()
    for prefix, size in {"": 1.0, "k": 1e3, "M": 1e6}.items():
        one = registry.Quantity(size, "Pa * m**0.5").to(f"{prefix}Pa * m**0.5")
        assert one.magnitude == pytest.approx(1.0)
        for root in (" m^0.5", " sqrt(m)", "√m"):
            assert texts.read_text(f"3 {prefix}Pa{root}", texts.TOUGHNESS) == 3.0 * size
    for other in ("3 MPa", "3 MPa m", "3 MPa m^2", "3 psi m^0.5", "3 N m^-1.5"):
        with pytest.raises(texts.Unreadable, match="not a unit of fracture toughness"):
            texts.read_text(other, texts.TOUGHNESS)
