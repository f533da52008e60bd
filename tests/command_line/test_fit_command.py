"""`carom fit`: what it prints and stores, exit codes, and one clear line for bad input."""

import csv
import json

import numpy as np
import pytest

import carom

CASE = """
[first]
radius = "2.5 mm"
material = "steel"
"""
DEGREES = (4.0, 9.0, 14.0, 19.0, 24.0, 29.0, 34.0, 45.0, 60.0)
MU = 0.12
GIVEN = ("fit", "data.csv", "--case", "ball.toml")


@pytest.fixture(autouse=True)
def folder(run, tmp_path, table, drops):
    (tmp_path / "ball.toml").write_text(CASE)
    (tmp_path / "data.csv").write_text(table)
    (tmp_path / "plate.toml").write_text(f'{CASE}[second]\nthickness = "3 mm"\n')
    (tmp_path / "lossy.toml").write_text(f"restitution = 0.9\n{CASE}[second]\nthickness = 0.003")
    (tmp_path / "drops.csv").write_text(drops)


@pytest.fixture(scope="module")
def drops():
    ball = carom.Sphere(radius="2.5 mm", material="steel")
    pair = carom.Pair(ball, carom.HalfSpace("steel", thickness="2 mm"), friction=MU)
    bodies = {"first": {"radius": 0.0025, "material": "steel"}, "second": {"material": "steel"}}
    lines = [f"# case: {json.dumps(bodies)}", "normal_speed [m/s],normal_restitution,duration [us]"]
    for speed in (0.1, 0.2, 0.5, 1.0):
        hit = carom.impact(pair, speed=speed)
        lines.append(f"{speed},{hit.normal_restitution},{1e6 * hit.duration}")
    return "\n".join(lines) + "\n"


@pytest.fixture(scope="module")
def table():
    ball = carom.Sphere(radius="2.5 mm", material="steel")
    pair = carom.Pair(ball, carom.HalfSpace(material="steel"), friction=MU)
    noise = np.random.default_rng(9).normal(0.0, 0.01, len(DEGREES))
    lines = ["angle [deg],tangential_restitution,tangential_restitution_error"]
    for degrees, error in zip(DEGREES, noise, strict=True):
        hit = carom.impact(pair, speed=2.0, angle=f"{degrees} deg")
        lines.append(f"{degrees},{hit.tangential_restitution + error},0.01")
    return "\n".join(lines) + "\n"


def test_table_of_a_file_with_a_case(run):
    code, out, _ = run(*GIVEN, "--fix", "restitution=1")
    assert code == 0
    value = float(out.split("friction")[1].split()[0])
    assert value == pytest.approx(MU, rel=0.1)
    assert "restitution    1, not varied" in out
    assert "rows by regime: 1 stick from the first touch; " in out


def test_json_and_advice(run):
    values = (*GIVEN, "--fix", "restitution=1", "--json")
    code, out, _ = run(*values, "--advice", "3", "--for", "friction")
    record = json.loads(out)
    assert code == 0
    low, high = (record["parameters"]["friction"][end] for end in ("low", "high"))
    assert low < MU < high
    assert record["advice"]["parameter"] == "friction"
    assert len(record["advice"]["places"]) == 3


@pytest.mark.slow
def test_shipped_data(run):
    code, out, _ = run("fit", "--dataset", "kharaz2001", "--fix", "restitution=0.98")
    assert code == 0
    assert "24 values" in out


