"""Cells of files: decimal commas, what is missing, and all faults at once, by cell."""

import ast
import re

import numpy as np
import pytest
from tests.checks import PAIR, refused

import carom
from carom.io import table_rows
from carom.io.heads import TableFormat, as_toml, table_format
from carom.io.remedies import SHELL, offering
from carom.io.tables import read_table
from carom.io.user_table import column_in_si, in_units


def values_of(content, stored, **how):
    """Return the cells of the first column of a file as numbers, and the texts of all notes."""
    table = read_table(stored(content), **how)
    name = table.names[0]
    return column_in_si(name, "1", "", table.column(name).cells)[0].tolist(), table.notes


DECIMALS = {  # the first column of a file, its numbers, or words of the line that asks
    "a;b\n0,5;x\n1;y\n": [0.5, 1.0],
    "a;b\n1,234;0,5\n2,5;1\n": [1.234, 2.5],
    "a;b\n1,234;0,5\n2,345;1\n": [1.234, 2.345],  # the other column has decimal commas
    "a;b\n-12,75 %;1\n": [-0.1275],
    "a;b\n1,5e3;1\n": [1500.0],
    "a\tb\n,5\t1\n": [0.5],
    'a,b\n"0,5","1,25"\n"2","3"\n': [0.5, 2.0],
    "a;b\n1.5;x\n2;y\n": [1.5, 2.0],
    "a;b\n1.234;x\n2;y\n": [1.234, 2.0],  # a point is decimal where no comma is
    "a;b\n0,125;1\n": [0.125],
    "a;b\n1,234;x\n2,345;y\n": "a: 1,234 in cell A2 may be 1.234 or 1234, .* give decimal=','",
    'a,b\n"1,234",5\n': "a: 1,234 in cell A2 may be 1.234 or 1234",
    'a,b\n"1,234",0.5\n': "a: 1,234 in cell A2 may be 1.234 or 1234",
    "a;b\n1.234;0,5\n": r"a: 1.234 in cell A2 may be 1.234 or 1234, .* give decimal='\.'",
    "a;b\n5;1\n0,5;2\n1.5;3\n": "0,5 in cell A3 and 1.5 in cell A4 have different decimal signs",
    "a;b\n0,5;2\n1.234;3\n": "0,5 in cell A2 and 1.234 in cell A3 have different",
    "a;b\n1.234,5;2\n": [np.nan],
    "a;b\n1,234,567;2\n": [np.nan],
    "a;b\n1.234.567;0,5\n": [np.nan],
    "a;b\n01.02.2026;0,5\n": [np.nan],
    "a;b\n12,30 und 5;0,5\n": [np.nan],
}


@pytest.mark.parametrize("content", DECIMALS)
@pytest.mark.parametrize("size", [1, 1 << 16])
def test_a_decimal_comma_is_read_where_it_can_be_nothing_else(content, size, stored, monkeypatch):
    """In blocks of a row and in one of all; or it is asked, with the cell."""
    monkeypatch.setattr(table_rows, "BLOCK_ROWS", size)
    expected = DECIMALS[content]
    if isinstance(expected, str):
        refused(expected, values_of, content, stored)
    else:
        np.testing.assert_array_equal(values_of(content, stored)[0], expected)


def test_a_decimal_sign_may_be_said(stored):
    thousands = "a;b\n1,234;x\n2,345;y\n"
    assert values_of(thousands, stored, decimal=",")[0] == [1.234, 2.345]
    assert np.isnan(values_of(thousands, stored, decimal=".")[0]).all()
    assert values_of("a;b\n1.234;0,5\n", stored, decimal=".")[0] == [1.234]
    refused(
        "1.5 in cell A3 has a decimal point", values_of, "a;b\n1;0\n1.5;2\n", stored, decimal=","
    )
    refused("decimal: ';' cannot be used; must be", values_of, thousands, stored, decimal=";")
    refused("decimal: only a file has it", read_table, {"a": ["1,5"], "b": [1]}, decimal=",")


BLANKS = {  # between columns; words of the line that refuses, or the names of columns
    "angle speed\n10 1.5\n20 1.6\n": ("angle", "speed"),
    "angle   spin_out\n 10  -0.5 \n20 NaN\n": ("angle", "spin_out"),
    "angle ,speed\n1 ,2\n3 ,4\n": ("angle", "speed"),
    "# angle speed\n1 2\n3 4\n": ("angle", "speed"),  # of NumPy's savetxt
    "angle[deg] speed[m/s]\n10,5 1,5\n20 1,6\n": ("angle", "speed"),
    "angle speed\n1, 2\n3, 4\n": "the first line holds numbers",  # commas between
    "angle [deg] speed [m/s]\n10 1.5\n20 1.6\n": "so are words of its head; write angle\\[deg\\]",
    "speed [m/s]\n10 1.5\n20 1.6\n": "so are words of its head",
    "angle speed\n10 1.5\n20\n": "give columns separated",
    "angle note\n10 good\n20 bad\n": "give columns separated",
}


