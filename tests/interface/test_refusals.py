"""Bad input to fields, stresses and animations: one clear line that names what is wrong."""

from itertools import product

import numpy as np
import pandas as pd
import pytest
import xarray as xr
from tests.checks import refused

import carom

NAN = float("nan")


@pytest.fixture(scope="module")
def hit(steel_ball):
    rigid = carom.HalfSpace(material=carom.Material(young=float("inf"), poisson=0.3))
    return carom.impact(carom.Pair(steel_ball, rigid, friction=0.2), speed=1.0, angle="20 deg")


def test_a_refusal_is_one_line_whatever_it_names():
    assert str(carom.InputError("a\nb\r\nc\x0bd\u2028e")) == "a b c d e"


@pytest.mark.parametrize("ask", ["fields", "stress", "radial", "contact"])
@pytest.mark.parametrize(
    ("time", "message"),
    [
        *((1.0, "within the contact, from 0 to"), (-1e-9, "within the contact, from 0 to")),
        *((NAN, "give a number in s"), ("soon", "give a number in s")),
        *(("5 mm", "not a value in s"), (None, "give a number in s")),
    ],
)
def test_times(hit, ask, time, message):
    refused(f"^at: .*{message}", getattr(hit, ask), time)


@pytest.mark.parametrize(
    ("inputs", "message"),
    [
        ({"points": [1.0, 2.0]}, r"points: an array of shape \(2,\) cannot .* shape \(n, 2\)"),
        ({"points": np.zeros((4, 3))}, r"shape \(4, 3\) .* must be .* of shape \(n, 2\)"),
        ({"points": np.zeros((0, 2))}, r"shape \(0, 2\)"),
        ({"points": [[0.0, 0.0], [0.0, NAN]]}, "row 1 is not finite"),
        ({"points": "here"}, r"points: 'here' .* shape \(n, 2\)"),
        ({"points": [[0.0, 0.0]], "x": [0.0]}, "a grid by x and y, or points"),
        ({"x": []}, "x: .* list of finite numbers"),
        ({"y": [0.0, NAN]}, "y: .* list of finite numbers"),
        ({"x": [[0.0, 1.0]]}, "x: .* list of finite numbers"),
        ({"x": [True, False]}, "x: .* list of finite numbers"),
        ({"x": [None, 0.0]}, "x: .* list of finite numbers"),
        ({"x": np.array(["2020-01-01"], "M8[D]")}, "x: .* list of finite numbers"),
        ({"x": np.ma.masked_array([0.0, 1.0], [0, 1])}, "x: .* list of finite numbers"),
        ({"points": np.array([["here", 1.0]] * 40, dtype=object)}, "points: 'here' cannot"),
    ],
)
def test_places_on_the_surface(hit, inputs, message):
    refused(message, hit.fields, 1e-6, **inputs)


@pytest.mark.parametrize(
    ("inputs", "message"),
    [
        ({"points": np.zeros((4, 2))}, r"shape \(n, 3\)"),
        ({"points": [[0.0, 0.0, -1e-6]]}, "depth in the body and must not be negative"),
        ({"z": [-1e-6]}, "depth in the body and must not be negative"),
        ({"points": [[0.0, 0.0, 0.0]], "z": [0.0]}, "a grid by x and z, or points"),
        ({"body": "second"}, "body: 'second' .* rigid .* ask for the first"),
        ({"body": "frist"}, "body: 'frist' .* did you mean 'first'"),
        ({"body": 3}, "body: 3 cannot be used"),
    ],
)
def test_places_below_the_surface(hit, inputs, message):
    refused(message, hit.stress, 1e-6, **({"body": "first"} | inputs))


@pytest.mark.parametrize("n", [1, 2.5, "many", NAN, None])
def test_numbers_of_times_and_distances(hit, n):
    refused(r"n: .* whole number of at least 2", hit.radial, 1e-6, n)
    refused(r"n: .* whole number of at least 2", hit.history, n)


@pytest.mark.parametrize("frames", [0, -3, 1.5, NAN, None])
def test_number_of_frames(hit, tmp_path, frames):
    refused(r"frames: .* whole number of at least 1", hit.animate, tmp_path / "hit.gif", frames)
    assert list(tmp_path.iterdir()) == []


def test_names_of_files(hit):
    for store in (hit.plot, hit.animate, lambda path: carom.save(hit, path), carom.read):
        refused("file: 5 cannot be used; must be the name", store, 5)


def test_what_is_at_the_ends_of_the_contact(hit):
    """At the first and last touch there is a contact of radius zero, without stress."""
    for time in (0.0, hit.duration):
        assert float(hit.fields(time).pressure.max()) == 0.0
        assert float(hit.stress(time, body="first").von_mises.max()) == 0.0
        assert float(hit.radial(time).traction_x[0]) == 0.0


def test_texts_with_units_are_taken_everywhere(hit):
    plain = hit.fields(1e-6, x=[1e-4], y=[0.0, 2e-5])
    texts = hit.fields("1 us", x="0.1 mm", y=["0 mm", "20 um"])
    xr.testing.assert_allclose(texts, plain, rtol=1e-9, atol=0.0)
    moves = {"normal_force": "10 N", "tangential_force": ["0 N", "500 mN"]}
    path = carom.load_path(hit.pair, **moves)
    assert path.tangential_force == pytest.approx([0.0, 0.5], abs=1e-12)
    refused(r"x: '0\.1 s' cannot be used", hit.fields, 1e-6, x="0.1 s")
    wrong = {"normal_force": 10.0, "tangential_force": ["0 N", "1 m"]}
    refused("tangential_force: '1 m' cannot be used", carom.load_path, hit.pair, **wrong)


