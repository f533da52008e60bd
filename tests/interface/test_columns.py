"""Columns of users: separators, line ends, units, gaps; and one clear line for what is wrong."""

import math
from decimal import Decimal
from fractions import Fraction

import numpy as np
import pandas as pd
import pint
import pytest
import xarray as xr
from tests.checks import refused

import carom
from carom.io.tables import read_table
from carom.io.user_table import column_in_si, in_units, others, with_errors
from carom.quantities.refusals import InputError
from carom.quantities.units import number

QUANTITY = pint.Quantity
KNOWN = with_errors(("angle", "speed", "spin_out", "tangential_restitution", "rebound_angle"))
GAPS = ("spin_out", "tangential_restitution", "rebound_angle")
TEXT = "angle [deg],spin_out [rpm]\n30,-60\n45,-120\n"
RADIANS = [math.pi / 6, math.pi / 4]
SPINS = [-2 * math.pi, -4 * math.pi]


def read(source):
    return in_units(read_table(source), KNOWN, gaps=GAPS)


@pytest.mark.parametrize(
    "content",
    [
        *(TEXT, TEXT.replace(",", ";"), TEXT.replace(",", "\t"), TEXT.replace("\n", "\r\n")),
        TEXT.encode("utf-8-sig"),
        TEXT.replace("\n", "\r\n").replace(",", ";").encode("utf-8-sig"),
        TEXT.replace(",", " , ").replace("[", "(").replace("]", ")"),
        *(TEXT.replace("[", "[ ").replace("]", " ]"), "sep=,\n" + TEXT),
        *(TEXT.replace("[", "/ [").replace("]", "]"), TEXT.replace("[", "/ (").replace("]", ")")),
        *("sep=;\r\n" + TEXT.replace(",", ";"), TEXT.rstrip("\n")),
        '"angle [deg]","spin_out [rpm]"\n"30","-60"\n\n# remark, of no account; none\n45,-120\n',
        "angle,spin_out\n30 deg,-60 rpm\n45 deg,-120 rpm\n",
        TEXT.replace(" [deg]", " in \N{DEGREE SIGN}").replace(" [rpm]", " in rpm"),
    ],
)
def test_one_table_written_in_many_ways(stored, content):
    """Comma, semicolon, tab; line ends of Windows; a byte order mark; units in head or cell."""
    dataset = read(stored(content))
    np.testing.assert_allclose(dataset["angle"], RADIANS, rtol=1e-14)
    np.testing.assert_allclose(dataset["spin_out"], SPINS, rtol=1e-14)


def test_a_column_without_a_unit_is_si():
    dataset = read({"angle": RADIANS, "spin_out": SPINS, "speed [cm/s]": [390, 391]})
    np.testing.assert_array_equal(dataset["angle"], RADIANS)
    np.testing.assert_array_equal(dataset["spin_out"], SPINS)
    np.testing.assert_allclose(dataset["speed"], [3.9, 3.91], rtol=1e-14)


def test_a_percentage_is_a_ratio():
    dataset = read({"angle": [0.1, 0.2], "tangential_restitution [%]": [70, "700 permille"]})
    np.testing.assert_allclose(dataset["tangential_restitution"], [0.7, 0.7], rtol=1e-15)


def test_errors_have_the_unit_of_their_head():
    dataset = read({"angle [deg]": [10.0], "angle_error [deg]": [1.0], "spin_out": [-1.0]})
    np.testing.assert_allclose(dataset["angle_error"], math.pi / 180, rtol=1e-14)


def test_gaps_are_told_by_a_dash(stored):
    text = "angle [deg],spin_out,tangential_restitution\n10,-,0.7\n20,-500,-\n"
    dataset = read(stored(text))
    np.testing.assert_array_equal(dataset["spin_out"], [np.nan, -500.0])
    np.testing.assert_array_equal(dataset["tangential_restitution"], [0.7, np.nan])
    refused("angle: no value in cell A3", read, stored(text.replace("20", "-")))


