"""The reader of quantities, against pint where it reads a text."""

import re

import pint
import pytest

from carom.quantities.glossary import GLOSSARY
from carom.quantities.texts import Unreadable, read_text

TEXTS = [
    *("5 mm", "210 GPa", "2 m/s", "-100 rad/s", "600 rpm", "30 deg", "0.2", "20 %", "30°"),
    *("1.5e-3 kg/m^3", "2 m·s⁻¹", "7.85 g/cm³", "7.2 km/h", "5e3mm", "10 kN", "5 µm", "1e-6 s"),
    *("−3 N/mm²", "7850 kg/m3", "2.1×10^5 N/mm2", "20 rad.s-1", "5×10⁻³ m", "600 RPM", "30º"),
    "2 Pascal",
]
RAISED = str.maketrans("⁺⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "+-0123456789")
UNITS = sorted({entry.unit for entry in GLOSSARY.values()})
BLANKS = "\u00a0\u2009\u202f"


@pytest.fixture(scope="module")
def registry():
    return pint.UnitRegistry(cache_folder=":auto:")


def twin(text, unit, registry):
    """The longest number that Python reads, in the unit that pint reads in the rest."""
    for blank in BLANKS:
        text = text.replace(blank, " ")
    text = text.strip(" \t").replace("\u2212", "-").replace("·", "*").replace("⋅", "*")
    if power := re.search(r"[ \t]*×[ \t]*10(?:\^([+-]?[0-9]+)|([⁺⁻]?[⁰¹²³⁴⁵⁶⁷⁸⁹]+))", text):
        digits = (power[1] or power[2]).translate(RAISED)
        text = f"{text[: power.start()]}e{digits}{text[power.end() :]}"
    for end in range(len(text), 0, -1):
        try:
            value = float(text[:end])
            break
        except ValueError:
            continue
    assert all(letter in "0123456789.+-eE" for letter in text[:end].strip())
    rest = re.sub("[°º˚]", "degree", text[end:].strip(" \t")).replace("rev", "turn")
    rest = rest.replace("RPM", "rpm").replace("Pascal", "pascal")
    rest = re.sub(r"\.(?=[^\W\d_])", "*", rest)  # a full stop between names
    rest = re.sub(r"(?<=[^\W\d_])([23])", r"**\1", rest)  # "m3"
    if not rest:
        return value
    rest = re.sub(r"(?<=[^\W\d_])([+-][0-9])", r"**\1", rest)  # "s-1" of CF
    return registry.Quantity(value, rest).to("" if unit == "1" else unit).magnitude


def test_what_is_read_is_what_python_and_pint_read(calls, rng, mutated, registry):
    read = 0
    for _ in range(10 * calls):
        text, unit = mutated(rng.choice(TEXTS)), rng.choice(UNITS)
        try:
            value = read_text(text, unit)
        except Unreadable:
            continue
        read += 1
        assert value == pytest.approx(twin(text, unit, registry), rel=1e-12, abs=0.0), text
    assert read > calls / 50
