"""Designs of sweeps: grids, Latin hypercubes and tables hold the points that they promise."""

import math
import re

import numpy as np
import pandas as pd
import pytest
from tests.checks import refused

from carom import sweep
from carom.many.sweeps.designs import Grid, LatinHypercube
from carom.many.sweeps.tables import Table

DEGREE = math.pi / 180.0


def whole(design):
    return tuple(slice(0, n) for n in design.shape)


def test_a_grid_is_the_product_of_its_axes():
    """The last axis varies fastest; a box of it is that part of the product."""
    grid = Grid({"angle": ["10 deg", 0.5], "first.radius": ["5 mm", 1.0, 2.0]})
    assert (grid.dims, grid.shape) == (("angle", "first_radius"), (2, 3))
    points = grid.inputs((slice(1, 2), slice(1, 3)))
    assert points["angle"].tolist() == [0.5, 0.5]
    assert points["first.radius"].tolist() == [1.0, 2.0]
    expected = np.repeat([10 * DEGREE, 0.5], 3)
    np.testing.assert_allclose(grid.inputs(whole(grid))["angle"], expected, rtol=1e-15)


def test_ranges_are_even_in_value_or_logarithm():
    """Both ends are hit to the bit; differences, or quotients, of neighbours are equal."""
    axes = {
        "angle": {"from": "0 deg", "to": "85 deg", "points": 86},
        "first.material.young": {"from": "1 MPa", "to": "1 GPa", "points": 7, "spacing": "log"},
    }
    coords = Grid(axes)._coords()
    angles, young = coords["angle"][1], coords["first_material_young"][1]
    np.testing.assert_allclose(angles, np.arange(86) * DEGREE, rtol=1e-14)
    np.testing.assert_allclose(young[1:] / young[:-1], math.sqrt(10.0), rtol=1e-14)
    assert (young[0], young[-1]) == (1e6, 1e9)
    for spacing in ("linear", "log"):  # 0.2 + (0.9 - 0.2) is not 0.9, nor 0.3 (0.7/0.3) 0.7
        for start, stop in ((0.2, 0.9), (0.3, 0.7)):
            axis = {"from": start, "to": stop, "points": 3, "spacing": spacing}
            values = Grid({"friction": axis})._coords()["friction"][1]
            assert (values[0], values[-1]) == (start, stop)
    assert coords["first_material_young"][2]["units"] == "Pa"


def test_axes_of_names_are_their_own_coordinates():
    grid = Grid({"first.material": ["steel", "rubber"], "second.kind": ["cup", "sphere"]})
    assert grid._coords()["first_material"][1] == ["steel", "rubber"]
    assert grid.inputs(whole(grid))["second.kind"].tolist() == [0, 1, 0, 1]


@pytest.mark.parametrize("n", [1, 2, 3, 7, 64, 255, 1000, 12345])
def test_every_part_of_every_range_holds_one_sample(n):
    """The definition of a Latin hypercube: of n equal parts each is hit exactly once."""
    ranges = {"friction": (0, 1), "spin": (-3.0, 5.0), "angle": ("0 deg", "60 deg")}
    points = LatinHypercube(ranges, samples=n, seed=5).inputs((slice(0, n),))
    for name, start, stop in (("friction", 0, 1), ("spin", -3, 5), ("angle", 0, math.pi / 3)):
        parts = np.floor((points[name] - start) / (stop - start) * n).astype(int)
        assert np.array_equal(np.sort(parts), np.arange(n))


def test_logarithmic_samples_are_even_in_the_logarithm():
    wide = {"friction": {"from": 1e-3, "to": 1.0, "spacing": "log"}}
    values = LatinHypercube(wide, samples=500).inputs((slice(0, 500),))["friction"]
    parts = np.floor((3.0 + np.log10(values)) / 3.0 * 500).astype(int)
    assert np.array_equal(np.sort(parts), np.arange(500))