def test_comments_are_read_by_key(stored):
    text = '# Title: drop test: one\n# a remark\n# case: {"friction": 0.3}\n# title: no\n' + TEXT
    table = read_table(stored(text))
    assert table.comments["title"] == "drop test: one"
    assert table.case == {"friction": 0.3}
    assert read_table(stored(TEXT)).case is None
    assert table.rows.tolist() == [6, 7]


def test_a_labelled_dataset_is_a_table():
    """Units from the attributes; what is missing there was not measured; the bodies come along."""
    data = xr.Dataset(
        {
            "angle": ("point", [10.0, 20.0], {"units": "deg"}),
            "spin_out": ("point", [np.nan, -5.0], {"units": "rad/s"}),
            "friction": 0.3,
        },
        attrs={"case": '{"friction": 0.3}'},
    )
    dataset = read(data)
    np.testing.assert_allclose(dataset["angle"], np.radians([10.0, 20.0]), rtol=1e-14)
    np.testing.assert_array_equal(dataset["spin_out"], [np.nan, -5.0])
    assert read_table(data).case == {"friction": 0.3}
    gap = data.assign(angle=("point", [10.0, np.nan], {"units": "deg"}))
    refused("angle: no value in row 2", read, gap)


@pytest.mark.parametrize(
    ("variable", "words"),
    [
        ((("point", "ball"), np.ones((2, 2))), "spin_out: it runs along point and b"),
        (("ball", [1.0, 2.0]), "spin_out: it runs along ball, but the rows along point"),
    ],
)
def test_variables_of_a_dataset_along_other_dimensions_are_no_columns(variable, words):
    """Refused where they would be used; of other names they are told among those not used."""
    data = xr.Dataset({"angle": ("point", [0.1, 0.2])})
    refused(words, read, data.assign(spin_out=variable))
    renamed = data.assign(of_a_spin_out=variable)
    assert read(renamed)["angle"].tolist() == [0.1, 0.2]
    assert "of_a_spin_out" in others(read_table(renamed), KNOWN)


def test_one_value_of_a_dataset_is_that_of_every_row():
    """What .sel and .isel leave behind."""
    data = xr.Dataset({"angle": ("point", [0.1, 0.2])}, coords={"speed": 3.0, "lab": "north"})
    assert read(data)["speed"].tolist() == [3.0, 3.0]
    assert others(read_table(data), KNOWN) == ("lab",)


def test_a_data_frame_and_the_dataset_of_it_are_one_table():
    frame = pd.DataFrame({"angle [deg]": [30.0, 45.0], "spin_out [rpm]": [-60.0, np.nan]})
    dataset = read(frame.to_xarray())
    np.testing.assert_allclose(dataset["angle"], RADIANS, rtol=1e-14)
    np.testing.assert_allclose(dataset["spin_out"], [SPINS[0], np.nan], rtol=1e-14)


@pytest.mark.parametrize(
    "cell",
    [5, 5.0, "5", Decimal(5), Fraction(5), np.int8(5), np.float32(5), np.array(5), xr.DataArray(5)],
    ids=repr,
)
def test_a_bare_cell_has_the_unit_of_its_column(cell):
    assert column_in_si("radius", "m", "mm", [cell])[0] == 0.005
    assert column_in_si("radius", "m", "", [cell])[0] == 5.0


@pytest.mark.parametrize(
    "cell", ["5 cm", QUANTITY(5, "cm"), xr.DataArray(5, attrs={"units": "cm"})], ids=repr
)
def test_a_cell_may_have_its_own_unit(cell):
    assert column_in_si("radius", "m", "mm", [cell])[0] == 0.05


def test_a_number_that_overflows_is_none():
    """Of a list and of an array alike, with what is wrong; the others are read."""
    for cells in ([1e305, 210], np.array([1e305, 210.0])):
        values, reason = column_in_si("young", "Pa", "GPa", cells)
        assert np.array_equal(values, [np.nan, 210e9], equal_nan=True)
        assert "floating point cannot hold it" in reason


