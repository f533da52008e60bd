"""Numbers for reading: each is the value, in a unit that people write and Carom reads."""

import json
import math
import os
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

import carom
from carom.lab.fitting import Estimate
from carom.quantities.glossary import GLOSSARY, Quantity
from carom.quantities.prefixes import DIGITS, READ, column, prefixed, shared, span, text
from carom.quantities.texts import read_text

UNITS = sorted({entry.unit for entry in GLOSSARY.values()})
UNCHANGED = {"1", "rad/s", "kg/m^3", "m^2/N", "m/s^2", "1/m", "kg m^2"}
WRITTEN = [  # SI value, its unit, how people write it
    *((0.000187666, "m", "187.666 µm"), (0.005, "m", "5 mm")),
    (1.25, "m", "1.25 m"),
    (9.999999e-4, "m", "1 mm"),  # not 1000 µm
    *((999.9999, "N", "1 kN"), (999.999, "N", "999.999 N")),
    *((2.1e11, "Pa", "210 GPa"), (-2.35e8, "Pa", "-235 MPa")),
    *((3.096e-5, "s", "30.96 µs"), (600.0, "s", "600 s")),
    (7200.0, "s", "7200 s"),  # no kiloseconds
    *((0.583044, "m/s", "583.044 mm/s"), (4.1e-3, "kg", "4.1 g")),
    *((4.1e-6, "kg", "4.1 mg"), (4.1e-9, "kg", "4.1 µg")),
    (12.0, "kg", "12 kg"),
    *((300.0, "1/m", "300 1/m"), (8.3e-6, "kg m^2", "8.3e-06 kg m^2")),
    (12e3, "kg", "12000 kg"),  # no megagrams
    *((0.000463285, "J", "463.285 µJ"), (2.5e-4, "N s", "250 µN s")),
    *((0.02, "N m", "20 mN m"), (3e-7, "N m s", "300 nN m s")),
    *((8200.0, "J/m^2", "8.2 kJ/m^2"), (0.75e6, "Pa m^0.5", "750 kPa m^0.5")),
    *((1.3e6, "Pa m^0.5", "1.3 MPa m^0.5"), (1.3e9, "Pa m^0.5", "1300 MPa m^0.5")),
    *((0.002, "m^2", "20 cm^2"), (3e-6, "m^2", "3 mm^2")),
    *((3e-12, "m^2", "3 µm^2"), (5e-6, "m^3", "5 cm^3")),
    *((5e-7, "m^3", "500 mm^3"), (4e-17, "m^3", "40 µm^3")),
    *((4e-11, "m^3", "0.04 mm^3"), (1e-13, "m^2/N", "1e-13 m^2/N")),
    (9.80665, "m/s^2", "9.80665 m/s^2"),
    *((7850.0, "kg/m^3", "7850 kg/m^3"), (-208.4781, "rad/s", "-208.478 rad/s")),
    *((23456.7, "rad/s", "23456.7 rad/s"), (44e3, "Hz", "44 kHz")),
    *((1.441177, "1", "1.44118"), (math.pi / 9.0, "rad", "20 deg (0.349066 rad)")),
    *((-math.pi / 2.0, "rad", "-90 deg (-1.5708 rad)"), (0.0, "m", "0 m")),
    *((-0.0, "rad/s", "0 rad/s"), (0.0, "kg", "0 kg")),
    *((0.0, "rad", "0 deg (0 rad)"), (math.nan, "m", "-")),
    *((math.nan, "rad", "-"), (math.inf, "Pa", "inf Pa")),
    *((-math.inf, "1", "-inf"), (1e-19, "J", "1e-19 J")),
    *((3.1e-13, "s", "0.31 ps"), (1e30, "Pa", "1e+30 Pa")),
]


@pytest.mark.parametrize(("value", "unit", "words"), WRITTEN)
def test_numbers_as_people_write_them(value, unit, words):
    assert text(value, unit) == words
    assert text(np.float64(value), unit) == words


def test_all_units_of_the_glossary_are_among_these():
    assert {unit for _, unit, _ in WRITTEN} == set(UNITS)
    assert set(READ) | UNCHANGED | {"rad"} == set(UNITS)


def halves_of_the_last_digit(value, digits=DIGITS):
    """Return by how much a decimal number of so many digits may be off, and a bit for floats."""
    return 0.5 * 10.0 ** (math.floor(math.log10(abs(value))) - digits + 1) + 1e-12 * abs(value)


@pytest.mark.first_case
@pytest.mark.parametrize("unit", UNITS)
@given(exponent=st.floats(-25.0, 25.0), sign=st.sampled_from((-1.0, 1.0)), digits=st.integers(2, 8))
@settings(max_examples=40, derandomize=True, deadline=None)
def test_what_is_printed_is_read_as_the_value(unit, exponent, sign, digits):
    """By the strict reader of what users write, to the last digit printed."""
    value = sign * 10.0**exponent
    for part in re.split(r" \(|\)", text(value, unit, digits)):
        if part:  # an angle twice
            off = math.degrees(1.0) * halves_of_the_last_digit(value, digits)
            allowed = off if unit == "rad" else halves_of_the_last_digit(value, digits)
            assert read_text(part, unit) == pytest.approx(value, rel=0.0, abs=allowed)
            assert len(re.sub(r"e.*|^-?0\.0*|\D", "", part.split()[0]).rstrip("0")) <= digits