@pytest.mark.parametrize("content", BLANKS)
def test_columns_between_blanks_are_read_where_they_can_be_nothing_else(content, stored):
    expected = BLANKS[content]
    if isinstance(expected, str):
        refused(expected, read_table, stored(content))
        return
    table = read_table(stored(content))
    assert table.names == expected
    own = [line.replace(" ,", " ").replace(",", ".").split() for line in content.splitlines()[1:]]
    for name, cells in zip(expected, zip(*own, strict=True), strict=True):
        values = column_in_si(name, "1", "", table.column(name).cells)[0]
        np.testing.assert_array_equal(values, [float(cell) for cell in cells])


@pytest.mark.parametrize("date", ["2024-05-03", "2024-05-03 00:00:00", "01.05.2024", "5/3/24"])
def test_dates_in_a_column_are_said_to_be_dates(date, stored):
    """As spreadsheets make of numbers; not that a part of them is no unit."""
    file = stored(f"angle;spin_out\n0.1;1\n0.2;{date}\n")
    line = refused(
        "^spin_out: not a number in cell B3; .* it is a date", carom.fit, file, pair=PAIR
    )
    assert "is not a unit" not in line


@pytest.mark.parametrize(
    "text", ["angel;speed;spin_out\n0.1;1;2\n", "angle;sped;spin_out\n0.1;1;2\n"]
)
def test_a_misspelt_column_is_one_fault(text, stored):
    line = refused("unknown column; did you mean", carom.fit, stored(text), pair=PAIR)
    assert "column missing" not in line
    assert "faults" not in line


def test_of_a_misspelt_drop_height_the_bounces_are_not_read(stored):
    text = "drop_hight [cm];rebound_height [cm]\n20;16\n30;24\n"
    line = refused("^drop_hight: unknown column", carom.fit, stored(text), pair=PAIR)
    assert "If so, give columns={'drop_hight [cm]': 'drop_height'}" in line


def test_an_error_in_other_words_is_asked_with_the_unit_of_its_column(stored):
    text = "angle [deg];spin_out [rpm];omega_error\n10;-5;1\n20;-7;1\n"
    refused(
        r"give columns=\{'omega_error': 'spin_out_error \[rpm\]'\}",
        carom.fit,
        stored(text),
        pair=PAIR,
    )


MISSING = ["", "-", "NaN", "nan", "NA", "n/a", "N/A", " ", "#N/A", "\N{EN DASH}"]


@pytest.mark.first_case
@pytest.mark.parametrize("cell", MISSING)
def test_what_is_missing_is_counted_or_refused_by_its_cell(cell, stored):
    text = f"angle [deg];speed;spin_out [rpm]\n10;1;-200\n20;1;{cell}\n30;1;-500\n;;\n40;1;-600\n"
    result = carom.fit(stored(text), pair=PAIR, fixed={"restitution": 1.0})
    assert "1 value missing: spin_out in cell C3" in result.notes
    assert result.to_dict()["values"] == 3
    words = "angle: no value in cell A4; write it there, or delete the row"
    refused(words, carom.fit, stored(text.replace("\n30;", f"\n{cell};")), pair=PAIR)


def test_rows_that_were_not_done_are_left_out_and_said(stored):
    rows = (
        "run,angle [deg],speed,spin_out [rpm]\n1,10,1,-200\n2,20,1,-400\n3,,,\n4,30,1,-500\n5,,,\n"
    )
    result = carom.fit(stored(rows), pair=PAIR, fixed={"restitution": 1.0})
    assert "left out, as they have no value: lines 4 and 6" in result.notes
    assert not [note for note in result.notes if "missing" in note]
    refused(
        "angle: no value in cell B4", carom.fit, stored(rows.replace("3,,,", "3,,,-300")), pair=PAIR
    )


def test_all_faults_are_said_at_once_with_what_mends_them(stored):
    text = "Winkel [°];theta_r;speed;spin_out [rpm]\n10;5;1;fast\n20;6;;-1,234\n30;7;2;0.5\n"
    line = refused("^4 faults: ", carom.fit, stored(text), pair=PAIR)
    assert "If so, give columns={'Winkel [°]': 'angle'}" in line
    assert "If so, give columns={'theta_r': 'rebound_angle [deg]'}, with the unit" in line
    assert "spin_out: -1,234 in cell D3 and 0.5 in cell D4 have different decimal signs" in line
    assert "speed: no value in cell C3" in line


FAULTY = """Winkel [°];speed [m/s];speed;spin_out [rpm];normal_restitution;rebound_angle [Ohm];spin2
10;1,5;1;-200;0,9;3;1,234
20;1,5;1;-300;fast;4;2,345
30;1,5;1;-400
40;;1;-400;0,9;5;3.5
50;"1,5
6";1;-500;0,8;5;1,000
60;1;1;"3"0;0,7;1;2,000
70;1;1;2;0,7;1;2,000;9
80;1;1
"""
FAULTS = (
    "it is not CSV; a text in quotes extends over several lines, from line 6 on",
    "it is not CSV; line 8: ';' expected after",
    "lines 4 and 10 have 4 values, line 7 has 6 values, line 9 has 8 values, the header has 7",
    "columns: 'w' cannot be used; results has no column of that name",
    "'speed': two columns, B and C, have this name",
    "give columns={'Winkel [°]': 'angle'}",
    "normal_restitution: not a number in cell E3; 'fast' cannot be used",
    "rebound_angle: 'Ohm' cannot be used; unit 'Ohm' is not known",
    "speed: no value in cell B5",
    "spin2: 1,234 in cell G2 and 3.5 in cell G5 have different decimal signs",
)