RPM = np.array([-60.0, -120.0])


@pytest.mark.parametrize(
    "column",
    [
        QUANTITY(RPM, "rpm"),
        [QUANTITY(-60.0, "rpm"), QUANTITY(-4 * math.pi, "rad/s")],
        xr.DataArray(RPM, attrs={"units": "rpm"}),
        xr.DataArray(RPM * math.pi / 30, attrs={"units": "rad s-1"}),
        xr.DataArray(QUANTITY(RPM, "rpm")),
        xr.DataArray(np.array([Decimal(-60), "-2 rev/s"], dtype=object), attrs={"units": "rpm"}),
        QUANTITY(np.ma.array(RPM), "rpm"),
    ],
    ids=lambda column: type(column).__name__,
)
def test_columns_tell_their_unit(column):
    angle = {"angle": RADIANS}
    np.testing.assert_allclose(read({"spin_out": column, **angle})["spin_out"], SPINS, rtol=1e-14)
    if not isinstance(column, list):
        held = column if isinstance(column, xr.DataArray) else ("row", column)
        spin_out = read(xr.Dataset({"spin_out": held}))["spin_out"]
        np.testing.assert_allclose(spin_out, SPINS, rtol=1e-14)


def test_units_of_pint_that_no_text_has_are_read():
    table = carom.Table({"first.material.density": QUANTITY(np.array([7.85]), "g/cm^3")})
    assert table.inputs((slice(0, 1),))["first.material.density"] == pytest.approx([7850.0])
    force = QUANTITY(np.array([210.0]), "kilonewton * meter / meter / millimeter / millimeter")
    table = carom.Table({"first.material.young": force})
    assert table.inputs((slice(0, 1),))["first.material.young"] == pytest.approx([210e9])


@pytest.mark.parametrize(
    ("data", "columns"),
    [
        ({"w": QUANTITY(RPM, "rad/s")}, {"w": "spin_out [rpm]"}),
        ({"w": xr.DataArray(RPM, attrs={"units": "rad/s"})}, {"w": "spin_out [rpm]"}),
        ({"w [rad/s]": RPM}, {"w": "spin_out [rpm]"}),
        ({"spin_out [rpm]": QUANTITY(RPM, "rad/s")}, None),
        ({"spin_out [rpm]": xr.DataArray(RPM, attrs={"units": "m"})}, None),
        ({"spin_out": xr.DataArray(QUANTITY(RPM, "rad/s"), attrs={"units": "rpm"})}, None),
    ],
)
def test_a_column_of_two_units_is_refused(data, columns):
    refused(r"it has two units, .*; leave one out", read_table, {"angle": RADIANS, **data}, columns)


def test_one_unit_may_be_told_twice():
    for own in (QUANTITY(RPM, "rpm"), xr.DataArray(RPM, attrs={"units": "rpm"})):
        table = read_table({"w [rpm]": own, "angle": RADIANS}, {"w": "spin_out [rpm]"})
        np.testing.assert_allclose(in_units(table, KNOWN)["spin_out"], SPINS, rtol=1e-14)


def test_errors_need_the_unit_that_the_data_tell():
    data = {"spin_out": QUANTITY(RPM, "rpm"), "spin_out_error": [1.0, 1.0]}
    refused("spin_out_error: no unit, but spin_out is in rev", read, data)


@pytest.mark.parametrize(
    "values",
    [
        *(["1_000", "2"], ["5 cm/s", "2"], [1 + 2j, 1j], [True, False], [1.5, 2.5], [1, 2]),
        np.array(["2020-01-01", "2021-01-01"], "M8[D]"),
        [Decimal(1), None],
    ],
    ids=str,
)
def test_a_mask_changes_nothing_but_what_it_hides(values):
    """Masked arrays are read as arrays are, NaN where they are masked: a gap in a fit."""
    plain = np.array(values)
    answer = carom.Table({"speed [mm/s]": plain}).inputs((slice(0, 2),))["speed"]
    for mask in ([0, 0], [0, 1]):
        column = {"speed [mm/s]": np.ma.array(plain, mask=mask)}
        speed = carom.Table(column).inputs((slice(0, 2),))["speed"]
        np.testing.assert_array_equal(speed, np.where(mask, np.nan, answer))
    inputs = {"angle": RADIANS, "spin_out": np.ma.array(SPINS, mask=[0, 1])}
    np.testing.assert_array_equal(read(inputs)["spin_out"], [SPINS[0], np.nan])


