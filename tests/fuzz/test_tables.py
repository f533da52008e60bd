"""Tables as people have them, mutated: a result, or one line; and no cell read otherwise."""

import numpy as np
import openpyxl
import pytest

import carom
from carom.io import table_rows
from carom.io.tables import read_table
from carom.io.user_table import column_in_si
from carom.lab.fitting.reading import read_problem, read_rebounds

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
        problem = read_problem(read_rebounds(file(text), columns=COLUMNS), pair)
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


def dialect(rng, rows, commas):
    """Return a table of texts of numbers as some program may write it, and its encoding."""
    between = rng.choice(";\t" if commas else ",;\t")
    wide = between * rng.choice([0, 0, 1, 3])
    lines = [between.join(row) + wide for row in rows]
    for _ in range(rng.choice([0, 0, 1, 2])):
        blank = rng.choice(["", between * (len(rows[0]) - 1) + wide, "# n, 0,5; 1.5", "% done"])
        lines.insert(rng.randrange(1, len(lines) + 1), blank)
    lines[:0] = rng.choice([[], [], ["# spun, by hand; 0,5"], ["Versuche vom Montag" + wide]])
    encoding = rng.choice(["utf-8", "utf-8-sig", "utf-16", "cp1252"])
    return rng.choice(["\n", "\r\n"]).join([*lines, ""]).encode(encoding)


def test_one_table_in_any_dialect_is_one_table_or_asked(calls, tmp_path, rng):
    """No decimal sign, separator, encoding or blank row changes a number; thousands are asked."""
    path, asked = tmp_path / "lab.txt", 0
    count = calls // 8
    for _ in range(count):
        digits, most = rng.choice([1, 2, 3, 5]), rng.choice([2000.0, 999.0])
        values = [[f"{rng.uniform(-most, most):.{digits}f}" for _ in range(2)] for _ in range(4)]
        commas = rng.random() < 0.6
        sign = "," if commas else "."
        rows = [["a [°]", "b"], *([t.replace(".", sign) for t in row] for row in values)]
        path.write_bytes(dialect(rng, rows, commas))
        try:
            table = read_table(path)
            columns = [table.column(name).cells for name in ("a", "b")]
        except carom.InputError:
            asked += 1
            assert digits == 3
            table = read_table(path, decimal=sign)
            columns = [table.column(name).cells for name in ("a", "b")]
        assert np.array_equal(np.transpose(columns), np.array(values, dtype=float))
        assert table.cells["a"].unit == "°"
    assert 0 < asked < count // 3


def test_damaged_spreadsheets_are_read_or_refused(calls, tmp_path, rng, answered):
    """Any bytes changed, lost or put in: a table, or one line."""
    book, sheet = openpyxl.Workbook(), tmp_path / "lab.xlsx"
    for row in [["psi_1", "psi_2"], *([psi, -0.1 * psi] for psi in (0.5, 1.0, 2.0, 4.0))]:
        book.active.append(row)
    book.save(sheet)
    stored, path = sheet.read_bytes(), tmp_path / "damaged.xlsx"
    assert answered(read_table, sheet)
    for _ in range(calls // 8):
        content = bytearray(stored)
        for _ in range(rng.choice([1, 3, 30])):
            place = rng.randrange(len(content))
            content[place : place + rng.choice([0, 1, 1, 40])] = rng.randbytes(
                rng.choice([0, 1, 4])
            )
        path.write_bytes(content)
        answered(read_table, path)
