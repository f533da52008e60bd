"""Tables as people have them, mutated: a result, or one line; and no cell read otherwise."""

import numpy as np
import pytest

import carom
from carom.fitting.reading import read_problem
from carom.io import table_rows
from carom.io.tables import read_table
from carom.io.user_table import column_in_si

HEAD = "angle [deg],speed [m/s],spin,spin_out [rpm],e_n,tangential_restitution [%]\n"
COLUMNS = {"e_n": "normal_restitution"}
MEASURED = HEAD + "".join(
    f"{a},2.0,0,{-20 * a - 50:.1f},0.98,{70 - a / 2}\n" for a in (5, 10, 20, 35, 50, 70)
)
CURVE = "# rebounds\npsi_1;psi_2;chi\n0.5;0.04;1.44\n1.5;-0.4;1.44\n3.5;-1.5;1.44\n6;0.2;1.44\n"
CASES = (
    "angle [deg]\tfriction\tfirst.radius\tsecond.material\n10\t0.1\t5 mm\tsteel\n"
    '20\t20 %\t0.005\t"young=70 GPa, poisson=0.3"\n30\t0.3\t5e-3\tglass\n'
)


@pytest.fixture
def file(tmp_path):
    def store(text):
        path = tmp_path / "table.csv"
        path.write_bytes(text.encode("utf-8", "surrogatepass"))
        return path

    return store


def test_measured_rebounds(calls, pair, file, mutated, answered):
    def read(text):
        problem = read_problem(file(text), pair, COLUMNS)
        assert np.isfinite(problem.measured).sum() == problem.count > 0
        assert all(np.isfinite(values).all() for values in problem.before.values())

    total = sum(answered(read, mutated(MEASURED)) for _ in range(calls // 2))
    assert 0 < total < calls // 2


def test_rebound_curves(calls, file, mutated, answered):
    def read(text):
        assert np.isfinite(carom.verify.score(file(text)).max_error)

    assert answered(read, CURVE)
    total = sum(answered(read, mutated(CURVE)) for _ in range(calls // 20))
    assert total < calls // 20


def test_cases_of_a_sweep(calls, file, mutated, answered):
    def read(text):
        table = carom.Table(file(text))
        assert set(table.names) <= {"angle", "friction", "first.radius", "second.material"}

    total = sum(answered(read, mutated(CASES)) for _ in range(calls // 2))
    assert 0 < total < calls // 2


def test_a_cell_that_is_no_number_is_never_read_as_one(calls, rng, mutated):
    """Of a column with one mutated cell the others keep their value to the last bit."""
    good = [f"{angle}" for angle in range(5, 80, 5)]
    for _ in range(calls // 2):
        place, cell = rng.randrange(len(good)), mutated(rng.choice(["30", "-7.5", "1e1", "30 deg"]))
        cells = [*good[:place], cell, *good[place + 1 :]]
        try:
            values = carom.Table({"angle [deg]": cells}).inputs((slice(0, len(good)),))["angle"]
        except carom.InputError:  # a unit alone, or a first row of words
            assert not any(letter in "0123456789" for letter in cell)
            continue
        expected = np.radians([float(text) for text in good])
        expected[place] = values[place]
        np.testing.assert_allclose(values, expected, rtol=1e-15)


def test_the_ends_of_blocks_change_nothing(calls, file, rng, mutated, monkeypatch):
    """The same numbers, rows and refusals, be the rows read two by two or all at once."""
    numbers = ["1", "-2.5", ".5", "3.", "+1e-3", "2E5", "0", "-0.0", "1e-300", "7e-310", "1e308"]

    def read(path):
        try:
            table = read_table(path)
        except carom.InputError as error:
            return str(error)
        read = [column_in_si("a", "1", "", column.cells)[0] for column in table.cells.values()]
        return repr([*map(list, read)]), [*table.rows]

    for _ in range(calls // 4):
        lines = [",".join(rng.choices(numbers, k=3)) for _ in range(rng.randrange(1, 9))]
        path = file("a,b,c\n" + "\n".join([*lines[:-1], mutated(lines[-1])]))
        with monkeypatch.context() as small:
            small.setattr(table_rows, "BLOCK_ROWS", 2)
            dataset = read(path)
        assert read(path) == dataset