@pytest.mark.parametrize(
    "column",
    [
        *([[1], [1, 2]], [[1], [2]], [np.array([0.5]), 1], np.ones((2, 1)), "12", b"12"),
        *(pd.Series([[1], 2]), memoryview(b"12"), {1: 2}, 5, None),
        xr.Dataset({"a": ("x", [1.0, 2.0])}),
    ],
    ids=lambda column: type(column).__name__,
)
def test_what_is_no_list_of_cells_is_no_column(column):
    for call in (carom.Table, carom.verify.score, read_table):
        refused(r"speed: .* a column must be a list", call, {"speed": column, "angle": RADIANS})


@pytest.mark.parametrize(
    ("name", "text"),
    [("radius", "2,5 mm"), ("radius", "1,250 mm"), ("speed", "1,5 m/s"), ("friction", "0,25")],
)
def test_a_decimal_comma_is_refused_and_not_dropped(name, text, plate):
    """In a number, a body, a pair, a motion; in a cell beside a point, too."""
    inputs = {"radius": "5 mm", "speed": "1 m/s", "friction": 0.2, name: text}

    def struck():
        ball = carom.Sphere(radius=inputs["radius"], material="steel")
        pair = carom.Pair(ball, plate, friction=inputs["friction"])
        return carom.impact(pair, speed=inputs["speed"], angle="30 deg")

    message = f"^{name}: '{text}' cannot be used; numbers need a decimal point, not a comma$"
    refused(message, number, name, text)
    refused(message, struck)
    refused(
        r"^speed: not a number in row 1; '1,250\.5 m/s' cannot be used; numbers need",
        read,
        {"speed": ["1,250.5 m/s"], "spin_out": [1.0]},
    )


ROWS = "\n1,1\n1,1\n1,1\n"
BAD = {
    "angle,spin_out\n0.1,1\n30,1\n45,1\n": "30, 45 in cells A3 and A4 .* write 'angle [deg]'",
    "angle [rad],spin_out\n30,1\n": "angle: 30 in cell A2 .* says rad; for .* 'angle [deg]'",
    "angle [deg],spin_out\n90,1\n": "angle: 1.5708 in cell A2 .* below pi/2, 90 deg",
    "angle [deg],rebound_angle\n9,-7\n": "rebound_angle: -7 in cell B2 .* 'rebound_angle [deg]'",
    "angle [m],spin_out" + ROWS: "angle: 'm' cannot be used; that is not a value in rad",
    "angle [dog],spin_out" + ROWS: "unit 'dog' is not known",
    "angle,spin_out [Hz]" + ROWS: "a spin is not in Hz",
    "angle,tangential_restitution [kg]"
    + ROWS: "tangential_restitution: 'kg' cannot be used; .* pure number",
    "angle [deg],angle_error" + ROWS: "angle_error: no unit, but angle is in deg; write 'angle_e",
    "speed,angle\n1,1\n1,\n1,nan\n1,1\n": "angle: no value in cells B3 and B4; write it there",
    "angle,spin_out\n,1\n1,1\n": "angle: no value in cell A2; write it there, or delete the row",
    "angle,spin_out\n1,1\n1,inf\n": "spin_out: not a number in cell B3",
    "angle,spin_out\n1,fast\n": "spin_out: not a number in cell B2; 'fast' cannot",
    "angle;spin_out\n0,5 m;1\n": "angle: not a number in cell A2; '0.5 m' cannot",
    "angle|spin_out\n0.5|1\n": "separated by commas, semicolons or tabs",
    "angle,angle [deg]" + ROWS: "'angle': two columns, A and B, have this name",
    "# case: {\nangle,spin_out" + ROWS: "there is no JSON",
}