def test_a_file_with_one_of_each_fault_has_them_all_in_one_message(stored):
    """Of its rows, its heads, the options, its units and its cells; by all who read tables."""
    file = stored(FAULTY.replace("80;1;1", "80;1;1;"))
    line = refused(f"^{len(FAULTS)} faults: ", carom.fit, file, pair=PAIR, columns={"w": "spin"})
    assert not [words for words in FAULTS if words not in line]
    for call in (carom.verify.score, carom.Table, read_table):
        line = refused("", call, file)
        assert not [words for words in (*FAULTS[:3], FAULTS[4]) if words not in line]


def test_a_table_with_faults_is_none_to_whoever_asks_for_a_column(stored):
    table = read_table(stored("psi_1;psi_2\n1;2\n3\n4;5\n"), lenient=True)
    assert table.names == ("psi_in", "psi_out")
    assert table.rows.tolist() == [2, 4]
    words = "line 3 has 1 values, the header has 2 names"
    refused(words, table.column, "psi_in")
    refused(words, in_units, table, ["psi_in"])
    refused(words, in_units, table, ["angle"])


UNITS_SAID = {  # in the head, by --column, and the factor to SI units, 0 where both cannot be true
    ("1/min", "spin_out [rpm]"): np.pi / 30.0,
    ("min^-1", "spin_out [rad/s]"): 0.0,
    ("1/s", "spin_out [rad/s]"): 1.0,
    ("Hz", "spin_out [rps]"): 2.0 * np.pi,
    ("Umdr./min", "spin_out [rpm]"): np.pi / 30.0,
    ("rad/s", "spin_out [rpm]"): 0.0,
    ("mm", "spin_out [rpm]"): 0.0,
    ("Grad", "angle [deg]"): np.pi / 180.0,
    ("deg", "angle [rad]"): 0.0,
    ("Ohm", "speed [m/s]"): 1.0,
    ("s", "speed [m/s]"): 0.0,
}


@pytest.mark.parametrize(("own", "said"), UNITS_SAID)
def test_a_unit_that_cannot_be_read_may_be_said(own, said, stored):
    """Not one that can be read as another."""
    file, name = stored(f"x [{own}];b\n0,5;1\n"), said.partition(" ")[0]
    if not (factor := UNITS_SAID[own, said]):
        refused("x: it has two units", read_table, file, {"x": said})
        return
    table = in_units(read_table(file, {"x": said}), [name])
    assert table[name] == pytest.approx([0.5 * factor], rel=1e-15)


def test_the_option_that_mends_a_column_has_a_unit_where_it_is_needed(stored):
    text = "Winkel [Grad];v_in;Drehzahl [1/min]\n10;1;-200\n20;1;-300\n30;1;-9\n"
    line = refused("^3 faults: ", carom.fit, stored(text), pair=PAIR)
    assert "did you mean 'angle'? It is measured from the normal." in line
    found = map(ast.literal_eval, re.findall(r"give columns=(\{[^}]*\})", line))
    names = {head: name for each in found for head, name in each.items()}
    with offering(SHELL):
        line = refused("^3 faults: ", carom.fit, stored(text), pair=PAIR)
    options = re.findall('add --column "([^"]*)"', line)
    assert dict(option.rsplit("=", 1) for option in options) == names
    assert names == {
        "Winkel [Grad]": "angle [deg]",
        "v_in": "speed",
        "Drehzahl [1/min]": "spin_out [rpm]",
    }
    assert carom.fit(stored(text), pair=PAIR, columns=names, fixed={"restitution": 1.0}).friction


def test_how_a_file_is_read_may_be_stored(stored, tmp_path):
    how = TableFormat(
        {'a "quoted" head [°]': "angle", "Drehzahl": "spin_out [rpm]"}, "S\u00e4ge", ","
    )
    path = tmp_path / "map.toml"
    path.write_text(as_toml(how), encoding="utf-8")
    assert table_format(path) == how
    assert table_format(path, sheet="B", decimal=".") == how._replace(sheet="B", decimal=".")
    path.write_text('decimal = ","\n[columns]\nw = "angle [deg]"\n', encoding="utf-8")
    table = read_table(stored("w;v\n1,500;2\n"), str(path))
    assert table.cells["angle"].cells.tolist() == [1.5]
    for text, words in {
        "columns = 3": "columns: 3 cannot be used",
        "[column]\na = 'b'": "columns: 'column' in .* is unknown; did you mean 'columns'",
        "w = [": "is not TOML",
        "sheet = 3": "sheet: 3 cannot be used; must be a text",
    }.items():
        path.write_text(text, encoding="utf-8")
        refused(words, table_format, path)
    refused("columns: .*cannot be read", table_format, tmp_path / "none.toml")