@pytest.mark.slow
def test_files_are_stored(run, tmp_path):
    files = ("--plot", "fit.png", "--output", "fit.nc", "--posterior", "samples.nc")
    values = (*GIVEN, "--fix", "restitution=1", "--steps", "100")
    code, _, err = run(*values, *files)
    assert code == 0
    assert {"fit.png", "fit.nc", "samples.nc"} <= {path.name for path in tmp_path.iterdir()}
    assert "The chain is short" in err
    samples = carom.read("samples.nc")
    assert samples.sizes["sample"] == 75 * 16  # steps kept, walkers
    code, _, _ = run(*values, "--posterior", "corner.png")
    assert code == 0
    assert (tmp_path / "corner.png").exists()


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ((), "give a file, or --dataset"),
        (("data.csv", "--dataset", "kharaz2001"), "give a file, or --dataset"),
        (("data.csv", "--dataset", "kharaz2001"), "data.csv and --dataset are given; "),
        (("kharaz2001",), "data: kharaz2001 comes with Carom; write --dataset kharaz2001\n"),
        (
            ("data.csv",),
            "; give pair=carom.Pair(...) in Python or --case FILE in a shell, or write",
        ),
        (("none.csv", "--case", "ball.toml"), "cannot be read"),
        (("--dataset", "kharaz"), "did you mean 'kharaz2001'"),
        ((*GIVEN[1:], "--fix", "restitution"), "restitution=0.98"),
        ((*GIVEN[1:], "--fix", "e=1"), "'e' is no parameter"),
        ((*GIVEN[1:], "--vary", "friction,x"), "'x' is no parameter"),
        ((*GIVEN[1:], "--plot", "fit.txt"), "must end in"),
        ((*GIVEN[1:], "--output", "data.csv"), "this file is also that of data"),
        ((*GIVEN[1:], "--confidence", "95"), "between 0.5 and 1"),
        ((*GIVEN[1:], "--for", "friction"), "--advice"),
        ((*GIVEN[1:], "--advice", "0"), "advice: '0' cannot be used"),
        ((*GIVEN[1:], "--advice", str(10**12)), "from 1 to 1000\n"),
        ((*GIVEN[1:], "--steps", "0"), "steps: '0' cannot be used"),
        ((*GIVEN[1:], "--steps", str(10**12)), "from 100 to 100000"),
        ((*GIVEN[1:], "--seed", str(10**30)), "seed: '1000"),
        ((*GIVEN[1:], "--vary", "thickness"), "the wall is thick; give its thickness"),
        ((*GIVEN[1:], "--thickness", "0 mm"), "thickness: '0 mm' cannot be used; must be positive"),
        (("data.csv", "--thickness", "3 mm"), "pair: missing, and the data do not name the bodies"),
        (("drops.csv", "--case", "lossy.toml"), "elastic so far; leave losses or thickness out"),
        (("drops.csv", "--case", "plate.toml", "--vary", "restitution"), "or vary thickness"),
    ],
)
def test_bad_input_is_one_line_and_code_2(refusal, arguments, words):
    assert words in refusal("fit", *arguments)


@pytest.mark.slow
@pytest.mark.parametrize(
    "arguments",
    [("--thickness", "5 mm"), ("--case", "plate.toml", "--vary", "thickness")],
    ids=["bodies of the table", "case file"],
)
def test_the_thickness_of_a_plate(run, arguments):
    """2 mm, from contact times and restitutions of normal impacts."""
    code, out, error = run("fit", "drops.csv", *arguments, "--json")
    assert code == 0, error
    record = json.loads(out)
    assert record["parameters"]["thickness"]["value"] == pytest.approx(2e-3, rel=1e-3)
    assert next(iter(record["losses"])) == "ZenerPlate"


@pytest.mark.slow
def test_a_known_thickness_in_place_of_that_of_the_case(run):
    """Then nothing is left to fit of normal impacts, unless a thickness is fixed."""
    code, out, _ = run("fit", "drops.csv", "--case", "plate.toml", "--thickness", "2 mm")
    assert code == 0
    assert "thickness      2 mm (" in out
    code, _, error = run("fit", "drops.csv", "--case", "plate.toml", "--fix", "thickness=2 mm")
    assert (code, error.count("\n")) == (2, 1)


def test_the_template_is_a_table_once_it_is_filled_in(run, refusal, tmp_path):
    """Empty it holds no row, as one line says; with three rows of sliding impacts it fits."""
    code, out, _ = run("fit", "--template")
    assert code == 0
    (tmp_path / "own.csv").write_text(out)
    refusal("fit", "own.csv")
    rows = ["50,2.0,1.0,44.14,-96.2", "60,2.0,1.0,57.0,-74", "70,2.0,-,69.2,-50.6"]
    (tmp_path / "own.csv").write_text(out + "\n".join(rows) + "\n")
    code, out, error = run("fit", "own.csv")
    assert code == 0, error
    assert "8 values of normal_restitution, rebound_angle, spin_out in 3 rows" in out