@pytest.mark.parametrize("unit", sorted(set(UNITS) - UNCHANGED - {"rad", "m^2", "m^3"}))
@given(st.floats(-12.0, 11.9))
@settings(max_examples=40, derandomize=True, deadline=None)
def test_numbers_are_1_to_1000_where_there_are_prefixes(unit, exponent):
    value, powers = 10.0**exponent, [power for power in READ[unit] if unit != "kg" or power]
    number = float(text(value, unit).split()[0])
    if min(powers) <= exponent < max(powers) + 2.9999999:
        assert 1.0 <= number < 1000.0
    assert prefixed([value, -0.5 * value], unit)[1] == text(value, unit).partition(" ")[2]


@pytest.mark.first_case
@pytest.mark.parametrize("unit", UNITS)
@given(st.lists(st.floats(-1e6, 1e6), min_size=1, max_size=5))
@settings(max_examples=50, derandomize=True, deadline=None)
def test_numbers_that_stand_together_have_one_unit(unit, values):
    """That of the largest; each has its digits, and in a column all have as many decimals."""
    largest = max(map(abs, values))
    numbers, name = shared(values, unit)
    for value, number in zip(values, numbers, strict=True):
        actual = read_text(number + ("" if name == "1" else f" {name}"), unit)
        assert actual == pytest.approx(value, rel=0.5e-5, abs=5e-324)
    cells, head = column(values, unit)
    assert head == name
    assert len({len(cell.partition(".")[2].split("e")[0]) for cell in cells}) == 1
    for value, cell in zip(values, cells, strict=True):
        actual = read_text(cell + ("" if head == "1" else f" {head}"), unit)
        assert actual == pytest.approx(value, rel=0.0, abs=1e-5 * largest + 5e-324)
    if unit not in ("1", "rad"):
        assert text(math.copysign(largest, -1.0), unit).endswith(f" {name}")


def test_spans_tell_their_unit_once():
    assert span(0.0, 845.996, "N") == "0 to 845.996 N"
    assert span(1e-3, 2.0, "m/s", 3) == "0.001 to 2 m/s"
    assert span(0.2, 0.2, "1") == "0.2"
    assert span(0.0, math.pi / 9.0, "rad") == "0 to 20 deg (0 to 0.349066 rad)"
    assert span(math.nan, 1.0, "m") == "-"
    assert GLOSSARY["young"].span(7e10, 2.1e11) == "70 to 210 GPa"
    assert Quantity("$x$", "m", "").text(2e-6) == "2 µm"


def test_few_digits_are_no_powers_of_ten():
    """750, rounded to two digits, is not 7.5e+02."""
    assert text(7.51e-7, "s", 2) == "750 ns"
    assert text(0.1512, "m/s", 2) == "150 mm/s"
    assert shared((9.9e4, 1.0), "rad/s", 2) == (("99000", "1"), "rad/s")
    for value in 10.0 ** np.arange(-12.0, 12.0, 0.1):
        assert "e" not in text(float(value), "Pa", 2)


def test_columns_hold_what_is_no_number():
    assert column([math.nan, 1e-3, math.inf], "m") == (("-", "1.00000", "inf"), "mm")
    assert column([0.0], "s") == (("0.00000",), "s")
    assert column([0.0, 1e-20], "s", 3) == (("0.00e+00", "1.00e-20"), "s")
    assert column([], "s") == ((), "s")


COMMAND = ["impact", "--radius", "5 mm", "--material", "steel", "--friction", "0.2"]
COMMAND += ["--speed", "0.6", "--angle", "30 deg"]


def rows_of(printed):
    """Return the table of an impact by meaning."""
    lines = printed.split("Phases")[0].splitlines()[1:]
    return dict(re.split(r"\s{2,}", line.strip(), maxsplit=1) for line in lines)


def test_an_impact_reads_the_same_in_command_and_notebook(run, pair):
    answer = rows_of(run(*COMMAND)[1])
    hit = carom.impact(pair, speed=0.6, angle="30 deg")
    assert rows_of(str(hit)) == answer
    in_notebook = dict(re.findall(r"<th[^>]*>(.*?)</th><td[^>]*>(.*?)</td>", hit._repr_html_()))
    both = {name for name in in_notebook if name in answer}
    assert len(both) >= 8
    assert {name: in_notebook[name] for name in both} == {name: answer[name] for name in both}