def test_samples_do_not_depend_on_the_block():
    """Any block alone holds the same bits, at ten million points as well."""
    design = LatinHypercube({"friction": (0.0, 1.0), "spin": (-1.0, 1.0)}, samples=10**7, seed=2)
    together = design.inputs((slice(9_990_000, 10**7),))
    for name, values in together.items():
        pieces = [design.inputs((slice(i, i + 1250),))[name] for i in range(9_990_000, 10**7, 1250)]
        assert np.array_equal(np.concatenate(pieces), values)
        assert np.unique(np.floor(values * 1e7 / (2.0 if name == "spin" else 1.0))).size == 10_000


def test_samples_are_random():
    """Means, correlations of inputs, of neighbours and of seeds are as of independent numbers."""
    n = 2**14 - 3
    names = ("friction", "spin", "spin2", "speed")
    seeds = [LatinHypercube(dict.fromkeys(names, (0.0, 1.0)), samples=n, seed=s) for s in (1, 2)]
    columns = [v for design in seeds for v in design.inputs((slice(0, n),)).values()]
    series = np.array([*columns, *(np.roll(column, 1) for column in columns)])
    others = np.corrcoef(series)[~np.eye(len(series), dtype=bool)]
    assert np.abs(others).max() < 4.5 / math.sqrt(n)
    assert np.abs(others).max() > 1.0 / math.sqrt(n)  # random, not constructed
    jitter = np.concatenate([np.mod(column * n, 1.0) for column in columns])
    assert abs(jitter.mean() - 0.5) < 4.5 / math.sqrt(12 * jitter.size)
    assert abs(jitter.var() - 1.0 / 12.0) < 0.002


def test_a_file_of_cases(tmp_path):
    """Units in the head or in the cell; what cannot be read is NaN and spoils no other cell."""
    path = tmp_path / "cases.csv"
    rows = ("0.1,36,0.5,steel", ".2, 72 , 90 deg,no such", "x,-1e1,nan,glass", ",3 m/s,5 kg, steel")
    text = "\n".join(["# measured", "friction,speed [km/h],angle,first.material", *rows])
    path.write_text(text)
    table = Table(path)
    points = table.inputs(whole(table))
    nan = np.nan
    np.testing.assert_array_equal(points["friction"], [0.1, 0.2, nan, nan])
    np.testing.assert_allclose(points["speed"], [10.0, 20.0, -10 / 3.6, 3.0], rtol=1e-15)
    np.testing.assert_allclose(points["angle"], [0.5, math.pi / 2, nan, nan], rtol=1e-15)
    assert points["first.material"].tolist() == [0, -1, 1, 0]
    assert [choice.label for choice in table._choices["first.material"]] == ["steel", "glass"]


def test_columns_of_arrays(tmp_path):
    """A mapping and a CSV file of the same numbers are the same table, to the last bit."""
    rng = np.random.default_rng(1)
    columns = {"friction": rng.uniform(size=50), "spin": rng.normal(size=50) * 1e5}
    path = tmp_path / "cases.csv"
    rows = zip(*columns.values(), strict=True)
    path.write_text("friction,spin\n" + "\n".join(f"{a!s},{b!s}" for a, b in rows))
    one, two = Table(columns), Table(str(path))
    assert one._description() == two._description()
    columns["spin"][7] = np.nextafter(columns["spin"][7], 0.0)
    assert Table(columns)._description() != two._description()


def test_a_decimal_comma_in_a_cell_is_not_dropped():
    table = Table({"friction": ["0,25", "0.25"], "speed": ["1,5 m/s", "1.5 m/s"]})
    points = table.inputs((slice(0, 2),))
    np.testing.assert_array_equal(points["friction"], [np.nan, 0.25])
    np.testing.assert_array_equal(points["speed"], [np.nan, 1.5])