@pytest.mark.parametrize("text", BAD)
def test_bad_columns_are_refused_in_one_line(stored, text):
    with pytest.raises(InputError, match=BAD[text].replace("[", r"\[")):
        assert read(stored(text)) is None or read_table(stored(text)).case is None


@pytest.mark.parametrize(
    ("content", "words"),
    [
        ("", "it is empty"),
        ("# only a comment\n", "it is empty"),
        *(("psi_1,angle\n", "no rows"), ("0.1,0.2\n0.3,0.4\n", "the first line holds numbers")),
        ("psi_1,angle\n0.1,0.2\n0.3\n", "line 3 has 1 values, the header has 2 names"),
        ("psi_1,angle\n1,2,3\n", "line 2 has 3 values, the header has 2 names"),
        ('psi_1,angle\n"0.1,0.2\n', "not CSV"),
        ('psi_1,angle\n"3"0,0.2\n', "not CSV"),  # not 30
        ('psi_1,angle\n"1\n2",3\n', "not CSV; a text in quotes extends over several lines"),
        ("psi_1,psi_1,angle\n1,1,1\n", "'psi_1': two columns"),
        *((TEXT.encode("utf-16")[:-1], "is not text"), (b"a,b\n1,\0\xff\n", "is not text")),
        (TEXT.encode("utf-16-le"), "is not text"),
        (b"a,b\n\xc3\xa4,\n\xe4,1\n", "its lines are in two encodings"),
        *(
            ("a,b;c\nx,y;z\n", "may be separated by ';' or by ','"),
            (b"PK\x03\x04", "no spreadsheet"),
        ),
    ],
)
def test_what_is_no_table_is_refused_by_all_who_read_one(stored, content, words):
    for call in (carom.fit, carom.verify.score, carom.Table, read_table):
        refused(words, call, stored(content))


def test_rows_of_a_mapping_are_counted_from_one():
    refused(
        "angle: no value in rows 1 and 3",
        read,
        {"angle": [None, 0.1, math.nan, 0.2], "spin_out": [1, 2, 3, 4]},
    )


@pytest.mark.parametrize(
    ("name", "meant"),
    [
        *(("spinout", "spin_out"), ("Spin Out", "spin_out"), ("omega", "spin_out")),
        *(("theta", "angle"), ("incident_angle_deg", "angle [deg]")),
        *(("e_t", "tangential_restitution"), ("e_t_error", "tangential_restitution_error")),
        *(("omega_rad_s", "spin_out [rad/s]"), ("rebound angel", "rebound_angle")),
        *(("Drehzahl nachher", "spin_out"), ("Winkel nach", "rebound_angle")),
        *(("angle_after", "rebound_angle"), ("Winkel vorher", "angle"), ("theta before", "angle")),
    ],
)
def test_a_misspelt_column_is_refused_and_not_ignored(name, meant):
    table = read_table({"speed": [1.0], name: [0.1]})
    line = refused("", others, table, KNOWN)
    assert line == f"{name}: unknown column; did you mean {meant!r}?"


def test_columns_that_mean_nothing_here_are_named():
    table = read_table({"angle": [0.1], "run": [1], "temperature": [20.0], "spin_out": [1.0]})
    assert others(table, KNOWN) == ("run", "temperature")
    refused(
        "spin_out_error: its column 'spin_out' is missing",
        others,
        read_table({"angle": [0.1], "spin_out_error": [1.0]}),
        KNOWN,
    )


def test_too_few_rows_are_refused():
    dataset = read({"angle": [0.1, 0.2], "spin_out": [1.0, 2.0]})
    dataset.require_rows(2)
    refused("too few points: 2, at least 3 are needed", dataset.require_rows, 3)
