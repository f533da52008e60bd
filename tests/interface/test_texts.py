"""One grammar for a quantity: what is read, and as what; all else is refused, wherever it stands.

Texts that were once read as something else are marked by what they were read as.
"""

import json
import math
import re
import time
import tomllib
from contextlib import suppress
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

from carom.io.user_table import column_in_si
from carom.quantities import texts
from carom.quantities.arrays import numbers, plain_numbers
from carom.quantities.glossary import GLOSSARY
from carom.quantities.refusals import InputError
from carom.quantities.texts import LONGEST_TEXT, Unreadable, read_text
from carom.quantities.units import number

DEGREE = math.pi / 180
READ = [  # text, quantity, value in SI units
    ("5 mm", "radius", 0.005),
    ("5mm", "radius", 0.005),
    ("5e3mm", "radius", 5.0),
    ("5.E-3", "radius", 0.005),
    (".5 cm", "radius", 0.005),
    ("+5 mm", "radius", 0.005),
    ("  5\tmm ", "radius", 0.005),
    ("5\u00a0mm", "radius", 0.005),
    ("5\u202fmm", "radius", 0.005),
    ("5 µm", "radius", 5e-6),  # micro sign
    ("5 μm", "radius", 5e-6),  # Greek mu
    ("5 um", "radius", 5e-6),
    ("5 millimeters", "radius", 0.005),
    ("2 in", "radius", 0.0508),
    ("0.005", "radius", 0.005),
    ("−100 rad/s", "spin", -100.0),  # +100
    ("−700 rpm", "spin", -700 * 2 * math.pi / 60),
    ("1e−2 rad/s", "spin", 0.01),
    ("600 rpm", "spin", 20 * math.pi),
    ("10 rev/s", "spin", 20 * math.pi),
    ("360 deg/s", "spin", 2 * math.pi),
    ("2 m/s", "speed", 2.0),
    ("2 m s^-1", "speed", 2.0),
    ("2 m·s⁻¹", "speed", 2.0),
    ("2 m⋅s⁻¹", "speed", 2.0),
    ("2 m*s**-1", "speed", 2.0),
    ("2 m s^−1", "speed", 2.0),
    ("2 m / s", "speed", 2.0),
    ("2 m s-1", "speed", 2.0),
    ("2 m s−1", "speed", 2.0),
    ("7850 kg m-3", "density", 7850.0),
    ("7850 kilogram / meter ** 3", "density", 7850.0),
    ("7.2 km/h", "speed", 2.0),
    ("7.2 kph", "speed", 2.0),
    ("30 deg", "angle", 30 * DEGREE),
    ("30°", "angle", 30 * DEGREE),
    ("30 °", "angle", 30 * DEGREE),
    ("-30 degrees", "angle", -30 * DEGREE),
    ("60 arcmin", "angle", DEGREE),
    ("500 mrad", "angle", 0.5),
    ("210 GPa", "young", 210e9),
    ("210e3 MPa", "young", 210e9),
    ("210 kN/mm^2", "young", 210e9),
    ("210 kN/mm²", "young", 210e9),
    ("2100000 bar", "young", 210e9),
    ("7850 kg/m^3", "density", 7850.0),
    ("7.85 g/cm^3", "density", 7850.0),
    ("7.85 g/cm³", "density", 7850.0),
    ("7.85 kg/L", "density", 7850.0),
    ("5 us", "loss_time", 5e-6),
    ("10 kN", "normal_force", 1e4),
    ("10 kg m s^-2", "normal_force", 10.0),
    ("0.2", "friction", 0.2),
    ("20 percent", "friction", 0.2),  # 20
    ("20 %", "friction", 0.2),
    ("20%", "friction", 0.2),
    ("200 permille", "friction", 0.2),
    ("20 ppm", "friction", 20e-6),  # 20
    ("200 mm/m", "friction", 0.2),  # 200
    ("20 µm/m", "friction", 20e-6),
]
REFUSED = [  # text, quantity, part of the message
    ("2–3 m/s", "speed", "not a unit"),  # 6
    ("–2 m/s", "speed", "give a number"),  # en dash
    ("—2 m/s", "speed", "give a number"),  # em dash
    ("‐2 m/s", "speed", "give a number"),  # hyphen
    ("1 500 mm/s", "speed", "not a unit"),  # 0.5 m/s
    ("1'500 mm/s", "speed", "not a unit"),  # 0.5 m/s
    ("1\u2009500 mm/s", "speed", "not a unit"),
    ("1,500 mm/s", "speed", "decimal point"),
    ("1,5 m/s", "speed", "decimal point"),
    ("1_500 mm/s", "speed", "not a unit"),
    ("5 mm; 3", "radius", "not a unit"),  # 15 mm
    ("5 mm 3", "radius", "not a unit"),
    ("5.5.5 mm", "radius", "not a unit"),  # 2.75 mm
    ("1·5 m/s", "speed", "not a unit"),  # 5
    ("1٫5 m/s", "speed", "not a unit"),  # 5, Arabic decimal separator
    ("5° 10'", "angle", "not a unit"),  # 50 deg
    ("5°10′", "angle", "not a unit"),
    ("5 deg 10 arcmin", "angle", "not a unit"),  # 0.00025 rad
    ("~2 m/s", "speed", "give a number"),  # 2
    ("<2 m/s", "speed", "give a number"),  # 2
    ("≈2 m/s", "speed", "give a number"),
    ("2 m/s?", "speed", "not a unit"),  # 2
    ("2±0.1 m/s", "speed", "not a unit"),
    ("2(1) m/s", "speed", "not a unit"),
    ("2 m/s.", "speed", "not a unit"),
    ("5 'mm'", "radius", "not a unit"),  # 5 m
    ('5"', "radius", "not a unit"),
    ("5 mm!", "radius", "not a unit"),
    ("[5] mm", "radius", "give a number"),
    ("(5) mm", "radius", "give a number"),
    ("1:2 m", "radius", "not a unit"),  # 2
    ("2**3 mm", "radius", "not a unit"),
    ("2*3 mm", "radius", "not a unit"),
    ("1/2", "speed", "not a unit"),  # 0.5
    ("=0.5", "speed", "give a number"),  # 0.5
    ("5-3 mm", "radius", "not a unit"),
    ("5+3 mm", "radius", "not a unit"),
    ("9**9**9 m", "radius", "not a unit"),  # without end
    ("pi/6", "angle", "give a number"),  # 0.1667
    ("0.5 pi", "angle", "'pi' is not known"),
    ("pi", "angle", "give a number"),
    ("1_000", "speed", "not a unit"),
    ("١٢", "speed", "give a number"),  # Arabic digits
    ("５ mm", "radius", "give a number"),  # full width
    ("5² mm", "radius", "not a unit"),
    ("½ mm", "radius", "give a number"),
    ("inf", "radius", "give a number"),
    ("-inf m", "radius", "give a number"),
    ("nan", "radius", "give a number"),
    ("infinity", "young", "give a number"),
    ("1e400 m", "radius", "floating point"),
    ("1e-400 m", "radius", "floating point"),
    ("1e305 GPa", "young", "floating point"),  # a rigid body
    ("5 Qm^9 Qm^9 m^-9 m^-8", "radius", "floating point"),
    ("5 qm^9 qm^9 m^-9 m^-8", "radius", "floating point"),
    ("5 mm-3", "radius", "not a value in m"),
    ("20 %-1", "friction", "not a unit"),
    ("0.2 1", "friction", "not a unit"),
    ("0.2 -", "friction", "not a unit"),
    ("0x10", "radius", "not a unit"),
    ("1e", "radius", "'e' is not known"),
    ("1e5.5", "radius", "not a unit"),
    ("1 e3 m", "radius", "not a unit"),
    ("--5 m", "radius", "give a number"),
    ("+-5 m", "radius", "give a number"),
    ("- 5 m", "radius", "give a number"),
    ("", "radius", "empty"),
    (" ", "radius", "empty"),
    ("mm", "radius", "give a number"),
    ("mm 5", "radius", "give a number"),
    ("five mm", "radius", "give a number"),
    ("5\nmm", "radius", "not a unit"),
    ("5 mm\n6 mm", "radius", "not a unit"),
    ("5\u200bmm", "radius", "not a unit"),
    ("5 mm\u0000", "radius", "not a unit"),
    ("5 furlongs", "radius", "not known"),
    ("5 c", "speed", "not known"),  # a number of speeds of light
    ("5 au", "radius", "not known"),
    ("5 dB", "friction", "not known"),
    ("5 mm^1.5", "radius", "not a unit"),
    ("5 mm^12", "radius", "not a unit"),
    ("5 m2", "radius", "not a value in m"),
    ("3 kg/m s^2", "young", "one unit may follow '/', as in"),
    ("3 kg/m/s^2", "young", "one unit may follow '/', as in"),
    ("3 m m m m m", "radius", "not a unit"),
    ("30 % %", "friction", "'%' stands alone"),  # 0.003
    ("20 % mm/m", "friction", "'%' stands alone"),
    ("20 ppm2", "friction", "'ppm' stands alone"),
    ("20 percent^2", "friction", "'percent' stands alone"),
    ("20 % mm", "radius", "'%' stands alone"),
    ("5 mm mm m^-1", "radius", "'mm' is given twice"),
    ("5 mm millimeter m^-1", "radius", "'mm' is given twice"),
    ("30 deg deg rad^-1", "angle", "'deg' is given twice"),
    ("30 deg deg", "angle", "not a value in rad"),
    ("5 mm mm", "radius", "not a value in m"),
    ("5 m^0", "friction", "not a unit"),  # 5
    ("5 mm m-0", "radius", "not a unit"),
    ("2 m.s", "speed", "not a value in m/s"),
    ("2 m..s-1", "speed", "not a unit"),
    ("2 m. s-1", "speed", "not a unit"),
    ("5×103 mm", "radius", "write powers of ten as in 5e3 or 5×10^3"),
    ("5e3×10^3 mm", "radius", "write powers of ten"),
    ("5×10^3.5 mm", "radius", "not a unit"),
    ("5×10^400 mm", "radius", "floating point"),
    ("5×10^-400 mm", "radius", "floating point"),
    ("×10^3 mm", "radius", "give a number"),
    ("5 MBAR", "young", "'MBAR' is not known"),  # mbar or Mbar
    ("5 kg", "radius", "not a value in m"),
    ("30 deg", "friction", "a pure number is needed"),
    ("0.3 rad", "friction", "a pure number is needed"),
    ("20 %", "angle", "not a value in rad"),
    ("200 mm/m", "angle", "not a value in rad"),
    ("1 kHz", "spin", "a spin is not in kHz; write rad/s or rpm"),  # 1000 rad/s
    ("100 Bq", "spin", "a spin is not in Bq; write rad/s or rpm"),  # 100 rad/s
    ("100 s^-1", "spin", "write rad/s or rpm"),
    ("20 degC", "angle", "not known"),
    ("5 mm" + " " * LONGEST_TEXT + "?", "radius", f"{LONGEST_TEXT} characters"),
]