BELOW = {  # the head: rows below it that are none of numbers, then rows of numbers
    "speed,angle\nmm/s,1\n1000,0.1\n2000,0.2\n": "speed: 'mm/s' in line 2 .*'speed \\[mm/s\\]'",
    "speed [m/s];angle\n[mm/s];[deg]\n1000;10\n": "2 faults: .*'mm/s' in line 2 .*'deg' in line 2",
    "speed\t angle\n(km/h)\tfast\n10\t20\n": "speed: 'km/h' in line 2 .* head of the column",
    "friction,angle\n0.2,10\n0.2,deg\n": "angle: 'deg' in line 3 is a unit without a number",
    "first.radius,friction\nmm,1\n5,0.2\n": "first.radius: 'mm' in line 2 is a unit",
    "first.material.density,friction\nkg/m3,1\n7850,0.2\n": "density: 'kg/m3' in line 2",
    "speed,angle\nvelocity,incidence\n1,0.2\n": "table, line 2: 'velocity, incidence' .* no number",
    "speed,angle\n(set),\n1,0.2\n": "table, line 2: '\\(set\\)' .* no number",
    "speed,first.material\nm/h,steel\n1,glass\n": "speed: 'm/h' in line 2",
}


@pytest.mark.parametrize(("text", "words"), BELOW.items())
def test_a_row_below_the_head_without_numbers_is_no_case(text, words, tmp_path):
    """Units there would be passed over, and what stands below be read in others."""
    path = tmp_path / "cases.csv"
    path.write_text(text)
    frame = pd.read_csv(path, sep=None, engine="python").rename(columns=str.strip)
    in_rows = re.sub(r"line (\d)", lambda line: f"row {int(line[1]) - 1}", words)
    for source in (path, frame, {name: list(column) for name, column in frame.items()}):
        expected = words if source is path else in_rows
        refused(expected, Table, source)


UNITS_BELOW = {
    "speed,angle\nmm/s,rad\n1000,0.1\n2000,0.2\n": {"speed": [1.0, 2.0], "angle": [0.1, 0.2]},
    "speed;angle\n[mm/s];[deg]\n1000;180\n": {"speed": [1.0], "angle": [math.pi]},
    "speed\t angle\n(km/h)\t°\n7.2\t180\n": {"speed": [2.0], "angle": [math.pi]},
    "friction,angle\n%,-\n20,0.1\n": {"friction": [0.2], "angle": [0.1]},
    "friction,angle\n-,deg\n0.2,180\n": {"friction": [0.2], "angle": [math.pi]},
}


@pytest.mark.parametrize(("text", "values"), UNITS_BELOW.items())
def test_a_row_of_units_alone_below_the_head_of_a_file_is_heeded(text, values, tmp_path):
    """As programs of laboratories write them; a data frame has no such row."""
    path = tmp_path / "cases.csv"
    path.write_text(text, encoding="utf-8")
    points = Table(path).inputs((slice(0, 9),))
    assert {name: pytest.approx(points[name], rel=1e-15) for name in points} == values
    frame = pd.read_csv(path, sep=None, engine="python").rename(columns=str.strip)
    refused("in row 1 is a unit without a number", Table, frame)


def test_rows_that_hold_numbers_may_have_units_of_their_own():
    table = Table({"speed": ["1000 mm/s", 2.0, "-"], "angle": ["", "20 deg", "0.1"]})
    points = table.inputs((slice(0, 3),))
    np.testing.assert_allclose(points["speed"], [1.0, 2.0, np.nan], rtol=1e-15)
    np.testing.assert_allclose(points["angle"], [np.nan, np.radians(20.0), 0.1], rtol=1e-15)


def test_cells_of_lists():
    values = Table({"angle": ["90 deg", 0.1, None, True]}).inputs((slice(0, 4),))["angle"]
    np.testing.assert_array_equal(values, [math.pi / 2, 0.1, np.nan, np.nan])
    masked = np.ma.array([0.25, 0.5], mask=[True, False])
    assert np.isnan(Table({"friction": masked}).inputs((slice(0, 2),))["friction"][0])