def test_a_command_prints_what_it_writes_as_json(run, pair):
    """In SI there, with all digits."""
    printed, record = run(*COMMAND)[1], json.loads(run(*COMMAND, "--json")[1])
    hit = carom.impact(pair, speed=0.6, angle="30 deg")
    names = {entry.meaning: name for name, entry in GLOSSARY.items()}
    for meaning, words in rows_of(printed).items():
        name = names[meaning]
        if name != "chi":
            value = record["result"][name]
            assert value == getattr(hit, name)
            read = read_text(words.split(" (")[0], GLOSSARY[name].unit)
            assert read == pytest.approx(value, rel=1e-5)
    table = printed.split("Phases\n")[1].split("\n  *")[0]
    (unit,) = set(re.findall(r"(?:from|to) \((\w+)\)", table))
    for line, phase in zip(table.splitlines()[1:], record["phases"], strict=True):
        for end, number in zip(("start", "end"), re.findall(r"\d+\.\d+", line), strict=False):
            read = read_text(f"{number} {unit}", "s")
            assert read == pytest.approx(phase[end], abs=1e-5 * hit.duration)


def test_the_largest_stresses_are_read_as_they_are(run, steel_ball):
    """Those of a table share a unit, and so do the three coordinates of a place."""
    hard = ["--second-material", "name=float glass, flaw_size=20 um", "--peaks"]
    printed = run(*COMMAND, *hard)[1].split("argest stresses in the ")[1:]
    glass = carom.HalfSpace(material=carom.material("float glass", flaw_size="20 um"))
    bodies = carom.Pair(steel_ball, glass, friction=0.2)
    peaks = carom.impact(bodies, speed=0.6, angle="30 deg").peaks()
    names, units = {entry.meaning: name for name, entry in GLOSSARY.items()}, set()
    for part, body in zip(printed, ("first", "second"), strict=True):
        lines = [line for line in part.splitlines() if " at x = " in line]
        assert len(lines) == 3 + (body == "second")
        for line in lines:
            meaning, value, place = re.fullmatch(r"  (.*?)  +(.*?) +at (.*)", line).groups()
            name = names[meaning]
            axes = [f"{name}_{axis}" for axis in ("x", "y", "z", "time")]
            at = zip(re.findall(r"= ([^,]*)", place), axes, strict=True)
            pairs = [(value, name), *at]
            for words, column_name in pairs:
                values = float(peaks[column_name].sel(body=body))
                read = read_text(words, GLOSSARY[column_name].unit)
                assert read == pytest.approx(values, rel=5e-4, abs=1e-10)
            if name != "stress_intensity":
                units.add(value.partition(" ")[2])
            assert len({words.partition(" ")[2] for words, _ in pairs[1:4]}) == 1
    assert units == {"GPa"}
    smallest = min(float(peaks[name].min()) for name in ("peak_shear", "peak_tension"))
    assert smallest < 1e9, "of which one alone would be in MPa"


def test_ranges_of_a_sweep_are_read_as_they_are(run):
    """From and to in one unit; angles in degrees and in radians."""
    words = ["sweep", Path(__file__).parents[2] / "examples/sweep.toml", "--no-progress"]
    printed, ranges = run(*words)[1], json.loads(run(*words, "--json")[1])["ranges"]
    rows = dict(re.split(r"\s{2,}", line.strip(), maxsplit=1) for line in printed.splitlines()[3:])
    assert len(rows) == len(ranges)
    for name, values in ranges.items():
        ends = [values["min"], values["max"]]
        low, high, *unit = rows[GLOSSARY[name].meaning].split()
        words = [[low, high, unit[0] if unit else ""]]
        if values["units"] == "rad":
            words.append(re.search(r"\((.*) to (.*) (rad)\)", " ".join(unit)).groups())
        for first, last, shown in words:
            read = [read_text(f"{number} {shown}", values["units"]) for number in (first, last)]
            assert read == pytest.approx(ends, rel=1e-5, abs=1e-12)


def test_fitted_parameters_have_prefixes_too():
    assert str(Estimate("loss_time", 2.31e-6, 2.2e-6, 2.4e-6)) == "2.31 µs (2.2 to 2.4)"
    assert str(Estimate("yield_velocity", 0.08, 0.0, 0.12)) == "80 mm/s, at most 120 mm/s"
    assert str(Estimate("loss_time", 1e-6)).startswith("1 µs, ")
    assert str(Estimate("spin_offset", 3.0, 1.0, 5.0)) == "3 rad/s (1 to 5)"


@pytest.mark.parametrize(("encoding", "micro"), [("ascii", "u"), ("latin-1", "µ"), ("utf-8", "µ")])
def test_a_terminal_without_the_micro_sign_gets_a_u(encoding, micro):
    """Which is read as well."""
    code = "from carom.quantities.prefixes import text; print(text(2.5e-6, 'm'))"
    environment = os.environ | {"PYTHONIOENCODING": encoding}
    command = [sys.executable, "-c", code]
    done = subprocess.run(command, env=environment, capture_output=True, check=True)
    assert done.stdout.decode(encoding).strip() == f"2.5 {micro}m"
    assert read_text("2.5 um", "m") == read_text("2.5 µm", "m") == 2.5e-6