def test_the_table_is_as_long_as_it_should_be():
    texts = [row[:2] for row in READ + REFUSED]
    assert len(set(texts)) == len(texts) >= 120


@pytest.mark.parametrize(("text", "name", "value"), READ)
def test_what_is_a_quantity_is_read(text, name, value):
    """In Python, in lists of Python, in a cell, in a case file: the same float everywhere."""
    si = GLOSSARY[name].unit
    found = number(name, text)
    assert found == pytest.approx(value, rel=1e-15)
    assert numbers(name, [text, text], "")[1] == found
    assert column_in_si(name, si, "", [text])[0][0] == found
    assert number(name, tomllib.loads(f"x = {json.dumps(text)}")["x"]) == found


@pytest.mark.parametrize(("text", "name", "words"), REFUSED)
def test_all_else_is_refused_in_one_line(text, name, words):
    for read in (number, lambda name, text: numbers(name, [text], "")):
        with pytest.raises(InputError) as refused:
            read(name, text)
        message = str(refused.value)
        assert message.startswith(f"{name}: ")
        assert words in message
        assert "\n" not in message
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


@settings(max_examples=300, deadline=None, derandomize=True)
@given(PLAIN, st.sampled_from(sorted(UNITS)), BLANK, BLANK)
def test_a_number_and_a_unit_are_their_product(text, unit, between, around):
    text = text.strip()
    read = read_text(f"{around}{text}{between}{unit}{around}", "m")
    assert read == pytest.approx(float(text) * UNITS[unit], rel=4e-16)


@settings(max_examples=300, deadline=None, derandomize=True)
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


@settings(max_examples=300, deadline=None, derandomize=True)
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