CUBE = {"friction": (0.1, 0.2)}


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: Grid({}), "design: no inputs"),
        (lambda: Grid(["angle"]), "axes: .*mapping"),
        (lambda: Grid({"anlge": [1]}), "anlge: .*did you mean 'angle'"),
        (lambda: Grid({"radius": [1]}), "radius: .*'first.radius'"),
        (lambda: Grid({"angle": []}), "angle: .*at least one"),
        (lambda: Grid({"friction": [0.1, math.nan]}), "friction: nan .*finite"),
        (lambda: Grid({"friction": [0.1, math.inf]}), "friction: inf .*finite"),
        (lambda: Grid({"friction": "0.1 kg"}), "friction: '0.1 kg'"),
        (lambda: Grid({"angle": [0, 30, 60]}), "radians"),
        (lambda: Grid({"angle": {"from": 0, "to": 60, "points": 3}}), "write '60 deg'"),
        (lambda: Grid({"friction": {"from": 0, "to": 1}}), "friction.points: None"),
        (lambda: Grid({"friction": {"from": 1, "to": 1, "points": 2}}), "must not end where"),
        (lambda: Grid({"friction": {"to": 1, "points": 2}}), "friction.from: missing"),
        (lambda: Grid({"friction": {"from": 0, "to": 1, "points": 2, "step": 1}}), "step: unknown"),
        (
            lambda: Grid({"spin": {"from": -1, "to": 1, "points": 2, "spacing": "log"}}),
            "logarithmic spacing needs positive",
        ),
        (
            lambda: Grid({"spin": {"from": 1, "to": 2, "points": 2, "spacing": "cubic"}}),
            "spin.spacing: 'cubic' .*linear or log",
        ),
        (lambda: Grid({"speed": [1], "normal_speed": [1]}), "speed .*not both|not both"),
        (lambda: Grid({"first.material": ["stel"]}), "material: 'stel' .*steel"),
        (lambda: Grid({"first.material": ["steel", "steel"]}), "given twice"),
        (lambda: Grid({"second.kind": ["ball"]}), "kind: 'ball'"),
        (lambda: LatinHypercube(CUBE, samples=0), "samples: 0"),
        (lambda: LatinHypercube(CUBE, samples=10**13), "samples: "),
        (lambda: LatinHypercube(CUBE, samples=1.5), "samples: 1.5"),
        (lambda: LatinHypercube(CUBE, samples=2, seed=-1), "seed: -1"),
        (lambda: LatinHypercube({"friction": [0.1, 0.2, 0.3]}, samples=2), "must be a range"),
        (lambda: LatinHypercube({"friction": (0.1, 0.1)}, samples=2), "must not end where"),
        (lambda: Table("no such.csv"), "'no such.csv' cannot be read"),
        (lambda: Table({"angle": [1, 2], "friction": [1]}), "equally long"),
        (lambda: Table({"angle": []}), "no rows"),
        (lambda: Table({"angle [kg]": [1]}), "angle: .*kg"),
        (lambda: Table({"angle": [1], "angle [deg]": [1]}), "two columns"),
        (lambda: Table(5), "table: 5"),
        (lambda: LatinHypercube({"angle": np.array(0.5)}, samples=2), "angle: .*must be a range"),
        (lambda: Grid({"second.kind": [np.array(["cup", "cup"])]}), "kind: an array of shape"),
        (lambda: Table({"first.material": [{"young": 1e9}]}), "first.material: .*must hold texts"),
        (lambda: sweep({}, object()), "design: .*must be a Grid"),
        (lambda: sweep({}, Grid), "design: .*must be a Grid"),
        (lambda: sweep({"second": {"kind": np.array(["cup"])}}, Grid(CUBE)), "kind: an array"),
    ],
)
def test_what_is_no_design_is_refused_in_a_line(make, message):
    refused(message, make)


@pytest.mark.parametrize("inputs", ["glass", np.array("glass"), np.array(["glass"])])
def test_one_name_is_an_axis_of_one(inputs):
    """However it is given; its label is a plain text."""
    (label,) = Grid({"second.material": inputs})._coords()["second_material"][1]
    assert (type(label), label) == (str, "glass")


@pytest.mark.parametrize("text", ["", "angle,friction\n1,2,3\n", "angle\n1\n2,3\n", "angle\n"])
def test_what_is_no_table_is_refused(tmp_path, text):
    path = tmp_path / "cases.csv"
    path.write_text(text)
    refused("table: ", Table, path)