def test_storing_results(hit, tmp_path):
    stored = carom.save(hit, tmp_path / "hit.nc")
    assert carom.read(stored).identical(hit.to_dataset())
    words = r"result: 'hit' .* an impact or a load path"
    refused(words, carom.save, "hit", tmp_path / "other.nc")
    assert [path.name for path in tmp_path.iterdir()] == ["hit.nc"]


class Unequal:
    """What is equal to nothing, not even to be asked for it."""

    __hash__ = None

    def __eq__(self, other):
        raise RuntimeError


CASE = {"first": {"radius": "5 mm", "material": "steel"}, "speed": 2.0, "friction": 0.2}
NO_NAMES = [
    *(1, 0, 1.5, True, NAN, b"x", "psi_out", "", object(), Unequal(), len, range(3), pd.NA),
    *({"psi_out": 1}, {"psi_out"}, iter(["psi_out"]), (name for name in ["psi_out"])),
    *([], (), [1], [None], [b"psi_out"], [["psi_out"]], [[]], [{}], [""], [NAN], [10**5000]),
    *([Unequal()], [pd.NA], [np.array(["psi_out", "chi"])], ["psi_out", None], ["psi_out"] * 2),
    *(np.array([1.0]), np.zeros(0), np.array([["psi_out"]]), np.array(["psi_out"])),
    *(pd.Series(["psi_out"]), pd.DataFrame({"psi_out": [1]}), xr.DataArray(["psi_out"])),
]


@pytest.mark.parametrize("outputs", NO_NAMES, ids=[str(row) for row in range(len(NO_NAMES))])
def test_outputs_of_a_sweep_that_are_no_list_of_names(outputs):
    grid = carom.Grid({"angle": [0.1]})
    refused("^outputs: ", carom.sweep, CASE, grid, outputs=outputs, progress=False)


def damaged_tables():
    """Yield tables of a law of which a part is missing, of another kind, shape or size."""
    law = carom.laws.ReboundLaw(1.44)
    for key in ("chi", "edges", "coefficients"):
        table = law.to_dict()
        del table[key]
        yield table
        for value in (*NO_NAMES, -1.0, float("inf"), 1e300, "x", [[1.0], [1.0, 2.0]]):
            yield law.to_dict() | {key: value}
    for value in (*NO_NAMES, -1.0, 2.0, float("inf"), 0.9):
        if type(value) is bool or not (isinstance(value, int) and value == 1):
            yield law.to_dict() | {"restitution": value}
    values = (NAN, None, "x", 10**5000, 1e300, float("inf"), np.ma.masked, [1.0], {})
    for value, row, part in product(values, (0, 3, -1), range(3)):
        table = law.to_dict()
        if part == 2:
            table["coefficients"][row][5] = value
        else:
            table[("edges", "coefficients")[part]][row] = value
        yield table
    yield from (None, 1, "table", [], {}, law, np.zeros((3, 3)), iter([1]))


def test_tables_of_a_law_that_are_damaged():
    count = 0
    for table in damaged_tables():
        refused(r"^table: it is not a table of ReboundLaw", carom.laws.ReboundLaw.from_dict, table)
        count += 1
    assert count > 200


PSI = [(0.5, 0.1), (1.0, 0.0), (2.0, -0.9)]
COLUMNS = np.array(PSI, [("psi_1", "f8"), ("psi_2", "f8")])


@pytest.mark.parametrize(
    "inputs",
    [
        *(COLUMNS, COLUMNS.view(np.recarray), np.ma.masked_array(COLUMNS)),
        np.array(PSI, [("psi_1 [1]", "f4"), ("psi_2", "f8")]),
        np.array(PSI, [("psi_1", "U8"), ("psi_2", "O")]),
        *(pd.DataFrame(COLUMNS).to_records(index=False), COLUMNS[::-1][::-1]),
    ],
)
def test_fields_of_records_are_columns(inputs):
    """As numpy.genfromtxt(names=True) reads them."""
    whole = {"psi_1": [0.5, 1.0, 2.0], "psi_2": [0.1, 0.0, -0.9]}
    wanted = carom.verify.score(whole, chi=1.44).to_dict()
    assert carom.verify.score(inputs, chi=1.44).to_dict() == wanted


@pytest.mark.parametrize(
    "inputs",
    [
        *(COLUMNS[0], COLUMNS.reshape(3, 1), np.array(PSI[0], COLUMNS.dtype), COLUMNS[:0]),
        np.zeros(3, [("psi_1", "f8", 2), ("psi_2", "f8")]),
        *(np.zeros(3, [("psi_1", [("a", "f8")]), ("psi_2", "f8")]), np.zeros(3, "V8")),
        *(np.array(PSI), np.array(PSI, dtype=object)),
        {"psi_1": COLUMNS, "psi_2": COLUMNS["psi_2"]},
        {"psi_1": list(COLUMNS), "psi_2": COLUMNS["psi_2"]},
        {"psi_1": np.array([{}, None, 1], object), "psi_2": COLUMNS["psi_2"]},
    ],
)
@pytest.mark.parametrize("use", ["score", "fit", "table"])
def test_records_that_are_no_columns(use, inputs):
    call = {
        "score": lambda arguments: carom.verify.score(arguments, chi=1.44),
        "fit": carom.fit,
        "table": lambda arguments: carom.sweep(CASE, carom.Table(arguments)),
    }[use]
    refused(": ", call, inputs)