@pytest.mark.slow
@pytest.mark.parametrize("separator", [",", ";"])
def test_the_template_survives_a_spreadsheet(run, tmp_path, separator):
    """Which cuts each line into cells, fills up the rows, and puts in quotes what needs them."""
    table = run("fit", "--template")[1].replace("10 mm", "2.5 mm")
    table += "50,2.0,1.0,44.14,-96.2\n60,2.0,1.0,57.0,-74\n70,2.0,-,69.2,-50.6\n"
    rows = list(csv.reader(table.splitlines()))
    with (tmp_path / "own.csv").open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, delimiter=separator)
        writer.writerows([*row, *[""] * (5 - len(row))] for row in rows)
    code, out, error = run("fit", "own.csv", "--report", "own.html")
    assert code == 0, error
    assert "8 values of normal_restitution, rebound_angle, spin_out in 3 rows" in out
    assert "sphere (steel, R = 2.5 mm) on half-space (steel)" in (tmp_path / "own.html").read_text()


def test_a_report_tells_its_command(run, tmp_path):
    code, _, error = run(*GIVEN, "--fix", "restitution=1", "--report", "out file.html")
    assert (code, error) == (0, "Carom has stored out file.html.\n")
    page = (tmp_path / "out file.html").read_text()
    words = "carom fit data.csv --case ball.toml --fix restitution=1 --report &#x27;out file.html"
    assert words in page
    assert "<title>Rebounds of data.csv</title>" in page


@pytest.mark.slow
def test_a_report_into_a_stream_is_html(run, tmp_path):
    with (tmp_path / "stream").open("wb") as stream:
        where = f"/dev/fd/{stream.fileno()}"
        code, _, error = run(*GIVEN, "--fix", "restitution=1", "--report", where)
    assert code == 0, error
    assert (tmp_path / "stream").read_bytes().startswith(b"<!DOCTYPE html>")


def test_a_report_of_another_kind_or_over_the_data_is_refused(refusal):
    assert ".html or .pdf" in refusal(*GIVEN, "--report", "report.docx")
    assert "is also that of" in refusal(*GIVEN, "--report", "a.pdf", "--plot", "a.pdf")


def test_the_template_wants_no_data(refusal):
    assert "prints an empty table" in refusal("fit", "data.csv", "--template")


@pytest.mark.slow
def test_two_files_are_compared(run, tmp_path, table):
    """One case for both; without an own restitution, and with a friction that both share."""
    (tmp_path / "other.csv").write_text(table)
    both = ("fit", "data.csv", "other.csv", "--case", "ball.toml", "--fix", "restitution=1")
    assert "other.csv less data.csv: 0 (" in run(*both)[1]
    result = json.loads(run(*both, "--share", "friction", "--json", "--report", "a.html")[1])
    page = (tmp_path / "a.html").read_text(encoding="utf-8")
    assert "<h1>Rebounds of data.csv and other.csv</h1>" in page
    for heading in ("Parameters of the sets", "data.csv: Parameters", "other.csv: Notes"):
        assert f"<h2>{heading}</h2>" in page
    assert result["shared"] == ["friction"]
    assert result["agreement"] == pytest.approx(1.0, abs=1e-3)
    assert [*result["differences"]] == ["kappa", "chi"]
    values = [each["parameters"]["friction"]["value"] for each in result["sets"].values()]
    assert values[0] == values[1] == pytest.approx(MU, rel=0.1)
    run(*both, "--plot", "sets.png", "--output", "sets.csv")
    assert (tmp_path / "sets.png").exists()
    assert (tmp_path / "sets.csv").exists()


def test_faults_of_several_files_are_told_together(refusal, tmp_path):
    (tmp_path / "bad.csv").write_text("angle [deg],spin_out\n95,2\n10,x\n")
    line = refusal("fit", "bad.csv", "none.csv", "--case", "ball.toml")
    assert "B3" in line
    assert "none.csv" in line
    line = refusal("fit", "data.csv", "bad.csv", "--case", "ball.toml")
    assert "bad.csv" in line
    assert "B3" in line
    line = refusal("fit", "data.csv", "bad.csv", "--posterior", "a.csv", "--advice", "3")
    assert "posterior" in line
    assert "advice" in line
    words = refusal("fit", "data.csv", "bad.csv", *(3 * ("--case", "ball.toml")))
    assert "3 for 2 files" in words
    assert "several files" in refusal(*GIVEN, "--share", "friction")
